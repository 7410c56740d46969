// What is within half a width of a segment: the width is that of the surface point.
layout(std430, binding = 3) coherent buffer Heads { uint heads[]; };
layout(std430, binding = 4) coherent buffer Entries { uint count, most, unused_a, unused_b; uvec4 entries[]; };
uniform vec3 eye;
uniform vec2 size;
uniform float pixel;
uniform int parallel, thin;
float pixel_at(vec3 X) { return parallel == 1 ? pixel : pixel * length(X - eye); }
float apart(vec2 p, vec2 a, vec2 b) {
  vec2 d = b - a;
  float l = dot(d, d);
  float t = l > 0.0 ? clamp(dot(p - a, d) / l, 0.0, 1.0) : 0.0;
  return length(p - (a + t * d));
}

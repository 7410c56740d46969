uniform samplerBuffer edges, sides, areas;
uniform sampler2D plan;
uniform usampler2D ids;
uniform mat4 clip_from_world;
uniform vec2 size;
uniform int n, count, by_winding, by_centre, additive, reach;
layout(location = 0) out vec4 to;

const uint SKY = 0xffffffffu;
vec2 Q[4];
uint seen[4];
ivec2 at[4];

vec2 corner_plan(uint id, int k) { int at = (int(id) * 3 + k) * 8 + 6; return vec2(mesh(at), mesh(at + 1)); }

// How far from `from` the ray of a pixel's centre meets a triangle's plane; infinite where it does not.
double reached(vec2 from, uint id, ivec2 pixel) {
  dmat3 of;
  for (int k = 0; k < 3; k++) {
    dvec4 c = dmat4(clip_from_world) * dvec4(corner(id, k), 1.0);
    of[k] = c.xyw;
  }
  dvec2 s = (dvec2(pixel) + 0.5lf) / dvec2(size) * 2.0lf - 1.0lf;
  dvec3 b = inverse(of) * dvec3(s, 1.0lf);
  double all = b.x + b.y + b.z;
  if (!(all > 0.0lf)) return 1e300lf;
  dvec2 p = (b.x * dvec2(corner_plan(id, 0)) + b.y * dvec2(corner_plan(id, 1)) + b.z * dvec2(corner_plan(id, 2))) / all;
  return length(p - dvec2(from));
}

bool spans(int a, int b) {
  if (seen[a] == seen[b]) return false;
  double length_of = length(dvec2(Q[b]) - dvec2(Q[a]));
  return length_of > 8.0lf * reached(Q[a], seen[a], at[b]) && length_of > 8.0lf * reached(Q[b], seen[b], at[a]);
}

float turn(vec2 a, vec2 b, vec2 p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

bool within(vec2 p) {
  bool odd = false;
  for (int k = 0; k < 4; k++) {
    vec2 a = Q[k], b = Q[(k + 1) & 3];
    if ((a.y > p.y) != (b.y > p.y) && (turn(a, b, p) > 0.0) == (b.y > a.y)) odd = !odd;
  }
  return odd;
}

bool cross_or_touch(vec2 a, vec2 b, vec2 c, vec2 d) {
  float p = turn(a, b, c), q = turn(a, b, d), r = turn(c, d, a), s = turn(c, d, b);
  bool apart = (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0) || (r > 0.0 && s > 0.0) || (r < 0.0 && s < 0.0);
  return !apart && all(lessThanEqual(max(min(a, b), min(c, d)), min(max(a, b), max(c, d))));
}

bool meets(vec2 a, vec2 b, vec2 low, vec2 high) {
  if (any(lessThan(max(a, b), low)) || any(greaterThan(min(a, b), high))) return false;
  if (within(a)) return true;
  for (int k = 0; k < 4; k++) if (cross_or_touch(a, b, Q[k], Q[(k + 1) & 3])) return true;
  return false;
}

vec2 place(int k) {
  vec2 s = (vec2(k % n, k / n) + 0.5) / float(n);
  return mix(mix(Q[0], Q[1], s.x), mix(Q[3], Q[2], s.x), s.y);
}

// Along a ray to the west.
int winding_of(vec2 a, vec2 b, vec2 p) {
  if ((a.y > p.y) == (b.y > p.y) || (turn(a, b, p) > 0.0) == (b.y > a.y)) return 0;
  return b.y > a.y ? -1 : 1;
}

// Which samples an area holds, a bit each.
uint held(int area, bool refused, vec2 low, vec2 high) {
  vec4 of = texelFetch(areas, area * 3);
  int around = 0;
  int sums[25];
  for (int k = 0; k < n * n; k++) sums[k] = 0;
  bool near = false;
  for (int e = int(of.x); e < int(of.x) + int(of.y); e++) {
    vec4 edge = texelFetch(edges, e);
    vec2 a = edge.xy, b = edge.zw;
    around += winding_of(a, b, Q[0]);
    bool met = !refused && meets(a, b, low, high);
    near = near || met;
    if (by_winding == 1) {
      for (int k = 0; k < n * n; k++) sums[k] += winding_of(a, b, place(k));
    } else if (met) {
      vec2 outward = vec2(b.y - a.y, a.x - b.x) * (texelFetch(sides, e).x == 1.0 ? -1.0 : 1.0);
      for (int k = 0; k < n * n; k++) {
        vec2 s = place(k);
        float along = dot(s - a, b - a);
        if (along < 0.0 || along > dot(b - a, b - a)) continue;
        sums[k] += dot(a - s + b - s, outward) >= 0.0 ? 1 : -1;
      }
    }
  }
  bool odd = of.z == 0.0;
  if (!near) return (odd ? (around & 1) != 0 : around != 0) ? 0xffffffffu : 0u;
  uint bits = 0u;
  for (int k = 0; k < n * n; k++) {
    bool in_it = by_winding == 0 ? sums[k] > 0 : odd ? (sums[k] & 1) != 0 : sums[k] != 0;
    bits |= in_it ? 1u << k : 0u;
  }
  return bits;
}

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  if (texelFetch(ids, p, 0).x == SKY) discard;
  ivec2 steps[4] = ivec2[4](ivec2(0), ivec2(reach, 0), ivec2(reach), ivec2(0, reach));
  bool refused = false;
  for (int k = 0; k < 4; k++) {
    at[k] = p + steps[k];
    Q[k] = texelFetch(plan, at[k], 0).xy;
    seen[k] = texelFetch(ids, at[k], 0).x;
    refused = refused || seen[k] == SKY;
  }
  for (int k = 0; k < 4 && !refused && by_centre == 1; k++) refused = spans(k, (k + 1) & 3);
  vec2 low = min(min(Q[0], Q[1]), min(Q[2], Q[3])), high = max(max(Q[0], Q[1]), max(Q[2], Q[3]));
  vec4 found[25], below[25];
  for (int k = 0; k < n * n; k++) found[k] = vec4(ground(seen[0], Q[0]), 1.0);
  float layer = -1.0, opacity = 1.0;
  for (int area = 0; area <= count; area++) {
    vec4 style = area < count ? texelFetch(areas, area * 3 + 1) : vec4(0.0, 0.0, -2.0, 1.0);
    if (style.z != layer) {
      for (int k = 0; k < n * n; k++) {
        if (layer >= 0.0) found[k] = mix(below[k], found[k], opacity);
        below[k] = found[k];
      }
      layer = style.z;
      opacity = style.w;
    }
    if (area == count || texelFetch(areas, area * 3).w == 0.0) continue;
    uint bits = held(area, refused, low, high);
    if (bits != 0u && style.x != 0.0) {
      uint cut = held(int(style.y), refused, low, high);
      bits &= style.x == 1.0 ? cut : ~cut;
    }
    vec4 paint = texelFetch(areas, area * 3 + 2);
    for (int k = 0; k < n * n; k++) {
      if ((bits >> k & 1u) == 0u) continue;
      found[k] = additive == 1 ? min(found[k] + paint, 1.0) : paint + found[k] * (1.0 - paint.w);
    }
  }
  to = vec4(0.0);
  for (int k = 0; k < n * n; k++) to += found[k] / float(n * n);
}

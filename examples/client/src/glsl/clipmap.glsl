// The virtual texture: tiles of 256 texels, level after level, row after row from the north.
uniform usamplerBuffer pages;
uniform sampler2DArray store;
uniform vec2 north_west;
uniform float finest;
uniform vec2 size;
uniform mat4 clip_from_world;
#ifdef MARK
layout(std430, binding = 3) coherent buffer Marks { uint marks[]; };
#endif

float rounded(float w, int bits) { return bits == 0 ? w : floor(w * exp2(float(bits)) + 0.5) / exp2(float(bits)); }
ivec2 inside(ivec2 at, int level) { return clamp(at, ivec2(0), ivec2((SIZE >> level) - 1)); }

vec4 texel(int level, ivec2 at) {
  at = inside(at, level);
  ivec2 tile = at >> 8;
  int index = int(whole(LEVEL + level * 5)) + tile.y * int(whole(LEVEL + level * 5 + 1)) + tile.x;
#ifdef MARK
  atomicOr(marks[index >> 5], 1u << uint(index & 31));
  return vec4(0.0);
#else
  return min(texelFetch(store, ivec3(at & 255, int(texelFetch(pages, index).x)), 0), 1.0);
#endif
}

// Whether the square between two texels is at hand.
bool at_hand(int level, ivec2 low, ivec2 high) {
  int of = LEVEL + level * 5;
  ivec2 first = ivec2(int(whole(of + 2)), int(whole(of + 3))), last = first + int(whole(of + 4)) - 1;
  return all(greaterThanEqual(inside(low, level) >> 8, first)) && all(lessThanEqual(inside(high, level) >> 8, last));
}

// What is read of a level, or of the first coarser one that is at hand.
vec4 read(inout int level, vec2 P) {
  vec2 at = vec2(P.x - north_west.x, north_west.y - P.y) / finest;
  ivec2 low, high;
  vec2 from;
  for (int k = 0; k < 32; k++) {
    from = at / exp2(float(level)) - (NEAREST == 1 ? 0.0 : 0.5);
    low = ivec2(floor(from));
    high = low + (NEAREST == 1 ? 0 : 1);
    if (level == COARSEST || at_hand(level, low, high)) break;
    level++;
  }
  if (NEAREST == 1) return texel(level, low);
  vec2 w = vec2(rounded(fract(from.x), FILTER_BITS), rounded(fract(from.y), FILTER_BITS));
  vec4 upper = mix(texel(level, low), texel(level, low + ivec2(1, 0)), w.x);
  vec4 lower = mix(texel(level, low + ivec2(0, 1)), texel(level, high), w.x);
  return mix(upper, lower, w.y);
}

float level_of(float extent) { return clamp(log2(extent / finest) + BIAS, 0.0, float(COARSEST)); }

vec4 trilinear(float level, vec2 P) {
  int finer = min(int(floor(level)), COARSEST), used = finer;
  float w = rounded(level - float(finer), LEVEL_BITS);
  vec4 c = read(used, P);
  if (used == finer && w > 0.0) {
    int coarser = min(finer + 1, COARSEST);
    c = mix(c, read(coarser, P), w);
  }
  return c;
}

// How the plan point moves from pixel to pixel, in the plane of a triangle.
void moves(uint id, vec2 P, out vec2 dx, out vec2 dy) {
  dmat3 of;
  dvec2 plans[3];
  for (int k = 0; k < 3; k++) {
    dvec4 c = dmat4(clip_from_world) * dvec4(corner(id, k), 1.0);
    of[k] = c.xyw;
    int at = (int(id) * 3 + k) * 8 + 6;
    plans[k] = dvec2(mesh(at), mesh(at + 1));
  }
  dmat3 back = inverse(of);
  dvec2 s = dvec2(gl_FragCoord.xy) / dvec2(size) * 2.0lf - 1.0lf;
  dvec3 b = back * dvec3(s, 1.0lf);
  double all = b.x + b.y + b.z;
  dvec2 at = (b.x * plans[0] + b.y * plans[1] + b.z * plans[2]) / all;
  dvec3 x = back[0], y = back[1];
  dx = vec2((x.x * (plans[0] - at) + x.y * (plans[1] - at) + x.z * (plans[2] - at)) / all * 2.0lf / double(size.x));
  dy = vec2((y.x * (plans[0] - at) + y.y * (plans[1] - at) + y.z * (plans[2] - at)) / all * 2.0lf / double(size.y));
}

vec4 filtered(uint id, vec2 P) {
  vec2 dx, dy;
  moves(id, P, dx, dy);
  float longer = max(length(dx), length(dy));
  if (FILTER < 2) {
    int level = int(ceil(level_of(longer) - 0.5));
    return read(level, P);
  }
  if (FILTER == 2) return trilinear(level_of(longer), P);
  float xx = dx.x * dx.x + dy.x * dy.x, xy = dx.x * dx.y + dy.x * dy.y, yy = dx.y * dx.y + dy.y * dy.y;
  float area = abs(dx.x * dy.y - dx.y * dy.x);
  float axis = sqrt(0.5 * (xx + yy + sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy))), other = area / axis;
  if (!(other > 0.0)) return trilinear(float(COARSEST), P);
  int n = int(clamp(ceil(axis / other - 1e-6), 1.0, float(ANISOTROPY)));
  float turn = 0.5 * atan(2.0 * xy, xx - yy);
  vec2 along = axis * vec2(cos(turn), sin(turn));
  vec4 sum = vec4(0.0);
  for (int k = 0; k < n; k++) sum += trilinear(level_of(axis / float(n)), P + along * ((float(k) + 0.5) / float(n) - 0.5));
  return sum / float(n);
}

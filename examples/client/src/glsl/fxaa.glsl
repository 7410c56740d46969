// FXAA over the whole picture, encoded and premultiplied.
uniform sampler2D picture;
uniform int linear;
layout(location = 0) out vec4 to;

vec4 color(ivec2 p) {
  vec4 c = texelFetch(picture, clamp(p, ivec2(0), textureSize(picture, 0) - 1), 0);
  if (linear == 0 || c.a == 0.0) return c;
  vec3 straight = c.rgb / c.a;
  vec3 encoded = mix(straight * 12.92, 1.055 * pow(straight, vec3(1.0 / 2.4)) - 0.055, greaterThan(straight, vec3(0.0031308)));
  return vec4(encoded * c.a, c.a);
}
float luma(ivec2 p) { return dot(color(p).rgb, vec3(0.299, 0.587, 0.114)); }

// Half way between p and p + across, some way along: linear between pixels.
float between(ivec2 p, ivec2 across, ivec2 along, float way) {
  int whole = int(floor(way));
  float share = way - float(whole);
  ivec2 a = p + along * whole, b = a + along;
  return 0.5 * mix(luma(a) + luma(a + across), luma(b) + luma(b + across), share);
}

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  // Rows are counted from below here: north is up.
  float own = luma(p), n = luma(p + ivec2(0, 1)), s = luma(p - ivec2(0, 1)), e = luma(p + ivec2(1, 0)), w = luma(p - ivec2(1, 0));
  float most = max(own, max(max(n, s), max(e, w))), least = min(own, min(min(n, s), min(e, w))), range = most - least;
  to = color(p);
  if (range < max(0.0833, 0.166 * most)) return;
  float nw = luma(p + ivec2(-1, 1)), ne = luma(p + ivec2(1, 1)), sw = luma(p - ivec2(1, 1)), se = luma(p + ivec2(1, -1));
  float u = min(1.0, abs((2.0 * (n + s + w + e) + nw + ne + sw + se) / 12.0 - own) / range);
  float t = u * u * (3.0 - 2.0 * u), sub = 0.75 * t * t;
  float rows = 2.0 * abs(n - 2.0 * own + s) + abs(nw - 2.0 * w + sw) + abs(ne - 2.0 * e + se);
  float columns = 2.0 * abs(w - 2.0 * own + e) + abs(nw - 2.0 * n + ne) + abs(sw - 2.0 * s + se);
  bool flat_ = rows >= columns;
  float first = flat_ ? n : w, second = flat_ ? s : e;
  bool is_first = abs(first - own) >= abs(second - own);
  ivec2 across = (flat_ ? ivec2(0, 1) : ivec2(-1, 0)) * (is_first ? 1 : -1), along = flat_ ? ivec2(1, 0) : ivec2(0, -1);
  float other = is_first ? first : second, here = 0.5 * (own + other), quarter = 0.25 * abs(other - own);
  const float steps[5] = float[5](1.0, 2.5, 4.5, 8.5, 20.5);
  float reached[2], off[2];
  for (int side = 0; side < 2; side++) {
    for (int k = 0; k < 5; k++) {
      reached[side] = steps[k];
      off[side] = between(p, across, along, side == 0 ? -steps[k] : steps[k]) - here;
      if (abs(off[side]) >= quarter) break;
    }
  }
  int near = reached[1] <= reached[0] ? 1 : 0;
  float edge = (off[near] < 0.0) == (own < here) ? 0.0 : 0.5 - reached[near] / (reached[0] + reached[1]);
  to += max(edge, sub) * (color(p + across) - to);
}

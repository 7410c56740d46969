// A segment of a stroke: rows of SEGMENTS (item; vertices at its start and end, before it, after it; the side that counts),
// STYLES (role, rule, side, join, cap, group), VALUES (half width, miter limit), ITEM_STYLES, VERTICES.
float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }
vec2 vertex(uint k) { return pair(VERTICES + int(k) * 2); }

// Software GPUs have been seen to lose what shaders with returns amid loops hold: there is one return.
bool segment_holds(int row, vec2 P, out bool ask_area) {
  int s = SEGMENTS + row * 6;
  int style = int(whole(ITEM_STYLES + int(whole(s))));
  float h = single(VALUES + style * 2), limit = single(VALUES + style * 2 + 1);
  uint wanted = whole(STYLES + style * 6 + 2), join = whole(STYLES + style * 6 + 3), cap = whole(STYLES + style * 6 + 4);
  vec2 a = vertex(whole(s + 1)), b = vertex(whole(s + 2)), uu = P - a, ww = P - b;
  bool dot_ = whole(s + 1) == whole(s + 2), starts = whole(s + 3) == NONE, ends = whole(s + 4) == NONE;
  float len = dot_ ? 0.0 : length(b - a);
  vec2 d = dot_ ? vec2(1.0, 0.0) : (b - a) / len;
  ask_area = wanted != 0u && whole(s + 5) == 0u;
  float along = dot(d, uu), before = starts && cap == 1u ? h : 0.0, behind = ends && cap == 1u ? h : 0.0;
  bool holds = abs(cross2(d, uu)) <= h && (!dot_ || cap == 1u) && along >= -before && along <= len + behind;
  holds = holds || (starts ? cap == 2u : join == 0u) && dot(uu, uu) <= h * h;
  holds = holds || (ends ? cap == 2u : join == 0u) && dot(ww, ww) <= h * h;
  vec2 e = starts ? d : normalize(a - vertex(whole(s + 3)));
  float outward = cross2(e, d) > 0.0 ? -1.0 : 1.0;
  vec2 m = outward * vec2(-e.y, e.x), n = outward * vec2(-d.y, d.x);
  bool beyond = limit * limit * (1.0 + dot(e, d)) < 2.0;
  bool between = dot(e, uu) >= 0.0 && along <= 0.0;
  bool bevel = between && dot(m + n, uu) <= h * (1.0 + dot(e, d));
  bool miter = between && dot(m, uu) <= h && dot(n, uu) <= h;
  bool disc = dot(uu, uu) <= h * h;
  bool joined = join == 1u ? bevel : join == 2u && beyond ? bevel : join == 3u && beyond ? disc : miter;
  holds = holds || !starts && !dot_ && join != 0u && joined;
  bool aside = whole(s + 5) != 0u && (cross2(d, uu) >= 0.0) != (whole(s + 5) == 1u);
  return holds && !aside;
}

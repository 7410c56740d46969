// Items that hold a point, each once.
const int MOST = 96;
uint hits[MOST];
int hit_count = 0;

void hit(uint item, bool again) {
  bool known = hit_count == MOST;
  for (int k = 0; k < hit_count; k++) known = known || (hits[k] == item && !again);
  if (!known) hits[hit_count++] = item;
}

// The next item in draw order behind the first `done` hits that are in their places already.
uint next_hit(int done) {
  for (int k = done + 1; k < hit_count; k++) {
    bool sooner = UPSIDE_DOWN == 1 ? hits[k] > hits[done] : hits[k] < hits[done];
    uint other = hits[k];
    if (sooner) { hits[k] = hits[done]; hits[done] = other; }
  }
  return hits[done];
}

// What is found over the ground: `over` or `additive`, layers that are composed as a whole by themselves.
vec4 compose(vec4 ground) {
  vec4 found = ground, below = ground;
  uint group = NONE;
  float opacity = 1.0;
  for (int k = 0; k <= hit_count; k++) {
    int item = k < hit_count ? int(next_hit(k)) : 0;
    uint of = k < hit_count && whole(ITEMS + item * 6 + 5) == 1u ? whole(ITEMS + item * 6) : NONE;
    if (of != group) {
      if (group != NONE) found = mix(below, found, opacity);
      below = found;
      group = of;
      opacity = single(PAINTS + item * 5 + 4);
    }
    if (k == hit_count) break;
    vec4 paint = vec4(single(PAINTS + item * 5), single(PAINTS + item * 5 + 1), single(PAINTS + item * 5 + 2), single(PAINTS + item * 5 + 3));
    found = ADDITIVE == 1 ? min(found + paint, 1.0) : paint + found * (1.0 - paint.w);
  }
  return found;
}

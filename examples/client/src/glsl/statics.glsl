// All strokes and areas of the scene, one after another: MEMBERS (first and count in RING_EDGES), edges as pairs of vertices.
// Whether the members of an item's feature hold a point.
bool polygon_holds(int first, int count, uint rule, vec2 P) {
  bool holds = false;
  for (int m = first; m < first + count; m++) {
    int sum = 0, from = int(whole(MEMBERS + m * 2)), edges = int(whole(MEMBERS + m * 2 + 1));
    for (int e = from; e < from + edges; e++) {
      vec2 a = pair(RING_EDGES + e * 4), b = pair(RING_EDGES + e * 4 + 2);
      int way = int(P.y < b.y) - int(P.y < a.y);
      sum += way * int(cross2(b - a, P - a) * float(way) > 0.0);
    }
    holds = holds || (rule == 0u ? (sum & 1) != 0 : sum != 0);
  }
  return holds;
}

bool item_polygon(uint item, vec2 P) {
  int at = POLYGON_OF + int(item) * 2;
  return polygon_holds(int(whole(at)), int(whole(at + 1)), whole(ITEMS + int(item) * 6 + 3), P);
}

void look_up(vec2 P) {
  for (uint item = 0u; item < uint(ITEM_COUNT); item++) {
    uint kind = whole(ITEMS + int(item) * 6 + 2);
    if (kind < 2u && item_polygon(item, P)) hit(item, false);
    int of = SEGMENTS_OF + int(item) * 2;
    for (int row = int(whole(of)); row < int(whole(of) + whole(of + 1)); row++) {
      bool ask;
      if (!segment_holds(row, P, ask)) continue;
      if (ask && item_polygon(item, P) != (whole(ITEMS + int(item) * 6 + 4) == 1u)) continue;
      hit(item, TWICE == 1);
      if (TWICE == 0) break;
    }
  }
}

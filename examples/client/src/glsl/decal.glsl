// The decal grid, its cells' trees and quadtrees.
struct Walk { int node, nodes, count, inner, first; };

bool in_box(int at, vec2 P) { return all(greaterThanEqual(P, pair(at))) && all(lessThanEqual(P, pair(at + 2))); }

// From a node on, the row of the next leaf whose box holds P; -1: the walk has ended.
int next_leaf(inout Walk w, int tree, int boxes, vec2 P) {
  int row = -1;
  while (w.node >= 0 && row < 0) {
    int i = w.node;
    uint box = whole(tree + w.nodes + i);
    bool holds = box != NONE && in_box(boxes + int(box) * 4, P);
    if (holds && i < w.inner) {
      w.node = WIDE * i + 1;
    } else {
      if (holds) row = w.first + i - w.inner;
      while (i % WIDE == 0 && i > 0) i = (i - 1) / WIDE;
      w.node = i == 0 ? -1 : i + 1;
    }
  }
  return row;
}

Walk start(int cell, int column) {
  int c = CELLS + cell * 10 + column;
  int count = int(whole(c + 1));
  return Walk(count == 0 ? -1 : 0, int(whole(c)), count, (count - 1) / WIDE, int(whole(c + 2)));
}

// Points count as moved to the east by next to nothing, and to the north by still less.
bool left_of(vec2 a, vec2 b, vec2 p) {
  float side = cross2(b - a, p - a);
  return side != 0.0 ? side > 0.0 : b.y != a.y ? b.y < a.y : b.x > a.x;
}

int winding_in_leaf(int leaf, vec2 P, vec2 C) {
  int at = LEAVES + leaf * 3, sum = int(whole(at + 2));
  vec2 K = vec2(C.x, P.y);
  for (int k = 0; k < int(whole(at + 1)); k++) {
    int e = EDGES + (int(whole(at)) + k) * 2;
    vec2 a = vertex(whole(e)), b = vertex(whole(e + 1));
    if ((a.y > P.y) != (b.y > P.y) && left_of(a, b, P) != left_of(a, b, K)) sum += b.y > a.y ? 1 : -1;
    if ((a.x > C.x) != (b.x > C.x) && left_of(a, b, K) != left_of(a, b, C)) sum += b.x > a.x ? 1 : -1;
  }
  return sum;
}

int winding_of_part(int part, vec2 P) {
  int node = int(whole(PARTS + part * 2 + 1));
  uint kind = in_box(QUADS + node * 4, P) ? whole(NODES + node * 2) : 1u;
  for (int deep = 0; deep < 32 && kind == 0u; deep++) {
    int first = int(whole(NODES + node * 2 + 1));
    vec2 border = pair(QUADS + first * 4 + 2);
    node = first + (P.x < border.x ? 0 : 1) + (P.y < border.y ? 0 : 2);
    kind = whole(NODES + node * 2);
  }
  uint of = whole(NODES + node * 2 + 1);
  int sum = kind == 2u ? int(of) : 0;
  if (kind == 3u) sum = winding_in_leaf(int(of), P, vec2(single(QUADS + node * 4 + 2), single(QUADS + node * 4 + 1)));
  return sum;
}

bool area_holds(uint area, uint rule, vec2 P) {
  int at = AREAS + int(area == NONE ? 0u : area) * 3;
  int first = area == NONE ? 0 : int(whole(at + 1)), count = area == NONE ? 0 : int(whole(at + 2));
  bool holds = false;
  for (int k = 0; k < count && !holds; k++) {
    uint member = whole(RINGS + int(whole(PARTS + (first + k) * 2)) * 4 + 1);
    int sum = 0;
    for (int j = 0; j < count; j++)
      if (whole(RINGS + int(whole(PARTS + (first + j) * 2)) * 4 + 1) == member) sum += winding_of_part(first + j, P);
    holds = rule == 0u ? (sum & 1) != 0 : sum != 0;
  }
  return holds;
}

// Whether the cell's area of an item's layer and feature is where the item's side wants it.
bool on_side(int cell, uint item, vec2 P) {
  int at = ITEMS + int(item) * 6, style = int(whole(ITEM_STYLES + int(item)));
  uint side = whole(STYLES + style * 6 + 2), found = NONE;
  for (int k = 0; k < int(whole(CELLS + cell * 10 + 9)); k++) {
    uint area = whole(CELLS + cell * 10 + 8) + uint(k);
    int owner = ITEMS + int(whole(AREAS + int(area) * 3)) * 6;
    if (whole(owner) == whole(at) && whole(owner + 1) == whole(at + 1)) found = area;
  }
  return area_holds(found, whole(STYLES + style * 6 + 1), P) == (side == 1u);
}

void look_up(vec2 P) {
  vec2 size = (pair(GRID + 2) - pair(GRID)) / float(CELLS_A_SIDE);
  ivec2 at = ivec2(floor((P - pair(GRID)) / size));
  if (P == pair(GRID + 2)) at = ivec2(CELLS_A_SIDE - 1);
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(CELLS_A_SIDE)))) return;
  int cell = at.x + CELLS_A_SIDE * at.y;
  Walk lines = start(cell, 0), fills = start(cell, 4);
  for (int row; (row = next_leaf(lines, LINE_NODES, LINE_BOXES, P)) >= 0;) {
    bool ask;
    uint item = whole(SEGMENTS + row * 6);
    if (segment_holds(row, P, ask) && (!ask || on_side(cell, item, P))) hit(item, TWICE == 1);
  }
  for (int row; (row = next_leaf(fills, POLYGON_NODES, POLYGON_BOXES, P)) >= 0;) {
    uint item = whole(POLYGONS + row * 2);
    int style = STYLES + int(whole(ITEM_STYLES + int(item))) * 6;
    if (area_holds(whole(POLYGONS + row * 2 + 1), whole(style + 1), P) != (whole(style) == 1u)) hit(item, false);
  }
}

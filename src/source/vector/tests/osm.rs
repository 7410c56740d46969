//! OpenStreetMap's PBF, written here by hand.

use super::*;
use crate::scene::Attribute;
use std::io::Write;

fn varint(mut number: u64) -> Vec<u8> {
    let mut out = Vec::new();
    while number > 0x7f {
        out.push(number as u8 | 0x80);
        number >>= 7;
    }
    out.push(number as u8);
    out
}

fn zigzag(number: i64) -> u64 {
    ((number << 1) ^ (number >> 63)).cast_unsigned()
}

fn number(field: u64, number: u64) -> Vec<u8> {
    [varint(field << 3), varint(number)].concat()
}

fn bytes(field: u64, content: &[u8]) -> Vec<u8> {
    [&varint(field << 3 | 2)[..], &varint(content.len() as u64), content].concat()
}

fn packed(field: u64, numbers: impl IntoIterator<Item = u64>) -> Vec<u8> {
    bytes(field, &numbers.into_iter().flat_map(varint).collect::<Vec<_>>())
}

fn differences(field: u64, numbers: &[i64]) -> Vec<u8> {
    let mut last = 0;
    packed(field, numbers.iter().map(|number| zigzag(number - std::mem::replace(&mut last, *number))))
}

type Tags<'a> = &'a [(&'a str, &'a str)];

/// The elements of one block, and its texts.
#[derive(Default)]
struct Block {
    strings: Vec<String>,
    groups: Vec<u8>,
}

impl Block {
    fn string(&mut self, text: &str) -> u64 {
        if self.strings.is_empty() {
            self.strings.push(String::new());
        }
        self.strings.push(text.into());
        self.strings.len() as u64 - 1
    }

    fn tags(&mut self, tags: Tags<'_>) -> Vec<u8> {
        let keys: Vec<u64> = tags.iter().map(|(key, _)| self.string(key)).collect();
        let values: Vec<u64> = tags.iter().map(|(_, value)| self.string(value)).collect();
        [packed(2, keys), packed(3, values)].concat()
    }

    /// Nodes by id, x and y in degrees; the last one has a tag.
    fn dense(&mut self, nodes: &[(i64, f64, f64)]) {
        let (key, value) = (self.string("natural"), self.string("tree"));
        let of = |pick: fn(&(i64, f64, f64)) -> f64| -> Vec<i64> {
            nodes.iter().map(|node| (pick(node) * 1e7).round() as i64).collect()
        };
        let mut tags = vec![0; nodes.len() - 1];
        tags.extend([key, value, 0]);
        let ids: Vec<i64> = nodes.iter().map(|node| node.0).collect();
        let dense = [
            differences(1, &ids),
            differences(8, &of(|node| node.2)),
            differences(9, &of(|node| node.1)),
            packed(10, tags),
        ];
        self.groups.extend(bytes(2, &bytes(2, &dense.concat())));
    }

    fn node(&mut self, (id, x, y): (i64, f64, f64)) {
        let place = |degrees: f64| zigzag((degrees * 1e7).round() as i64);
        let node = [number(1, zigzag(id)), number(8, place(y)), number(9, place(x))].concat();
        self.groups.extend(bytes(2, &bytes(1, &node)));
    }

    fn way(&mut self, id: u64, tags: Tags<'_>, nodes: &[i64]) {
        let way = [number(1, id), self.tags(tags), differences(8, nodes)].concat();
        self.groups.extend(bytes(2, &bytes(3, &way)));
    }

    fn relation(&mut self, id: u64, tags: Tags<'_>, ways: &[(i64, &str)]) {
        let roles: Vec<u64> = ways.iter().map(|(_, role)| self.string(role)).collect();
        let ids: Vec<i64> = ways.iter().map(|(id, _)| *id).collect();
        let kinds = ways.iter().map(|_| 1);
        let relation =
            [number(1, id), self.tags(tags), packed(8, roles), differences(9, &ids), packed(10, kinds)];
        self.groups.extend(bytes(2, &bytes(4, &relation.concat())));
    }

    fn content(&self) -> Vec<u8> {
        let strings: Vec<u8> = self.strings.iter().flat_map(|text| bytes(1, text.as_bytes())).collect();
        [bytes(1, &strings), self.groups.clone()].concat()
    }
}

fn blob(kind: &str, content: &[u8], is_packed: bool) -> Vec<u8> {
    let blob = if is_packed {
        let mut packer = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
        packer.write_all(content).unwrap();
        [number(2, content.len() as u64), bytes(3, &packer.finish().unwrap())].concat()
    } else {
        bytes(1, content)
    };
    let header = [bytes(1, kind.as_bytes()), number(3, blob.len() as u64)].concat();
    [&(header.len() as u32).to_be_bytes()[..], &header, &blob].concat()
}

fn header(feature: &str) -> Vec<u8> {
    blob("OSMHeader", &[bytes(4, b"OsmSchema-V0.6"), bytes(4, feature.as_bytes())].concat(), false)
}

/// A square of nodes 1 to 4, one inside it of nodes 5 to 8, and what is made of them.
fn town() -> Block {
    let mut block = Block::default();
    block.dense(&[
        (1, 0.0, 0.0),
        (2, 4.0, 0.0),
        (3, 4.0, 4.0),
        (4, 0.0, 4.0),
        (5, 1.0, 1.0),
        (6, 2.0, 1.0),
        (7, 2.0, 2.0),
        (100, -51.234_567_8, -29.987_654_3),
    ]);
    block.node((8, 1.0, 2.0));
    block.way(10, &[], &[1, 2, 3]);
    block.way(11, &[], &[1, 4, 3]);
    block.way(12, &[("building", "yes"), ("levels", "3"), ("ref", "007")], &[5, 6, 7, 8, 5]);
    block.way(13, &[("highway", "residential"), ("levels", "2.5")], &[1, 2, 3, 4, 1]);
    block.way(14, &[("highway", "path")], &[1, 2, 999, 3, 100]);
    block.way(15, &[("building", "yes")], &[1, 2, 999, 1]);
    block.relation(
        20,
        &[("type", "multipolygon"), ("natural", "water")],
        &[(10, "outer"), (12, "inner"), (11, "outer")],
    );
    block.relation(21, &[("type", "multipolygon"), ("natural", "wood")], &[(10, "outer"), (77, "outer")]);
    block.relation(22, &[("type", "route"), ("ref", "1")], &[(13, "")]);
    block.relation(23, &[("type", "multipolygon")], &[(77, "outer")]);
    block
}

pub(super) fn town_file(is_packed: bool) -> Vec<u8> {
    [header("DenseNodes"), blob("OSMData", &town().content(), is_packed)].concat()
}

#[test]
fn ways_are_lines_closed_ones_areas_by_their_tags_and_multipolygons_rings() {
    for is_packed in [false, true] {
        let (_folder, path) = file("a.osm.pbf", &town_file(is_packed));
        let read = read_columns(&path, None, &["levels".into(), "natural".into(), "ref".into()]).unwrap();
        let kinds: Vec<(usize, bool, Vec<usize>)> = read
            .features
            .iter()
            .map(|f| {
                let parts = f.shape.parts().map(Vec::len).collect();
                (f.index, matches!(f.shape, Shape::Polygon(_)), parts)
            })
            .collect();
        assert_eq!(
            kinds,
            [(0, true, vec![4]), (1, false, vec![5]), (2, false, vec![2, 2]), (4, true, vec![4, 4])]
        );
        let Shape::Line(parts) = &read.features[2].shape else { panic!("no line") };
        assert_eq!(parts[1][1], Plan::new(-51.234_567_8, -29.987_654_3));
        let text = |text: &str| Attribute::Text(text.into());
        let value = |column: usize, feature: usize| read.columns[column].value(feature).clone();
        assert_eq!([value(0, 0), value(0, 1)], [Attribute::Integer(3), Attribute::Number(2.5)]);
        assert_eq!([value(1, 0), value(2, 4)], [text("007"), text("water")]);
        assert_eq!(
            read.columns.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(),
            ["levels", "ref", "natural"]
        );
        assert!(read.crs.unwrap().is_geographic());
        assert_eq!(
            read.notes,
            [
                "1 point left out: nodes with tags are not drawn",
                "2 ways lack nodes that the file does not hold: lines end there, areas are left out",
                "1 area lacking ways or nodes that the file does not hold, left out (relation 21)",
            ]
        );
    }
}

#[test]
fn nodes_may_stand_in_any_order_and_after_the_ways() {
    let mut ways = Block::default();
    ways.way(1, &[("highway", "path")], &[3, 1, 2]);
    let mut nodes = Block::default();
    for node in [(2, 2.0, 0.0), (3, 3.0, 0.0), (1, 1.0, 0.0), (4, 4.0, 0.0)] {
        nodes.node(node);
    }
    let bytes = [
        header("DenseNodes"),
        blob("OSMData", &ways.content(), true),
        blob("Whatever", b"x", false),
        blob("OSMData", &nodes.content(), false),
    ];
    let read = read_bytes("noname", &bytes.concat()).unwrap();
    let Shape::Line(parts) = &read.features[0].shape else { panic!("no line") };
    assert_eq!(parts[0].iter().map(|p| p.x).collect::<Vec<_>>(), [3.0, 1.0, 2.0]);
}

#[test]
fn what_is_not_done_and_what_is_damaged_is_refused() {
    let refused = refusal("a.pbf", &[header("HistoricalInformation"), town_file(false)].concat());
    assert!(refused.contains("'HistoricalInformation'") && refused.contains("osmium"), "{refused}");
    let content = bytes(7, b"x");
    let head = [bytes(1, b"OSMData"), number(3, content.len() as u64)].concat();
    let zstd = [&header("DenseNodes")[..], &(head.len() as u32).to_be_bytes(), &head, &content].concat();
    assert!(refusal("a.pbf", &zstd).contains("packed by zstd"));
    assert!(refusal("a.pbf", b"\x1a\x00hello").contains("whatever its name says"));
    let mut far = Block::default();
    far.node((1, 181.0, 0.0));
    let far = [header("DenseNodes"), blob("OSMData", &far.content(), false)].concat();
    assert!(refusal("a.pbf", &far).contains("off the globe"));
    let whole = town_file(false);
    let first = header("DenseNodes").len();
    for cut in (1..whole.len()).filter(|cut| *cut != first) {
        let _ = refusal("a.pbf", &whole[..cut]);
    }
}

#[test]
fn a_blob_that_unpacks_to_more_than_the_format_allows_is_refused() {
    let bomb = blob("OSMData", &vec![0; (1 << 25) + 1], true);
    assert!(
        refusal("a.pbf", &[header("DenseNodes"), bomb].concat())
            .contains("more bytes than the format allows")
    );
}

/// A file of one block.
fn read_block(block: &Block, columns: &[&str]) -> VectorFile {
    let bytes = [header("DenseNodes"), blob("OSMData", &block.content(), true)].concat();
    let (_folder, path) = file("a.osm.pbf", &bytes);
    read_columns(&path, None, &columns.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>()).unwrap()
}

/// Closed ways around squares with these corners and sides, way `k` over nodes `10 k` to `10 k + 3`; every second one runs with the clock.
fn squares(tagged: &[Tags<'_>], squares: &[(f64, f64, f64)]) -> Block {
    let mut block = Block::default();
    for (k, (x, y, side)) in squares.iter().enumerate() {
        let first = 10 * k as i64;
        let mut ids: Vec<i64> = (first..first + 4).chain([first]).collect();
        for (id, (dx, dy)) in ids.iter().zip([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]) {
            block.node((*id, x + dx * side, y + dy * side));
        }
        if k % 2 == 1 {
            ids.reverse();
        }
        block.way(k as u64, tagged.get(k).copied().unwrap_or(&[]), &ids);
    }
    block
}

/// The first corner and the turn (1: against the clock) of the rings of each member.
fn members(shape: &Shape) -> Vec<Vec<(f64, f64, i8)>> {
    let told = |rings: &Vec<Vec<Plan>>| -> Vec<(f64, f64, i8)> {
        let ring = |ring: &Vec<Plan>| {
            let low = crate::space::PlanBox::around(ring.iter().copied()).min;
            (low.x, low.y, rings::signed_area(ring).signum() as i8)
        };
        rings.iter().map(ring).collect()
    };
    match shape {
        Shape::Polygon(rings) => vec![told(rings)],
        Shape::MultiPolygon(members) => members.iter().map(told).collect(),
        _ => panic!("no area"),
    }
}

const LAKE: Tags<'_> = &[("type", "multipolygon"), ("natural", "water")];

#[test]
fn rings_of_a_multipolygon_are_members_with_their_holes_and_turn_so() {
    // Two shores, an island in the first, a pond on it, and a second island that touches the first along a side.
    let places = [(0.0, 0.0, 8.0), (20.0, 0.0, 4.0), (1.0, 1.0, 4.0), (2.0, 2.0, 1.0), (5.0, 1.0, 2.0)];
    let roles = ["outer", "outer", "inner", "outer", "inner"];
    for is_told in [true, false] {
        let mut block = squares(&[], &places);
        let ways: Vec<(i64, &str)> =
            (0..5).rev().map(|k| (k, if is_told { roles[k as usize] } else { "" })).collect();
        block.relation(1, LAKE, &ways);
        let read = read_block(&block, &[]);
        let mut found = members(&read.features[0].shape);
        found.sort_by(|a, b| a[0].partial_cmp(&b[0]).unwrap());
        found.iter_mut().for_each(|rings| rings[1..].sort_by(|a, b| a.partial_cmp(b).unwrap()));
        let shore = vec![(0.0, 0.0, 1), (1.0, 1.0, -1), (5.0, 1.0, -1)];
        assert_eq!(found, [shore, vec![(2.0, 2.0, 1)], vec![(20.0, 0.0, 1)]], "{is_told}");
        assert_eq!(read.notes, [""; 0], "{is_told}");
    }
}

#[test]
fn roles_that_rings_contradict_are_not_followed_and_told() {
    let places = [(0.0, 0.0, 8.0), (1.0, 1.0, 4.0)];
    for roles in [["inner", "outer"], ["outer", "outer"], ["inner", "inner"]] {
        let mut block = squares(&[], &places);
        block.relation(7, LAKE, &[(0, roles[0]), (1, roles[1])]);
        let read = read_block(&block, &[]);
        assert_eq!(members(&read.features[0].shape), [[(0.0, 0.0, 1), (1.0, 1.0, -1)]]);
        assert_eq!(
            read.notes,
            [
                "1 area with roles that are not how the rings lie in one another: the rings are followed (relation 7)"
            ]
        );
    }
}

#[test]
fn a_way_that_is_listed_twice_bounds_its_area_once() {
    let mut block = squares(&[], &[(0.0, 0.0, 8.0)]);
    block.relation(7, LAKE, &[(0, "outer"), (0, "outer")]);
    assert_eq!(members(&read_block(&block, &[]).features[0].shape), [[(0.0, 0.0, 1)]]);
}

#[test]
fn areas_that_do_not_close_are_told_by_their_ids() {
    let mut block = town();
    for id in 30..35 {
        block.relation(id, LAKE, &[(10, "outer")]);
    }
    let notes = read_block(&block, &[]).notes;
    assert!(
        notes.contains(
            &"5 areas whose ways do not close to rings, left out (relations 30, 31, 32, ...)".to_owned()
        ),
        "{notes:?}"
    );
}

#[test]
fn a_relation_without_tags_has_those_of_its_outer_ways_which_are_nothing_themselves() {
    let wood: Tags<'_> = &[("landuse", "forest"), ("name", "old")];
    let pond: Tags<'_> = &[("natural", "water")];
    let places = [(0.0, 0.0, 8.0), (1.0, 1.0, 2.0), (4.0, 4.0, 2.0), (20.0, 0.0, 1.0)];
    let read_with = |tags: [Tags<'_>; 4], own: Tags<'_>| {
        let mut block = squares(&tags, &places);
        block.relation(9, own, &[(0, "outer"), (1, "inner"), (2, "inner"), (3, "outer")]);
        let read = read_block(&block, &["landuse", "name", "osm_id", "osm_type"]);
        let value = |name: &str, feature: &Feature| {
            let column = read.columns.iter().find(|column| column.name == name);
            column.map_or(Attribute::Null, |column| column.value(feature.index).clone())
        };
        let told = |f: &Feature| {
            (value("osm_id", f), value("landuse", f), value("name", f), members(&f.shape).len())
        };
        read.features.iter().map(told).collect::<Vec<_>>()
    };
    let (text, none) = (|text: &str| Attribute::Text(text.into()), Attribute::Null);
    let id = Attribute::Integer;
    let untold: Tags<'_> = &[("type", "multipolygon"), ("source", "survey")];
    // An inner way with the very tags is but a hole, one with others a feature of its own.
    let new = [&wood[..1], &wood[..1], pond, wood];
    assert_eq!(
        read_with(new, untold),
        [(id(2), none.clone(), none.clone(), 1), (id(9), text("forest"), none.clone(), 2)]
    );
    // Outer ways that share no area, or have none, stay what they are.
    assert_eq!(
        read_with([wood, &[], &[], pond], untold),
        [(id(0), text("forest"), text("old"), 1), (id(3), none.clone(), none.clone(), 1)]
    );
    // A relation with tags has its own, and its ways keep theirs.
    let named = read_with([wood, &[], &[], &[]], LAKE);
    assert_eq!(named, [(id(0), text("forest"), text("old"), 1), (id(9), none.clone(), none, 2)]);
}

#[test]
fn a_broken_relation_takes_no_tags_from_its_ways() {
    let mut block = squares(&[&[("landuse", "forest")]], &[(0.0, 0.0, 8.0)]);
    block.relation(9, &[("type", "multipolygon")], &[(0, "outer"), (99, "inner")]);
    let read = read_block(&block, &[]);
    assert_eq!((read.features.len(), read.notes.len()), (1, 1), "{:?}", read.notes);
}

#[test]
fn elements_have_their_id_and_type_as_columns_whatever_their_tags_say() {
    let mut block =
        squares(&[&[("building", "yes"), ("osm_id", "5"), ("osm_type", "x")]], &[(0.0, 0.0, 8.0)]);
    block.relation(0, LAKE, &[(0, "outer")]);
    let read = read_block(&block, &["osm_id", "osm_type"]);
    let values: Vec<&[Attribute]> = read.columns.iter().map(|column| &column.values[..]).collect();
    let kinds = ["way", "relation"].map(|kind| Attribute::Text(kind.into()));
    assert_eq!(values, [&[Attribute::Integer(0), Attribute::Integer(0)][..], &kinds[..]]);
}

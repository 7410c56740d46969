//! The elements of a block: nodes, ways and relations with their tags.

use super::blob::damaged;
use super::protobuf::{Fields, Value, differences, packed, signed};
use crate::error::{Error, Result};

/// A block of elements, taken apart as far as its groups.
pub(super) struct Block<'a> {
    strings: Vec<&'a [u8]>,
    groups: Vec<&'a [u8]>,
    /// Billionths of a degree that positions count in.
    granularity: i64,
    /// Latitude and longitude of position 0, in billionths of a degree.
    offsets: [i64; 2],
}

/// Tags in the order of the file.
pub(super) type Tags<'a> = Vec<(&'a str, &'a str)>;

/// A way.
pub(super) struct Way<'a> {
    pub(super) id: i64,
    pub(super) tags: Tags<'a>,
    pub(super) nodes: Vec<i64>,
}

/// A relation, of its members the ways: the id, and the role.
pub(super) struct Relation<'a> {
    pub(super) id: i64,
    pub(super) tags: Tags<'a>,
    pub(super) ways: Vec<(i64, &'a [u8])>,
}

/// Longitude and latitude in ten-millionths of a degree, as OpenStreetMap keeps them.
pub(super) type Position = [i32; 2];

fn cut() -> Error {
    damaged("an element is cut")
}

impl<'a> Block<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Result<Self> {
        let mut block = Self { strings: Vec::new(), groups: Vec::new(), granularity: 100, offsets: [0; 2] };
        for field in Fields::of(bytes) {
            match field.ok_or_else(cut)? {
                (1, Value::Bytes(table)) => {
                    for string in Fields::of(table) {
                        block.strings.extend(string.ok_or_else(cut)?.1.bytes());
                    }
                }
                (2, Value::Bytes(group)) => block.groups.push(group),
                (17, Value::Number(number)) => block.granularity = number.cast_signed(),
                (19, Value::Number(number)) => block.offsets[0] = number.cast_signed(),
                (20, Value::Number(number)) => block.offsets[1] = number.cast_signed(),
                _ => {}
            }
        }
        Ok(block)
    }

    /// Calls with the bytes of each element of the kind with this number.
    fn each(&self, kind: u64, mut take: impl FnMut(&'a [u8]) -> Result<()>) -> Result<()> {
        for group in &self.groups {
            for field in Fields::of(group) {
                match field.ok_or_else(cut)? {
                    (number, Value::Bytes(element)) if number == kind => take(element)?,
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// Whether it has nodes, and whether it has ways.
    pub(super) fn kinds(&self) -> (bool, bool) {
        let has = |kinds: &[u64]| {
            let mut fields = self.groups.iter().flat_map(|group| Fields::of(group).flatten());
            fields.any(|(number, _)| kinds.contains(&number))
        };
        (has(&[1, 2]), has(&[3]))
    }

    /// Calls with each node: its id, its place, and whether it has tags.
    pub(super) fn nodes(&self, take: &mut impl FnMut(i64, Position, bool)) -> Result<()> {
        self.each(1, |node| self.plain_node(node, take))?;
        self.each(2, |nodes| self.dense_nodes(nodes, take))
    }

    fn plain_node(&self, node: &[u8], take: &mut impl FnMut(i64, Position, bool)) -> Result<()> {
        let (mut id, mut place, mut is_tagged) = (0, [0; 2], false);
        for field in Fields::of(node) {
            match field.ok_or_else(cut)? {
                (1, Value::Number(number)) => id = signed(number),
                (2, Value::Bytes(keys)) => is_tagged = !keys.is_empty(),
                (8, Value::Number(number)) => place[0] = signed(number),
                (9, Value::Number(number)) => place[1] = signed(number),
                _ => {}
            }
        }
        take(id, self.position(place)?, is_tagged);
        Ok(())
    }

    fn dense_nodes(&self, nodes: &[u8], take: &mut impl FnMut(i64, Position, bool)) -> Result<()> {
        let [mut ids, mut latitudes, mut longitudes, mut tags] = [&[][..]; 4];
        for field in Fields::of(nodes) {
            match field.ok_or_else(cut)? {
                (1, Value::Bytes(bytes)) => ids = bytes,
                (8, Value::Bytes(bytes)) => latitudes = bytes,
                (9, Value::Bytes(bytes)) => longitudes = bytes,
                (10, Value::Bytes(bytes)) => tags = bytes,
                _ => {}
            }
        }
        // Key, value, key, value, ..., 0 for each node; nothing at all where no node has any.
        let mut tags = packed(tags);
        let (mut latitudes, mut longitudes) = (differences(latitudes), differences(longitudes));
        for id in differences(ids) {
            let place = latitudes.next().flatten().zip(longitudes.next().flatten());
            let (latitude, longitude) = place.ok_or_else(cut)?;
            let count = tags.by_ref().take_while(|word| !matches!(word, Some(0))).count();
            take(id.ok_or_else(cut)?, self.position([latitude, longitude])?, count > 0);
        }
        Ok(())
    }

    fn position(&self, [latitude, longitude]: [i64; 2]) -> Result<Position> {
        let degrees = |number: i64, offset: i64, most: i64| {
            let billionths = number.checked_mul(self.granularity)?.checked_add(offset)?;
            let rounded = (billionths.checked_add(50)?).div_euclid(100);
            i32::try_from(rounded).ok().filter(|_| rounded.abs() <= most * 10_000_000)
        };
        let [from_equator, from_greenwich] = self.offsets;
        let place = degrees(longitude, from_greenwich, 180).zip(degrees(latitude, from_equator, 90));
        place.map(|(x, y)| [x, y]).ok_or_else(|| damaged("a node lies off the globe"))
    }

    /// Calls with each way.
    pub(super) fn ways(&self, mut take: impl FnMut(Way<'a>) -> Result<()>) -> Result<()> {
        self.each(3, |element| {
            let (mut id, mut keys, mut values, mut nodes) = (0, &[][..], &[][..], Vec::new());
            for field in Fields::of(element) {
                match field.ok_or_else(cut)? {
                    (1, Value::Number(number)) => id = number.cast_signed(),
                    (2, Value::Bytes(bytes)) => keys = bytes,
                    (3, Value::Bytes(bytes)) => values = bytes,
                    (8, Value::Bytes(bytes)) => {
                        nodes = differences(bytes).collect::<Option<_>>().ok_or_else(cut)?;
                    }
                    _ => {}
                }
            }
            take(Way { id, tags: self.tags(keys, values)?, nodes })
        })
    }

    /// Calls with each relation.
    pub(super) fn relations(&self, mut take: impl FnMut(Relation<'a>) -> Result<()>) -> Result<()> {
        self.each(4, |element| {
            let [mut keys, mut values, mut roles, mut ids, mut kinds] = [&[][..]; 5];
            let mut id = 0;
            for field in Fields::of(element) {
                match field.ok_or_else(cut)? {
                    (1, Value::Number(number)) => id = number.cast_signed(),
                    (2, Value::Bytes(bytes)) => keys = bytes,
                    (3, Value::Bytes(bytes)) => values = bytes,
                    (8, Value::Bytes(bytes)) => roles = bytes,
                    (9, Value::Bytes(bytes)) => ids = bytes,
                    (10, Value::Bytes(bytes)) => kinds = bytes,
                    _ => {}
                }
            }
            let mut ways = Vec::new();
            let (mut roles, mut kinds) = (packed(roles), packed(kinds));
            for member in differences(ids) {
                let told = roles.next().flatten().zip(kinds.next().flatten());
                let ((role, kind), member) = told.zip(member).ok_or_else(cut)?;
                if kind == WAY {
                    ways.push((member, self.string(role)?));
                }
            }
            take(Relation { id, tags: self.tags(keys, values)?, ways })
        })
    }

    fn string(&self, number: u64) -> Result<&'a [u8]> {
        let string = usize::try_from(number).ok().and_then(|number| self.strings.get(number));
        string.copied().ok_or_else(|| damaged("an element names a text that there is not"))
    }

    fn tags(&self, keys: &[u8], values: &[u8]) -> Result<Tags<'a>> {
        let text = |number: Option<u64>| {
            let bytes = self.string(number.ok_or_else(cut)?)?;
            std::str::from_utf8(bytes).map_err(|_| damaged("a tag is not UTF-8"))
        };
        packed(keys).zip(packed(values)).map(|(key, value)| Ok((text(key)?, text(value)?))).collect()
    }
}

/// The kind of a member that is a way.
const WAY: u64 = 1;

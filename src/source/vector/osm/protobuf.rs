//! Fields of protocol buffers, never past the end of the bytes: the encoding that OpenStreetMap's files are in.

/// What a field holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Value<'a> {
    Number(u64),
    Bytes(&'a [u8]),
    /// Numbers of 4 and 8 bytes, which none of the fields that are read is.
    Fixed,
}

impl<'a> Value<'a> {
    pub(super) fn bytes(self) -> Option<&'a [u8]> {
        if let Self::Bytes(bytes) = self { Some(bytes) } else { None }
    }

    pub(super) fn number(self) -> Option<u64> {
        if let Self::Number(number) = self { Some(number) } else { None }
    }
}

/// The fields of a message, one after the other; `None` in place of one that is cut or not known.
pub(super) struct Fields<'a> {
    rest: &'a [u8],
}

impl<'a> Fields<'a> {
    pub(super) fn of(message: &'a [u8]) -> Self {
        Self { rest: message }
    }

    fn field(&mut self) -> Option<(u64, Value<'a>)> {
        let key = varint(&mut self.rest)?;
        let value = match key & 7 {
            0 => Value::Number(varint(&mut self.rest)?),
            1 => self.take(8).map(|_| Value::Fixed)?,
            2 => {
                let length = usize::try_from(varint(&mut self.rest)?).ok()?;
                Value::Bytes(self.take(length)?)
            }
            5 => self.take(4).map(|_| Value::Fixed)?,
            _ => return None,
        };
        Some((key >> 3, value))
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(taken)
    }
}

impl<'a> Iterator for Fields<'a> {
    type Item = Option<(u64, Value<'a>)>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let field = self.field();
        if field.is_none() {
            self.rest = &[];
        }
        Some(field)
    }
}

/// A number of 7 bits a byte, the least significant first.
fn varint(rest: &mut &[u8]) -> Option<u64> {
    let mut number = 0;
    for (at, byte) in rest.iter().take(10).enumerate() {
        number |= u64::from(byte & 0x7f) << (7 * at);
        if byte & 0x80 == 0 {
            *rest = &rest[at + 1..];
            return Some(number);
        }
    }
    None
}

/// Numbers one after the other; `None` in place of one that is cut.
pub(super) fn packed(mut bytes: &[u8]) -> impl Iterator<Item = Option<u64>> {
    std::iter::from_fn(move || {
        if bytes.is_empty() {
            return None;
        }
        let number = varint(&mut bytes);
        if number.is_none() {
            bytes = &[];
        }
        Some(number)
    })
}

/// Signed numbers, each but the first told by its difference from the one before.
pub(super) fn differences(bytes: &[u8]) -> impl Iterator<Item = Option<i64>> {
    let mut sum = 0_i64;
    packed(bytes).map(move |number| {
        sum = sum.wrapping_add(signed(number?));
        Some(sum)
    })
}

/// The signed number that is stored with its sign in the lowest bit.
pub(super) fn signed(number: u64) -> i64 {
    (number >> 1).cast_signed() ^ -(number & 1).cast_signed()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_seven_bits_a_byte_and_signs_in_the_lowest_one() {
        assert_eq!(packed(&[0x96, 0x01, 0x05]).collect::<Vec<_>>(), [Some(150), Some(5)]);
        assert_eq!([0, 1, 2, 3, u64::MAX].map(signed), [0, -1, 1, -2, i64::MIN]);
        assert_eq!(differences(&[4, 1, 6]).collect::<Vec<_>>(), [Some(2), Some(1), Some(4)]);
        assert_eq!(packed(&[0x80]).collect::<Vec<_>>(), [None]);
        assert_eq!(packed(&[0xff; 11]).next(), Some(None), "no number is that long");
    }

    #[test]
    fn a_field_that_is_cut_is_none_and_the_last() {
        let whole = [0x08, 0x01, 0x12, 0x02, b'a', b'b', 0x1d, 0, 0, 0, 0];
        let fields: Vec<_> = Fields::of(&whole).collect();
        let expected = [(1, Value::Number(1)), (2, Value::Bytes(b"ab")), (3, Value::Fixed)].map(Some);
        assert_eq!(fields, expected);
        for cut in [1, 3, 5, 9] {
            assert_eq!(Fields::of(&whole[..cut]).last(), Some(None), "{cut}");
        }
    }
}

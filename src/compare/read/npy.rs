//! .npy arrays (NumPy's `numpy.lib.format`, versions 1 to 3): little-endian f64, f32, u32, u16 and u8 in C order; pictures of
//! (rows, columns) or (rows, columns, channels), and tables.

use super::size::check_size;
use crate::compare::image::{Image, Samples};
use crate::error::{Error, Result};

pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

/// An array as its file holds it.
#[derive(Debug)]
pub(in crate::compare) struct Array<'a> {
    /// Its sides, as the file writes them.
    shape: &'a str,
    /// The kind of its numbers.
    kind: &'a str,
    data: &'a [u8],
}

pub(super) fn decode(bytes: &[u8]) -> Result<Image> {
    let array = Array::of(bytes)?;
    let [height, width, channels] = array.picture_shape()?;
    let samples = match array.kind {
        "<u2" => Samples::Codes16(numbers(array.data, u16::from_le_bytes)?),
        "|u1" => Samples::Codes8(array.data.to_vec()),
        _ => Samples::Reals(array.values()?),
    };
    Image::of(width, height, channels, samples)
}

impl<'a> Array<'a> {
    /// The array in a file's bytes. Its numbers are looked at later.
    pub(in crate::compare) fn of(bytes: &'a [u8]) -> Result<Self> {
        let opened = bytes.strip_prefix(MAGIC).ok_or_else(|| broken("it is none"))?;
        let (head, data) = split(opened).ok_or_else(|| broken("it ends before its values"))?;
        let head = std::str::from_utf8(head).map_err(|_| broken("its header is no text"))?;
        if entry(head, "fortran_order")?.trim() != "False" {
            return Err(Error::unsupported("this .npy array is in Fortran order")
                .help("save numpy.ascontiguousarray(a)"));
        }
        let kind = entry(head, "descr")?.trim().trim_matches(['\'', '"']);
        Ok(Self { shape: entry(head, "shape")?.trim(), kind, data })
    }

    /// Rows, columns and channels of a picture.
    fn picture_shape(&self) -> Result<[usize; 3]> {
        let [height, width, channels] = match self.sides().as_deref() {
            Some([height, width]) => [*height, *width, 1],
            Some([height, width, channels]) => [*height, *width, *channels],
            _ => {
                let what = format!("this .npy array of the shape {} is no picture", self.shape);
                return Err(
                    Error::unsupported(what).help("(rows, columns) and (rows, columns, channels) are")
                );
            }
        };
        check_size(width, height, channels)?;
        Ok([height, width, channels])
    }

    fn sides(&self) -> Option<Vec<usize>> {
        let inside = self.shape.trim_start_matches('(').trim_end_matches(')');
        let sides = inside.split(',').map(str::trim).filter(|side| !side.is_empty());
        sides.map(|side| side.parse().ok()).collect()
    }

    /// A buffer's numbers as they are, codes undivided.
    pub(in crate::compare) fn plane(&self) -> Result<Image> {
        let [height, width, channels] = self.picture_shape()?;
        Image::new(width, height, channels, self.values()?)
    }

    /// The rows of a table of so many columns, of whole numbers; it may have none.
    pub(in crate::compare) fn whole_rows<const N: usize>(&self) -> Result<Vec<[u32; N]>> {
        if self.kind != "<u4" {
            return Err(broken(&format!("its values are of the kind `{}` and not `<u4`", self.kind)));
        }
        self.rows(&numbers(self.data, u32::from_le_bytes)?)
    }

    /// The rows of a table of so many columns; it may have none.
    pub(in crate::compare) fn real_rows<const N: usize>(&self) -> Result<Vec<[f64; N]>> {
        self.rows(&self.values()?)
    }

    fn rows<T: Copy, const N: usize>(&self, values: &[T]) -> Result<Vec<[T; N]>> {
        let (rows, rest) = values.as_chunks::<N>();
        if self.sides() != Some(vec![rows.len(), N]) || !rest.is_empty() {
            let (shape, n) = (self.shape, values.len());
            return Err(broken(&format!("{n} values of the shape {shape} are no table of {N} columns")));
        }
        Ok(rows.to_vec())
    }

    /// Its numbers as they are.
    fn values(&self) -> Result<Vec<f64>> {
        match self.kind {
            "<f8" => numbers(self.data, f64::from_le_bytes),
            "<f4" => numbers(self.data, |b| f64::from(f32::from_le_bytes(b))),
            "<u4" => numbers(self.data, |b| f64::from(u32::from_le_bytes(b))),
            "<u2" => numbers(self.data, |b| f64::from(u16::from_le_bytes(b))),
            "|u1" => numbers(self.data, |[b]| f64::from(b)),
            kind => Err(Error::unsupported(format!("this .npy array holds values of the kind `{kind}`"))
                .help("<f8, <f4, <u4, <u2 and |u1 can be compared: a.astype(numpy.float64)")),
        }
    }
}

fn broken(why: &str) -> Error {
    Error::new(format!("this .npy file cannot be read: {why}"))
}

/// The header and the values of what follows the magic.
fn split(opened: &[u8]) -> Option<(&[u8], &[u8])> {
    let (version, rest) = opened.split_at_checked(2)?;
    let (length, rest) = if version[0] == 1 {
        let (length, rest) = rest.split_first_chunk::<2>()?;
        (usize::from(u16::from_le_bytes(*length)), rest)
    } else {
        let (length, rest) = rest.split_first_chunk::<4>()?;
        (u32::from_le_bytes(*length) as usize, rest)
    };
    rest.split_at_checked(length)
}

/// What the header, a dictionary as Python writes it, holds under a key.
fn entry<'a>(head: &'a str, key: &str) -> Result<&'a str> {
    let missing = || broken(&format!("its header has no `{key}`"));
    let start = head.find(&format!("'{key}'")).ok_or_else(missing)? + key.len() + 2;
    let rest = head[start..].trim_start().strip_prefix(':').ok_or_else(missing)?;
    let end = match rest.trim_start().starts_with('(') {
        true => rest.find(')').map(|at| at + 1),
        false => rest.find([',', '}']),
    };
    end.map(|end| &rest[..end]).ok_or_else(missing)
}

fn numbers<T, const N: usize>(data: &[u8], number: impl Fn([u8; N]) -> T) -> Result<Vec<T>> {
    let (values, rest) = data.as_chunks::<N>();
    if !rest.is_empty() {
        return Err(broken("its last value is cut off"));
    }
    Ok(values.iter().map(|bytes| number(*bytes)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(head: &str, data: &[u8]) -> Vec<u8> {
        let mut file = b"\x93NUMPY\x01\x00".to_vec();
        file.extend((head.len() as u16).to_le_bytes());
        file.extend(head.bytes());
        file.extend(data);
        file
    }

    fn head(kind: &str, shape: &str) -> String {
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}   \n")
    }

    fn decoded(kind: &str, data: &[u8]) -> Vec<f64> {
        let image = decode(&file(&head(kind, "(1, 2)"), data)).unwrap();
        assert_eq!((image.width(), image.height(), image.channels()), (2, 1, 1));
        image.values().collect()
    }

    #[test]
    fn every_kind_of_number_is_read() {
        let bytes = |v: [f64; 2]| v.map(f64::to_le_bytes).concat();
        assert_eq!(decoded("<f8", &bytes([0.1, f64::INFINITY])), [0.1, f64::INFINITY]);
        assert_eq!(decoded("<f4", &[0.5_f32, -1.0].map(f32::to_le_bytes).concat()), [0.5, -1.0]);
        assert_eq!(decoded("<u4", &[1_u32, u32::MAX].map(u32::to_le_bytes).concat()), [1.0, 4_294_967_295.0]);
        assert_eq!(decoded("<u2", &[13107_u16, 65535].map(u16::to_le_bytes).concat()), [0.2, 1.0]);
        assert_eq!(decoded("|u1", &[51, 255]), [0.2, 1.0]);
    }

    #[test]
    fn channels_and_the_second_version_are_read() {
        let text = "{'shape':(1,1,3),'descr':'|u1','fortran_order':False}";
        let mut file = b"\x93NUMPY\x02\x00".to_vec();
        file.extend((text.len() as u32).to_le_bytes());
        file.extend(text.bytes().chain([0, 51, 255]));
        let image = decode(&file).unwrap();
        assert_eq!((image.channels(), &image.reals(3)[..]), (3, &[0.0, 0.2, 1.0][..]));
    }

    #[test]
    fn a_table_has_as_many_columns_as_one_reads_and_may_have_no_rows() {
        let table = |shape: &str, data: &[u32]| {
            let bytes: Vec<u8> = data.iter().flat_map(|value| value.to_le_bytes()).collect();
            let file = file(&head("<u4", shape), &bytes);
            Array::of(&file)
                .and_then(|array| array.whole_rows::<2>())
                .map_err(|error| error.what().to_owned())
        };
        assert_eq!(table("(2, 2)", &[1, 2, 3, 4]), Ok(vec![[1, 2], [3, 4]]));
        assert_eq!(table("(0, 2)", &[]), Ok(vec![]));
        for (shape, data) in
            [("(2, 2)", &[1, 2][..]), ("(1, 2)", &[1, 2, 3]), ("(1, 4)", &[1, 2, 3, 4]), ("(2,)", &[1, 2])]
        {
            assert!(table(shape, data).unwrap_err().contains("no table of 2 columns"), "{shape}");
        }
        let real = file(&head("<f8", "(1, 2)"), &[0; 16]);
        assert!(Array::of(&real).unwrap().whole_rows::<2>().unwrap_err().what().contains("not `<u4`"));
        assert_eq!(Array::of(&real).unwrap().real_rows::<2>().unwrap(), [[0.0, 0.0]]);
    }

    #[test]
    fn a_buffers_codes_are_no_fractions() {
        let file = file(&head("|u1", "(1, 2)"), &[7, 255]);
        assert_eq!(Array::of(&file).unwrap().plane().unwrap().reals(1)[..], [7.0, 255.0]);
    }

    #[test]
    fn what_is_no_picture_is_refused_with_a_hint() {
        let refused = |file: &[u8]| decode(file).unwrap_err().to_string();
        let fortran = head("|u1", "(1, 1)").replace("False", "True");
        assert!(refused(&file(&fortran, &[0])).contains("ascontiguousarray"));
        assert!(refused(&file(&head("<i8", "(1, 1)"), &[0; 8])).contains("the kind `<i8`"));
        assert!(refused(&file(&head("|u1", "(4,)"), &[0; 4])).contains("shape (4,) is no picture"));
        assert!(refused(&file(&head("|u1", "(0, 4)"), &[])).contains("nothing to compare"));
        assert!(refused(&file(&head("|u1", "(2, 2)"), &[0; 3])).contains("cannot have 3 values"));
        assert!(refused(&file(&head("<u2", "(1, 1)"), &[0; 3])).contains("cut off"));
        let huge = "(9223372036854775807, 9223372036854775807)";
        assert!(refused(&file(&head("|u1", huge), &[])).contains("too large"));
        assert!(refused(b"\x93NUMPY\x01\x00\xff\xff{").contains("ends before its values"));
        assert!(refused(&file("{}", &[])).contains("no `fortran_order`"));
    }
}

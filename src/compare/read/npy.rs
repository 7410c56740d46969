//! .npy arrays (NumPy's `numpy.lib.format`, versions 1 to 3): little-endian f64, f32, u32, u16 and u8 in C order, of
//! (rows, columns) or (rows, columns, channels).

use super::size::check_size;
use crate::compare::image::Image;
use crate::error::{Error, Result};

pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

pub(super) fn decode(bytes: &[u8]) -> Result<Image> {
    let (head, data) = split(bytes).ok_or_else(|| broken("it ends before its values"))?;
    let head = std::str::from_utf8(head).map_err(|_| broken("its header is no text"))?;
    if entry(head, "fortran_order")?.trim() != "False" {
        return Err(
            Error::unsupported("this .npy array is in Fortran order").help("save numpy.ascontiguousarray(a)")
        );
    }
    let [height, width, channels] = shape(entry(head, "shape")?)?;
    check_size(width, height, channels)?;
    let values = values(entry(head, "descr")?.trim().trim_matches(['\'', '"']), data)?;
    Image::new(width, height, channels, values)
}

fn broken(why: &str) -> Error {
    Error::new(format!("this .npy file cannot be read: {why}"))
}

/// The header and the values.
fn split(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (version, rest) = bytes.get(MAGIC.len()..)?.split_at_checked(2)?;
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

/// Rows, columns, channels.
fn shape(text: &str) -> Result<[usize; 3]> {
    let inside = text.trim().trim_start_matches('(').trim_end_matches(')');
    let sides = inside.split(',').map(str::trim).filter(|side| !side.is_empty());
    let sides: std::result::Result<Vec<usize>, _> = sides.map(str::parse).collect();
    match sides.as_deref() {
        Ok([height, width]) => Ok([*height, *width, 1]),
        Ok([height, width, channels]) => Ok([*height, *width, *channels]),
        _ => Err(Error::unsupported(format!("this .npy array of the shape {} is no picture", text.trim()))
            .help("(rows, columns) and (rows, columns, channels) are")),
    }
}

fn values(kind: &str, data: &[u8]) -> Result<Vec<f64>> {
    match kind {
        "<f8" => numbers(data, f64::from_le_bytes),
        "<f4" => numbers(data, |b| f64::from(f32::from_le_bytes(b))),
        "<u4" => numbers(data, |b| f64::from(u32::from_le_bytes(b))),
        "<u2" => numbers(data, |b| f64::from(u16::from_le_bytes(b)) / 65535.0),
        "|u1" => numbers(data, |[b]| f64::from(b) / 255.0),
        _ => Err(Error::unsupported(format!("this .npy array holds values of the kind `{kind}`"))
            .help("<f8, <f4, <u4, <u2 and |u1 can be compared: a.astype(numpy.float64)")),
    }
}

fn numbers<const N: usize>(data: &[u8], number: impl Fn([u8; N]) -> f64) -> Result<Vec<f64>> {
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
        image.values().to_vec()
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
        assert_eq!((image.channels(), image.values()), (3, &[0.0, 0.2, 1.0][..]));
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

//! Files that are written: PNG without compression, and NumPy's arrays.

use std::path::Path;

fn save(path: &Path, bytes: &[u8]) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
}

/// Eight bits of red, green, blue and alpha, rows from the top.
pub fn png(path: &Path, width: usize, pixels: &[u8]) -> Result<(), String> {
    let table: Vec<u32> = (0..256u32)
        .map(|n| (0..8).fold(n, |c, _| if c & 1 == 1 { 0xEDB8_8320 ^ (c >> 1) } else { c >> 1 }))
        .collect();
    let crc = |bytes: &[u8]| {
        !bytes.iter().fold(!0u32, |c, b| table[((c ^ u32::from(*b)) & 255) as usize] ^ (c >> 8))
    };
    let mut out = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |kind: &[u8; 4], body: &[u8]| {
        out.extend((body.len() as u32).to_be_bytes());
        let all = [kind, body].concat();
        out.extend(&all);
        out.extend(crc(&all).to_be_bytes());
    };
    let raw: Vec<u8> =
        pixels.chunks(width * 4).flat_map(|row| std::iter::once(0).chain(row.iter().copied())).collect();
    let mut body = vec![0x78, 1];
    let parts = raw.chunks(65535);
    let last = parts.len() - 1;
    for (k, part) in parts.enumerate() {
        let size = part.len() as u16;
        body.push(u8::from(k == last));
        body.extend(size.to_le_bytes());
        body.extend((!size).to_le_bytes());
        body.extend(part);
    }
    let (a, b) = raw
        .iter()
        .fold((1u32, 0u32), |(a, b), v| ((a + u32::from(*v)) % 65521, (a + u32::from(*v) + b) % 65521));
    body.extend((b << 16 | a).to_be_bytes());
    let size = [(width as u32).to_be_bytes(), ((pixels.len() / width / 4) as u32).to_be_bytes()].concat();
    chunk(b"IHDR", &[&size[..], &[8, 6, 0, 0, 0]].concat());
    chunk(b"IDAT", &body);
    chunk(b"IEND", &[]);
    save(path, &out)
}

/// A table of `kind` (`<f8`, `<u4`); `shape` as Python writes it.
pub fn npy(path: &Path, kind: &str, shape: &str, body: &[u8]) -> Result<(), String> {
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
    while (header.len() + 11) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let size = (header.len() as u16).to_le_bytes();
    save(path, &[b"\x93NUMPY\x01\x00", &size[..], header.as_bytes(), body].concat())
}

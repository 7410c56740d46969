//! Code pages: which characters the bytes of a dBASE table are.
//!
//! The tables themselves are those of `encoding_rs` (Windows, ISO 8859, Macintosh, East Asian) and `oem_cp` (DOS).

use encoding_rs::Encoding;
use oem_cp::code_table::DECODING_TABLE_CP_MAP;
use oem_cp::code_table_type::TableType;

/// How bytes become text.
#[derive(Debug, Clone, Copy)]
pub(super) enum CodePage {
    Utf8,
    /// One of those that the web knows.
    Web(&'static Encoding),
    /// One of DOS.
    Dos(&'static TableType),
}

impl CodePage {
    /// The code page that a .cpg file names: `UTF-8`, `ISO-8859-1`, `1252`, `ANSI 1252`, `OEM 850`, `LDID/87`, ...
    pub(super) fn named(name: &str) -> Option<Self> {
        let name = name.trim();
        if let Some(driver) = name.strip_prefix("LDID/") {
            return Self::of_driver(driver.parse().ok()?);
        }
        if let Some(encoding) = Encoding::for_label(name.as_bytes()) {
            return Self::of_encoding(encoding);
        }
        let digits: String = name.chars().filter(char::is_ascii_digit).collect();
        Self::numbered(digits.parse().ok()?)
    }

    /// Western Windows, which most tables that say nothing are in.
    pub(super) fn western() -> Self {
        Self::Web(encoding_rs::WINDOWS_1252)
    }

    fn of_encoding(encoding: &'static Encoding) -> Option<Self> {
        if encoding == encoding_rs::UTF_8 {
            return Some(Self::Utf8);
        }
        encoding.is_ascii_compatible().then_some(Self::Web(encoding))
    }

    fn numbered(number: u32) -> Option<Self> {
        let label = match number {
            65001 => "utf-8".to_owned(),
            1250..=1258 => format!("windows-{number}"),
            874 => "windows-874".to_owned(),
            932 => "shift_jis".to_owned(),
            936 => "gbk".to_owned(),
            949 => "euc-kr".to_owned(),
            950 => "big5".to_owned(),
            54936 => "gb18030".to_owned(),
            20866 => "koi8-r".to_owned(),
            21866 => "koi8-u".to_owned(),
            10000 => "macintosh".to_owned(),
            10007 => "x-mac-cyrillic".to_owned(),
            28591..=28606 => format!("iso-8859-{}", number - 28590),
            88591..=88599 => format!("iso-8859-{}", number - 88590),
            885_910..=885_916 => format!("iso-8859-{}", number - 885_900),
            _ => return DECODING_TABLE_CP_MAP.get(&u16::try_from(number).ok()?).map(Self::Dos),
        };
        Encoding::for_label(label.as_bytes()).and_then(Self::of_encoding)
    }

    /// The code page of a table's language driver (byte 29 of its header); 0 says nothing.
    pub(super) fn of_driver(driver: u8) -> Option<Self> {
        Self::numbered(match driver {
            0x01 | 0x09 | 0x0b | 0x0d | 0x0f | 0x11 | 0x15 | 0x18 | 0x19 | 0x1b => 437,
            0x02 | 0x0a | 0x0e | 0x10 | 0x12 | 0x14 | 0x16 | 0x1a | 0x1d | 0x25 | 0x37 => 850,
            0x03 | 0x57..=0x59 => 1252,
            0x04 => 10000,
            0x08 | 0x17 | 0x66 => 865,
            0x13 | 0x7b => 932,
            0x1c | 0x6c => 863,
            0x1f | 0x22 | 0x23 | 0x40 | 0x64 | 0x87 => 852,
            0x24 => 860,
            0x26 | 0x65 => 866,
            0x4d | 0x7a => 936,
            0x4e | 0x79 => 949,
            0x4f | 0x78 => 950,
            0x50 | 0x7c => 874,
            0x67 => 861,
            0x6a | 0x86 => 737,
            0x6b | 0x88 => 857,
            0x7d => 1255,
            0x7e => 1256,
            0x96 => 10007,
            0xc8 => 1250,
            0xc9 => 1251,
            0xca => 1254,
            0xcb => 1253,
            0xcc => 1257,
            _ => return None,
        })
    }

    /// The text of some bytes; `None` where they are none. A character that the end of the bytes cuts is left out: fields
    /// are so many bytes long, whatever stands in them.
    pub(super) fn decode(self, bytes: &[u8]) -> Option<String> {
        match self {
            Self::Utf8 => match std::str::from_utf8(bytes) {
                Ok(text) => Some(text.to_owned()),
                Err(e) if e.error_len().is_none() => Self::Utf8.decode(&bytes[..e.valid_up_to()]),
                Err(_) => None,
            },
            Self::Web(encoding) => {
                let whole = |bytes| encoding.decode_without_bom_handling_and_without_replacement(bytes);
                let cut = bytes.split_last().filter(|_| !encoding.is_single_byte());
                whole(bytes).or_else(|| whole(cut?.1)).map(Into::into)
            }
            Self::Dos(table) => table.decode_string_checked(bytes),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(page: Option<CodePage>, bytes: &[u8]) -> Option<String> {
        page.unwrap().decode(bytes)
    }

    #[test]
    fn a_cpg_is_understood_in_its_spellings() {
        for name in
            ["ISO-8859-1", "8859-1", "88591", "1252", "ANSI 1252", "cp1252", " windows-1252\r\n", "LDID/87"]
        {
            assert_eq!(decoded(CodePage::named(name), b"\xd6tztal").as_deref(), Some("Ötztal"), "{name}");
        }
        for name in ["UTF-8", "utf8", "65001"] {
            assert_eq!(decoded(CodePage::named(name), "Ötztal".as_bytes()).as_deref(), Some("Ötztal"));
        }
        for name in ["OEM 850", "850", "CP850", "LDID/2"] {
            assert_eq!(decoded(CodePage::named(name), b"\x99tztal").as_deref(), Some("Ötztal"), "{name}");
        }
        for name in ["", "klingon", "UTF-16", "LDID/0", "LDID/300", "99999999999999"] {
            assert!(CodePage::named(name).is_none(), "{name}");
        }
    }

    #[test]
    fn language_drivers_are_code_pages() {
        for (driver, bytes, text) in [
            (0x57, &b"\xe9"[..], "é"),
            (0x01, b"\x82", "é"),
            (0xc9, b"\xcc\xee\xf1\xea\xe2\xe0", "Москва"),
            (0x26, b"\x8c\xae\xe1\xaa\xa2\xa0", "Москва"),
            (0x7b, b"\x93\x8c\x8b\x9e", "東京"),
            (0x4d, b"\xb1\xb1\xbe\xa9", "北京"),
        ] {
            assert_eq!(decoded(CodePage::of_driver(driver), bytes).as_deref(), Some(text), "{driver:#x}");
        }
        assert!(CodePage::of_driver(0).is_none());
    }

    #[test]
    fn a_character_that_the_end_cuts_is_left_out_and_a_wrong_one_refused() {
        let utf8 = CodePage::named("UTF-8");
        assert_eq!(decoded(utf8, &"aö".as_bytes()[..2]).as_deref(), Some("a"));
        assert_eq!(decoded(utf8, b"a\xffb"), None);
        assert_eq!(decoded(CodePage::of_driver(0x7b), b"\x93\x8c\x8b").as_deref(), Some("東"));
    }
}

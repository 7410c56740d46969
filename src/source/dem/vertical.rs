//! In which unit heights are, and whether they count upwards: by codes of the EPSG register, well-known text, or a word.
//!
//! Codes after the EPSG register 12.013 (vertical CRSs whose axis is not in metres upwards); what is not listed is in metres.

use std::ops::Range;

/// What one step of stored heights is.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::source) enum VerticalUnit {
    /// So many metres, below 0 for depths; in words.
    Metres(f64, String),
    /// A word that names no length known here.
    Unknown(String),
    /// A vertical CRS that is described by its name alone.
    Unsaid(String),
    /// So many metres, and a zero that lies elsewhere than the CRS's own, which is told and not applied; in words.
    Shifted(f64, String),
}

/// Metres of an international and of a US survey foot.
const FOOT: f64 = 0.3048;
const SURVEY_FOOT: f64 = 1200.0 / 3937.0;

impl VerticalUnit {
    /// The factor from stored heights to metres.
    pub(in crate::source) fn metres(&self) -> f64 {
        match self {
            Self::Metres(metres, _) | Self::Shifted(metres, _) => *metres,
            Self::Unknown(_) | Self::Unsaid(_) => 1.0,
        }
    }

    /// Whether heights in one unit may stand beside heights in the other as they are; what is not said is the metre.
    pub(super) fn agree(one: Option<&Self>, other: Option<&Self>) -> bool {
        let metre = Self::of_unit_code(9001);
        match (one.unwrap_or(&metre), other.unwrap_or(&metre)) {
            (Self::Metres(one, _), Self::Metres(other, _)) => one == other,
            (one, other) => one == other,
        }
    }

    /// The unit in words.
    pub(in crate::source) fn words(&self) -> &str {
        match self {
            Self::Metres(_, words) | Self::Unknown(words) | Self::Unsaid(words) | Self::Shifted(_, words) => {
                words
            }
        }
    }

    /// What a user should know of it.
    pub(in crate::source) fn note(&self) -> Option<String> {
        match self {
            Self::Metres(1.0, _) => None,
            Self::Metres(metres, words) if *metres < 0.0 => Some(format!(
                "the file counts depths, in {words}: they are turned to heights in metres (x {metres})"
            )),
            Self::Metres(metres, words) => {
                Some(format!("the file's heights are in {words}: they are converted to metres (x {metres})"))
            }
            Self::Unknown(word) => Some(format!(
                "the file's unit of heights, `{word}`, is no length known here: they are taken as metres (`vertical_scale` \
                 makes up for it)"
            )),
            Self::Shifted(metres, words) => Some(format!(
                "the file's heights are in {words}: they are converted to metres (x {metres}), and the shift is not applied \
                 (`terrain.offset` moves them)"
            )),
            Self::Unsaid(name) => Some(format!(
                "the file's vertical CRS, `{name}`, is described by its name alone, which does not say the unit of heights: they are \
                 taken as metres (`vertical_scale` makes up for it)"
            )),
        }
    }

    /// The unit of a code of the EPSG register.
    pub(super) fn of_unit_code(code: u16) -> Self {
        match code {
            9001 => Self::Metres(1.0, "metres".into()),
            9002 => Self::Metres(FOOT, "feet".into()),
            9003 => Self::Metres(SURVEY_FOOT, "US survey feet".into()),
            9014 => Self::Metres(1.8288, "fathoms".into()),
            9095 => Self::Metres(0.304_800_749_1, "British feet (1936)".into()),
            1025 => Self::Metres(0.001, "millimetres".into()),
            1033 => Self::Metres(0.01, "centimetres".into()),
            9036 => Self::Metres(1000.0, "kilometres".into()),
            other => Self::Unknown(format!("EPSG:{other}")),
        }
    }

    /// The unit of a vertical or compound CRS of the EPSG register; `None` where that is the metre, upwards.
    pub(super) fn of_crs_code(code: u32) -> Option<Self> {
        let feet = |by: f64| Some(Self::Metres(by * FOOT, "feet".into()));
        let survey_feet = |by: f64| Some(Self::Metres(by * SURVEY_FOOT, "US survey feet".into()));
        match code {
            6130..=6132 | 8050 | 8228 | 8700..=8711 | 9502..=9504 => feet(1.0),
            5614 | 8051 | 8897 => feet(-1.0),
            5702 | 6360 | 8052 | 7406 | 7407 | 8712..=8800 => survey_feet(1.0),
            6358 | 6359 | 8053 => survey_feet(-1.0),
            5754 => Some(Self::of_unit_code(9095)),
            5336
            | 5612
            | 5706
            | 5715
            | 5734
            | 5739
            | 5789
            | 5831
            | 5861..=5867
            | 5873
            | 6357
            | 7976
            | 8358
            | 8378
            | 9287..=9290
            | 9672
            | 9883
            | 10150
            | 10151
            | 10156
            | 10157
            | 10349
            | 10364
            | 10370..=10379
            | 10547..=10556
            | 10649..=10652
            | 10678
            | 10679 => Some(Self::Metres(-1.0, "metres".into())),
            _ => None,
        }
    }

    /// The unit that a word names, as GDAL's `UNITTYPE` has it; `None` for an empty word.
    pub(super) fn of_word(word: &str) -> Option<Self> {
        let word = word.trim();
        let lower = word.to_ascii_lowercase().replace(['_', '-'], " ");
        Some(match lower.as_str() {
            "" => return None,
            "m" | "metre" | "metres" | "meter" | "meters" | "metre(s)" | "meter(s)" => {
                Self::of_unit_code(9001)
            }
            "ft" | "foot" | "feet" | "international foot" | "international feet" | "ft (international)" => {
                Self::of_unit_code(9002)
            }
            "ftus" | "us ft" | "us survey foot" | "us survey feet" | "survey foot" | "survey feet"
            | "foot (us survey)" | "feet (us survey)" | "ft (us survey)" | "foot us" | "us foot"
            | "us feet" | "feet us" | "sft" | "usft" | "ft us" => Self::of_unit_code(9003),
            "cm" | "centimetre" | "centimetres" | "centimeter" | "centimeters" => Self::of_unit_code(1033),
            "mm" | "millimetre" | "millimetres" | "millimeter" | "millimeters" => Self::of_unit_code(1025),
            "dm" | "decimetre" | "decimetres" | "decimeter" | "decimeters" => {
                Self::Metres(0.1, "decimetres".into())
            }
            "km" | "kilometre" | "kilometres" | "kilometer" | "kilometers" => Self::of_unit_code(9036),
            "fathom" | "fathoms" => Self::of_unit_code(9014),
            _ => Self::Unknown(word.to_owned()),
        })
    }

    /// The unit of the vertical part of a CRS as people write it (`EPSG:2263+6360`, a compound code, well-known text); `None` where
    /// there is none.
    pub(in crate::source) fn of_crs_text(text: &str) -> Option<Self> {
        let text = text.trim();
        let codes =
            text.get(5..).filter(|_| text.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("EPSG:")));
        let Some(codes) = codes else {
            vertical_part(&text.to_ascii_uppercase())?;
            return Some(Self::of_wkt(text).unwrap_or_else(|| Self::of_unit_code(9001)));
        };
        match codes.split_once('+') {
            Some((_, vertical)) => {
                let code = vertical.parse().ok()?;
                Some(Self::of_crs_code(code).unwrap_or_else(|| Self::of_unit_code(9001)))
            }
            None => Self::of_crs_code(codes.parse().ok()?),
        }
    }

    /// The unit of the vertical CRS in a well-known text; `None` where there is none, or it is in metres upwards.
    pub(super) fn of_wkt(text: &str) -> Option<Self> {
        let upper = text.to_ascii_uppercase();
        let vertical = vertical_part(&upper)?;
        let unit = ["LENGTHUNIT", "UNIT"].iter().find_map(|k| node(vertical, k));
        let mut parts = unit.unwrap_or_default().splitn(3, ',').map(|part| part.trim().trim_matches('"'));
        let name = parts.next().unwrap_or_default();
        let metres = parts.next().and_then(|t| t.parse::<f64>().ok()).filter(|m| *m > 0.0 && m.is_finite());
        let known = Self::of_word(name).filter(|unit| matches!(unit, Self::Metres(..)));
        let metres = metres.or(known.map(|unit| unit.metres())).unwrap_or(1.0);
        let axis = node(vertical, "AXIS").unwrap_or_default();
        let is_down = axis.split(',').any(|part| part.trim() == "DOWN")
            || esri_parameter(vertical, "DIRECTION").is_some_and(|direction| direction < 0.0);
        let metres = if is_down { -metres } else { metres };
        let words = if name.is_empty() { "metres".into() } else { name.to_ascii_lowercase() };
        match esri_parameter(vertical, "VERTICAL_SHIFT") {
            Some(shift) if shift != 0.0 => {
                Some(Self::Shifted(metres, format!("{words} from a zero that is shifted by {shift}")))
            }
            _ => (metres != 1.0).then_some(Self::Metres(metres, words)),
        }
    }
}

/// The vertical CRS in a well-known text, in capitals.
fn vertical_part(text: &str) -> Option<&str> {
    ["VERT_CS", "VERTCRS", "VERTICALCRS", "VERTCS"].iter().find_map(|k| node(text, k))
}

/// A number that a vertical CRS of Esri's programs states: its direction (below 0 for downwards), or how its zero is shifted.
fn esri_parameter(vertical: &str, name: &str) -> Option<f64> {
    let (mut from, mut value) = (0, None);
    while let Some(found) = span(vertical, "PARAMETER", from) {
        from = found.end;
        let mut parts = vertical[found].split(',').map(|part| part.trim().trim_matches('"'));
        if parts.next() == Some(name) {
            value = parts.next().and_then(|number| number.parse().ok()).or(value);
        }
    }
    value
}

/// What stands between the brackets of the first node of a keyword, outside quotes.
fn node<'a>(text: &'a str, keyword: &str) -> Option<&'a str> {
    text.get(span(text, keyword, 0)?)
}

/// Where the content of the first node of a keyword from a byte outside quotes on stands.
fn span(text: &str, keyword: &str, from: usize) -> Option<Range<usize>> {
    let bytes = text.as_bytes();
    let mut quoted = false;
    let start = (from..bytes.len()).find_map(|at| {
        quoted ^= bytes[at] == b'"';
        let is_word = at == 0 || !(bytes[at - 1].is_ascii_alphanumeric() || bytes[at - 1] == b'_');
        let open = at + keyword.len();
        let begins = !quoted && is_word && bytes[at..].starts_with(keyword.as_bytes());
        (begins && matches!(bytes.get(open), Some(b'[' | b'('))).then_some(open + 1)
    })?;
    let (mut depth, mut quoted) = (1, false);
    for (at, byte) in bytes.iter().enumerate().skip(start) {
        match byte {
            b'"' => quoted = !quoted,
            b'[' | b'(' if !quoted => depth += 1,
            b']' | b')' if !quoted => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(start..at);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metres(unit: Option<VerticalUnit>) -> Option<f64> {
        unit.map(|unit| unit.metres())
    }

    #[test]
    fn codes_of_feet_and_depths_are_known_and_others_are_metres() {
        let feet =
            [6360, 5702, 8228, 5703, 5773, 3855, 5715, 6358, 8714].map(VerticalUnit::of_crs_code).map(metres);
        let expected = [
            Some(SURVEY_FOOT),
            Some(SURVEY_FOOT),
            Some(FOOT),
            None,
            None,
            None,
            Some(-1.0),
            Some(-SURVEY_FOOT),
            Some(SURVEY_FOOT),
        ];
        assert_eq!(feet, expected);
    }

    #[test]
    fn the_unit_of_a_well_known_text_is_that_of_its_vertical_part() {
        let horizontal = r#"PROJCS["a, VERT_CS[",UNIT["US survey foot",0.3048006]]"#;
        let wkt1 = format!(
            r#"COMPD_CS["x",{horizontal},VERT_CS["NAVD88 height (ft)",VERT_DATUM["n",2005],UNIT["foot",0.3048],AXIS["Up",UP]]]"#
        );
        assert_eq!(metres(VerticalUnit::of_wkt(&wkt1)), Some(0.3048));
        assert_eq!(VerticalUnit::of_wkt(horizontal), None);
        let wkt2 = r#"COMPOUNDCRS["x",GEOGCRS["g"],VERTCRS["d",VDATUM["v"],CS[vertical,1],AXIS["depth (D)",down],LENGTHUNIT["metre",1]]]"#;
        assert_eq!(metres(VerticalUnit::of_wkt(wkt2)), Some(-1.0));
        let esri = r#"COMPD_CS["x",GEOGCS["g"],VERTCS["NAVD_1988_Foot_US",VDATUM["n"],UNIT["Foot_US",0.3048006096012192]]]"#;
        assert_eq!(metres(VerticalUnit::of_wkt(esri)), Some(0.304_800_609_601_219_2));
        for cut in 0..wkt1.len() {
            let _ = VerticalUnit::of_wkt(&wkt1[..cut]);
        }
    }

    #[test]
    fn a_vertical_crs_of_esri_says_its_direction_in_a_parameter() {
        let esri = |direction: &str, unit: &str| {
            let text = format!(
                r#"PROJCS["x",UNIT["Meter",1.0]],VERTCS["MSL",VDATUM["é"],PARAMETER["Vertical_Shift",0.0],PARAMETER["Direction",{direction}],UNIT[{unit}]]"#
            );
            for (cut, _) in text.char_indices() {
                let _ = VerticalUnit::of_wkt(&text[..cut]);
            }
            metres(VerticalUnit::of_wkt(&text))
        };
        assert_eq!(esri("-1.0", r#""Meter",1.0"#), Some(-1.0));
        assert_eq!(esri("-1.0", r#""Foot",0.3048"#), Some(-0.3048));
        assert_eq!(esri("1.0", r#""Meter",1.0"#), None);
        assert_eq!(esri("down", r#""Meter",1.0"#), None);
    }

    #[test]
    fn a_shifted_zero_of_esri_is_told_and_its_unit_counts() {
        let esri = |shift: &str, unit: &str| {
            let text = format!(
                r#"VERTCS["NAVD88",VDATUM["n"],PARAMETER["Vertical_Shift",{shift}],PARAMETER["Direction",1.0],UNIT[{unit}]]"#
            );
            VerticalUnit::of_wkt(&text)
        };
        assert_eq!(esri("0.0", r#""Meter",1.0"#), None);
        let shifted = esri("-12.5", r#""Foot",0.3048"#).unwrap();
        let note = shifted.note().unwrap();
        assert!(
            shifted.metres() == 0.3048 && note.contains("shifted by -12.5") && note.contains("not applied"),
            "{note}"
        );
        assert!(!VerticalUnit::agree(Some(&shifted), None));
    }

    #[test]
    fn the_vertical_part_of_a_crs_that_people_write_has_a_unit() {
        let of = |text: &str| metres(VerticalUnit::of_crs_text(text));
        assert_eq!(of("EPSG:2263+6360"), Some(SURVEY_FOOT));
        assert_eq!(of(" epsg:4326+5773 "), Some(1.0));
        assert_eq!(of("EPSG:26918+5715"), Some(-1.0));
        assert_eq!(
            [of("EPSG:4326"), of("EPSG:2263"), of("+proj=utm +zone=33"), of("EPSG:"), of("é")],
            [None; 5]
        );
        let wkt = |unit: &str| {
            format!(r#"COMPD_CS["x",GEOGCS["g"],VERT_CS["v",VERT_DATUM["n",2005],UNIT[{unit}]]]"#)
        };
        assert_eq!(of(&wkt(r#""metre",1"#)), Some(1.0));
        assert_eq!(of(&wkt(r#""foot",0.3048"#)), Some(0.3048));
    }

    #[test]
    fn words_name_lengths_or_say_that_they_do_not() {
        assert_eq!(metres(VerticalUnit::of_word("US_survey_foot")), Some(SURVEY_FOOT));
        assert_eq!(metres(VerticalUnit::of_word("Feet (US survey)")), Some(SURVEY_FOOT));
        assert_eq!(metres(VerticalUnit::of_word(" ft ")), Some(FOOT));
        assert_eq!(VerticalUnit::of_word(" "), None);
        let kelvin = VerticalUnit::of_word("K").unwrap();
        assert!(kelvin.metres() == 1.0 && kelvin.note().unwrap().contains("`K`"));
        assert_eq!(VerticalUnit::of_word("metre").unwrap().note(), None);
    }
}

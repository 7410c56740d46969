//! Colours as CSS writes them.

use csscolorparser::{NAMED_COLORS, parse};

/// Functions whose values need nothing but sums, products and quotients: they have the same bits on every machine. (The others, `lab()`
/// and its like, take powers and angles from the C library.)
const FUNCTIONS: [&str; 6] = ["rgb", "rgba", "hsl", "hsla", "hwb", "calc"];

/// The four code values of a colour of CSS: `#rgb`, `#rgba`, `#rrggbb`, `#rrggbbaa`, a name, `rgb()`, `hsl()`, `hwb()`.
pub fn color(text: &str) -> Option<[u8; 4]> {
    let is_color = match text.find('(') {
        // Digits without a `#` are a colour to the parser and none to CSS.
        None => text.starts_with('#') || color_names().any(|name| text.eq_ignore_ascii_case(name)),
        Some(_) => text.is_ascii() && functions(text).all(is_known),
    };
    let color = parse(text).ok().filter(|_| is_color)?;
    let is_finite = [color.r, color.g, color.b, color.a].iter().all(|v| v.is_finite());
    is_finite.then(|| color.to_rgba8())
}

/// The names of colours.
pub fn color_names() -> impl Iterator<Item = &'static str> {
    NAMED_COLORS.keys().map(|name| name.as_str()).chain(["transparent"])
}

/// What stands before each opening parenthesis.
fn functions(text: &str) -> impl Iterator<Item = &str> {
    let before = text.match_indices('(').map(|(at, _)| &text[..at]);
    before.map(|before| {
        let name = before.trim_end();
        &name[name.rfind(|c: char| !c.is_ascii_alphanumeric() && c != '-').map_or(0, |at| at + 1)..]
    })
}

/// Whether a function is one of ours; parentheses alone are a part of a sum.
fn is_known(name: &str) -> bool {
    name.is_empty() || FUNCTIONS.iter().any(|known| name.eq_ignore_ascii_case(known))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_the_code_values_themselves() {
        for v in 0..=255u8 {
            let w = 255 - v;
            let same = [v, w, v, w];
            assert_eq!(color(&format!("#{v:02x}{w:02X}{v:02x}{w:02X}")), Some(same));
            assert_eq!(color(&format!("#{v:02x}{w:02X}{v:02x}")), Some([v, w, v, 255]));
            assert_eq!(color(&format!("rgb({v} {w} {v})")), Some([v, w, v, 255]));
        }
        for v in 0..=15u8 {
            assert_eq!(color(&format!("#{v:x}{v:x}{v:x}{v:x}")), Some([17 * v; 4]));
        }
        assert_eq!(color("#f00"), Some([255, 0, 0, 255]));
    }

    #[test]
    fn names_and_functions_are_those_of_css() {
        for (text, codes) in [
            ("red", [255, 0, 0, 255]),
            ("RebeccaPurple", [102, 51, 153, 255]),
            ("transparent", [0, 0, 0, 0]),
            ("rgb(255, 128, 0)", [255, 128, 0, 255]),
            ("rgb(300 -5 0)", [255, 0, 0, 255]),
            ("rgba(255, 128, 0, 0.2)", [255, 128, 0, 51]),
            ("rgb(100% 50% 0% / 20%)", [255, 128, 0, 51]),
            ("hsl(120, 100%, 25%)", [0, 128, 0, 255]),
            ("hwb(240 0% 0%)", [0, 0, 255, 255]),
            ("RGB(1, 2, 3)", [1, 2, 3, 255]),
            ("rgb(from #102030 calc((r + 1) * 2) g b)", [34, 32, 48, 255]),
        ] {
            assert_eq!(color(text), Some(codes), "{text}");
        }
    }

    #[test]
    fn what_is_no_colour_or_would_need_the_c_library_is_none() {
        for wrong in [
            "",
            "#",
            "#f",
            "#ff",
            "ff8000",
            "fade",
            "beef",
            "#ff80zz",
            "#ff80001",
            "#üüü",
            "#+f+f+f",
            "rot",
            "rgb(1, 2)",
            "rgb(nan 0 0)",
            "rgb(inf 0 0)",
            "lab(50 20 30)",
            "rgb(from lab(50 20 30) r g b)",
            "oklch(0.5 0.1 30)",
            "hsv(0 100% 100%)",
            "rgb(1e999 0 0)",
            "(((((((((((((((((",
            "rgb(ü 0 0)",
            "color(srgb 1 0 0)",
        ] {
            assert_eq!(color(wrong), None, "{wrong}");
        }
    }
}

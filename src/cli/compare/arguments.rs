//! What `compare` is called with.

use drapery::compare::Limits;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery compare bundle my-frames                    by what a bundle of `drapery export` allows
  drapery compare bundle frame.png --junit junit.xml --html page.html
  drapery compare conformance my-frames --github      each bundle of a set; a table, one exit status
  drapery compare expected.png actual.png
  drapery compare expected.png actual.png --tolerance 1/255 --allow 0.1% --heatmap heat.png
  drapery compare expected.png actual.png --ignore clouds.png
  drapery compare out/inverse-projection.depth.npy depth.exr --relative 0.001 --json -
  drapery compare --lo lo.png --hi hi.png actual.png
  my-renderer | drapery compare expected.png - --tolerance 2/255

A bundle tells of each pixel what any right program may draw. It is tried by one hypothesis after the other (which way ties are \
broken, for one); the first that fits all pixels is named. PASS: no pixel is outside. WEAK PASS: none is, but almost \
everything that is open was decided one way, as by lines that are a little too wide. FAIL: the rest. A folder of frames holds T.png (T is the \
bundle's technique) and, where you have them, buffers T.NAME.npy: the first that differs is named.

Pictures are PNG (8 or 16 bits), EXR (RGB, RGBA or one channel; f16, f32 or u32) or .npy (rows, columns and channels of \
f64, f32, u32, u16 or u8); which, their first bytes say. Values are compared in units of 1: 8-bit codes are 255ths, \
16-bit codes 65535ths; f16, f32, f64 and u32 are as they are. Alpha is compared; a picture without alpha has the alpha 1.

Exit status 0: passed, weakly too (see --strict). 1: failed, by pixels over the tolerance or outside, another size, other channels, or a NaN. \
2: nothing was judged, because a picture is missing or is no picture, a bundle is not as it was written, or both are the same file (which would pass \
whatever it shows; two files of equal content are compared).";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES, allow_missing_positional = true)]
pub(in crate::cli) struct Arguments {
    /// What is right: a bundle, a conformance set, or a picture; `-` for stdin.
    #[arg(required_unless_present = "lo")]
    pub expected: Option<PathBuf>,
    /// What to judge: a picture, or the folder of a program's frames; `-` for a picture on stdin.
    pub actual: PathBuf,
    /// The least that each value may be, as a picture; with --hi, instead of EXPECTED.
    #[arg(long, value_name = "FILE", requires = "hi", conflicts_with = "expected")]
    pub lo: Option<PathBuf>,
    /// The most that each value may be, as a picture.
    #[arg(long, value_name = "FILE", requires = "lo")]
    pub hi: Option<PathBuf>,
    /// A pixel fails when one of its channels is off by more than this: a number such as 0.01, or a fraction such as 2/255.
    /// For pictures: a bundle has its own.
    #[arg(long, value_name = "DISTANCE", value_parser = tolerance)]
    pub tolerance: Option<f64>,
    /// And by more than this share of what is expected, for depth: 0.001. For pictures.
    #[arg(long, value_name = "SHARE", value_parser = relative)]
    pub relative: Option<f64>,
    /// So many failing pixels still pass: a number, or a share of all pixels such as 0.1% [default: 0].
    #[arg(long, value_name = "N", value_parser = allowance)]
    pub allow: Option<Allowance>,
    /// So many of them within any 16 x 16 pixels still pass [default: 4 of a bundle, any of pictures].
    #[arg(long, value_name = "N")]
    pub densest: Option<usize>,
    /// A picture of the same size: its pixels that are not black (nor transparent) are not looked at.
    #[arg(long, value_name = "FILE")]
    pub ignore: Option<PathBuf>,
    /// A weak pass fails, and so does a frame with a buffer that is not as allowed.
    #[arg(long)]
    pub strict: bool,
    /// Write the verdict as JSON; `-`: on stdout, instead of the text.
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write a PNG of where and how far they differ: black equal, blue within the tolerance, yellow to pink over it. Of a set, into
    /// this folder.
    #[arg(long, value_name = "FILE")]
    pub heatmap: Option<PathBuf>,
    /// Write JUnit's XML, a case each, with lines that name the frame, the heat map and the page as attachments.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Write one page with both pictures under a slider, where they differ, the windows and features that fail; needs no network.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Print annotations for GitHub's pages (`::error ...`), and add a summary to the file that GITHUB_STEP_SUMMARY names.
    #[arg(long)]
    pub github: bool,
}

impl Arguments {
    /// Whether pictures are written.
    pub(super) fn shows(&self) -> bool {
        self.heatmap.is_some() || self.html.is_some()
    }
}

/// How many pixels may fail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cli) enum Allowance {
    Pixels(usize),
    /// Of a hundred.
    Percent(f64),
}

impl Allowance {
    /// Of so many pixels.
    pub(super) fn of(self, pixels: usize) -> usize {
        // Percents are decimal: 0.1 % of 1000 is 1, though 0.1 is not quite a tenth.
        const ROUNDING: f64 = 1e-9;
        match self {
            Self::Pixels(pixels) => pixels,
            Self::Percent(percent) => (percent * pixels as f64 / 100.0 + ROUNDING).floor() as usize,
        }
    }
}

type Parsed<T> = std::result::Result<T, String>;

/// A number, or a fraction of two.
fn tolerance(text: &str) -> Parsed<f64> {
    let distance = match text.split_once('/') {
        Some((above, below)) => number(above)? / number(below)?,
        None => number(text)?,
    };
    Limits::new(distance, 0).map_err(|error| error.what().to_owned()).map(Limits::tolerance)
}

fn relative(text: &str) -> Parsed<f64> {
    let limits = Limits::default().with_relative(number(text)?);
    limits.map_err(|error| error.what().to_owned()).map(Limits::relative)
}

fn allowance(text: &str) -> Parsed<Allowance> {
    let Some(percent) = text.strip_suffix('%') else {
        return text
            .parse()
            .map(Allowance::Pixels)
            .map_err(|_| "it is no number and no share such as 0.1%".into());
    };
    match number(percent)? {
        percent if (0.0..=100.0).contains(&percent) => Ok(Allowance::Percent(percent)),
        _ => Err("it is no share from 0% to 100%".into()),
    }
}

fn number(text: &str) -> Parsed<f64> {
    text.trim().parse::<f64>().map_err(|_| "it is no number and no fraction".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_is_a_number_or_a_fraction() {
        assert_eq!(tolerance("0.25"), Ok(0.25));
        assert_eq!(tolerance("2/255"), Ok(2.0 / 255.0));
        for wrong in ["", "x", "1/0", "0/0", "-1", "nan", "inf", "1/2/3"] {
            assert!(tolerance(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn an_allowance_is_a_number_of_pixels_or_a_share_of_them() {
        let of = |text: &str| allowance(text).unwrap().of(1200);
        assert_eq!([of("0"), of("7"), of("0.1%"), of("0.25%"), of("100%")], [0, 7, 1, 3, 1200]);
        assert_eq!(allowance("0.1%").unwrap().of(120_000), 120);
        for wrong in ["", "%", "-1", "1.5", "101%", "-1%", "nan%", "1/2"] {
            assert!(allowance(wrong).is_err(), "{wrong}");
        }
    }
}

//! `drapery compare EXPECTED ACTUAL`

use super::print::{print, say};
use super::stop::{Outcome, Status, Stop};
use drapery::compare::{Expected, Image, Limits, Report, Verdict, same_file};
use drapery::output::{write_png, write_whole};
use drapery::{Error, Result};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  drapery compare expected.png actual.png
  drapery compare expected.png actual.png --tolerance 1/255 --allow 20 --heatmap heat.png
  drapery compare out/inverse-projection.depth.npy depth.exr --tolerance 0.001 --json -
  my-renderer | drapery compare expected.png - --tolerance 2/255

Pictures are PNG (8 or 16 bits), EXR (RGB, RGBA or one channel; f16, f32 or u32) or .npy (rows, columns and channels of \
f64, f32, u32, u16 or u8); which, their first bytes say. Values are compared in units of 1: 8-bit codes are 255ths, \
16-bit codes 65535ths; f16, f32, f64 and u32 are as they are. Alpha is compared; a picture without alpha has the alpha 1.

Exit status 0: passed. 1: failed, by pixels over the tolerance, another size, other channels, or a NaN in either. \
2: nothing was judged, because a picture is missing or is no picture, or both are the same file (which would pass \
whatever it shows; two files of equal content are compared).";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The picture that is right; `-` for stdin.
    expected: PathBuf,
    /// The picture to judge; `-` for stdin.
    actual: PathBuf,
    /// A pixel fails when one of its channels is off by more than this: a number such as 0.01, or a fraction such as 2/255.
    #[arg(long, value_name = "DISTANCE", default_value = "0", value_parser = tolerance)]
    tolerance: f64,
    /// So many failing pixels still pass.
    #[arg(long, value_name = "N", default_value_t = 0)]
    allow: usize,
    /// Write the verdict as JSON; `-`: on stdout, instead of the text.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write a PNG of where and how far they differ: black equal, blue within the tolerance, yellow to pink over it.
    #[arg(long, value_name = "FILE")]
    heatmap: Option<PathBuf>,
}

/// A number, or a fraction of two.
fn tolerance(text: &str) -> std::result::Result<f64, String> {
    let number =
        |text: &str| text.trim().parse::<f64>().map_err(|_| "it is no number and no fraction".to_owned());
    let distance = match text.split_once('/') {
        Some((above, below)) => number(above)? / number(below)?,
        None => number(text)?,
    };
    Limits::new(distance, 0).map_err(|error| error.what().to_owned()).map(Limits::tolerance)
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let Arguments { expected, actual, .. } = arguments;
    check_call(arguments)?;
    let limits = Limits::new(arguments.tolerance, arguments.allow)?;
    let verdict = Verdict::on(&read(actual)?, &Expected::exactly(read(expected)?), limits);
    let (expected, actual) = (expected.display().to_string(), actual.display().to_string());
    match report(arguments, &Report { expected: &expected, actual: &actual, verdict: &verdict }) {
        // Nobody reads the verdict; the exit status still tells it.
        Ok(()) | Err(Stop::PipeClosed) => {}
        Err(stop) => return Err(stop),
    }
    Ok(if verdict.passed() { Status::Passed } else { Status::Failed })
}

/// What is wrong with a call before any picture is looked into.
fn check_call(arguments: &Arguments) -> Result<()> {
    let Arguments { expected, actual, json, heatmap, .. } = arguments;
    if is_one_file(expected, actual)? {
        return Err(Error::usage(format!(
            "the same file twice: {} and {} are one file, which would pass whatever it shows",
            expected.display(),
            actual.display()
        ))
        .help("compare two files; equal content is no hindrance"));
    }
    if json.is_some() && json == heatmap {
        return Err(Error::usage("--json and --heatmap name the same file").help("name two"));
    }
    for output in [json, heatmap].into_iter().flatten().filter(|path| !is_standard(path) && path.exists()) {
        for input in [expected, actual] {
            if is_one_file(output, input)? {
                return Err(
                    Error::usage("this picture is compared, and would be written over").in_file(output)
                );
            }
        }
    }
    Ok(())
}

fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// Whether two names are of one file. Where stdin has a place in the file system, `compare a.png - < a.png` is seen
/// through too.
fn is_one_file(a: &Path, b: &Path) -> Result<bool> {
    const STDIN: &str = "/dev/stdin";
    let place = |path| if is_standard(path) { Path::new(STDIN) } else { path };
    if is_standard(a) != is_standard(b) && !Path::new(STDIN).exists() {
        return Ok(false);
    }
    Ok((is_standard(a) && is_standard(b)) || same_file(place(a), place(b))?)
}

fn read(path: &Path) -> Result<Image> {
    if !is_standard(path) {
        return Image::read(path);
    }
    let mut bytes = Vec::new();
    let read = std::io::stdin().read_to_end(&mut bytes);
    read.map_err(|error| Error::io("stdin cannot be read", error))?;
    Image::decode(&bytes).map_err(|error| error.in_file(Path::new("<stdin>")))
}

/// Writes what is asked for, and the text where nothing else goes to stdout.
fn report(arguments: &Arguments, report: &Report) -> std::result::Result<(), Stop> {
    let mut is_told = false;
    if let Some(path) = &arguments.heatmap {
        match report.verdict.heat_map() {
            Some(map) => is_told |= write(path, &|to| write_png(&map, to))?,
            None => say("note: there is no heat map of what cannot be measured"),
        }
    }
    if let Some(path) = &arguments.json {
        let text = report.json()?;
        is_told |= write(path, &|to| to.write_all(text.as_bytes()))?;
    }
    if !is_told {
        print(&super::refusal::harmless(&report.text()))?;
    }
    Ok(())
}

/// Writes a file, or stdout: whether it was that.
fn write(
    path: &Path,
    content: &dyn Fn(&mut dyn Write) -> std::io::Result<()>,
) -> std::result::Result<bool, Stop> {
    if !is_standard(path) {
        write_whole(path, content)?;
        return Ok(false);
    }
    let mut stdout = std::io::stdout().lock();
    content(&mut stdout).and_then(|()| stdout.flush()).map_err(Stop::stdout)?;
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::tolerance;

    #[test]
    fn a_tolerance_is_a_number_or_a_fraction() {
        assert_eq!(tolerance("0.25"), Ok(0.25));
        assert_eq!(tolerance("2/255"), Ok(2.0 / 255.0));
        for wrong in ["", "x", "1/0", "0/0", "-1", "nan", "inf", "1/2/3"] {
            assert!(tolerance(wrong).is_err(), "{wrong}");
        }
    }
}

//! What a technique's picture and its buffers may be, as files of a bundle: `allowed.json` and the pictures and tables that it names.

use crate::buffer::{Buffer, Plane, Values};
use crate::canvas::table;
use crate::compare::{Allowed, Hypothesis, Stage, StageRange};
use crate::error::{Error, Result};
use crate::output::{Batch, ByName, Npy, write_codes16};
use serde_json::{Value, json};

/// What errors call the tables.
const TABLE: &str = "allowed";

/// Stages the files of what a technique's picture may be; `envelope` is what was allowed for.
///
/// # Errors
/// When a file cannot be written; internal errors where lists are not as long as the picture is large.
pub fn stage_allowed(
    (allowed, envelope): (&Allowed, &ByName),
    technique: &str,
    batch: &mut Batch,
) -> Result<()> {
    let hypotheses = allowed.hypotheses.iter().map(|of| {
        let mut told = stage_hypothesis(of, (allowed.width, allowed.height), batch)?;
        told["says"] = of.says[..].into();
        Ok(told)
    });
    let hypotheses = hypotheses.collect::<Result<Vec<Value>>>()?;
    let alternatives = allowed.alternatives.iter().map(|of| {
        let mut told = stage_hypothesis(&of.hypothesis, (allowed.width, allowed.height), batch)?;
        told["says"] = of.hypothesis.says[..].into();
        told["choice"] = of.choice[..].into();
        Ok(told)
    });
    let alternatives = alternatives.collect::<Result<Vec<Value>>>()?;
    let stages = allowed.stages.iter().map(|of| stage_range(of, (allowed.width, allowed.height), batch));
    let stages = stages.collect::<Result<Vec<Value>>>()?;
    let rows = allowed.features.iter().map(|r| [r.row, r.first, r.last, r.layer, r.feature]);
    let features = "allowed/features.npy";
    stage_plane(features, &table(TABLE, &mut rows.collect(), Values::U32), batch)?;
    let told = json!({
        "schema": 1,
        "technique": technique,
        "width": allowed.width,
        "height": allowed.height,
        "picture": format!("{technique}.png"),
        "envelope": envelope,
        "hypotheses": hypotheses,
        "stages": stages,
        "features": features,
        "alternatives": alternatives,
    });
    let text = serde_json::to_string_pretty(&told);
    let text = text.map_err(|error| Error::internal(format!("allowed.json: {error}")).caused_by(error))?;
    batch.stage("allowed.json", |to| to.write_all(text.as_bytes()).and_then(|()| to.write_all(b"\n")))
}

/// The files of a hypothesis, and what is told of them.
fn stage_hypothesis(of: &Hypothesis, (width, height): (usize, usize), batch: &mut Batch) -> Result<Value> {
    let name = &of.name;
    let mut picture = |end: &str, codes: &[[u16; 4]]| {
        let path = format!("allowed/{name}.{end}.png");
        if codes.len() != width * height {
            return Err(Error::internal(format!("{path} has {} pixels", codes.len())));
        }
        let codes = Buffer::from_values(width, height, codes.to_vec());
        batch.stage(&path, |to| write_codes16(&codes, to))?;
        Ok(path)
    };
    let (lo, hi) = (picture("lo", &of.lo)?, picture("hi", &of.hi)?);
    let choices = of.choices.iter().map(|c| row(c.pixel, c.lo, c.hi)).collect();
    let extremes = of.extremes.iter().map(|e| row(e.pixel, e.least, e.most)).collect();
    let mut pixels = |end: &str, mut rows: Vec<[u32; 9]>| {
        let path = format!("allowed/{name}.{end}.npy");
        stage_plane(&path, &table(TABLE, &mut rows, Values::U32), batch).map(|()| path)
    };
    let (choices, extremes) = (pixels("choices", choices)?, pixels("extremes", extremes)?);
    Ok(json!({ "name": name, "lo": lo, "hi": hi, "choices": choices, "extremes": extremes }))
}

/// The files of what a buffer may be, and what is told of them.
fn stage_range(of: &Stage, (width, height): (usize, usize), batch: &mut Batch) -> Result<Value> {
    let name = &of.buffer;
    match &of.range {
        StageRange::OneOf(values) => {
            let mut rows = values.iter().map(|(pixel, value)| [f64::from(*pixel), *value]).collect();
            let path = format!("allowed/{name}.one-of.npy");
            stage_plane(&path, &table(TABLE, &mut rows, Values::F64), batch)?;
            Ok(json!({ "buffer": name, "one-of": path }))
        }
        StageRange::Between { components, lo, hi } => {
            let mut ends = Vec::new();
            for (end, values) in [("lo", lo), ("hi", hi)] {
                let path = format!("allowed/{name}.{end}.npy");
                // Finer samples than pixels make a larger buffer of the same proportions: its rows tell its height.
                let pixels = values.len() / components;
                let side = (pixels / (width * height).max(1)).isqrt().max(1);
                let plane = Plane {
                    name: TABLE,
                    width: width * side,
                    height: height * side,
                    components: *components,
                    values: Values::F64(values.clone()),
                };
                stage_plane(&path, &plane, batch)?;
                ends.push(path);
            }
            Ok(json!({ "buffer": name, "lo": ends[0], "hi": ends[1] }))
        }
    }
}

/// A pixel and two colours.
fn row(pixel: u32, [a, b, c, d]: [u16; 4], [e, f, g, h]: [u16; 4]) -> [u32; 9] {
    let [a, b, c, d, e, f, g, h] = [a, b, c, d, e, f, g, h].map(u32::from);
    [pixel, a, b, c, d, e, f, g, h]
}

fn stage_plane(path: &str, plane: &Plane, batch: &mut Batch) -> Result<()> {
    let npy = Npy::new(plane)?;
    batch.stage(path, |to| npy.write(to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{Choice, Extremes, FeatureRun};

    fn allowed() -> Allowed {
        Allowed {
            width: 2,
            height: 1,
            hypotheses: vec![Hypothesis {
                name: "as-is".into(),
                says: "as-is: so it is".into(),
                lo: vec![[0, 1, 256, 65535], [0; 4]],
                hi: vec![[9, 10, 300, 65535], [65535; 4]],
                choices: vec![Choice { pixel: 1, lo: [0; 4], hi: [65535; 4] }],
                extremes: vec![Extremes { pixel: 1, least: [1; 4], most: [2; 4] }],
            }],
            stages: vec![
                Stage {
                    buffer: "depth".into(),
                    range: StageRange::Between {
                        components: 1,
                        lo: vec![1.0, 2.0],
                        hi: vec![1.5, f64::INFINITY],
                    },
                },
                Stage { buffer: "triangle".into(), range: StageRange::OneOf(vec![(0, 7.0), (0, 8.0)]) },
            ],
            features: vec![FeatureRun { row: 0, first: 0, last: 1, layer: 2, feature: 3 }],
            alternatives: Vec::new(),
        }
    }

    #[test]
    fn what_a_picture_may_be_is_told_with_the_files_that_hold_it() {
        let folder = tempfile::tempdir().unwrap();
        let mut batch = Batch::into(folder.path()).unwrap();
        let envelope = ByName::from_pairs([("shift_px", 0.00390625)]);
        stage_allowed((&allowed(), &envelope), "clipmap", &mut batch).unwrap();
        batch.commit().unwrap();
        let text = std::fs::read(folder.path().join("allowed.json")).unwrap();
        let told: Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(told["picture"], "clipmap.png");
        assert_eq!(told["envelope"]["shift_px"], 0.00390625);
        assert_eq!(told["hypotheses"][0]["says"], "as-is: so it is");
        assert_eq!(
            told["stages"][0],
            json!({ "buffer": "depth", "lo": "allowed/depth.lo.npy", "hi": "allowed/depth.hi.npy" })
        );
        assert_eq!(
            told["stages"][1],
            json!({ "buffer": "triangle", "one-of": "allowed/triangle.one-of.npy" })
        );
        let lo = image::open(folder.path().join(told["hypotheses"][0]["lo"].as_str().unwrap())).unwrap();
        assert_eq!(lo.as_rgba16().unwrap().get_pixel(0, 0).0, [0, 1, 256, 65535], "all 16 bits are there");
        let choices = std::fs::read(folder.path().join("allowed/as-is.choices.npy")).unwrap();
        let numbers: Vec<u32> =
            choices[choices.len() - 36..].as_chunks().0.iter().map(|v| u32::from_le_bytes(*v)).collect();
        assert_eq!(numbers, [1, 0, 0, 0, 0, 65535, 65535, 65535, 65535]);
        assert!(folder.path().join("allowed/features.npy").is_file());
    }

    #[test]
    fn lists_that_are_not_as_long_as_the_picture_is_large_are_a_bug() {
        let folder = tempfile::tempdir().unwrap();
        let mut batch = Batch::into(folder.path()).unwrap();
        let mut short = allowed();
        short.hypotheses[0].hi.pop();
        let none = ByName::from_pairs::<f64>([]);
        let error = stage_allowed((&short, &none), "clipmap", &mut batch).unwrap_err();
        assert!(error.is_internal(), "{error}");
    }
}

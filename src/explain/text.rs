//! An account as a person reads it in a terminal.

use super::absence::percent;
use super::account::{Account, ByTechnique, Centre, Covering, Right, Step, color_of, hex};
use super::margin::short;
use std::collections::BTreeMap;
use std::fmt::{self, Write};

/// Of a pixel no more triangles are told one by one.
const MOST_TRIANGLES: usize = 8;

/// Shares of a pixel below this are not spoken of.
const MATTERS: f64 = 5e-5;

impl Account {
    /// The account in lines.
    pub fn text(&self) -> String {
        let mut text = String::new();
        // Writing into a text cannot fail.
        let _ = self.write(&mut text);
        text
    }

    fn write(&self, to: &mut String) -> fmt::Result {
        let [x, y] = self.pixel;
        writeln!(to, "pixel {x},{y}")?;
        self.write_sight(to)?;
        writeln!(to, "\nright: {}", right(&self.truth))?;
        self.covering.iter().try_for_each(|covering| writeln!(to, "  {}", covered(covering)))?;
        if self.others > MATTERS {
            writeln!(to, "  others cover up to {:.2} %", 100.0 * self.others)?;
        }
        if !self.ladder.is_empty() {
            writeln!(to, "\nat its centre, from the ground up:")?;
        }
        for rung in &self.ladder {
            writeln!(to, "  {}  {} {}", hex(rung.after), rung.name, hex(rung.color))?;
        }
        if let Some(feature) = &self.feature {
            let verdict = if feature.shows { "shows here" } else { "does not show here" };
            writeln!(to, "\n`{}` {verdict}:", feature.asked)?;
            feature.reasons.iter().try_for_each(|reason| writeln!(to, "  {reason}"))?;
        }
        self.techniques.iter().try_for_each(|by| write_technique(by, to))?;
        if !self.items.is_empty() {
            writeln!(to, "\nitems:")?;
        }
        self.items.iter().try_for_each(|(item, name)| writeln!(to, "  {item} is {name}"))?;
        for left_out in &self.left_out {
            writeln!(to, "\n{} is left out: {}", left_out.technique, left_out.reason)?;
        }
        Ok(())
    }

    fn write_sight(&self, to: &mut String) -> fmt::Result {
        let ([a, b, c], [u, v, w]) = (self.ray.from, self.ray.direction);
        writeln!(to, "its line of sight: from ({a:.3}, {b:.3}, {c:.3}) along ({u:.6}, {v:.6}, {w:.6})")?;
        match &self.centre {
            Some(centre) => write_centre(centre, to)?,
            None => writeln!(to, "its centre sees the sky")?,
        }
        writeln!(to, "it sees {}", self.seen())
    }

    /// What the pixel sees, the largest shares first.
    fn seen(&self) -> String {
        let mut shares: BTreeMap<Option<u32>, f64> = BTreeMap::new();
        for piece in self.scenery.pieces.iter().filter(|piece| piece.share > 0.0) {
            *shares.entry(piece.triangle).or_default() += piece.share;
        }
        let mut shares: Vec<(Option<u32>, f64)> = shares.into_iter().collect();
        shares.sort_by(|a, b| b.1.total_cmp(&a.1));
        let told = shares.iter().take(MOST_TRIANGLES).map(|(triangle, share)| {
            let what = triangle.map_or("the sky".into(), |id| format!("triangle {id}"));
            format!("{what} {:.2} %", 100.0 * share)
        });
        let told = told.collect::<Vec<String>>().join(", ");
        match shares.len() {
            0 => "too many triangles to tell".into(),
            count if count > MOST_TRIANGLES => format!("{told} and {} more", count - MOST_TRIANGLES),
            _ => told,
        }
    }
}

fn write_centre(centre: &Centre, to: &mut String) -> fmt::Result {
    let Centre { triangle, plan: [x, y], world: [.., z], depth, .. } = centre;
    writeln!(
        to,
        "its centre sees triangle {triangle} at plan ({x:.3}, {y:.3}), z {z:.3}, {depth:.3} m deep"
    )?;
    if let Some([dx, dy]) = centre.pixel {
        let length = |[x, y]: [f64; 2]| short((x * x + y * y).sqrt());
        writeln!(
            to,
            "a pixel there is {} m to the right and {} m down, in the plan",
            length(dx),
            length(dy)
        )?;
    }
    centre.margins.iter().try_for_each(|margin| writeln!(to, "its centre is {}", margin.text()))?;
    centre.silhouette.iter().try_for_each(|edge| writeln!(to, "{}", edge.text()))
}

/// The right colour in words.
pub(super) fn right(truth: &Right) -> String {
    let codes = |of: [f64; 4]| of.map(|v| format!("{:.3}", v * 255.0)).join(" ");
    let width = short(255.0 * truth.width());
    let (color, low, high) = (hex(truth.estimate), codes(truth.low), codes(truth.high));
    if low == high {
        return format!("{color}, [{low}] of 255, known to {width}");
    }
    format!("{color} between [{low}] and [{high}] of 255, {width} wide")
}

/// What an item covers, in words.
pub(super) fn covered(covering: &Covering) -> String {
    format!("{} covers {}  {}", covering.name, percent(covering.low, covering.high), hex(covering.color))
}

/// How far a technique's colour is from the truth, in words.
pub(super) fn distance(error: f64) -> String {
    match 255.0 * error {
        codes if codes <= 0.0 => "right".into(),
        codes if codes <= 0.5 => "right but for rounding".into(),
        codes => format!("off by {} codes of 255", short(codes)),
    }
}

fn write_technique(by: &ByTechnique, to: &mut String) -> fmt::Result {
    writeln!(to, "\n{}: {}, {}", by.technique, hex(color_of(by.code)), distance(by.error))?;
    writeln!(to, "  {}", by.paper)?;
    by.steps.iter().try_for_each(|step| write_step(step, to))?;
    for tried in &by.tried {
        let verdict = match tried.error < by.error {
            true => "nearer",
            false if tried.error > by.error => "farther",
            false => "as far",
        };
        let changes = tried.changes.join(" ");
        writeln!(
            to,
            "  with {changes}: {}, {} ({verdict})",
            hex(color_of(tried.code)),
            distance(tried.error)
        )?;
    }
    Ok(())
}

/// How near a step's decision was, in words.
pub(super) fn notes(step: &Step) -> Vec<String> {
    let margins = step.margins.iter().map(|margin| format!("it is {}", margin.text()));
    margins.chain(step.silhouette.iter().map(|edge| edge.text())).collect()
}

fn write_step(step: &Step, to: &mut String) -> fmt::Result {
    writeln!(to, "  {:<22} {}", step.section, step.text)?;
    notes(step).iter().try_for_each(|note| writeln!(to, "  {:<22}   {note}", ""))
}

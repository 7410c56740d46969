//! A judgement by a bundle, as it is told.

use super::case::{COMPARE_SCHEMA, Case, Failure};
use super::numbers::{Row, channel_names, measured_rows, metrics_json, short};
use crate::compare::bundle::Judge;
use crate::compare::judgement::{
    Fitted, Involved, Judgement, Lopsided, Otherwise, Ruling, StageFound, StageOutcome,
};
use crate::error::Result;
use serde_json::{Value, json};

/// So many features are told by name.
const MOST_FEATURES: usize = 20;

/// So many other choices are told in the text.
const MOST_CHOICES: usize = 3;

/// A judgement, and who judged what.
#[derive(Debug, Clone, Copy)]
pub struct JudgementReport<'a> {
    /// What the bundle is called.
    pub expected: &'a str,
    /// What the judged frame is called.
    pub actual: &'a str,
    /// What the bundle allows.
    pub judge: &'a Judge,
    /// The judgement.
    pub judgement: &'a Judgement,
}

impl JudgementReport<'_> {
    /// The judgement as all reports tell it.
    ///
    /// # Errors
    /// When the names of the features cannot be read.
    pub fn case(&self) -> Result<Case> {
        let judgement = self.judgement;
        let fitted = judgement.outcome.as_ref().ok();
        let features = fitted.map_or(Ok(Vec::new()), |fitted| self.features(&fitted.features))?;
        let headline = judgement.to_string();
        let failure = judgement.failure().map(|name| Failure::of(name, &headline));
        Ok(Case {
            name: self.judge.technique().to_owned(),
            exposes: None,
            expected: self.expected.to_owned(),
            actual: self.actual.to_owned(),
            ruling: judgement.ruling(),
            document: self.document(failure.as_ref(), &features),
            failing: fitted.map(|fitted| fitted.metrics.failing),
            hypothesis: fitted.map(|fitted| fitted.tried[fitted.best].name.clone()),
            windows: fitted.map(Fitted::windows).unwrap_or_default(),
            rows: self.rows(&features),
            features,
            failure,
            headline,
        })
    }

    /// The names of features that are involved, the first of them.
    fn features(&self, involved: &[Involved]) -> Result<Vec<(String, usize)>> {
        if involved.is_empty() {
            return Ok(Vec::new());
        }
        let names = self.judge.feature_names()?;
        let named = |found: &Involved| {
            let (layer, feature) = (found.layer, found.feature);
            let name = names.get(&(layer, feature)).cloned();
            (name.unwrap_or_else(|| format!("layer {layer} feature {feature}")), found.pixels)
        };
        Ok(involved.iter().take(MOST_FEATURES).map(named).collect())
    }

    fn rows(&self, features: &[(String, usize)]) -> Vec<Row> {
        let mut rows = vec![
            ("expected", self.expected.to_owned()),
            ("actual", self.actual.to_owned()),
            ("technique", self.judge.technique().to_owned()),
        ];
        let Ok(fitted) = &self.judgement.outcome else { return rows };
        let says = &self.judge.allowed().hypotheses[fitted.best].says;
        rows.push(("hypothesis", format!("{}: {says}", fitted.tried[fitted.best].name)));
        let others = fitted.tried.iter().enumerate().filter(|(at, _)| *at != fitted.best);
        let others: Vec<String> =
            others.map(|(_, tried)| format!("{} {} failing", tried.name, tried.failing)).collect();
        if !others.is_empty() {
            rows.push(("others", others.join(", ")));
        }
        rows.extend(fitted.otherwise.iter().take(MOST_CHOICES).map(|of| ("instead", instead_text(of))));
        rows.extend(measured_rows(&fitted.difference, &fitted.metrics));
        let lean = fitted.lean;
        rows.push((
            "open",
            format!(
                "{} pixels tell a side: {} drawn, {} left out, {} between",
                lean.open(),
                lean.drawn,
                lean.out,
                lean.between
            ),
        ));
        if let Some(lopsided) = lean.lopsided() {
            rows.push(("weak", explained(lopsided)));
        }
        rows.extend(
            fitted
                .stages
                .iter()
                .map(|stage| ("buffer", stage_text(stage, fitted.first_stage() == Some(stage)))),
        );
        let few: Vec<String> = features
            .iter()
            .take(5)
            .map(|(name, pixels)| format!("{name} in {pixels} failing pixels"))
            .collect();
        if !few.is_empty() {
            rows.push(("features", few.join(", ")));
        }
        rows
    }

    fn document(&self, failure: Option<&Failure>, features: &[(String, usize)]) -> Value {
        let (judgement, allowed) = (self.judgement, self.judge.allowed());
        let mut document = json!({
            "schema": COMPARE_SCHEMA,
            "kind": "bundle",
            "expected": self.expected,
            "actual": self.actual,
            "technique": self.judge.technique(),
            "verdict": word(judgement.ruling()),
            "failure": failure,
            "allow": judgement.gates.allow,
            "densest_allowed": judgement.gates.densest,
            "width": allowed.width,
            "height": allowed.height,
            "metrics": null,
        });
        if let Ok(fitted) = &judgement.outcome {
            self.tell(fitted, features, &mut document);
        }
        document
    }

    /// What was found, into a document.
    fn tell(&self, fitted: &Fitted, features: &[(String, usize)], document: &mut Value) {
        let tried = fitted.tried.iter().enumerate();
        let hypotheses: Vec<Value> = tried
            .map(|(at, tried)| json!({ "name": tried.name, "says": self.judge.allowed().hypotheses[at].says, "failing": tried.failing }))
            .collect();
        let features = fitted.features.iter().zip(features);
        let features: Vec<Value> = features
            .map(|(found, (name, pixels))| json!({ "layer": found.layer, "feature": found.feature, "name": name, "pixels": pixels }))
            .collect();
        let weak = fitted.lean.lopsided().map(|lopsided| {
            let Lopsided { to_drawn, pixels, of, probability } = lopsided;
            let side = if to_drawn { "drawn" } else { "out" };
            json!({ "side": side, "pixels": pixels, "of": of, "probability": probability, "text": explained(lopsided) })
        });
        document["channels"] = json!(channel_names(&fitted.difference));
        document["metrics"] = metrics_json(&fitted.metrics, &fitted.difference);
        document["hypothesis"] = json!(fitted.tried[fitted.best].name);
        document["hypotheses"] = json!(hypotheses);
        let otherwise = fitted.otherwise.iter().map(|of| {
            let Otherwise { choice, says, failing, passes } = of;
            json!({ "choice": choice, "says": says, "failing": failing, "passes": passes })
        });
        document["otherwise"] = otherwise.collect();
        document["open"] = json!(fitted.lean);
        document["weak"] = json!(weak);
        document["stages"] = fitted.stages.iter().map(stage_json).collect();
        document["first_stage"] = json!(fitted.first_stage().map(|stage| &stage.buffer));
        document["features"] = json!(features);
    }
}

/// A verdict's name in JSON.
pub(super) fn word(ruling: Ruling) -> &'static str {
    match ruling {
        Ruling::Pass => "pass",
        Ruling::Weak => "weak-pass",
        Ruling::Fail => "fail",
    }
}

fn instead_text(Otherwise { choice, says, failing, passes }: &Otherwise) -> String {
    match passes {
        true => format!("by {choice} it would pass: {says}"),
        false => format!("by {choice} {failing} pixels would fail"),
    }
}

fn explained(lopsided: Lopsided) -> String {
    let Lopsided { to_drawn, pixels, of, probability } = lopsided;
    let (side, cause) = match to_drawn {
        true => ("where more is drawn", "lines a little too wide"),
        false => ("where less is drawn", "lines a little too narrow"),
    };
    format!(
        "{pixels} of {of} open pixels lie on the side {side}; a fair coin does so with the probability {}. Each is allowed, together \
         they are suspect: {cause}, or samples a little off to one side",
        short(probability)
    )
}

fn stage_text(stage: &StageFound, is_first: bool) -> String {
    let StageFound { buffer, outcome } = stage;
    let first = if is_first { ", the first stage that differs" } else { "" };
    match outcome {
        StageOutcome::NotGiven => format!("{buffer}: not given"),
        StageOutcome::Fits => format!("{buffer}: as allowed"),
        StageOutcome::Differs { pixels, first: (x, y) } => {
            format!("{buffer}: not allowed in {pixels} places, first at {x},{y}{first}")
        }
        StageOutcome::AnotherSize { expected: e, actual: a } => format!(
            "{buffer}: another size: {} x {} pixels of {} values are expected, it has {} x {} of {}{first}",
            e[0], e[1], e[2], a[0], a[1], a[2]
        ),
    }
}

fn stage_json(stage: &StageFound) -> Value {
    let buffer = &stage.buffer;
    match stage.outcome {
        StageOutcome::NotGiven => json!({ "buffer": buffer, "found": "not-given" }),
        StageOutcome::Fits => json!({ "buffer": buffer, "found": "fits" }),
        StageOutcome::Differs { pixels, first: (x, y) } => {
            json!({ "buffer": buffer, "found": "differs", "pixels": pixels, "first": { "x": x, "y": y } })
        }
        StageOutcome::AnotherSize { expected, actual } => {
            json!({ "buffer": buffer, "found": "another-size", "expected": expected, "actual": actual })
        }
    }
}

//! What pictures would be if a program had chosen otherwise where papers leave a choice, or where a setting is easily overlooked: told of a picture
//! that fails, never a reason to pass.
//!
//! Input: a stage, a view, a technique, what is allowed. Output: an [`Alternative`] for each other choice whose pictures are others, by one guess: of the
//! first envelope the one that allows most. Refuses: nothing; a choice by which the technique does not draw the scene, or of which nobody knows what
//! it draws, is left out. (Rules of ties and of interpolation are none of them: whichever a machine has, its pictures are allowed.)

use super::by_kind::{guesses, pictures};
use super::encoding::{encoded_by_tables, encoded_name, encoding};
use super::model::{Guess, View};
use crate::compare::{Allowed, Alternative, Hypothesis};
use crate::error::{Error, Result};
use crate::parameter::{Key, Named, Value};
use crate::scene::{BlendMode, BlendSpace, Diagonal};
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{self, Kind};
use crate::terrain::{Grid, Mesh};
use std::sync::Arc;

/// A technique's parameter, and values of it that programs are found to have.
type Tried = (&'static str, &'static [Setting]);

/// A value of a parameter.
#[derive(Debug, Clone, Copy)]
enum Setting {
    Word(&'static str),
    Whole(i64),
    Real(f64),
}

use Setting::{Real, Whole, Word};

/// What is tried of a technique's settings; the scene's own are among them.
const fn tried(kind: Kind) -> &'static [Tried] {
    match kind {
        Kind::StencilVolume => &[("joins", &[Word("none"), Word("style")]), ("samples", &[Whole(1)])],
        Kind::InverseProjection => &[
            ("point_in_polygon", &[Word("edge-normals"), Word("winding")]),
            ("corners", &[Word("centres"), Word("true")]),
            ("silhouette", &[Word("centre"), Word("smear")]),
            ("samples", &[Whole(1)]),
        ],
        Kind::StaticDecal => &[
            ("joins", &[Word("thesis"), Word("style")]),
            ("outlines", &[Word("side"), Word("polygon")]),
            ("samples", &[Whole(1), Whole(4), Whole(8), Whole(9)]),
        ],
        Kind::Clipmap => &[
            ("joints", &[Word("algorithm-1"), Word("method-1"), Word("method-2"), Word("style")]),
            ("polygons", &[Word("aliased"), Word("exact")]),
            ("overlaps", &[Word("blend"), Word("once")]),
            ("filter", &[Word("nearest"), Word("bilinear"), Word("trilinear"), Word("anisotropic")]),
            ("level_bias", &[Real(-0.5), Real(0.0), Real(0.5)]),
        ],
        Kind::DynamicLine => &[
            ("antialiasing", &[Word("none"), Word("fxaa")]),
            ("overlaps", &[Word("once"), Word("double")]),
            ("boxes", &[Word("mitred"), Word("overlapping"), Word("enclosing")]),
            ("thin_lines", &[Word("none"), Word("correction")]),
            ("sorting", &[Word("selection"), Word("none")]),
        ],
        Kind::GeometryOverlay => {
            &[("lines", &[Word("gl"), Word("antialiased")]), ("widths", &[Word("style"), Word("one")])]
        }
        Kind::Analytic => &[],
    }
}

/// Something that is chosen otherwise.
#[derive(Debug)]
enum Choice {
    Setting(&'static Key, Value),
    Space(BlendSpace),
    Mode(BlendMode),
    Diagonal(Diagonal),
}

/// What a technique's picture of a view would be by other choices; `allowed`: what it may be by the scene's own. `progress` is told the share that is done
/// (0..=1), from any thread.
///
/// # Errors
/// Internal errors only.
pub fn alternatives(
    kind: Kind,
    (stage, frame): (&Stage, &ViewFrame),
    allowed: &Allowed,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<Alternative>> {
    let choices = choices(kind, stage);
    let guess = guess(kind, (stage, frame));
    // As the alternatives are: the coarsest way to encode.
    let name = match encoding(kind, stage.scene.compositing.space) {
        Some(_) => encoded_name(&guess.name),
        None => guess.name.clone(),
    };
    let known = allowed.hypotheses.iter().find(|hypothesis| hypothesis.name == name);
    let mut found = Vec::new();
    for (k, choice) in choices.iter().enumerate() {
        let told = |share: f64| progress((k as f64 + share) / choices.len() as f64);
        let hypothesis = match picture(kind, (stage, frame), (choice, &guess), &told) {
            Ok(hypothesis) => hypothesis,
            Err(error) if error.is_internal() => return Err(error),
            Err(_) => continue,
        };
        let is_like = |known: &Hypothesis| {
            (&known.lo, &known.hi, &known.choices) == (&hypothesis.lo, &hypothesis.hi, &hypothesis.choices)
        };
        if known.is_none_or(|known| !is_like(known)) {
            let choice = choice.told(kind);
            found.push(Alternative { choice, hypothesis });
        }
    }
    Ok(found)
}

/// All that may be chosen otherwise than a stage has it.
fn choices(kind: Kind, stage: &Stage) -> Vec<Choice> {
    let scene = &stage.scene;
    let own = kind.parameters(&scene.technique);
    let mut all = Vec::new();
    for (name, settings) in tried(kind) {
        let Some(key) = kind.declaration().parameters.table.keys.iter().find(|key| key.name == *name) else {
            continue;
        };
        let values = settings.iter().map(|setting| match *setting {
            Word(word) => Value::Word(word),
            Whole(number) => Value::Integer(number),
            Real(number) => Value::Number(number),
        });
        let is_other = |value: &Value| !own.iter().any(|(known, own)| known == name && own == value);
        all.extend(values.filter(is_other).map(|value| Choice::Setting(key, value)));
    }
    let spaces = BlendSpace::NAMES.iter().filter(|(_, space)| *space != scene.compositing.space);
    all.extend(spaces.map(|(_, space)| Choice::Space(*space)));
    let modes = BlendMode::NAMES.iter().filter(|(_, mode)| *mode != scene.compositing.mode);
    all.extend(modes.map(|(_, mode)| Choice::Mode(*mode)));
    if let (Mesh::Grid(grid), None) = (&*stage.mesh, scene.lod) {
        let diagonals = Diagonal::NAMES.iter().filter(|(_, diagonal)| *diagonal != grid.diagonal());
        all.extend(diagonals.map(|(_, diagonal)| Choice::Diagonal(*diagonal)));
    }
    all
}

/// Of the first envelope's guesses the one that allows most.
fn guess(kind: Kind, (stage, frame): (&Stage, &ViewFrame)) -> Guess {
    let all = guesses(kind, &stage.scene.device, frame);
    let first = all[0].envelope;
    let mut of_first = all.into_iter().filter(|guess| guess.envelope == first);
    of_first.next_back().unwrap_or_else(|| Guess::of(first))
}

/// What a picture would be.
fn picture(
    kind: Kind,
    (stage, frame): (&Stage, &ViewFrame),
    (choice, guess): (&Choice, &Guess),
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Hypothesis> {
    let stage = choice.chosen(kind, stage)?;
    technique::applies(kind, &stage)?;
    if let Some(contradiction) = (kind.declaration().contradiction)(&stage.scene.technique) {
        return Err(Error::new(contradiction.what));
    }
    let guess = Guess { name: choice.slug(), ..guess.clone() };
    let pictures = pictures(kind, &View { stage: &stage, frame, progress }, std::slice::from_ref(&guess))?;
    let mut hypothesis = pictures.hypotheses.into_iter().next().unwrap_or_default();
    if let Some(by) = encoding(kind, stage.scene.compositing.space) {
        hypothesis = Hypothesis { name: guess.name, ..encoded_by_tables(&hypothesis, by) };
    }
    // To which side open pixels lean matters to nobody here.
    Ok(Hypothesis { says: choice.says(), extremes: Vec::new(), ..hypothesis })
}

impl Choice {
    /// A stage on which it is so.
    fn chosen(&self, kind: Kind, stage: &Stage) -> Result<Stage> {
        let (mut scene, mut mesh) = (stage.scene.clone(), Arc::clone(&stage.mesh));
        match self {
            Self::Setting(key, value) => scene.technique.say(kind.name(), key, value.clone()),
            Self::Space(space) => scene.compositing.space = *space,
            Self::Mode(mode) => scene.compositing.mode = *mode,
            Self::Diagonal(diagonal) => {
                scene.diagonal = *diagonal;
                if let Mesh::Grid(grid) = &*stage.mesh {
                    mesh = Arc::new(Mesh::Grid(Arc::new(Grid::new(grid.posts().clone(), *diagonal)?)));
                }
            }
        }
        Stage::of_draw_list(scene, stage.draw_list.clone(), mesh)
    }

    /// The key of the scene file and its value.
    fn key_and_value(&self, kind: Kind) -> (String, String) {
        let word = |key: &str, word: &'static str| (key.to_owned(), Value::Word(word).to_string());
        match self {
            Self::Setting(key, value) => {
                (format!("technique.{}.{}", kind.name(), key.name), value.to_string())
            }
            Self::Space(space) => word("compositing.space", space.word()),
            Self::Mode(mode) => word("compositing.mode", mode.word()),
            Self::Diagonal(diagonal) => word("terrain.diagonal", diagonal.word()),
        }
    }

    /// As `--set` has it.
    fn told(&self, kind: Kind) -> String {
        let (key, value) = self.key_and_value(kind);
        format!("{key}={value}")
    }

    /// A name for files.
    fn slug(&self) -> String {
        let (key, value) = match self {
            Self::Setting(key, value) => (key.name, value.to_string()),
            Self::Space(space) => ("space", space.word().to_owned()),
            Self::Mode(mode) => ("mode", mode.word().to_owned()),
            Self::Diagonal(diagonal) => ("diagonal", diagonal.word().to_owned()),
        };
        format!("with-{key}-{}", value.trim_matches('"')).replace('_', "-")
    }

    /// What it means.
    fn says(&self) -> String {
        match self {
            Self::Setting(key, Value::Word(word)) => key.shape.meaning(word).unwrap_or(key.doc).to_owned(),
            Self::Setting(key, _) => key.doc.to_owned(),
            Self::Space(space) => meaning(*space),
            Self::Mode(mode) => meaning(*mode),
            Self::Diagonal(diagonal) => meaning(*diagonal),
        }
    }
}

/// What a word for a setting means.
fn meaning<N: Named>(value: N) -> String {
    let at = N::NAMES.iter().position(|(_, known)| *known == value);
    at.map_or_else(String::new, |at| N::MEANINGS[at].to_owned())
}

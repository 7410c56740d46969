//! Who draws a case, and on which machine.

use super::figure::Figure;
use super::machine::{F64, Machine};
use super::picture::{Picture, differing, farthest, rmse, wrong_inside};
use super::setup::Setup;
use crate::error::Result;
use crate::scene_file::{Override, SceneFile};
use crate::source::load;
use crate::stage::Stage;
use crate::technique::{self, Frame, FrameOptions, Kind};
use crate::truth::{self, Budget, Truth};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Who draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Who {
    /// The truth, in doubles.
    Truth,
    /// A technique.
    Technique(Kind),
}

/// The truths of a case's scenes, each found once: by the text with its changes.
pub(super) type Truths = RefCell<BTreeMap<String, Rc<Picture>>>;

/// Draws a case's scenes.
pub(super) struct Hand<'a> {
    pub(super) who: Who,
    pub(super) machine: Machine,
    /// Settings of the technique, for all scenes.
    pub(super) settings: &'a [&'a str],
    pub(super) truths: &'a Truths,
}

impl Hand<'_> {
    /// The technique that draws.
    pub(super) fn kind(&self) -> Option<Kind> {
        match self.who {
            Who::Truth => None,
            Who::Technique(kind) => Some(kind),
        }
    }

    /// A technique with settings on the same machine.
    pub(super) fn by<'s>(&'s self, kind: Kind, settings: &'s [&'s str]) -> Hand<'s> {
        Hand { who: Who::Technique(kind), machine: self.machine, settings, truths: self.truths }
    }

    /// Whether it is exact mathematics that is imitated.
    pub(super) fn is_exact(&self) -> bool {
        self.machine == F64
    }

    /// A scene's picture, with changes to it.
    ///
    /// # Errors
    /// When the technique does not draw such a scene.
    pub(super) fn draw(&self, setup: &Setup, changes: &[&str]) -> Result<Picture> {
        match self.who {
            Who::Truth => Ok((*self.truth(setup, changes)?).clone()),
            Who::Technique(_) => {
                Ok(Picture::of_codes(&self.frame(setup, changes, &FrameOptions::default())?.image))
            }
        }
    }

    /// A technique's frame of a scene; the truth's is none.
    ///
    /// # Errors
    /// As [`Hand::draw`].
    pub(super) fn frame(&self, setup: &Setup, changes: &[&str], options: &FrameOptions) -> Result<Frame> {
        let kind = self.kind().ok_or_else(|| crate::Error::internal("the truth draws no frame"))?;
        let stage = stage(setup, &[self.machine.keys, self.settings, changes].concat())?;
        technique::prepare(kind, &stage)?.frame(&stage.view()?, options)
    }

    /// The right picture of a scene.
    ///
    /// # Errors
    /// When the scene is wrong.
    pub(super) fn truth(&self, setup: &Setup, changes: &[&str]) -> Result<Rc<Picture>> {
        let surface = setup.surface.as_ref().map_or(String::new(), |surface| format!("{surface:?}"));
        let name = [&setup.text, &changes.join("\n"), &surface].map(String::as_str).join("\n");
        if let Some(known) = self.truths.borrow().get(&name) {
            return Ok(Rc::clone(known));
        }
        let found = Rc::new(Picture::of_truth(&certified(setup, changes)?));
        self.truths.borrow_mut().insert(name, Rc::clone(&found));
        Ok(found)
    }

    /// How a scene's picture stands beside the truth: nothing is wrong where all around looks the same.
    ///
    /// # Errors
    /// As [`Hand::draw`].
    pub(super) fn against_truth(&self, setup: &Setup, changes: &[&str]) -> Result<Vec<Figure>> {
        let (right, drawn) = (self.truth(setup, changes)?, self.draw(setup, changes)?);
        Ok(vec![
            Figure::none("pixels wrong inside", wrong_inside(&drawn, &right)),
            Figure::told("rms to the truth", rmse(&drawn, &right)),
            Figure::told("largest difference", farthest(&drawn, &right)),
        ])
    }

    /// How two pictures that should be one compare: in exact mathematics no pixel differs, on a machine only at borders.
    pub(super) fn same(&self, drawn: &Picture, right: &Picture) -> Vec<Figure> {
        let differing = match self.who {
            // Both are the middles of intervals.
            Who::Truth => super::picture::differing_by(super::picture::STEP, drawn, right),
            Who::Technique(_) => differing(drawn, right),
        };
        if self.is_exact() {
            return vec![Figure::none("pixels that differ", differing)];
        }
        vec![
            Figure::told("pixels that differ", differing as f64),
            Figure::none("of them inside", wrong_inside(drawn, right)),
        ]
    }
}

/// A scene ready to be drawn.
///
/// # Errors
/// When the scene is wrong.
pub(super) fn stage(setup: &Setup, changes: &[&str]) -> Result<Stage> {
    let changes = changes.iter().map(|change| Override::parse(change)).collect::<Result<Vec<_>>>()?;
    let (mut scene, surface) = load::load(&SceneFile::parse(&setup.text, None, &changes)?, &|_| {})?;
    if let Some(edit) = setup.edit {
        edit(&mut scene);
    }
    Stage::new(scene, setup.surface.clone().unwrap_or(surface))
}

/// The truth of a scene.
///
/// # Errors
/// When the scene is wrong.
pub(super) fn certified(setup: &Setup, changes: &[&str]) -> Result<Truth> {
    let stage = stage(setup, changes)?;
    Ok(truth::certify(&stage, &stage.view()?, &Budget::default(), &|_| {}))
}

/// Figures of several scenes as one list: of each name and bound the worst.
pub(super) fn worst(all: impl IntoIterator<Item = Vec<Figure>>) -> Vec<Figure> {
    let mut worst: Vec<Figure> = Vec::new();
    for figure in all.into_iter().flatten() {
        match worst.iter_mut().find(|known| known.name == figure.name) {
            Some(known) => {
                let is_least = matches!(known.bound, super::figure::Bound::AtLeast(_));
                if (figure.value > known.value) != is_least {
                    known.value = figure.value;
                }
            }
            None => worst.push(figure),
        }
    }
    worst
}

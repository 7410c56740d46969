//! The corpus shown to the judge.

use super::bugs::{self, Bug};
use super::contrast;
use super::drawing::Subject;
use super::edit::Picture;
use super::judging::{Narrowness, Said, everything, judge, narrowness};
use super::scenes::{SCENES, SmallScene};
use super::variants::{MACHINES, Machine, VARIANTS, Variant};
use crate::allowed::allowed;
use crate::compare::{Allowed, Ruling};
use crate::error::{Error, ErrorKind, Result};
use crate::parallel;
use crate::scene_file::SceneText;
use crate::technique::{self, Kind};

/// What is tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Techniques; those without a model are told as such.
    pub kinds: Vec<Kind>,
    /// The one scene to try; `None`: all.
    pub scene: Option<String>,
    /// Only each n-th bug and variant, from the first on; at least 1.
    pub every: usize,
    /// A judge who allows everything: the test of the judge has to fail.
    pub blind: bool,
}

impl Default for Plan {
    /// All of it.
    fn default() -> Self {
        Self { kinds: Kind::ALL.to_vec(), scene: None, every: 1, blind: false }
    }
}

/// What the judge and the usual comparators said of everything.
#[derive(Debug, Clone, Default)]
pub struct Trial {
    pub(super) shown: Vec<Shown>,
    pub(super) subjects: Vec<Judged>,
    /// Whether it is the whole corpus.
    pub(super) is_whole: bool,
    /// Techniques that nobody can judge, with the reason.
    pub(super) without_model: Vec<(Kind, String)>,
}

/// A scene by a technique that has been judged.
#[derive(Debug, Clone)]
pub(super) struct Judged {
    pub(super) kind: Kind,
    pub(super) scene: &'static str,
    pub(super) narrowness: Narrowness,
}

/// A picture that the judge was shown.
#[derive(Debug, Clone)]
pub(super) struct Shown {
    pub(super) kind: Kind,
    pub(super) scene: &'static str,
    /// Its bug's or variant's name, with that of the machine where it is not the scene's own.
    pub(super) name: String,
    /// `None`: a legitimate variant.
    pub(super) bug: Option<bugs::Class>,
    /// What the judge says; `None`: it is the right picture, bit for bit (of bugs; a variant is judged nevertheless).
    pub(super) said: Option<Said>,
    /// Which of the usual comparators let it pass.
    pub(super) contrast: [bool; 4],
}

impl Shown {
    /// The verdict.
    pub(super) fn ruling(&self) -> Option<Ruling> {
        self.said.map(|said| said.ruling)
    }
}

/// Shows the corpus to the judge. `progress` is told the share that is done (0..=1), from any thread.
///
/// # Errors
/// When there is no such scene, or a scene of the corpus cannot be drawn.
pub fn run(plan: &Plan, progress: &(dyn Fn(f64) + Sync)) -> Result<Trial> {
    let scenes: Vec<&SmallScene> =
        SCENES.iter().filter(|scene| plan.scene.as_deref().is_none_or(|name| name == scene.name)).collect();
    if scenes.is_empty() {
        let names: Vec<&str> = SCENES.iter().map(|scene| scene.name).collect();
        return Err(Error::usage("there is no such scene").help(format!("one of {}", names.join(", "))));
    }
    let places: Vec<(&SmallScene, Kind)> =
        scenes.iter().flat_map(|scene| plan.kinds.iter().map(move |kind| (*scene, *kind))).collect();
    let parts = parallel::map_telling(places.len(), progress, |k| {
        let (scene, kind) = places[k];
        of_subject(plan, scene, kind)
            .map_err(|error| error.reworded(|what| format!("{}: {what}", scene.name)))
    });
    let is_whole = plan.scene.is_none() && plan.every <= 1;
    let mut trial = Trial { is_whole, ..Trial::default() };
    for part in parts {
        let part = part?;
        trial.shown.extend(part.shown);
        trial.subjects.extend(part.subjects);
        for (kind, reason) in part.without_model {
            if !trial.without_model.iter().any(|(known, _)| *known == kind) {
                trial.without_model.push((kind, reason));
            }
        }
    }
    Ok(trial)
}

fn of_subject(plan: &Plan, scene: &SmallScene, kind: Kind) -> Result<Trial> {
    let text = SceneText::parse(scene.text, None, &[])?;
    let subject = Subject { text: &text, kind, machine: &[] };
    let stage = subject.stage()?;
    let mut trial = Trial::default();
    if technique::applies(kind, &stage).is_err() {
        return Ok(trial);
    }
    let allowed = match allowed(kind, (&stage, &stage.view()?), &|_| {}) {
        Ok(allowed) => allowed,
        Err(error) if error.kind() == ErrorKind::Unsupported => {
            trial.without_model.push((kind, error.what().to_owned()));
            return Ok(trial);
        }
        Err(error) => return Err(error),
    };
    trial.subjects.push(Judged { kind, scene: scene.name, narrowness: narrowness(&allowed) });
    let allowed = if plan.blind { everything(&allowed) } else { allowed };
    let trier = Trier { scene: scene.name, subject, right: &subject.right()?, allowed: &allowed };
    let bugs: Vec<&Bug> =
        bugs::all().into_iter().filter(|bug| bug.can_be_of(kind)).step_by(plan.every.max(1)).collect();
    for shown in parallel::map(&bugs, |bug| trier.bug(bug)) {
        trial.shown.extend(shown?);
    }
    let machines = MACHINES.iter().filter(|machine| machine.fits(&stage.scene.device));
    let variants: Vec<(&Machine, &Variant)> = machines
        .flat_map(|machine| VARIANTS.iter().map(move |variant| (machine, variant)))
        .filter(|(_, variant)| !variant.not.contains(&kind))
        .step_by(plan.every.max(1))
        .collect();
    for shown in parallel::map(&variants, |(machine, variant)| trier.variant(machine, variant)) {
        trial.shown.extend(shown?);
    }
    Ok(trial)
}

/// A scene by a technique, with its right picture and what is allowed.
struct Trier<'a> {
    scene: &'static str,
    subject: Subject<'a>,
    right: &'a Picture,
    allowed: &'a Allowed,
}

impl Trier<'_> {
    /// The verdict on a bug; `None`: the scene has nothing that it is a bug of.
    fn bug(&self, bug: &Bug) -> Result<Option<Shown>> {
        let Some(picture) = self.subject.edited(&bug.edit, self.right)? else { return Ok(None) };
        self.shown(bug.name.to_owned(), Some(bug.class), &picture).map(Some)
    }

    /// The verdict on a variant; `None`: the scene has nothing that is otherwise in it.
    fn variant(&self, machine: &Machine, variant: &Variant) -> Result<Option<Shown>> {
        let subject = Subject { machine: machine.keys, ..self.subject };
        let picture = match &variant.edit {
            None => Some(subject.right()?),
            Some(edit) => subject.edited(edit, self.right)?,
        };
        let name = format!("{}, by a machine: {}", variant.name, machine.name);
        picture.map(|picture| self.shown(name, None, &picture)).transpose()
    }

    fn shown(&self, name: String, bug: Option<bugs::Class>, picture: &Picture) -> Result<Shown> {
        let is_right = picture.values() == self.right.values();
        let said = if bug.is_some() && is_right { None } else { Some(judge(self.allowed, picture)?) };
        let contrast = if is_right { [true; 4] } else { contrast::passed(self.right, picture) };
        Ok(Shown { kind: self.subject.kind, scene: self.scene, name, bug, said, contrast })
    }
}

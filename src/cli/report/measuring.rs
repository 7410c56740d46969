//! All runs of a scene: the truth, each technique over its sweep, supersampling.

use super::notable::Notable;
use crate::cli::bar::Bar;
use crate::cli::measure::{Certified, Drawn, applicable, device_words, scene_result, timed, unequal};
use crate::cli::scene_input::SceneInput;
use drapery::buffer::Buffer;
use drapery::compare::{Difference, Expected, Image};
use drapery::output::ByName;
use drapery::report::sweep::{self, Variation};
use drapery::report::{self, Errors, Exhibit, Run, SUPERSAMPLING, SceneReport, TRUTH, Times};
use drapery::resolve::code_values;
use drapery::sampling::{Sampled, sample};
use drapery::scene::{Device, TechniqueSettings};
use drapery::space::ViewFrame;
use drapery::stage::Stage;
use drapery::technique::{self, Kind};
use drapery::truth::Budget;
use drapery::{Error, Result};

/// Samples a side of a pixel that supersampling is tried with.
const SAMPLES: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];
/// The most samples of a picture, so that a report of a large one comes to its end. (A limit of time would make the rows depend on
/// the machine.)
const MOST_SAMPLES: usize = 1 << 28;

/// Widths of the truth that are tried besides the reference's own, where they are narrower.
const WIDTHS: [f64; 2] = [1e-4, 1e-6];

/// A scene's numbers and pictures.
pub(super) struct Measured {
    pub(super) report: SceneReport,
    pub(super) exhibits: Vec<Exhibit>,
}

/// A scene being measured.
pub(super) struct Measuring<'a> {
    input: &'a SceneInput,
    stage: Stage,
    view: ViewFrame,
    certified: Certified,
    repeat: u32,
    bar: &'a Bar,
    runs: Vec<Run>,
    exhibits: Vec<Exhibit>,
}

impl<'a> Measuring<'a> {
    /// Loads the scene and computes its truth.
    pub(super) fn new(input: &'a SceneInput, budget: &Budget, repeat: u32, bar: &'a Bar) -> Result<Self> {
        let stage = input.stage(bar)?;
        let view = stage.view()?;
        let certified = Certified::of((&stage, &view), budget, repeat, bar)?;
        Ok(Self { input, stage, view, certified, repeat, bar, runs: Vec::new(), exhibits: Vec::new() })
    }

    /// The truth as a run, and narrower ones: what certainty costs.
    pub(super) fn truth(&mut self) -> Result<()> {
        let (run, doubt) = truth_run(&self.certified, Vec::new())?;
        let image = self.certified.truth.image();
        let caption = "the right picture · its heat map: half the width of each interval".to_owned();
        self.exhibits.push(Exhibit::new((TRUTH.to_owned(), caption), &image, &doubt)?);
        self.runs.push(run);
        let budget = self.certified.budget;
        for width in WIDTHS.into_iter().filter(|width| *width < budget.width) {
            let narrower = Budget { width, ..budget };
            let certified = Certified::of((&self.stage, &self.view), &narrower, self.repeat, self.bar)?;
            self.runs.push(truth_run(&certified, vec![format!("width={width}")])?.0);
        }
        Ok(())
    }

    /// Every technique that draws the scene.
    pub(super) fn techniques(&mut self) -> Result<()> {
        for kind in applicable(&self.stage, self.bar)? {
            let tries = tries(sweep::variations(&kind.declaration().sweep), self.input)?;
            let mut notable = Notable::default();
            for (k, one) in tries.iter().enumerate() {
                self.bar.start(&format!("{} {}/{}", kind.name(), k + 1, tries.len()));
                self.stage.scene.technique = one.technique.clone();
                self.stage.scene.device = one.device;
                if let Some(run) = self.technique(kind, one, &mut notable)? {
                    self.runs.push(run);
                }
            }
            self.exhibits.extend(notable.exhibits()?);
        }
        Ok(())
    }

    /// A technique at one setting; `None` where it refuses that, which is told.
    fn technique(&self, kind: Kind, one: &Try, notable: &mut Notable) -> Result<Option<Run>> {
        let varied = sweep::words(&one.variation.changes);
        if let Err(error) = technique::applies(kind, &self.stage) {
            let what = format!("note: {} {} is left out: {}", kind.name(), varied.join(" "), error.what());
            return if error.is_internal() { Err(error) } else { Ok((self.bar.say(&what), None).1) };
        }
        let drawn = Drawn::by(kind, (&self.stage, &self.view), (self.repeat, &|_| false), self.bar)?;
        let image = &drawn.frame.image;
        let difference = self.certified.difference(&Image::from_rgba8(image)?)?;
        let run = Run {
            technique: kind.name().into(),
            varied,
            is_own: one.is_own,
            line: one.variation.line.clone(),
            parameters: drawn.parameters,
            device: device_words(&self.stage.scene.device),
            prepare_ms: drawn.prepare,
            frame_ms: drawn.draw,
            structure_bytes: drawn.structure_bytes,
            counts: ByName::from_pairs(drawn.frame.counts.iter().copied()),
            error: self.errors(&difference, image),
            is_rounded: true,
            image_hash: image.hash(),
            on_front: false,
        };
        notable.offer(&run, image, &difference);
        Ok(Some(run))
    }

    /// Plain supersampling with more and more samples.
    pub(super) fn supersampling(&mut self) -> Result<()> {
        let pixels = self.view.width() * self.view.height();
        let mut notable = Notable::default();
        for n in SAMPLES.into_iter().filter(|n| *n == 1 || n * n * pixels <= MOST_SAMPLES) {
            self.bar.start(&format!("{SUPERSAMPLING} {n} x {n}"));
            let (sampled, times) = self.sampled(n)?;
            let codes = sampled.colors.values().iter().map(|color| code_values(*color)).collect();
            let image = Buffer::from_values(sampled.colors.width(), sampled.colors.height(), codes);
            let difference = self.certified.difference(&report::image(&sampled.colors)?)?;
            let run = Run {
                technique: SUPERSAMPLING.into(),
                varied: vec![format!("n={n}")],
                is_own: false,
                line: Some(String::new()),
                parameters: ByName::from_pairs([("n", n)]),
                device: device_words(&Device::default()),
                prepare_ms: Times::of(Vec::new()),
                frame_ms: times,
                structure_bytes: sampled.structure_bytes,
                counts: ByName::from_pairs([("samples", n * n * pixels)]),
                error: self.errors(&difference, &image),
                is_rounded: false,
                image_hash: image.hash(),
                on_front: false,
            };
            notable.offer(&run, &image, &difference);
            self.runs.push(run);
        }
        self.exhibits.extend(notable.exhibits()?);
        Ok(())
    }

    /// A supersampled picture, drawn as often as is asked for.
    fn sampled(&self, n: usize) -> Result<(Sampled, Times)> {
        let once = || timed(|| Ok(sample(&self.stage, &self.view, n, &|share| self.bar.done(share))));
        let (sampled, first) = once()?;
        let mut times = vec![first];
        for _ in 1..self.repeat {
            let (again, ms) = once()?;
            if again.colors != sampled.colors {
                return Err(unequal(SUPERSAMPLING));
            }
            times.push(ms);
        }
        Ok((sampled, Times::of(times)))
    }

    fn errors(&self, difference: &Difference, image: &Buffer<[u8; 4]>) -> Errors {
        let flip = report::flip(&self.certified.truth.image(), image);
        Errors::of(&difference.metrics(0.0), flip)
    }

    /// The scene's part of the report.
    pub(super) fn finish(self) -> Measured {
        let mut report = SceneReport {
            scene: scene_result(&self.stage, &self.input.file),
            width: self.view.width(),
            height: self.view.height(),
            notes: self.stage.scene.notes.clone(),
            reference_width_max: self.certified.truth.widest(),
            runs: self.runs,
        };
        report.mark_front();
        Measured { report, exhibits: self.exhibits }
    }
}

/// A setting to try, as the scene then says it.
struct Try {
    variation: Variation,
    technique: TechniqueSettings,
    device: Device,
    /// Whether it is the scene's own.
    is_own: bool,
}

/// The settings of a sweep in a scene, each once: where a line of the plot has the scene's own, that is it.
fn tries(variations: Vec<Variation>, input: &SceneInput) -> Result<Vec<Try>> {
    let mut all: Vec<Try> = Vec::new();
    for variation in variations {
        let file = input.changed(&variation.changes)?;
        let mut one = Try { variation, technique: file.technique, device: file.device, is_own: false };
        let is_same = |known: &Try| known.technique == one.technique && known.device == one.device;
        match all.iter().position(is_same) {
            None => one.is_own = all.is_empty(),
            Some(at)
                if all[at].is_own && all[at].variation.line.is_none() && one.variation.line.is_some() =>
            {
                all.remove(at);
                one.is_own = true;
            }
            Some(_) => continue,
        }
        all.push(one);
    }
    Ok(all)
}

/// A truth as a run: its error is what its estimate may be off, the half widths that are returned with it.
fn truth_run(certified: &Certified, varied: Vec<String>) -> Result<(Run, Difference)> {
    let halves = report::half_widths(&certified.truth)?;
    let nothing = Image::new(halves.width(), halves.height(), 4, vec![0.0; halves.values().len()])?;
    let doubt = Difference::of(&Expected::exactly(nothing), &halves)
        .map_err(|what| Error::internal(format!("the truth's widths: {what}")))?;
    let run = Run {
        technique: TRUTH.into(),
        varied,
        is_own: false,
        line: None,
        parameters: certified.parameters(),
        device: device_words(&Device::default()),
        prepare_ms: Times::of(Vec::new()),
        frame_ms: certified.times,
        structure_bytes: certified.truth.structure_bytes,
        counts: certified.counts(),
        error: Errors::of(&doubt.metrics(0.0), None),
        is_rounded: false,
        image_hash: certified.truth.image().hash(),
        on_front: false,
    };
    Ok((run, doubt))
}

//! All runs of a scene: the truth, each technique over its sweep, supersampling.

use super::notable::Notable;
use super::sweep::{self, Variation};
use super::{Errors, Exhibit, Run, SUPERSAMPLING, SceneReport, TRUTH, flip};
use crate::buffer::Buffer;
use crate::compare::{Difference, Expected, Image};
use crate::error::{Error, Result};
use crate::measure::{self, Certified, Drawn, Times, Watch};
use crate::measure::{applicable, device_words, supersampled, touched, view_result};
use crate::open::Opened;
use crate::output::ByName;
use crate::resolve::code_values;
use crate::scene::{Device, TechniqueSettings};
use crate::scene_file::SceneText;
use crate::space::ViewFrame;
use crate::technique::{self, Kind};
use crate::truth::Budget;

/// Samples a side of a pixel that supersampling is tried with.
const SAMPLES: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];
/// The most samples of a picture, so that a report of a large one comes to its end. (A limit of time would make the rows depend on
/// the machine.)
const MOST_SAMPLES: usize = 1 << 28;

/// What is told of a scene in whose view no feature is.
const NOTHING_TO_SCORE: &str =
    "no feature of a layer is in view: there is nothing to score, and no technique was measured";

/// Widths of the truth that are tried besides the reference's own, where they are narrower.
const WIDTHS: [f64; 2] = [1e-4, 1e-6];

/// A scene's numbers and pictures.
#[derive(Debug)]
pub struct Measured {
    /// The numbers.
    pub report: SceneReport,
    /// The pictures, the most important first.
    pub exhibits: Vec<Exhibit>,
}

/// Measures a scene: the truth, every technique that draws it over the settings of its sweep, and supersampling, each `repeat` times
/// (at least once).
///
/// # Errors
/// When the camera shows nothing; internal errors. A technique that refuses a setting is left out, and the watch is told.
pub fn measure(scene: Opened, budget: &Budget, repeat: u32, watch: &dyn Watch) -> Result<Measured> {
    let mut measuring = Measuring::new(scene, budget, repeat, watch)?;
    if measuring.has_features() {
        measuring.truth()?;
        measuring.techniques()?;
        measuring.supersampling()?;
    } else {
        measuring.refuse_to_score()?;
    }
    Ok(measuring.finish())
}

/// A scene being measured.
struct Measuring<'a> {
    scene: Opened,
    view: ViewFrame,
    certified: Certified,
    /// For each pixel, whether features touch it.
    touched: Vec<bool>,
    notes: Vec<String>,
    repeat: u32,
    watch: &'a dyn Watch,
    runs: Vec<Run>,
    exhibits: Vec<Exhibit>,
}

impl<'a> Measuring<'a> {
    /// Computes the scene's truth.
    fn new(scene: Opened, budget: &Budget, repeat: u32, watch: &'a dyn Watch) -> Result<Self> {
        let view = scene.view()?;
        let certified = Certified::of((&scene.stage, &view), budget, repeat, watch)?;
        let touched = touched(&scene.stage, &view, watch);
        let notes = scene.notes().to_vec();
        let (runs, exhibits) = (Vec::new(), Vec::new());
        Ok(Self { scene, view, certified, touched, notes, repeat, watch, runs, exhibits })
    }

    fn has_features(&self) -> bool {
        self.touched.contains(&true)
    }

    /// Where no feature is in view every technique draws the same ground: scores would tell nothing of it.
    fn refuse_to_score(&mut self) -> Result<()> {
        self.notes.push(NOTHING_TO_SCORE.into());
        let (_, doubt) = self.truth_run(&self.certified, Vec::new())?;
        let caption = "the right picture · its heat map: half the width of each interval".to_owned();
        self.exhibits.push(Exhibit::new((TRUTH.to_owned(), caption), &self.certified.truth.image(), &doubt)?);
        Ok(())
    }

    /// The errors of a run: of all pixels, and of those that features touch.
    fn errors_of(&self, difference: &Difference, flip: Option<f64>) -> [Errors; 2] {
        let of = |difference: &Difference, flip| Errors::of(&difference.metrics(0.0), flip);
        let whole = of(difference, flip);
        [whole, difference.among(&self.touched).map_or(whole, |some| of(&some, None))]
    }

    /// The truth as a run, and narrower ones: what certainty costs.
    fn truth(&mut self) -> Result<()> {
        let (run, doubt) = self.truth_run(&self.certified, Vec::new())?;
        let image = self.certified.truth.image();
        let caption = "the right picture · its heat map: half the width of each interval".to_owned();
        self.exhibits.push(Exhibit::new((TRUTH.to_owned(), caption), &image, &doubt)?);
        self.runs.push(run);
        let budget = self.certified.budget;
        for width in WIDTHS.into_iter().filter(|width| *width < budget.width) {
            let narrower = Budget { width, ..budget };
            let certified =
                Certified::of((&self.scene.stage, &self.view), &narrower, self.repeat, self.watch)?;
            self.runs.push(self.truth_run(&certified, vec![format!("width={width}")])?.0);
        }
        Ok(())
    }

    /// Every technique that draws the scene.
    fn techniques(&mut self) -> Result<()> {
        for kind in applicable(&self.scene.stage, self.watch)? {
            let tries = tries(sweep::variations(&kind.declaration().sweep), &self.scene.text)?;
            let mut notable = Notable::default();
            for (k, one) in tries.iter().enumerate() {
                self.watch.start(&format!("{} {}/{}", kind.name(), k + 1, tries.len()));
                let scene = &mut self.scene.stage.scene;
                (scene.technique, scene.device) = (one.technique.clone(), one.device);
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
        let stage = &self.scene.stage;
        if let Err(error) = technique::applies(kind, stage) {
            if error.is_internal() {
                return Err(error);
            }
            let what = format!("{} {} is left out: {}", kind.name(), varied.join(" "), error.what());
            self.watch.note(&what);
            return Ok(None);
        }
        let drawn = Drawn::by(kind, (stage, &self.view), (self.repeat, &|_| false), self.watch)?;
        let image = &drawn.frame.image;
        let difference = self.certified.difference(&Image::from_rgba8(image)?)?;
        let [error, error_on_features] = self.errors(&difference, image);
        let run = Run {
            technique: kind.name().into(),
            varied,
            is_own: one.is_own,
            line: one.variation.line.clone(),
            parameters: drawn.parameters,
            device: device_words(&stage.scene.device),
            prepare_ms: drawn.prepare,
            frame_ms: drawn.draw,
            structure_bytes: drawn.structure_bytes,
            counts: ByName::from_pairs(drawn.frame.counts.iter().copied()),
            error,
            error_on_features,
            is_rounded: true,
            image_hash: image.hash(),
            on_front: false,
        };
        notable.offer(&run, image, &difference);
        Ok(Some(run))
    }

    /// Plain supersampling with more and more samples.
    fn supersampling(&mut self) -> Result<()> {
        let pixels = self.view.width() * self.view.height();
        let mut notable = Notable::default();
        for n in SAMPLES.into_iter().filter(|n| *n == 1 || n * n * pixels <= MOST_SAMPLES) {
            self.watch.start(&format!("{SUPERSAMPLING} {n} x {n}"));
            let drawn = (&self.scene.stage, &self.view);
            let (sampled, times) = supersampled(drawn, n, self.repeat, self.watch)?;
            let codes = sampled.colors.values().iter().map(|color| code_values(*color)).collect();
            let image = Buffer::from_values(sampled.colors.width(), sampled.colors.height(), codes);
            let difference = self.certified.difference(&measure::image(&sampled.colors)?)?;
            let [error, error_on_features] = self.errors(&difference, &image);
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
                error,
                error_on_features,
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

    fn errors(&self, difference: &Difference, image: &Buffer<[u8; 4]>) -> [Errors; 2] {
        self.errors_of(difference, flip(&self.certified.truth.image(), image))
    }

    /// A truth as a run: its error is what its estimate may be off, the half widths that are returned with it.
    fn truth_run(&self, certified: &Certified, varied: Vec<String>) -> Result<(Run, Difference)> {
        let halves = measure::half_widths(&certified.truth)?;
        let nothing = Image::new(halves.width(), halves.height(), 4, vec![0.0; halves.values().len()])?;
        let doubt = Difference::of(&Expected::exactly(nothing), &halves)
            .map_err(|what| Error::internal(format!("the truth's widths: {what}")).caused_by(what))?;
        let [error, error_on_features] = self.errors_of(&doubt, None);
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
            error,
            error_on_features,
            is_rounded: false,
            image_hash: certified.truth.image().hash(),
            on_front: false,
        };
        Ok((run, doubt))
    }

    /// The scene's part of the report.
    fn finish(self) -> Measured {
        let mut report = SceneReport {
            scene: view_result(&self.scene.stage, &self.view, &self.scene.text.file.hash),
            width: self.view.width(),
            height: self.view.height(),
            notes: self.notes,
            reference_width_max: self.certified.truth.widest(),
            feature_pixels: self.touched.iter().filter(|is_touched| **is_touched).count(),
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
fn tries(variations: Vec<Variation>, scene: &SceneText) -> Result<Vec<Try>> {
    let mut all: Vec<Try> = Vec::new();
    for variation in variations {
        let file = scene.changed(&variation.changes)?;
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

//! A scene drawn into a folder: what `drapery render` writes.

use super::Buffers;
use super::picked::Picked;
use super::run_files::RunFiles;
use crate::buffer::Plane;
use crate::error::Result;
use crate::measure::{Certified, Watch, view_result};
use crate::output::{Batch, PickResult, RESULT_SCHEMA, RenderResult};
use crate::scene::Column;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{Kind, no_such_pixel};
use crate::truth::{self, Budget, PixelCoverage, Touched};

/// Pictures to be made: `T.png` and the wanted buffers of each technique T, and `result.json`.
#[derive(Debug, Clone, Copy)]
pub struct Pictures<'a> {
    /// What is drawn.
    pub stage: &'a Stage,
    /// The hash of its scene file (`SceneFile::hash`), for `result.json`.
    pub hash: &'a str,
    /// Whether the truth's own picture is written.
    pub truth: bool,
    /// Whether distances from the truth are told, for which it must be computed; where its picture is written, they are.
    pub errors: bool,
    /// By what it is drawn.
    pub techniques: &'a [Kind],
    /// The buffers that are written beside the pictures.
    pub buffers: &'a Buffers,
    /// A pixel (column, row), if it is to be told what there is at it.
    pub pick: Option<[usize; 2]>,
    /// The columns of attributes of each layer, for what is told of items; may be empty.
    pub attributes: &'a [Vec<Column>],
    /// How exact the truth is.
    pub budget: &'a Budget,
    /// How many runs are timed, at least 1; told are the medians.
    pub repeat: u32,
}

impl Pictures<'_> {
    /// Draws and writes; the files are in their places when it returns what `result.json` says.
    ///
    /// # Errors
    /// When a technique does not draw such a scene, or a file cannot be written: then no file is.
    pub fn write(&self, mut batch: Batch, watch: &dyn Watch) -> Result<RenderResult> {
        self.check_pixel()?;
        let view = self.stage.view()?;
        let truths = if self.truth { self.repeat } else { 1 };
        let certify = || Certified::of((self.stage, &view), self.budget, truths, watch);
        let certified = (self.truth || self.errors).then(certify).transpose()?;
        let buffers = if self.pick.is_some() { &self.buffers.with_picks() } else { self.buffers };
        let mut files = RunFiles {
            stage: self.stage,
            view: &view,
            certified: certified.as_ref(),
            buffers,
            // What is made to be asked about one pixel is no file.
            is_elsewhere: &|name| !self.buffers.wants(name),
            batch: &mut batch,
            watch,
        };
        let mut picked = Picked::new(self.stage, self.attributes, (self.pick, self.buffers.wants_picks()));
        let mut runs = Vec::new();
        if let Some(certified) = certified.as_ref().filter(|_| self.truth) {
            let (planes, coverage) = self.touched((&view, buffers), watch);
            picked.take(truth::NAME, &planes, coverage.as_ref());
            runs.push(files.truth(certified, &planes)?);
        }
        for kind in self.techniques {
            let (run, frame) = files.technique(*kind, self.repeat)?;
            picked.take(kind.name(), &frame.planes, None);
            runs.push(run);
        }
        let (at_pixel, items) = picked.told();
        let result = RenderResult {
            schema: RESULT_SCHEMA,
            scene: view_result(self.stage, &view, self.hash),
            notes: self.stage.scene.notes.clone(),
            runs,
            pick: self.pick.map(|pixel| PickResult { pixel, runs: at_pixel }),
            items: buffers.wants_picks().then_some(items),
        };
        let text = result.to_json()?;
        batch.stage("result.json", |to| to.write_all(text.as_bytes()))?;
        batch.commit()?;
        Ok(result)
    }
}

impl Pictures<'_> {
    /// The truth's buffers of which items touch pixels, where they are wanted, and what covers the pixel that is asked about.
    fn touched(
        &self,
        (view, buffers): (&ViewFrame, &Buffers),
        watch: &dyn Watch,
    ) -> (Vec<Plane>, Option<PixelCoverage>) {
        if !buffers.wants_picks() {
            return (Vec::new(), None);
        }
        watch.part("items");
        let Touched { touches, coverage } =
            Touched::of(self.stage, view, self.budget, &|share| watch.done(share));
        let at_pixel = self.pick.map(|[x, y]| coverage.at(x, y).clone());
        (touches.planes(view.height(), &|name| buffers.wants(name)), at_pixel)
    }

    /// Refuses a pixel that is not in the picture.
    fn check_pixel(&self) -> Result<()> {
        let (width, height) = (self.stage.scene.image.width, self.stage.scene.image.height);
        match self.pick {
            Some([x, y]) if x >= width || y >= height => Err(no_such_pixel([x, y], [width, height])),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    /// Who writes down which steps there are.
    #[derive(Default)]
    struct Steps(Mutex<Vec<String>>);

    impl Watch for Steps {
        fn milliseconds(&self) -> f64 {
            0.0
        }

        fn start(&self, what: &str) {
            self.0.lock().unwrap().push(what.to_owned());
        }

        fn part(&self, what: &str) {
            self.0.lock().unwrap().push(format!("- {what}"));
        }
    }

    /// The steps of drawing by a technique, and whether its run tells an error.
    fn steps(truth: bool, errors: bool) -> (Vec<String>, bool) {
        let scene = crate::Opened::parse(crate::tutorial::SMALL_SCENE).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let buffers = Buffers::named(&[], truth, &[Kind::StencilVolume]).unwrap();
        let pictures = Pictures {
            stage: &scene.stage,
            hash: "",
            truth,
            errors,
            techniques: &[Kind::StencilVolume],
            buffers: &buffers,
            pick: None,
            attributes: &[],
            budget: &Budget::default(),
            repeat: 1,
        };
        let watch = Steps::default();
        let result = pictures.write(Batch::into(folder.path()).unwrap(), &watch).unwrap();
        (watch.0.into_inner().unwrap(), result.runs.iter().all(|run| run.error.is_some()))
    }

    #[test]
    fn the_truth_is_computed_where_it_or_an_error_is_wanted_and_only_there() {
        let technique = ["stencil-volume", "- preparing", "- drawing"];
        let all = ["truth", "stencil-volume", "- preparing", "- drawing"];
        assert_eq!(steps(false, false), (technique.map(String::from).to_vec(), false));
        assert_eq!(steps(false, true), (all.map(String::from).to_vec(), true));
        assert_eq!(steps(true, false), (all.map(String::from).to_vec(), true));
    }
}

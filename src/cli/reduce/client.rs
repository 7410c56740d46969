//! The program that draws bundles, and what the judge says of it.

use super::folder::Folder;
use drapery::compare::{Gates, Judge, Judgement};
use drapery::output::Batch;
use drapery::reduce::{Draft, Failing, SCENE_FILE};
use drapery::technique::Kind;
use drapery::{Budget, Bundle, Error, Opened, Result};
use std::fs::File;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// A program that draws bundles.
pub(super) struct Client {
    command: String,
    kind: Kind,
    timeout: Duration,
    place: Folder,
}

/// What became of a drawing.
pub(super) enum Drawing {
    /// How it fails; `None`: it is right.
    Judged(Option<Failing>),
    /// Nothing was drawn.
    Broken(Error),
}

/// How often it is looked whether the program has ended.
const LOOK: Duration = Duration::from_millis(2);

/// So much of what it says is shown, bytes.
const SHOWN: usize = 1000;

/// The truth in bundles that nobody but the program reads need not be exact.
const BUDGET: Budget = Budget { width: 1.0, depth: 0, coverage: false };

impl Client {
    /// A command of the shell that draws by a technique.
    ///
    /// # Errors
    /// When there is no room for bundles.
    pub(super) fn new(command: &str, kind: Kind, timeout: Duration) -> Result<Self> {
        // The folders are the shell's own arguments: nothing in their names is read by it.
        let has_places = command.contains("{}") || command.contains("{out}");
        let command = match has_places {
            true => command.replace("{}", "\"$1\"").replace("{out}", "\"$2\""),
            false => format!("{command} \"$@\""),
        };
        Ok(Self { command, kind, timeout, place: Folder::new()? })
    }

    /// Has a draft drawn, and judges it. A draft that cannot be drawn by the technique is one without failure.
    ///
    /// # Errors
    /// When bundles cannot be written, or the shell cannot be called.
    pub(super) fn drawn(&self, draft: &Draft) -> Result<Drawing> {
        let Ok(scene) = Opened::parse(&draft.text()) else { return Ok(Drawing::Judged(None)) };
        let (bundle, frames) = (self.place.empty("bundle")?, self.place.empty("frames")?);
        let mut batch = Batch::into(&bundle)?;
        let text = draft.text();
        batch.stage(SCENE_FILE, |to| to.write_all(text.as_bytes()))?;
        let made =
            Bundle { budget: BUDGET, hash: &scene.text.file.hash, ..Bundle::of(&scene.stage, self.kind) };
        if let Err(error) = made.write(batch, &drapery::measure::Unwatched) {
            return Ok(Drawing::Broken(error));
        }
        if let Err(error) = self.called(&bundle, &frames) {
            return Ok(Drawing::Broken(error));
        }
        let judged = Judge::read(&bundle).and_then(|judge| {
            let frame = judge.frame(&frames)?;
            Ok(failing(&judge.judge(&frame, Gates::default())))
        });
        Ok(judged.map_or_else(Drawing::Broken, Drawing::Judged))
    }

    /// Calls the program.
    fn called(&self, bundle: &Path, frames: &Path) -> Result<()> {
        let log = self.place.path().join("said");
        let refuse = |error| Error::io("the command cannot be called", error);
        let said = File::create(&log).map_err(refuse)?;
        let mut command = Command::new("sh");
        command.arg("-c").arg(&self.command).arg("sh").arg(bundle).arg(frames);
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(said);
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn().map_err(refuse)?;
        let status = self.ended(&mut child).map_err(refuse)?;
        let said = || {
            let text = std::fs::read(&log).unwrap_or_default();
            String::from_utf8_lossy(&text[text.len().saturating_sub(SHOWN)..]).trim().to_owned()
        };
        match status {
            Some(status) if status.success() => Ok(()),
            Some(status) => Err(Error::new(format!("the command failed ({status}): {}", said()))
                .help("it is called with the folder of a bundle and an empty one for its frame")),
            None => Err(Error::new(format!("the command did not end in {} s", self.timeout.as_secs_f64()))
                .help("give it more time: --timeout S")),
        }
    }

    /// How a program ended; `None`: it did not, and was stopped.
    #[expect(clippy::disallowed_methods, reason = "the command line may look at the clock")]
    fn ended(&self, child: &mut Child) -> std::io::Result<Option<ExitStatus>> {
        let began = Instant::now();
        loop {
            if let Some(status) = child.try_wait()? {
                return Ok(Some(status));
            }
            if began.elapsed() >= self.timeout {
                stop(child)?;
                return Ok(None);
            }
            drapery::parallel::pause(LOOK);
        }
    }
}

/// Stops a program and what it has started.
fn stop(child: &mut Child) -> std::io::Result<()> {
    #[cfg(unix)]
    {
        let group = format!("-{}", child.id());
        let _ = Command::new("kill").args(["-KILL", "--", &group]).stderr(Stdio::null()).status();
    }
    // It may have ended by itself in the meantime.
    let _ = child.kill();
    child.wait().map(drop)
}

/// How many pixels are wrong, and around which of them most are; `None`: the frame passed.
fn failing(judgement: &Judgement) -> Option<Failing> {
    if judgement.passed() {
        return None;
    }
    // A picture that cannot be measured is wrong everywhere.
    let metrics = judgement.outcome.as_ref().ok().map(|fitted| &fitted.metrics);
    let window = metrics.and_then(|metrics| metrics.densest);
    let at = window.map_or([0, 0], |window| [window.x + window.width / 2, window.y + window.height / 2]);
    Some(Failing { pixels: metrics.map_or(0, |metrics| metrics.failing), at })
}

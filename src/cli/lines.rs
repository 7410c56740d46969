//! What is said of long work where nobody sees a bar: a line when ten seconds have passed, and then now and then.

use drapery::math::min;

/// Seconds until the first line.
const FIRST: f64 = 10.0;
/// The most seconds between two lines.
const MOST: f64 = 60.0;

/// What is being done, and when it was last spoken of. It has no clock: who asks for a line says what time it is.
#[derive(Debug)]
pub(super) struct Lines {
    step: String,
    part: Option<String>,
    share: Option<f64>,
    /// When the next line is due, in seconds since the work began.
    due: f64,
    /// How long to be quiet after that.
    quiet: f64,
}

impl Default for Lines {
    fn default() -> Self {
        Self { step: String::new(), part: None, share: None, due: FIRST, quiet: FIRST }
    }
}

impl Lines {
    /// Another step begins.
    pub(super) fn start(&mut self, what: &str) {
        (self.step, self.part, self.share) = (what.to_owned(), None, None);
    }

    /// Another part of the step begins.
    pub(super) fn part(&mut self, what: &str) {
        (self.part, self.share) = (Some(what.to_owned()), None);
    }

    /// This share (0..=1) of it is done.
    pub(super) fn done(&mut self, share: f64) {
        self.share = Some(share);
    }

    /// The line to print `now` seconds after the work began, if it is time for one.
    pub(super) fn due(&mut self, now: f64) -> Option<String> {
        if now < self.due || self.step.is_empty() {
            return None;
        }
        self.due = now + self.quiet;
        self.quiet = min(2.0 * self.quiet, MOST);
        let mut line = format!("after {now:.0} s: {}", self.step);
        if let Some(part) = &self.part {
            line += &format!(", {part}");
        }
        if let Some(share) = self.share {
            line += &format!(", {:.0} % done", (100.0 * share).floor());
        }
        Some(line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines of work that takes so many seconds, looked at each second.
    fn lines_of(seconds: u32, mut work: impl FnMut(&mut Lines, u32)) -> Vec<String> {
        let mut lines = Lines::default();
        let mut all = Vec::new();
        for second in 0..seconds {
            work(&mut lines, second);
            all.extend(lines.due(f64::from(second)));
        }
        all
    }

    #[test]
    fn work_that_is_done_within_ten_seconds_says_nothing() {
        let said = lines_of(10, |lines, second| {
            if second == 0 {
                lines.start("truth")
            }
        });
        assert!(said.is_empty(), "{said:?}");
    }

    #[test]
    fn long_work_says_what_it_does_and_how_much_is_done_now_and_then() {
        let said = lines_of(200, |lines, second| match second {
            0 => lines.start("reading dem.tif"),
            15 => lines.start("clipmap"),
            16 => lines.part("preparing"),
            35 => lines.part("drawing"),
            _ if second > 35 => lines.done(f64::from(second - 35) / 165.0),
            _ => (),
        });
        assert_eq!(
            said,
            [
                "after 10 s: reading dem.tif",
                "after 20 s: clipmap, preparing",
                "after 40 s: clipmap, drawing, 3 % done",
                "after 80 s: clipmap, drawing, 27 % done",
                "after 140 s: clipmap, drawing, 63 % done",
            ]
        );
    }

    #[test]
    fn steps_that_are_short_each_but_many_say_something_too() {
        let said = lines_of(31, |lines, second| lines.start(&format!("step {second}")));
        assert_eq!(said, ["after 10 s: step 10", "after 20 s: step 20"]);
    }
}

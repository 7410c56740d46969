//! The steps on the way to a pixel's colour, for whoever wants to know why it has it.

/// Takes the steps of a decision. Code that decides is written once, over a recorder: a frame is drawn with `()`, which keeps nothing and
/// costs nothing; a pixel is explained with a `Vec`, which keeps all.
pub trait Record<S> {
    /// Takes a step, which is made only if it is kept.
    fn step(&mut self, step: impl FnOnce() -> S);
}

impl<S> Record<S> for () {
    #[inline(always)]
    fn step(&mut self, _: impl FnOnce() -> S) {}
}

impl<S> Record<S> for Vec<S> {
    fn step(&mut self, step: impl FnOnce() -> S) {
        self.push(step());
    }
}

//! What features lose and gain on their way to the plan, for the notes.

/// What was changed on the way to the plan.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Changes {
    /// Features with a part that was cut off.
    pub(super) cut: usize,
    /// Rings around a pole.
    pub(super) around: usize,
    /// Edges that are curves.
    pub(super) edges: usize,
    /// Vertices along them.
    pub(super) along: usize,
    /// Edges that are curves of the ground.
    pub(super) edges_on_the_ground: usize,
    /// Vertices along those.
    pub(super) along_the_ground: usize,
    /// Features that reach farther beyond a pole than anything does.
    pub(super) beyond: usize,
    /// Features that are written unusually many turns off.
    pub(super) turned: usize,
}

impl Changes {
    pub(super) fn add(&mut self, other: &Self) {
        self.cut += other.cut;
        self.around += other.around;
        self.edges += other.edges;
        self.along += other.along;
        self.edges_on_the_ground += other.edges_on_the_ground;
        self.along_the_ground += other.along_the_ground;
        self.beyond += other.beyond;
        self.turned += other.turned;
    }

    /// Says so; chords are off by at most `tolerance` metres, from curves of the ground, of which the kind is named, by at most `ground`.
    pub(super) fn tell(&self, tolerance: f64, (kind, ground): (&str, f64), notes: &mut Vec<String>) {
        let mut tell = |count: usize, text: String| {
            if count > 0 {
                notes.push(text);
            }
        };
        tell(
            self.beyond,
            format!(
                "features that reach beyond a pole: {} (longitude comes first, then latitude)",
                self.beyond
            ),
        );
        tell(
            self.turned,
            format!(
                "features written more than one and a half turns of longitude off, moved by whole turns: {}",
                self.turned
            ),
        );
        tell(self.around, format!("rings around a pole, closed by way of it: {}", self.around));
        tell(
            self.cut,
            format!(
                "features cut off where the projection can be used no farther, out of sight: {}",
                self.cut
            ),
        );
        tell(
            self.edges_on_the_ground,
            format!(
                "edges that are {kind}: {}, followed by {} more vertices, to {} m on the ground",
                self.edges_on_the_ground,
                self.along_the_ground,
                rounded(ground)
            ),
        );
        tell(
            self.edges,
            format!(
                "edges that are curves in the plan: {}, followed by {} more vertices, to {} m",
                self.edges,
                self.along,
                rounded(tolerance)
            ),
        );
    }
}

/// A number for people: three digits that count.
fn rounded(number: f64) -> String {
    let (mut decimals, mut size) = (0, number.abs());
    while size > 0.0 && size < 100.0 && decimals < 9 {
        (decimals, size) = (decimals + 1, size * 10.0);
    }
    let text = format!("{number:.decimals$}");
    if decimals > 0 { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn numbers_for_people_have_three_digits_that_count() {
        let numbers = [0.0, 0.3, 0.001, 11_131.949_079_327_358, 1.0, 12.345, 0.012_345, 123.456, 90.0];
        let words = ["0", "0.3", "0.001", "11132", "1", "12.3", "0.0123", "123", "90"];
        assert_eq!(numbers.map(rounded), words);
    }
}

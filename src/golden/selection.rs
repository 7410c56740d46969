//! Which goldens are meant.

use crate::error::{Error, Result};

/// A part of the cases: those whose names match a pattern, and of these every n-th.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Selection {
    only: Option<String>,
    part: usize,
    parts: usize,
}

impl Default for Selection {
    fn default() -> Self {
        Self { only: None, part: 1, parts: 1 }
    }
}

impl Selection {
    /// The cases whose names match `only` (`*` any text, `?` any character; without it, all), and of these the `part`-th
    /// (from 1) of `parts` that have no case in common and together all.
    ///
    /// # Errors
    /// When there is no such part.
    pub fn new(only: Option<&str>, (part, parts): (usize, usize)) -> Result<Self> {
        if part == 0 || part > parts {
            return Err(Error::usage(format!("there is no part {part} of {parts}"))
                .help("parts are counted from 1, such as 1/4 to 4/4"));
        }
        Ok(Self { only: only.map(str::to_owned), part, parts })
    }

    /// Whether a name matches the pattern.
    pub fn matches(&self, name: &str) -> bool {
        self.only.as_deref().is_none_or(|pattern| matches(pattern.as_bytes(), name.as_bytes()))
    }

    /// Whether this part also answers for what belongs to no case.
    pub(super) fn is_first(&self) -> bool {
        self.part == 1
    }

    /// Whether nothing is left out.
    pub(super) fn is_all(&self) -> bool {
        *self == Self::default()
    }

    /// The part of these that is meant; their order counts.
    pub(super) fn of<T>(&self, items: Vec<T>, name: impl Fn(&T) -> &str) -> Vec<T> {
        let matching = items.into_iter().filter(|item| self.matches(name(item)));
        let part = matching.enumerate().filter(|(index, _)| index % self.parts == self.part - 1);
        part.map(|(_, item)| item).collect()
    }
}

/// Whether a name matches a pattern. The latest `*` takes as little as it can, and one more where that fails.
fn matches(pattern: &[u8], name: &[u8]) -> bool {
    let (mut at, mut seen) = (0, 0);
    let mut star: Option<(usize, usize)> = None;
    while seen < name.len() {
        match (pattern.get(at), star) {
            (Some(b'*'), _) => {
                star = Some((at, seen));
                at += 1;
            }
            (Some(c), _) if *c == b'?' || *c == name[seen] => {
                at += 1;
                seen += 1;
            }
            (_, Some((star_at, taken))) => {
                star = Some((star_at, taken + 1));
                at = star_at + 1;
                seen = taken + 1;
            }
            _ => return false,
        }
    }
    pattern[at..].iter().all(|c| *c == b'*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_match_as_in_a_shell_and_a_star_crosses_folders() {
        let matches = |pattern: &str, name: &str| matches(pattern.as_bytes(), name.as_bytes());
        for (pattern, name) in
            [("*", "a/b"), ("a*", "a/b"), ("a/?", "a/b"), ("*b*c", "abbcc"), ("a/b", "a/b")]
        {
            assert!(matches(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in [("a", "a/b"), ("?", ""), ("a/??", "a/b"), ("*b", "abc"), ("", "a")] {
            assert!(!matches(pattern, name), "{pattern} {name}");
        }
        assert!(!matches(&"*a".repeat(40), &"a".repeat(39)), "no pattern takes for ever");
    }

    #[test]
    fn parts_have_nothing_in_common_and_are_together_all() {
        let names = ["a", "b", "c", "d", "e"];
        let part = |i, n| Selection::new(None, (i, n)).unwrap().of(names.to_vec(), |name| name);
        let mut all = [part(1, 3), part(2, 3), part(3, 3)].concat();
        all.sort_unstable();
        assert_eq!((all, part(2, 3)), (names.to_vec(), vec!["b", "e"]));
        for wrong in [(0, 2), (3, 2), (0, 0), (1, 0)] {
            assert!(Selection::new(None, wrong).is_err(), "{wrong:?}");
        }
    }
}

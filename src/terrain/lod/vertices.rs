//! Sets of vertices: posts of the hierarchy, a bit for each.
//!
//! Input: an [`Extent`]. Output: [`Vertices`]. Refuses: nothing; a post beyond the hierarchy is in no set.

use super::extent::Extent;
use super::right_triangle::Post;

/// A set of posts. Those of each level stand together, so that a coarse mesh touches little memory.
#[derive(Debug, Clone)]
pub(super) struct Vertices {
    extent: Extent,
    /// Where each level's bits start, and how many columns and rows it has.
    levels: Vec<(u64, [u32; 2])>,
    words: Vec<u64>,
}

impl Vertices {
    /// No post.
    pub fn none(extent: Extent) -> Self {
        let mut levels = Vec::new();
        let mut first = 0;
        for n in 0..=extent.top() {
            let [columns, rows] = extent.cells(n).map(|cells| cells + 1);
            levels.push((first, [columns, rows]));
            first += u64::from(columns) * u64::from(rows);
        }
        Self { extent, levels, words: vec![0; first.div_ceil(64) as usize] }
    }

    /// The place of a post's bit; `None` beyond the hierarchy.
    #[inline]
    fn bit(&self, post: Post) -> Option<u64> {
        let n = self.extent.level_of(post);
        let (first, [columns, rows]) = self.levels[n as usize];
        let [x, y] = post.map(|at| at >> n);
        (x < columns && y < rows).then(|| first + u64::from(y) * u64::from(columns) + u64::from(x))
    }

    /// Whether a post is in it.
    #[inline]
    pub fn contains(&self, post: Post) -> bool {
        self.bit(post).is_some_and(|bit| self.words[(bit / 64) as usize] >> (bit % 64) & 1 == 1)
    }

    /// Puts a post in; returns whether it was not there before.
    #[inline]
    pub fn insert(&mut self, post: Post) -> bool {
        let Some(bit) = self.bit(post) else { return false };
        let word = &mut self.words[(bit / 64) as usize];
        let before = *word;
        *word |= 1 << (bit % 64);
        *word != before
    }

    /// Takes a post out.
    pub fn remove(&mut self, post: Post) {
        if let Some(bit) = self.bit(post) {
            self.words[(bit / 64) as usize] &= !(1 << (bit % 64));
        }
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.words[..])
    }
}

/// The posts of a set, numbered.
pub(super) struct Numbered<'v> {
    vertices: &'v Vertices,
    /// How many there are before each word.
    before: Vec<u32>,
}

impl<'v> Numbered<'v> {
    /// Numbers a set, level by level, row by row.
    pub fn new(vertices: &'v Vertices) -> Self {
        let mut count = 0;
        let before = vertices.words.iter().map(|word| {
            count += word.count_ones();
            count - word.count_ones()
        });
        Self { vertices, before: before.collect() }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        let last = self.before.last().copied().unwrap_or(0);
        (last + self.vertices.words.last().map_or(0, |word| word.count_ones())) as usize
    }

    /// The number of a post of the set.
    #[inline]
    pub fn of(&self, post: Post) -> usize {
        let bit = self.vertices.bit(post).unwrap_or(0);
        let word = (bit / 64) as usize;
        let below = self.vertices.words[word] & ((1 << (bit % 64)) - 1);
        (self.before[word] + below.count_ones()) as usize
    }
}

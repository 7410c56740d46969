//! What a figure is: words and panels.

use crate::buffer::Buffer;
use crate::error::Result;

/// Whose figures they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Paper {
    /// Taibo et al. 2014.
    Taibo,
    /// Wartell et al. 2003.
    Wartell,
    /// She et al. 2016.
    She,
    /// Zechmeister 2020.
    Zechmeister,
    /// Schneider and Klein 2007.
    SchneiderKlein,
    /// None: this program's own.
    Ours,
}

impl Paper {
    /// All, in the order of the page.
    pub const ALL: [Self; 6] =
        [Self::SchneiderKlein, Self::Wartell, Self::Taibo, Self::She, Self::Zechmeister, Self::Ours];

    /// The beginning of its figures' names.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Taibo => "taibo",
            Self::Wartell => "wartell",
            Self::She => "she",
            Self::Zechmeister => "zechmeister",
            Self::SchneiderKlein => "schneider-klein",
            Self::Ours => "ours",
        }
    }

    /// What it is called in full.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Taibo => {
                "J. Taibo, A. Seoane, L. Hernández 2014: Practical line rasterization for multi-resolution textures"
            }
            Self::Wartell => {
                "Z. Wartell et al. 2003: Rendering vector data over global, multi-resolution 3D terrain"
            }
            Self::She => {
                "J. She et al. 2016: A screen-based method of line rendering on three-dimensional terrain"
            }
            Self::Zechmeister => "A. Zechmeister 2020: Visualization of vector data on heightfields (thesis)",
            Self::SchneiderKlein => {
                "M. Schneider, R. Klein 2007: Efficient and accurate rendering of vector data on virtual landscapes"
            }
            Self::Ours => "This program's own",
        }
    }
}

/// How large figures are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// As the page shows them.
    Full,
    /// Pictures of landscapes a quarter as wide and high: soon made, to see that nothing changed.
    Small,
}

impl Scale {
    /// What widths and heights are divided by.
    pub(super) const fn divisor(self) -> usize {
        match self {
            Self::Full => 1,
            Self::Small => 4,
        }
    }
}

/// What a panel shows.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    /// Pixels: a PNG.
    Picture(Buffer<[u8; 4]>),
    /// Lines and words: a whole SVG document.
    Drawing(String),
}

/// A part of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Its caption.
    pub caption: String,
    /// What it shows.
    pub content: Content,
}

impl Panel {
    /// A picture.
    pub(super) fn picture(caption: impl Into<String>, picture: Buffer<[u8; 4]>) -> Self {
        Self { caption: caption.into(), content: Content::Picture(picture) }
    }

    /// A drawing.
    pub(super) fn drawing(caption: impl Into<String>, svg: String) -> Self {
        Self { caption: caption.into(), content: Content::Drawing(svg) }
    }
}

/// A figure that can be made.
#[derive(Debug)]
pub struct Figure {
    /// Its name, on the command line and in files.
    pub name: &'static str,
    /// Whose it is.
    pub paper: Paper,
    /// Its number there; empty where it is ours.
    pub number: &'static str,
    /// What it shows, in some words.
    pub title: &'static str,
    /// What it shows, in sentences; not the paper's.
    pub caption: &'static str,
    /// What to look for.
    pub look_for: &'static str,
    /// Makes its panels.
    pub(super) draw: fn(Scale) -> Result<Vec<Panel>>,
}

impl Figure {
    /// Makes its panels.
    ///
    /// # Errors
    /// Internal errors only: its scenes are the program's own.
    pub fn panels(&self, scale: Scale) -> Result<Vec<Panel>> {
        (self.draw)(scale)
    }
}

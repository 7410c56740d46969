//! What is said of a technique, once.

use super::sweep::Sweep;
use super::{Kind, Prepared};
use crate::buffer::PlaneKind;
use crate::error::Result;
use crate::parameter::{Settings, TableShape, Value};
use crate::scene::{Line, StrokeForm, TechniqueSettings};
use crate::stage::Stage;

/// What is said of a technique: all that others know of it.
#[derive(Debug)]
pub struct Declaration {
    /// Its name and its parameters.
    pub parameters: Parameters,
    /// Those of other techniques that it draws by, too.
    pub further: &'static [Parameters],
    /// Its paper.
    pub paper: &'static str,
    /// What it is, in a line.
    pub title: &'static str,
    /// What is wrong with settings each of which is right.
    pub contradiction: fn(&TechniqueSettings) -> Option<Contradiction>,
    /// The buffers that can be asked for, in the order of the technique's stages: of two that differ from what they should
    /// be, the first is nearer to the cause.
    pub planes: &'static [PlaneKind],
    /// How a client draws the same, as a part of a bundle's README: its algorithm, then `## Buffers`, in which each has a row.
    pub client: &'static str,
    /// What it makes of the ends and corners of a stroke in a layer's style.
    pub stroke_form: fn(&TechniqueSettings, &Line) -> StrokeForm,
    /// Which settings a report tries.
    pub sweep: Sweep,
    /// Whether it draws such a scene, or the reason why it does not.
    pub applies: fn(&Stage) -> Result<()>,
    /// Builds its structures; what it is lent is told the share that is done (0..=1), from any thread.
    pub prepare: Preparing,
}

/// Builds a technique's structures over a stage.
pub type Preparing = for<'s, 'p> fn(&'s Stage, &'p (dyn Fn(f64) + Sync)) -> Result<Box<dyn Prepared + 's>>;

/// The parameters of a technique, whatever the type of its settings.
#[derive(Debug)]
pub struct Parameters {
    /// The name of their table in the scene file: the technique's.
    pub name: &'static str,
    /// The table.
    pub table: &'static TableShape,
    /// Their values, as the technique reads them.
    pub values: fn(&TechniqueSettings) -> Vec<(&'static str, Value)>,
}

impl Parameters {
    /// Those of settings.
    pub const fn of<S: Settings>() -> Self {
        Self { name: S::NAME, table: S::TABLE, values: |said| said.get::<S>().values() }
    }
}

/// Settings that contradict each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Contradiction {
    /// The parameter to blame.
    pub parameter: &'static str,
    /// What is wrong.
    pub what: String,
    /// What to do.
    pub help: String,
}

impl Kind {
    /// The name on the command line and in files.
    pub const fn name(self) -> &'static str {
        self.declaration().parameters.name
    }

    /// The names of the buffers that can be asked for, in the order of the technique's stages.
    pub fn buffer_names(self) -> Vec<String> {
        self.declaration().planes.iter().map(|plane| plane.name.to_owned()).collect()
    }

    /// The values of all its parameters by their names in the scene file.
    pub fn parameters(self, settings: &TechniqueSettings) -> Vec<(&'static str, Value)> {
        (self.declaration().parameters.values)(settings)
    }
}

/// The list of techniques: a [`Kind`] each, in the folder that holds its [`Declaration`].
macro_rules! techniques {
    ($($kind:ident is $folder:ident,)+) => {
        /// A technique that is built.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Kind {
            $(
                #[doc = concat!("See [`", stringify!($folder), "`].")]
                $kind,
            )+
        }

        impl Kind {
            /// Every technique that is built.
            pub const ALL: [Self; [$(Self::$kind),+].len()] = [$(Self::$kind),+];

            /// What is said of it.
            pub const fn declaration(self) -> &'static Declaration {
                match self {
                    $(Self::$kind => &$folder::DECLARATION,)+
                }
            }
        }
    };
}
pub(super) use techniques;

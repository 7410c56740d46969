//! How items look, as painting them needs it.

use crate::draw_list::{DrawList, Side};
use crate::resolve::{Compositor, Paint};
use crate::scene::{BlendMode, Group, Line, Rule, Width};
use crate::space::Lens;

/// Which side of a border counts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Area {
    pub(super) rule: Rule,
    /// Whether the inside is wanted; else the outside.
    pub(super) is_wanted: bool,
}

impl Area {
    /// Whether a place is wanted around which the border turns so often.
    pub(super) fn holds(self, turns: i32) -> bool {
        self.rule.contains(turns) == self.is_wanted
    }
}

/// How an item looks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Look {
    pub(super) paint: Paint,
    pub(super) group: Option<Group>,
    /// Its stroke; `None` of an item that is its area.
    pub(super) line: Option<Line>,
    /// The area that it is, or that its stroke is cut to.
    pub(super) area: Option<Area>,
    /// Whether nothing below it shows.
    pub(super) is_opaque: bool,
}

/// How all items look.
#[derive(Debug)]
pub(super) struct Looks<'s> {
    list: &'s DrawList,
    of_styles: Vec<Look>,
    mode: BlendMode,
}

impl<'s> Looks<'s> {
    /// Those of a list.
    pub(super) fn new(list: &'s DrawList, compositor: &Compositor, mode: BlendMode) -> Self {
        let look = |style: &crate::draw_list::ItemStyle| Look {
            paint: compositor.paint(style.paint),
            group: style.group,
            line: style.stroke,
            area: match (style.stroke, style.cut) {
                (Some(_), None) => None,
                (_, cut) => Some(Area { rule: style.rule, is_wanted: cut != Some(Side::Outside) }),
            },
            is_opaque: mode == BlendMode::Over && style.group.is_none() && style.paint.0[3] >= 1.0,
        };
        Self { list, of_styles: list.styles().iter().map(look).collect(), mode }
    }

    /// Whether what is composed is linear in what lies below; sums of light stop at 1.
    pub(super) fn is_linear(&self) -> bool {
        self.mode == BlendMode::Over
    }

    /// That of an item.
    #[inline]
    pub(super) fn of(&self, item: u32) -> &Look {
        &self.of_styles[self.list.items()[item as usize].style as usize]
    }
}

/// Half a stroke's width, metres, where it is the same in all of the plan.
pub(super) fn even_half(line: &Line, lens: Lens) -> Option<f64> {
    match (line.width, lens) {
        (Width::Metres(width), _) => Some(width / 2.0),
        (Width::Pixels(width), Lens::Parallel { pixel }) => Some(0.5 * width * pixel),
        (Width::Pixels(_), Lens::Central { .. }) => None,
    }
}

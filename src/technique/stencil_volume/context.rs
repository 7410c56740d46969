//! What all tiles of a frame are drawn with.

use super::extrusion::{Extrusion, Volume};
use super::face::Outline;
use super::stencil::{Method, TRACES, Width};
use super::view::VolumeViews;
use crate::canvas::{Backdrop, FrameOptions, LastGround};
use crate::raster::Lattice;
use crate::resolve::Paint;
use crate::scene::{Group, Rule};
use crate::space::{Plan, ViewFrame};
use crate::stage::Stage;
use crate::technique::stencil_volume::{FarPlane, Grouping, Overflow, Settings, VolumeCaps};
use crate::terrain::Mesh;
use crate::visibility::Sight;

/// How fragments are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Only where a volume's fragments do not cancel.
    Sparse,
    /// Everywhere.
    Full,
    /// By the imitated machine.
    Machine,
}

/// What all tiles of a frame are drawn with.
pub struct FrameContext<'a> {
    /// The scene.
    pub stage: &'a Stage,
    /// The terrain that the view shows.
    pub mesh: &'a Mesh,
    /// From where it is seen.
    pub view: &'a ViewFrame,
    /// The parameters.
    pub settings: Settings,
    /// The volumes.
    pub extrusion: &'a Extrusion<'a>,
    /// What the samples see.
    pub sight: Sight<'a>,
    /// How fragments are found.
    pub way: Way,
    /// What features are painted over.
    pub backdrop: Backdrop<'a>,
    /// Whether the planes of the stencil are kept to look at.
    pub wants_traces: bool,
    /// Whether it is kept which items touch pixels. One mask for all objects of a colour does not tell.
    pub wants_items: bool,
    /// The vectors that kernels are run with; the bits are the same with any.
    pub arch: pulp::Arch,
    /// What the view makes of the volumes.
    pub looks: VolumeViews,
    /// The paint of each style of items.
    paints: Vec<Paint>,
}

impl<'a> FrameContext<'a> {
    /// Finds what a view sees, and what it makes of the volumes.
    pub fn new(
        (stage, mesh, view): (&'a Stage, &'a Mesh, &'a ViewFrame),
        extrusion: &'a Extrusion<'a>,
        options: &FrameOptions,
    ) -> Self {
        let settings: Settings = stage.scene.technique.get();
        let n = settings.samples as usize;
        let lattice = Lattice::samples([0, 0], [view.width(), view.height()], n);
        let device = &stage.scene.device;
        let mut sight = Sight::new(view, mesh, device, lattice, options.tile);
        sight.see();
        let backdrop = Backdrop::of(&stage.scene, mesh);
        let looks = VolumeViews::new((stage, view), &lattice, &settings, extrusion);
        let shows_counting = TRACES[1..].iter().any(|name| options.wants(name));
        let cancels = settings.overflow == Overflow::Wrap
            && settings.caps == VolumeCaps::Both
            && !looks.has_forced
            && !looks.has_cut;
        let way = match (device.is_exact(), cancels && !shows_counting) {
            (false, _) => Way::Machine,
            (true, true) => Way::Sparse,
            (true, false) => Way::Full,
        };
        let styles = stage.draw_list.styles().iter();
        Self {
            stage,
            mesh,
            view,
            settings,
            extrusion,
            sight,
            way,
            wants_traces: shows_counting || options.wants(TRACES[0]),
            wants_items: options.touches(0).is_wanted() && settings.grouping == Grouping::Object,
            arch: pulp::Arch::new(),
            looks,
            paints: styles.map(|style| backdrop.compositor.paint(style.paint)).collect(),
            backdrop,
        }
    }

    /// Samples a side of a pixel.
    pub fn samples(&self) -> usize {
        self.settings.samples as usize
    }

    /// A volume by its number.
    pub fn volume(&self, volume: u32) -> &'a Volume {
        &self.extrusion.volumes[volume as usize]
    }

    /// How a volume is counted.
    pub fn method_of(&self, volume: u32) -> Method {
        self.looks.methods[volume as usize]
    }

    /// Whether the near or the far plane cuts faces of a volume away.
    pub fn is_cut(&self, volume: u32) -> bool {
        self.looks.is_cut[volume as usize]
    }

    /// Whether near and far plane clip volumes.
    pub fn clips(&self) -> bool {
        self.settings.far == FarPlane::Clip
    }

    /// What the stencil can hold.
    pub fn stencil_width(&self) -> Width {
        Width { bits: self.stage.scene.device.stencil_bits, overflow: self.settings.overflow }
    }

    /// The faces of the box around a volume (4.2.2).
    pub fn box_of(&self, volume: u32) -> [Outline; 6] {
        let volume = self.volume(volume);
        Outline::of_box(&volume.plan, (volume.low, volume.high))
    }

    /// The item that a pass draws first, and all there is of it where each object has a mask of its own.
    pub fn item_of(&self, pass: u32) -> u32 {
        self.extrusion.passes[pass as usize].objects[0]
    }

    /// The paint and the rule of a pass.
    pub fn paint_of(&self, pass: u32) -> (Paint, Rule) {
        let first = self.item_of(pass);
        let style = self.stage.draw_list.items()[first as usize].style;
        (self.paints[style as usize], self.extrusion.rule_of(first))
    }

    /// What the objects of a pass are composed with first.
    pub fn group_of(&self, pass: u32) -> Option<Group> {
        self.stage.draw_list.style_of(self.extrusion.passes[pass as usize].objects[0]).group
    }

    /// The rule of the polygon that a pass is cut to, and whether what lies inside is kept.
    pub fn cut_of(&self, pass: u32) -> Option<(Rule, bool)> {
        self.extrusion.cut_of(self.extrusion.passes[pass as usize].objects[0])
    }

    /// Whether the planes to look at show a pass.
    pub fn is_traced(&self, pass: u32) -> bool {
        let objects = &self.extrusion.passes[pass as usize].objects;
        self.settings.object.is_none_or(|object| objects.binary_search(&object).is_ok())
    }

    /// The terrain's or the sky's paint at a sample.
    #[inline(always)]
    pub fn ground_paint(&self, last: &mut LastGround, (column, row): (usize, usize)) -> Paint {
        let plan = || self.sight.hit(column, row).map_or_else(Plan::default, |hit| hit.plan);
        self.backdrop.paint_at(last, self.sight.triangle(column, row), plan)
    }
}

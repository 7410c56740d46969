//! What a view makes of the volumes: which are in the picture and where, how each is counted, which are cut.
//!
//! Input: a stage, the volumes. Output: [`VolumeViews`]. Refuses: nothing.
//!
//! The paper's test for z-pass (4.2.1) asks whether the viewpoint lies in the polyhedron's bounding box. A volume that the near
//! plane cuts beside the eye passes it all the same, so here the box around the eye and the near plane's rectangle is asked.

use super::extrusion::{Extrusion, Volume, nadir};
use super::stencil::Method;
use crate::math;
use crate::parallel;
use crate::raster::{Lattice, TileView};
use crate::space::{Plan, Screen, ViewFrame, World};
use crate::stage::Stage;
use crate::technique::stencil_volume::{Counting, FarPlane, Overflow, Settings, VolumeCaps};
use glam::DVec3;

/// A volume in the list of what is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Entry {
    /// Which mask it belongs to.
    pub pass: u32,
    /// Its number.
    pub volume: u32,
    /// Whether it is the polygon that an outline is cut to.
    pub is_cutter: bool,
    /// The first column and row of the lattice that its picture can touch, and the last.
    pub window: [u32; 4],
}

impl Entry {
    /// The samples of a tile that its picture can touch; the tile is one of those it touches.
    pub fn samples_in(&self, view: &TileView) -> ((usize, usize), (usize, usize)) {
        let [c0, r0, c1, r1] = self.window.map(|v| v as usize);
        let within = |v: usize, first: usize, count: usize| v.saturating_sub(first).min(count - 1);
        (
            (within(c0, view.column, view.width), within(r0, view.row, view.height)),
            (within(c1, view.column, view.width), within(r1, view.row, view.height)),
        )
    }
}

/// What a view makes of each volume.
#[derive(Debug)]
pub struct VolumeViews {
    /// How it is counted.
    pub methods: Vec<Method>,
    /// Whether the near or the far plane cuts faces of it away.
    pub is_cut: Vec<bool>,
    /// Whether a volume is counted by z-pass that the test would have counted by z-fail.
    pub has_forced: bool,
    /// Whether any volume is cut.
    pub has_cut: bool,
    windows: Vec<Option<[u32; 4]>>,
}

/// What is found of one volume.
struct VolumeView {
    window: Option<[u32; 4]>,
    is_near: bool,
    is_cut: bool,
}

impl VolumeViews {
    /// Looks at all volumes.
    pub fn new(
        at: (&Stage, &ViewFrame),
        lattice: &Lattice,
        settings: &Settings,
        extrusion: &Extrusion,
    ) -> Self {
        let viewer = Viewer::new(at, lattice, settings);
        let looks = parallel::map(&extrusion.volumes, |volume| viewer.look(extrusion, volume));
        let method = |look: &VolumeView| match settings.method {
            Counting::Automatic if look.is_near => Method::ZFail,
            Counting::Automatic | Counting::ZPass => Method::ZPass,
            Counting::ZFail => Method::ZFail,
        };
        let in_view = || looks.iter().filter(|look| look.window.is_some());
        Self {
            methods: looks.iter().map(method).collect(),
            is_cut: looks.iter().map(|look| look.is_cut).collect(),
            has_forced: settings.method == Counting::ZPass && in_view().any(|look| look.is_near),
            has_cut: in_view().any(|look| look.is_cut),
            windows: looks.into_iter().map(|look| look.window).collect(),
        }
    }

    /// The numbers of the volumes in the picture.
    pub fn in_view(&self) -> impl Iterator<Item = usize> + '_ {
        self.windows.iter().enumerate().filter(|(_, window)| window.is_some()).map(|(number, _)| number)
    }

    /// The volumes in the picture in draw order; of an outline that is cut, the polygon first.
    pub fn entries(&self, extrusion: &Extrusion) -> Vec<Entry> {
        let mut entries = Vec::new();
        for (pass, objects) in extrusion.passes.iter().enumerate() {
            for object in objects.objects.iter().map(|o| &extrusion.objects[*o as usize]) {
                let cutters = object.cutters.clone();
                let all = cutters.map(|v| (v, true)).chain(object.volumes.clone().map(|v| (v, false)));
                entries.extend(all.filter_map(|(volume, is_cutter)| {
                    let window = self.windows[volume as usize]?;
                    Some(Entry { pass: pass as u32, volume, is_cutter, window })
                }));
            }
        }
        entries
    }
}

struct Viewer<'a> {
    frame: &'a ViewFrame,
    lattice: &'a Lattice,
    far: FarPlane,
    /// Whether no count can be left over outside a volume's own picture. Else the boxes through which masks are applied may
    /// find one, and the pictures of the boxes count.
    is_sound: bool,
    /// The box around the eye (or the eye's plane) and the near plane's rectangle.
    low: DVec3,
    high: DVec3,
}

impl<'a> Viewer<'a> {
    fn new((stage, frame): (&Stage, &'a ViewFrame), lattice: &'a Lattice, settings: &Settings) -> Self {
        let is_sound = settings.overflow == Overflow::Wrap
            && settings.caps == VolumeCaps::Both
            && settings.method != Counting::ZPass
            && settings.far == FarPlane::Clamp
            && stage.scene.device.is_exact();
        let (mut low, mut high) = (frame.eye().to_vec(), frame.eye().to_vec());
        let (width, height) = (frame.width() as f64, frame.height() as f64);
        for (x, y) in [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)] {
            let ray = frame.ray(Screen::new(x, y));
            let near = ray.from + (ray.through - ray.from) * (frame.near() / frame.reach());
            for p in [ray.from.to_vec(), near.to_vec()] {
                for k in 0..3 {
                    low[k] = math::min(p[k], low[k]);
                    high[k] = math::max(p[k], high[k]);
                }
            }
        }
        let slack = DVec3::splat(1e-9 * (low.abs().max_element() + high.abs().max_element()));
        Self { frame, lattice, far: settings.far, is_sound, low: low - slack, high: high + slack }
    }

    fn look(&self, extrusion: &Extrusion, volume: &Volume) -> VolumeView {
        if volume.high <= volume.low {
            return VolumeView { window: None, is_near: false, is_cut: false };
        }
        let (low, high) =
            (nadir(volume.plan.min, volume.low).to_vec(), nadir(volume.plan.max, volume.high).to_vec());
        let is_near = low.cmple(self.high).all() && self.low.cmple(high).all();
        VolumeView { window: self.window(extrusion, volume), is_near, is_cut: self.is_cut(low, high) }
    }

    /// Whether some of a box may lie before the near or behind the far plane that clips.
    fn is_cut(&self, low: DVec3, high: DVec3) -> bool {
        if self.far == FarPlane::Clamp {
            return false;
        }
        let middle = self.frame.depth(World::from((low + high) / 2.0));
        let spread =
            (self.frame.forward().abs()).dot((high - low) / 2.0) * (1.0 + 1e-9) + 1e-9 * middle.abs();
        middle - spread < self.frame.near() || middle + spread > self.frame.far()
    }

    /// The columns and rows of the lattice around a volume's picture; `None`: it has none.
    fn window(&self, extrusion: &Extrusion, volume: &Volume) -> Option<[u32; 4]> {
        let lattice = self.lattice;
        let is_central = matches!(self.frame.lens(), crate::space::Lens::Central { .. });
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut behind = 0;
        let mut count = 0;
        self.for_each_corner(extrusion, volume, |p| {
            count += 1;
            let d = p - self.frame.eye();
            let h = self.frame.homogeneous(d) + self.frame.homogeneous_eye();
            // What lies nearer to the eye's plane than this has no place on the screen that doubles could tell.
            if is_central
                && h.z <= 1e-9 * (d.abs().element_sum() + self.frame.eye().to_vec().abs().max_element())
            {
                behind += 1;
                return;
            }
            let at = [(h.x / h.z - lattice.x) / lattice.step, (h.y / h.z - lattice.y) / lattice.step];
            for k in 0..2 {
                low[k] = math::min(at[k], low[k]);
                high[k] = math::max(at[k], high[k]);
            }
        });
        let (last_column, last_row) = ((lattice.columns - 1) as f64, (lattice.rows - 1) as f64);
        if behind == count {
            // Wholly behind the eye (a parallel lens has no behind).
            return None;
        }
        if behind > 0 {
            return Some([0, 0, last_column as u32, last_row as u32]);
        }
        // A hair for the error of a projected corner.
        let from = [low[0] - 1e-2, low[1] - 1e-2];
        let to = [high[0] + 1e-2, high[1] + 1e-2];
        let is_out = to[0] < 0.0 || to[1] < 0.0 || from[0] > last_column || from[1] > last_row;
        // Casts saturate: what lies before the first sample becomes 0.
        let last = |v: f64, most: f64| math::min(v, most) as u32;
        (!is_out).then(|| [from[0] as u32, from[1] as u32, last(to[0], last_column), last(to[1], last_row)])
    }

    /// Calls `visit` with the corners of a volume, or of the upright box around it.
    fn for_each_corner(&self, extrusion: &Extrusion, volume: &Volume, mut visit: impl FnMut(World)) {
        let plan = &volume.plan;
        let around =
            [plan.min, Plan::new(plan.max.x, plan.min.y), plan.max, Plan::new(plan.min.x, plan.max.y)];
        let ring =
            extrusion.rings_of(volume).next().filter(|_| volume.is_box && self.is_sound).unwrap_or(&around);
        for corner in ring {
            visit(nadir(*corner, volume.low));
            visit(nadir(*corner, volume.high));
        }
    }
}

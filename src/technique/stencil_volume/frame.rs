//! One frame: what the samples see, volumes to tiles, tiles to a picture (Fig. 4).

use super::block::SIZE;
use super::extrusion::{Extrusion, Volume};
use super::face::Outline;
use super::stencil::{Method, Traces};
use super::tile::{Counts, Tile, Way};
use super::view::{Entry, Looks};
use crate::buffer::{Buffer, Plane, Values};
use crate::parallel;
use crate::raster::{Lattice, TileView};
use crate::resolve::{Compositor, GroundPaint, Paint, code_values};
use crate::scene::Rule;
use crate::space::{Plan, ViewFrame};
use crate::stage::Stage;
use crate::technique::stencil_volume::{FarPlane, Overflow, Settings, VolumeCaps};
use crate::technique::{Frame, FrameOptions};
use crate::terrain::{Mesh, SKY};
use crate::visibility::Sight;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The most samples a side of a tile: single precision resolves them (see [`TileView`]).
const MOST: usize = 512;

/// Draws a frame of a view.
pub fn draw((stage, view): (&Stage, &ViewFrame), extrusion: &Extrusion, options: &FrameOptions) -> Frame {
    let mesh = &*stage.mesh_for(view);
    let drawing = Drawing::new((stage, view), mesh, extrusion, options);
    (options.progress)(0.3);
    let n = drawing.settings.samples as usize;
    let side = options.tile.clamp(1, MOST / n) * n;
    let entries = drawing.looks.entries(extrusion);
    let bins = bins(&entries, &drawing.lattice, side);
    let done = AtomicUsize::new(0);
    let tiles = parallel::map_indices(bins.len(), |k| {
        let across = drawing.lattice.columns.div_ceil(side);
        let tile = TileView::new(view, &drawing.lattice, (k % across * side, k / across * side), side);
        let drawn = drawing.tile(tile, &bins[k]);
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        (options.progress)(0.3 + 0.7 * done as f64 / bins.len() as f64);
        drawn
    });
    drawing.frame(&tiles, options)
}

/// The volumes that may touch each tile, in draw order.
fn bins(entries: &[Entry], lattice: &Lattice, side: usize) -> Vec<Vec<Entry>> {
    let (across, down) = (lattice.columns.div_ceil(side), lattice.rows.div_ceil(side));
    let mut bins = vec![Vec::new(); across * down];
    for entry in entries {
        let [c0, r0, c1, r1] = entry.window.map(|v| v as usize / side);
        for r in r0..=r1 {
            for c in c0..=c1 {
                bins[r * across + c].push(*entry);
            }
        }
    }
    bins
}

/// Everything that tiles are drawn with.
pub struct Drawing<'a> {
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
    /// Composes colours.
    pub compositor: Compositor,
    /// Whether the planes of the stencil are kept to look at.
    pub wants_traces: bool,
    /// The vectors that kernels are run with; the bits are the same with any.
    pub arch: pulp::Arch,
    lattice: Lattice,
    /// What the view makes of the volumes.
    looks: Looks,
    ground: GroundPaint<'a>,
    sky: Paint,
    /// The paint of each style of items.
    paints: Vec<Paint>,
    wants_colors: bool,
}

/// A finished tile.
struct Drawn {
    /// Where it starts and its size, in pixels.
    place: (usize, usize),
    size: (usize, usize),
    image: Vec<[u8; 4]>,
    colors: Vec<f64>,
    traces: Option<SampleTraces>,
    counts: Counts,
}

/// The planes of a tile's stencil, rows from the top.
struct SampleTraces {
    width: usize,
    planes: [Vec<u32>; 4],
}

impl<'a> Drawing<'a> {
    fn new(
        (stage, view): (&'a Stage, &'a ViewFrame),
        mesh: &'a Mesh,
        extrusion: &'a Extrusion<'a>,
        options: &FrameOptions,
    ) -> Self {
        let settings: Settings = stage.scene.technique.get();
        let lattice = lattice(view, settings.samples);
        let device = &stage.scene.device;
        let mut sight = Sight::new(view, mesh, device, lattice, options.tile);
        sight.see();
        let compositor = Compositor::new(stage.scene.compositing);
        let looks = Looks::new((stage, view), &lattice, &settings, extrusion);
        let wants = |name: &str| options.buffers.iter().any(|b| b == name);
        let is_curious = TRACES[1..].iter().any(|name| wants(name));
        let cancels = settings.overflow == Overflow::Wrap
            && settings.caps == VolumeCaps::Both
            && !looks.has_forced
            && !looks.has_cut;
        let way = match (device.is_exact(), cancels && !is_curious) {
            (false, _) => Way::Machine,
            (true, true) => Way::Sparse,
            (true, false) => Way::Full,
        };
        Self {
            stage,
            mesh,
            view,
            settings,
            extrusion,
            sight,
            way,
            compositor,
            wants_traces: is_curious || wants(TRACES[0]),
            arch: pulp::Arch::new(),
            lattice,
            looks,
            ground: GroundPaint::new(&stage.scene.ground, mesh, compositor),
            sky: compositor.paint(stage.scene.image.background),
            paints: stage.draw_list.styles().iter().map(|style| compositor.paint(style.paint)).collect(),
            wants_colors: wants("color"),
        }
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

    /// The faces of the box around a volume (4.2.2).
    pub fn box_of(&self, volume: u32) -> [Outline; 6] {
        let volume = self.volume(volume);
        Outline::of_box(&volume.plan, (volume.low, volume.high))
    }

    /// The paint and the rule of a pass.
    pub fn paint_of(&self, pass: u32) -> (Paint, Rule) {
        let first = self.extrusion.passes[pass as usize].objects[0];
        let style = self.stage.draw_list.items()[first as usize].style;
        (self.paints[style as usize], self.extrusion.rule_of(first))
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
    pub fn ground_paint(&self, column: usize, row: usize) -> Paint {
        let id = self.sight.triangle(column, row);
        if id == SKY {
            return self.sky;
        }
        let plan = if self.ground.is_constant_on_triangles() {
            Plan::default()
        } else {
            self.sight.hit(column, row).map_or_else(Plan::default, |hit| hit.plan)
        };
        self.ground.at(id, plan)
    }

    fn tile(&self, view: TileView, entries: &[Entry]) -> Drawn {
        let n = self.settings.samples as usize;
        let place = (view.column / n, view.row / n);
        let size = (view.width / n, view.height / n);
        let mut tile = Tile::new(self, view, entries);
        tile.draw(entries);
        let mut drawn = Drawn {
            place,
            size,
            image: Vec::with_capacity(size.0 * size.1),
            colors: Vec::new(),
            traces: tile.traces.as_ref().map(|traces| samples_of(&tile, traces)),
            counts: tile.counts,
        };
        let mut last = (self.sky, code_values(self.compositor.encoded(self.sky)));
        let mut ground = Ground { id: SKY, paint: self.sky, code: last.1 };
        for y in 0..size.1 {
            for x in 0..size.0 {
                if n == 1 && !self.wants_colors && tile.painted(x, y).is_none() {
                    self.look_at_ground((tile.view.column + x, tile.view.row + y), &mut ground);
                    drawn.image.push(ground.code);
                    continue;
                }
                let paint = self.pixel(&tile, (x, y), &mut ground);
                if paint != last.0 {
                    last = (paint, code_values(self.compositor.encoded(paint)));
                }
                drawn.image.push(last.1);
                if self.wants_colors {
                    drawn.colors.extend(self.compositor.encoded(paint));
                }
            }
        }
        drawn
    }

    /// The mean of a pixel's samples.
    fn pixel(&self, tile: &Tile, (x, y): (usize, usize), ground: &mut Ground) -> Paint {
        let n = self.settings.samples as usize;
        let mut sum = Paint::CLEAR;
        for r in y * n..(y + 1) * n {
            for c in x * n..(x + 1) * n {
                let paint = tile.painted(c, r).unwrap_or_else(|| {
                    self.look_at_ground((tile.view.column + c, tile.view.row + r), ground);
                    ground.paint
                });
                if n == 1 {
                    return paint;
                }
                sum = sum.plus(paint);
            }
        }
        sum.divided_by((n * n) as f64)
    }

    /// The ground at a sample; neighbours often see the same triangle.
    #[inline(always)]
    fn look_at_ground(&self, (column, row): (usize, usize), last: &mut Ground) {
        let id = self.sight.triangle(column, row);
        if id != last.id || !self.ground.is_constant_on_triangles() {
            let paint = self.ground_paint(column, row);
            if paint != last.paint {
                *last = Ground { id, paint, code: code_values(self.compositor.encoded(paint)) };
            }
            last.id = id;
        }
    }

    fn frame(&self, tiles: &[Drawn], options: &FrameOptions) -> Frame {
        let view = self.view;
        let mut image = vec![[0; 4]; view.width() * view.height()];
        for tile in tiles {
            for (r, row) in tile.image.chunks_exact(tile.size.0).enumerate() {
                let start = (tile.place.1 + r) * view.width() + tile.place.0;
                image[start..start + tile.size.0].copy_from_slice(row);
            }
        }
        let planes = options.buffers.iter().filter_map(|name| self.plane(name, tiles)).collect();
        Frame {
            image: Buffer::from_values(view.width(), view.height(), image),
            planes,
            counts: self.counts(tiles),
        }
    }

    fn plane(&self, name: &str, tiles: &[Drawn]) -> Option<Plane> {
        let (columns, rows) = (self.lattice.columns, self.lattice.rows);
        let of_samples =
            |name, components, values| Some(Plane { name, width: columns, height: rows, components, values });
        if let Some(k) = TRACES.iter().position(|known| *known == name) {
            return of_samples(TRACES[k], 1, self.trace(k, tiles));
        }
        match name {
            "triangle" => of_samples("triangle", 1, Values::U32(self.sight.triangles().to_vec())),
            "depth" => of_samples("depth", 1, Values::F64(self.of_hits(|hit| [hit.depth]))),
            "plan" => of_samples("plan", 2, Values::F64(self.of_hits(|hit| [hit.plan.x, hit.plan.y]))),
            "color" => Some(self.colors(tiles)),
            _ => None,
        }
    }

    fn of_hits<const N: usize>(&self, f: impl Fn(crate::visibility::Hit) -> [f64; N] + Sync) -> Vec<f64> {
        let rows = parallel::map_indices(self.lattice.rows, |row| {
            let hits = (0..self.lattice.columns).map(|column| self.sight.hit(column, row));
            hits.flat_map(|hit| hit.map_or([f64::INFINITY; N], &f)).collect::<Vec<_>>()
        });
        rows.concat()
    }

    fn colors(&self, tiles: &[Drawn]) -> Plane {
        let (width, height) = (self.view.width(), self.view.height());
        let mut values = vec![0.0; width * height * 4];
        for tile in tiles {
            for (r, row) in tile.colors.chunks_exact(tile.size.0 * 4).enumerate() {
                let start = ((tile.place.1 + r) * width + tile.place.0) * 4;
                values[start..start + row.len()].copy_from_slice(row);
            }
        }
        Plane { name: "color", width, height, components: 4, values: Values::F64(values) }
    }

    /// Plane `k` of [`TRACES`] of all samples.
    fn trace(&self, k: usize, tiles: &[Drawn]) -> Values {
        let n = self.settings.samples as usize;
        let mut values = vec![0; self.lattice.columns * self.lattice.rows];
        for tile in tiles {
            let Some(traces) = &tile.traces else { continue };
            for (r, row) in traces.planes[k].chunks_exact(traces.width).enumerate() {
                let start = (tile.place.1 * n + r) * self.lattice.columns + tile.place.0 * n;
                values[start..start + row.len()].copy_from_slice(row);
            }
        }
        if k == 0 { Values::U16(values.into_iter().map(|v| v as u16).collect()) } else { Values::U32(values) }
    }

    fn counts(&self, tiles: &[Drawn]) -> Vec<(&'static str, u64)> {
        let done = tiles.iter().fold(Counts::default(), |sum, tile| sum.plus(tile.counts));
        let seen = self.sight.counts();
        let by = |method| self.looks.in_view().filter(|v| self.looks.methods[*v] == method).count() as u64;
        vec![
            ("objects", self.extrusion.objects.len() as u64),
            ("volumes", self.extrusion.volumes.len() as u64),
            ("passes", self.extrusion.passes.len() as u64),
            ("z_pass", by(Method::ZPass)),
            ("z_fail", by(Method::ZFail)),
            ("faces", done.faces),
            ("fragments", done.fragments),
            ("masks", done.masks),
            ("exact_fragments", done.exact_decisions),
            ("triangles_drawn", seen.triangles),
            ("hidden_nodes", seen.hidden_nodes),
            ("exact_decisions", seen.exact_decisions),
        ]
    }
}

/// The last triangle that was asked for, and its paint.
struct Ground {
    id: u32,
    paint: Paint,
    /// Its code values.
    code: [u8; 4],
}

/// The planes that show how the stencil came about.
pub const TRACES: [&str; 4] = ["stencil", "stencil-front", "stencil-back", "overdraw"];

/// n x n samples a pixel.
fn lattice(view: &ViewFrame, n: u32) -> Lattice {
    let step = 1.0 / f64::from(n);
    Lattice {
        x: step / 2.0,
        y: step / 2.0,
        step,
        columns: view.width() * n as usize,
        rows: view.height() * n as usize,
    }
}

/// The planes of a tile, rows from the top.
fn samples_of(tile: &Tile, traces: &Traces) -> SampleTraces {
    let (width, height) = (tile.view.width, tile.view.height);
    let gather = |of: &dyn Fn((usize, usize)) -> u32| {
        (0..width * height).map(|k| of(tile.index(k % width, k / width))).collect()
    };
    let of_counts = |plane: &Vec<[u32; SIZE]>| gather(&|(block, at)| plane[block][at]);
    let planes = [
        gather(&|(block, at)| u32::from(traces.stencil[block][at])),
        of_counts(&traces.front),
        of_counts(&traces.back),
        of_counts(&traces.overdraw),
    ];
    SampleTraces { width, planes }
}

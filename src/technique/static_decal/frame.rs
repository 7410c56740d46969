//! One frame: blocks of pixels, what their samples see, which decals hold them (3.4.1).

use super::Prepare;
use super::analytic::EdgePainter;
use super::step::Step;
use super::structures;
use crate::buffer::{Buffer, Plane, Touches, Values};
use crate::canvas::{
    Backdrop, BlockSamples, Frame, FrameOptions, GBuffer, Kept, LastGround, Pixels, Record, picture_plane,
    surface_plane,
};
use crate::decal::{Hits, LookupCounts, MOST_TOGETHER, Mean, Memory, Palette, Shares};
use crate::error::Result;
use crate::parallel;
use crate::raster::Lattice;
use crate::resolve::{Paint, code_values};
use crate::space::{Plan, ViewFrame};
use crate::technique::static_decal::Edges;
use crate::terrain::{Mesh, SKY};
use crate::tiling::{TilePlace, Tiling};

/// The buffers of a picture in the order in which a frame has them, behind the structures.
const ORDER: [&str; 7] = ["depth", "triangle", "plan", "color", "cell", "nodes", "tests"];

/// The most pixels a side of a block: what its samples see stays in a processor's cache.
const MOST_OF_A_BLOCK: usize = 64;

/// No cell.
const NO_CELL: u32 = u32::MAX;

/// What stays the same for all pixels.
struct Painter<'a> {
    prepared: &'a Prepare<'a>,
    mesh: &'a Mesh,
    view: &'a ViewFrame,
    backdrop: Backdrop<'a>,
    palette: Palette<'a>,
}

/// A finished block.
struct Block {
    pixels: Pixels,
    nodes: Kept<u32>,
    tests: Kept<u32>,
    touches: Touches,
    counts: Counts,
}

/// What was done.
#[derive(Debug, Default, Clone, Copy)]
struct Counts {
    /// Samples on the terrain that were looked up.
    samples: u64,
    nodes: u64,
    leaves: u64,
    quadtree_nodes: u64,
    edges: u64,
    /// Items that were found at pixels.
    hits: u64,
}

impl Counts {
    fn add(&mut self, of: LookupCounts, hits: &Hits) {
        self.nodes += u64::from(of.nodes);
        self.leaves += u64::from(of.leaves);
        self.quadtree_nodes += of.quadtree_nodes;
        self.edges += of.edges;
        self.hits += hits.found().len() as u64;
    }
}

/// Room for the lists of one pixel, used again from pixel to pixel.
struct Lists {
    last: LastGround,
    hits: Hits,
    shares: Shares,
    points: [Plan; MOST_TOGETHER],
    grounds: [Paint; MOST_TOGETHER],
}

/// Draws a frame of a view.
///
/// # Errors
/// When a structure that is wanted has more rows than can be numbered.
pub(super) fn draw(prepared: &Prepare, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
    let structures = structures::planes(&prepared.decals, options, &|share| (options.progress)(0.5 * share))?;
    let before = if structures.is_empty() { 0.0 } else { 0.5 };
    let progress = |share: f64| (options.progress)(before + (1.0 - before) * share);
    let mesh = &*prepared.stage.mesh_for(view);
    let painter = Painter::new(prepared, mesh, view);
    let tiling = Tiling::new(view.width(), view.height(), options.tile.min(MOST_OF_A_BLOCK));
    let mut blocks =
        parallel::map_telling(tiling.count(), &progress, |k| painter.block(&tiling.place(k), options));
    let mut touches = options.touches(view.width());
    blocks.iter_mut().for_each(|block| touches.take(std::mem::take(&mut block.touches)));
    let picks = touches.planes(view.height(), &|name| options.wants(name));
    let codes = tiling.assembled([0; 4], blocks.iter().map(|block| block.pixels.codes()));
    let wants_surface = ["depth", "triangle", "plan", "cell"].iter().any(|name| options.wants(name));
    let centres = wants_surface.then(|| {
        let lattice = Lattice::centres(view, 0);
        GBuffer::new(view, mesh, &prepared.stage.scene.device, lattice, options.tile)
    });
    let wanted = ORDER.into_iter().filter(|name| options.wants(name));
    let plane = |name| plane(name, prepared, (&tiling, &blocks), centres.as_ref());
    Ok(Frame {
        image: Buffer::from_values(view.width(), view.height(), codes),
        planes: structures.into_iter().chain(wanted.filter_map(plane)).chain(picks).collect(),
        counts: counts(&blocks, &prepared.decals.memory()),
    })
}

/// Decides one pixel of a view as a frame does: its steps and its code values.
pub(super) fn explain(prepared: &Prepare, view: &ViewFrame, corner: [usize; 2]) -> (Vec<Step>, [u8; 4]) {
    let mesh = &*prepared.stage.mesh_for(view);
    let painter = Painter::new(prepared, mesh, view);
    let samples = painter.see(&TilePlace { corner, size: [1, 1] });
    let mut steps = Vec::new();
    let pixel = ([0, 0], corner);
    let (paint, ..) =
        painter.pixel(&samples, pixel, &mut painter.lists(), &mut Counts::default(), &mut steps);
    (steps, code_values(painter.backdrop.compositor.encoded(paint)))
}

impl<'a> Painter<'a> {
    fn new(prepared: &'a Prepare<'a>, mesh: &'a Mesh, view: &'a ViewFrame) -> Self {
        let scene = &prepared.stage.scene;
        let backdrop = Backdrop::of(scene, mesh);
        let palette = Palette::new(&prepared.stage.draw_list, backdrop.compositor, scene.compositing.mode);
        Self { prepared, mesh, view, backdrop, palette }
    }

    fn lists(&self) -> Lists {
        Lists {
            last: self.backdrop.no_ground(),
            hits: Hits::default(),
            shares: Shares::default(),
            points: [Plan::default(); MOST_TOGETHER],
            grounds: [self.backdrop.sky; MOST_TOGETHER],
        }
    }

    fn see(&self, place: &TilePlace) -> BlockSamples<'a> {
        let device = &self.prepared.stage.scene.device;
        BlockSamples::new((self.view, self.mesh, device), place, self.prepared.pattern)
    }

    fn block(&self, place: &TilePlace, options: &FrameOptions) -> Block {
        let samples = self.see(place);
        let [width, height] = place.size;
        let mut lists = self.lists();
        let mut block = Block {
            pixels: Pixels::new(self.backdrop.compositor, width * height, options.wants("color")),
            nodes: Kept::new(options.wants("nodes")),
            tests: Kept::new(options.wants("tests")),
            touches: options.touches(self.view.width()),
            counts: Counts::default(),
        };
        let middle = self.prepared.pattern.middle();
        let is_analytic = self.prepared.settings.edges == Edges::Analytic;
        if !is_analytic && self.prepared.decals.is_bare(&samples.plan_bounds()) {
            self.bare_block(&samples, place, &mut lists.last, &mut block);
            return block;
        }
        for y in 0..height {
            for x in 0..width {
                let at = ([x, y], [place.corner[0] + x, place.corner[1] + y]);
                let (paint, is_ground, done) = if block.touches.is_wanted() {
                    let mut steps = Vec::new();
                    let pixel = self.pixel(&samples, at, &mut lists, &mut block.counts, &mut steps);
                    steps.iter().for_each(|step| touch(step, at.1, middle, &mut block.touches));
                    pixel
                } else {
                    self.pixel(&samples, at, &mut lists, &mut block.counts, &mut ())
                };
                if is_ground {
                    block.pixels.push_ground(paint)
                } else {
                    block.pixels.push(paint)
                }
                block.nodes.push(|| done.nodes);
                block.tests.push(|| done.leaves);
            }
        }
        block
    }

    /// The pixels of a block that sees no decals: as [`Self::pixel`] finds them.
    fn bare_block(
        &self,
        samples: &BlockSamples,
        place: &TilePlace,
        last: &mut LastGround,
        block: &mut Block,
    ) {
        let total = self.prepared.pattern.count();
        let [width, height] = place.size;
        for at in (0..height).flat_map(|y| (0..width).map(move |x| [x, y])) {
            let first = samples.sample(at, 0).0;
            let (mut is_one_triangle, mut seen) = (true, 0);
            for k in 0..total {
                let triangle = samples.sample(at, k).0;
                is_one_triangle &= triangle == first;
                seen += u64::from(triangle != SKY);
            }
            block.counts.samples += seen;
            let paint = if is_one_triangle && self.backdrop.is_constant_on_triangles() {
                // The mean of what is all the same.
                self.backdrop.paint_at(last, first, Plan::default)
            } else {
                let mut mean = Mean::default();
                for (triangle, plan) in (0..total).map(|k| samples.sample(at, k)) {
                    mean.add(self.backdrop.paint_at(last, triangle, || plan));
                }
                mean.paint()
            };
            block.pixels.push_ground(paint);
            block.nodes.push(|| 0);
            block.tests.push(|| 0);
        }
    }

    /// The paint of a pixel (its place in the block, and in the picture), whether that is the ground's or the sky's alone, and what was done.
    #[inline(always)]
    fn pixel<R: Record<Step>>(
        &self,
        samples: &BlockSamples,
        (place, in_picture): ([usize; 2], [usize; 2]),
        lists: &mut Lists,
        counts: &mut Counts,
        record: &mut R,
    ) -> (Paint, bool, LookupCounts) {
        let total = self.prepared.pattern.count();
        let (mut mean, mut is_ground, mut done) = (Mean::default(), true, LookupCounts::default());
        for first in (0..total).step_by(MOST_TOGETHER) {
            let count = (total - first).min(MOST_TOGETHER);
            for k in 0..count {
                let (triangle, plan) = samples.sample(place, first + k);
                let ground = self.backdrop.paint_at(&mut lists.last, triangle, || plan);
                (lists.points[k], lists.grounds[k]) = (plan, ground);
                counts.samples += u64::from(triangle != SKY);
                record.step(|| match triangle {
                    SKY => Step::Sky { sample: first + k },
                    _ => {
                        let cell = self.prepared.decals.cell_of(plan);
                        Step::Sample { sample: first + k, triangle, plan, cell, ground }
                    }
                });
            }
            let (points, grounds) = (&lists.points[..count], &lists.grounds[..count]);
            let mut of_these = LookupCounts::default();
            if self.prepared.settings.edges == Edges::Analytic {
                let edges = EdgePainter::new(self.view, self.mesh, &self.prepared.decals, &self.palette);
                let triangle = samples.sample(place, 0).0;
                let paint = edges.paint((triangle, points[0], in_picture), grounds[0], &mut lists.shares);
                is_ground &= lists.shares.found().is_empty();
                mean.add(paint);
                lists
                    .shares
                    .found()
                    .iter()
                    .for_each(|(item, share)| record.step(|| Step::Share { item: *item, share: *share }));
            } else {
                self.prepared.decals.find(points, &self.palette, &mut lists.hits, &mut of_these);
                is_ground &= lists.hits.is_empty();
                mean.add_over(grounds, &lists.hits, &self.palette);
                counts.add(of_these, &lists.hits);
                tell(&lists.hits, first, of_these, record);
            }
            done = done.plus(of_these);
        }
        let paint = mean.paint();
        record.step(|| Step::Mean(paint));
        (paint, is_ground, done)
    }
}

/// Records what was found for samples from `first` on.
#[inline(always)]
fn tell<R: Record<Step>>(hits: &Hits, first: usize, done: LookupCounts, record: &mut R) {
    record.step(|| {
        let LookupCounts { nodes, leaves, quadtree_nodes, edges } = done;
        Step::Search { nodes, leaves, quadtree_nodes, edges }
    });
    for hit in hits.found() {
        record.step(|| {
            let samples = (0..MOST_TOGETHER).filter(|k| hit.samples >> k & 1 == 1).map(|k| first + k);
            Step::Hit { item: hit.item, samples: samples.collect() }
        });
    }
}

/// The item that a step tells of touches its pixel; `middle` is the sample that counts as the pixel's middle. A straight border holds the centre of
/// a pixel of which it has more than a half.
fn touch(step: &Step, pixel: [usize; 2], middle: usize, touches: &mut Touches) {
    match step {
        Step::Hit { item, samples } => touches.push(pixel, *item, samples.contains(&middle)),
        Step::Share { item, share } => touches.push(pixel, *item, *share >= 0.5),
        Step::Sky { .. } | Step::Sample { .. } | Step::Search { .. } | Step::Mean(_) => {}
    }
}

fn plane(
    name: &'static str,
    prepared: &Prepare,
    (tiling, blocks): (&Tiling, &[Block]),
    centres: Option<&GBuffer>,
) -> Option<Plane> {
    let size = tiling.size();
    let counted = |of: fn(&Block) -> &[u32]| {
        let values = tiling.assembled(0, blocks.iter().map(of));
        Some(picture_plane(name, size, 1, Values::U32(values)))
    };
    match name {
        "color" => {
            let colors = tiling.assembled([0.0; 4], blocks.iter().map(|block| block.pixels.colors()));
            Some(picture_plane("color", size, 4, Values::F64(colors.into_flattened())))
        }
        "cell" => {
            let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
            let cell = |(x, y)| prepared.decals.cell_of(centres?.plan(x, y)).or(Some(NO_CELL));
            Some(picture_plane("cell", size, 1, Values::U32(pixels.map(cell).collect::<Option<_>>()?)))
        }
        "nodes" => counted(|block| block.nodes.values()),
        "tests" => counted(|block| block.tests.values()),
        _ => surface_plane(name, centres?.sight(), 0),
    }
}

fn counts(blocks: &[Block], memory: &Memory) -> Vec<(&'static str, u64)> {
    let sum = |f: fn(&Counts) -> u64| blocks.iter().map(|block| f(&block.counts)).sum();
    vec![
        ("samples", sum(|c| c.samples)),
        ("nodes", sum(|c| c.nodes)),
        ("leaves", sum(|c| c.leaves)),
        ("quadtree_nodes", sum(|c| c.quadtree_nodes)),
        ("edges", sum(|c| c.edges)),
        ("hits", sum(|c| c.hits)),
        ("cells", memory.cells as u64),
        ("grid_bytes", memory.grid as u64),
        ("line_bytes", memory.lines as u64),
        ("polygon_bytes", memory.polygons as u64),
        ("quadtree_bytes", memory.quadtrees as u64),
        ("index_bytes", memory.index as u64),
    ]
}

//! A tile of the picture: what its pixels see, which items are near its blocks, each pixel's paint.

use super::convex::{area, middle};
use super::coverage::Class;
use super::facet::Facet;
use super::features::Features;
use super::gather;
use super::items::{Items, Lists, Painted, Place, SAGITTA};
use super::look::Looks;
use super::near::Near;
use super::samples::{fragment_at, seen_sample};
use super::settings::Settings;
use super::sheet::{BLOCK, FULL, Sheet};
use super::step::{Fallback, Step};
use super::texels::Texels;
use crate::buffer::Touches;
use crate::canvas::{Backdrop, GBuffer, LastGround, Record};
use crate::math;
use crate::raster::Lattice;
use crate::resolve::Paint;
use crate::scene::Device;
use crate::space::{Lens, Plan, PlanBox, ViewFrame};
use crate::terrain::Mesh;
use crate::tiling::TilePlace;
use glam::DVec2;

/// What stays the same for all tiles of a frame.
#[derive(Debug)]
pub(super) struct Painter<'a> {
    pub(super) features: &'a Features<'a>,
    pub(super) settings: Settings,
    pub(super) view: &'a ViewFrame,
    pub(super) mesh: &'a Mesh,
    pub(super) backdrop: Backdrop<'a>,
    pub(super) looks: &'a Looks<'a>,
    pub(super) texels: Option<Texels>,
}

/// What a thread needs for a tile; used again.
#[derive(Debug, Default)]
pub(super) struct Room {
    sheet: Sheet,
    tile: Near,
    block: Near,
    pixel: Near,
    /// A box of the block in which what `pixel` has is all that there is, if it covers all of its pixel.
    clear: Option<PlanBox>,
    lists: Lists,
    plan: Vec<Plan>,
    polygon: [Vec<DVec2>; 2],
    /// What each block sees of the plan.
    boxes: Vec<PlanBox>,
    /// The tile's corner.
    origin: DVec2,
}

/// A finished pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pixel {
    pub(super) paint: Paint,
    /// 0 to 3 as [`Class`], 4 where it was sampled.
    pub(super) class: u8,
    pub(super) edges: u32,
    pub(super) fragments: u32,
    /// 0: no; else why it was sampled.
    pub(super) fallback: u8,
}

/// The class of pixels that are sampled.
pub(super) const SAMPLED: u8 = 4;

/// Why a pixel was sampled, as buffers have it.
fn number_of(why: Fallback) -> u8 {
    match why {
        Fallback::Fragments => 1,
        Fallback::Crowd => 2,
        Fallback::Width => 3,
    }
}

fn class_of(class: Class) -> u8 {
    match class {
        Class::Point => 0,
        Class::Half => 1,
        Class::Band => 2,
        Class::Slabs => 3,
    }
}

impl<'a> Painter<'a> {
    /// The pixels of a tile, row by row from the top; and which items touch them, where that is wanted.
    pub(super) fn tile(&self, place: &TilePlace, room: &mut Room, touches: &mut Touches) -> Vec<Pixel> {
        let [width, height] = place.size;
        room.lists.wants_sets = touches.is_wanted();
        let empty = Pixel { paint: self.backdrop.sky, class: 0, edges: 0, fragments: 0, fallback: 0 };
        let mut pixels = vec![empty; width * height];
        let samples = self.see(place, room);
        let mut last = self.backdrop.no_ground();
        for (k, block) in blocks(place).enumerate() {
            self.look_near(k, &block, room);
            for (x, y) in pixels_of(&block) {
                pixels[y * width + x] = if touches.is_wanted() {
                    let mut steps = Vec::new();
                    let pixel = self.pixel([x, y], samples.as_ref(), room, &mut last, &mut steps);
                    let items = self.held(([x, y], &pixel), samples.as_ref(), room, &steps);
                    let at = [place.corner[0] + x, place.corner[1] + y];
                    items.for_each(|(item, is_central)| touches.push(at, item, is_central));
                    pixel
                } else {
                    self.pixel([x, y], samples.as_ref(), room, &mut last, &mut ())
                };
            }
        }
        pixels
    }

    /// The items that cover some of a pixel, by its steps or its samples, and those that hold its middle.
    fn held(
        &self,
        (at, pixel): ([usize; 2], &Pixel),
        samples: Option<&GBuffer>,
        room: &mut Room,
        steps: &[Step],
    ) -> impl Iterator<Item = (u32, bool)> + use<> {
        let mut held = Vec::new();
        for step in steps {
            if let Step::Covered { items, share } = step
                && *share > 0.0
            {
                held.extend(items.iter().map(|item| (*item, false)));
            }
        }
        let n = if pixel.class == SAMPLED { self.settings.samples as usize } else { 1 };
        let middle = (n - 1) / 2;
        for place in (0..n * n).map(|k| [k % n, k / n]) {
            room.lists.sets.clear();
            self.sample(at, (place, n), samples, room, &mut self.backdrop.no_ground());
            let items = room.lists.sets.iter().flat_map(|(items, _)| items);
            held.extend(items.map(|item| (*item, place == [middle, middle])));
        }
        held.into_iter()
    }

    /// Decides one pixel of a tile as [`Self::tile`] does.
    pub(super) fn one<R: Record<Step>>(&self, place: &TilePlace, at: [usize; 2], record: &mut R) -> Paint {
        let mut room = Room::default();
        room.lists.wants_sets = true;
        let samples = self.see(place, &mut room);
        let mut blocks = blocks(place).enumerate();
        if let Some((k, block)) = blocks.find(|(_, block)| pixels_of(block).any(|(x, y)| [x, y] == at)) {
            self.look_near(k, &block, &mut room);
        }
        self.pixel(at, samples.as_ref(), &mut room, &mut self.backdrop.no_ground(), record).paint
    }

    /// Finds what the pixels of a tile see: fragments, and the samples of all if some have too many; then what is near them.
    fn see(&self, place: &TilePlace, room: &mut Room) -> Option<GBuffer<'a>> {
        let is_sampled = self.settings.fragments == 0 || self.settings.crowd == 0;
        let budget = if is_sampled { 0 } else { self.settings.fragments as usize };
        room.sheet.reset(place.size, budget);
        room.origin = DVec2::new(place.corner[0] as f64, place.corner[1] as f64);
        let is_constant = self.backdrop.is_constant_on_triangles();
        let ground = |id| match is_constant {
            true => self.backdrop.paint_at(&mut self.backdrop.no_ground(), id, Plan::default),
            false => Paint::CLEAR,
        };
        gather::see(self.view, self.mesh, place, &ground, &mut room.sheet);
        room.boxes.clear();
        let mut plan = PlanBox::EMPTY;
        for block in blocks(place) {
            let of_block = room.sheet.plan_of_block(block.corner);
            plan.include_box(&of_block);
            room.boxes.push(of_block);
        }
        room.tile.find(self.features, self.looks, &plan, self.widest(&room.sheet));
        let whole = TilePlace { corner: [0, 0], size: place.size };
        // A crowded pixel without a border needs its mean ground alone, and that may be known.
        let is_bare = room.tile.is_plain() && !room.lists.wants_sets && self.is_linear(&room.tile);
        let is_lost = |at| room.sheet.is_crowded(at) && !(is_bare && room.sheet.ground(at).is_some());
        let has_lost = pixels_of(&whole).any(|(x, y)| is_lost([x, y]));
        has_lost.then(|| {
            let lattice = Lattice::samples(place.corner, place.size, self.settings.samples as usize);
            GBuffer::new(self.view, self.mesh, &Device::default(), lattice, lattice.columns.max(lattice.rows))
        })
    }

    /// Whether items composed over the mean of some grounds are the mean of the items over each.
    fn is_linear(&self, near: &Near) -> bool {
        self.texels.is_none() && (self.looks.is_linear() || near.items.is_empty())
    }

    /// Half the width in the plan that a stroke of one pixel has at most where a tile sees the terrain.
    fn widest(&self, sheet: &Sheet) -> f64 {
        let Lens::Central { pixel } = self.view.lens() else { return 0.5 * self.view.lens().pixel() };
        if !self.features.has_dynamic() {
            return 0.0;
        }
        let all = self.mesh.farthest_from(self.view.eye());
        let least = sheet.least_key();
        // The ray of the picture's corner is the longest.
        let (w, h) = (0.5 * pixel * self.view.width() as f64, 0.5 * pixel * self.view.height() as f64);
        let seen = if least > 0.0 { (1.0 + w * w + h * h).sqrt() / least } else { f64::INFINITY };
        0.5 * pixel * (1.0 + 1e-6) * math::min(seen, all)
    }

    /// Finds what is near a block of a tile.
    fn look_near(&self, number: usize, block: &TilePlace, room: &mut Room) {
        let Room { sheet, tile, block: near, lists, .. } = room;
        tile.narrow(self.looks, &room.boxes[number], near);
        lists.plain = None;
        room.clear = None;
        if near.has_strokes() {
            let sagitta = SAGITTA * self.finest(block, sheet);
            near.make_pieces(self.looks, self.view.lens(), sagitta, &mut lists.pieces);
        }
    }

    /// About the least metres that a pixel of a block has in the plan.
    fn finest(&self, block: &TilePlace, sheet: &Sheet) -> f64 {
        let TilePlace { corner: [x, y], size: [width, height] } = *block;
        let places = |from: usize, count: usize| [from, from + count / 2, from + count - 1];
        let mut least = f64::INFINITY;
        for at in places(y, height).into_iter().flat_map(|y| places(x, width).map(|x| [x, y])) {
            let middle = DVec2::new(at[0] as f64 + 0.5, at[1] as f64 + 0.5);
            for fragment in sheet.fragments(at) {
                least = math::min(sheet.facets[fragment.facet as usize].finest_at(middle), least);
            }
        }
        // Half of it for the pixels in between; what samples alone see is not known.
        if least < f64::INFINITY { 0.5 * least } else { 0.01 * self.mesh.resolution() }
    }

    fn items(&self) -> Items<'_> {
        Items {
            view: self.view,
            mesh: self.mesh,
            looks: self.looks,
            compositor: self.backdrop.compositor,
            crowd: self.settings.crowd as usize,
        }
    }

    /// A pixel of a tile whose block has been looked at.
    fn pixel<R: Record<Step>>(
        &self,
        at: [usize; 2],
        samples: Option<&GBuffer>,
        room: &mut Room,
        last: &mut LastGround,
        record: &mut R,
    ) -> Pixel {
        if room.sheet.is_sky(at) {
            record.step(|| Step::Sky { area: 1.0 });
            record.step(|| Step::Mean(self.backdrop.sky));
            return Pixel { paint: self.backdrop.sky, class: 0, edges: 0, fragments: 0, fallback: 0 };
        }
        let why = match self.exact(at, room, last, record) {
            Ok(pixel) => return pixel,
            Err(why) => why,
        };
        let paint = self.sampled(at, samples, room, last);
        let n = self.settings.samples as usize;
        record.step(|| Step::Sampled { why, samples: n * n });
        record.step(|| Step::Mean(paint));
        let fragments = room.sheet.fragments(at).count() as u32;
        Pixel { paint, class: SAMPLED, edges: 0, fragments, fallback: number_of(why) }
    }

    /// A pixel by areas: of the ground alone where no border of an item lies in it.
    fn exact<R: Record<Step>>(
        &self,
        at: [usize; 2],
        room: &mut Room,
        last: &mut LastGround,
        record: &mut R,
    ) -> Result<Pixel, Fallback> {
        let Room { sheet, block, pixel: own, clear, lists, .. } = room;
        if sheet.is_crowded(at) && sheet.ground(at).is_none() {
            return Err(Fallback::Fragments);
        }
        let near = if block.is_plain() {
            &*block
        } else {
            let plan = sheet.plan_of_pixel(at);
            let mut joint = plan;
            let goes_on = clear.is_some_and(|before| {
                joint.include_box(&before);
                block.is_clear(&joint)
            });
            if !goes_on {
                block.narrow(self.looks, &plan, own);
                lists.plain = None;
            }
            *clear = own.is_plain().then_some(plan);
            &*own
        };
        if near.is_plain()
            && self.is_linear(near)
            && let Some((ground, covered, triangles)) = sheet.ground(at)
        {
            record.step(|| Step::Ground { triangles, area: covered, ground });
            let painted = self.items().paint_plain(near, ground, lists);
            record_sets(lists, record);
            let sky = 1.0 - covered;
            let paint = if sky > 0.0 {
                record.step(|| Step::Sky { area: sky });
                painted.paint.times(covered).plus(self.backdrop.sky.times(sky))
            } else {
                painted.paint
            };
            record.step(|| Step::Mean(paint));
            return Ok(Pixel { paint, class: 0, edges: 0, fragments: triangles, fallback: 0 });
        }
        self.by_fragments(at, room, last, record)
    }

    /// A pixel by its fragments.
    fn by_fragments<R: Record<Step>>(
        &self,
        at: [usize; 2],
        room: &mut Room,
        last: &mut LastGround,
        record: &mut R,
    ) -> Result<Pixel, Fallback> {
        let Room { sheet, block, pixel: own, lists, plan, polygon, .. } = room;
        if sheet.is_crowded(at) {
            return Err(Fallback::Fragments);
        }
        let near = if block.is_plain() { &*block } else { &*own };
        let items = self.items();
        let mut pixel = Pixel { paint: Paint::CLEAR, class: 0, edges: 0, fragments: 0, fallback: 0 };
        let mut covered = 0.0;
        for fragment in sheet.fragments(at) {
            let (facet, corners) =
                (&sheet.facets[fragment.facet as usize], sheet.corners(&fragment, at, polygon));
            covered += fragment.area;
            pixel.fragments += 1;
            if pixel.fragments > self.settings.fragments {
                return Err(Fallback::Fragments);
            }
            let mut add = |part: &[DVec2], record: &mut R| {
                let (area, painted) =
                    self.part(&items, (facet, part, at), near, (lists, plan), last, record)?;
                pixel.paint = pixel.paint.plus(painted.paint.times(area));
                pixel.class = pixel.class.max(class_of(painted.class));
                pixel.edges += painted.edges as u32;
                Ok(())
            };
            match &self.texels {
                None => add(corners, record)?,
                Some(texels) => {
                    let most = self.settings.fragments as usize;
                    let parts = texels.parts(facet, corners, most).ok_or(Fallback::Fragments)?;
                    parts.iter().try_for_each(|part| add(part, record))?;
                }
            }
        }
        if covered < FULL {
            record.step(|| Step::Sky { area: 1.0 - covered });
            pixel.paint = pixel.paint.plus(self.backdrop.sky.times(1.0 - covered));
        } else {
            pixel.paint = pixel.paint.divided_by(covered);
        }
        record.step(|| Step::Mean(pixel.paint));
        Ok(pixel)
    }

    /// A part of a pixel over which the ground has one paint: its area, and what it shows.
    fn part<R: Record<Step>>(
        &self,
        items: &Items,
        (facet, corners, [x, y]): (&Facet, &[DVec2], [usize; 2]),
        near: &Near,
        (lists, plan): (&mut Lists, &mut Vec<Plan>),
        last: &mut LastGround,
        record: &mut R,
    ) -> Result<(f64, Painted), Fallback> {
        // A triangle that stands upright in the plan is asked at its middle alone.
        let (area, middle) = (area(corners), [middle(corners)]);
        let screen = if facet.has_plan() { corners } else { &middle };
        let ground = match self.backdrop.is_constant_on_triangles() {
            true => facet.ground,
            false => self.backdrop.paint_at(last, facet.id, || facet.plan_at(middle[0])),
        };
        record.step(|| Step::Fragment {
            triangle: facet.id,
            area,
            corners: corners.iter().map(|p| [p.x - x as f64, p.y - y as f64]).collect(),
            ground,
        });
        let painted = if near.is_plain() {
            items.paint_plain(near, ground, lists)
        } else {
            plan.clear();
            plan.extend(screen.iter().map(|p| facet.plan_at(*p)));
            let pixel = DVec2::new(x as f64, y as f64);
            items.paint(&Place { facet, screen, plan, pixel }, near, ground, lists)?
        };
        record.step(|| Step::Edges { edges: painted.edges, class: painted.class });
        record_sets(lists, record);
        Ok((area, painted))
    }

    /// A pixel by samples in the middles of equal squares.
    fn sampled(
        &self,
        at: [usize; 2],
        samples: Option<&GBuffer>,
        room: &mut Room,
        last: &mut LastGround,
    ) -> Paint {
        let n = self.settings.samples as usize;
        crate::canvas::mean(n, |column, row| self.sample(at, ([column, row], n), samples, room, last))
    }

    /// What a pixel shows in the middle of one of n x n equal squares.
    fn sample(
        &self,
        at: [usize; 2],
        ([column, row], n): ([usize; 2], usize),
        samples: Option<&GBuffer>,
        room: &mut Room,
        last: &mut LastGround,
    ) -> Paint {
        let Room { sheet, block, lists, origin, .. } = room;
        let place = [column, row].map(|k| (k as f64 + 0.5) / n as f64);
        let screen = DVec2::new(at[0] as f64 + place[0], at[1] as f64 + place[1]);
        let sample = match samples.filter(|_| sheet.is_crowded(at)) {
            Some(seen) => {
                seen_sample((self.view, self.mesh), *origin, seen, [at[0] * n + column, at[1] * n + row])
            }
            None => fragment_at(sheet, at, screen),
        };
        let Some((facet, plan)) = sample else { return self.backdrop.sky };
        let ground = self.backdrop.paint_at(last, facet.id, || plan);
        let place = Place { facet: &facet, screen: &[screen], plan: &[plan], pixel: screen };
        self.items().paint(&place, block, ground, lists).map_or(ground, |painted| painted.paint)
    }
}

/// Tells the sets of items that were found.
fn record_sets<R: Record<Step>>(lists: &Lists, record: &mut R) {
    for (items, share) in &lists.sets {
        record.step(|| Step::Covered { items: items.clone(), share: *share });
    }
}

/// The blocks of a tile, counted from its corner.
fn blocks(place: &TilePlace) -> impl Iterator<Item = TilePlace> {
    let tiling = crate::tiling::Tiling::new(place.size[0], place.size[1], BLOCK);
    (0..tiling.count()).map(move |k| tiling.place(k))
}

/// The columns and rows of a part of a tile.
fn pixels_of(part: &TilePlace) -> impl Iterator<Item = (usize, usize)> + use<> {
    let TilePlace { corner: [x, y], size: [width, height] } = *part;
    (y..y + height).flat_map(move |y| (x..x + width).map(move |x| (x, y)))
}

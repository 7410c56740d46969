//! Features -> items, block by block.

use super::dash::{InThePlan, check as check_dashes};
use super::style::{StyleParts, StyleTable};
use super::vertices::{Ends, add_distinct, are_distinct};
use super::{Chain, DrawList, Item, ItemStyle, NO_FEATURE};
use crate::error::{Error, Result};
use crate::overlay::{border_outside, union_border};
use crate::parallel;
use crate::scene::{Dash, Dashed, Feature, Layer, Rule, Shape};
use crate::space::{Plan, PlanBox};
use std::ops::Range;

/// Features that are one piece of work.
const FEATURES_AT_A_TIME: usize = 1024;

/// Blocks that are in memory together.
const BLOCKS_AT_A_TIME: usize = 16;

/// The most items, chains and vertices: twice an item's number, and what lies behind a chain's end, can be numbered too.
const MOST: usize = u32::MAX as usize / 2;

/// A border of fewer vertices encloses nothing.
const FEWEST_OF_A_BORDER: usize = 3;

/// Some features of a layer, one after the other.
struct Block {
    layer: usize,
    /// The first one's place in the layer.
    first: usize,
    features: Vec<Feature>,
    /// What is outside of all of the layer's polygons, if that is painted; in a block before its features.
    outside: Option<Outside>,
}

/// What is to be painted outside of a layer's polygons.
struct Outside {
    style: u32,
    /// The members of all polygons, each as rings.
    members: Vec<Vec<Vec<Plan>>>,
}

/// The list of some layers, whose features it takes.
pub(super) fn of_layers(layers: &mut [Layer], terrain: &PlanBox) -> Result<DrawList> {
    check_dashes(layers)?;
    let mut table = StyleTable::default();
    let parts: Vec<Vec<StyleParts>> =
        layers.iter().enumerate().map(|(k, layer)| table.parts_of(k, layer)).collect();
    let outsides: Vec<Option<Outside>> = layers
        .iter()
        .enumerate()
        .map(|(k, layer)| {
            table.outside_of(k, layer).map(|style| Outside { style, members: members_of(layer) })
        })
        .collect();
    let frame = frame_around(terrain);
    let features = layers.iter().flat_map(|layer| &layer.features);
    let mut all = DrawList::default();
    all.vertices.reserve_exact(features.map(|feature| vertices_of(&feature.shape)).sum());
    let mut blocks = blocks(layers, outsides).into_iter();
    loop {
        // Not all at once: a block's features go when its list is made, its list when it is added.
        let some: Vec<Block> = blocks.by_ref().take(BLOCKS_AT_A_TIME).collect();
        if some.is_empty() {
            break;
        }
        let made = parallel::map_owned(some, |block| {
            let layer = block.layer;
            (layer, made((&table.styles, &parts[layer], &frame), block))
        });
        for (layer, block) in made {
            let added = block.and_then(|block| all.append(block));
            added.map_err(|error| error.in_layer(layer, &layers[layer].name))?;
        }
    }
    all.take_styles(&table.styles);
    Ok(all)
}

/// The members of all of a layer's polygons, each as rings.
fn members_of(layer: &Layer) -> Vec<Vec<Vec<Plan>>> {
    let members = layer.features.iter().flat_map(|feature| match &feature.shape {
        Shape::Polygon(rings) => std::slice::from_ref(rings),
        Shape::MultiPolygon(members) | Shape::Swath { members, .. } => members,
        Shape::Line(_) | Shape::Points(_) => &[],
    });
    members.cloned().collect()
}

/// A frame so far outside of the terrain that no filter at the terrain's edge sees it.
fn frame_around(terrain: &PlanBox) -> PlanBox {
    let size = terrain.max - terrain.min;
    terrain.grown(size.max_element())
}

/// The features of all layers, which then have none.
fn blocks(layers: &mut [Layer], outsides: Vec<Option<Outside>>) -> Vec<Block> {
    let mut blocks = Vec::new();
    for ((layer, of), outside) in layers.iter_mut().enumerate().zip(outsides) {
        if outside.is_some() {
            blocks.push(Block { layer, first: 0, features: Vec::new(), outside });
        }
        let count = of.features.len();
        let mut features = std::mem::take(&mut of.features).into_iter();
        for first in (0..count).step_by(FEATURES_AT_A_TIME) {
            let features = features.by_ref().take(FEATURES_AT_A_TIME).collect();
            blocks.push(Block { layer, first, features, outside: None });
        }
    }
    blocks
}

/// What a block becomes.
fn made((styles, parts, frame): (&[ItemStyle], &[StyleParts], &PlanBox), block: Block) -> Result<DrawList> {
    let mut list = DrawList::default();
    list.vertices.reserve_exact(block.features.iter().map(|feature| vertices_of(&feature.shape)).sum());
    if let Some(outside) = &block.outside {
        list.add_outside(block.layer, outside, (styles[outside.style as usize].rule, frame))?;
    }
    for (k, feature) in block.features.into_iter().enumerate() {
        let item = Item {
            layer: block.layer as u32,
            feature: (block.first + k) as u32,
            number: feature.index as u32,
            style: 0,
            area: 0..0,
            border: 0..0,
            strokes: 0..0,
            centre_lines: 0..0,
        };
        let style = &parts[feature.style as usize];
        match feature.shape {
            Shape::Polygon(rings) => list.add_polygon(item, style, &[rings], None),
            Shape::MultiPolygon(members) => {
                let border = union_of(&members, style.area_rule(styles), feature.index)?;
                list.add_polygon(item, style, &members, border.as_deref());
            }
            Shape::Swath { members, lines } => {
                let border = union_of(&members, style.area_rule(styles), feature.index)?;
                let first = list.chains.len();
                for (part, line) in (0..).zip(&lines) {
                    list.add_stroke((part, 0), line, Ends::AsWritten);
                }
                let centre_lines = list.chains_from(first);
                list.add_polygon(Item { centre_lines, ..item }, style, &members, border.as_deref());
            }
            Shape::Line(lines) => list.add_line(item, style, &lines),
            Shape::Points(points) => list.add_points(item, style, &points),
        }
    }
    Ok(list)
}

/// The border of the union of members, by a rule; `None` where it is that of the members, or no area counts.
fn union_of(
    members: &[Vec<Vec<Plan>>],
    rule: Option<Rule>,
    feature: usize,
) -> Result<Option<Vec<Vec<Plan>>>> {
    let border = rule.map_or(Ok(None), |rule| union_border(members, &|turns| rule.contains(turns)));
    border.map_err(|error| error.in_feature(feature))
}

/// How many vertices of a shape are held, if none is left out or held twice.
fn vertices_of(shape: &Shape) -> usize {
    shape.parts().map(|part| part.len() + 1).sum()
}

/// Whether so many can be numbered.
fn check(count: usize, what: &str) -> Result<()> {
    if count <= MOST {
        return Ok(());
    }
    Err(Error::unsupported(format!("more {what} than this program can number"))
        .help("give the terrain a `window`"))
}

impl DrawList {
    fn add_line(&mut self, item: Item, style: &StyleParts, lines: &[Vec<Plan>]) {
        let (Some(number), dash) = (style.line, &style.line_dash) else { return };
        let first = self.chains.len();
        for (part, line) in (0..).zip(lines) {
            self.add_stroke((part, 0), line, Ends::AsWritten);
        }
        let (strokes, centre_lines) = self.dashed(self.chains_from(first), dash.as_ref());
        self.items.push(Item { style: number, strokes, centre_lines, ..item });
    }

    /// What is drawn of some chains, and of dashed ones what they are along.
    fn dashed(&mut self, whole: Range<u32>, dash: Option<&Dash>) -> (Range<u32>, Range<u32>) {
        let Some(dash) = dash else { return (whole, 0..0) };
        let first = self.chains.len();
        for chain in whole.clone() {
            let chain = self.chains[chain as usize];
            let along = dash.along(self.path_of(&chain), chain.is_closed, &InThePlan);
            let Dashed::Parts(parts) = along else {
                self.chains.push(chain);
                continue;
            };
            for part in parts {
                let (first, count) = (self.vertices.len() as u32, part.len() as u32);
                self.vertices.extend(part);
                self.chains.push(Chain { first, count, is_closed: false, ..chain });
            }
        }
        (self.chains_from(first), whole)
    }

    fn add_points(&mut self, item: Item, style: &StyleParts, points: &[Plan]) {
        let Some(style) = style.point else { return };
        let first = self.chains.len();
        for (part, point) in (0..).zip(points) {
            self.add_stroke((part, 0), std::slice::from_ref(point), Ends::AsWritten);
        }
        self.items.push(Item { style, strokes: self.chains_from(first), ..item });
    }

    /// Adds the item of what lies outside of a layer's polygons, by a rule and within a frame.
    fn add_outside(
        &mut self,
        layer: usize,
        Outside { style, members }: &Outside,
        (rule, frame): (Rule, &PlanBox),
    ) -> Result<()> {
        let area = self.add_members(members);
        let first = self.chains.len();
        self.add_rings(&border_outside(members, frame, &|turns| rule.contains(turns))?, 0, 0);
        let border = self.chains_from(first);
        let (feature, number) = (NO_FEATURE, NO_FEATURE);
        self.items.push(Item {
            layer: layer as u32,
            feature,
            number,
            style: *style,
            area,
            border,
            strokes: 0..0,
            centre_lines: 0..0,
        });
        Ok(())
    }

    /// Adds the rings of members.
    fn add_members(&mut self, members: &[Vec<Vec<Plan>>]) -> Range<u32> {
        let (first, mut part) = (self.chains.len(), 0);
        for (member, rings) in (0..).zip(members) {
            self.add_rings(rings, member, part);
            part += rings.len() as u32;
        }
        self.chains_from(first)
    }

    /// Adds the items of polygons, given by their members, and by the border of their union where members overlap.
    fn add_polygon(
        &mut self,
        item: Item,
        style: &StyleParts,
        members: &[Vec<Vec<Plan>>],
        union: Option<&[Vec<Plan>]>,
    ) {
        let area = if style.has_area() { self.add_members(members) } else { 0..0 };
        let border = union.map_or_else(
            || area.clone(),
            |rings| {
                let first = self.chains.len();
                self.add_rings(rings, 0, 0);
                self.chains_from(first)
            },
        );
        let with_area = Item { area: area.clone(), border, ..item.clone() };
        if let Some(style) = style.fill {
            self.items.push(Item { style, ..with_area.clone() });
        }
        let (is_cut, dash) = (style.is_cut, &style.outline_dash);
        let Some(style) = style.outline else { return };
        let whole = self.add_outline(members, &area);
        let (strokes, centre_lines) = self.dashed(whole, dash.as_ref());
        self.items.push(Item { style, strokes, centre_lines, ..if is_cut { with_area } else { item } });
    }

    /// Adds rings that can bound something, numbered from `part` on.
    fn add_rings(&mut self, rings: &[Vec<Plan>], member: u32, part: u32) {
        for (part, ring) in (part..).zip(rings).filter(|(_, ring)| ring.len() >= FEWEST_OF_A_BORDER) {
            let first = self.vertices.len() as u32;
            self.vertices.extend(ring);
            self.vertices.push(ring[0]);
            self.chains.push(Chain { first, count: ring.len() as u32, part, member, is_closed: true });
        }
    }

    /// Adds the strokes along the rings of all members: along those of the area where their vertices are distinct.
    fn add_outline(&mut self, members: &[Vec<Vec<Plan>>], area: &Range<u32>) -> Range<u32> {
        let first = self.chains.len();
        let mut borders = area.clone();
        let rings =
            (0..).zip(members).flat_map(|(member, rings)| rings.iter().map(move |ring| (member, ring)));
        for (part, (member, ring)) in (0..).zip(rings) {
            let own = if ring.len() >= FEWEST_OF_A_BORDER { borders.next() } else { None };
            match own.filter(|_| are_distinct(ring)) {
                Some(border) => self.chains.push(self.chains[border as usize]),
                None => self.add_stroke((part, member), ring, Ends::Joined),
            }
        }
        if self.chains[first..] == self.chains[area.start as usize..area.end as usize] {
            self.chains.truncate(first);
            return area.clone();
        }
        self.chains_from(first)
    }

    fn add_stroke(&mut self, (part, member): (u32, u32), points: &[Plan], ends: Ends) {
        if !points.is_empty() {
            let first = self.vertices.len() as u32;
            let (count, is_closed) = add_distinct(points, ends, &mut self.vertices);
            self.chains.push(Chain { first, count, part, member, is_closed });
        }
    }

    /// Takes those of some styles that items have, in the order of the items.
    fn take_styles(&mut self, styles: &[ItemStyle]) {
        let mut numbers = vec![None; styles.len()];
        for item in &mut self.items {
            let number = &mut numbers[item.style as usize];
            item.style = *number.get_or_insert_with(|| {
                self.styles.push(styles[item.style as usize]);
                self.styles.len() as u32 - 1
            });
        }
    }

    fn chains_from(&self, first: usize) -> Range<u32> {
        first as u32..self.chains.len() as u32
    }

    /// Adds a block after these.
    fn append(&mut self, block: Self) -> Result<()> {
        check(self.items.len() + block.items.len(), "features")?;
        check(self.chains.len() + block.chains.len(), "lines and rings")?;
        check(self.vertices.len() + block.vertices.len(), "vertices")?;
        let (chains, vertices) = (self.chains.len() as u32, self.vertices.len() as u32);
        let moved = |range: &Range<u32>| range.start + chains..range.end + chains;
        let items = block.items.into_iter();
        self.items.extend(items.map(|item| Item {
            area: moved(&item.area),
            border: moved(&item.border),
            strokes: moved(&item.strokes),
            centre_lines: moved(&item.centre_lines),
            ..item
        }));
        let chain = |chain: Chain| Chain { first: chain.first + vertices, ..chain };
        self.chains.extend(block.chains.into_iter().map(chain));
        self.vertices.extend(block.vertices);
        Ok(())
    }
}

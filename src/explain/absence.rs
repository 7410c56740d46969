//! Why a feature is not in a pixel, or that it is.

use super::account::{Account, Presence};
use super::bench::{Bench, Near};
use super::margin::short;
use super::search::Wanted;
use crate::draw_list::Chain;
use crate::scene::BlendMode;
use crate::space::{Plan, Screen, World};
use glam::DVec2;

/// Items are spoken of one by one up to so many.
const MOST_ITEMS: usize = 6;

/// What the terrain hides is behind it by more than this share of its view depth.
const BEHIND: f64 = 1e-6;

/// What is to be said of features at a pixel.
pub(super) fn presence(bench: &Bench, near: &Near, wanted: &Wanted, account: &Account) -> Presence {
    let mut reasons = Vec::new();
    let covering = |item: &u32| account.covering.iter().find(|known| known.item == *item && known.high > 0.0);
    let here: Vec<u32> = wanted.items.iter().copied().filter(|item| covering(item).is_some()).collect();
    let mut shows = false;
    for item in here.iter().take(MOST_ITEMS) {
        shows |= said_of_one_here(bench, *item, account, &mut reasons);
    }
    if here.len() > MOST_ITEMS {
        reasons.push(format!("{} more of it cover parts of the pixel", here.len() - MOST_ITEMS));
    }
    if wanted.items.is_empty() {
        reasons.push(
            "nothing of it is drawn: its layer's style, `where` or the terrain's extent leaves nothing"
                .to_owned(),
        );
    } else if here.is_empty() {
        not_here(bench, near, wanted, &mut reasons);
    }
    Presence { asked: wanted.asked.clone(), shows, reasons }
}

/// What is said of an item that covers a part of the pixel; whether some of it shows.
fn said_of_one_here(bench: &Bench, item: u32, account: &Account, reasons: &mut Vec<String>) -> bool {
    let Some(own) = account.covering.iter().find(|covering| covering.item == item) else { return false };
    let name = &own.name;
    reasons.push(format!("{name} covers {} of the pixel", percent(own.low, own.high)));
    let is_hiding = |other: u32| {
        let is_opaque = bench.paint_of(other).0[3] == 1.0;
        let is_over = bench.stage.scene.compositing.mode == BlendMode::Over;
        is_opaque && is_over && bench.stage.draw_list.style_of(other).group.is_none()
    };
    let above = account.covering.iter().filter(|other| other.item > item && is_hiding(other.item));
    let above: Vec<_> = above.collect();
    for other in above.iter().take(MOST_ITEMS) {
        let share = percent(other.low, other.high);
        reasons.push(format!(
            "{}, which is drawn over it, is opaque and covers {share} of the pixel",
            other.name
        ));
    }
    if bench.paint_of(item).0[3] == 0.0 {
        reasons.push(format!("{name} is wholly transparent"));
    }
    for by in &account.techniques {
        let has_found = by.steps.iter().any(|step| step.items.contains(&item));
        let speaks = by.steps.iter().any(|step| !step.items.is_empty());
        if !has_found && speaks {
            let technique = by.technique;
            reasons.push(format!("{technique} does not find it here: none of its steps is about it"));
        }
    }
    let hidden = above.iter().any(|other| other.low > 1.0 - 1e-9);
    !hidden && bench.paint_of(item).0[3] > 0.0
}

/// A share between two bounds, in words.
pub(super) fn percent(low: f64, high: f64) -> String {
    let [low, high] = [low, high].map(|share| format!("{:.2}", 100.0 * share));
    if low == high { format!("{low} %") } else { format!("{low} to {high} %") }
}

/// What is said where no item covers a part of the pixel.
fn not_here(bench: &Bench, near: &Near, wanted: &Wanted, reasons: &mut Vec<String>) {
    let Some(centre) = near.look.centre else {
        reasons.push("the pixel's centre sees the sky".into());
        return;
    };
    let Some((item, at)) = nearest(bench, wanted, centre.plan) else { return };
    let name = bench.name_of(item);
    let way = at - centre.plan;
    let line = if bench.stage.draw_list.style_of(item).stroke.is_some() { "line" } else { "border" };
    reasons.push(format!(
        "no part of the pixel is in it; the nearest {line} is that of {name}, {} m {} of what the pixel's centre sees",
        short(way.length()),
        compass(way)
    ));
    reasons.push(format!("that place {}", whereabouts(bench, at)));
}

/// The nearest point of the chains of some items to a plan point.
fn nearest(bench: &Bench, wanted: &Wanted, to: Plan) -> Option<(u32, Plan)> {
    let list = &bench.stage.draw_list;
    let mut best: Option<(f64, u32, Plan)> = None;
    for number in &wanted.items {
        let item = &list.items()[*number as usize];
        for chain in list.area(item).iter().chain(list.strokes(item)) {
            let (distance, at) = nearest_on(list.path_of(chain), chain, to);
            if best.is_none_or(|(known, ..)| distance < known) {
                best = Some((distance, *number, at));
            }
        }
    }
    best.map(|(_, number, at)| (number, at))
}

fn nearest_on(path: &[Plan], chain: &Chain, to: Plan) -> (f64, Plan) {
    let on = |a: Plan, b: Plan| {
        let (along, length) = (b - a, (b - a).length_squared());
        let share = if length > 0.0 { ((to - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
        let at = a + along * share;
        ((to - at).length(), at)
    };
    let first = (to - path[0]).length();
    let start = (first, path[0]);
    if chain.segments() == 0 {
        return start;
    }
    path.windows(2)
        .map(|pair| on(pair[0], pair[1]))
        .fold(start, |best, one| if one.0 < best.0 { one } else { best })
}

/// A direction of the plan in words.
fn compass(way: DVec2) -> &'static str {
    const NAMES: [&str; 8] =
        ["east", "north-east", "north", "north-west", "west", "south-west", "south", "south-east"];
    let turn = crate::math::atan2(way.y, way.x) / std::f64::consts::TAU * 8.0;
    NAMES[(turn.round() as i64).rem_euclid(8) as usize]
}

/// Where in the picture a plan point of the terrain is.
fn whereabouts(bench: &Bench, at: Plan) -> String {
    let Some(height) = bench.mesh.height_at(at) else {
        return "lies off the terrain, in a hole of it, or on a globe, where it is not followed".into();
    };
    let world = World::new(at.x, at.y, height);
    let (depth, view) = (bench.view.depth(world), bench.view);
    let Some(screen) = view.screen_from_world(world).filter(|_| depth >= view.near() && depth < view.far())
    else {
        return "lies behind the camera or beyond its planes".into();
    };
    let Screen { x, y } = screen;
    if !(x >= 0.0 && y >= 0.0 && x < view.width() as f64 && y < view.height() as f64) {
        return format!("lies outside of the picture, at {x:.1}, {y:.1}");
    }
    let pixel = [x as usize, y as usize];
    let nears = bench.look(&[pixel]);
    let seen = nears.first().and_then(|near| bench.seen(near, screen));
    match seen {
        Some(seen) if seen.hit.depth < depth * (1.0 - BEHIND) => format!(
            "is hidden: at {x:.1}, {y:.1} the terrain {} m nearer is seen",
            short(depth - seen.hit.depth)
        ),
        _ => format!("is seen at {x:.1}, {y:.1}: pixel {},{}", pixel[0], pixel[1]),
    }
}

//! What is composed at a pixel's centre, from the ground up.

use super::account::Rung;
use super::bench::{Bench, Near, Seen};
use crate::holding::Nearby;
use crate::resolve::{Paint, Stack};

/// The ladder of what a pixel's centre sees.
pub(super) fn ladder(bench: &Bench, near: &Near, centre: Option<&Seen>) -> Vec<Rung> {
    let color = |paint: Paint| bench.backdrop.compositor.encoded(paint);
    let Some(seen) = centre else {
        let is_sky = near.look.centre.is_none();
        let sky = color(bench.backdrop.sky);
        return is_sky.then(|| Rung { name: "sky".into(), color: sky, after: sky }).into_iter().collect();
    };
    let ground = bench.ground(seen);
    let mut stack = Stack::on(ground);
    let mut rungs = vec![Rung { name: "ground".into(), color: color(ground), after: color(ground) }];
    for item in bench.items_at(seen, seen.hit.plan, &mut Nearby::default()) {
        bench.draw(&mut stack, item);
        let name = match bench.stage.draw_list.style_of(item).group {
            Some(group) => format!("{}, in a layer of {} %", bench.name_of(item), 100.0 * group.opacity),
            None => bench.name_of(item),
        };
        rungs.push(Rung { name, color: color(bench.paint_of(item)), after: color(stack.finished()) });
    }
    rungs
}

//! `tables.html`: the tables with bars, one page that needs no network.

use super::super::super::axis::{duration, short};
use super::super::super::page::{STYLE, size};
use super::super::grouped::grouped;
use super::{DataSet, SolutionRow, Tables, WidthRow};
use crate::output::document;
use maud::{Markup, html};

/// The text of the page.
pub fn page(tables: &Tables) -> String {
    let body = html! {
        body {
            header {
                h1 { "Line rasterization for multi-resolution textures" }
                p.lead {
                    "The tables of Taibo et al. 2014, section 5, measured anew in software: what each solution keeps in memory, how long "
                    "it takes to make that, and how long all tiles of the clipmap around the middle take. Percentages are of the best, as "
                    "in the paper's Figures 10 to 12. "
                    @if tables.repeat == 1 { "Times are of one run." }
                    @else { "Times are medians of " (tables.repeat) " runs." }
                }
            }
            @for set in &tables.data_sets { (data_set(set)) }
            (footer())
        }
    };
    document("Line rasterization for multi-resolution textures: the tables", STYLE, &body)
}

fn data_set(set: &DataSet) -> Markup {
    html! {
        section.scene {
            h2 { (set.scene.name) }
            p.facts {
                (grouped(set.features)) " features · " (grouped(set.segments)) " segments · " (grouped(set.vertices)) " vertices · "
                (short(set.area_km2)) " km²"
            }
            h3 { "Solutions" }
            div.scroll { table {
                thead { tr {
                    @for head in ["solution", "strategy"] { th { (head) } }
                    @for head in ["memory (Fig. 10)", "", "generation (Fig. 11)", "", "rendering (Fig. 12)", ""] { th.n { (head) } }
                    @for head in ["tiles", "line primitives", "quadrilaterals"] { th.n { (head) } }
                } }
                tbody { @for row in &set.solutions { (solution(set, row)) } }
            } }
            h3 { "A change of the width (5.1)" }
            div.scroll { table { tbody { @for row in &set.width_changes { (width_change(row)) } } } }
            p.note {
                "Memory is that of lines and outlines; rendering draws fills too, if the layers have any. Line primitives are as wide as the device "
                "can draw at most; widths in pixels count as metres. Where there are few segments, times say nothing."
            }
            p.note { "The index that finds a tile's lines takes " (size(set.solutions.first().map_or(0, |row| row.index_bytes))) " more." }
        }
    }
}

fn solution(set: &DataSet, row: &SolutionRow) -> Markup {
    let bar = |of: &dyn Fn(&SolutionRow) -> f64| {
        let share = of(row) / set.best(of);
        let most = set.solutions.iter().map(|row| of(row) / set.best(of)).fold(1.0, crate::math::max);
        html! { td { div.bar style=(format!("width:{:.1}%", 100.0 * share / most)) {} (format!("{:.0} %", 100.0 * share)) } }
    };
    html! {
        tr {
            td { (row.solution) }
            td { @if row.is_combined { "thin ones as lines" } @else { "all alike" } }
            td.n { (size(row.geometry_bytes)) } (bar(&|row| row.geometry_bytes as f64))
            td.n { (duration(row.generation_ms.median)) } (bar(&|row| row.generation_ms.median))
            td.n { (duration(row.rendering_ms.median)) } (bar(&|row| row.rendering_ms.median))
            td.n { (row.tiles) } td.n { (grouped(row.line_primitives as usize)) } td.n { (grouped(row.quads as usize)) }
        }
    }
}

fn width_change(row: &WidthRow) -> Markup {
    html! { tr { td { (row.name) } td.n { (duration(row.ms.median)) } } }
}

fn footer() -> Markup {
    html! {
        footer {
            h3 { "How to read it" }
            dl {
                dt { "in the paper" }
                dd { "The best is solution 1 in memory (100 %); 4a takes 105 to 133 %, 4b close to 3a, the worst. Rendering by 4a takes 127 to 231 % of lines. "
                     "A change of the width of 1.25 million segments: 1.29 ms by scaling, about 18 ms by method 3b." }
                dt { "rendering" }
                dd { "Lines and polygons are rasterized in software here: relations are those of this machine, not of a graphics processor of 2014." }
                dt { "strategy" }
                dd { "“thin ones as lines”: below the threshold in texels, line primitives (or, in 3b, wireframe) are drawn instead (Algorithm 2). “all alike”: one strategy in every level." }
            }
        }
    }
}

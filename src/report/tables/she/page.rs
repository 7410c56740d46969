//! `tables.html`: the tables beside the paper's, one page that needs no network.

use super::super::super::axis::{duration, short};
use super::super::super::page::STYLE;
use super::super::grouped::grouped;
use super::{DataSet, Row, Table, Tables};
use crate::output::document;
use maud::{Markup, html};

/// The text of the page.
pub fn page(tables: &Tables) -> String {
    let body = html! {
        body {
            header {
                h1 { "Line rendering by inverse projection" }
                p.lead {
                    "Tables 2 to 5 and the frame rates of Fig. 14 of She et al. 2016, measured anew in software on data in the likeness of the paper's. Counts are the same in "
                    "every run. Times are this machine's. "
                    @if tables.repeat == 1 { "Each is of one run." } @else { "Each is the median of " (tables.repeat) " runs." }
                }
            }
            @for table in Table::ALL { (section(tables, table)) }
            (footer())
        }
    };
    document("Line rendering by inverse projection: the tables", STYLE, &body)
}

/// A table, with the rows of all data sets that have some.
fn section(tables: &Tables, table: Table) -> Markup {
    let of = |set: &DataSet| {
        set.rows.iter().filter(|row| row.table == table.number()).cloned().collect::<Vec<Row>>()
    };
    let sets: Vec<(&DataSet, Vec<Row>)> =
        tables.data_sets.iter().map(|set| (set, of(set))).filter(|(_, rows)| !rows.is_empty()).collect();
    html! {
        @if !sets.is_empty() {
            section.scene {
                h2 { (table.number()) }
                p.facts { (table.title()) }
                div.scroll { table {
                    thead { tr {
                        th { "data" } th { "setting" }
                        @for head in ["triangles", "vertices", "frame", "frames/s", "the paper's", "P pixels", "samples in them", "edge tests"] { th.n { (head) } }
                    } }
                    tbody { @for (set, rows) in &sets { @for row in rows { (line(set, row)) } } }
                } }
            }
        }
    }
}

fn line(set: &DataSet, row: &Row) -> Markup {
    let ms = row.frame_ms.median;
    html! {
        tr {
            td { (set.scene.name) } td { (row.setting) }
            td.n { (grouped(set.triangles)) } td.n { @if row.vertices > 0 { (grouped(row.vertices)) } }
            td.n { (duration(ms)) } td.n { @if ms > 0.0 { (short(1000.0 / ms)) } @else { "—" } }
            td.n { @if let Some(fps) = row.paper_fps { (short(fps)) } }
            td.n { (grouped(row.border_pixels as usize)) } td.n { (grouped(row.samples as usize)) } td.n { (grouped(row.edge_tests as usize)) }
        }
    }
}

fn footer() -> Markup {
    html! {
        footer {
            h3 { "How to read it" }
            dl {
                dt { "the paper" }
                dd { "finds that blocks beyond 4,800 (of 10 × 20 pixels) no longer help; that the rate falls with the window's size and the vectors, and hardly with the terrain; and that inverse "
                     "projection with up to 5 × 5 samples is a little slower than stencil volumes with one, and far faster than anti-aliasing of the whole screen. Fig. 14 is drawn there as curves, without numbers." }
                dt { "tiles" }
                dd { "A block of a graphics processor's threads is here a tile of pixels that one thread of the processor draws: too large ones leave threads idle, too small ones repeat work at their borders." }
                dt { "vertices" }
                dd { "Of lines after their expansion to areas: as many as edges." }
                dt { "samples in them" }
                dd { "Only P pixels, on a border, take n × n samples: that is why samples cost little (3.5)." }
            }
        }
    }
}

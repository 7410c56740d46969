//! `tables.html`: the tables beside the paper's, one page that needs no network.

use super::super::super::axis::{duration, short};
use super::super::super::page::{STYLE, size};
use super::super::grouped::grouped;
use super::Tables;
use super::paper::{COVERING_TRIANGLES, POINTS, QUAD_BYTES, TABLE_1};
use super::rows::{DataSet, Form, POLYLINES, Row, Stored};
use super::sweeps::{BORROW, ERROR_PX, OFFSET, SWEEPS, Sweep, TOLERANCE};
use crate::output::document;
use maud::{Markup, html};

/// The text of the page.
pub fn page(tables: &Tables) -> String {
    let body = html! {
        body {
            header {
                h1 { "Vector data over multi-resolution terrain" }
                p.lead {
                    "Table 1 and the storage of section 3.3 of Wartell et al. 2003, measured anew in software, and geometry overlay over what can be set of its mesh "
                    "and its lines. Counts and bytes are the same in every run. Times are this machine's. "
                    @if tables.repeat == 1 { "Each is of one run." } @else { "Each is the median of " (tables.repeat) " runs." }
                }
            }
            @for set in &tables.data_sets { (data_set(set)) }
            (footer())
        }
    };
    document("Vector data over multi-resolution terrain: the tables", STYLE, &body)
}

fn data_set(set: &DataSet) -> Markup {
    html! {
        section.scene {
            h2 { (set.scene.name) }
            p.facts {
                (grouped(set.polylines)) " polylines · " (grouped(set.points)) " points · "
                (set.posts[0]) " × " (set.posts[1]) " posts · " (set.width) " × " (set.height) " pixels"
            }
            (table_1(set))
            (storage(set))
            @for sweep in &SWEEPS { (sweep_table(set, sweep)) }
        }
    }
}

/// Turns a second.
fn per_second(ms: f64) -> String {
    if ms > 0.0 { short(1000.0 / ms) } else { "—".into() }
}

/// Milliseconds of what the paper's level-of-detail thread does: the mesh, and the walks over it.
fn lod_ms(row: &Row) -> f64 {
    row.mesh_ms.median + row.walk_ms.median
}

fn table_1(set: &DataSet) -> Markup {
    html! {
        h3 { "Table 1: the view with polylines and without them" }
        div.scroll { table {
            thead { tr {
                th { "polylines" }
                @for head in ["frame", "frames/s", "the paper's", "mesh", "walks", "mesh and walks/s", "the paper's LOD", "triangles of the mesh", "primitives of lines",
                              "strips and primitives there", "vertices of the mesh", "points of lines", "vertices there"] { th.n { (head) } }
            } }
            tbody { @for (row, paper) in set.of(POLYLINES).zip(TABLE_1) {
                tr {
                    td { (row.setting) }
                    td.n { (duration(row.frame_ms.median)) } td.n { (per_second(row.frame_ms.median)) } td.n { (paper.render_fps) }
                    td.n { (duration(row.mesh_ms.median)) } td.n { (duration(row.walk_ms.median)) }
                    td.n { (per_second(lod_ms(row))) } td.n { (format!("{:.1}", paper.lod_fps)) }
                    td.n { (grouped(row.triangles)) } td.n { (grouped(row.count("primitives") as usize)) } td.n { (grouped(paper.primitives)) }
                    td.n { (grouped(row.vertices)) } td.n { (grouped(row.count("points_drawn") as usize)) } td.n { (grouped(paper.vertices)) }
                }
            } }
        } }
        p.note {
            "There: a 1.5 GHz Pentium 4 with a GeForce 2 GTS; the 489 primitives are 82 triangle strips of the mesh and 407 of lines. Here the mesh is no strips: each triangle "
            "is one. A frame has the walks and the drawing, of the mesh too, by software; its mesh was made before."
        }
    }
}

fn storage(set: &DataSet) -> Markup {
    let storage = &set.storage;
    html! {
        h3 { "Storage (3.3)" }
        div.scroll { table {
            thead { tr {
                th { "quads" } th { "points" } th { "layers" }
                @for head in ["coordinates", "the rest", "all", "of it coordinates", "smaller by", "the paper's"] { th.n { (head) } }
            } }
            tbody {
                @for (k, form) in storage.root.forms.iter().enumerate().filter(|(k, _)| *k < 2) {
                    (form_row("the one that holds all", form, if k == 0 { "41.8 MB, 98 %" } else { "" }))
                }
                @for (k, form) in storage.all.forms.iter().enumerate() {
                    (form_row("all levels", form, match k { 0 => "615 MB, 68 %", 3 => "estimated: ten fold", _ => "" }))
                }
            }
        } }
        p.note {
            "A point of a quad is covered by " (storage.covering_triangles) " triangles, one of each layer (the paper's " (COVERING_TRIANGLES) "): the estimate for the quad that holds all is "
            "points × 12 bytes × " (storage.covering_triangles) ", here " (size(set.points * 12 * storage.covering_triangles as usize)) "; there "
            (grouped(POINTS)) " points, " (size(QUAD_BYTES)) " (“41 MB”). Crossings of edges are stored too."
        }
        div.scroll { table {
            thead { tr {
                th { "here" }
                @for head in ["quads that lines cross", "made in", "points, once a quad", "triangle clippings", "points of clippings", "held in memory"] { th.n { (head) } }
            } }
            tbody {
                (held_row("the quad that holds all", &storage.root))
                (held_row("all levels", &storage.all))
            }
        } }
        p.note {
            "Held in memory: each point once in double precision, with the clippings of all layers. Before, lines are put into columns and rows of posts: "
            (duration(storage.index_ms.median)) "."
        }
    }
}

fn form_row(quads: &str, form: &Form, paper: &str) -> Markup {
    html! {
        tr {
            td { (quads) }
            td { @if form.points == "cartesian" { "in space" } @else { "projectors" } }
            td { @if form.layers == "all" { "all" } @else { "two finest, roots all" } }
            td.n { (size(form.coordinate_bytes as usize)) } td.n { (size(form.topology_bytes as usize)) } td.n { (size(form.bytes() as usize)) }
            td.n { (format!("{:.0} %", 100.0 * form.coordinate_share())) }
            td.n { (format!("{:.2}", form.factor)) }
            td.n { (paper) }
        }
    }
}

fn held_row(what: &str, stored: &Stored) -> Markup {
    html! {
        tr {
            td { (what) }
            td.n { (grouped(stored.quads)) } td.n { (duration(stored.build_ms.median)) } td.n { (grouped(stored.points as usize)) }
            td.n { (grouped(stored.clippings as usize)) } td.n { (grouped(stored.clipping_points as usize)) } td.n { (size(stored.held_bytes as usize)) }
        }
    }
}

/// A column of a sweep: its head, and a row's cell.
type Column = (&'static str, fn(&Row) -> String);

/// A column of what frames count.
macro_rules! counted {
    ($head:literal, $name:literal) => {
        ($head, |row| grouped(row.count($name) as usize))
    };
}

const TIMES: [Column; 3] = [
    ("mesh", |row| duration(row.mesh_ms.median)),
    ("walks", |row| duration(row.walk_ms.median)),
    ("frame", |row| duration(row.frame_ms.median)),
];

const CHANGED: Column = ("pixels changed", |row| grouped(row.changed_pixels));

const MESH: [Column; 4] = [
    ("triangles", |row| grouped(row.triangles)),
    ("off by at most", |row| format!("{} px", short(row.deviation_px))),
    ("", |row| format!("{} m", short(row.deviation_m))),
    counted!("quads", "quads"),
];

const LINES: [Column; 3] = [
    counted!("primitives", "primitives"),
    counted!("clippings", "clippings_drawn"),
    counted!("points", "points_drawn"),
];

/// What a sweep has to tell beside its times and the change of the picture.
fn columns(sweep: &Sweep) -> Vec<Column> {
    let own: &[&[Column]] = match sweep.varied {
        of if of == ERROR_PX.varied => &[&MESH, &LINES],
        of if of == BORROW.varied => &[
            &MESH,
            &[
                counted!("borrowed", "borrowed_quads"),
                counted!("clippings visited", "clippings_visited"),
                counted!("tested", "clippings_tested"),
            ],
            &LINES,
        ],
        of if of == OFFSET.varied => &[&[
            counted!("fragments", "fragments"),
            counted!("drawn", "fragments_drawn"),
            ("share", |row| format!("{:.1} %", 100.0 * row.survival())),
        ]],
        of if of == TOLERANCE.varied => &[&[
            counted!("points", "points"),
            counted!("left", "points_drawn"),
            counted!("segments", "segments"),
        ]],
        _ => &[],
    };
    [&TIMES[..], &own.concat(), &[CHANGED]].concat()
}

fn sweep_table(set: &DataSet, sweep: &Sweep) -> Markup {
    let columns = columns(sweep);
    html! {
        h3 { (sweep.title) }
        div.scroll { table {
            thead { tr { th { "setting" } @for (head, _) in &columns { th.n { (head) } } } }
            tbody { @for row in set.of(sweep.varied) {
                tr { td { (row.setting) } @for (_, cell) in &columns { td.n { (cell(row)) } } }
            } }
        } }
    }
}

fn footer() -> Markup {
    html! {
        footer {
            h3 { "How to read it" }
            dl {
                dt { "mesh, walks" }
                dd { "The time to make the view's mesh, and that of the walks from clipping to clipping over it (Algorithm 1): what the paper's level-of-detail thread does, without paging." }
                dt { "clippings visited, tested" }
                dd { "Those that walks went to, and those that were asked, to find where to begin, whether they lie over a triangle in use. “cached”: where lines enter borrowed regions is "
                     "known from the frame before; “searched”: the quad that is borrowed from is walked through whole, each time." }
                dt { "off by at most" }
                dd { "A bound of the mesh's distance from the full surface over what the view may see, in pixels at that distance and in metres." }
                dt { "pixels changed" }
                dd { "Against the first setting of the table." }
                dt { "drawn, share" }
                dd { "Fragments of lines that are nearer than the mesh by the depth test, hidden parts of lines among the others." }
                dt { "made in" }
                dd { "The time to cut all lines at all triangles of all layers. A view makes only the quads that it uses." }
            }
        }
    }
}

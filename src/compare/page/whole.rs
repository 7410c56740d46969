//! The page from its first line to its last.

use super::case::section;
use super::shown::Shown;
use super::sign::sign;
use crate::compare::report::{Case, Cases, called, escaped};

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// The bytes of pictures that a page carries at most.
const MOST_BYTES: usize = 20 << 20;

/// The page of what a call judged, with the pictures of each case where it has any. Where there are too many, those of cases that
/// fail come first, and the rest is left out.
///
/// # Panics
/// When there are pictures of other than each case.
pub fn page(cases: &Cases, shown: &[Option<Shown>]) -> String {
    assert_eq!(shown.len(), cases.cases.len(), "pictures of each case");
    let mut order: Vec<usize> = (0..shown.len()).collect();
    order.sort_by_key(|at| std::cmp::Reverse(cases.cases[*at].ruling));
    let (mut room, mut has_room) = (MOST_BYTES, vec![false; shown.len()]);
    for at in order {
        let bytes = shown[at].as_ref().map_or(0, Shown::bytes);
        has_room[at] = bytes <= room;
        room -= if has_room[at] { bytes } else { 0 };
    }
    let pictures = |at: usize| shown[at].as_ref().filter(|_| has_room[at]);
    let sections: String = cases
        .cases
        .iter()
        .enumerate()
        .map(|(at, case)| section(at, case, pictures(at), cases.set.is_some()))
        .collect();
    let (title, ruling) = (escaped(&cases.headline()), cases.ruling());
    let table = if cases.set.is_some() { table(&cases.cases) } else { String::new() };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, \
         initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n\
         <body>\n<header>\n<h1>{} {title}</h1>\n</header>\n<main>\n{table}{sections}</main>\n<script>{SCRIPT}</script>\n</body>\n</html>\n",
        sign(ruling)
    )
}

/// The cases of a set.
fn table(cases: &[Case]) -> String {
    let row = |(at, case): (usize, &Case)| {
        let failing = case.failing.map_or("-".into(), |failing| failing.to_string());
        let dense = case.failing.map(|_| case.windows.first().map_or(0, |window| window.failing));
        let dense = dense.map_or("-".into(), |dense| dense.to_string());
        let hypothesis = escaped(case.hypothesis.as_deref().unwrap_or("-"));
        format!(
            "<tr><td><a href=\"#case-{at}\">{}</a></td><td>{} {}</td><td class=\"n\">{failing}</td><td class=\"n\">{dense}</td>\
             <td>{hypothesis}</td><td>{}</td></tr>\n",
            escaped(&case.name),
            sign(case.ruling),
            called(case.ruling),
            escaped(case.exposes.as_deref().unwrap_or(""))
        )
    };
    let rows: String = cases.iter().enumerate().map(row).collect();
    format!(
        "<div class=\"scroll\"><table>\n<caption>Cases</caption>\n<thead><tr><th scope=\"col\">case</th><th scope=\"col\">verdict</th>\
         <th scope=\"col\" class=\"n\">failing pixels</th><th scope=\"col\" class=\"n\">densest 16 × 16</th><th scope=\"col\">hypothesis</th>\
         <th scope=\"col\">exposes</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n"
    )
}

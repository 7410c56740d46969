//! A case's part of the page.

use super::shown::Shown;
use super::sign::sign;
use crate::compare::judgement::Ruling;
use crate::compare::metrics::Window;
use crate::compare::report::{Case, called, escaped};

/// A case: its verdict, its pictures, what fails, its numbers. One of a set that passed is closed at first.
pub(super) fn section(at: usize, case: &Case, shown: Option<&Shown>, is_of_set: bool) -> String {
    let pictures = match shown {
        Some(shown) => viewer(at, shown) + &windows(case, shown),
        None => "<p class=\"note\">There are no pictures to show here.</p>\n".to_owned(),
    };
    let inner = format!("{pictures}{}{}", features(case), numbers(case));
    if !is_of_set {
        return format!("<section id=\"case-{at}\">\n{inner}</section>\n");
    }
    let open = if case.ruling == Ruling::Pass { "" } else { " open" };
    let (name, headline) = (escaped(&case.name), escaped(&case.headline));
    let exposes = case.exposes.as_ref().map_or(String::new(), |exposes| {
        format!("<p class=\"note\">This case exposes: {}</p>\n", escaped(exposes))
    });
    format!(
        "<section id=\"case-{at}\"><details{open}>\n<summary><h2>{} {name}: {}</h2></summary>\n<p>{headline}</p>\n{exposes}{inner}</details></section>\n",
        sign(case.ruling),
        called(case.ruling)
    )
}

/// The slider, and the other views.
fn viewer(at: usize, shown: &Shown) -> String {
    let Shown { width, height, expected, actual, heat } = shown;
    let views =
        [("split", "Slider"), ("expected", "Expected"), ("actual", "Actual"), ("heat", "Where they differ")];
    let view = |(value, label): &(&str, &str)| {
        let checked = if *value == "split" { " checked" } else { "" };
        format!(
            "<label><input type=\"radio\" name=\"view-{at}\" value=\"{value}\"{checked}> {label}</label>\n"
        )
    };
    let has = |(value, _): &&(&str, &str)| *value != "heat" || heat.is_some();
    let views: String = views.iter().filter(has).map(view).collect();
    let fitting = (960 / (*width).max(1)).clamp(1, 8);
    let scale = |scale: &usize| {
        let chosen = if *scale == fitting { " selected" } else { "" };
        format!("<option value=\"{scale}\"{chosen}>{scale} ×</option>")
    };
    let scales: String =
        (1..=16).filter(|n| [1, 2, 3, 4, 6, 8, 12, 16, fitting].contains(n)).map(|n| scale(&n)).collect();
    let picture = |class: &str, source: &str, what: &str| {
        format!("<img class=\"{class}\" src=\"{source}\" alt=\"{what}, {width} by {height} pixels\">\n")
    };
    let heat = heat.as_ref().map_or(String::new(), |heat| picture("heat", heat, "where the two differ"));
    format!(
        "<figure class=\"viewer\" data-view=\"split\" style=\"--w:{width};--h:{height};--s:{fitting}\">\n<div class=\"controls\">\n\
         <fieldset><legend>View</legend>\n{views}</fieldset>\n<label>Size <select>{scales}</select></label>\n</div>\n\
         <div class=\"scroll\" tabindex=\"0\" aria-label=\"picture\"><div class=\"stage\">\n{}{}{heat}<div class=\"edge\"></div><div class=\"box\" hidden></div>\n</div></div>\n\
         <label class=\"slide\">expected <input type=\"range\" min=\"0\" max=\"100\" step=\"0.5\" value=\"50\" aria-label=\"how much of the expected picture is shown, \
         from the left\"> actual</label>\n<figcaption>Where they differ: black is as expected, blue within the tolerance; yellow, orange and pink fail, the \
         farther the pinker.</figcaption>\n</figure>\n",
        picture("expected", expected, "expected"),
        picture("actual", actual, "actual"),
    )
}

/// The windows in which most pixels fail, each cut out of the pictures.
fn windows(case: &Case, shown: &Shown) -> String {
    if case.windows.is_empty() {
        return String::new();
    }
    let row = |window: &Window| {
        let Window { x, y, width, height, failing } = window;
        let cut = |what: &str| {
            format!(
                "<td><div class=\"cut\" data-of=\"{what}\" style=\"--x:{x};--y:{y};--cw:{width};--ch:{height}\"></div></td>"
            )
        };
        let heat = if shown.heat.is_some() { cut("heat") } else { String::new() };
        format!(
            "<tr><td><button type=\"button\" data-window=\"{x},{y},{width},{height}\">{x},{y}</button></td><td class=\"n\">{failing}</td>{}{}{heat}</tr>\n",
            cut("expected"),
            cut("actual")
        )
    };
    let rows: String = case.windows.iter().map(row).collect();
    let heat = if shown.heat.is_some() { "<th scope=\"col\">where they differ</th>" } else { "" };
    format!(
        "<div class=\"scroll\"><table>\n<caption>Windows in which most pixels fail</caption>\n<thead><tr><th scope=\"col\">from pixel</th>\
         <th scope=\"col\" class=\"n\">failing</th><th scope=\"col\">expected</th><th scope=\"col\">actual</th>{heat}</tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table></div>\n"
    )
}

/// The features that have a say in what fails.
fn features(case: &Case) -> String {
    if case.features.is_empty() {
        return String::new();
    }
    let row = |(name, pixels): &(String, usize)| {
        format!("<tr><td>{}</td><td class=\"n\">{pixels}</td></tr>\n", escaped(name))
    };
    let rows: String = case.features.iter().map(row).collect();
    format!(
        "<div class=\"scroll\"><table>\n<caption>Features that have a say in failing pixels</caption>\n<thead><tr><th scope=\"col\">feature</th>\
         <th scope=\"col\" class=\"n\">failing pixels</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n"
    )
}

fn numbers(case: &Case) -> String {
    let row =
        |(name, text): &(&str, String)| format!("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(text));
    let rows: String = case.rows.iter().map(row).collect();
    format!("<h3>Numbers</h3>\n<dl>\n{rows}</dl>\n")
}

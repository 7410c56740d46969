//! What there is at a pixel, for people.

use crate::cli::refusal::harmless;
use drapery::output::{ItemResult, PickResult, PickedItem, PickedRun};
use std::fmt::Write;

/// What each run says of the pixel, the topmost item first; `items` tells of those that are named.
pub(super) fn text(pick: &PickResult, items: &[ItemResult]) -> String {
    let mut text = format!("pixel {},{}\n", pick.pixel[0], pick.pixel[1]);
    for run in &pick.runs {
        let _ = writeln!(text, "{}", run.technique);
        match run.items.as_deref() {
            None => text += "  cannot tell which features there are\n",
            Some([]) => text += "  no feature\n",
            Some(found) => found.iter().for_each(|item| put_item(run, item, items, &mut text)),
        }
    }
    text
}

fn put_item(run: &PickedRun, picked: &PickedItem, items: &[ItemResult], text: &mut String) {
    // They are told in the order of their numbers.
    let Ok(at) = items.binary_search_by_key(&picked.item, |item| item.item) else { return };
    let item = &items[at];
    let _ = write!(text, "  {}: {}", harmless(&item.layer_name), item.part);
    if let Some(number) = item.number {
        let _ = write!(text, " of feature {number}");
    }
    if let Some(name) = &item.name {
        let _ = write!(text, " \"{}\"", harmless(name));
    }
    if let Some([low, high]) = picked.coverage {
        let _ = write!(text, ", covers {:.2} % to {:.2} %", 100.0 * low, 100.0 * high);
    }
    text.push_str(if run.topmost == Some(picked.item) { ", topmost at the middle\n" } else { "\n" });
    let told: Vec<String> =
        item.attributes.0.iter().map(|(name, value)| harmless(&format!("{name} = {value}"))).collect();
    if !told.is_empty() {
        let _ = writeln!(text, "    {}", told.join(", "));
    }
}

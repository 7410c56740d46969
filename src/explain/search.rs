//! Which features are meant: by layer, by number, by what a column says.

use super::names::Names;
use crate::draw_list::DrawList;
use crate::error::{Error, Result};
use crate::scene::Attribute;
use crate::scene_file::nearest;

/// Names of features that are looked at for one that is near, at most.
const MOST_NAMES: usize = 10_000;

/// Features that were asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Wanted {
    /// As it was asked.
    pub(super) asked: String,
    /// Their items.
    pub(super) items: Vec<u32>,
}

/// A layer, and which of its features: all, or those with these numbers.
type Meant = (usize, Option<Vec<usize>>);

impl Wanted {
    /// Finds features by `LAYER`, `LAYER/NUMBER` or the value of any column.
    ///
    /// # Errors
    /// When there is no such feature; names that are near are told.
    pub(super) fn find(asked: &str, names: &Names, list: &DrawList) -> Result<Self> {
        let meant = meant(asked, names);
        let is_meant = |layer: u32, number: u32| {
            meant.iter().any(|(of, numbers)| {
                let is_among = |numbers: &Vec<usize>| numbers.binary_search(&(number as usize)).is_ok();
                *of == layer as usize && numbers.as_ref().is_none_or(is_among)
            })
        };
        let items = list.numbered().filter(|(_, item)| is_meant(item.layer, item.number));
        let items: Vec<u32> = items.map(|(number, _)| number).collect();
        let is_known = meant.iter().any(|(layer, numbers)| match numbers {
            None => true,
            Some(numbers) => names.has_any(*layer, numbers) || !items.is_empty(),
        });
        if is_known { Ok(Self { asked: asked.to_owned(), items }) } else { Err(unknown(asked, names)) }
    }
}

/// What a text may mean.
fn meant(asked: &str, names: &Names) -> Vec<Meant> {
    let layer = |name: &str| names.layers().iter().position(|known| known.eq_ignore_ascii_case(name));
    if let Some(layer) = layer(asked) {
        return vec![(layer, None)];
    }
    let numbered = asked.rsplit_once('/').and_then(|(of, number)| Some((layer(of)?, number.parse().ok()?)));
    if let Some((layer, number)) = numbered {
        return vec![(layer, Some(vec![number]))];
    }
    let says = |value: &Attribute| match value {
        Attribute::Null => false,
        Attribute::Text(text) => text.eq_ignore_ascii_case(asked),
        other => other.to_string() == asked,
    };
    let by_layer = (0..names.layers().len()).map(|layer| {
        let columns = names.columns(layer).iter();
        let rows = columns.flat_map(|column| (0..).zip(&column.values));
        let mut numbers: Vec<usize> = rows.filter(|(_, value)| says(value)).map(|(row, _)| row).collect();
        numbers.sort_unstable();
        numbers.dedup();
        (layer, Some(numbers))
    });
    by_layer.filter(|(_, numbers)| numbers.as_ref().is_some_and(|numbers| !numbers.is_empty())).collect()
}

fn unknown(asked: &str, names: &Names) -> Error {
    let texts = (0..names.layers().len()).flat_map(|layer| names.texts(layer));
    let known: Vec<&str> = names.layers().iter().copied().chain(texts.take(MOST_NAMES)).collect();
    let help = match nearest(asked, &known) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!(
            "say a layer ({}), LAYER/NUMBER, or what a column of a file says",
            names.layers().join(", ")
        ),
    };
    Error::new(format!("no layer and no feature is called `{asked}`")).help(help)
}

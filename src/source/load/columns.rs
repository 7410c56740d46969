//! The columns of attributes that a layer asks for, and whom to blame for what they hold.

use super::blame::Named;
use crate::error::{Error, Result};
use crate::scene::{Attribute, Column};
use crate::scene_file::{InlineFeature, LayerSpec, SceneFile, nearest_or_all};
use crate::source::vector::VectorFile;
use std::path::Path;

/// The most names of columns that an error tells.
const MOST_NAMES: usize = 40;

/// The columns of a layer's source.
pub(super) struct Columns<'a> {
    /// Those that the layer asks for and the source has.
    columns: Vec<Column>,
    /// The names of all that the source has.
    names: Vec<String>,
    source: Source<'a>,
}

/// Where features come from.
enum Source<'a> {
    File(Named<'a>),
    /// The scene itself.
    Scene(Option<&'a Path>),
}

impl<'a> Columns<'a> {
    /// Those of a file, taken out of it.
    pub(super) fn of_file(file: &mut VectorFile, named: Named<'a>) -> Self {
        let columns = std::mem::take(&mut file.columns);
        let names = std::mem::take(&mut file.column_names);
        Self { columns, names, source: Source::File(named) }
    }

    /// Those of features that are written in the scene.
    pub(super) fn of_inline(features: &[InlineFeature], scene: &'a SceneFile) -> Self {
        let properties = || features.iter().flat_map(|feature| &feature.properties);
        let mut names: Vec<String> = properties().map(|(name, _)| name.clone()).collect();
        names.sort_unstable();
        names.dedup();
        let of = |feature: &InlineFeature, name: &str| {
            let property = feature.properties.iter().find(|(column, _)| column == name);
            property.map_or(Attribute::Null, |(_, value)| value.clone())
        };
        let column = |name: &String| Column {
            name: name.clone(),
            values: features.iter().map(|feature| of(feature, name)).collect(),
        };
        let columns = names.iter().map(column).collect();
        Self { columns, names, source: Source::Scene(scene.path.as_deref()) }
    }

    /// Those of a generator's features.
    pub(super) fn of_generator(columns: Vec<Column>, scene: &'a SceneFile) -> Self {
        let names = columns.iter().map(|column| column.name.clone()).collect();
        Self { columns, names, source: Source::Scene(scene.path.as_deref()) }
    }

    /// The columns themselves.
    pub(super) fn into_columns(self) -> Vec<Column> {
        self.columns
    }

    /// Refuses a layer that asks for a column which there is not.
    pub(super) fn require(&self, spec: &LayerSpec) -> Result<()> {
        let has = |name: &String| self.columns.iter().any(|column| column.name == *name);
        let Some(missing) = spec.columns().into_iter().find(|name| !has(name)) else {
            return Ok(());
        };
        let error =
            Error::new(format!("there is no column `{missing}`, which `layer.{}` asks for", spec.name));
        let known: Vec<&str> = self.names.iter().map(String::as_str).collect();
        let told = if known.len() > MOST_NAMES { &known[..MOST_NAMES] } else { &known };
        let help = match nearest_or_all(&missing, &known, "columns") {
            near if near.starts_with("did you mean") => near,
            _ => nearest_or_all(&missing, told, "columns"),
        };
        Err(self.blame(error.help(help)))
    }

    /// The value of the feature with this number in a column that has been required.
    pub(super) fn value(&self, column: &str, index: usize) -> &Attribute {
        let column = self.columns.iter().find(|found| found.name == column);
        column.map_or(&Attribute::Null, |column| column.value(index))
    }

    /// All values of a column that has been required.
    pub(super) fn values(&self, column: &str) -> &[Attribute] {
        let column = self.columns.iter().find(|found| found.name == column);
        column.map_or(&[], |column| &column.values)
    }

    /// Puts the file and the line of the scene that names it into an error, or the scene.
    pub(super) fn blame(&self, error: Error) -> Error {
        match &self.source {
            Source::File(named) => named.blame(error),
            Source::Scene(Some(path)) => error.in_file(path),
            Source::Scene(None) => error,
        }
    }
}

//! Which attributes of a file are read, and what becomes of them, under the rules that all formats share.

use super::column_summary::{ColumnSummary, Tally};
use crate::error::{Error, Result};
use crate::scene::{Attribute, Column};
use std::collections::BTreeMap;

/// What is to be read of a file's attributes.
#[derive(Debug, Clone, Default)]
pub(super) enum Wanted {
    /// Nothing: they are passed over.
    #[default]
    Nothing,
    /// The values of the columns with these names.
    Columns(Vec<String>),
    /// The values of all columns, as far as they are of kinds that are read.
    All,
    /// What each column holds, in short.
    Summary,
}

/// The columns of a file, as far as they have been met.
#[derive(Debug, Default)]
pub(super) struct Attributes {
    wanted: Wanted,
    slots: BTreeMap<String, usize>,
    columns: Vec<Met>,
}

/// A column of the file.
#[derive(Debug)]
struct Met {
    name: String,
    kept: Kept,
}

/// What is kept of a column. Memory is taken for values alone that the file holds, and for the features before them.
#[derive(Debug)]
enum Kept {
    Name,
    Values(Vec<Attribute>),
    Summary(Tally),
}

impl Attributes {
    pub(super) fn new(wanted: Wanted) -> Self {
        Self { wanted, ..Self::default() }
    }

    /// Whether anything at all is wanted.
    pub(super) fn are_read(&self) -> bool {
        !matches!(self.wanted, Wanted::Nothing)
    }

    /// Whether columns are summed up and no values kept.
    pub(super) fn are_summed_up(&self) -> bool {
        matches!(self.wanted, Wanted::Summary)
    }

    /// The number of the column with this name, which the file has; columns are numbered as they are met.
    pub(super) fn column(&mut self, name: &str) -> usize {
        if let Some(slot) = self.slots.get(name) {
            return *slot;
        }
        let kept = match &self.wanted {
            Wanted::Columns(names) if names.iter().any(|wanted| wanted == name) => Kept::Values(Vec::new()),
            Wanted::All => Kept::Values(Vec::new()),
            Wanted::Summary => Kept::Summary(Tally::default()),
            Wanted::Nothing | Wanted::Columns(_) => Kept::Name,
        };
        let slot = self.columns.len();
        self.slots.insert(name.to_owned(), slot);
        self.columns.push(Met { name: name.to_owned(), kept });
        slot
    }

    /// Whether the values of a column are of use.
    pub(super) fn reads(&self, column: usize) -> bool {
        !matches!(self.columns[column].kept, Kept::Name)
    }

    /// A feature's value in a column; of several the last one stays.
    pub(super) fn put(&mut self, column: usize, feature: usize, value: Attribute) {
        match &mut self.columns[column].kept {
            Kept::Name => {}
            Kept::Values(values) => {
                values.resize(feature, Attribute::Null);
                values.push(value);
            }
            Kept::Summary(tally) => tally.put(feature, value),
        }
    }

    /// A feature's value in a column that is not read, and why not: refused where it is wanted.
    pub(super) fn put_unread(&self, column: usize, why: &str) -> Result<()> {
        match (&self.wanted, &self.columns[column].kept) {
            (Wanted::Columns(_), Kept::Values(_)) => Err(self.error(column, why)),
            _ => Ok(()),
        }
    }

    /// A refusal of a column, or of a value in it.
    pub(super) fn error(&self, column: usize, what: &str) -> Error {
        Error::new(format!("the column `{}` {what}", self.columns[column].name))
            .help("repair the file, or ask for another column")
    }

    /// The names of all columns, and the columns whose values were wanted.
    pub(super) fn into_columns(self) -> (Vec<String>, Vec<Column>) {
        let mut columns = Vec::new();
        let mut names = Vec::with_capacity(self.columns.len());
        for Met { name, kept } in self.columns {
            if let Kept::Values(values) = kept {
                columns.push(Column { name: name.clone(), values });
            }
            names.push(name);
        }
        (names, columns)
    }

    /// What each column holds.
    pub(super) fn into_summaries(self) -> Vec<ColumnSummary> {
        let summary = |Met { name, kept }| match kept {
            Kept::Summary(tally) => Some(tally.finish(name)),
            Kept::Name | Kept::Values(_) => None,
        };
        self.columns.into_iter().filter_map(summary).collect()
    }
}

//! The tables of the techniques' parameters: each technique declares its own.

use crate::parameter::{Key, Shape, TableShape, key};
use crate::technique::Kind;

pub(super) static TECHNIQUE: TableShape = TableShape { keys: &TABLES, rules: &[] };

static TABLES: [Key; Kind::ALL.len()] = {
    let mut tables = [key("", Shape::Text, ""); Kind::ALL.len()];
    let mut at = 0;
    while at < tables.len() {
        let technique = Kind::ALL[at].declaration();
        let table = Shape::Table(technique.parameters.table);
        tables[at] = key(technique.parameters.name, table, technique.paper);
        at += 1;
    }
    tables
};

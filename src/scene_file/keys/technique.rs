//! The tables of the techniques' parameters: each technique declares its own.

use crate::parameter::{Key, Shape, TableShape, key};
use crate::technique::Kind;

pub(super) static TECHNIQUE: TableShape = TableShape { keys: &TABLES, rules: &[] };

static TABLES: [Key; Kind::ALL.len()] = {
    let mut tables = [key("", Shape::Text, ""); Kind::ALL.len()];
    let mut at = 0;
    while at < tables.len() {
        let technique = Kind::ALL[at].declaration();
        tables[at] = key(technique.name, Shape::Table(technique.settings), technique.paper);
        at += 1;
    }
    tables
};

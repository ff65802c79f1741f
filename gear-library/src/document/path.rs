//! Dotted paths through a file, such as `line.0.length`.

use toml_edit::{ArrayOfTables, Item, Table, TableLike};

use crate::confidence::FORMER_CONFIDENCE;

/// The parts of a dotted path; one in double quotes may hold dots itself.
pub(super) fn parts(field: &str) -> Vec<&str> {
    let mut quoted = false;
    let between = |letter: char| {
        quoted ^= letter == '"';
        letter == '.' && !quoted
    };
    field
        .split(between)
        .filter(|part| !part.is_empty())
        .map(|part| part.trim_matches('"'))
        .collect()
}

/// The tables on the way to a field, and its own key or index.
pub(super) fn way_to(field: &str) -> (Vec<&str>, &str) {
    let mut parents = parts(field);
    let last = parents.pop().unwrap_or_default();
    (parents, last)
}

/// A step along a path, made where there is nothing yet.
pub(super) fn way<'a>(item: &'a mut Item, part: &str, to_list: bool) -> Option<&'a mut Item> {
    if let Ok(index) = part.parse::<usize>() {
        if let Some(tables) = item.as_array_of_tables_mut().filter(|tables| tables.len() == index) {
            tables.push(Table::new());
        }
        return item.get_mut(index);
    }
    let table = item.as_table_like_mut()?;
    if !table.contains_key(part) {
        let fresh = if to_list {
            Item::ArrayOfTables(ArrayOfTables::new())
        } else {
            // Its head is written where it holds more than tables.
            let mut table = Table::new();
            table.set_implicit(true);
            Item::Table(table)
        };
        table.insert(part, fresh);
    }
    table.get_mut(part)
}

/// A step along a path, where there is something.
pub(super) fn child<'a>(item: &'a mut Item, part: &str) -> Option<&'a mut Item> {
    match part.parse::<usize>() {
        Ok(index) => item.get_mut(index),
        Err(_) => item.get_mut(part),
    }
}

/// The key under which a table holds what a path calls `key`: an older file gives its confidence as
/// `sureness`.
pub(super) fn key_in<'a>(table: &dyn TableLike, key: &'a str) -> &'a str {
    let is_former =
        key == "confidence" && !table.contains_key(key) && table.contains_key(FORMER_CONFIDENCE);
    if is_former { FORMER_CONFIDENCE } else { key }
}

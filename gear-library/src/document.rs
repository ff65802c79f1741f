//! Edits of a TOML file that preserve comments and order.
//!
//! Fields are named by dotted paths, such as `line.0.length`. A figure whose value is edited loses its former source.

use std::str::FromStr;

use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value};

use crate::entry::{Confidence, FORMER_CONFIDENCE};
use crate::tree::{Content, Node};

/// A TOML file open for editing.
#[derive(Clone, Debug)]
pub struct Document {
    document: DocumentMut,
}

/// Why an edit failed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EditError {
    /// What is wrong.
    pub message: String,
}

impl std::fmt::Display for EditError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for EditError {}

impl Document {
    /// Opens a text for editing; [`Library::check_file`](crate::Library::check_file) locates syntax errors.
    pub fn parse(text: &str) -> Result<Self, EditError> {
        let document = DocumentMut::from_str(text)
            .map_err(|error| EditError { message: error.message().trim().to_owned() })?;
        Ok(Self { document })
    }

    /// The current text.
    pub fn text(&self) -> String {
        self.document.to_string()
    }

    /// The text of a field, such as `3/8 in` for `diameter` or for `diameter.value`.
    pub fn get(&self, field: &str) -> Option<String> {
        let item = self.item(field)?;
        let item = item.get("value").unwrap_or(item);
        item.as_str()
            .map(str::to_owned)
            .or_else(|| item.as_value().map(|value| value.to_string().trim().to_owned()))
    }

    /// Whether a field, table or list exists at a dotted path.
    pub fn has(&self, field: &str) -> bool {
        self.item(field).is_some()
    }

    /// Keys of a table in the order of the file, as parts of a path: a key with a dot is quoted. Empty if there is not a table.
    pub fn keys(&self, field: &str) -> Vec<String> {
        let table = self.item(field).and_then(Item::as_table_like);
        let part =
            |key: &str| if key.contains('.') { format!("\"{key}\"") } else { key.to_owned() };
        table.map_or_else(Vec::new, |table| table.iter().map(|(key, _)| part(key)).collect())
    }

    fn item(&self, field: &str) -> Option<&Item> {
        parts(field).into_iter().try_fold(self.document.as_item(), |item, part| {
            match part.parse::<usize>() {
                Ok(index) => item.get(index),
                Err(_) => item.get(item.as_table_like().map_or(part, |table| key_in(table, part))),
            }
        })
    }

    /// Sets a field by its dotted path, such as `diameter` or `line.0.length`.
    ///
    /// A figure written as a table keeps its source and confidence: its `value` changes. A number, `true` or `false` is
    /// written without quotes if the former value was.
    pub fn set(&mut self, field: &str, text: &str) -> Result<(), EditError> {
        let (parents, last) = split_path(field);
        let no_path =
            |part: &str| EditError { message: format!("`{part}` of `{field}` does not exist") };
        let mut item = self.document.as_item_mut();
        for part in parents {
            item = child(item, part).ok_or_else(|| no_path(part))?;
        }
        if let Ok(index) = last.parse::<usize>() {
            let slot =
                item.get_mut(index).and_then(Item::as_value_mut).ok_or_else(|| no_path(last))?;
            replace(slot, text);
            return Ok(());
        }
        let table = item.as_table_like_mut().ok_or_else(|| no_path(last))?;
        let key = key_in(table, last);
        set_in(table, key, text);
        Ok(())
    }

    /// Sets the value at a dotted path, creates missing tables on it, and appends to a list of tables at its end.
    /// A figure written as a table keeps its source and confidence.
    pub fn put(&mut self, field: &str, value: &Setting) -> Result<(), EditError> {
        let no_path =
            |part: &str| EditError { message: format!("`{part}` of `{field}` is not a table") };
        let (parts, last) = split_path(field);
        let mut item = self.document.as_item_mut();
        for (place, part) in parts.iter().enumerate() {
            let next_is_index =
                parts.get(place + 1).copied().unwrap_or(last).parse::<usize>().is_ok();
            item = child_or_new(item, part, next_is_index).ok_or_else(|| no_path(part))?;
        }
        if let Ok(index) = last.parse::<usize>() {
            let slot =
                item.get_mut(index).and_then(Item::as_value_mut).ok_or_else(|| no_path(last))?;
            *slot = value.0.clone();
            return Ok(());
        }
        let table = item.as_table_like_mut().ok_or_else(|| no_path(last))?;
        let key = key_in(table, last);
        match table
            .get_mut(key)
            .and_then(Item::as_table_like_mut)
            .filter(|figure| figure.contains_key("value"))
        {
            Some(figure) => figure.insert("value", Item::Value(value.0.clone())),
            None => table.insert(key, Item::Value(value.0.clone())),
        };
        Ok(())
    }

    /// Removes a field of the top level or of a table, with its comment.
    pub fn remove(&mut self, field: &str) -> Result<(), EditError> {
        let (parents, last) = split_path(field);
        let missing = || EditError { message: format!("`{field}` does not exist") };
        let mut item = self.document.as_item_mut();
        for part in parents {
            item = child(item, part).ok_or_else(missing)?;
        }
        item.as_table_like_mut()
            .and_then(|table| table.remove(key_in(table, last)))
            .map(|_| ())
            .ok_or_else(missing)
    }
}

/// Source of a figure that was typed in the program.
pub const UNSOURCED: &str = "typed by hand, without a source";

impl Document {
    /// Sets the value of a figure, such as `strength`, with source and confidence. An equal value changes nothing.
    pub fn set_figure(
        &mut self,
        figure: &str,
        value: &str,
        source: &str,
        confidence: Confidence,
    ) -> Result<(), EditError> {
        if self.get(figure).as_deref() == Some(value) {
            return Ok(());
        }
        let table = self.figure_table(figure)?;
        match table.get_mut("value").and_then(Item::as_value_mut) {
            Some(slot) => replace(slot, value),
            None => put(table, "value", value),
        }
        put(table, "source", source);
        let key = key_in(table, "confidence");
        put(table, key, confidence.word());
        Ok(())
    }

    /// Sets the `source` or `confidence` of a figure.
    pub fn set_of_figure(&mut self, figure: &str, key: &str, text: &str) -> Result<(), EditError> {
        if !self.has(figure) {
            return Err(EditError { message: format!("`{figure}` does not exist") });
        }
        let table = self.figure_table(figure)?;
        let key = key_in(table, key);
        put(table, key, text);
        Ok(())
    }

    /// The table of a figure; a plain value is converted to a table.
    fn figure_table(&mut self, figure: &str) -> Result<&mut dyn TableLike, EditError> {
        let (parents, last) = split_path(figure);
        let no_path = || EditError { message: format!("`{figure}` does not exist") };
        let mut item = self.document.as_item_mut();
        for part in parents {
            item = child(item, part).ok_or_else(no_path)?;
        }
        let table = item.as_table_like_mut().ok_or_else(no_path)?;
        let plain =
            table.get(last).and_then(Item::as_value).filter(|value| !value.is_inline_table());
        if plain.is_some() || !table.contains_key(last) {
            let mut own = InlineTable::new();
            if let Some(value) = plain {
                let mut value = value.clone();
                value.decor_mut().clear();
                own.insert("value", value);
            }
            table.insert(last, Item::Value(Value::InlineTable(own)));
        }
        table.get_mut(last).and_then(Item::as_table_like_mut).ok_or_else(no_path)
    }
}

/// Sets a text in a table.
fn put(table: &mut dyn TableLike, key: &str, text: &str) {
    match table.get_mut(key).and_then(Item::as_value_mut) {
        Some(slot) => replace(slot, text),
        None => {
            table.insert(key, Item::Value(Value::from(text)));
        }
    }
}

impl Document {
    /// Appends a table to a list of tables, such as `line` or `whale.pilot`; returns its index.
    pub fn push_table(&mut self, list: &str, fields: &[(&str, &str)]) -> Result<usize, EditError> {
        let no_list = || EditError { message: format!("`{list}` is not a list of tables") };
        let mut item = self.document.as_item_mut();
        let mut parts = list.split('.').peekable();
        while let Some(part) = parts.next() {
            item = child_or_new(item, part, parts.peek().is_none()).ok_or_else(no_list)?;
        }
        let tables = item.as_array_of_tables_mut().ok_or_else(no_list)?;
        let mut table = Table::new();
        for (key, text) in fields {
            table.insert(key, Item::Value(Setting::plain(text).0));
        }
        if !tables.is_empty() {
            table.decor_mut().set_prefix("\n");
        }
        tables.push(table);
        Ok(tables.len() - 1)
    }

    /// Removes a table from a list of tables.
    pub fn remove_table(&mut self, list: &str, index: usize) -> Result<(), EditError> {
        let missing = || EditError { message: format!("`{list}.{index}` does not exist") };
        let tables = self.tables(list).filter(|tables| index < tables.len()).ok_or_else(missing)?;
        tables.remove(index);
        Ok(())
    }

    /// Swaps two tables of a list with their comments.
    pub fn swap_tables(&mut self, list: &str, one: usize, other: usize) -> Result<(), EditError> {
        let missing =
            |index: usize| EditError { message: format!("`{list}.{index}` does not exist") };
        let tables = self.tables(list).ok_or_else(|| missing(one))?;
        let copy = |index: usize| tables.get(index).cloned().ok_or_else(|| missing(index));
        let (mut first, mut second) = (copy(one)?, copy(other)?);
        // Tables are written in the order of their positions.
        let places = [first.position(), second.position()];
        first.set_position(places[1]);
        second.set_position(places[0]);
        for (index, table) in [(one, second), (other, first)] {
            tables.get_mut(index).into_iter().for_each(|slot| *slot = table.clone());
        }
        Ok(())
    }

    /// Number of tables of a list; 0 if there is no such list.
    pub fn count(&self, list: &str) -> usize {
        self.item(list).and_then(Item::as_array_of_tables).map_or(0, ArrayOfTables::len)
    }

    fn tables(&mut self, list: &str) -> Option<&mut ArrayOfTables> {
        list.split('.').try_fold(self.document.as_item_mut(), child)?.as_array_of_tables_mut()
    }
}

/// The parts of a dotted path; a part in double quotes may contain dots.
fn parts(field: &str) -> Vec<&str> {
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

/// The parents of a field, and its own key or index.
fn split_path(field: &str) -> (Vec<&str>, &str) {
    let mut parents = parts(field);
    let last = parents.pop().unwrap_or_default();
    (parents, last)
}

/// The child of an item; a missing one is created.
fn child_or_new<'a>(item: &'a mut Item, part: &str, to_list: bool) -> Option<&'a mut Item> {
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
            // Its heading is only written if it contains fields.
            let mut table = Table::new();
            table.set_implicit(true);
            Item::Table(table)
        };
        table.insert(part, fresh);
    }
    table.get_mut(part)
}

/// The child of an item.
fn child<'a>(item: &'a mut Item, part: &str) -> Option<&'a mut Item> {
    match part.parse::<usize>() {
        Ok(index) => item.get_mut(index),
        Err(_) => item.get_mut(part),
    }
}

/// The key of a table for a key of a path: older files write `sureness` for `confidence`.
fn key_in<'a>(table: &dyn TableLike, key: &'a str) -> &'a str {
    let is_former =
        key == "confidence" && !table.contains_key(key) && table.contains_key(FORMER_CONFIDENCE);
    if is_former { FORMER_CONFIDENCE } else { key }
}

/// A value of a file: a text, a number, true or false, or a list of these.
#[derive(Clone, Debug)]
pub struct Setting(Value);

impl Setting {
    /// A text, such as `"0.5 m/s"`.
    pub fn text(text: &str) -> Self {
        Self(Value::from(text))
    }

    /// A plain number.
    pub fn number(number: f64) -> Self {
        Self(Value::from(number))
    }

    /// A list of texts.
    pub fn texts(texts: &[String]) -> Self {
        Self(Value::Array(texts.iter().map(String::as_str).collect()))
    }

    /// The TOML value that `text` represents, else a text.
    pub fn plain(text: &str) -> Self {
        Self(text.parse().unwrap_or_else(|_| Value::from(text)))
    }

    /// The value of a node; `None` for a table or a date.
    pub(crate) fn of(node: &Node) -> Option<Self> {
        let value = match &node.content {
            Content::Text(text) => Value::from(text.as_str()),
            Content::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => {
                Value::from(*number as i64)
            }
            Content::Number(number) => Value::from(*number),
            Content::Flag(flag) => Value::from(*flag),
            Content::List(items) => Value::Array(
                items
                    .iter()
                    .map(|item| Self::of(item).map(|value| value.0))
                    .collect::<Option<Array>>()?,
            ),
            Content::Table(_) | Content::Date(_) => return None,
        };
        Some(Self(value))
    }

    /// The value as written in a file.
    pub fn written(&self) -> String {
        self.0.to_string().trim().to_owned()
    }
}

impl PartialEq for Setting {
    fn eq(&self, other: &Self) -> bool {
        self.written() == other.written()
    }
}

/// Sets a key of a table; the table of a figure keeps its source and confidence.
fn set_in(table: &mut dyn TableLike, key: &str, text: &str) {
    match table.get_mut(key) {
        Some(Item::Value(Value::InlineTable(figure))) if figure.contains_key("value") => {
            figure.get_mut("value").into_iter().for_each(|slot| replace(slot, text));
        }
        Some(Item::Table(figure)) if figure.contains_key("value") => {
            figure
                .get_mut("value")
                .and_then(Item::as_value_mut)
                .into_iter()
                .for_each(|slot| replace(slot, text));
        }
        Some(Item::Value(slot)) => replace(slot, text),
        _ => {
            table.insert(key, Item::Value(Value::from(text)));
        }
    }
}

/// Replaces a value and keeps the spaces and comments around it.
fn replace(slot: &mut Value, text: &str) {
    let decor = slot.decor().clone();
    let plain = !matches!(slot, Value::String(_));
    let fresh = if plain {
        text.parse::<Value>().unwrap_or_else(|_| Value::from(text))
    } else {
        Value::from(text)
    };
    *slot = fresh;
    *slot.decor_mut() = decor;
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROPE: &str = "source = \"a shop\"\nconfidence = \"measured\"\n\n# As new.\nstrength = { value = \"2,440 lbf\", source = \"a mill\", confidence = \"measured\" } # of a table\ndiameter = \"3/8 in\"\nratio = 0.5\n";

    #[test]
    fn an_edited_value_loses_the_former_source() {
        let mut rope = Document::parse(ROPE).unwrap();
        rope.set_figure("strength", "2,300 lbf", UNSOURCED, Confidence::Estimate).unwrap();
        rope.set_figure("diameter", "1/2 in", UNSOURCED, Confidence::Estimate).unwrap();
        rope.set_figure("ratio", "0.25", UNSOURCED, Confidence::Estimate).unwrap();
        let own = format!("source = \"{UNSOURCED}\", confidence = \"estimate\"");
        let text = rope.text();
        for line in [
            format!("strength = {{ value = \"2,300 lbf\", {own} }} # of a table"),
            format!("diameter = {{ value = \"1/2 in\", {own} }}"),
            format!("ratio = {{ value = 0.25, {own} }}"),
            "# As new.".to_owned(),
        ] {
            assert!(text.contains(&line), "{line}\n{text}");
        }
    }

    #[test]
    fn an_equal_value_keeps_its_source_and_a_source_can_be_set() {
        let mut rope = Document::parse(ROPE).unwrap();
        rope.set_figure("strength", "2,440 lbf", UNSOURCED, Confidence::Estimate).unwrap();
        assert_eq!(rope.text(), ROPE);
        rope.set_of_figure("diameter", "source", "a caliper").unwrap();
        assert_eq!(rope.get("diameter").as_deref(), Some("3/8 in"));
        assert_eq!(rope.get("diameter.source").as_deref(), Some("a caliper"));
        assert!(rope.set_of_figure("mass", "source", "a scale").is_err());
    }
}

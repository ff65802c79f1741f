//! A file being edited: fields change, comments and order stay.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;
use std::str::FromStr;

use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, TableLike, Value};

use crate::tree::{Content, Node};

/// A TOML file open for editing.
#[derive(Clone, Debug)]
pub struct Document {
    document: DocumentMut,
}

/// A value as it stands in a file: a text, a number, true or false, or a list of them.
#[derive(Clone, Debug)]
pub struct Setting(Value);

impl Setting {
    /// A text, such as `"0.5 m/s"`.
    #[must_use]
    pub fn text(text: &str) -> Self {
        Self(Value::from(text))
    }

    /// A plain number.
    #[must_use]
    pub fn number(number: f64) -> Self {
        Self(Value::from(number))
    }

    /// A list of texts.
    #[must_use]
    pub fn texts(texts: &[String]) -> Self {
        Self(Value::Array(texts.iter().map(String::as_str).collect()))
    }

    /// A value that stands without quotes where `text` reads as one, else a text.
    #[must_use]
    pub fn plain(text: &str) -> Self {
        Self(text.parse().unwrap_or_else(|_| Value::from(text)))
    }

    /// What a file's value is; `None` for a table or a date.
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

    /// As it is written.
    #[must_use]
    pub fn written(&self) -> String {
        self.0.to_string().trim().to_owned()
    }
}

impl PartialEq for Setting {
    fn eq(&self, other: &Self) -> bool {
        self.written() == other.written()
    }
}

/// Why a field could not be set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EditError {
    /// What is wrong and what was expected.
    pub message: String,
}

impl std::fmt::Display for EditError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for EditError {}

impl Document {
    /// Opens a text for editing.
    ///
    /// # Errors
    /// Where it is not TOML; [`Library::check_file`](crate::Library::check_file) says where.
    pub fn parse(text: &str) -> Result<Self, EditError> {
        let document = DocumentMut::from_str(text)
            .map_err(|error| EditError { message: error.message().trim().to_owned() })?;
        Ok(Self { document })
    }

    /// The text as it stands.
    #[must_use]
    pub fn text(&self) -> String {
        self.document.to_string()
    }

    /// The text of a field, such as `3/8 in` for `diameter` or for `diameter.value`.
    #[must_use]
    pub fn get(&self, field: &str) -> Option<String> {
        let item = self.item(field)?;
        let item = item.get("value").unwrap_or(item);
        item.as_str()
            .map(str::to_owned)
            .or_else(|| item.as_value().map(|value| value.to_string().trim().to_owned()))
    }

    /// Whether there is a field, table or list of this dotted path.
    #[must_use]
    pub fn has(&self, field: &str) -> bool {
        self.item(field).is_some()
    }

    /// Keys of a table in the order of the file, each as a part of a path: in quotes where it holds a dot. None of anything else.
    #[must_use]
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
                Err(_) => item.get(part),
            }
        })
    }

    /// Sets a field by its dotted path, such as `diameter` or `line.0.length`.
    ///
    /// A figure written as a table keeps its source and sureness: its `value` changes. Text that
    /// reads as a plain number, `true` or `false` is written as such where the field held one.
    ///
    /// # Errors
    /// Where the path leads through something that is no table or list.
    pub fn set(&mut self, field: &str, text: &str) -> Result<(), EditError> {
        let (parents, last) = way_to(field);
        let no_way =
            |part: &str| EditError { message: format!("`{part}` of `{field}` is not there") };
        let mut item = self.document.as_item_mut();
        for part in parents {
            item = child(item, part).ok_or_else(|| no_way(part))?;
        }
        if let Ok(index) = last.parse::<usize>() {
            let slot =
                item.get_mut(index).and_then(Item::as_value_mut).ok_or_else(|| no_way(last))?;
            replace(slot, text);
            return Ok(());
        }
        set_in(item.as_table_like_mut().ok_or_else(|| no_way(last))?, last, text);
        Ok(())
    }

    /// Puts a value at a dotted path, whatever stood there; tables on the way that are not there are made, and an item
    /// after the last of a list of tables. A figure written as a table keeps its source and sureness.
    ///
    /// # Errors
    /// Where the path leads through something that is no table or list, or past the end of a list.
    pub fn put(&mut self, field: &str, value: &Setting) -> Result<(), EditError> {
        let no_way =
            |part: &str| EditError { message: format!("`{part}` of `{field}` is no table") };
        let (parts, last) = way_to(field);
        let mut item = self.document.as_item_mut();
        for (place, part) in parts.iter().enumerate() {
            let next_is_index =
                parts.get(place + 1).copied().unwrap_or(last).parse::<usize>().is_ok();
            item = way(item, part, next_is_index).ok_or_else(|| no_way(part))?;
        }
        if let Ok(index) = last.parse::<usize>() {
            let slot =
                item.get_mut(index).and_then(Item::as_value_mut).ok_or_else(|| no_way(last))?;
            *slot = value.0.clone();
            return Ok(());
        }
        let table = item.as_table_like_mut().ok_or_else(|| no_way(last))?;
        match table
            .get_mut(last)
            .and_then(Item::as_table_like_mut)
            .filter(|figure| figure.contains_key("value"))
        {
            Some(figure) => figure.insert("value", Item::Value(value.0.clone())),
            None => table.insert(last, Item::Value(value.0.clone())),
        };
        Ok(())
    }

    /// Adds a table at the end of a list of tables by its dotted path, such as `line` or `whale.pilot`; answers its index.
    ///
    /// # Errors
    /// Where there is something of that name that is no list of tables.
    pub fn push_table(&mut self, list: &str, fields: &[(&str, &str)]) -> Result<usize, EditError> {
        let no_list = || EditError { message: format!("`{list}` is no list of tables") };
        let mut item = self.document.as_item_mut();
        let mut parts = list.split('.').peekable();
        while let Some(part) = parts.next() {
            item = way(item, part, parts.peek().is_none()).ok_or_else(no_list)?;
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

    /// Takes a table out of a list of tables.
    ///
    /// # Errors
    /// Where it is not there.
    pub fn remove_table(&mut self, list: &str, index: usize) -> Result<(), EditError> {
        let missing = || EditError { message: format!("`{list}.{index}` is not there") };
        let tables = self.tables(list).filter(|tables| index < tables.len()).ok_or_else(missing)?;
        tables.remove(index);
        Ok(())
    }

    /// Two tables of a list change places, each with its comments.
    ///
    /// # Errors
    /// Where one of them is not there.
    pub fn swap_tables(&mut self, list: &str, one: usize, other: usize) -> Result<(), EditError> {
        let missing =
            |index: usize| EditError { message: format!("`{list}.{index}` is not there") };
        let tables = self.tables(list).ok_or_else(|| missing(one))?;
        let copy = |index: usize| tables.get(index).cloned().ok_or_else(|| missing(index));
        let (mut first, mut second) = (copy(one)?, copy(other)?);
        // Tables are written in the order of their positions in the file.
        let places = [first.position(), second.position()];
        first.set_position(places[1]);
        second.set_position(places[0]);
        for (index, table) in [(one, second), (other, first)] {
            tables.get_mut(index).into_iter().for_each(|slot| *slot = table.clone());
        }
        Ok(())
    }

    /// How many tables a list has; none where there is no such list.
    #[must_use]
    pub fn count(&self, list: &str) -> usize {
        self.item(list).and_then(Item::as_array_of_tables).map_or(0, ArrayOfTables::len)
    }

    fn tables(&mut self, list: &str) -> Option<&mut ArrayOfTables> {
        list.split('.').try_fold(self.document.as_item_mut(), child)?.as_array_of_tables_mut()
    }

    /// Removes a field of the top level or of a table, with its comment.
    ///
    /// # Errors
    /// Where it is not there.
    pub fn remove(&mut self, field: &str) -> Result<(), EditError> {
        let (parents, last) = way_to(field);
        let missing = || EditError { message: format!("`{field}` is not there") };
        let mut item = self.document.as_item_mut();
        for part in parents {
            item = child(item, part).ok_or_else(missing)?;
        }
        item.as_table_like_mut()
            .and_then(|table| table.remove(last))
            .map(|_| ())
            .ok_or_else(missing)
    }

    /// Saves: writes beside, syncs, renames, so that a crash leaves the old file or the new one.
    ///
    /// # Errors
    /// Where the folder or the file cannot be written.
    pub fn save(&self, path: &Path) -> io::Result<()> {
        save_text(path, &self.text())
    }
}

/// Saves a text in one move: writes beside, syncs, renames.
///
/// # Errors
/// Where the folder or the file cannot be written.
pub fn save_text(path: &Path, text: &str) -> io::Result<()> {
    let name = path
        .file_name()
        .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not the name of a file"))?;
    let beside = path.with_file_name(format!(".{}.saving", name.to_string_lossy()));
    let written = write_synced(&beside, text).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        let _ = fs::remove_file(&beside);
    }
    written
}

fn write_synced(path: &Path, text: &str) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()
}

/// The parts of a dotted path; one in double quotes may hold dots itself.
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

/// The tables on the way to a field, and its own key or index.
fn way_to(field: &str) -> (Vec<&str>, &str) {
    let mut parents = parts(field);
    let last = parents.pop().unwrap_or_default();
    (parents, last)
}

/// A step along a path, made where there is nothing yet.
fn way<'a>(item: &'a mut Item, part: &str, to_list: bool) -> Option<&'a mut Item> {
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
            Item::Table(Table::new())
        };
        table.insert(part, fresh);
    }
    table.get_mut(part)
}

fn child<'a>(item: &'a mut Item, part: &str) -> Option<&'a mut Item> {
    match part.parse::<usize>() {
        Ok(index) => item.get_mut(index),
        Err(_) => item.get_mut(part),
    }
}

/// Sets a key of a table; a figure's table keeps its source and sureness.
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

/// Puts a new value in the place of an old one, with the spaces and comments around it.
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

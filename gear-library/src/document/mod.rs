//! A file being edited: fields change, comments and order stay.

mod figure;
mod lists;
mod path;
mod save;
mod setting;

use std::io;
use std::path::Path;
use std::str::FromStr;

use toml_edit::{DocumentMut, Item};

use path::{child, key_in, parts, way, way_to};
use setting::{replace, set_in};

pub use figure::UNSOURCED;
pub use save::save_text;
pub use setting::Setting;

/// A TOML file open for editing.
#[derive(Clone, Debug)]
pub struct Document {
    document: DocumentMut,
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
                Err(_) => item.get(item.as_table_like().map_or(part, |table| key_in(table, part))),
            }
        })
    }

    /// Sets a field by its dotted path, such as `diameter` or `line.0.length`.
    ///
    /// A figure written as a table keeps its source and confidence: its `value` changes. Text that
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
        let table = item.as_table_like_mut().ok_or_else(|| no_way(last))?;
        let key = key_in(table, last);
        set_in(table, key, text);
        Ok(())
    }

    /// Puts a value at a dotted path, whatever stood there; tables on the way that are not there are made, and an item
    /// after the last of a list of tables. A figure written as a table keeps its source and confidence.
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
            .and_then(|table| table.remove(key_in(table, last)))
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

//! Lists of tables, such as `[[line]]`: added to, taken from, put in another order.

use toml_edit::{ArrayOfTables, Item, Table};

use super::path::{child, way};
use super::{Document, EditError, Setting};

impl Document {
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
}

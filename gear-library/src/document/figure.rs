//! Figures of an entry: a value that is typed anew is no longer what its source said.

use toml_edit::{InlineTable, Item, TableLike, Value};

use super::path::{child, key_in, way_to};
use super::setting::replace;
use super::{Document, EditError};
use crate::confidence::Confidence;

/// The source of a figure that was typed, until a better one is given.
pub const UNSOURCED: &str = "typed by hand, without a source";

impl Document {
    /// Sets the value of a figure, such as `strength`, and where the new value comes from. Setting the value that it has
    /// changes nothing.
    ///
    /// # Errors
    /// Where the path leads through something that is no table.
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

    /// Sets a figure's own `source` or `confidence`; its value stays.
    ///
    /// # Errors
    /// Where the figure is not there.
    pub fn set_of_figure(&mut self, figure: &str, key: &str, text: &str) -> Result<(), EditError> {
        if !self.has(figure) {
            return Err(EditError { message: format!("`{figure}` is not there") });
        }
        let table = self.figure_table(figure)?;
        let key = key_in(table, key);
        put(table, key, text);
        Ok(())
    }

    /// A figure as a table, made of its plain value where it is none yet.
    fn figure_table(&mut self, figure: &str) -> Result<&mut dyn TableLike, EditError> {
        let (parents, last) = way_to(figure);
        let no_way = || EditError { message: format!("`{figure}` is not there") };
        let mut item = self.document.as_item_mut();
        for part in parents {
            item = child(item, part).ok_or_else(no_way)?;
        }
        let table = item.as_table_like_mut().ok_or_else(no_way)?;
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
        table.get_mut(last).and_then(Item::as_table_like_mut).ok_or_else(no_way)
    }
}

/// Puts a text into a table, in the place of what stood there.
fn put(table: &mut dyn TableLike, key: &str, text: &str) {
    match table.get_mut(key).and_then(Item::as_value_mut) {
        Some(slot) => replace(slot, text),
        None => {
            table.insert(key, Item::Value(Value::from(text)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROPE: &str = "source = \"a shop\"\nconfidence = \"measured\"\n\n# As new.\nstrength = { value = \"2,440 lbf\", source = \"a mill\", confidence = \"measured\" } # of a table\ndiameter = \"3/8 in\"\nratio = 0.5\n";

    #[test]
    fn a_value_that_is_typed_loses_the_source_of_the_old_one() {
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
    fn the_same_value_keeps_its_source_and_a_source_is_given_later() {
        let mut rope = Document::parse(ROPE).unwrap();
        rope.set_figure("strength", "2,440 lbf", UNSOURCED, Confidence::Estimate).unwrap();
        assert_eq!(rope.text(), ROPE);
        rope.set_of_figure("diameter", "source", "a caliper").unwrap();
        assert_eq!(rope.get("diameter").as_deref(), Some("3/8 in"));
        assert_eq!(rope.get("diameter.source").as_deref(), Some("a caliper"));
        assert!(rope.set_of_figure("mass", "source", "a scale").is_err());
    }
}

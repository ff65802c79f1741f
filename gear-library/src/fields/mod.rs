//! Reading the fields of a table: every problem is collected, every unread key is one.

mod figure;
mod problems;
mod range;
mod rising;
mod value;

use std::cell::RefCell;

use crate::diagnostic::{At, Place};
use crate::limits::{DIAGNOSTICS, Limit};
use crate::names;
use crate::nearest::{hint, nearest};
use crate::tree::{Content, Node};
use crate::units::Quantity;

pub use figure::{
    Figure, Provenance, confidence, provenance, provenance_over, read_figure, sourced,
};
pub use problems::Problems;
pub use range::Range;
pub use rising::rising;
pub use value::read_value;

/// A table being read: what was asked for is known, the rest is refused by [`finish`](Self::finish).
pub struct Fields<'a> {
    /// Where the table stands.
    pub place: &'a Place,
    entries: &'a [(String, Place, Node)],
    asked: RefCell<Vec<&'a str>>,
    problems: &'a Problems,
}

impl<'a> Fields<'a> {
    /// Opens a table; anything else is a problem and reads as an empty table.
    pub fn of(node: &'a Node, problems: &'a Problems) -> Self {
        let entries = match &node.content {
            Content::Table(entries) => entries.as_slice(),
            other => {
                problems.push(node.place.error(
                    format!("`{}` is {}, not a table", node.place.field, other.noun()),
                    "write a table here",
                ));
                &[]
            }
        };
        Self { place: &node.place, entries, asked: RefCell::default(), problems }
    }

    /// The raw value of a key, if it is there.
    pub fn get(&self, key: &'a str) -> Option<&'a Node> {
        self.asked.borrow_mut().push(key);
        self.entries.iter().find(|(name, _, _)| name == key).map(|(_, _, node)| node)
    }

    /// Every entry not asked for so far, now taken as asked for.
    pub fn rest(&self) -> Vec<&'a (String, Place, Node)> {
        let rest: Vec<_> = self
            .entries
            .iter()
            .filter(|(name, _, _)| !self.asked.borrow().contains(&name.as_str()))
            .collect();
        self.asked.borrow_mut().extend(rest.iter().map(|(name, _, _)| name.as_str()));
        rest
    }

    /// Reports a key that must be there and is not.
    pub fn missing(&self, key: &str, help: impl Into<String>) {
        let within = if self.place.field.is_empty() {
            String::new()
        } else {
            format!(" in `{}`", self.place.field)
        };
        let mut place = self.place.clone();
        place.field =
            if place.field.is_empty() { key.to_owned() } else { format!("{}.{key}", place.field) };
        self.problems.push(place.error(format!("`{key}` is missing{within}"), help));
    }

    /// A text, if it is there.
    pub fn text(&self, key: &'a str) -> Option<At<String>> {
        let node = self.get(key)?;
        match &node.content {
            Content::Text(text) => Some(At { value: text.clone(), place: node.place.clone() }),
            other => {
                let message = format!("`{key}` is {}, not a text", other.noun());
                self.problems.push(node.place.error(message, "write it in quotes"));
                None
            }
        }
    }

    /// A text that must be there.
    pub fn need_text(&self, key: &'a str, help: &str) -> Option<At<String>> {
        if !self.has(key) {
            self.missing(key, help);
        }
        self.text(key)
    }

    /// An id that must be there, such as that of a part.
    pub fn need_id(&self, key: &'a str, help: &str) -> Option<At<String>> {
        if !self.has(key) {
            self.missing(key, help);
        }
        self.id(key)
    }

    /// An id, if it is there.
    pub fn id(&self, key: &'a str) -> Option<At<String>> {
        let text = self.text(key)?;
        if names::is_id(&text.value) {
            return Some(text);
        }
        let message = format!("{:?} is no `{key}`", text.value);
        self.problems.push(text.place.error(message, names::ID_HELP));
        None
    }

    /// One of a few words, if it is there.
    pub fn word(&self, key: &'a str, allowed: &[&str]) -> Option<At<String>> {
        let text = self.text(key)?;
        if allowed.contains(&text.value.as_str()) {
            return Some(text);
        }
        let message = format!("`{}` is no value of `{key}`", text.value);
        let meant = nearest(&text.value, allowed.iter().copied())
            .map(|word| format!("; did you mean `{word}`?"));
        let choices =
            format!("expected one of {}{}", allowed.join(", "), meant.unwrap_or_default());
        self.problems.push(text.place.error(message, choices));
        None
    }

    /// True or false, if it is there.
    pub fn flag(&self, key: &'a str) -> Option<bool> {
        let node = self.get(key)?;
        if let Content::Flag(flag) = node.content {
            return Some(flag);
        }
        self.problems.push(node.place.error(
            format!("`{key}` is {}", node.content.noun()),
            "write true or false, without quotes",
        ));
        None
    }

    /// A value with unit, if it is there.
    pub fn value(&self, key: &'a str, quantity: Quantity, range: Range) -> Option<At<f64>> {
        let node = self.get(key)?;
        read_value(node, quantity, range, self.problems)
    }

    /// A value with unit that must be there.
    pub fn need_value(&self, key: &'a str, quantity: Quantity, range: Range) -> Option<At<f64>> {
        if !self.has(key) {
            self.missing(
                key,
                format!("expected {} such as {}", quantity.noun(), quantity.examples()),
            );
        }
        self.value(key, quantity, range)
    }

    /// A list of values with unit, of a length that must fit.
    pub fn values(
        &self,
        key: &'a str,
        quantity: Quantity,
        lengths: &[usize],
    ) -> Option<At<Vec<f64>>> {
        let node = self.get(key)?;
        let help = format!(
            "expected a list of {} values such as [\"{}\"]",
            words_of(lengths),
            quantity.examples()
        );
        let Content::List(items) = &node.content else {
            self.problems.push(
                node.place.error(format!("`{key}` is {}, not a list", node.content.noun()), help),
            );
            return None;
        };
        if !lengths.contains(&items.len()) {
            self.problems
                .push(node.place.error(format!("`{key}` has {} values", items.len()), help));
            return None;
        }
        let read: Vec<_> = items
            .iter()
            .map(|item| read_value(item, quantity, Range::Any, self.problems))
            .collect();
        let value = read
            .into_iter()
            .map(|item| item.map(|item| item.value))
            .collect::<Option<Vec<f64>>>()?;
        Some(At { value, place: node.place.clone() })
    }

    /// A whole number within a limit, if it is there.
    pub fn count(&self, key: &'a str, limit: &Limit) -> Option<At<u64>> {
        let node = self.get(key)?;
        let Content::Number(number) = node.content else {
            self.problems.push(node.place.error(
                format!("`{key}` is {}", node.content.noun()),
                "write a whole number, without quotes",
            ));
            return None;
        };
        if number.fract() != 0.0 || number < limit.least {
            self.problems.push(node.place.error(
                format!("`{key}` is {number}"),
                format!("expected a whole number, {} or more", limit.least),
            ));
            return None;
        }
        if let Err(beyond) = limit.check(key, number) {
            self.problems.push(beyond.at(&node.place));
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked above"
        )]
        let value = number as u64;
        Some(At { value, place: node.place.clone() })
    }

    /// A figure with source and confidence, if it is there.
    pub fn figure(
        &self,
        key: &'a str,
        quantity: Quantity,
        range: Range,
        file: &Provenance,
    ) -> Option<Figure> {
        let node = self.get(key)?;
        read_figure(node, quantity, range, file, self.problems)
    }

    /// The tables of a list, such as `[[line]]`; none where the key is not there.
    pub fn tables(&self, key: &'a str) -> &'a [Node] {
        match self.get(key).map(|node| (&node.content, node)) {
            Some((Content::List(items), _)) => items,
            Some((other, node)) => {
                self.problems.push(node.place.error(
                    format!("`{key}` is {}", other.noun()),
                    format!("write each one under [[{key}]]"),
                ));
                &[]
            }
            None => &[],
        }
    }

    /// A table, if it is there.
    pub fn table(&self, key: &'a str) -> Option<Fields<'a>> {
        self.get(key).map(|node| Fields::of(node, self.problems))
    }

    /// Refuses every key that was not asked for; the last thing done with a table.
    pub fn finish(&self) {
        let asked = self.asked.borrow();
        let is_unknown = |(name, _, _): &&(String, Place, Node)| !asked.contains(&name.as_str());
        let mut unknown = self.entries.iter().filter(is_unknown);
        for (name, key, _) in unknown.by_ref().take(DIAGNOSTICS) {
            self.problems.push(
                key.error(format!("unknown field `{name}`"), hint(name, asked.iter().copied())),
            );
        }
        self.problems.count_more(unknown.count());
    }

    /// Where problems go.
    pub fn problems(&self) -> &'a Problems {
        self.problems
    }

    fn has(&self, key: &str) -> bool {
        self.entries.iter().any(|(name, _, _)| name == key)
    }
}

fn words_of(lengths: &[usize]) -> String {
    lengths.iter().map(ToString::to_string).collect::<Vec<_>>().join(" or ")
}

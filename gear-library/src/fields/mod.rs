//! Reads the fields of a table. All problems are collected; a key that is not read is a problem too.

mod figure;

use std::cell::{Cell, RefCell};

use endline_sdk::LineEnd;

use crate::diagnostic::{At, Diagnostic, Place, hint, nearest};
use crate::limits::{DIAGNOSTICS, Limit};
use crate::names;
use crate::tree::{self, Content, Node};
use crate::units::Quantity;

pub use figure::{
    Figure, Provenance, Range, confidence, provenance, provenance_over, read_figure, read_value,
    sourced,
};

/// The ends of a line.
pub const ENDS: [(&str, LineEnd); 2] = [("from", LineEnd::A), ("to", LineEnd::B)];

/// A table that is being read; [`finish`](Self::finish) reports every key that was not requested.
pub struct Fields<'a> {
    /// Place of the table.
    pub place: &'a Place,
    entries: &'a [(String, Place, Node)],
    requested: RefCell<Vec<&'a str>>,
    problems: &'a Problems,
}

impl<'a> Fields<'a> {
    /// Opens a table; another value is reported and treated as an empty table.
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
        Self { place: &node.place, entries, requested: RefCell::default(), problems }
    }

    /// The value of a key, if present.
    pub fn get(&self, key: &'a str) -> Option<&'a Node> {
        self.requested.borrow_mut().push(key);
        self.entries.iter().find(|(name, _, _)| name == key).map(|(_, _, node)| node)
    }

    /// All entries that were not requested so far; they count as requested now.
    pub fn rest(&self) -> Vec<&'a (String, Place, Node)> {
        let rest: Vec<_> = self
            .entries
            .iter()
            .filter(|(name, _, _)| !self.requested.borrow().contains(&name.as_str()))
            .collect();
        self.requested.borrow_mut().extend(rest.iter().map(|(name, _, _)| name.as_str()));
        rest
    }

    /// Reports a required key that is missing.
    pub fn require(&self, key: &'a str, help: impl Into<String>) {
        if self.get(key).is_none() {
            self.missing(key, help);
        }
    }

    /// Reports a missing key.
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

    /// A text, if present.
    pub fn text(&self, key: &'a str) -> Option<At<String>> {
        let node = self.get(key)?;
        match &node.content {
            Content::Text(text) => Some(At { value: text.clone(), place: node.place.clone() }),
            other => {
                let message = format!("`{key}` is {}, not a text", other.noun());
                self.problems.refuse(node.place.error(message, "write it in quotes"))
            }
        }
    }

    /// A required text.
    pub fn need_text(&self, key: &'a str, help: &str) -> Option<At<String>> {
        self.require(key, help);
        self.text(key)
    }

    /// A required id, such as that of a part.
    pub fn need_id(&self, key: &'a str, help: &str) -> Option<At<String>> {
        self.require(key, help);
        self.id(key)
    }

    /// An id, if present.
    pub fn id(&self, key: &'a str) -> Option<At<String>> {
        let text = self.text(key)?;
        if names::is_id(&text.value) {
            return Some(text);
        }
        let message = format!("{:?} is not a valid `{key}`", text.value);
        self.problems.refuse(text.place.error(message, names::ID_HELP))
    }

    /// One of the allowed words, if present.
    pub fn word(&self, key: &'a str, allowed: &[&str]) -> Option<At<String>> {
        let text = self.text(key)?;
        if allowed.contains(&text.value.as_str()) {
            return Some(text);
        }
        let message = format!("`{}` is not a value of `{key}`", text.value);
        let meant = nearest(&text.value, allowed.iter().copied())
            .map(|word| format!("; did you mean `{word}`?"));
        let choices =
            format!("expected one of {}{}", allowed.join(", "), meant.unwrap_or_default());
        self.problems.refuse(text.place.error(message, choices))
    }

    /// One of the allowed words, required.
    pub fn need_word(&self, key: &'a str, help: &str, allowed: &[&str]) -> Option<At<String>> {
        self.require(key, help);
        self.word(key, allowed)
    }

    /// The value of one of the allowed words, if present.
    pub fn choice<T: Copy>(&self, key: &'a str, choices: &[(&str, T)]) -> Option<At<T>> {
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        let At { value, place } = self.word(key, &words)?;
        let (_, value) = choices.iter().find(|(word, _)| *word == value)?;
        Some(At { value: *value, place })
    }

    /// The value of one of the allowed words, required.
    pub fn need_choice<T: Copy>(
        &self,
        key: &'a str,
        help: &str,
        choices: &[(&str, T)],
    ) -> Option<T> {
        self.require(key, help);
        self.choice(key, choices).map(|choice| choice.value)
    }

    /// An end of a line, required.
    pub fn need_end(&self, key: &'a str, help: &str) -> Option<LineEnd> {
        self.need_choice(key, help, &ENDS)
    }

    /// True or false, if present.
    pub fn flag(&self, key: &'a str) -> Option<bool> {
        let node = self.get(key)?;
        if let Content::Flag(flag) = node.content {
            return Some(flag);
        }
        self.problems.refuse(node.place.error(
            format!("`{key}` is {}", node.content.noun()),
            "write true or false, without quotes",
        ))
    }

    /// A value with a unit, if present.
    pub fn value(&self, key: &'a str, quantity: Quantity, range: Range) -> Option<At<f64>> {
        let node = self.get(key)?;
        read_value(node, quantity, range, self.problems)
    }

    /// A required value with a unit.
    pub fn need_value(&self, key: &'a str, quantity: Quantity, range: Range) -> Option<At<f64>> {
        self.require(key, quantity.expected());
        self.value(key, quantity, range)
    }

    /// A list of values with units, of one of the allowed lengths.
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
            return self.problems.refuse(
                node.place.error(format!("`{key}` is {}, not a list", node.content.noun()), help),
            );
        };
        if !lengths.contains(&items.len()) {
            return self
                .problems
                .refuse(node.place.error(format!("`{key}` has {} values", items.len()), help));
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

    /// A whole number within a limit, if present.
    pub fn count(&self, key: &'a str, limit: &Limit) -> Option<At<u64>> {
        let node = self.get(key)?;
        let Content::Number(number) = node.content else {
            return self.problems.refuse(node.place.error(
                format!("`{key}` is {}", node.content.noun()),
                "write a whole number, without quotes",
            ));
        };
        if number.fract() != 0.0 || number < limit.least {
            return self.problems.refuse(node.place.error(
                format!("`{key}` is {number}"),
                format!("expected a whole number, {} or more", limit.least),
            ));
        }
        if let Err(beyond) = limit.check(key, number) {
            return self.problems.refuse(beyond.at(&node.place));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked above"
        )]
        let value = number as u64;
        Some(At { value, place: node.place.clone() })
    }

    /// A figure with source and confidence, if present.
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

    /// The tables of a list, such as `[[line]]`; empty if the key is missing.
    pub fn tables(&self, key: &'a str) -> &'a [Node] {
        match self.get(key).map(|node| (&node.content, node)) {
            Some((Content::List(items), _)) => items,
            Some((other, node)) => {
                self.problems.push(node.place.error(
                    format!("`{key}` is {}", other.noun()),
                    format!("write each entry under [[{key}]]"),
                ));
                &[]
            }
            None => &[],
        }
    }

    /// Reads each table of a list, such as `[[line]]`, and reports its unknown keys; omits a table that gives `None`.
    pub fn each<T>(&self, key: &'a str, read: impl Fn(&Fields<'a>) -> Option<T>) -> Vec<T> {
        let one = |node: &'a Node| {
            let fields = Fields::of(node, self.problems);
            let value = read(&fields);
            fields.finish();
            value
        };
        self.tables(key).iter().filter_map(one).collect()
    }

    /// A table, if present.
    pub fn table(&self, key: &'a str) -> Option<Fields<'a>> {
        self.get(key).map(|node| Fields::of(node, self.problems))
    }

    /// Reads a table, if present, and reports its unknown keys.
    pub fn inside<T>(&self, key: &'a str, read: impl FnOnce(&Fields<'a>) -> T) -> Option<T> {
        let table = self.table(key)?;
        let value = read(&table);
        table.finish();
        Some(value)
    }

    /// Reports every key that was not requested; called last.
    pub fn finish(&self) {
        let requested = self.requested.borrow();
        let is_unknown =
            |(name, _, _): &&(String, Place, Node)| !requested.contains(&name.as_str());
        let mut unknown = self.entries.iter().filter(is_unknown);
        for (name, key, _) in unknown.by_ref().take(DIAGNOSTICS) {
            self.problems.push(
                key.error(format!("unknown field `{name}`"), hint(name, requested.iter().copied())),
            );
        }
        self.problems.count_more(unknown.count());
    }

    /// The collected problems.
    pub fn problems(&self) -> &'a Problems {
        self.problems
    }

    /// Reports a problem; `None` in place of the refused value.
    pub fn refuse<T>(&self, problem: Diagnostic) -> Option<T> {
        self.problems.refuse(problem)
    }
}

fn words_of(lengths: &[usize]) -> String {
    lengths.iter().map(ToString::to_string).collect::<Vec<_>>().join(" or ")
}

/// Problems found while reading: the first [`DIAGNOSTICS`], and the number of the others.
#[derive(Debug, Default)]
pub struct Problems {
    stored: RefCell<Vec<Diagnostic>>,
    more: Cell<usize>,
}

impl Problems {
    /// Adds one.
    pub fn push(&self, problem: Diagnostic) {
        let mut stored = self.stored.borrow_mut();
        if stored.len() < DIAGNOSTICS {
            return stored.push(problem);
        }
        self.more.set(self.more.get() + 1);
        // An error replaces a stored warning.
        if problem.is_error()
            && let Some(warning) = stored.iter_mut().find(|known| !known.is_error())
        {
            *warning = problem;
        }
    }

    /// Adds one; `None` in place of the refused value.
    pub fn refuse<T>(&self, problem: Diagnostic) -> Option<T> {
        self.push(problem);
        None
    }

    /// Adds several.
    pub fn extend(&self, problems: impl IntoIterator<Item = Diagnostic>) {
        problems.into_iter().for_each(|problem| self.push(problem));
    }

    /// Counts problems that are not stored.
    pub fn count_more(&self, more: usize) {
        self.more.set(self.more.get() + more);
    }

    /// Whether there is an error.
    pub fn any_error(&self) -> bool {
        self.stored.borrow().iter().any(Diagnostic::is_error)
    }

    /// All problems, sorted by file and place.
    pub fn into_sorted(self) -> Vec<Diagnostic> {
        let mut all = self.stored.into_inner();
        all.sort_by(|a, b| (&a.file, a.line, a.column).cmp(&(&b.file, b.line, b.column)));
        all.dedup();
        if let (more @ 1.., Some(last)) = (self.more.get(), all.last()) {
            let message = format!("{more} more problems are not shown");
            let note = Diagnostic::of_file(&last.file, message, "correct these first");
            all.push(note);
        }
        all
    }
}

/// Reads a whole file, whose path is `name` in messages; `Err` has all its problems.
pub fn read_file<T>(
    name: &str,
    text: &str,
    read: impl FnOnce(&Node, &Problems) -> Option<T>,
) -> Result<T, Vec<Diagnostic>> {
    let problems = Problems::default();
    let node = tree::read(name, text).map_err(|problem| vec![*problem])?;
    match read(&node, &problems) {
        Some(value) if !problems.any_error() => Ok(value),
        _ => Err(problems.into_sorted()),
    }
}

/// Id of a file: its name without `.toml`.
pub fn id_of(path: &str) -> String {
    path.rsplit(['/', '\\']).next().unwrap_or(path).trim_end_matches(".toml").to_owned()
}

/// Reads a least and a greatest value, not negative, if present.
pub fn rising(
    fields: &Fields<'_>,
    key: &'static str,
    quantity: Quantity,
    example: &str,
) -> Option<[f64; 2]> {
    let node = fields.get(key)?;
    if matches!(&node.content, Content::List(items) if items.len() != 2) {
        let help = format!("write the least and the most, {example}");
        return fields.refuse(node.place.error(format!("`{key}` is not two values"), help));
    }
    let values = fields.values(key, quantity, &[2])?;
    match values.value.as_slice() {
        [least, most] if *least >= 0.0 && least <= most => Some([*least, *most]),
        _ => {
            let help = format!("write the least and the most, {example}");
            fields
                .refuse(values.place.error(format!("the two values of `{key}` do not rise"), help))
        }
    }
}

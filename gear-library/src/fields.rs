//! Reading the fields of a table: every problem is collected, every unread key is one.

use std::cell::RefCell;

use crate::diagnostic::{At, Diagnostic, Place};
use crate::nearest::{hint, nearest};
use crate::tree::{Content, Node};
use crate::units::{self, Quantity, format_si};

/// How sure a figure is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sureness {
    /// Measured, or printed by its source as such.
    Measured,
    /// Computed from measured figures.
    Derived,
    /// An engineering estimate.
    Estimate,
}

impl Sureness {
    /// The words a file may use.
    pub const WORDS: [&'static str; 3] = ["measured", "derived", "estimate"];

    /// The word a file uses.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Derived => "derived",
            Self::Estimate => "estimate",
        }
    }

    fn from_word(word: &str) -> Option<Self> {
        [Self::Measured, Self::Derived, Self::Estimate]
            .into_iter()
            .find(|sureness| sureness.word() == word)
    }
}

/// A number that enters physics: value, as written, source, sureness.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Value [SI].
    pub value: f64,
    /// As the file has it, such as `3/8 in`.
    pub text: String,
    /// Where it comes from.
    pub source: String,
    /// How sure it is.
    pub sureness: Sureness,
    /// Where the value stands.
    pub place: Place,
}

/// Source and sureness of figures that name none of their own.
#[derive(Clone, Debug, Default)]
pub struct Provenance {
    /// The file's source.
    pub source: Option<String>,
    /// The file's sureness.
    pub sureness: Option<Sureness>,
}

/// The range a value must lie in, with whether the least value itself is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// Between the two, both allowed.
    Between(f64, f64),
}

impl Range {
    fn holds(self, value: f64) -> bool {
        match self {
            Self::Any => value.is_finite(),
            Self::Positive => value > 0.0 && value.is_finite(),
            Self::NotNegative => value >= 0.0 && value.is_finite(),
            Self::Between(least, most) => (least..=most).contains(&value),
        }
    }

    /// In words, for messages and for help on a field: `above zero`.
    #[must_use]
    pub fn words(self, quantity: Quantity) -> String {
        match self {
            Self::Any => "any number".to_owned(),
            Self::Positive => "above zero".to_owned(),
            Self::NotNegative => "zero or above".to_owned(),
            Self::Between(least, most) => {
                format!("between {} and {}", format_si(least, quantity), format_si(most, quantity))
            }
        }
    }
}

/// All problems found while reading.
#[derive(Debug, Default)]
pub struct Problems(RefCell<Vec<Diagnostic>>);

impl Problems {
    /// Adds one.
    pub fn push(&self, problem: Diagnostic) {
        self.0.borrow_mut().push(problem);
    }

    /// Adds several.
    pub fn extend(&self, problems: impl IntoIterator<Item = Diagnostic>) {
        self.0.borrow_mut().extend(problems);
    }

    /// Whether one of them is an error.
    pub fn any_error(&self) -> bool {
        self.0.borrow().iter().any(Diagnostic::is_error)
    }

    /// All of them, by file and place.
    pub fn into_sorted(self) -> Vec<Diagnostic> {
        let mut all = self.0.into_inner();
        all.sort_by(|a, b| (&a.file, a.line, a.column).cmp(&(&b.file, b.line, b.column)));
        all.dedup();
        all
    }
}

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

    /// A whole number of at least `least`, if it is there.
    pub fn count(&self, key: &'a str, least: u64) -> Option<At<u64>> {
        let node = self.get(key)?;
        let Content::Number(number) = node.content else {
            self.problems.push(node.place.error(
                format!("`{key}` is {}", node.content.noun()),
                "write a whole number, without quotes",
            ));
            return None;
        };
        #[expect(clippy::cast_precision_loss, reason = "least is small")]
        if number.fract() != 0.0 || number < least as f64 || number > 9e15 {
            self.problems.push(node.place.error(
                format!("`{key}` is {number}"),
                format!("expected a whole number, {least} or more"),
            ));
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

    /// A figure with source and sureness, if it is there.
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
        for (name, key, _) in
            self.entries.iter().filter(|(name, _, _)| !asked.contains(&name.as_str()))
        {
            self.problems.push(
                key.error(format!("unknown field `{name}`"), hint(name, asked.iter().copied())),
            );
        }
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

/// Reads a value: a text with unit, a plain number where that is meant, or a table whose `value` it is.
pub fn read_value(
    node: &Node,
    quantity: Quantity,
    range: Range,
    problems: &Problems,
) -> Option<At<f64>> {
    let help = || format!("expected {} such as {}", quantity.noun(), quantity.examples());
    let name = node
        .place
        .field
        .rsplit('.')
        .find(|part| part.parse::<usize>().is_err())
        .unwrap_or_default();
    let value = match &node.content {
        Content::Text(text) => match units::parse(text, quantity) {
            Ok(value) => {
                if let Some(nearest) = units::odd_fraction(text) {
                    let help = format!(
                        "inches go in halves, quarters, eighths, sixteenths, 32nds and 64ths; the nearest is {nearest}; else write a decimal or millimetres"
                    );
                    problems.push(
                        node.place
                            .error(format!("`{text}` in `{name}` is no size in inches"), help),
                    );
                    return None;
                }
                value
            }
            Err(error) => {
                problems
                    .push(node.place.error(format!("{} in `{name}`", error.message), error.help));
                return None;
            }
        },
        Content::Number(number) if quantity == Quantity::Ratio => *number,
        Content::Number(number) => {
            problems.push(node.place.error(
                format!("`{name}` is {number} without a unit"),
                format!("{}, in quotes", help()),
            ));
            return None;
        }
        other => {
            problems.push(node.place.error(format!("`{name}` is {}", other.noun()), help()));
            return None;
        }
    };
    if range.holds(value) {
        return Some(At { value, place: node.place.clone() });
    }
    problems.push(node.place.error(
        format!("`{name}` is {}", format_si(value, quantity)),
        format!("it must be {}", range.words(quantity)),
    ));
    None
}

/// How a figure is given its source.
const HOW_TO_SOURCE: &str =
    "write { value = …, source = \"…\", sureness = \"measured\" }, or one for the whole file";

/// Reads a figure: `"3/8 in"` with the file's source and sureness, or a table with its own.
pub fn read_figure(
    node: &Node,
    quantity: Quantity,
    range: Range,
    file: &Provenance,
    problems: &Problems,
) -> Option<Figure> {
    let (value, source, sureness) = match &node.content {
        Content::Table(_) => {
            let fields = Fields::of(node, problems);
            let value = fields.get("value");
            let source = fields.text("source").map(|text| text.value);
            let sureness = fields
                .word("sureness", &Sureness::WORDS)
                .and_then(|word| Sureness::from_word(&word.value));
            if value.is_none() {
                fields.missing(
                    "value",
                    format!("expected {} such as {}", quantity.noun(), quantity.examples()),
                );
            }
            fields.finish();
            (value?, source, sureness)
        }
        _ => (node, None, None),
    };
    let mut named = value.clone();
    named.place.field.clone_from(&node.place.field);
    let read = read_value(&named, quantity, range, problems);
    let (source, sureness) = (source.or_else(|| file.source.clone()), sureness.or(file.sureness));
    if source.as_deref().unwrap_or_default().trim().is_empty() || sureness.is_none() {
        let lacks = if sureness.is_none() { "sureness" } else { "source" };
        let message = format!("`{}` has no {lacks}", node.place.field);
        problems.push(node.place.error(message, HOW_TO_SOURCE));
    }
    let text = match &value.content {
        Content::Text(text) => text.clone(),
        _ => format_si(read.as_ref()?.value, quantity),
    };
    Some(Figure {
        value: read?.value,
        text,
        source: source?,
        sureness: sureness?,
        place: value.place.clone(),
    })
}

/// The value of a figure whose quantity is not known yet: `"3/8 in"` with the file's source and sureness, or a table with its own.
pub fn sourced(node: &Node, file: &Provenance, problems: &Problems) -> Option<Node> {
    let (value, own) = match &node.content {
        Content::Table(_) => {
            let fields = Fields::of(node, problems);
            let value = fields.get("value").cloned();
            let own = provenance_over(&fields, file);
            if value.is_none() {
                fields.missing("value", "write the value here");
            }
            fields.finish();
            (value?, own)
        }
        _ => (node.clone(), file.clone()),
    };
    if own.source.as_deref().unwrap_or_default().trim().is_empty() || own.sureness.is_none() {
        let lacks = if own.sureness.is_none() { "sureness" } else { "source" };
        problems.push(
            node.place.error(format!("`{}` has no {lacks}", node.place.field), HOW_TO_SOURCE),
        );
    }
    let mut named = value;
    named.place.field.clone_from(&node.place.field);
    Some(named)
}

/// Reads the file's own source and sureness.
pub fn provenance(fields: &Fields<'_>) -> Provenance {
    let source = fields.text("source").map(|text| text.value);
    let sureness =
        fields.word("sureness", &Sureness::WORDS).and_then(|word| Sureness::from_word(&word.value));
    Provenance { source, sureness }
}

/// Reads a table's own source and sureness over those of the file.
pub fn provenance_over(fields: &Fields<'_>, file: &Provenance) -> Provenance {
    let own = provenance(fields);
    Provenance {
        source: own.source.or_else(|| file.source.clone()),
        sureness: own.sureness.or(file.sureness),
    }
}

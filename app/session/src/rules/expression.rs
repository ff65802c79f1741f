//! Expressions of rules: read with every mistake at its place, evaluated with what is known of gear.

use endline_gear::{At, Diagnostic, Place, hint};
use exmex::{Express, FlatEx, NumberMatcher};

use super::operators::{FUNCTIONS_OF_ONE, FUNCTIONS_OF_TWO, Operators};
use super::value::{Kind, Value};

type Flat = FlatEx<Value, Operators, NumberMatcher>;

/// Names that an expression may use, with what each is.
pub(super) type Names = Vec<(String, Kind)>;

/// An expression that was read.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    flat: Flat,
}

impl Expression {
    /// Reads what must be true or false.
    ///
    /// # Errors
    /// Every unknown name and odd character, or else what makes no sense, with its place.
    pub fn read(text: &At<String>, names: &Names) -> Result<Self, Vec<Diagnostic>> {
        let problems = unknown_words(text, names);
        if !problems.is_empty() {
            return Err(problems);
        }
        let wrong = |message: String, help: &str| vec![text.place.error(message, help)];
        let flat = Flat::parse(&text.value).map_err(|error| {
            wrong(
                format!("cannot be read: {}", error.msg()),
                "see docs/rules.md for what it may hold",
            )
        })?;
        let expression = Self { flat };
        let kinds = |name: &str| {
            let kind = names.iter().find(|(known, _)| known == name).map(|(_, kind)| *kind);
            kind.map(|kind| Value::Unknown { kind, why: String::new() })
        };
        match expression.value(&kinds) {
            Value::Wrong(why) => Err(wrong(why, "compare what is measured in the same unit")),
            value if value.kind() != Some(Kind::Truth) => {
                let message = format!("is {}, not true or false", value.noun());
                Err(wrong(message, "compare it, such as with <= and a parameter"))
            }
            _ => Ok(expression),
        }
    }

    /// Its value, with the values of the names it uses.
    pub fn value(&self, of: &dyn Fn(&str) -> Option<Value>) -> Value {
        let one = |name: &String| of(name).unwrap_or_else(|| Value::Wrong(format!("no `{name}`")));
        let values: Vec<Value> = self.flat.var_names().iter().map(one).collect();
        self.flat.eval_vec(values).unwrap_or_else(|error| Value::Wrong(error.msg().to_owned()))
    }
}

/// Whether a name would be read as a function: the library takes the longest operator that a name begins with.
pub(super) fn begins_with_function(name: &str) -> Option<&'static str> {
    FUNCTIONS_OF_TWO.into_iter().find(|function| name.starts_with(function))
}

/// Names that are neither facts, parameters nor functions, and characters that no expression has.
fn unknown_words(text: &At<String>, names: &Names) -> Vec<Diagnostic> {
    let functions = || FUNCTIONS_OF_ONE.into_iter().chain(FUNCTIONS_OF_TWO);
    let known = || names.iter().map(|(name, _)| name.as_str()).chain(functions());
    let mut problems = Vec::new();
    for (start, word) in words(&text.value) {
        let place = within(text, start, word.len());
        let is_name =
            word.starts_with(|letter: char| letter.is_ascii_alphabetic() || letter == '_');
        if is_name && !known().any(|name| name == word) {
            let message = format!("there is no fact or parameter `{word}`");
            problems.push(place.error(message, hint(word, known())));
        } else if !is_name && !word.chars().all(may_stand) {
            let help = "an expression has names, numbers, ( ) , + - * / < <= > >= == != ! && ||";
            problems.push(place.error(format!("`{word}` has no place here"), help));
        }
    }
    problems
}

fn may_stand(letter: char) -> bool {
    letter.is_ascii_digit() || "().,+-*/<>=!&| ".contains(letter)
}

/// Names, numbers and single characters, with the byte where each starts.
fn words(text: &str) -> Vec<(usize, &str)> {
    let in_word = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '.';
    let (mut found, mut at) = (Vec::new(), 0);
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let long = rest.find(|letter| !in_word(letter)).unwrap_or(rest.len());
        let length = if long > 0 { long } else { first.len_utf8() };
        found.push((at, &rest[..length]));
        at += length;
    }
    found
}

/// Part of a text's place; the whole of it where the file writes the text otherwise, such as with escapes.
fn within(text: &At<String>, start: usize, length: usize) -> Place {
    let mut place = text.place.clone();
    let span = place.source.text.get(place.span.clone()).unwrap_or_default();
    if let Some(quote) = span.find(&text.value) {
        let from = place.span.start + quote + start;
        place.span = from..from + length;
    }
    place
}

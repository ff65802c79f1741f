//! Expressions of rules: read with every mistake at its place, evaluated on the facts of gear.
//!
//! An unknown value makes a result unknown, unless the other side decides: `false && unknown` is false, `true || unknown` is true.

use endline_gear::units::Quantity;
use endline_gear::{At, Diagnostic, Place, hint};
use exmex::{BinOp, Express, FlatEx, MakeOperators, NumberMatcher, Operator};

use super::value::{Compared, Kind, Value};

type Flat = FlatEx<Value, Operators, NumberMatcher>;

/// Names that an expression may use, with their kinds.
pub(super) type Names = Vec<(String, Kind)>;

/// An expression that was read.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    flat: Flat,
}

impl Expression {
    /// Reads an expression that is true or false.
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

/// Functions of two values: no name of a fact or parameter may begin with one of them.
pub(super) const FUNCTIONS_OF_TWO: [&str; 3] = ["upper_part", "weak_places", "place_from"];
/// Functions of one value.
pub(super) const FUNCTIONS_OF_ONE: [&str; 4] =
    ["longest_gap", "share_of", "first_place", "count_of"];

/// Numbers closer than this share are equal: units change the last digits.
const ROUNDING: f64 = 1e-9;

/// Makes the operators.
#[derive(Clone, Debug)]
pub(super) struct Operators;

impl MakeOperators<Value> for Operators {
    fn make<'a>() -> Vec<Operator<'a, Value>> {
        let two = |name, prio, apply| {
            Operator::make_bin(name, BinOp { apply, prio, is_commutative: false })
        };
        let minus = BinOp { apply: |a, b| sum(a, b, -1.0), prio: 4, is_commutative: false };
        let negative = |a| sum(Value::count(0.0), a, -1.0);
        let [upper_part, weak_places, place_from] = FUNCTIONS_OF_TWO;
        let [longest_gap, share_of, first_place, count_of] = FUNCTIONS_OF_ONE;
        vec![
            two("||", 0, |a, b| either(a, b, true)),
            two("&&", 1, |a, b| either(a, b, false)),
            two("<=", 3, |a, b| compare(a, b, "<=")),
            two(">=", 3, |a, b| compare(a, b, ">=")),
            two("==", 3, |a, b| compare(a, b, "==")),
            two("!=", 3, |a, b| compare(a, b, "!=")),
            two("<", 3, |a, b| compare(a, b, "<")),
            two(">", 3, |a, b| compare(a, b, ">")),
            two("+", 4, |a, b| sum(a, b, 1.0)),
            Operator::make_bin_unary("-", minus, negative),
            two("*", 5, product),
            two("/", 5, quotient),
            Operator::make_unary("!", not),
            two(upper_part, 6, |a, b| of_line(a, b, Quantity::Ratio)),
            two(weak_places, 6, |a, b| of_line(a, b, Quantity::Force)),
            two(place_from, 6, place_from_share),
            Operator::make_unary(longest_gap, |a| of_places(a, "longest_gap")),
            Operator::make_unary(share_of, |a| of_places(a, "share_of")),
            Operator::make_unary(first_place, |a| of_places(a, "first_place")),
            Operator::make_unary(count_of, |a| of_places(a, "count_of")),
        ]
    }
}

fn unknown(kind: Kind, why: String) -> Value {
    Value::Unknown { kind, why }
}

/// Why one of two values is not known.
fn why(a: &Value, b: &Value) -> Option<String> {
    match (a, b) {
        (Value::Unknown { why, .. }, Value::Unknown { why: other, .. }) if why != other => {
            Some(format!("{why}; {other}"))
        }
        (Value::Unknown { why, .. }, _) | (_, Value::Unknown { why, .. }) => Some(why.clone()),
        _ => None,
    }
}

/// The quantities of two numbers, or the value that replaces the result.
fn numbers(a: &Value, b: &Value, does: &str) -> Result<(Quantity, Quantity), Value> {
    match (a, b) {
        (Value::Wrong(why), _) | (_, Value::Wrong(why)) => return Err(Value::Wrong(why.clone())),
        _ => {}
    }
    match (a.kind(), b.kind()) {
        (Some(Kind::Number(left)), Some(Kind::Number(right))) => Ok((left, right)),
        _ => Err(Value::Wrong(format!("{does} {} and {}", a.noun(), b.noun()))),
    }
}

/// The piece that was measured of two numbers: of the left one where both name one.
fn piece(a: &Value, b: &Value) -> Option<String> {
    [a, b].into_iter().find_map(|value| match value {
        Value::Number { of, .. } => of.clone(),
        _ => None,
    })
}

fn compare(a: Value, b: Value, sign: &'static str) -> Value {
    let (left, right) = match numbers(&a, &b, &format!("`{sign}` compares")) {
        Ok(both) => both,
        Err(instead) => return instead,
    };
    if left != right {
        return Value::Wrong(format!("`{sign}` compares {} and {}", left.noun(), right.noun()));
    }
    match (&a, &b) {
        (
            Value::Number { si: left, quantity, unit, .. },
            Value::Number { si: right, unit: other, .. },
        ) => {
            let (left, right) = (*left, *right);
            let slack = ROUNDING * left.abs().min(right.abs());
            let equal = left.total_cmp(&right).is_eq() || (left - right).abs() <= slack;
            let holds = match sign {
                "<=" => left < right || equal,
                ">=" => left > right || equal,
                "<" => left < right && !equal,
                ">" => left > right && !equal,
                "==" => equal,
                _ => !equal,
            };
            let unit = other.or(*unit);
            let of = piece(&a, &b);
            let compared = Compared { left, sign, right, quantity: *quantity, unit, of, holds };
            Value::Truth { holds, compared: vec![compared] }
        }
        _ => unknown(Kind::Truth, why(&a, &b).unwrap_or_default()),
    }
}

/// `||` where `decides` is true, `&&` where it is false.
fn either(a: Value, b: Value, decides: bool) -> Value {
    for value in [&a, &b] {
        if let Value::Wrong(why) = value {
            return Value::Wrong(why.clone());
        }
        if value.kind() != Some(Kind::Truth) {
            let sign = if decides { "||" } else { "&&" };
            return Value::Wrong(format!("`{sign}` joins what is {}", value.noun()));
        }
    }
    let is_decided =
        |value: &Value| matches!(value, Value::Truth { holds, .. } if *holds == decides);
    match (is_decided(&a), is_decided(&b)) {
        (true, false) => a,
        (false, true) => b,
        _ => match (a, b) {
            (Value::Truth { holds, mut compared }, Value::Truth { compared: others, .. }) => {
                compared.extend(others);
                Value::Truth { holds, compared }
            }
            (a, b) => unknown(Kind::Truth, why(&a, &b).unwrap_or_default()),
        },
    }
}

fn not(a: Value) -> Value {
    match a {
        Value::Truth { holds, compared } => Value::Truth { holds: !holds, compared },
        Value::Unknown { kind: Kind::Truth, .. } | Value::Wrong(_) => a,
        other => Value::Wrong(format!("`!` turns what is {}", other.noun())),
    }
}

fn sum(a: Value, b: Value, sign: f64) -> Value {
    let (left, right) = match numbers(&a, &b, "a sum has") {
        Ok(both) => both,
        Err(instead) => return instead,
    };
    // The zero before a single minus takes the unit of what follows.
    let is_zero = matches!(a, Value::Number { si: 0.0, quantity: Quantity::Ratio, .. });
    if left != right && !is_zero {
        return Value::Wrong(format!("a sum has {} and {}", left.noun(), right.noun()));
    }
    match (&a, &b) {
        (Value::Number { si: x, unit, .. }, Value::Number { si: y, unit: other, .. }) => {
            let si = x + sign * y;
            Value::Number { si, quantity: right, unit: unit.or(*other), of: piece(&a, &b) }
        }
        _ => unknown(Kind::Number(right), why(&a, &b).unwrap_or_default()),
    }
}

fn product(a: Value, b: Value) -> Value {
    let (left, right) = match numbers(&a, &b, "a product has") {
        Ok(both) => both,
        Err(instead) => return instead,
    };
    let quantity = match (left, right) {
        (Quantity::Ratio, other) | (other, Quantity::Ratio) => other,
        _ => {
            return Value::Wrong(format!("a product has {} and {}", left.noun(), right.noun()));
        }
    };
    match (&a, &b) {
        (Value::Number { si: x, unit, .. }, Value::Number { si: y, unit: other, .. }) => {
            Value::Number { si: x * y, quantity, unit: unit.or(*other), of: piece(&a, &b) }
        }
        _ => unknown(Kind::Number(quantity), why(&a, &b).unwrap_or_default()),
    }
}

fn quotient(a: Value, b: Value) -> Value {
    let (left, right) = match numbers(&a, &b, "a quotient has") {
        Ok(both) => both,
        Err(instead) => return instead,
    };
    let quantity = match (left, right) {
        (left, Quantity::Ratio) => left,
        (left, right) if left == right => Quantity::Ratio,
        _ => {
            return Value::Wrong(format!("a quotient has {} and {}", left.noun(), right.noun()));
        }
    };
    match (&a, &b) {
        (Value::Number { si: x, unit, .. }, Value::Number { si: y, .. }) => {
            let unit = if quantity == left { *unit } else { None };
            Value::Number { si: x / y, quantity, unit, of: piece(&a, &b) }
        }
        _ => unknown(Kind::Number(quantity), why(&a, &b).unwrap_or_default()),
    }
}

/// `upper_part(line, share)` and `weak_places(line, force)`, by the quantity of the second argument.
fn of_line(a: Value, b: Value, needs: Quantity) -> Value {
    let is_part = needs == Quantity::Ratio;
    let name = if is_part { "upper_part" } else { "weak_places" };
    let gives = if is_part { Kind::Line } else { Kind::Places };
    if let Some(instead) = refused(&a, &b, name, (Kind::Line, needs)) {
        return instead;
    }
    match (&a, &b) {
        (Value::Line(line), Value::Number { si, .. }) if is_part => {
            Value::Line(line.upper_part(*si))
        }
        (Value::Line(line), Value::Number { si, .. }) => Value::Places(line.weak_places(*si)),
        _ => unknown(gives, why(&a, &b).unwrap_or_default()),
    }
}

fn place_from_share(a: Value, b: Value) -> Value {
    if let Some(instead) = refused(&a, &b, "place_from", (Kind::Places, Quantity::Ratio)) {
        return instead;
    }
    match (&a, &b) {
        (Value::Places(places), Value::Number { si, .. }) => Value::count(places.from_share(*si)),
        _ => unknown(Kind::Number(Quantity::Ratio), why(&a, &b).unwrap_or_default()),
    }
}

/// The error for two values of which a function does not take the kinds.
fn refused(a: &Value, b: &Value, name: &str, takes: (Kind, Quantity)) -> Option<Value> {
    if let (Value::Wrong(why), _) | (_, Value::Wrong(why)) = (a, b) {
        return Some(Value::Wrong(why.clone()));
    }
    let fits = a.kind() == Some(takes.0) && b.kind() == Some(Kind::Number(takes.1));
    let message = || {
        format!(
            "`{name}` takes {} and {}, not {} and {}",
            takes.0.noun(),
            takes.1.noun(),
            a.noun(),
            b.noun()
        )
    };
    (!fits).then(|| Value::Wrong(message()))
}

fn of_places(a: Value, name: &str) -> Value {
    let quantity = if matches!(name, "longest_gap" | "first_place") {
        Quantity::Length
    } else {
        Quantity::Ratio
    };
    #[expect(clippy::cast_precision_loss, reason = "a few places")]
    match a {
        Value::Places(places) => Value::measure(
            match name {
                "longest_gap" => places.longest_gap_m(),
                "first_place" => places.first_m(),
                "share_of" => places.share(),
                _ => places.spans_m.len() as f64,
            },
            quantity,
        ),
        Value::Unknown { kind: Kind::Places, why } => unknown(Kind::Number(quantity), why),
        Value::Wrong(why) => Value::Wrong(why),
        other => {
            Value::Wrong(format!("`{name}` takes places along an endline, not {}", other.noun()))
        }
    }
}

//! Expressions and templates of text gear types: `1.3 * depth + 2 fathom`, `trap-{i}`, `{rope}`.
//!
//! Expressions have units of length and a dimension: the power of length, computed when they are read. A sum of a length and
//! a pure number is an error with a location and a correction. This is why they have their own parser: exmex, which
//! evaluates the rules, has neither units nor dimensions. Only `+ - * /`, `min`, `max` and the correctly rounded square root
//! are used, so that results are equal on all platforms.
//!
//! ```text
//! expression = term { ("+" | "-") term }
//! term       = factor { ("*" | "/") factor }
//! factor     = "-" factor | number [unit of length] | name | "(" expression ")"
//!            | "min" "(" expression "," expression ")" | "max" "(" … ")" | "sqrt" "(" expression ")"
//! ```
//! A template is a text with braces, which contain a count or the key of an attribute that is an item.

use endline_sdk::AttributeValue;

use crate::diagnostic::{At, hint};
use crate::fields::Problems;
use crate::units::{self, Quantity};

/// Greatest number of instructions of an expression, and greatest depth of brackets.
const MOST: usize = 200;

/// A name in expressions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Name {
    /// As written.
    pub key: String,
    /// Power of length of its value; `None` for an item, which has no value.
    pub power: Option<i32>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Code {
    Push(f64),
    Load(usize),
    Negate,
    Two(Operator),
    Root,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Least,
    Greatest,
}

/// A compiled expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Expression {
    code: Vec<Code>,
    /// Power of length: 1 for a length, 0 for a pure number.
    pub power: i32,
}

impl Expression {
    /// A number.
    pub fn number(value: f64) -> Self {
        Self { code: vec![Code::Push(value)], power: 0 }
    }

    /// Reads an expression; `Err` is a message with its help.
    pub fn read(text: &str, names: &[Name]) -> Result<Self, (String, String)> {
        let mut reader = Reader { rest: text, names, code: Vec::new(), depth: 0 };
        let power = reader.sum()?;
        if let Some(left) = reader.peek() {
            return fail(
                format!("unexpected `{left}` after the end of the expression"),
                "write an operator + - * / before it, or remove it",
            );
        }
        Ok(Self { code: reader.code, power })
    }

    /// Its value for the values of the names, in order.
    pub fn value(&self, values: &[f64]) -> f64 {
        let mut stack: Vec<f64> = Vec::with_capacity(8);
        for code in &self.code {
            let result = match *code {
                Code::Push(number) => number,
                Code::Load(index) => values.get(index).copied().unwrap_or(f64::NAN),
                Code::Negate => -stack.pop().unwrap_or(f64::NAN),
                Code::Root => libm::sqrt(stack.pop().unwrap_or(f64::NAN)),
                Code::Two(operator) => {
                    let (b, a) = (stack.pop().unwrap_or(f64::NAN), stack.pop().unwrap_or(f64::NAN));
                    operator.of(a, b)
                }
            };
            stack.push(result);
        }
        stack.pop().unwrap_or(f64::NAN)
    }
}

impl Operator {
    fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Least => a.min(b),
            Self::Greatest => a.max(b),
        }
    }
}

/// Recursive descent parser that emits instructions; each function returns the power of length.
struct Reader<'a> {
    rest: &'a str,
    names: &'a [Name],
    code: Vec<Code>,
    depth: usize,
}

type Power = Result<i32, (String, String)>;

fn fail<T>(message: impl Into<String>, help: impl Into<String>) -> Result<T, (String, String)> {
    Err((message.into(), help.into()))
}

impl Reader<'_> {
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.rest = &self.rest[wanted.len_utf8()..];
        }
        found
    }

    fn write(&mut self, code: Code) -> Result<(), (String, String)> {
        self.code.push(code);
        if self.code.len() > MOST {
            fail(format!("the expression has more than {MOST} parts"), "make it shorter")
        } else {
            Ok(())
        }
    }

    fn sum(&mut self) -> Power {
        let mut power = self.product()?;
        loop {
            let operator = if self.take('+') {
                Operator::Add
            } else if self.take('-') {
                Operator::Subtract
            } else {
                return Ok(power);
            };
            let other = self.product()?;
            power = same(power, other)?;
            self.write(Code::Two(operator))?;
        }
    }

    fn product(&mut self) -> Power {
        let mut power = self.factor()?;
        loop {
            if self.take('*') {
                power += self.factor()?;
                self.write(Code::Two(Operator::Multiply))?;
            } else if self.take('/') {
                power -= self.factor()?;
                self.write(Code::Two(Operator::Divide))?;
            } else {
                return Ok(power);
            }
        }
    }

    fn factor(&mut self) -> Power {
        self.depth += 1;
        if self.depth > MOST {
            return fail("the expression is nested too deeply", "make it shorter");
        }
        let power = match self.peek() {
            Some('-') => {
                self.take('-');
                let power = self.factor()?;
                self.write(Code::Negate)?;
                power
            }
            Some('(') => self.bracket()?,
            Some(c) if c.is_ascii_digit() || c == '.' => self.number()?,
            Some(c) if c.is_alphabetic() => self.name()?,
            Some(c) => {
                return fail(
                    format!("unexpected `{c}` in an expression"),
                    "write numbers, names, + - * / and brackets",
                );
            }
            None => {
                return fail(
                    "the expression is incomplete: a number or a name is missing",
                    "write an expression such as 1.3 * depth",
                );
            }
        };
        self.depth -= 1;
        Ok(power)
    }

    fn bracket(&mut self) -> Power {
        self.take('(');
        let power = self.sum()?;
        if self.take(')') {
            Ok(power)
        } else {
            fail("a bracket is not closed", "write the missing )")
        }
    }

    /// A number with an optional unit of length.
    fn number(&mut self) -> Power {
        let digits = self.word(|c| c.is_ascii_digit() || c == '.');
        let unit = if self.peek().is_some_and(char::is_alphabetic) {
            self.word(char::is_alphanumeric)
        } else {
            String::new()
        };
        let (quantity, power) =
            if unit.is_empty() { (Quantity::Ratio, 0) } else { (Quantity::Length, 1) };
        let value = units::parse(&format!("{digits} {unit}"), quantity)
            .map_err(|error| (error.message, error.help))?;
        self.write(Code::Push(value))?;
        Ok(power)
    }

    /// Reads characters while they match.
    fn word(&mut self, fits: impl Fn(char) -> bool) -> String {
        let end = self.rest.find(|c| !fits(c)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word.to_owned()
    }

    fn name(&mut self) -> Power {
        let word = self.word(|c| c.is_alphanumeric() || c == '_');
        match word.as_str() {
            "min" => return self.of_two(Operator::Least),
            "max" => return self.of_two(Operator::Greatest),
            "sqrt" => return self.root(),
            _ => {}
        }
        let Some(index) = self.names.iter().position(|name| name.key == word) else {
            return fail(
                format!("unknown name `{word}`"),
                hint(&word, self.names.iter().map(|name| name.key.as_str())),
            );
        };
        let Some(power) = self.names[index].power else {
            return fail(
                format!("`{word}` is an item and has no value"),
                format!("write an item in braces, such as item = \"{{{word}}}\""),
            );
        };
        self.write(Code::Load(index))?;
        Ok(power)
    }

    fn of_two(&mut self, operator: Operator) -> Power {
        let open = self.take('(');
        let one = self.sum()?;
        let comma = self.take(',');
        if !open || !comma {
            return fail(
                "`min` and `max` have two arguments",
                "write them such as max(depth, 20 m)",
            );
        }
        let power = same(one, self.sum()?)?;
        self.write(Code::Two(operator))?;
        if self.take(')') {
            Ok(power)
        } else {
            fail("a bracket is not closed", "write the missing )")
        }
    }

    fn root(&mut self) -> Power {
        let power = self.bracket()?;
        if power % 2 != 0 {
            return fail(
                format!("the root of {} is neither a length nor a number", noun(power)),
                "take the root of a product of two lengths",
            );
        }
        self.write(Code::Root)?;
        Ok(power / 2)
    }
}

fn same(one: i32, other: i32) -> Power {
    if one == other {
        return Ok(one);
    }
    let help = "write lengths with a unit, such as 2 m or 1 fathom";
    fail(format!("cannot add or compare {} and {}", noun(one), noun(other)), help)
}

/// Name of a power of length.
pub(super) fn noun(power: i32) -> String {
    match power {
        0 => "a pure number".to_owned(),
        1 => "a length".to_owned(),
        2 => "an area".to_owned(),
        power => format!("a length to the power {power}"),
    }
}

/// A template: a text with braces.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Template(Vec<Piece>);

#[derive(Clone, Debug, PartialEq)]
enum Piece {
    Text(String),
    /// The item of the attribute with this index.
    Item(usize),
    /// A whole number.
    Count(Expression),
}

impl Template {
    /// Reads a template; problems are reported.
    pub fn read(text: &At<String>, names: &[Name], problems: &Problems) -> Option<Self> {
        let (mut pieces, mut rest) = (Vec::new(), text.value.as_str());
        while let Some((before, after)) = rest.split_once('{') {
            pieces.push(Piece::Text(before.to_owned()));
            let Some((inside, after)) = after.split_once('}') else {
                return problems.refuse(
                    text.place.error(
                        "a brace is not closed",
                        "write the missing }, such as \"trap-{i}\"",
                    ),
                );
            };
            pieces.push(piece(inside.trim(), text, names, problems)?);
            rest = after;
        }
        pieces.push(Piece::Text(rest.to_owned()));
        Some(Self(pieces))
    }

    /// The text for values of the names and attributes.
    pub fn text(&self, values: &[f64], attributes: &[AttributeValue]) -> String {
        let mut text = String::new();
        for piece in &self.0 {
            match piece {
                Piece::Text(words) => text.push_str(words),
                Piece::Item(index) => text.push_str(
                    attributes.get(*index).and_then(AttributeValue::item).unwrap_or_default(),
                ),
                Piece::Count(expression) => {
                    text.push_str(&format!("{:.0}", expression.value(values)))
                }
            }
        }
        text
    }
}

fn piece(inside: &str, text: &At<String>, names: &[Name], problems: &Problems) -> Option<Piece> {
    if let Some(index) = names.iter().position(|name| name.key == inside && name.power.is_none()) {
        return Some(Piece::Item(index));
    }
    match Expression::read(inside, names) {
        Ok(expression) if expression.power == 0 => Some(Piece::Count(expression)),
        Ok(expression) => {
            let message = format!(
                "`{{{inside}}}` is {}, not a whole number or an item",
                noun(expression.power)
            );
            problems.refuse(
                text.place
                    .error(message, "write a count such as {i}, or the key of an item attribute"),
            )
        }
        Err((message, help)) => problems.refuse(text.place.error(message, help)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names() -> Vec<Name> {
        let name = |key: &str, power| Name { key: key.to_owned(), power };
        vec![name("depth", Some(1)), name("scope", Some(0)), name("rope", None)]
    }

    #[test]
    fn values_are_those_of_arithmetic() {
        for (text, expected, power) in [
            ("1.3 * depth + 2 fathom", 1.3 * 20.0 + 2.0 * 1.8288, 1),
            ("-(depth - 5 m) / 2 m * scope", -(20.0 - 5.0) / 2.0 * 1.5, 0),
            ("10 - 2 - 3", 5.0, 0),
            ("max(depth, 30 m) / min(2, scope)", 30.0 / 1.5, 1),
            ("sqrt(depth * depth + 15 m * 15 m)", 25.0, 1),
        ] {
            let expression = Expression::read(text, &names()).unwrap();
            let value = expression.value(&[20.0, 1.5, f64::NAN]);
            assert!(
                (value - expected).abs() < 1e-12 && expression.power == power,
                "{text}: {value} {}",
                expression.power
            );
        }
    }

    #[test]
    fn invalid_expressions_are_reported() {
        let long = "(".repeat(500);
        for (text, expected) in [
            ("depth + 2", "cannot add or compare a length and a pure number"),
            ("dept + 2 m", "unknown name `dept`"),
            ("rope * 2", "is an item"),
            ("2 lbf", "`lbf` is a unit of a force"),
            ("(depth", "not closed"),
            ("depth 2", "after the end"),
            ("2 *", "incomplete"),
            ("sqrt(depth)", "the root of a length"),
            ("depth ^ 2", "after the end"),
            (&long, "nested too deeply"),
        ] {
            let (message, help) = Expression::read(text, &names()).unwrap_err();
            assert!(message.contains(expected) && !help.is_empty(), "{text}: {message}; {help}");
        }
    }
}

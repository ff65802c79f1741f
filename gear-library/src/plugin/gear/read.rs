//! Reading the parts of a gear type without code.

use endline_sdk::{BodyKind, LineEnd};

use super::{Body, Joint, Line, Link, Part, Place};
use crate::diagnostic::At;
use crate::fields::{Fields, Problems};
use crate::plugin::expression::{Expression, Name, noun};
use crate::plugin::words::Words;
use crate::tree::{Content, Node};

/// Reads the fields of parts.
pub(super) struct Reader<'a> {
    /// Names that expressions may use.
    pub(super) names: Vec<Name>,
    /// Where problems go.
    pub(super) problems: &'a Problems,
}

impl Reader<'_> {
    fn part(&self, fields: &Fields<'_>) -> Option<Part> {
        let id = fields.need_text("id", "write an id such as \"trap\", or \"trap-{i}\" in a row");
        let repeat = if fields.get("repeat").is_some() {
            self.expression(fields, "repeat", 0)
        } else {
            Some(Expression::number(1.0))
        };
        Some(Part { id: self.words(&id?)?, repeat: repeat? })
    }

    fn words(&self, text: &At<String>) -> Option<Words> {
        Words::read(text, &self.names, self.problems)
    }

    fn need_words(&self, fields: &Fields<'_>, key: &'static str, help: &str) -> Option<Words> {
        self.words(&fields.need_text(key, help)?)
    }

    /// An expression of a power of length, from a text or a plain number.
    fn expression(&self, fields: &Fields<'_>, key: &'static str, power: i32) -> Option<Expression> {
        match fields.get(key) {
            Some(node) => self.expression_of(node, power),
            None => {
                let example =
                    if power == 1 { "\"1.3 * depth\" or \"20 m\"" } else { "\"traps - 1\"" };
                fields.missing(key, format!("write {} such as {example}", noun(power)));
                None
            }
        }
    }

    fn expression_of(&self, node: &Node, power: i32) -> Option<Expression> {
        let read = match &node.content {
            Content::Number(number) => Ok(Expression::number(*number)),
            Content::Text(text) => Expression::read(text, &self.names),
            other => Err((
                format!("this is {}, not an expression", other.noun()),
                "write it in quotes, as in \"1.3 * depth\"".to_owned(),
            )),
        };
        let read = read.and_then(|expression| {
            let (is, wanted) = (noun(expression.power), noun(power));
            let help = "lengths carry a unit, such as 2 m; pure numbers carry none".to_owned();
            if expression.power == power {
                Ok(expression)
            } else {
                Err((format!("this is {is}; expected {wanted}"), help))
            }
        });
        read.map_err(|(message, help)| self.problems.push(node.place.error(message, help))).ok()
    }

    /// `position` along and across the gear, `height` as a share of the depth.
    fn place(&self, fields: &Fields<'_>) -> Option<Place> {
        let zero = || Some(Expression::number(0.0));
        let [x, y] = match fields.get("position").map(|node| (&node.content, node)) {
            None => [zero(), zero()],
            Some((Content::List(items), _)) if items.len() == 2 => {
                [&items[0], &items[1]].map(|node| self.expression_of(node, 1))
            }
            Some((_, node)) => {
                let help =
                    "write it along and across the gear, as in position = [\"-10 m\", \"0 m\"]";
                self.problems.push(node.place.error("`position` is no list of two lengths", help));
                return None;
            }
        };
        let height = if fields.get("height").is_some() {
            self.expression(fields, "height", 0)
        } else {
            zero()
        };
        Some(Place([x?, y?, height?]))
    }

    /// Reads a `[[body]]`; `None` where something needed is missing or wrong, which is reported.
    pub(super) fn body(&self, node: &Node) -> Option<Body> {
        let fields = Fields::of(node, self.problems);
        let part = self.part(&fields);
        let kind = fields.need_text("kind", "write trap, buoy or anchor");
        let kind = kind.and_then(|_| fields.word("kind", &["trap", "buoy", "anchor"]));
        let item = self.need_words(
            &fields,
            "item",
            "write the id of an item, or the key of an attribute in braces: \"{trap}\"",
        );
        let place = self.place(&fields);
        fields.finish();
        let kind = match kind?.value.as_str() {
            "trap" => BodyKind::Trap,
            "buoy" => BodyKind::Buoy,
            _ => BodyKind::Anchor,
        };
        Some(Body { part: part?, kind, item: item?, place: place? })
    }

    /// Reads a `[[joint]]`; `None` where something needed is missing or wrong, which is reported.
    pub(super) fn joint(&self, node: &Node) -> Option<Joint> {
        let fields = Fields::of(node, self.problems);
        let (part, place) = (self.part(&fields), self.place(&fields));
        fields.finish();
        Some(Joint { part: part?, place: place? })
    }

    /// Reads a `[[line]]`; `None` where something needed is missing or wrong, which is reported.
    pub(super) fn line(&self, node: &Node) -> Option<Line> {
        let fields = Fields::of(node, self.problems);
        let part = self.part(&fields);
        let rope = self.need_words(
            &fields,
            "rope",
            "write the id of a rope, or the key of an attribute in braces: \"{rope}\"",
        );
        let from =
            self.need_words(&fields, "from", "write the id of the body or joint at this end");
        let to = self.need_words(&fields, "to", "write the id of the body or joint at that end");
        let length = self.expression(&fields, "length", 1);
        fields.finish();
        Some(Line { part: part?, rope: rope?, ends: [from?, to?], length: length? })
    }

    /// Reads a `[[link]]`; `None` where something needed is missing or wrong, which is reported.
    pub(super) fn link(&self, node: &Node) -> Option<Link> {
        let fields = Fields::of(node, self.problems);
        let part = self.part(&fields);
        let item = self.need_words(
            &fields,
            "item",
            "write the id of a weak link, or the key of an attribute in braces: \"{weak_link}\"",
        );
        let line = self.need_words(&fields, "line", "write the id of its line");
        let end = fields
            .need_text("end", "write from or to")
            .and_then(|_| fields.word("end", &["from", "to"]));
        fields.finish();
        let end = if end?.value == "from" { LineEnd::A } else { LineEnd::B };
        Some(Link { part: part?, item: item?, line: line?, end })
    }
}

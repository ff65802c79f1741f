//! A text gear type: attributes, and parts with lengths and places that are expressions of them.
//!
//! ```text
//! part k of a row:  i = 1 … repeat;   place = (x, y, depth * (height - 1));   length = expression of attributes, depth and i
//! ```

use endline_sdk::{
    AttributeValue, BodyKind, Descriptor, GearType, HookError, LineEnd, Rig, RigBody, RigEnd,
    RigJoint, RigLine, RigLink, Site,
};

use crate::diagnostic::At;
use crate::entry;
use crate::fields::{Fields, Problems};
use crate::tree::{Content, Node};

use super::attributes;
use super::expression::{Expression, Name, Template, noun};

/// A gear type of a plugin folder.
#[derive(Clone, Debug, PartialEq)]
pub struct TextGear {
    descriptor: Descriptor,
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    lines: Vec<Line>,
    links: Vec<Link>,
}

/// Id and number of the parts of a row.
#[derive(Clone, Debug, PartialEq)]
struct Part {
    id: Template,
    repeat: Expression,
}

#[derive(Clone, Debug, PartialEq)]
struct Place([Expression; 3]);

#[derive(Clone, Debug, PartialEq)]
struct Body {
    part: Part,
    kind: BodyKind,
    item: Template,
    place: Place,
}

#[derive(Clone, Debug, PartialEq)]
struct Joint {
    part: Part,
    place: Place,
}

#[derive(Clone, Debug, PartialEq)]
struct Line {
    part: Part,
    rope: Template,
    ends: [Template; 2],
    length: Expression,
}

#[derive(Clone, Debug, PartialEq)]
struct Link {
    part: Part,
    item: Template,
    line: Template,
    end: LineEnd,
}

impl TextGear {
    /// Reads a file of `gear-types/`; `None` if a required field is missing, which is reported.
    pub(super) fn read(node: &Node, version: &str, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, _) = entry::header(&fields, "gear-type", problems);
        let id = fields
            .need_text("id", "write a reverse-domain id such as \"org.example.gear.two-buoys\"");
        let attributes = fields.each("attribute", attributes::read);
        let own = [("depth", 1), ("i", 0)]
            .map(|(key, power)| Name { key: key.to_owned(), power: Some(power) });
        let names = attributes.iter().map(attributes::name).chain(own).collect();
        let reader = Reader { names, problems };
        let bodies = fields.each("body", |table| reader.body(table));
        let joints = fields.each("joint", |table| reader.joint(table));
        let lines = fields.each("line", |table| reader.line(table));
        let links = fields.each("link", |table| reader.link(table));
        fields.finish();
        if lines.is_empty() && !problems.any_error() {
            fields.missing("line", "write parts under [[body]], [[joint]], [[line]] and [[link]]");
        }
        let descriptor = Descriptor {
            id: id?.value.into(),
            version: version.to_owned().into(),
            name: name.into(),
            help: notes.into(),
            attributes,
            state_len: 0,
            acts: Vec::new(),
        };
        Some(Self { descriptor, bodies, joints, lines, links })
    }
}

/// Reads the fields of parts.
struct Reader<'a> {
    /// Names in expressions.
    names: Vec<Name>,
    /// Collected problems.
    problems: &'a Problems,
}

impl Reader<'_> {
    fn part(&self, fields: &Fields<'_>) -> Option<Part> {
        let id = fields.need_text("id", "write an id such as \"trap\", or \"trap-{i}\" in a row");
        let repeat = if fields.get("repeat").is_some() {
            self.expression(fields, "repeat", 0)
        } else {
            Some(Expression::number(1.0))
        };
        Some(Part { id: self.template(&id?)?, repeat: repeat? })
    }

    fn template(&self, text: &At<String>) -> Option<Template> {
        Template::read(text, &self.names, self.problems)
    }

    fn need_template(
        &self,
        fields: &Fields<'_>,
        key: &'static str,
        help: &str,
    ) -> Option<Template> {
        self.template(&fields.need_text(key, help)?)
    }

    /// A required expression with a power of length.
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
            let help = "lengths have a unit, such as 2 m; pure numbers have none".to_owned();
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
                    "write it along and across the gear, such as position = [\"-10 m\", \"0 m\"]";
                return self
                    .problems
                    .refuse(node.place.error("`position` is not a list of two lengths", help));
            }
        };
        let height = if fields.get("height").is_some() {
            self.expression(fields, "height", 0)
        } else {
            zero()
        };
        Some(Place([x?, y?, height?]))
    }

    /// Reads a `[[body]]`; `None` if a field is missing or wrong, which is reported.
    fn body(&self, fields: &Fields<'_>) -> Option<Body> {
        let part = self.part(fields);
        let kinds =
            [("trap", BodyKind::Trap), ("buoy", BodyKind::Buoy), ("anchor", BodyKind::Anchor)];
        let kind = fields.need_choice("kind", "write trap, buoy or anchor", &kinds);
        let item = self.need_template(
            fields,
            "item",
            "write the id of an item, or the key of an attribute in braces: \"{trap}\"",
        );
        let place = self.place(fields);
        Some(Body { part: part?, kind: kind?, item: item?, place: place? })
    }

    /// Reads a `[[joint]]`; `None` if a field is missing or wrong, which is reported.
    fn joint(&self, fields: &Fields<'_>) -> Option<Joint> {
        let (part, place) = (self.part(fields), self.place(fields));
        Some(Joint { part: part?, place: place? })
    }

    /// Reads a `[[line]]`; `None` if a field is missing or wrong, which is reported.
    fn line(&self, fields: &Fields<'_>) -> Option<Line> {
        let part = self.part(fields);
        let rope = self.need_template(
            fields,
            "rope",
            "write the id of a rope, or the key of an attribute in braces: \"{rope}\"",
        );
        let from = self.need_template(
            fields,
            "from",
            "write the id of the body or joint at the `from` end",
        );
        let to =
            self.need_template(fields, "to", "write the id of the body or joint at the `to` end");
        let length = self.expression(fields, "length", 1);
        Some(Line { part: part?, rope: rope?, ends: [from?, to?], length: length? })
    }

    /// Reads a `[[link]]`; `None` if a field is missing or wrong, which is reported.
    fn link(&self, fields: &Fields<'_>) -> Option<Link> {
        let part = self.part(fields);
        let item = self.need_template(
            fields,
            "item",
            "write the id of a weak link, or the key of an attribute in braces: \"{weak_link}\"",
        );
        let line = self.need_template(fields, "line", "write the id of its line");
        let end = fields.need_end("end", "write from or to");
        Some(Link { part: part?, item: item?, line: line?, end: end? })
    }
}

/// Greatest number of parts of a row.
const MOST_IN_ROW: f64 = 1000.0;

/// Attributes and depth, while a rig is built.
struct Values<'a> {
    attributes: &'a [AttributeValue],
    /// In the order of the names: attributes, depth, index in the row.
    numbers: Vec<f64>,
}

impl Values<'_> {
    fn text(&self, template: &Template) -> String {
        template.text(&self.numbers, self.attributes)
    }

    fn number(&self, expression: &Expression, what: &str, id: &str) -> Result<f64, HookError> {
        let value = expression.value(&self.numbers);
        if value.is_finite() {
            Ok(value)
        } else {
            Err(HookError::new(format!("`{what}` of `{id}` is {value} with these attributes")))
        }
    }

    fn place(&self, place: &Place, id: &str) -> Result<[f64; 3], HookError> {
        let [x, y, height] = &place.0;
        let (x, y, height) = (
            self.number(x, "position", id)?,
            self.number(y, "position", id)?,
            self.number(height, "height", id)?,
        );
        let depth_m = self.numbers[self.numbers.len() - 2];
        Ok([x, y, depth_m * (height - 1.0)])
    }

    /// Calls a function for each part of a row, with its id.
    fn row(
        &mut self,
        part: &Part,
        mut add: impl FnMut(&Self, String) -> Result<(), HookError>,
    ) -> Result<(), HookError> {
        let last = self.numbers.len() - 1;
        self.numbers[last] = 1.0;
        let count = self.number(&part.repeat, "repeat", &self.text(&part.id))?.floor();
        if count > MOST_IN_ROW {
            return Err(HookError::new(format!(
                "`repeat` of `{}` is {count}, more than {MOST_IN_ROW}",
                self.text(&part.id)
            )));
        }
        while self.numbers[last] <= count {
            add(self, self.text(&part.id))?;
            self.numbers[last] += 1.0;
        }
        Ok(())
    }
}

impl GearType for TextGear {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let mut numbers: Vec<f64> =
            attributes.iter().map(|value| value.number().unwrap_or(f64::NAN)).collect();
        numbers.extend([site.depth_m, 1.0]);
        let (mut values, mut rig) = (Values { attributes, numbers }, Rig::default());
        self.add_places(&mut values, &mut rig)?;
        self.add_lines(&mut values, &mut rig)?;
        self.add_links(&mut values, &mut rig)?;
        Ok(rig)
    }
}

impl TextGear {
    fn add_places(&self, values: &mut Values<'_>, rig: &mut Rig) -> Result<(), HookError> {
        for Body { part, kind, item, place } in &self.bodies {
            values.row(part, |values, id| {
                let position_m = values.place(place, &id)?;
                rig.bodies.push(RigBody { id, kind: *kind, item: values.text(item), position_m });
                Ok(())
            })?;
        }
        for Joint { part, place } in &self.joints {
            values.row(part, |values, id| {
                let position_m = values.place(place, &id)?;
                rig.joints.push(RigJoint { id, position_m });
                Ok(())
            })?;
        }
        Ok(())
    }

    fn add_lines(&self, values: &mut Values<'_>, rig: &mut Rig) -> Result<(), HookError> {
        let joints: Vec<String> = rig.joints.iter().map(|joint| joint.id.clone()).collect();
        let end =
            |id: String| if joints.contains(&id) { RigEnd::Joint(id) } else { RigEnd::Body(id) };
        for Line { part, rope, ends, length } in &self.lines {
            values.row(part, |values, id| {
                let [from, to] = [&ends[0], &ends[1]].map(|template| end(values.text(template)));
                let length_m = values.number(length, "length", &id)?;
                let (rope, laid_m) = (values.text(rope), Vec::new());
                rig.lines.push(RigLine { id, rope, from, to, length_m, laid_m });
                Ok(())
            })?;
        }
        Ok(())
    }

    fn add_links(&self, values: &mut Values<'_>, rig: &mut Rig) -> Result<(), HookError> {
        for Link { part, item, line, end } in &self.links {
            values.row(part, |values, id| {
                let item = values.text(item);
                // An empty attribute omits the weak link.
                if !item.is_empty() {
                    rig.links.push(RigLink { id, item, line: values.text(line), end: *end });
                }
                Ok(())
            })?;
        }
        Ok(())
    }
}

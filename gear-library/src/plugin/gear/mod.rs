//! A gear type without code: attributes, and parts whose lengths and places are expressions of them.
//!
//! ```text
//! part k of a row:  i = 1 … repeat;   place = (x, y, depth * (height - 1));   length = expression of attributes, depth and i
//! ```

mod build;
mod read;

use endline_sdk::{BodyKind, Descriptor, LineEnd};

use super::attributes;
use super::expression::{Expression, Name};
use super::words::Words;
use crate::entry;
use crate::fields::{Fields, Problems};
use crate::tree::Node;
use read::Reader;

/// A gear type of a plugin folder.
#[derive(Clone, Debug, PartialEq)]
pub struct TextGear {
    descriptor: Descriptor,
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    lines: Vec<Line>,
    links: Vec<Link>,
}

/// What every part has: a name, and how many there are in a row.
#[derive(Clone, Debug, PartialEq)]
struct Part {
    id: Words,
    repeat: Expression,
}

#[derive(Clone, Debug, PartialEq)]
struct Place([Expression; 3]);

#[derive(Clone, Debug, PartialEq)]
struct Body {
    part: Part,
    kind: BodyKind,
    item: Words,
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
    rope: Words,
    ends: [Words; 2],
    length: Expression,
}

#[derive(Clone, Debug, PartialEq)]
struct Link {
    part: Part,
    item: Words,
    line: Words,
    end: LineEnd,
}

impl TextGear {
    /// Reads a file of `gear-types/`; `None` where something needed is missing, which is reported.
    pub(super) fn read(node: &Node, version: &str, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, _) = entry::header(&fields, "gear-type", problems);
        let id = fields
            .need_text("id", "write a reverse-domain id such as \"org.example.gear.two-buoys\"");
        let attributes: Vec<_> = fields
            .tables("attribute")
            .iter()
            .filter_map(|node| attributes::read(node, problems))
            .collect();
        let own = [("depth", 1), ("i", 0)]
            .map(|(key, power)| Name { key: key.to_owned(), power: Some(power) });
        let names = attributes.iter().map(attributes::name).chain(own).collect();
        let reader = Reader { names, problems };
        let each = |key: &'static str| fields.tables(key).iter();
        let bodies = each("body").filter_map(|node| reader.body(node)).collect();
        let joints = each("joint").filter_map(|node| reader.joint(node)).collect();
        let lines: Vec<_> = each("line").filter_map(|node| reader.line(node)).collect();
        let links = each("link").filter_map(|node| reader.link(node)).collect();
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

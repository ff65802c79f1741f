//! Assemblies: gear that a gear type builds from attributes, or that consists of parts; attributes as written.

use endline_sdk::LineEnd;

use crate::diagnostic::{At, Place};
use crate::entry::{self, Entry};
use crate::fields::{Fields, Problems, Range};
use crate::line::{LineMake, line_choices};
use crate::schema::Kind;
use crate::tree::Node;
use crate::units::Quantity;

/// An assembly of the library.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// Its file.
    pub entry: Entry,
    /// Its gear type or parts.
    pub make: Make,
}

/// The content of an assembly.
#[derive(Clone, Debug, PartialEq)]
pub enum Make {
    /// A gear type builds it from attributes.
    GearType {
        /// Id of the plugin.
        id: At<String>,
        /// Its attributes.
        attributes: Attributes,
        /// Makes of its lines, by id.
        lines: Vec<(At<String>, LineMake)>,
    },
    /// Its parts.
    Parts(Parts),
}

/// Parts of an assembly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// Traps, buoys, anchors.
    pub bodies: Vec<PartBody>,
    /// Splices.
    pub joints: Vec<PartJoint>,
    /// Lines.
    pub lines: Vec<PartLine>,
    /// Weak links.
    pub links: Vec<PartLink>,
}

/// Initial place of a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Along and across the assembly [m].
    pub xy_m: [f64; 2],
    /// Height as a share of depth: 0 on the seabed, 1 at the surface.
    pub height: f64,
}

/// A trap, buoy or anchor.
#[derive(Clone, Debug, PartialEq)]
pub struct PartBody {
    /// Id.
    pub id: At<String>,
    /// Kind: trap, buoy or anchor.
    pub kind: Kind,
    /// Id of the library item.
    pub item: At<String>,
    /// Its initial place.
    pub start: Start,
}

/// A splice.
#[derive(Clone, Debug, PartialEq)]
pub struct PartJoint {
    /// Id.
    pub id: At<String>,
    /// Its initial place.
    pub start: Start,
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct PartLine {
    /// Id.
    pub id: At<String>,
    /// Id of the rope.
    pub rope: At<String>,
    /// Id of the part at end A.
    pub from: At<String>,
    /// Id of the part at end B.
    pub to: At<String>,
    /// Unstretched length [m].
    pub length_m: f64,
    /// Its make.
    pub make: LineMake,
}

/// A weak link.
#[derive(Clone, Debug, PartialEq)]
pub struct PartLink {
    /// Id.
    pub id: At<String>,
    /// Id of the library item; a scenario may rate one in place instead.
    pub item: Option<At<String>>,
    /// Rating written in place [N].
    pub rating_n: Option<f64>,
    /// Id of its line.
    pub line: At<String>,
    /// At which end.
    pub end: LineEnd,
}

impl Assembly {
    /// Reads an assembly's file; `None` if a required field is missing, which is reported.
    pub(crate) fn read(node: &Node, id: &str, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let head = entry::header(&fields, Kind::Assembly.word(), problems);
        let entry = entry::body(&fields, Kind::Assembly, head, id);
        let make = match fields.text("gear_type") {
            Some(id) => Make::GearType {
                id,
                attributes: Attributes::read(&fields, "attributes"),
                lines: line_choices(&fields),
            },
            None => Make::Parts(Parts::read(&fields)),
        };
        if matches!(&make, Make::Parts(parts) if parts.lines.is_empty() && parts.bodies.is_empty())
        {
            fields.missing(
                "gear_type",
                "name a gear type, or write parts under [[body]], [[joint]], [[line]] and [[link]]",
            );
        }
        fields.finish();
        Some(Self { entry, make })
    }
}

impl Parts {
    fn read(fields: &Fields<'_>) -> Self {
        Self {
            bodies: fields.each("body", body),
            joints: fields.each("joint", joint),
            lines: fields.each("line", line),
            links: fields.each("link", |table| link(table, false)),
        }
    }
}

fn body(fields: &Fields<'_>) -> Option<PartBody> {
    let id = fields.need_id("id", "write an id such as \"trap-1\"");
    let kinds = [("trap", Kind::Trap), ("buoy", Kind::Buoy), ("anchor", Kind::Anchor)];
    let kind = fields.need_choice("kind", "write trap, buoy or anchor", &kinds);
    let item =
        fields.need_text("item", "write the id of a library item, such as \"wire-lobster-3ft\"");
    let start = start(fields);
    Some(PartBody { id: id?, kind: kind?, item: item?, start })
}

fn joint(fields: &Fields<'_>) -> Option<PartJoint> {
    let id = fields.need_id("id", "write an id such as \"splice\"");
    let start = start(fields);
    Some(PartJoint { id: id?, start })
}

/// `position` along and across the assembly, `height` as a share of depth.
fn start(fields: &Fields<'_>) -> Start {
    let xy = fields
        .values("position", Quantity::Length, &[2])
        .map_or([0.0; 2], |xy| [xy.value[0], xy.value[1]]);
    let height = fields
        .value("height", Quantity::Ratio, Range::Between(0.0, 1.0))
        .map_or(0.0, |height| height.value);
    Start { xy_m: xy, height }
}

/// Reads a `[[line]]`.
pub(crate) fn line(fields: &Fields<'_>) -> Option<PartLine> {
    let id = fields.need_id("id", "write an id such as \"groundline-1\"");
    let rope = fields.need_text("rope", "write the id of a rope, such as \"pp-3-8\"");
    let from = fields.need_text("from", "write the id of the body or joint at the `from` end");
    let to = fields.need_text("to", "write the id of the body or joint at the `to` end");
    let length = fields.need_value("length", Quantity::Length, Range::Between(0.01, 20_000.0));
    let make = LineMake::read(fields);
    if let (Some(from), Some(to)) = (&from, &to)
        && from.value == to.value
    {
        fields.problems().push(
            to.place.error(format!("both ends are at `{}`", to.value), "a line connects two parts"),
        );
    }
    Some(PartLine { id: id?, rope: rope?, from: from?, to: to?, length_m: length?.value, make })
}

/// Reads a `[[link]]`; with `in_place` it may have a rating instead of an item.
pub(crate) fn link(fields: &Fields<'_>, in_place: bool) -> Option<PartLink> {
    let id = fields.need_id("id", "write an id such as \"buoy-link\"");
    let rating =
        if in_place { fields.value("rating", Quantity::Force, Range::Positive) } else { None };
    let item = if rating.is_some() {
        fields.text("item")
    } else {
        fields.need_text("item", "write the id of a weak link, such as \"wl-600\"")
    };
    let line = fields.need_text("line", "write the id of its line");
    let end = fields.need_end("end", "write from or to")?;
    if item.is_none() && rating.is_none() {
        return None;
    }
    Some(PartLink { id: id?, item, rating_n: rating.map(|rating| rating.value), line: line?, end })
}

/// Attributes as written: key, place of the key, value; checked once the plugin is known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes(pub(crate) Vec<(String, Place, Node)>);

impl Attributes {
    /// The entries of a table, if present.
    pub(crate) fn read<'a>(fields: &Fields<'a>, key: &'a str) -> Self {
        fields
            .table(key)
            .map(|table| Self(table.rest().into_iter().cloned().collect()))
            .unwrap_or_default()
    }

    /// These attributes, which override others.
    pub(crate) fn over(&self, other: &Self) -> Self {
        let others =
            other.0.iter().filter(|(key, _, _)| !self.0.iter().any(|(own, _, _)| own == key));
        Self(others.chain(&self.0).cloned().collect())
    }
}

//! Gear on the seabed: a groundline with traps on gangions or in the line itself, and an optional anchor at each end.
//!
//! ```text
//!              trap-2                              trap-n
//!                |  gangion-2                        |
//!  anchor-line   |          groundline-1             |                     anchor-line
//! anchor --- knot-1 ----------------------- knot-2 ... knot-n --- far-anchor        x <--
//!                             |  gangion-1 (alternate sides)
//!                           trap-1
//! ```
//!
//! Spans are lengths of rope; the groundline covers `span / (1 + slack)`, as when it is set under way. Traps lie beside it within
//! reach of their gangions. Spacing: inshore 10 to 15 fathoms, nearshore 15 to 20, offshore 25 to 50;
//! gangions of 1 to 2 fathoms.

use endline_sdk::{Attribute, BodyKind, HookError, RigEnd, Site};

use super::{FAR, Lay, Values, depth_of};

/// Lateral distance of a trap from the groundline, as a share of its gangion.
const BESIDE: f64 = 0.65;

/// Side of the groundline on which the traps lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Alternate,
    Left,
    Right,
}

/// A set on the seabed.
#[derive(Clone, Debug)]
pub struct Ground<'a> {
    traps: u32,
    trap: &'a str,
    spacing_m: f64,
    groundline: &'a str,
    slack: f64,
    gangion_m: f64,
    gangion_rope: &'a str,
    side: Side,
    bridle_m: f64,
    anchor: &'a str,
    anchor_line_m: f64,
}

/// The foot of an endline.
#[derive(Clone, Debug)]
pub struct Foot {
    /// Part at which its rope ends.
    pub end: RigEnd,
    /// Initial place [m].
    pub at_m: [f64; 3],
    /// The nearest trap or anchor.
    pub body: RigEnd,
    /// Initial place of that trap or anchor [m].
    pub body_at_m: [f64; 3],
}

impl<'a> Ground<'a> {
    /// The attributes of a set, with defaults of the number of traps and the length of gangions [m].
    #[must_use]
    pub fn attributes(traps: u32, gangion_m: f64) -> Vec<Attribute> {
        let mut all = vec![Attribute::count("traps", [1, 100], traps, "Number of traps.")];
        all.extend(Self::attributes_but_count());
        all.extend([
            Attribute::number(
                "gangion",
                "m",
                [0.0, 20.0],
                gangion_m,
                "Length of each gangion; 0 puts the traps in the groundline itself.",
            ),
            Attribute::item(
                "gangion_rope",
                "ropes",
                "sink-5-16",
                "Rope of the gangions and bridles.",
            ),
            Attribute::choice(
                "side",
                &["alternate", "left", "right"],
                "Side of the groundline on which the traps lie, seen from the near end.",
            ),
            Attribute::number(
                "bridle",
                "m",
                [0.0, 5.0],
                0.0,
                "Length of each leg of the two-leg bridle on every trap; 0 for none.",
            ),
            Attribute::item(
                "anchor",
                "anchors",
                "",
                "Anchor at each end, under the endline; empty for none.",
            ),
            Attribute::number(
                "anchor_line",
                "m",
                [1.0, 500.0],
                36.6,
                "Groundline from each anchor to the first trap, if there are anchors.",
            ),
        ]);
        all
    }

    /// Trap, spacing, groundline and its slack.
    #[must_use]
    pub fn attributes_but_count() -> Vec<Attribute> {
        vec![
            Attribute::item("trap", "traps", "wire-lobster-3ft", "Each trap."),
            Attribute::number(
                "spacing",
                "m",
                [1.0, 500.0],
                21.95,
                "Groundline from trap to trap; 12 fathoms by default.",
            ),
            Attribute::item("groundline", "ropes", "sink-3-8", "Rope of the groundline."),
            Attribute::number(
                "slack",
                "1",
                [0.0, 0.5],
                0.03,
                "Excess length of the groundline over the distance that it spans, as a share.",
            ),
        ]
    }

    /// The set of the attribute values.
    ///
    /// # Errors
    /// Naming the attribute to fix.
    pub fn read(values: &Values<'a>) -> Result<Self, HookError> {
        let ground = Self {
            traps: values.count("traps")?,
            gangion_m: values.number("gangion")?,
            gangion_rope: values.item("gangion_rope")?,
            side: match values.word("side")? {
                "left" => Side::Left,
                "right" => Side::Right,
                _ => Side::Alternate,
            },
            bridle_m: values.number("bridle")?,
            anchor: values.item("anchor")?,
            anchor_line_m: values.number("anchor_line")?,
            ..Self::in_line(values, 1)?
        };
        if ground.gangion_m + ground.bridle_m > 0.0 && ground.gangion_rope.is_empty() {
            let message = "attribute `gangion_rope`: name a rope for gangions and bridles, or set \
             `gangion` and `bridle` to 0";
            return Err(HookError::new(message));
        }
        if ground.gangion_m > 0.5 * ground.spacing_m {
            let (gangion, spacing) = (ground.gangion_m, ground.spacing_m);
            return Err(HookError::new(format!(
                "attribute `gangion`: {gangion} m is more than half the spacing of {spacing} m; \
                 shorten it, or raise `spacing`"
            )));
        }
        Ok(ground)
    }

    /// A number of traps in the groundline itself, without anchors.
    ///
    /// # Errors
    /// Naming the attribute to fix.
    pub fn in_line(values: &Values<'a>, traps: u32) -> Result<Self, HookError> {
        Ok(Self {
            traps,
            trap: values.needed("trap")?,
            spacing_m: values.number("spacing")?,
            groundline: values.needed("groundline")?,
            slack: values.number("slack")?,
            gangion_m: 0.0,
            gangion_rope: "",
            side: Side::Alternate,
            bridle_m: 0.0,
            anchor: "",
            anchor_line_m: 0.0,
        })
    }

    /// Number of traps.
    #[must_use]
    pub fn traps(&self) -> u32 {
        self.traps
    }

    /// Number of lines.
    #[must_use]
    pub fn line_count(&self) -> usize {
        let each = u32::from(self.gangion_m > 0.0) + if self.bridle_m > 0.0 { 2 } else { 0 };
        let anchors = if self.anchor.is_empty() { 0 } else { 2 };
        (self.traps - 1 + each * self.traps + anchors) as usize
    }

    /// Adds the set on the seabed; returns its feet, near and far.
    ///
    /// # Errors
    /// Where there is no water.
    pub fn lay(&self, into: &mut Lay, site: &Site) -> Result<[Foot; 2], HookError> {
        let bed_m = -depth_of(site)?;
        let (span, first) = (self.spacing_m / (1.0 + self.slack), self.anchor_chord_m());
        let mut feet: Vec<Foot> = Vec::new();
        for index in 0..self.traps {
            let at = [-first - f64::from(index) * span, 0.0, bed_m];
            let foot = self.lay_trap(into, index, at);
            if let Some(before) = feet.last() {
                let ends = [before.end.clone(), foot.end.clone()];
                into.line(&format!("groundline-{index}"), self.groundline, ends, self.spacing_m);
            }
            feet.push(foot);
        }
        let (near, far) = match (feet.first(), feet.last()) {
            (Some(near), Some(far)) => (near.clone(), far.clone()),
            _ => return Err(HookError::new("attribute `traps`: a set has at least one trap")),
        };
        if self.anchor.is_empty() {
            return Ok([near, far]);
        }
        Ok([self.lay_anchor(into, "", &near, first), self.lay_anchor(into, FAR, &far, -first)])
    }

    fn anchor_chord_m(&self) -> f64 {
        if self.anchor.is_empty() { 0.0 } else { self.anchor_line_m / (1.0 + self.slack) }
    }

    /// Adds a trap in the line at a place, or beside it on a gangion.
    fn lay_trap(&self, into: &mut Lay, index: u32, at_m: [f64; 3]) -> Foot {
        let number = index + 1;
        let id = format!("trap-{number}");
        let left = match self.side {
            Side::Alternate => index.is_multiple_of(2),
            Side::Left => true,
            Side::Right => false,
        };
        // Seen from the near end, along -x, left is -y.
        let aside = if left { -BESIDE } else { BESIDE } * self.gangion_m;
        let body_at_m = [at_m[0], at_m[1] + aside, at_m[2]];
        let body = into.body(&id, BodyKind::Trap, self.trap, body_at_m);
        let hung = if self.bridle_m > 0.0 {
            self.lay_bridle(into, number, &id, body_at_m)
        } else {
            body.clone()
        };
        if self.gangion_m == 0.0 {
            return Foot { end: hung, at_m, body, body_at_m };
        }
        let knot = into.joint(&format!("knot-{number}"), at_m);
        into.line(
            &format!("gangion-{number}"),
            self.gangion_rope,
            [knot.clone(), hung],
            self.gangion_m,
        );
        Foot { end: knot, at_m, body, body_at_m }
    }

    /// Adds two legs from the corners of a trap's top edge to a splice; returns the splice.
    fn lay_bridle(&self, into: &mut Lay, number: u32, trap: &str, [x, y, bed]: [f64; 3]) -> RigEnd {
        let splice = into.joint(&format!("bridle-{number}"), [x + self.bridle_m, y, bed]);
        for side in ["port", "starboard"] {
            let corner = RigEnd::Body(format!("{trap}:bridle-{side}"));
            into.line(
                &format!("bridle-{side}-{number}"),
                self.gangion_rope,
                [corner, splice.clone()],
                self.bridle_m,
            );
        }
        splice
    }

    /// Adds an anchor beyond a foot, at which the endline then ends.
    fn lay_anchor(&self, into: &mut Lay, prefix: &str, from: &Foot, along_x_m: f64) -> Foot {
        let at_m = [from.at_m[0] + along_x_m, from.at_m[1], from.at_m[2]];
        let anchor = into.body(&format!("{prefix}anchor"), BodyKind::Anchor, self.anchor, at_m);
        let ends = [anchor.clone(), from.end.clone()];
        into.line(&format!("{prefix}anchor-line"), self.groundline, ends, self.anchor_line_m);
        Foot { end: anchor.clone(), at_m, body: anchor, body_at_m: at_m }
    }
}

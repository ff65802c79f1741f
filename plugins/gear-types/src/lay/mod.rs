//! Common parts of gear types: attribute values, construction of rigs, and the two halves of fixed gear.
//!
//! | module | |
//! |---|---|
//! | [`Values`] | attribute values by key, with errors that name the attribute |
//! | [`Lay`] | construction of a rig |
//! | [`ground`] | gear on the seabed: groundline, gangions, traps, anchors |
//! | [`endline`] | gear above it: two ropes, surface system, buoy, high-flyer |
//!
//! Frame: origin on the mean sea surface above the foot of the near endline, x along the gear, which extends to negative x,
//! z up. All places are initial guesses for statics.

pub mod endline;
pub mod ground;

use endline_sdk::{
    Attribute, AttributeValue, BodyKind, HookError, LineEnd, Rig, RigBody, RigEnd, RigJoint,
    RigLine, RigLink, Site,
};

pub use endline::Endline;
pub use ground::{Foot, Ground};

/// Prefix of the ids of endline, buoy and anchor at the far end.
pub const FAR: &str = "far-";

/// The checked depth of the site [m].
///
/// # Errors
/// If the depth is not positive.
pub fn depth_of(site: &Site) -> Result<f64, HookError> {
    if site.depth_m > 0.0 && site.depth_m.is_finite() {
        return Ok(site.depth_m);
    }
    Err(HookError::new(format!(
        "the site's depth is {} m; fixed gear needs a positive depth",
        site.depth_m
    )))
}

/// Unit direction of the current; x without current.
#[must_use]
pub fn downstream([east, north]: [f64; 2]) -> [f64; 2] {
    let speed = (east * east + north * north).sqrt();
    if speed > 0.0 { [east / speed, north / speed] } else { [1.0, 0.0] }
}

/// The values of a call with their declarations.
#[derive(Clone, Copy)]
pub struct Values<'a> {
    declared: &'a [Attribute],
    given: &'a [AttributeValue],
}

impl<'a> Values<'a> {
    /// Values in the declared order.
    #[must_use]
    pub fn new(declared: &'a [Attribute], given: &'a [AttributeValue]) -> Self {
        Self { declared, given }
    }

    fn find(&self, key: &str) -> Option<&'a AttributeValue> {
        self.given.get(self.declared.iter().position(|attribute| attribute.key == key)?)
    }

    /// A number in the attribute's SI unit.
    ///
    /// # Errors
    /// If the value is not a number.
    pub fn number(&self, key: &str) -> Result<f64, HookError> {
        let value = self.find(key).and_then(AttributeValue::number);
        value.ok_or_else(|| HookError::new(format!("attribute `{key}`: expected a number")))
    }

    /// A whole number.
    ///
    /// # Errors
    /// If the value has another kind.
    pub fn count(&self, key: &str) -> Result<u32, HookError> {
        let value = self.number(key)?;
        if value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value) {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "checked above"
            )]
            return Ok(value as u32);
        }
        Err(HookError::new(format!("attribute `{key}`: expected a whole number, got {value}")))
    }

    /// A word.
    ///
    /// # Errors
    /// If the value has another kind.
    pub fn word(&self, key: &str) -> Result<&'a str, HookError> {
        let value = self.find(key).and_then(AttributeValue::choice);
        value.ok_or_else(|| HookError::new(format!("attribute `{key}`: expected one of its words")))
    }

    /// The id of a library item; empty for none.
    ///
    /// # Errors
    /// If the value is not an id.
    pub fn item(&self, key: &str) -> Result<&'a str, HookError> {
        let value = self.find(key).and_then(AttributeValue::item);
        value.ok_or_else(|| {
            HookError::new(format!("attribute `{key}`: expected the id of a library item"))
        })
    }

    /// The id of a required library item.
    ///
    /// # Errors
    /// If it is empty or not an id.
    pub fn needed(&self, key: &str) -> Result<&'a str, HookError> {
        let id = self.item(key)?;
        if id.is_empty() {
            Err(HookError::new(format!("attribute `{key}`: name an item of the library")))
        } else {
            Ok(id)
        }
    }
}

/// A rig under construction.
#[derive(Clone, Debug, Default)]
pub struct Lay {
    /// The parts so far.
    pub rig: Rig,
}

impl Lay {
    /// Adds a trap, buoy or anchor with its initial place [m].
    pub fn body(&mut self, id: &str, kind: BodyKind, item: &str, position_m: [f64; 3]) -> RigEnd {
        self.rig.bodies.push(RigBody { id: id.into(), kind, item: item.into(), position_m });
        RigEnd::Body(id.into())
    }

    /// Adds a splice with its initial place [m].
    pub fn joint(&mut self, id: &str, position_m: [f64; 3]) -> RigEnd {
        self.rig.joints.push(RigJoint { id: id.into(), position_m });
        RigEnd::Joint(id.into())
    }

    /// Adds a straight line.
    pub fn line(&mut self, id: &str, rope: &str, ends: [RigEnd; 2], length_m: f64) {
        self.line_along(id, rope, ends, length_m, Vec::new());
    }

    /// Adds a line along an initial path [m].
    pub fn line_along(
        &mut self,
        id: &str,
        rope: &str,
        [from, to]: [RigEnd; 2],
        length_m: f64,
        laid_m: Vec<[f64; 3]>,
    ) {
        self.rig.lines.push(RigLine {
            id: id.into(),
            rope: rope.into(),
            from,
            to,
            length_m,
            laid_m,
        });
    }

    /// Adds a weak link or release, unless the item is empty.
    pub fn link(&mut self, id: &str, item: &str, line: &str, end: LineEnd) {
        if !item.is_empty() {
            self.rig.links.push(RigLink {
                id: id.into(),
                item: item.into(),
                line: line.into(),
                end,
            });
        }
    }
}

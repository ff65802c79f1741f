//! The pair: two traps at the ends of one groundline, with one endline from the first of them.

use endline_sdk::{AttributeValue, Descriptor, GearType, HookError, Rig, Site};

use crate::lay::{Endline, Ground, Lay, Values};

/// The gear type of two traps.
#[derive(Clone, Debug)]
pub struct Pair {
    descriptor: Descriptor,
}

impl Pair {
    /// The gear type with its descriptor.
    #[must_use]
    pub fn new() -> Self {
        Self { descriptor: descriptor() }
    }
}

impl Default for Pair {
    fn default() -> Self {
        Self::new()
    }
}

impl GearType for Pair {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let values = Values::new(&self.descriptor.attributes, attributes);
        let (ground, endline) = (Ground::in_line(&values, 2)?, Endline::read(&values)?);
        let mut rig = Lay::default();
        let [near, _] = ground.lay(&mut rig, site)?;
        endline.lay(&mut rig, &near, site, "")?;
        Ok(rig.rig)
    }
}

fn descriptor() -> Descriptor {
    let mut attributes = Ground::attributes_but_count();
    attributes.extend(Endline::attributes("bullet-7x16"));
    Descriptor {
        id: "org.endline.gear.pair".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        name: "Pair".into(),
        help: "Two traps at the ends of one groundline, with one endline and buoy.".into(),
        attributes,
        state_len: 0,
        acts: Vec::new(),
    }
}

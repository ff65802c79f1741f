//! The single: one trap on the seabed with an endline and a buoy.

use endline_sdk::{
    Attribute, AttributeValue, BodyKind, Descriptor, GearType, HookError, Rig, Site,
};

use crate::lay::{Endline, Foot, Lay, Values, depth_of};

/// The single-trap gear type.
#[derive(Clone, Debug)]
pub struct Single {
    descriptor: Descriptor,
}

impl Single {
    /// The gear type with its descriptor.
    #[must_use]
    pub fn new() -> Self {
        Self { descriptor: descriptor() }
    }
}

impl Default for Single {
    fn default() -> Self {
        Self::new()
    }
}

impl GearType for Single {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let values = Values::new(&self.descriptor.attributes, attributes);
        let (trap, endline) = (values.needed("trap")?, Endline::read(&values)?);
        let (mut rig, at_m) = (Lay::default(), [0.0, 0.0, -depth_of(site)?]);
        let body = rig.body("trap", BodyKind::Trap, trap, at_m);
        let foot = Foot { end: body.clone(), at_m, body, body_at_m: at_m };
        endline.lay(&mut rig, &foot, site, "")?;
        Ok(rig.rig)
    }
}

fn descriptor() -> Descriptor {
    let mut attributes = vec![Attribute::item("trap", "traps", "wire-lobster-3ft", "The trap.")];
    attributes.extend(Endline::attributes("bullet-6x14"));
    Descriptor {
        id: "org.endline.gear.single".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        name: "Single".into(),
        help: "One trap, one buoy, and an endline of floating rope below and sinking rope above."
            .into(),
        attributes,
        state_len: 0,
        acts: Vec::new(),
    }
}

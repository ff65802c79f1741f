//! The single: one trap on the seabed with an endline and a buoy.

use endline_sdk::{Attribute, BodyKind, Descriptor, HookError, Rig, Site};

use crate::lay::{Endline, Foot, Lay, Values, depth_of};
use crate::{Laid, Layout};

/// The single-trap gear type.
pub type Single = Laid<OneTrap>;

/// Layout of [`Single`].
#[derive(Clone, Debug)]
pub struct OneTrap;

impl Layout for OneTrap {
    fn descriptor() -> Descriptor {
        let mut attributes =
            vec![Attribute::item("trap", "traps", "wire-lobster-3ft", "The trap.")];
        attributes.extend(Endline::attributes("bullet-6x14"));
        let help =
            "One trap, one buoy, and an endline of floating rope below and sinking rope above.";
        Descriptor::new("org.endline.gear.single", "Single", help).with_attributes(attributes)
    }

    fn build(values: &Values<'_>, site: &Site) -> Result<Rig, HookError> {
        let (trap, endline) = (values.needed("trap")?, Endline::read(values)?);
        let (mut rig, at_m) = (Lay::default(), [0.0, 0.0, -depth_of(site)?]);
        let body = rig.body("trap", BodyKind::Trap, trap, at_m);
        let foot = Foot { end: body.clone(), at_m, body, body_at_m: at_m };
        endline.lay(&mut rig, &foot, site, "")?;
        Ok(rig.rig)
    }
}

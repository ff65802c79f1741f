//! The pair: two traps at the ends of one groundline, with one endline from the first of them.

use endline_sdk::{Descriptor, HookError, Rig, Site};

use crate::lay::{Endline, Ground, Lay, Values};
use crate::{Laid, Layout};

/// The gear type of two traps.
pub type Pair = Laid<TwoTraps>;

/// Layout of [`Pair`].
#[derive(Clone, Debug)]
pub struct TwoTraps;

impl Layout for TwoTraps {
    fn descriptor() -> Descriptor {
        let mut attributes = Ground::attributes_but_count();
        attributes.extend(Endline::attributes("bullet-7x16"));
        let help = "Two traps at the ends of one groundline, with one endline and buoy.";
        Descriptor::new("org.endline.gear.pair", "Pair", help).with_attributes(attributes)
    }

    fn build(values: &Values<'_>, site: &Site) -> Result<Rig, HookError> {
        let (ground, endline) = (Ground::in_line(values, 2)?, Endline::read(values)?);
        let mut rig = Lay::default();
        let [near, _] = ground.lay(&mut rig, site)?;
        endline.lay(&mut rig, &near, site, "")?;
        Ok(rig.rig)
    }
}

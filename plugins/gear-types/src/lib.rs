//! The gear types of Endline, which build gear from a few attributes.
//!
//! | id | gear |
//! |---|---|
//! | `org.endline.gear.single` | [`Single`]: one trap, one buoy, an endline of two ropes |
//! | `org.endline.gear.pair` | [`Pair`]: two traps on one groundline, one endline |
//! | `org.endline.gear.trawl` | [`Trawl`]: traps on gangions along a groundline, one endline or two |
//! | `org.endline.gear.gillnet` | [`Gillnet`]: a string of gillnet panels between anchors |
//! | `org.endline.gear.on-demand` | [`OnDemand`]: an endline stowed at the trap until an acoustic release opens |
//! | `org.endline.gear.time-tension-cutter` | [`TimeTensionCutter`]: traps with a cutter in each endline |
//!
//! Each is a [`Layout`]; common parts are in [`lay`].

pub mod cutter;
pub mod gillnet;
pub mod lay;
pub mod on_demand;
pub mod pair;
pub mod single;
pub mod trawl;

use std::marker::PhantomData;
use std::sync::Arc;

use endline_sdk::{
    AttributeValue, Descriptor, GearAction, GearStep, GearType, HookError, Rig, Site,
};

use lay::Values;

pub use cutter::TimeTensionCutter;
pub use gillnet::Gillnet;
pub use on_demand::OnDemand;
pub use pair::Pair;
pub use single::Single;
pub use trawl::Trawl;

/// How gear of a type is built from attribute values, and how it acts.
pub trait Layout: Send + Sync {
    /// Descriptor of the gear type, without version.
    fn descriptor() -> Descriptor;

    /// Parts and connections.
    ///
    /// # Errors
    /// With a message that names the attribute to fix.
    fn build(values: &Values<'_>, site: &Site) -> Result<Rig, HookError>;

    /// Actions of a step; none by default.
    ///
    /// # Errors
    /// With a message that names the attribute to fix.
    fn step(
        _values: &Values<'_>,
        _input: &GearStep<'_>,
        _state: &mut [f64],
        _actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        Ok(())
    }
}

/// The gear type of a layout.
#[derive(Clone, Debug)]
pub struct Laid<L> {
    descriptor: Descriptor,
    layout: PhantomData<L>,
}

impl<L: Layout> Laid<L> {
    /// The gear type with its descriptor.
    #[must_use]
    pub fn new() -> Self {
        let version = env!("CARGO_PKG_VERSION").into();
        Self { descriptor: Descriptor { version, ..L::descriptor() }, layout: PhantomData }
    }
}

impl<L: Layout> Default for Laid<L> {
    fn default() -> Self {
        Self::new()
    }
}

impl<L: Layout> GearType for Laid<L> {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        L::build(&Values::new(&self.descriptor.attributes, attributes), site)
    }

    fn step(
        &self,
        attributes: &[AttributeValue],
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        L::step(&Values::new(&self.descriptor.attributes, attributes), input, state, actions)
    }
}

endline_sdk::export_plugin! {
    about: "Endline; the gears and where their figures come from: docs/gear-types.md";
    gear: Single::new(),
    gear: Pair::new(),
    gear: Trawl::new(),
    gear: Gillnet::new(),
    gear: OnDemand::new(),
    gear: TimeTensionCutter::new(),
}

/// Every gear type of this crate, for programs and tests that link it.
#[must_use]
pub fn all() -> Vec<Arc<dyn GearType>> {
    vec![
        Arc::new(Single::new()),
        Arc::new(Pair::new()),
        Arc::new(Trawl::new()),
        Arc::new(Gillnet::new()),
        Arc::new(OnDemand::new()),
        Arc::new(TimeTensionCutter::new()),
    ]
}

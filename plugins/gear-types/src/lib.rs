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
//! Common parts are in [`lay`].

pub mod cutter;
pub mod gillnet;
pub mod lay;
pub mod on_demand;
pub mod pair;
pub mod single;
pub mod trawl;

use std::sync::Arc;

use endline_sdk::GearType;

pub use cutter::TimeTensionCutter;
pub use gillnet::Gillnet;
pub use on_demand::OnDemand;
pub use pair::Pair;
pub use single::Single;
pub use trawl::Trawl;

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

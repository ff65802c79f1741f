//! Endline's own gear types: kinds of gear that build themselves from a few attributes.
//!
//! | id | gear |
//! |---|---|
//! | `org.endline.gear.single` | [`Single`]: one trap, one buoy, an endline of two ropes |

pub mod single;

pub use single::Single;

endline_sdk::export_plugin! { gear: Single::new() }

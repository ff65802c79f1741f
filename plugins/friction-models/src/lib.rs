//! Endline's own friction models: how rope drags over skin, lips and baleen.
//!
//! | id | law |
//! |---|---|
//! | `org.endline.friction.coulomb` | [`Coulomb`]: sticks on a stiff bristle, slips at coefficient times normal force |

pub mod coulomb;

pub use coulomb::Coulomb;

endline_sdk::export_plugin! { friction: Coulomb::new() }

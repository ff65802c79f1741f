//! The friction models of Endline for rope on skin, lips and baleen.
//!
//! | id | law |
//! |---|---|
//! | `org.endline.friction.coulomb` | [`Coulomb`]: sticks on a stiff bristle, slips at coefficient times normal force |
//! | `org.endline.friction.stribeck` | [`Stribeck`]: wet skin; falls from static to kinetic with slip speed, then rises |
//! | `org.endline.friction.tissue` | [`Tissue`]: skin follows the rope over an elastic range, then the rope slips |
//! | `org.endline.friction.baleen` | [`Baleen`]: anisotropic along and across the plates, with wedging between them |

pub mod baleen;
pub mod coulomb;
mod law;
pub mod stribeck;
pub mod tissue;

use std::sync::Arc;

use endline_sdk::FrictionModel;

pub use baleen::Baleen;
pub use coulomb::Coulomb;
pub use stribeck::Stribeck;
pub use tissue::Tissue;

/// Every friction model that ships with Endline.
#[must_use]
pub fn all() -> Vec<Arc<dyn FrictionModel>> {
    vec![
        Arc::new(Coulomb::new()),
        Arc::new(Stribeck::new()),
        Arc::new(Tissue::new()),
        Arc::new(Baleen::new()),
    ]
}

endline_sdk::export_plugin! {
    about: "Endline; the laws and where their figures come from: docs/friction.md";
    friction: Coulomb::new(),
    friction: Stribeck::new(),
    friction: Tissue::new(),
    friction: Baleen::new(),
}

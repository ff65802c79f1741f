//! Library items with their figures by name, ready for assembly.

mod act;
mod box_gear;
mod buoy;
mod channel;
mod friction;
mod growth;
mod joints;
mod knot;
mod mesh;
mod piece;
mod point;
mod rope;
mod site;
mod surface;
mod weak_link;
mod whale;

pub use act::ActItem;
pub use box_gear::BoxGear;
pub use buoy::{Buoy, BuoyShape};
pub use channel::{CHANNELS, Channel};
pub use friction::{ModelFigures, RopeFriction};
pub(crate) use growth::YEAR_S;
pub use growth::{AgeLaw, Growth, MassLaw};
pub use joints::Joints;
pub use knot::Knot;
pub use mesh::WhaleMesh;
pub use piece::BuoyPiece;
pub(crate) use piece::pieces;
pub use point::Point;
pub(crate) use point::points;
pub use rope::{Condition, Rope};
pub use site::SeaSite;
pub(crate) use surface::{any_holds, read as read_surfaces};
pub use weak_link::WeakLink;
pub use whale::WhaleItem;

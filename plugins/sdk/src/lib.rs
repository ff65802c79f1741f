//! Endline's plugin vocabulary: all that a plugin may see.
//!
//! Three hooks, each a trait with plain-data inputs and outputs:
//!
//! | hook | trait | called |
//! |---|---|---|
//! | whale motion | [`WhaleMotion`] | once a step, before contact |
//! | friction model | [`FrictionModel`] | each solver pass, all contacts in one call |
//! | gear type | [`GearType`] | at assembly, then once a step |
//!
//! SI units, radians, z up with z = 0 the mean sea surface, x east, y north;
//! whale frame x to the snout, y to port, z dorsal.
//! A plugin keeps nothing between calls but the floats the engine hands it, so
//! that a run can be recorded, replayed and run many times at once.

pub mod abi;
mod controls;
pub mod friction;
pub mod gear;
pub mod hook;
pub mod motion;
pub mod whale;

pub use friction::{Contacts, FrictionModel, FrictionResponse};
pub use gear::{
    BodyKind, GearAction, GearStep, GearType, LineEnd, Rig, RigBody, RigEnd, RigJoint, RigLine,
    RigLink, Site,
};
pub use hook::{Act, Attribute, AttributeKind, AttributeValue, Descriptor, HookError};
pub use motion::{Controls, MotionInput, MotionOutput, WhaleMotion};
pub use whale::{
    BodyPart, FLUKE_STATION, Limb, Posture, Region, SPINE_JOINTS, SPINE_STATIONS, Side,
};

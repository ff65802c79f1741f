//! Endline's plugin vocabulary: the complete interface of plugins.
//!
//! Three hooks, each a trait with plain-data inputs and outputs:
//!
//! | hook | trait | called |
//! |---|---|---|
//! | whale motion | [`WhaleMotion`] | once per step, before contact |
//! | friction model | [`FrictionModel`] | each solver pass, all contacts in one call |
//! | gear type | [`GearType`] | at assembly, then once per step |
//!
//! SI units, radians, z up with z = 0 the mean sea surface, x east, y north;
//! whale frame x to the snout, y to port, z dorsal.
//! A plugin has no state between calls except the floats of the engine, so
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

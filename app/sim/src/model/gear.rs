//! Gear types: plugins that built part of the rig and are called once a step.

use std::sync::Arc;

use endline_sdk::{AttributeValue, GearType};

/// A gear type at work: what it built, and its attributes for the calls of the run.
#[derive(Clone)]
pub struct GearHook {
    /// The plugin.
    pub gear: Arc<dyn GearType>,
    /// Its attribute values.
    pub attributes: Vec<AttributeValue>,
    /// Its lines in the order built, each by the indices of its first and last piece among the model's lines: a
    /// line with inserts is several of them, end to end.
    pub lines: Vec<[usize; 2]>,
    /// Its links in the order built, as indices of the model's links.
    pub links: Vec<usize>,
}

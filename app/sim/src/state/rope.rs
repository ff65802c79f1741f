//! Rope nodes and segments.

use glam::DVec3;

use super::friction::{FrictionState, RopeGrip, RopeWithin, SolidGrip};
use crate::in_place::clone_in_place;

/// Nodes and segments of all lines, in the model's layout.
#[derive(Debug, PartialEq, Default)]
pub struct RopeState {
    /// Place of each node [m].
    pub position: Vec<DVec3>,
    /// Velocity of each node [m/s].
    pub velocity: Vec<DVec3>,
    /// Unstretched length of each segment [m]; those of a line add up to the line.
    pub segment_length: Vec<f64>,
    /// Tension of each segment; below zero it is slack and pulls nothing [N].
    pub tension: Vec<f64>,
    /// Whether each segment is cut (a parted link or rope): it pulls and touches nothing.
    pub cut: Vec<bool>,
    /// Place of each node one solver step earlier [m].
    pub earlier_position: Vec<DVec3>,
    /// Velocity of each node one solver step earlier [m/s].
    pub earlier_velocity: Vec<DVec3>,
    /// Length of that earlier solver step [s]; zero where there is none.
    pub earlier_dt_s: f64,
    /// Where each node grips the seabed: tangential stretch of the grip [m].
    pub seabed_grip: Vec<DVec3>,
    /// Floats of the friction model where rope touches skin.
    pub friction: FrictionState,
    /// Where rope touches obstacles and bodies.
    pub solid_grips: Vec<SolidGrip>,
    /// Rope that has lain within a body since the start.
    pub within: Vec<RopeWithin>,
    /// Where rope touches rope.
    pub rope_grips: Vec<RopeGrip>,
}

clone_in_place!(RopeState {
    position,
    velocity,
    segment_length,
    tension,
    cut,
    earlier_position,
    earlier_velocity,
    earlier_dt_s,
    seabed_grip,
    friction,
    solid_grips,
    within,
    rope_grips
});

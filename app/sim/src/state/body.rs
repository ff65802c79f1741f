//! Rigid bodies in motion.

use glam::{DQuat, DVec3};

use crate::in_place::clone_in_place;

/// A rigid body in motion.
#[derive(Debug, PartialEq)]
pub struct BodyState {
    /// Place of its origin (centre of mass) [m].
    pub position: DVec3,
    /// Orientation, body to world.
    pub orientation: DQuat,
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Angular velocity in the world frame [rad/s].
    pub spin: DVec3,
    /// Place one solver step earlier [m].
    pub earlier_position: DVec3,
    /// Velocity one solver step earlier [m/s].
    pub earlier_velocity: DVec3,
    /// Orientation one solver step earlier, body to world.
    pub earlier_orientation: DQuat,
    /// Angular velocity in the world frame one solver step earlier [rad/s].
    pub earlier_spin: DVec3,
    /// Tangential stretch of each foot's grip on the seabed [m].
    pub grip: Vec<DVec3>,
    /// Whether each foot slides.
    pub sliding: Vec<bool>,
    /// Greatest lift of each foot off the seabed since it last set there, up to where it is loose [m].
    pub lift_m: Vec<f64>,
}

clone_in_place!(BodyState {
    position,
    orientation,
    velocity,
    spin,
    earlier_position,
    earlier_velocity,
    earlier_orientation,
    earlier_spin,
    grip,
    sliding,
    lift_m
});

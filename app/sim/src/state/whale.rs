//! The whale in motion.

use endline_sdk::Posture;
use glam::{DQuat, DVec3};

use crate::in_place::clone_in_place;
use crate::whale::kinetic::Exertion;

/// The whale in motion. A kinematic one goes where its motion plugin and pilot send it, a kinetic one as its forces do.
#[derive(Debug, PartialEq)]
pub struct WhaleState {
    /// Place of the whale frame's origin, mid-body [m].
    pub position: DVec3,
    /// Orientation, whale to world (x to the snout, y to port, z dorsal).
    pub orientation: DQuat,
    /// Speed through the water along its x axis [m/s].
    pub speed_m_s: f64,
    /// Turn rates about its own axes [rad/s].
    pub turn_rate: DVec3,
    /// Joint angles.
    pub posture: Posture,
    /// Floats of the motion plugin.
    pub motion: Vec<f64>,
    /// Sum of normal contact forces of the last step, by body part [N].
    pub contact_force_n: [f64; endline_sdk::BodyPart::ALL.len()],
    /// Where on each part those forces are: mean place to port of the midplane on the body at rest [m].
    pub contact_port_m: [f64; endline_sdk::BodyPart::ALL.len()],
    /// Moments with which what touched jaw, left and right lip opened them in the last step [N m].
    pub mouth_moment_n_m: [f64; 3],
    /// What it does and bears.
    pub exertion: Exertion,
}

clone_in_place!(WhaleState {
    position,
    orientation,
    speed_m_s,
    turn_rate,
    posture,
    motion,
    contact_force_n,
    contact_port_m,
    mouth_moment_n_m,
    exertion
});

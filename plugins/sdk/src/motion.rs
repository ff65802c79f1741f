//! The whale-motion hook: pilot controls in, target speed, turn rates and posture out.

use crate::hook::{Descriptor, HookError};
use crate::whale::{BodyPart, Posture};

/// The pilot's controls: one vocabulary for pad, keyboard, recording and pilot program.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Controls {
    /// Swim speed, 0 (glide) to 1 (cruise).
    pub speed: f64,
    /// Pitch, -1 (nose down) to 1 (nose up).
    pub pitch: f64,
    /// Roll, -1 (to port) to 1 (to starboard).
    pub roll: f64,
    /// Yaw, -1 (to starboard) to 1 (to port).
    pub yaw: f64,
    /// Burst, 0 or 1: the greatest swimming speed.
    pub burst: f64,
    /// Mouth, 0 (closed) to 1 (open).
    pub mouth: f64,
    /// Flippers abducted (1) or adducted (-1).
    pub flipper_raise: f64,
    /// Flippers pronated (1) or supinated (-1).
    pub flipper_twist: f64,
    /// Flippers swept forward (1) or aft (-1).
    pub flipper_sweep: f64,
    /// Requested act: 0 none, n the n-th that the motion declares; a whole number.
    pub act: f64,
}

/// Input of a motion.
#[derive(Clone, Copy, Debug)]
pub struct MotionInput<'a> {
    /// Simulated time [s].
    pub time_s: f64,
    /// Length of the step [s].
    pub dt_s: f64,
    /// Body length, snout to fluke notch [m].
    pub length_m: f64,
    /// Speed through the water along the whale's x axis [m/s].
    pub speed_m_s: f64,
    /// Position of the whale frame's origin (mid-body) [m].
    pub position_m: [f64; 3],
    /// Orientation as a quaternion (x, y, z, w), whale frame to world.
    pub orientation: [f64; 4],
    /// The pilot's controls in this step.
    pub controls: Controls,
    /// Sum of the normal contact forces of the last step on each [`BodyPart`] [N].
    pub contact_force_n: &'a [f64; BodyPart::ALL.len()],
    /// Mean place of those forces on each part: distance to port from the midplane on the body at rest, negative to starboard [m].
    pub contact_port_m: &'a [f64; BodyPart::ALL.len()],
    /// Speed at which the drag of the body equals the thrust of the last step [m/s]; `None` for a kinematic whale, which has no
    /// thrust.
    pub thrust_speed_m_s: Option<f64>,
}

/// Output of a motion.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionOutput {
    /// Speed through the water at the end of the step [m/s].
    pub speed_m_s: f64,
    /// Turn rates about the whale's own x (roll), y (pitch down) and z (yaw to port) axes [rad/s].
    pub turn_rate_rad_s: [f64; 3],
    /// Joint angles at the end of the step.
    pub posture: Posture,
}

/// A way of moving: a pure function except for its floats.
pub trait WhaleMotion: Send + Sync {
    /// Identity and attributes.
    fn descriptor(&self) -> &Descriptor;

    /// Decides the whale's motion over one step from `input`, its attributes
    /// (SI, in the declared order) and its floats, which it may advance.
    ///
    /// # Errors
    /// With a message for the user; the run ends with it.
    fn step(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError>;
}

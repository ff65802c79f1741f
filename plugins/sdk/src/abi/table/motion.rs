//! The functions of a whale motion and their input.

use std::ffi::c_void;

use super::AbiMessage;
use crate::motion::{Controls, MotionOutput};

/// Functions of a whale motion.
#[repr(C)]
#[derive(Debug)]
pub struct AbiMotion {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// `[any-thread]` Moves the whale over one step; may advance `state`.
    pub step: Option<
        unsafe extern "C" fn(
            context: *const c_void,
            attributes: *const f64,
            attribute_count: usize,
            input: *const AbiMotionInput,
            state: *mut f64,
            state_len: usize,
            out: *mut MotionOutput,
            message: *mut AbiMessage,
        ) -> i32,
    >,
}

/// Input of a motion.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiMotionInput {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// Simulated time [s].
    pub time_s: f64,
    /// Length of the step [s].
    pub dt_s: f64,
    /// Body length, snout to fluke notch [m].
    pub length_m: f64,
    /// Speed through the water along the whale's x axis [m/s].
    pub speed_m_s: f64,
    /// Position of the whale frame's origin, mid-body [m].
    pub position_m: [f64; 3],
    /// Orientation as a quaternion (x, y, z, w), whale frame to world.
    pub orientation: [f64; 4],
    /// The pilot's controls.
    pub controls: Controls,
    /// Normal contact force on each body part in the last step [N].
    pub contact_force_n: *const f64,
    /// Number of body parts.
    pub body_part_count: usize,
    /// Mean place of those forces on each part: distance to port from the midplane on the body at rest [m].
    pub contact_port_m: *const f64,
    /// Speed at which the drag of the body equals the thrust of the last step, if `has_thrust` [m/s]. Since 3.2.
    pub thrust_speed_m_s: f64,
    /// 1 for a kinetic whale; 0 for a kinematic one, which has no thrust. Since 3.2.
    pub has_thrust: u32,
}

//! The functions of a friction model and their input.

use std::ffi::c_void;

use super::AbiMessage;
use crate::friction::FrictionResponse;

/// Functions of a friction model.
#[repr(C)]
#[derive(Debug)]
pub struct AbiFriction {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// `[any-thread]` Forces and derivatives: writes `contacts.count` answers. Called many times per step.
    pub respond: Option<
        unsafe extern "C" fn(
            context: *const c_void,
            attributes: *const f64,
            attribute_count: usize,
            contacts: *const AbiContacts,
            out: *mut FrictionResponse,
            message: *mut AbiMessage,
        ) -> i32,
    >,
    /// `[any-thread]` Floats at the end of an accepted step: writes `contacts.count * state_len`.
    pub advance: Option<
        unsafe extern "C" fn(
            context: *const c_void,
            attributes: *const f64,
            attribute_count: usize,
            contacts: *const AbiContacts,
            out: *mut f64,
            message: *mut AbiMessage,
        ) -> i32,
    >,
}

/// All contacts of one solver pass: arrays of `count` entries, vectors in the world frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiContacts {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// Number of contacts.
    pub count: usize,
    /// Length of the step [s].
    pub dt_s: f64,
    /// Normal force, never negative [N].
    pub normal_force_n: *const f64,
    /// Unit normal, from skin to rope.
    pub normal: *const [f64; 3],
    /// Unit vector fixed to the skin, across the normal: athwart the whale at rest; on baleen along the plates.
    pub grain: *const [f64; 3],
    /// Unit vector along the rope; for a contact of a trap, buoy or anchor: the normal.
    pub along: *const [f64; 3],
    /// Tangential displacement of rope against skin since the start of the step [m].
    pub slip_m: *const [f64; 3],
    /// Length of rope of each contact [m].
    pub length_m: *const f64,
    /// Coefficient of friction.
    pub coefficient: *const f64,
    /// Number of the skin region.
    pub region: *const u32,
    /// Index of the rope material; for a contact of a trap, buoy or anchor: 4294967295.
    pub rope: *const u32,
    /// Floats at the start of the step, `state_len` for each contact.
    pub state: *const f64,
    /// Floats for each contact.
    pub state_len: usize,
}

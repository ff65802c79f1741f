//! The functions of a gear type, and the program's functions by which it builds and acts.

use std::ffi::c_void;

use super::{AbiMessage, AbiText};
use crate::gear::Site;

/// Kind of body: trap.
pub const BODY_TRAP: u32 = 0;
/// Kind of body: buoy.
pub const BODY_BUOY: u32 = 1;
/// Kind of body: anchor.
pub const BODY_ANCHOR: u32 = 2;

/// A line ends at a body.
pub const AT_BODY: u32 = 0;
/// A line ends at a joint.
pub const AT_JOINT: u32 = 1;

/// End A of a line, its `from` end.
pub const END_A: u32 = 0;
/// End B of a line, its `to` end.
pub const END_B: u32 = 1;

/// Functions of a gear type.
#[repr(C)]
#[derive(Debug)]
pub struct AbiGear {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// `[any-thread]` Builds the rig by calling `rig`'s functions.
    pub build: Option<
        unsafe extern "C" fn(
            context: *const c_void,
            values: *const AbiValue,
            value_count: usize,
            site: *const Site,
            rig: *const AbiRigHost,
            message: *mut AbiMessage,
        ) -> i32,
    >,
    /// `[any-thread]` Once a step; acts by calling `actions`' functions. Null where the gear never acts.
    pub step: Option<
        unsafe extern "C" fn(
            context: *const c_void,
            values: *const AbiValue,
            value_count: usize,
            input: *const AbiGearStep,
            state: *mut f64,
            state_len: usize,
            actions: *const AbiActionHost,
            message: *mut AbiMessage,
        ) -> i32,
    >,
}

/// The value of an attribute.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiValue {
    /// Kind of the attribute, as declared.
    pub kind: u32,
    /// The number or count.
    pub number: f64,
    /// The id of the item, or the word.
    pub item: AbiText,
}

/// Input of a gear type, once per step.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiGearStep {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// Simulated time [s].
    pub time_s: f64,
    /// Length of the step [s].
    pub dt_s: f64,
    /// Number of lines of its rig.
    pub line_count: usize,
    /// Tension of each line, in the order built, at end A then end B [N].
    pub end_tension_n: *const [f64; 2],
}

/// The program's functions by which a gear type builds; each takes `host` first and gives a status.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiRigHost {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// First argument of each function.
    pub host: *mut c_void,
    /// Adds a trap, buoy or anchor.
    pub add_body: Option<unsafe extern "C" fn(host: *mut c_void, body: *const AbiBody) -> i32>,
    /// Adds a splice.
    pub add_joint: Option<unsafe extern "C" fn(host: *mut c_void, joint: *const AbiJoint) -> i32>,
    /// Adds a line.
    pub add_line: Option<unsafe extern "C" fn(host: *mut c_void, line: *const AbiLine) -> i32>,
    /// Adds a weak link.
    pub add_link: Option<unsafe extern "C" fn(host: *mut c_void, link: *const AbiLink) -> i32>,
    /// Sets the initial path of a line added before, `count` places from end A to end B [m].
    pub lay_line: Option<
        unsafe extern "C" fn(
            host: *mut c_void,
            line: AbiText,
            places_m: *const [f64; 3],
            count: usize,
        ) -> i32,
    >,
}

/// The program's functions by which a gear type acts; indices are in the order built.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiActionHost {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// First argument of each function.
    pub host: *mut c_void,
    /// Cuts a line at [`END_A`] or [`END_B`].
    pub cut_line: Option<unsafe extern "C" fn(host: *mut c_void, line: u32, end: u32) -> i32>,
    /// Opens a weak link or release.
    pub release_link: Option<unsafe extern "C" fn(host: *mut c_void, link: u32) -> i32>,
}

/// A trap, buoy or anchor of a rig.
#[repr(C)]
#[derive(Debug)]
pub struct AbiBody {
    /// Id within the rig.
    pub id: AbiText,
    /// [`BODY_TRAP`], [`BODY_BUOY`] or [`BODY_ANCHOR`].
    pub kind: u32,
    /// Id of the library item.
    pub item: AbiText,
    /// Initial place [m].
    pub position_m: [f64; 3],
}

/// A splice.
#[repr(C)]
#[derive(Debug)]
pub struct AbiJoint {
    /// Id within the rig.
    pub id: AbiText,
    /// Initial place [m].
    pub position_m: [f64; 3],
}

/// An end of a line.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiRigEnd {
    /// [`AT_BODY`] or [`AT_JOINT`].
    pub at: u32,
    /// Id of the body or joint.
    pub id: AbiText,
}

/// A length of one rope between two ends.
#[repr(C)]
#[derive(Debug)]
pub struct AbiLine {
    /// Id within the rig.
    pub id: AbiText,
    /// Id of the rope in the library.
    pub rope: AbiText,
    /// End A.
    pub from: AbiRigEnd,
    /// End B.
    pub to: AbiRigEnd,
    /// Unstretched length [m].
    pub length_m: f64,
}

/// A weak link at one end of a line.
#[repr(C)]
#[derive(Debug)]
pub struct AbiLink {
    /// Id within the rig.
    pub id: AbiText,
    /// Id of the weak link in the library.
    pub item: AbiText,
    /// Id of its line.
    pub line: AbiText,
    /// [`END_A`] or [`END_B`].
    pub end: u32,
}

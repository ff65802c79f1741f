//! Structs and function pointers of the plugin ABI; `include/endline_plugin.h` is made from this file.
//!
//! Rules for every function: nothing unwinds or `longjmp`s across; the callee keeps no pointer it
//! was handed after it returns; memory is freed on the side that made it; strings are UTF-8.
//! A status is [`STATUS_OK`], or [`STATUS_ERROR`] or [`STATUS_CRASH`] with a message.
//!
//! Thread tags: `[main-thread]` is called once at a time, before any run; `[any-thread]` may be
//! called by several runs at once and so writes nothing but what it is handed.
//!
//! A later minor version may add fields at the end of a struct that has `struct_size`, never
//! change or remove one; each side reads of the other's struct what `struct_size` reaches, and takes the rest
//! for zero. A struct without `struct_size` stays as it is.

use std::ffi::{c_char, c_void};

use crate::friction::FrictionResponse;
use crate::gear::Site;
use crate::motion::{Controls, MotionOutput};

/// Major version: another number means another layout.
pub const ABI_MAJOR: u32 = 3;
/// Minor version: a greater number means fields added at the ends of structs, or kinds of attribute.
pub const ABI_MINOR: u32 = 1;

/// Kind of plugin: whale motion, table [`AbiMotion`].
pub const KIND_MOTION: u32 = 1;
/// Kind of plugin: friction model, table [`AbiFriction`].
pub const KIND_FRICTION: u32 = 2;
/// Kind of plugin: gear type, table [`AbiGear`].
pub const KIND_GEAR: u32 = 3;

/// Status: done.
pub const STATUS_OK: i32 = 0;
/// Status: could not be done; the message says why.
pub const STATUS_ERROR: i32 = 1;
/// Status: the plugin failed inside (in Rust, panicked); the message says what is known.
pub const STATUS_CRASH: i32 = 2;

/// Kind of attribute: a number in its SI unit.
pub const ATTRIBUTE_NUMBER: u32 = 0;
/// Kind of attribute: the id of an item of the gear library.
pub const ATTRIBUTE_ITEM: u32 = 1;
/// Kind of attribute: a whole number.
pub const ATTRIBUTE_COUNT: u32 = 2;
/// Kind of attribute: one of a few words.
pub const ATTRIBUTE_CHOICE: u32 = 3;

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

/// Text: UTF-8, `length` bytes, no NUL needed; null stands for empty.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiText {
    /// First byte.
    pub text: *const c_char,
    /// How many bytes.
    pub length: usize,
}

/// A buffer of the caller for a message; the callee writes UTF-8 and sets `length`.
#[repr(C)]
#[derive(Debug)]
pub struct AbiMessage {
    /// First byte of the buffer.
    pub text: *mut c_char,
    /// Size of the buffer in bytes.
    pub capacity: usize,
    /// Bytes written.
    pub length: usize,
}

/// What a plugin library exports under the name `endline_plugin_entry`.
#[repr(C)]
#[derive(Debug)]
pub struct AbiEntry {
    /// [`ABI_MAJOR`] it was built for.
    pub abi_major: u32,
    /// [`ABI_MINOR`] it was built for.
    pub abi_minor: u32,
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// `[main-thread]` Called once, first, with the path of the library. Gives a status.
    pub init: Option<unsafe extern "C" fn(path: AbiText, message: *mut AbiMessage) -> i32>,
    /// `[main-thread]` Called at most once, last; libraries stay mapped, so it may never be called. May be null.
    pub deinit: Option<unsafe extern "C" fn()>,
    /// `[main-thread]` The [`AbiFactory`] for the id `endline.plugins/3`, null for any other id.
    pub get_factory: Option<unsafe extern "C" fn(id: AbiText) -> *const c_void>,
}

/// The plugins of a library; lives as long as the library.
#[repr(C)]
#[derive(Debug)]
pub struct AbiFactory {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// How many plugins there are.
    pub plugin_count: u32,
    /// A pointer to each.
    pub plugins: *const *const AbiPlugin,
    /// What the library says of itself: who made it, where its laws and figures come from. Since 3.1; may be null.
    pub about: AbiText,
}

/// One plugin: who it is, what it takes, and its functions; lives as long as the library.
#[repr(C)]
#[derive(Debug)]
pub struct AbiPlugin {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// [`KIND_MOTION`], [`KIND_FRICTION`] or [`KIND_GEAR`].
    pub kind: u32,
    /// Reverse-domain id, such as `org.endline.friction.coulomb`.
    pub id: AbiText,
    /// Version of the plugin.
    pub version: AbiText,
    /// Name shown in menus.
    pub name: AbiText,
    /// One sentence of help.
    pub help: AbiText,
    /// Declared attributes, in the order in which values are handed over.
    pub attributes: *const AbiAttribute,
    /// How many attributes.
    pub attribute_count: usize,
    /// Floats of state the engine keeps: in all for a motion or gear type, for each contact for a friction model.
    pub state_len: usize,
    /// Handed back as the first argument of every function of the table; the plugin's own, may be null.
    pub context: *const c_void,
    /// [`AbiMotion`], [`AbiFriction`] or [`AbiGear`], as `kind` says.
    pub table: *const c_void,
    /// Acts of a whale motion, in the order of the control `act`; may be null for none.
    pub acts: *const AbiAct,
    /// How many acts.
    pub act_count: usize,
}

/// Something a whale motion does of itself when asked.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiAct {
    /// Id in files, such as `roll-away`.
    pub id: AbiText,
    /// Name shown in menus.
    pub name: AbiText,
    /// Help shown beside it.
    pub help: AbiText,
}

/// One setting of a plugin.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiAttribute {
    /// Key in files.
    pub key: AbiText,
    /// SI unit, `1` for a pure number or a count; empty for an item or a word.
    pub unit: AbiText,
    /// Help shown beside the field.
    pub help: AbiText,
    /// [`ATTRIBUTE_NUMBER`], [`ATTRIBUTE_ITEM`], [`ATTRIBUTE_COUNT`] or [`ATTRIBUTE_CHOICE`].
    pub kind: u32,
    /// Number, count: least allowed value.
    pub least: f64,
    /// Number, count: greatest allowed value.
    pub greatest: f64,
    /// Number, count: value where a file names none.
    pub default_number: f64,
    /// Item: folder of the library, such as `ropes`. Choice: the words, with `|` between.
    pub library: AbiText,
    /// Item: id where a file names none; empty for no item. Choice: the word.
    pub default_item: AbiText,
}

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

/// What a motion may look at.
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
    /// How many body parts.
    pub body_part_count: usize,
    /// Where on each part those forces are: mean place to port of the midplane on the body at rest [m].
    pub contact_port_m: *const f64,
}

/// Functions of a friction model.
#[repr(C)]
#[derive(Debug)]
pub struct AbiFriction {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// `[any-thread]` Forces and derivatives: writes `contacts.count` answers. Called many times a step.
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
    /// How many contacts.
    pub count: usize,
    /// Length of the step [s].
    pub dt_s: f64,
    /// Normal force, never negative [N].
    pub normal_force_n: *const f64,
    /// Unit normal, from skin to rope.
    pub normal: *const [f64; 3],
    /// Unit vector fixed to the skin, across the normal: athwart the whale at rest; on baleen along the plates.
    pub grain: *const [f64; 3],
    /// Unit vector along the rope.
    pub along: *const [f64; 3],
    /// Tangential displacement of rope against skin since the step began [m].
    pub slip_m: *const [f64; 3],
    /// Length of rope each contact stands for [m].
    pub length_m: *const f64,
    /// Coefficient of friction.
    pub coefficient: *const f64,
    /// Number of the skin region.
    pub region: *const u32,
    /// Index of the rope material.
    pub rope: *const u32,
    /// Floats as the step began, `state_len` for each contact.
    pub state: *const f64,
    /// Floats for each contact.
    pub state_len: usize,
}

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
    /// The number or count, where it is one.
    pub number: f64,
    /// The item's id or the word, where it is one.
    pub item: AbiText,
}

/// What a gear type may look at once a step.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiGearStep {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// Simulated time [s].
    pub time_s: f64,
    /// Length of the step [s].
    pub dt_s: f64,
    /// How many lines its rig has.
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
    /// To be handed to each function.
    pub host: *mut c_void,
    /// Adds a trap, buoy or anchor.
    pub add_body: Option<unsafe extern "C" fn(host: *mut c_void, body: *const AbiBody) -> i32>,
    /// Adds a splice.
    pub add_joint: Option<unsafe extern "C" fn(host: *mut c_void, joint: *const AbiJoint) -> i32>,
    /// Adds a line.
    pub add_line: Option<unsafe extern "C" fn(host: *mut c_void, line: *const AbiLine) -> i32>,
    /// Adds a weak link.
    pub add_link: Option<unsafe extern "C" fn(host: *mut c_void, link: *const AbiLink) -> i32>,
    /// Gives a line added before the way it lies at first, `count` places from end A to end B [m].
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
    /// To be handed to each function.
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
    /// First guess of its place [m].
    pub position_m: [f64; 3],
}

/// A splice.
#[repr(C)]
#[derive(Debug)]
pub struct AbiJoint {
    /// Id within the rig.
    pub id: AbiText,
    /// First guess of its place [m].
    pub position_m: [f64; 3],
}

/// Where a line ends.
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
    /// Id of the line it sits in.
    pub line: AbiText,
    /// [`END_A`] or [`END_B`].
    pub end: u32,
}

/// Name under which the library exports its [`AbiEntry`].
pub const ENTRY_NAME: &str = "endline_plugin_entry";
/// Id of the factory of this ABI.
pub const FACTORY_ID: &str = "endline.plugins/3";

impl AbiText {
    /// Text that lives as long as what it was made from.
    #[must_use]
    pub const fn of(text: &str) -> Self {
        Self { text: text.as_ptr().cast(), length: text.len() }
    }
}

impl AbiMessage {
    /// A message buffer over a caller's bytes.
    #[must_use]
    pub fn over(buffer: &mut [u8]) -> Self {
        Self { text: buffer.as_mut_ptr().cast(), capacity: buffer.len(), length: 0 }
    }
}

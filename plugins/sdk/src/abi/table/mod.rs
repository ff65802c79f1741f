//! Structs and function pointers of the plugin ABI; `include/endline_plugin.h` is made from this folder.
//!
//! Rules for every function: nothing unwinds or `longjmp`s across; the callee does not store pointers that it
//! receives; memory is freed on the side that made it; strings are UTF-8.
//! A status is [`STATUS_OK`], or [`STATUS_ERROR`] or [`STATUS_CRASH`] with a message.
//!
//! Thread tags: `[main-thread]` is called once at a time, before any run; `[any-thread]` may be
//! called by several runs at once and therefore writes only to its arguments.
//!
//! A later minor version may add fields at the end of a struct that has `struct_size`, never
//! change or remove one; each side reads the other's struct up to `struct_size`, and uses zero
//! for the rest. A struct without `struct_size` stays as it is.

mod friction;
mod gear;
mod motion;

use std::ffi::{c_char, c_void};

pub use friction::{AbiContacts, AbiFriction};
pub use gear::{
    AT_BODY, AT_JOINT, AbiActionHost, AbiBody, AbiGear, AbiGearStep, AbiJoint, AbiLine, AbiLink,
    AbiRigEnd, AbiRigHost, AbiValue, BODY_ANCHOR, BODY_BUOY, BODY_TRAP, END_A, END_B,
};
pub use motion::{AbiMotion, AbiMotionInput};

/// Major version: another number means another layout.
pub const ABI_MAJOR: u32 = 3;
/// Minor version: a greater number means fields added at the ends of structs, or kinds of attribute.
pub const ABI_MINOR: u32 = 2;

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
/// Status: the plugin failed inside (in Rust, panicked); the message has the known details.
pub const STATUS_CRASH: i32 = 2;

/// Kind of attribute: a number in its SI unit.
pub const ATTRIBUTE_NUMBER: u32 = 0;
/// Kind of attribute: the id of an item of the gear library.
pub const ATTRIBUTE_ITEM: u32 = 1;
/// Kind of attribute: a whole number.
pub const ATTRIBUTE_COUNT: u32 = 2;
/// Kind of attribute: one of several words.
pub const ATTRIBUTE_CHOICE: u32 = 3;

/// Text: UTF-8, `length` bytes, not NUL-terminated; null means empty.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AbiText {
    /// First byte.
    pub text: *const c_char,
    /// Number of bytes.
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

/// The entry that a plugin library exports as `endline_plugin_entry`.
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
    /// Number of plugins.
    pub plugin_count: u32,
    /// A pointer to each.
    pub plugins: *const *const AbiPlugin,
    /// Author of the library, and sources of its laws and figures. Since 3.1; may be null.
    pub about: AbiText,
}

/// A plugin: identity, attributes and functions; lives as long as the library.
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
    /// Declared attributes, in the order of their values.
    pub attributes: *const AbiAttribute,
    /// Number of attributes.
    pub attribute_count: usize,
    /// Floats of state, stored by the engine: in total for a motion or gear type, for each contact for a friction model.
    pub state_len: usize,
    /// First argument of every function of the table; owned by the plugin, may be null.
    pub context: *const c_void,
    /// [`AbiMotion`], [`AbiFriction`] or [`AbiGear`], as `kind` says.
    pub table: *const c_void,
    /// Acts of a whale motion, in the order of the control `act`; may be null for none.
    pub acts: *const AbiAct,
    /// Number of acts.
    pub act_count: usize,
}

/// An action of a whale motion on request.
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
    /// Number, count: default value.
    pub default_number: f64,
    /// Item: folder of the library, such as `ropes`. Choice: the words, with `|` between.
    pub library: AbiText,
    /// Item: default id; empty for no item. Choice: default word.
    pub default_item: AbiText,
}

/// Name under which the library exports its [`AbiEntry`].
pub const ENTRY_NAME: &str = "endline_plugin_entry";
/// Id of the factory of this ABI.
pub const FACTORY_ID: &str = "endline.plugins/3";

impl AbiText {
    /// Text with the lifetime of its source.
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

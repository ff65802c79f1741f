//! The plugin's side of the C table: from traits to function pointers.
//!
//! Everything here runs inside a plugin library. Each function catches a panic and returns
//! [`STATUS_CRASH`] with its message, so that nothing unwinds into the program. The plugin must
//! therefore be built with `panic = "unwind"`, Rust's default.
//!
//! `motion.rs`, `friction.rs` and `gear.rs` hold the functions of one hook each, `describe.rs` makes
//! the descriptors, `pointers.rs` turns the program's pointers into references, and `guard.rs`
//! catches errors and panics.
#![expect(
    unsafe_code,
    reason = "one of the two sides of the plugin boundary: raw pointers from the program become slices here"
)]

mod describe;
mod friction;
mod gear;
mod guard;
mod motion;
mod pointers;

use std::ffi::c_void;
use std::sync::OnceLock;

use super::table::*;
use crate::friction::FrictionModel;
use crate::gear::GearType;
use crate::motion::WhaleMotion;
use guard::guarded;
use pointers::{size, text};

/// Exports plugins from a library crate, where its feature `entry` is on.
///
/// ```text
/// endline_sdk::export_plugin! { motion: Swim::new(), friction: Coulomb::new(), gear: Single::new() }
/// ```
///
/// Any number of plugins, each after its kind: `motion`, `friction` or `gear`. An optional first entry describes the library,
/// as in `about: "A. Author 2026, after Smith 1999";`. Without the feature nothing is generated, so that several plugin crates
/// link into one binary.
#[macro_export]
macro_rules! export_plugin {
    ($($kind:ident: $plugin:expr),+ $(,)?) => {
        $crate::export_plugin! { about: ""; $($kind: $plugin),+ }
    };
    (about: $about:expr; $($kind:ident: $plugin:expr),+ $(,)?) => {
        #[cfg(feature = "entry")]
        mod endline_plugin_export {
            #![allow(unsafe_code, reason = "an exported symbol is unsafe to name; all work is done in endline_sdk::abi::export")]
            use super::*;
            use $crate::abi::export::{Exported, Factory, factory, init};
            use $crate::abi::table::{ABI_MAJOR, ABI_MINOR, AbiEntry, AbiMessage, AbiText};

            static FACTORY: ::std::sync::OnceLock<Factory> = ::std::sync::OnceLock::new();

            extern "C" fn init_library(_path: AbiText, message: *mut AbiMessage) -> i32 {
                init(&FACTORY, || ::std::vec![$(Exported::$kind($plugin)),+], $about, message)
            }

            extern "C" fn get_factory(id: AbiText) -> *const ::std::ffi::c_void {
                factory(&FACTORY, id)
            }

            /// The entry of this library.
            #[unsafe(no_mangle)]
            #[allow(non_upper_case_globals, reason = "the name is part of the ABI")]
            pub static endline_plugin_entry: AbiEntry = AbiEntry {
                abi_major: ABI_MAJOR,
                abi_minor: ABI_MINOR,
                struct_size: ::std::mem::size_of::<AbiEntry>() as u32,
                init: Some(init_library),
                deinit: None,
                get_factory: Some(get_factory),
            };
        }
    };
}

/// One plugin to export.
pub enum Exported {
    /// A whale motion.
    Motion(Box<dyn WhaleMotion>),
    /// A friction model.
    Friction(Box<dyn FrictionModel>),
    /// A gear type.
    Gear(Box<dyn GearType>),
}

impl Exported {
    /// A whale motion.
    pub fn motion(plugin: impl WhaleMotion + 'static) -> Self {
        Self::Motion(Box::new(plugin))
    }

    /// A friction model.
    pub fn friction(plugin: impl FrictionModel + 'static) -> Self {
        Self::Friction(Box::new(plugin))
    }

    /// A gear type.
    pub fn gear(plugin: impl GearType + 'static) -> Self {
        Self::Gear(Box::new(plugin))
    }
}

/// The factory of a library and all it points at; made once, never freed.
pub struct Factory(AbiFactory);

// SAFETY: the pointers lead to leaked memory that is not written to after its creation, and the
// traits behind `context` are `Send + Sync`.
unsafe impl Send for Factory {}
// SAFETY: as above.
unsafe impl Sync for Factory {}

/// Makes the factory; a panic in a plugin's constructor becomes a status with its message.
pub fn init(
    store: &OnceLock<Factory>,
    plugins: impl FnOnce() -> Vec<Exported>,
    about: &'static str,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        store.get_or_init(|| make_factory(plugins(), about));
        Ok(())
    })
}

/// The factory for its own id, if its construction succeeded; else null.
pub fn factory(store: &OnceLock<Factory>, id: AbiText) -> *const c_void {
    // SAFETY: the program hands over text that lives through this call.
    let asked = unsafe { text(id) };
    match store.get() {
        Some(factory) if asked == FACTORY_ID => (&raw const factory.0).cast(),
        _ => std::ptr::null(),
    }
}

fn make_factory(plugins: Vec<Exported>, about: &'static str) -> Factory {
    let pointers: Vec<*const AbiPlugin> = plugins
        .into_iter()
        .map(|plugin| &raw const *Box::leak(Box::new(describe::plugin(plugin))))
        .collect();
    let pointers = Vec::leak(pointers);
    Factory(AbiFactory {
        struct_size: size::<AbiFactory>(),
        plugin_count: pointers.len() as u32,
        plugins: pointers.as_ptr(),
        about: AbiText::of(about),
    })
}

//! The C side of the hooks: the interface between the program and a plugin library.
//!
//! A plugin library exports one static, [`endline_plugin_entry`](table::AbiEntry). It leads to a
//! factory, the factory to descriptors, each descriptor to a table of functions of its kind:
//!
//! ```text
//! endline_plugin_entry -> get_factory("endline.plugins/3") -> AbiFactory -> AbiPlugin -> AbiMotion | AbiFriction | AbiGear
//! ```
//!
//! In Rust this module is not needed: implement a trait and name it in
//! [`export_plugin!`](crate::export_plugin). In C, include `endline_plugin.h`, which is generated
//! from [`table`]. `docs/plugin-abi.md` has the rules in one page.

pub mod export;
pub mod table;

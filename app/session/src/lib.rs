//! All a user can do with Endline, without a screen.

pub mod plugins;

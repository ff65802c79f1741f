//! Tests of the window without a screen: actions of a user and their effects.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot continue fails")]
#![allow(clippy::disallowed_methods, reason = "tests read files that they have written")]

mod answers;
mod commands;
mod common;
mod figures;
mod gear;
mod house;
mod killed;
mod plugins;
mod rules;
mod runs;
mod scenario;
mod search;
mod soak;
mod study;
mod view;
mod workbench;

//! Tests of the window without a screen: what a user does in it, and what comes of it.
#![cfg(feature = "gui")]
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
mod start;
mod study;
mod view;
mod workbench;

//! Watches over a plugin: right lengths in, finite and passive values out, its id in every error.

use std::sync::Arc;

use endline_sdk::HookError;

use super::info::Hook;

mod friction;
mod gear;
mod motion;

#[cfg(unix)]
pub(super) use friction::{BLANK, UNWRITTEN};

pub(super) fn guarded(hook: Hook) -> Hook {
    match hook {
        Hook::Motion(motion) => Hook::Motion(Arc::new(motion::Guarded(motion))),
        Hook::Friction(friction) => Hook::Friction(Arc::new(friction::Guarded(friction))),
        Hook::Gear(gear) => Hook::Gear(Arc::new(gear::Guarded(gear))),
    }
}

/// The same error with the plugin's id in front.
fn named(id: &str) -> impl Fn(HookError) -> HookError {
    move |error| HookError::new(format!("plugin `{id}`: {}", error.message))
}

fn fault<T>(message: impl Into<String>) -> Result<T, HookError> {
    Err(HookError::new(message))
}

fn expect_len(what: &str, got: usize, expected: usize) -> Result<(), HookError> {
    if got == expected { Ok(()) } else { fault(format!("expected {expected} {what}, got {got}")) }
}

fn expect_finite(what: &str, values: &[f64]) -> Result<(), HookError> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => fault(format!("it gave {value} for {what}")),
    }
}

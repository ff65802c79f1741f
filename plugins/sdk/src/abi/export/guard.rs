//! Errors and panics of a hook as a status and a message.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::abi::table::{AbiMessage, STATUS_CRASH, STATUS_ERROR, STATUS_OK};
use crate::hook::HookError;

/// Runs a hook. Its error or its panic becomes a status with a message.
pub(super) fn guarded(
    message: *mut AbiMessage,
    work: impl FnOnce() -> Result<(), HookError>,
) -> i32 {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => STATUS_OK,
        Ok(Err(error)) => {
            say(message, &error.message);
            STATUS_ERROR
        }
        Err(payload) => {
            say(message, panic_text(payload.as_ref()));
            std::mem::forget(payload); // its drop might panic in turn
            STATUS_CRASH
        }
    }
}

fn panic_text(payload: &(dyn Any + Send)) -> &str {
    let known = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    known.unwrap_or("a panic without a message")
}

/// Writes a message into the caller's buffer, truncated at a character boundary.
fn say(message: *mut AbiMessage, words: &str) {
    // SAFETY: the caller hands null or a buffer of `capacity` bytes that is its own alone.
    unsafe {
        let Some(message) = message.as_mut() else { return };
        let length = words.floor_char_boundary(message.capacity);
        std::ptr::copy_nonoverlapping(words.as_ptr(), message.text.cast(), length);
        message.length = length;
    }
}

//! Results as JSON. Structs of numbers and texts always serialise; the empty string would fail every reader at once.

use serde::Serialize;

/// One line of JSON.
pub fn line(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// JSON with a line for each value.
pub fn indented(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default()
}

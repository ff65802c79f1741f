//! What enters a step from outside.

use endline_sdk::Controls;

/// All that enters a step from outside; recorded, so that a run replays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Input {
    /// The pilot's controls.
    pub controls: Controls,
}

//! Gamepad and keyboard as the pilot's controls.
//!
//! | module | what |
//! |---|---|
//! | [`pad`] | a pad behind a trait: gilrs, or a script in tests |
//! | [`keys`] | the keyboard |
//! | [`pilot`] | both as [`Controls`](endline_sdk::Controls) and [`PilotAction`]s, the 2012 preset |

pub mod keys;
pub mod pad;
pub mod pilot;

pub use keys::HeldKeys;
pub use pad::{GilrsPads, PadAxis, PadButton, PadEvent, PadSource, ScriptedPad};
pub use pilot::{Pilot, PilotAction};

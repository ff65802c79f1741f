//! Gamepad and keyboard as the pilot's controls.
//!
//! | module | what |
//! |---|---|
//! | [`pad`] | a pad behind a trait: gilrs, or a script in tests; its pulses |
//! | [`mapping`] | which key, stick, trigger and button does what |
//! | [`pilot`] | both as [`Controls`](endline_sdk::Controls) and [`PilotAction`]s |

pub mod mapping;
pub mod pad;
pub mod pilot;

pub use mapping::{AxisUse, HeldKeys, Mapping, Pressed, Steered};
pub use pad::{GilrsPads, PadAxis, PadButton, PadEvent, PadSource, Pulse, Rumble, ScriptedPad};
pub use pilot::{Hands, Pilot, PilotAction};

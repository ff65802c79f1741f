//! Gamepad and keyboard as the pilot's controls.
//!
//! | module | what |
//! |---|---|
//! | [`pad`] | a pad behind a trait: gilrs, or a script in tests |
//! | [`keys`] | the keyboard |
//! | [`mapping`] | which stick, trigger and button does what |
//! | [`rumble`] | what a pilot feels |
//! | [`pilot`] | both as [`Controls`](endline_sdk::Controls) and [`PilotAction`]s |

pub mod keys;
pub mod mapping;
pub mod pad;
pub mod pilot;
pub mod rumble;

pub use keys::HeldKeys;
pub use mapping::{AxisUse, Mapping, Pressed, Steered};
pub use pad::{GilrsPads, PadAxis, PadButton, PadEvent, PadSource, ScriptedPad};
pub use pilot::{Hands, Pilot, PilotAction};
pub use rumble::{Pulse, Rumble};

//! Gamepad and keyboard as controls of the whale.
//!
//! | module | content |
//! |---|---|
//! | [`pad`] | pads of this machine, or a script in tests; pulses of the pad |
//! | [`mapping`] | assignment of keys, sticks, triggers and buttons |
//! | [`pilot`] | pad and keyboard combined into [`Controls`](endline_sdk::Controls) and [`PilotAction`]s |

pub mod mapping;
pub mod pad;
pub mod pilot;

pub use mapping::{AxisUse, HeldKeys, Mapping, Pressed, Steered};
pub use pad::{GilrsPads, PadAxis, PadButton, PadEvent, PadSource, Pulse, Rumble, ScriptedPad};
pub use pilot::{Hands, Pilot, PilotAction};

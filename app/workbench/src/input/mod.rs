//! Gamepad and keyboard as the pilot's controls.

//! The keyboard as a pilot holds it.

use egui::{InputState, Key};

/// Keys held down that steer; each pair is one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeldKeys {
    /// Faster (W, 1) or slower (S, -1).
    pub throttle: f64,
    /// Nose up (up arrow, 1) or down (down arrow, -1).
    pub pitch: f64,
    /// Roll to starboard (right arrow, 1) or port (left arrow, -1).
    pub roll: f64,
    /// Turn to port (A, 1) or starboard (D, -1).
    pub yaw: f64,
    /// Burst (Shift).
    pub burst: bool,
    /// Flippers out (E, 1) or in (Q, -1).
    pub flipper_raise: f64,
    /// Flippers pronated (C, 1) or supinated (Z, -1).
    pub flipper_twist: f64,
    /// Flippers swept forward (R, 1) or aft (T, -1).
    pub flipper_sweep: f64,
    /// The chosen act (G).
    pub act: bool,
}

impl HeldKeys {
    /// What is held in egui's input.
    #[must_use]
    pub fn of(input: &InputState) -> Self {
        let pair = |more: Key, less: Key| f64::from(u8::from(input.key_down(more))) - f64::from(u8::from(input.key_down(less)));
        Self {
            throttle: pair(Key::W, Key::S),
            pitch: pair(Key::ArrowUp, Key::ArrowDown),
            roll: pair(Key::ArrowRight, Key::ArrowLeft),
            yaw: pair(Key::A, Key::D),
            burst: input.modifiers.shift,
            flipper_raise: pair(Key::E, Key::Q),
            flipper_twist: pair(Key::C, Key::Z),
            flipper_sweep: pair(Key::R, Key::T),
            act: input.key_down(Key::G),
        }
    }
}

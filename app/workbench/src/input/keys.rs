//! The keyboard as a pilot holds it, by the table of keys that steer.

use egui::{InputState, Key};

/// A pair of keys held down to steer, or one.
#[derive(Clone, Copy, Debug)]
pub struct Steer {
    /// What they do, in the list of keys.
    pub what: &'static str,
    /// The key that gives 1.
    pub more: Key,
    /// The key that gives -1.
    pub less: Option<Key>,
    /// The same on the pad, as it is preset.
    pub pad: &'static str,
}

impl Steer {
    const fn pair(what: &'static str, more: Key, less: Key, pad: &'static str) -> Self {
        Self { what, more, less: Some(less), pad }
    }

    /// Its keys, for the list.
    #[must_use]
    pub fn keys(&self) -> String {
        let less = self.less.map_or_else(String::new, |key| format!(", {}", key.symbol_or_name()));
        format!("{}{less}", self.more.symbol_or_name())
    }

    fn held(&self, input: &InputState) -> f64 {
        let down = |key: Key| f64::from(u8::from(input.key_down(key)));
        down(self.more) - self.less.map_or(0.0, down)
    }
}

/// Every key that steers, in the order of the fields of [`HeldKeys`] but the burst, which is Shift.
pub static STEERING: [Steer; 8] = [
    Steer::pair("Swim faster, slower", Key::W, Key::S, "left trigger"),
    Steer::pair("Nose up, down", Key::ArrowUp, Key::ArrowDown, "left stick"),
    Steer::pair("Roll to starboard, port", Key::ArrowRight, Key::ArrowLeft, "left stick"),
    Steer::pair("Turn to port, starboard", Key::A, Key::D, "right stick"),
    Steer::pair("Flippers out, in", Key::E, Key::Q, "left shoulder and right stick"),
    Steer::pair("Flippers pronated, supinated", Key::C, Key::Z, "left shoulder and right stick"),
    Steer::pair(
        "Flippers swept forward, aft",
        Key::R,
        Key::T,
        "right trigger; aft with left shoulder",
    ),
    Steer { what: "Do the chosen act", more: Key::G, less: None, pad: "right stick pressed" },
];

/// What is held down; each pair is one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeldKeys {
    /// Faster (1) or slower (-1).
    pub throttle: f64,
    /// Nose up (1) or down (-1).
    pub pitch: f64,
    /// Roll to starboard (1) or port (-1).
    pub roll: f64,
    /// Turn to port (1) or starboard (-1).
    pub yaw: f64,
    /// Burst (Shift).
    pub burst: bool,
    /// Flippers out (1) or in (-1).
    pub flipper_raise: f64,
    /// Flippers pronated (1) or supinated (-1).
    pub flipper_twist: f64,
    /// Flippers swept forward (1) or aft (-1).
    pub flipper_sweep: f64,
    /// The chosen act.
    pub act: bool,
}

impl HeldKeys {
    /// What is held in egui's input.
    #[must_use]
    pub fn of(input: &InputState) -> Self {
        let [throttle, pitch, roll, yaw, flipper_raise, flipper_twist, flipper_sweep, act] =
            STEERING.each_ref().map(|steer| steer.held(input));
        let burst = input.modifiers.shift;
        Self {
            throttle,
            pitch,
            roll,
            yaw,
            burst,
            flipper_raise,
            flipper_twist,
            flipper_sweep,
            act: act > 0.0,
        }
    }
}

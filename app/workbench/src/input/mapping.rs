//! Assignment of keys, sticks, triggers and buttons: fixed keys of the keyboard; presets, dead zones and curve of the pad, which are
//! stored with the preferences.
//!
//! A deflection x beyond the dead zone, scaled to 0..1, becomes `y = x^curve`: a curve above 1 is less sensitive near the middle.

use egui::{InputState, Key};
use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

use crate::input::pad::{PadAxis, PadButton};

/// What a stick or trigger can control.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantArray,
)]
pub enum Steered {
    /// Swimming speed.
    #[strum(serialize = "Swim faster")]
    Speed,
    /// Nose up.
    #[strum(serialize = "Nose up")]
    Pitch,
    /// Roll to starboard.
    #[strum(serialize = "Roll to starboard")]
    Roll,
    /// Turn to port.
    #[strum(serialize = "Turn to port")]
    Yaw,
    /// Flippers out.
    #[strum(serialize = "Flippers out")]
    FlipperRaise,
    /// Flippers pronated.
    #[strum(serialize = "Flippers pronated")]
    FlipperTwist,
    /// Flippers swept forward.
    #[strum(serialize = "Flippers swept forward")]
    FlipperSweep,
    /// Opening of the mouth.
    #[strum(serialize = "Open the mouth")]
    Mouth,
}

impl Steered {
    /// All, in the order shown.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Name on screen.
    pub fn words(self) -> &'static str {
        self.into()
    }
}

/// Function of a button.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantArray,
)]
pub enum Pressed {
    /// While held, sticks and triggers have their second function.
    #[strum(serialize = "Second function of sticks and triggers, while held")]
    Second,
    /// Burst, while held.
    Burst,
    /// The selected act, while held.
    #[strum(serialize = "Do the selected act")]
    Act,
    /// Select the next act.
    #[strum(serialize = "Select the next act")]
    NextAct,
    /// Open or close the mouth.
    #[strum(serialize = "Open, close the mouth")]
    Mouth,
    /// Reset and start the run.
    Restart,
    /// Pause or continue.
    #[strum(serialize = "Run, pause")]
    PlayPause,
    /// First or third person.
    #[strum(serialize = "First, third person")]
    Person,
    /// Weak links on or off.
    #[strum(serialize = "Weak links on, off")]
    WeakLinks,
    /// The next slower speed.
    Slower,
    /// The next faster speed.
    Faster,
}

impl Pressed {
    /// All, in the order shown.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Name on screen.
    pub fn words(self) -> &'static str {
        self.into()
    }
}

/// A stick or trigger with its function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AxisUse {
    /// The stick or trigger.
    pub axis: PadAxis,
    /// Whether this is its second function, used while the button for it is held.
    pub second: bool,
    /// Its function.
    pub steers: Steered,
    /// Whether the direction is inverted; `turned` in stored preferences.
    #[serde(rename = "turned")]
    pub inverted: bool,
}

/// Assignment of a pad.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Mapping {
    /// Sticks and triggers.
    pub axes: Vec<AxisUse>,
    /// Buttons.
    pub buttons: Vec<(PadButton, Pressed)>,
    /// Dead zone of sticks, as a share of the full deflection, 0 to 0.9.
    pub dead_zone: f64,
    /// Dead zone of triggers, 0 to 0.9.
    pub trigger_dead_zone: f64,
    /// Exponent of the deflection beyond the dead zone, 1 to 3.
    pub curve: f64,
    /// Strength of the rumble, 0 to 1.
    pub rumble: f64,
}

impl Default for Mapping {
    fn default() -> Self {
        Self::of_2012()
    }
}

impl Mapping {
    /// Presets with their names.
    pub fn presets() -> [(&'static str, Self); 2] {
        [("VWES 2012", Self::of_2012()), ("Feeding", Self::feeding())]
    }

    /// The preset of 2012, extended by flippers, acts and mouth.
    pub fn of_2012() -> Self {
        use PadAxis::{LeftTrigger, LeftX, LeftY, RightTrigger, RightX, RightY};
        let to = |axis, second, steers, inverted| AxisUse { axis, second, steers, inverted };
        let both = |axis, steers, inverted| {
            [to(axis, false, steers, inverted), to(axis, true, steers, inverted)]
        };
        let mut axes = Vec::new();
        axes.extend(both(LeftTrigger, Steered::Speed, false));
        axes.extend(both(LeftY, Steered::Pitch, false));
        axes.extend(both(LeftX, Steered::Roll, false));
        axes.extend([
            to(RightX, false, Steered::Yaw, true),
            to(RightX, true, Steered::FlipperTwist, false),
            to(RightY, true, Steered::FlipperRaise, false),
            to(RightTrigger, false, Steered::FlipperSweep, false),
            to(RightTrigger, true, Steered::FlipperSweep, true),
        ]);
        let buttons = vec![
            (PadButton::LeftShoulder, Pressed::Second),
            (PadButton::RightShoulder, Pressed::Burst),
            (PadButton::RightStick, Pressed::Act),
            (PadButton::LeftStick, Pressed::NextAct),
            (PadButton::South, Pressed::Mouth),
            (PadButton::Start, Pressed::Restart),
            (PadButton::Back, Pressed::PlayPause),
            (PadButton::East, Pressed::Person),
            (PadButton::North, Pressed::WeakLinks),
            (PadButton::Down, Pressed::Slower),
            (PadButton::Up, Pressed::Faster),
        ];
        Self { axes, buttons, dead_zone: 0.12, trigger_dead_zone: 0.12, curve: 1.0, rumble: 1.0 }
    }

    /// The preset of 2012 with the mouth on the right trigger.
    pub fn feeding() -> Self {
        let mut mapping = Self::of_2012();
        for uses in mapping
            .axes
            .iter_mut()
            .filter(|uses| uses.axis == PadAxis::RightTrigger && !uses.second)
        {
            (uses.steers, uses.inverted) = (Steered::Mouth, false);
        }
        mapping
    }

    /// Value of a stick or trigger for a deflection from -1 to 1, after dead zone and curve.
    pub fn shaped(&self, axis: PadAxis, value: f64) -> f64 {
        let dead =
            if axis.is_trigger() { self.trigger_dead_zone } else { self.dead_zone }.clamp(0.0, 0.9);
        if value.abs() <= dead {
            return 0.0;
        }
        ((value.abs() - dead) / (1.0 - dead)).clamp(0.0, 1.0).powf(self.curve.clamp(0.5, 4.0))
            * value.signum()
    }

    /// Function of a button.
    pub fn of_button(&self, button: PadButton) -> Option<Pressed> {
        self.buttons.iter().find(|(known, _)| *known == button).map(|(_, does)| *does)
    }

    /// Assigns a function to a button. Removes its former function, and the former button of this function.
    pub fn bind_button(&mut self, button: PadButton, does: Pressed) {
        self.buttons.retain(|(known, done)| *known != button && *done != does);
        self.buttons.push((button, does));
    }

    /// Assigns a function to a stick or trigger, as its first or second function.
    pub fn bind_axis(&mut self, uses: AxisUse) {
        self.axes.retain(|known| {
            (known.axis, known.second) != (uses.axis, uses.second)
                && (known.steers, known.second) != (uses.steers, uses.second)
        });
        self.axes.push(uses);
    }
}

/// A pair of keys, or one key, that steers while held.
#[derive(Clone, Copy, Debug)]
pub struct Steer {
    /// Function, as shown in the list of keys.
    pub what: &'static str,
    /// Key for the value 1.
    pub more: Key,
    /// Key for the value -1.
    pub less: Option<Key>,
    /// Control on the pad with the same function in the preset.
    pub pad: &'static str,
}

impl Steer {
    const fn pair(what: &'static str, more: Key, less: Key, pad: &'static str) -> Self {
        Self { what, more, less: Some(less), pad }
    }

    /// Names of its keys, for the list.
    pub fn keys(&self) -> String {
        let less = self.less.map_or_else(String::new, |key| format!(", {}", key.symbol_or_name()));
        format!("{}{less}", self.more.symbol_or_name())
    }

    fn held(&self, input: &InputState) -> f64 {
        let down = |key: Key| f64::from(u8::from(input.key_down(key)));
        down(self.more) - self.less.map_or(0.0, down)
    }
}

/// All keys that steer, in the order of the fields of [`HeldKeys`] without the burst, which is Shift.
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
    Steer { what: "Do the selected act", more: Key::G, less: None, pad: "right stick pressed" },
];

/// Keys that are held; each pair is one axis.
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
    /// The selected act.
    pub act: bool,
}

impl HeldKeys {
    /// Reads the held keys from egui's input.
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

#[cfg(test)]
mod tests {

    use super::*;

    #[test]
    fn the_deflection_beyond_the_dead_zone_is_scaled_and_raised_to_a_power() {
        let mapping = Mapping { dead_zone: 0.2, curve: 2.0, ..Mapping::of_2012() };
        assert!(mapping.shaped(PadAxis::LeftX, 0.2).abs() < 1e-12);
        assert!((mapping.shaped(PadAxis::LeftX, -1.0) + 1.0).abs() < 1e-12);
        assert!(
            (mapping.shaped(PadAxis::LeftX, 0.6) - 0.25).abs() < 1e-12,
            "half of the deflection beyond the dead zone, squared"
        );
        assert!(
            mapping.shaped(PadAxis::LeftTrigger, 0.2) > 0.0,
            "triggers have their own dead zone"
        );
    }

    #[test]
    fn a_new_assignment_replaces_the_former_ones() {
        let mut mapping = Mapping::of_2012();
        mapping.bind_button(PadButton::South, Pressed::Burst);
        assert_eq!(mapping.of_button(PadButton::South), Some(Pressed::Burst));
        assert_eq!(mapping.of_button(PadButton::RightShoulder), None);
        let uses = AxisUse {
            axis: PadAxis::RightTrigger,
            second: false,
            steers: Steered::Speed,
            inverted: false,
        };
        mapping.bind_axis(uses);
        let speed: Vec<_> = mapping
            .axes
            .iter()
            .filter(|uses| uses.steers == Steered::Speed && !uses.second)
            .collect();
        assert_eq!(speed, [&uses]);
    }

    #[test]
    fn a_mapping_is_read_as_it_was_written() {
        let text = serde_json::to_string(&Mapping::feeding()).unwrap();
        assert_eq!(serde_json::from_str::<Mapping>(&text).unwrap(), Mapping::feeding());
        assert_eq!(
            serde_json::from_str::<Mapping>("{\"curve\":2.0}").unwrap(),
            Mapping { curve: 2.0, ..Mapping::of_2012() }
        );
    }
}

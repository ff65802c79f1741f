//! Gamepads behind a trait, so that a test can use a script, and pulses of the pad for seabed, surface, contact, slip and parting.
//!
//! Pads over radio lag when pulses are sent too often, so pulses are at least 1/30 s apart and end by themselves.

use std::collections::VecDeque;
use std::time::Duration;

use endline_sim::metrics::{Event, EventKind};
use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

/// A stick or trigger.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantArray,
)]
pub enum PadAxis {
    /// Left stick, right is 1.
    #[strum(serialize = "left stick, sideways")]
    LeftX,
    /// Left stick, up (away from the pilot) is 1.
    #[strum(serialize = "left stick, up and down")]
    LeftY,
    /// Right stick, right is 1.
    #[strum(serialize = "right stick, sideways")]
    RightX,
    /// Right stick, up (away from the pilot) is 1.
    #[strum(serialize = "right stick, up and down")]
    RightY,
    /// Left trigger, pulled is 1.
    #[strum(serialize = "left trigger")]
    LeftTrigger,
    /// Right trigger, pulled is 1.
    #[strum(serialize = "right trigger")]
    RightTrigger,
}

impl PadAxis {
    /// All sticks and triggers.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Name on screen.
    pub fn words(self) -> &'static str {
        self.into()
    }

    /// Whether it is a trigger, 0 to 1.
    pub fn is_trigger(self) -> bool {
        matches!(self, Self::LeftTrigger | Self::RightTrigger)
    }
}

/// A button the pilot uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
pub enum PadButton {
    /// Lower face button (A).
    #[strum(serialize = "A")]
    South,
    /// Right face button (B).
    #[strum(serialize = "B")]
    East,
    /// Upper face button (Y).
    #[strum(serialize = "Y")]
    North,
    /// Left face button (X).
    #[strum(serialize = "X")]
    West,
    /// Up on the cross.
    #[strum(serialize = "cross up")]
    Up,
    /// Down on the cross.
    #[strum(serialize = "cross down")]
    Down,
    /// Left on the cross.
    #[strum(serialize = "cross left")]
    Left,
    /// Right on the cross.
    #[strum(serialize = "cross right")]
    Right,
    /// Left shoulder.
    #[strum(serialize = "left shoulder")]
    LeftShoulder,
    /// Right shoulder.
    #[strum(serialize = "right shoulder")]
    RightShoulder,
    /// Left stick pressed.
    #[strum(serialize = "left stick pressed")]
    LeftStick,
    /// Right stick pressed.
    #[strum(serialize = "right stick pressed")]
    RightStick,
    /// Start.
    Start,
    /// Back, also called select.
    Back,
}

impl PadButton {
    /// Name on screen.
    pub fn words(self) -> &'static str {
        self.into()
    }
}

/// An event of a pad.
#[derive(Clone, Debug, PartialEq)]
pub enum PadEvent {
    /// A pad with this name was connected.
    Connected(String),
    /// The pad was disconnected.
    Disconnected,
    /// A stick or trigger moved to a value, -1 to 1 (triggers 0 to 1).
    Moved(PadAxis, f64),
    /// A button was pressed.
    Pressed(PadButton),
    /// A button was released.
    Released(PadButton),
}

/// A source of pad events.
pub trait PadSource {
    /// Appends the events since the last call.
    fn poll(&mut self, out: &mut Vec<PadEvent>);

    /// Vibrates the pad with a strength of 0 to 1 for a time, if it can.
    fn rumble(&mut self, strength: f64, long: Duration) {
        let _ = (strength, long);
    }
}

/// Pads of this machine, by the library gilrs.
pub struct GilrsPads {
    gilrs: gilrs::Gilrs,
    announced: bool,
    /// The current pulse; dropping it ends it.
    pulse: Option<gilrs::ff::Effect>,
}

impl GilrsPads {
    /// Opens the pads of this machine. That there is none is not an error.
    pub fn new() -> Result<Self, String> {
        let gilrs =
            gilrs::Gilrs::new().map_err(|error| format!("gamepads cannot be read: {error}"))?;
        Ok(Self { gilrs, announced: false, pulse: None })
    }
}

impl PadSource for GilrsPads {
    fn poll(&mut self, out: &mut Vec<PadEvent>) {
        if !self.announced {
            self.announced = true;
            out.extend(
                self.gilrs.gamepads().map(|(_, pad)| PadEvent::Connected(pad.name().to_owned())),
            );
        }
        while let Some(event) = self.gilrs.next_event() {
            let translated = match event.event {
                gilrs::EventType::Connected => {
                    Some(PadEvent::Connected(self.gilrs.gamepad(event.id).name().to_owned()))
                }
                gilrs::EventType::Disconnected => Some(PadEvent::Disconnected),
                gilrs::EventType::AxisChanged(axis, value, _) => {
                    axis_of(axis).map(|axis| PadEvent::Moved(axis, f64::from(value)))
                }
                gilrs::EventType::ButtonChanged(gilrs::Button::LeftTrigger2, value, _) => {
                    Some(PadEvent::Moved(PadAxis::LeftTrigger, f64::from(value)))
                }
                gilrs::EventType::ButtonPressed(button, _) => {
                    button_of(button).map(PadEvent::Pressed)
                }
                gilrs::EventType::ButtonReleased(button, _) => {
                    button_of(button).map(PadEvent::Released)
                }
                gilrs::EventType::ButtonChanged(gilrs::Button::RightTrigger2, value, _) => {
                    Some(PadEvent::Moved(PadAxis::RightTrigger, f64::from(value)))
                }
                _ => None,
            };
            out.extend(translated);
        }
    }

    fn rumble(&mut self, strength: f64, long: Duration) {
        use gilrs::ff::{BaseEffect, BaseEffectType, EffectBuilder, Replay, Ticks};
        let pads: Vec<gilrs::GamepadId> = self
            .gilrs
            .gamepads()
            .filter(|(_, pad)| pad.is_ff_supported())
            .map(|(id, _)| id)
            .collect();
        if pads.is_empty() {
            return;
        }
        let magnitude = (strength.clamp(0.0, 1.0) * f64::from(u16::MAX)) as u16;
        let long = u32::try_from(long.as_millis()).unwrap_or(u32::MAX);
        let scheduling = Replay { play_for: Ticks::from_ms(long), ..Replay::default() };
        let effect = BaseEffect {
            kind: BaseEffectType::Strong { magnitude },
            scheduling,
            ..BaseEffect::default()
        };
        // A pad that cannot vibrate still steers.
        self.pulse =
            EffectBuilder::new().add_effect(effect).gamepads(&pads).finish(&mut self.gilrs).ok();
        let _ = self.pulse.as_ref().map(gilrs::ff::Effect::play);
    }
}

fn axis_of(axis: gilrs::Axis) -> Option<PadAxis> {
    match axis {
        gilrs::Axis::LeftStickX => Some(PadAxis::LeftX),
        gilrs::Axis::LeftStickY => Some(PadAxis::LeftY),
        gilrs::Axis::RightStickX => Some(PadAxis::RightX),
        gilrs::Axis::RightStickY => Some(PadAxis::RightY),
        _ => None,
    }
}

fn button_of(button: gilrs::Button) -> Option<PadButton> {
    match button {
        gilrs::Button::South => Some(PadButton::South),
        gilrs::Button::East => Some(PadButton::East),
        gilrs::Button::North => Some(PadButton::North),
        gilrs::Button::West => Some(PadButton::West),
        gilrs::Button::DPadUp => Some(PadButton::Up),
        gilrs::Button::DPadDown => Some(PadButton::Down),
        gilrs::Button::DPadLeft => Some(PadButton::Left),
        gilrs::Button::DPadRight => Some(PadButton::Right),
        gilrs::Button::LeftTrigger => Some(PadButton::LeftShoulder),
        gilrs::Button::RightTrigger => Some(PadButton::RightShoulder),
        gilrs::Button::LeftThumb => Some(PadButton::LeftStick),
        gilrs::Button::RightThumb => Some(PadButton::RightStick),
        gilrs::Button::Start => Some(PadButton::Start),
        gilrs::Button::Select => Some(PadButton::Back),
        _ => None,
    }
}

/// A pad that replays a script, one entry for each poll.
#[derive(Clone, Debug, Default)]
pub struct ScriptedPad {
    /// Events of each remaining poll.
    pub script: VecDeque<Vec<PadEvent>>,
}

impl PadSource for ScriptedPad {
    fn poll(&mut self, out: &mut Vec<PadEvent>) {
        out.extend(self.script.pop_front().unwrap_or_default());
    }
}

/// Least time between two pulses [s].
const APART_S: f64 = 1.0 / 30.0;

/// A pulse of the pad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Strength, 0 to 1.
    pub strength: f64,
    /// Duration [s].
    pub long_s: f64,
}

/// The pulse for a kind of event; `None` if it has none.
pub fn pulse(kind: EventKind) -> Option<Pulse> {
    let (strength, long_s) = match kind {
        EventKind::LinkParted | EventKind::LineParted => (1.0, 0.35),
        EventKind::AtSeabed => (0.7, 0.25),
        EventKind::Contact => (0.6, 0.2),
        EventKind::AtSurface => (0.5, 0.3),
        EventKind::Slip => (0.25, 0.1),
        _ => return None,
    };
    Some(Pulse { strength, long_s })
}

/// Converts the events of a run into pulses.
#[derive(Clone, Debug, Default)]
pub struct Rumble {
    seen: usize,
    last_s: Option<f64>,
    /// The last pulse and its start [s].
    felt: Option<(Pulse, f64)>,
}

impl Rumble {
    /// Returns the strongest pulse of the events since the last call, unless the last pulse was too recent.
    pub fn feel(&mut self, events: &[Event], now_s: f64) -> Option<Pulse> {
        // A run that was reset has fewer events than were seen.
        let fresh = events.get(self.seen..).unwrap_or_default();
        if events.len() < self.seen {
            self.seen = events.len();
            return None;
        }
        let strongest = fresh
            .iter()
            .filter_map(|event| pulse(event.kind))
            .max_by(|a, b| a.strength.total_cmp(&b.strength));
        if strongest.is_some() && self.last_s.is_some_and(|last_s| now_s - last_s < APART_S) {
            return None;
        }
        self.seen = events.len();
        if let Some(pulse) = strongest {
            self.last_s = Some(now_s);
            self.felt = Some((pulse, now_s));
        }
        strongest
    }

    /// Ignores all events so far.
    pub fn skip(&mut self, events: &[Event]) {
        self.seen = events.len();
    }

    /// Strength of the last pulse at a time, fading to zero, for display on screen.
    pub fn strength(&self, now_s: f64) -> f64 {
        let Some((pulse, begun_s)) = self.felt else { return 0.0 };
        let left = 1.0 - (now_s - begun_s) / (2.0 * pulse.long_s);
        pulse.strength * left.clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {

    use super::*;

    fn event(kind: EventKind) -> Event {
        Event { time_s: 0.0, kind, subject: String::new(), value: 0.0 }
    }

    #[test]
    fn the_strongest_new_event_gives_one_pulse_and_pulses_keep_their_distance() {
        let mut rumble = Rumble::default();
        let events = [event(EventKind::Slip), event(EventKind::LinkParted), event(EventKind::Wrap)];
        assert_eq!(rumble.feel(&events, 1.0), pulse(EventKind::LinkParted));
        assert_eq!(rumble.feel(&events, 2.0), None);
        let more = [events.as_slice(), &[event(EventKind::Contact)]].concat();
        assert_eq!(rumble.feel(&more, 1.01), None, "too soon after the last pulse");
        assert_eq!(rumble.feel(&more, 1.1), pulse(EventKind::Contact), "the event is not lost");
        assert_eq!(rumble.feel(&[], 3.0), None, "the run was reset");
        assert_eq!(rumble.feel(&[event(EventKind::Slip)], 4.0), pulse(EventKind::Slip));
        assert!(rumble.strength(4.05) > 0.0 && rumble.strength(5.0) <= 0.0);
    }
}

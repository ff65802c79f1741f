//! Combines pad and keyboard into controls and actions, by the mapping.
//!
//! If the pad is disconnected while it steers, its last input holds for a moment. Then the whale glides until a pad or the keyboard
//! steers again.

use std::time::Duration;

use endline_sdk::Controls;

use super::mapping::{HeldKeys, Mapping, Pressed, Steered};
use super::pad::{PadAxis, PadButton, PadEvent, PadSource};

/// An action of the pilot other than steering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PilotAction {
    /// Reset and start the run.
    Restart,
    /// Pause or continue.
    PlayPause,
    /// First or third person.
    Person,
    /// Weak links on or off.
    WeakLinks,
    /// The next act of the whale's motion.
    NextAct,
    /// The next slower speed.
    Slower,
    /// The next faster speed.
    Faster,
}

/// What steers the whale.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hands {
    /// Pad or keyboard.
    #[default]
    On,
    /// The pad was disconnected; its last input holds for a moment.
    Holding,
    /// The pad was disconnected, and the whale glides.
    Gliding,
}

/// Time for which the last input of a disconnected pad holds [s].
const HOLD_S: f64 = 0.5;
/// Rates at which the throttle and the other axes follow their keys [1/s].
const THROTTLE_RATE: f64 = 0.5;
const KEY_RATE: f64 = 4.0;

/// State of the controls.
#[derive(Default)]
pub struct Pilot {
    source: Option<Box<dyn PadSource>>,
    events: Vec<PadEvent>,
    pad_name: Option<String>,
    /// Assignment of the pad.
    pub mapping: Mapping,
    stick: Stick,
    throttle: f64,
    smooth: Smooth,
    mouth_open: bool,
    /// Time since the pad was disconnected [s].
    lost_s: Option<f64>,
    /// Last button pressed, for the mapping editor.
    last_pressed: Option<PadButton>,
    /// Index of the selected act.
    act: usize,
    /// Whether pushing the stick (or the up arrow) pitches the nose down, as in an aeroplane.
    pub invert_pitch: bool,
}

#[derive(Clone, Debug, Default)]
struct Stick {
    axes: [f64; PadAxis::ALL.len()],
    second: bool,
    burst: bool,
    act: bool,
    /// Whether the act was requested since the controls were last read, so that a short press is not lost.
    act_pressed: bool,
}

/// Axes of keys, which change gradually so that a short press is a small correction.
#[derive(Clone, Copy, Debug, Default)]
struct Smooth {
    pitch: f64,
    roll: f64,
    yaw: f64,
    flipper_raise: f64,
    flipper_twist: f64,
    flipper_sweep: f64,
}

impl Pilot {
    /// Controls with a pad, or with the keyboard only.
    pub fn new(source: Option<Box<dyn PadSource>>) -> Self {
        Self { source, ..Self::default() }
    }

    /// Name of the connected pad.
    pub fn pad_name(&self) -> Option<&str> {
        self.pad_name.as_deref()
    }

    /// What steers the whale.
    pub fn hands(&self) -> Hands {
        match self.lost_s {
            None => Hands::On,
            Some(lost_s) if lost_s < HOLD_S => Hands::Holding,
            Some(_) => Hands::Gliding,
        }
    }

    /// Raw deflection of a stick or trigger.
    pub fn axis(&self, axis: PadAxis) -> f64 {
        self.stick.axes[axis as usize]
    }

    /// Returns the last button pressed, once.
    pub fn take_pressed(&mut self) -> Option<PadButton> {
        self.last_pressed.take()
    }

    /// Vibrates the pad, scaled by the strength in the mapping.
    pub fn rumble(&mut self, strength: f64, long_s: f64) {
        let strength = strength * self.mapping.rumble;
        if let (Some(source), true) = (&mut self.source, strength > 0.0) {
            source.rumble(strength, Duration::from_secs_f64(long_s.clamp(0.0, 2.0)));
        }
    }

    /// Reads the events of the pad and returns the requested actions.
    pub fn poll_pad(&mut self) -> Vec<PilotAction> {
        let Some(source) = &mut self.source else { return Vec::new() };
        let mut events = std::mem::take(&mut self.events);
        source.poll(&mut events);
        let actions = events.drain(..).filter_map(|event| self.take(event)).collect();
        self.events = events;
        actions
    }

    fn take(&mut self, event: PadEvent) -> Option<PilotAction> {
        match event {
            PadEvent::Connected(name) => (self.pad_name, self.lost_s) = (Some(name), None),
            // The last input holds for a moment; `watch_pad` releases it.
            PadEvent::Disconnected => (self.pad_name, self.lost_s) = (None, Some(0.0)),
            PadEvent::Moved(axis, value) => {
                self.stick.axes[axis as usize] =
                    if value.is_finite() { value.clamp(-1.0, 1.0) } else { 0.0 };
            }
            PadEvent::Pressed(button) => {
                self.last_pressed = Some(button);
                return self.press(self.mapping.of_button(button)?, true);
            }
            PadEvent::Released(button) => {
                return self.press(self.mapping.of_button(button)?, false);
            }
        }
        None
    }

    fn press(&mut self, does: Pressed, down: bool) -> Option<PilotAction> {
        match does {
            Pressed::Second => self.stick.second = down,
            Pressed::Burst => self.stick.burst = down,
            Pressed::Act => {
                (self.stick.act, self.stick.act_pressed) = (down, self.stick.act_pressed || down)
            }
            Pressed::Mouth if down => self.toggle_mouth(),
            Pressed::NextAct if down => return Some(PilotAction::NextAct),
            Pressed::Restart if down => return Some(PilotAction::Restart),
            Pressed::PlayPause if down => return Some(PilotAction::PlayPause),
            Pressed::Person if down => return Some(PilotAction::Person),
            Pressed::WeakLinks if down => return Some(PilotAction::WeakLinks),
            Pressed::Slower if down => return Some(PilotAction::Slower),
            Pressed::Faster if down => return Some(PilotAction::Faster),
            _ => {}
        }
        None
    }

    /// Index of the selected act, which may exceed the number of acts.
    pub fn act(&self) -> usize {
        self.act
    }

    /// Whether the mouth is open.
    pub fn mouth_open(&self) -> bool {
        self.mouth_open
    }

    /// Opens or closes the mouth.
    pub fn toggle_mouth(&mut self) {
        self.mouth_open = !self.mouth_open;
    }

    /// Selects the next act of the whale's motion.
    pub fn next_act(&mut self, acts: usize) {
        self.act = if acts == 0 { 0 } else { (self.act + 1) % acts };
    }

    /// Selects an act by its index.
    pub fn choose_act(&mut self, act: usize) {
        self.act = act;
    }

    /// Index of the selected act, limited to the number of acts; `None` if there are none.
    pub fn chosen_act(&self, acts: usize) -> Option<usize> {
        (acts > 0).then(|| self.act.min(acts - 1))
    }

    /// Sets the throttle of the keyboard, 0 to 1.
    pub fn set_throttle(&mut self, throttle: f64) {
        self.throttle = throttle.clamp(0.0, 1.0);
    }

    /// Sum of the values of all sticks and triggers with a function.
    fn steered(&self, steered: Steered) -> f64 {
        let uses = self
            .mapping
            .axes
            .iter()
            .filter(|uses| uses.steers == steered && uses.second == self.stick.second);
        let values = uses.map(|uses| {
            self.mapping.shaped(uses.axis, self.axis(uses.axis))
                * if uses.inverted { -1.0 } else { 1.0 }
        });
        values.sum::<f64>().clamp(-1.0, 1.0)
    }

    /// Releases the last input of a disconnected pad after its time, or as soon as a key is held.
    fn watch_pad(&mut self, keys: &HeldKeys, elapsed_s: f64) {
        let Some(lost_s) = &mut self.lost_s else { return };
        let held = *lost_s < HOLD_S;
        *lost_s += elapsed_s;
        if held && *lost_s >= HOLD_S {
            (self.stick, self.throttle) = (Stick::default(), 0.0);
        }
        if *keys != HeldKeys::default() {
            (self.stick, self.lost_s) = (Stick::default(), None);
        }
    }

    /// Controls after `elapsed_s` seconds with these keys held, pad included, for a motion with a number of acts.
    pub fn controls(&mut self, keys: &HeldKeys, acts: usize, elapsed_s: f64) -> Controls {
        self.watch_pad(keys, elapsed_s);
        self.throttle = (self.throttle + keys.throttle * THROTTLE_RATE * elapsed_s).clamp(0.0, 1.0);
        let step = KEY_RATE * elapsed_s;
        self.smooth.follow(keys, step);
        let up = if self.invert_pitch { -1.0 } else { 1.0 };
        let sum = |steered: Steered, key: f64| (self.steered(steered) + key).clamp(-1.0, 1.0);
        let asked = self.stick.act || self.stick.act_pressed || keys.act;
        let act = self.chosen_act(acts).filter(|_| asked).map_or(0.0, |act| (act + 1) as f64);
        let controls = Controls {
            speed: self.throttle.max(self.steered(Steered::Speed)),
            pitch: up * sum(Steered::Pitch, self.smooth.pitch),
            roll: sum(Steered::Roll, self.smooth.roll),
            yaw: sum(Steered::Yaw, self.smooth.yaw),
            burst: f64::from(u8::from(self.stick.burst || keys.burst)),
            mouth: f64::from(u8::from(self.mouth_open)).max(self.steered(Steered::Mouth)),
            flipper_raise: sum(Steered::FlipperRaise, self.smooth.flipper_raise),
            flipper_twist: sum(Steered::FlipperTwist, self.smooth.flipper_twist),
            flipper_sweep: sum(Steered::FlipperSweep, self.smooth.flipper_sweep),
            act,
        };
        self.stick.act_pressed = false;
        controls
    }
}

impl Smooth {
    fn follow(&mut self, keys: &HeldKeys, step: f64) {
        let pairs = [
            (&mut self.pitch, keys.pitch),
            (&mut self.roll, keys.roll),
            (&mut self.yaw, keys.yaw),
            (&mut self.flipper_raise, keys.flipper_raise),
            (&mut self.flipper_twist, keys.flipper_twist),
            (&mut self.flipper_sweep, keys.flipper_sweep),
        ];
        for (value, wanted) in pairs {
            *value += (wanted - *value).clamp(-step, step);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::pad::ScriptedPad;
    use super::*;

    fn flown(script: Vec<Vec<PadEvent>>) -> (Pilot, Vec<PilotAction>) {
        let polls = script.len();
        let mut pilot = Pilot::new(Some(Box::new(ScriptedPad { script: script.into() })));
        let actions = (0..polls).flat_map(|_| pilot.poll_pad()).collect();
        (pilot, actions)
    }

    #[test]
    fn the_preset_of_2012_gives_controls_and_actions() {
        let (mut pilot, actions) = flown(vec![
            vec![
                PadEvent::Connected("pad".into()),
                PadEvent::Moved(PadAxis::LeftTrigger, 1.0),
                PadEvent::Moved(PadAxis::LeftY, 1.0),
            ],
            vec![
                PadEvent::Moved(PadAxis::LeftX, -1.0),
                PadEvent::Moved(PadAxis::RightX, 1.0),
                PadEvent::Pressed(PadButton::RightShoulder),
            ],
            vec![
                PadEvent::Pressed(PadButton::Start),
                PadEvent::Pressed(PadButton::Back),
                PadEvent::Pressed(PadButton::East),
            ],
            vec![PadEvent::Pressed(PadButton::North)],
        ]);
        assert_eq!(
            actions,
            [
                PilotAction::Restart,
                PilotAction::PlayPause,
                PilotAction::Person,
                PilotAction::WeakLinks
            ]
        );
        let flown = pilot.controls(&HeldKeys::default(), 2, 0.1);
        let wanted = Controls {
            speed: 1.0,
            pitch: 1.0,
            roll: -1.0,
            yaw: -1.0,
            burst: 1.0,
            ..Controls::default()
        };
        assert_eq!(
            flown, wanted,
            "trigger speed; stick up nose up, left roll to port; right stick right yaws to starboard"
        );
    }

    #[test]
    fn a_stick_within_its_dead_zone_gives_zero() {
        let (mut pilot, _) = flown(vec![vec![
            PadEvent::Moved(PadAxis::LeftX, 0.1),
            PadEvent::Moved(PadAxis::LeftTrigger, 0.8),
        ]]);
        let controls = pilot.controls(&HeldKeys::default(), 2, 0.1);
        assert!(controls.roll.abs() < 1e-12 && controls.speed > 0.7);
    }

    #[test]
    fn the_last_input_of_a_disconnected_pad_holds_for_a_moment_then_the_whale_glides() {
        let lost = || {
            flown(vec![vec![
                PadEvent::Moved(PadAxis::LeftTrigger, 0.8),
                PadEvent::Pressed(PadButton::RightShoulder),
                PadEvent::Disconnected,
            ]])
            .0
        };
        let mut pilot = lost();
        let held = pilot.controls(&HeldKeys::default(), 2, 0.1);
        assert!(
            held.speed > 0.7 && held.burst > 0.5 && pilot.hands() == Hands::Holding,
            "{held:?}"
        );
        pilot.controls(&HeldKeys::default(), 2, 0.3);
        assert_eq!(pilot.controls(&HeldKeys::default(), 2, 0.2), Controls::default());
        assert_eq!(pilot.hands(), Hands::Gliding);
        pilot.take(PadEvent::Connected("pad".into()));
        assert_eq!(pilot.hands(), Hands::On, "the pad is connected again");
        let mut pilot = lost();
        let keys = HeldKeys { yaw: 1.0, ..HeldKeys::default() };
        assert!(
            pilot.controls(&keys, 2, 0.1).yaw > 0.3 && pilot.hands() == Hands::On,
            "the keyboard takes over at once"
        );
    }

    #[test]
    fn the_feeding_preset_opens_the_mouth_with_the_right_trigger() {
        let (mut pilot, _) = flown(vec![vec![PadEvent::Moved(PadAxis::RightTrigger, 1.0)]]);
        pilot.mapping = Mapping::feeding();
        let controls = pilot.controls(&HeldKeys::default(), 0, 0.1);
        assert_eq!(controls, Controls { mouth: 1.0, ..Controls::default() });
    }

    #[test]
    fn keys_change_the_speed_lastingly_and_steer_gradually() {
        let mut pilot = Pilot::new(None);
        let held = HeldKeys { throttle: 1.0, yaw: 1.0, ..HeldKeys::default() };
        let first = pilot.controls(&held, 2, 0.1);
        assert!((first.speed - 0.05).abs() < 1e-12 && (first.yaw - 0.4).abs() < 1e-12);
        for _ in 0..40 {
            pilot.controls(&held, 2, 0.1);
        }
        let released = pilot.controls(&HeldKeys::default(), 2, 1.0);
        assert!((released.speed - 1.0).abs() < 1e-12, "the speed stays after the key is released");
        assert!(released.yaw.abs() < 1e-12, "the turn ends");
    }

    #[test]
    fn every_control_stays_in_its_range_for_any_input() {
        let (mut pilot, _) = flown(vec![vec![
            PadEvent::Moved(PadAxis::LeftY, 7.0),
            PadEvent::Moved(PadAxis::RightX, f64::NAN),
        ]]);
        let held = HeldKeys {
            throttle: 1.0,
            pitch: 1.0,
            roll: 1.0,
            yaw: 1.0,
            burst: true,
            flipper_raise: -1.0,
            flipper_twist: 1.0,
            flipper_sweep: -1.0,
            act: true,
        };
        for _ in 0..100 {
            let c = pilot.controls(&held, 2, 0.7);
            for value in [c.pitch, c.roll, c.yaw, c.flipper_raise, c.flipper_twist, c.flipper_sweep]
            {
                assert!((-1.0..=1.0).contains(&value));
            }
            assert!((0.0..=1.0).contains(&c.speed) && (0.0..=1.0).contains(&c.burst));
        }
    }

    #[test]
    fn pitch_can_be_inverted() {
        let (mut pilot, _) = flown(vec![vec![PadEvent::Moved(PadAxis::LeftY, 1.0)]]);
        pilot.invert_pitch = true;
        assert!((pilot.controls(&HeldKeys::default(), 2, 0.1).pitch + 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_left_shoulder_button_switches_the_right_stick_to_the_flippers() {
        let moved = |axis, value| PadEvent::Moved(axis, value);
        let (mut pilot, _) = flown(vec![vec![
            moved(PadAxis::RightX, 1.0),
            moved(PadAxis::RightY, -1.0),
            moved(PadAxis::RightTrigger, 1.0),
        ]]);
        let steering = Controls { yaw: -1.0, flipper_sweep: 1.0, ..Controls::default() };
        assert_eq!(pilot.controls(&HeldKeys::default(), 0, 0.1), steering);
        pilot.take(PadEvent::Pressed(PadButton::LeftShoulder));
        let flippers = Controls {
            yaw: 0.0,
            flipper_raise: -1.0,
            flipper_twist: 1.0,
            flipper_sweep: -1.0,
            ..Controls::default()
        };
        assert_eq!(pilot.controls(&HeldKeys::default(), 0, 0.1), flippers);
        pilot.take(PadEvent::Released(PadButton::LeftShoulder));
        assert_eq!(pilot.controls(&HeldKeys::default(), 0, 0.1), steering);
    }

    #[test]
    fn acts_are_selected_in_turn_and_last_while_requested() {
        let mut pilot = Pilot::new(None);
        let act = |pilot: &mut Pilot, keys: &HeldKeys| pilot.controls(keys, 3, 0.1).act as usize;
        let held = HeldKeys { act: true, ..HeldKeys::default() };
        assert_eq!([act(&mut pilot, &HeldKeys::default()), act(&mut pilot, &held)], [0, 1]);
        assert_eq!(pilot.take(PadEvent::Pressed(PadButton::LeftStick)), Some(PilotAction::NextAct));
        pilot.next_act(3);
        // A press shorter than a frame gives the act once.
        pilot.take(PadEvent::Pressed(PadButton::RightStick));
        pilot.take(PadEvent::Released(PadButton::RightStick));
        assert_eq!(
            [act(&mut pilot, &HeldKeys::default()), act(&mut pilot, &HeldKeys::default())],
            [2, 0]
        );
        pilot.next_act(3);
        pilot.next_act(3);
        assert_eq!(act(&mut pilot, &held), 1, "the first act follows the last");
        assert_eq!(
            pilot.controls(&held, 0, 0.1).act.to_bits(),
            0.0_f64.to_bits(),
            "a motion without acts"
        );
    }
}

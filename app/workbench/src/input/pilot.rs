//! Pad and keyboard together: the preset of 2012 as controls and actions.
//!
//! Left trigger speed, left stick pitch and roll, right stick yaw, right shoulder burst; Start
//! restarts, Back pauses, B changes between first and third person, Y switches the weak links.
//! Added since: A the mouth; while the left shoulder is held the right stick raises and twists the flippers; the right
//! trigger sweeps them forward, aft with the left shoulder; the left stick pressed chooses the next act of the motion,
//! the right one pressed asks for it as long as it is held.

use endline_sdk::Controls;

use super::keys::HeldKeys;
use super::pad::{PadAxis, PadButton, PadEvent, PadSource};

/// What a pilot asks for besides steering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PilotAction {
    /// Back to the start and go.
    Restart,
    /// Pause, or go on.
    PlayPause,
    /// First or third person.
    Person,
    /// Weak links on or off.
    WeakLinks,
    /// The next act of the whale's motion.
    NextAct,
}

/// Share of a stick's way around its middle that counts as the middle.
const DEAD_ZONE: f64 = 0.12;
/// How fast the throttle follows its keys, and smooth axes theirs [1/s].
const THROTTLE_RATE: f64 = 0.5;
const KEY_RATE: f64 = 4.0;

/// The state of a pilot's hands.
#[derive(Default)]
pub struct Pilot {
    source: Option<Box<dyn PadSource>>,
    events: Vec<PadEvent>,
    pad_name: Option<String>,
    stick: Stick,
    throttle: f64,
    smooth: Smooth,
    mouth_open: bool,
    /// Index of the chosen act.
    act: usize,
    /// Whether pushing the stick (or the up arrow) puts the nose down, as in an aeroplane.
    pub invert_pitch: bool,
}

#[derive(Clone, Copy, Debug, Default)]
struct Stick {
    left_x: f64,
    left_y: f64,
    right_x: f64,
    right_y: f64,
    left_trigger: f64,
    right_trigger: f64,
    left_shoulder: bool,
    right_shoulder: bool,
    act: bool,
    /// Whether the act was asked for since the controls were last read: a short press counts.
    act_pressed: bool,
}

/// Key axes brought smoothly to their ends, so that a tap is a small correction.
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
    /// A pilot with a pad, or with the keyboard alone.
    #[must_use]
    pub fn new(source: Option<Box<dyn PadSource>>) -> Self {
        Self { source, ..Self::default() }
    }

    /// Name of the connected pad.
    #[must_use]
    pub fn pad_name(&self) -> Option<&str> {
        self.pad_name.as_deref()
    }

    /// Takes in the pad and answers the actions asked for.
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
            PadEvent::Connected(name) => self.pad_name = Some(name),
            PadEvent::Disconnected => (self.pad_name, self.stick) = (None, Stick::default()),
            PadEvent::Moved(axis, value) => self.stick.set(axis, value),
            PadEvent::Pressed(PadButton::LeftShoulder) => self.stick.left_shoulder = true,
            PadEvent::Released(PadButton::LeftShoulder) => self.stick.left_shoulder = false,
            PadEvent::Pressed(PadButton::RightShoulder) => self.stick.right_shoulder = true,
            PadEvent::Released(PadButton::RightShoulder) => self.stick.right_shoulder = false,
            PadEvent::Pressed(PadButton::RightStick) => (self.stick.act, self.stick.act_pressed) = (true, true),
            PadEvent::Released(PadButton::RightStick) => self.stick.act = false,
            PadEvent::Pressed(PadButton::LeftStick) => return Some(PilotAction::NextAct),
            PadEvent::Pressed(PadButton::South) => self.toggle_mouth(),
            PadEvent::Pressed(PadButton::Start) => return Some(PilotAction::Restart),
            PadEvent::Pressed(PadButton::Back) => return Some(PilotAction::PlayPause),
            PadEvent::Pressed(PadButton::East) => return Some(PilotAction::Person),
            PadEvent::Pressed(PadButton::North) => return Some(PilotAction::WeakLinks),
            PadEvent::Released(_) => {}
        }
        None
    }

    /// Opens or closes the mouth.
    pub fn toggle_mouth(&mut self) {
        self.mouth_open = !self.mouth_open;
    }

    /// Chooses the next of the acts that the whale's motion declares.
    pub fn next_act(&mut self, acts: usize) {
        self.act = if acts == 0 { 0 } else { (self.act + 1) % acts };
    }

    /// Chooses an act by its index.
    pub fn choose_act(&mut self, act: usize) {
        self.act = act;
    }

    /// Index of the chosen act among so many; `None` where there are none.
    #[must_use]
    pub fn chosen_act(&self, acts: usize) -> Option<usize> {
        (acts > 0).then(|| self.act.min(acts - 1))
    }

    /// Sets the keyboard's throttle, 0 to 1: the speed it starts from.
    pub fn set_throttle(&mut self, throttle: f64) {
        self.throttle = throttle.clamp(0.0, 1.0);
    }

    /// The controls after `elapsed_s` seconds of these keys, pad included, for a motion with so many acts.
    pub fn controls(&mut self, keys: &HeldKeys, acts: usize, elapsed_s: f64) -> Controls {
        self.throttle = (self.throttle + keys.throttle * THROTTLE_RATE * elapsed_s).clamp(0.0, 1.0);
        let step = KEY_RATE * elapsed_s;
        self.smooth.follow(keys, step);
        let up = if self.invert_pitch { -1.0 } else { 1.0 };
        let sum = |stick: f64, key: f64| (live(stick) + key).clamp(-1.0, 1.0);
        let stick = self.stick;
        // The left shoulder gives the right hand to the flippers.
        let (turn, flippers) = if stick.left_shoulder { (0.0, [stick.right_x, stick.right_y]) } else { (stick.right_x, [0.0; 2]) };
        let sweep = if stick.left_shoulder { -stick.right_trigger } else { stick.right_trigger };
        let asked = stick.act || std::mem::take(&mut self.stick.act_pressed) || keys.act;
        let act = self.chosen_act(acts).filter(|_| asked).map_or(0.0, |act| (act + 1) as f64);
        Controls {
            speed: self.throttle.max(live(stick.left_trigger)),
            pitch: up * sum(stick.left_y, self.smooth.pitch),
            roll: sum(stick.left_x, self.smooth.roll),
            yaw: sum(-turn, self.smooth.yaw),
            burst: f64::from(u8::from(stick.right_shoulder || keys.burst)),
            mouth: f64::from(u8::from(self.mouth_open)),
            flipper_raise: sum(flippers[1], self.smooth.flipper_raise),
            flipper_twist: sum(flippers[0], self.smooth.flipper_twist),
            flipper_sweep: sum(sweep, self.smooth.flipper_sweep),
            act,
        }
    }
}

impl Stick {
    fn set(&mut self, axis: PadAxis, value: f64) {
        let slot = match axis {
            PadAxis::LeftX => &mut self.left_x,
            PadAxis::LeftY => &mut self.left_y,
            PadAxis::RightX => &mut self.right_x,
            PadAxis::RightY => &mut self.right_y,
            PadAxis::LeftTrigger => &mut self.left_trigger,
            PadAxis::RightTrigger => &mut self.right_trigger,
        };
        *slot = if value.is_finite() { value.clamp(-1.0, 1.0) } else { 0.0 };
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

/// A stick outside its dead zone, stretched so that it starts from zero.
fn live(value: f64) -> f64 {
    if value.abs() <= DEAD_ZONE { 0.0 } else { (value.abs() - DEAD_ZONE) / (1.0 - DEAD_ZONE) * value.signum() }
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
    fn the_preset_of_2012() {
        let (mut pilot, actions) = flown(vec![
            vec![PadEvent::Connected("pad".into()), PadEvent::Moved(PadAxis::LeftTrigger, 1.0), PadEvent::Moved(PadAxis::LeftY, 1.0)],
            vec![PadEvent::Moved(PadAxis::LeftX, -1.0), PadEvent::Moved(PadAxis::RightX, 1.0), PadEvent::Pressed(PadButton::RightShoulder)],
            vec![PadEvent::Pressed(PadButton::Start), PadEvent::Pressed(PadButton::Back), PadEvent::Pressed(PadButton::East)],
            vec![PadEvent::Pressed(PadButton::North)],
        ]);
        assert_eq!(actions, [PilotAction::Restart, PilotAction::PlayPause, PilotAction::Person, PilotAction::WeakLinks]);
        let flown = pilot.controls(&HeldKeys::default(), 2, 0.1);
        let wanted = Controls { speed: 1.0, pitch: 1.0, roll: -1.0, yaw: -1.0, burst: 1.0, ..Controls::default() };
        assert_eq!(flown, wanted, "trigger speed; stick up nose up, left roll to port; right stick right yaws to starboard");
    }

    #[test]
    fn a_stick_near_its_middle_is_at_rest_and_a_lost_pad_lets_go() {
        let (mut pilot, _) = flown(vec![vec![PadEvent::Moved(PadAxis::LeftX, 0.1), PadEvent::Moved(PadAxis::LeftTrigger, 0.8)]]);
        let controls = pilot.controls(&HeldKeys::default(), 2, 0.1);
        assert!(controls.roll.abs() < 1e-12 && controls.speed > 0.7);
        let (mut pilot, _) = flown(vec![vec![PadEvent::Moved(PadAxis::LeftTrigger, 0.8), PadEvent::Disconnected]]);
        assert_eq!(pilot.controls(&HeldKeys::default(), 2, 0.1), Controls::default());
    }

    #[test]
    fn keys_hold_the_speed_and_steer_smoothly() {
        let mut pilot = Pilot::new(None);
        let held = HeldKeys { throttle: 1.0, yaw: 1.0, ..HeldKeys::default() };
        let first = pilot.controls(&held, 2, 0.1);
        assert!((first.speed - 0.05).abs() < 1e-12 && (first.yaw - 0.4).abs() < 1e-12);
        for _ in 0..40 {
            pilot.controls(&held, 2, 0.1);
        }
        let released = pilot.controls(&HeldKeys::default(), 2, 1.0);
        assert!((released.speed - 1.0).abs() < 1e-12, "speed stays when the key is let go");
        assert!(released.yaw.abs() < 1e-12, "the turn ends");
    }

    #[test]
    fn every_control_stays_in_its_range_whatever_the_hands_do() {
        let (mut pilot, _) = flown(vec![vec![PadEvent::Moved(PadAxis::LeftY, 7.0), PadEvent::Moved(PadAxis::RightX, f64::NAN)]]);
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
            for value in [c.pitch, c.roll, c.yaw, c.flipper_raise, c.flipper_twist, c.flipper_sweep] {
                assert!((-1.0..=1.0).contains(&value));
            }
            assert!((0.0..=1.0).contains(&c.speed) && (0.0..=1.0).contains(&c.burst));
        }
    }

    #[test]
    fn pitch_can_be_turned_over() {
        let (mut pilot, _) = flown(vec![vec![PadEvent::Moved(PadAxis::LeftY, 1.0)]]);
        pilot.invert_pitch = true;
        assert!((pilot.controls(&HeldKeys::default(), 2, 0.1).pitch + 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_left_shoulder_gives_the_right_hand_to_the_flippers() {
        let moved = |axis, value| PadEvent::Moved(axis, value);
        let (mut pilot, _) =
            flown(vec![vec![moved(PadAxis::RightX, 1.0), moved(PadAxis::RightY, -1.0), moved(PadAxis::RightTrigger, 1.0)]]);
        let steering = Controls { yaw: -1.0, flipper_sweep: 1.0, ..Controls::default() };
        assert_eq!(pilot.controls(&HeldKeys::default(), 0, 0.1), steering);
        pilot.take(PadEvent::Pressed(PadButton::LeftShoulder));
        let flippers = Controls { yaw: 0.0, flipper_raise: -1.0, flipper_twist: 1.0, flipper_sweep: -1.0, ..Controls::default() };
        assert_eq!(pilot.controls(&HeldKeys::default(), 0, 0.1), flippers);
        pilot.take(PadEvent::Released(PadButton::LeftShoulder));
        assert_eq!(pilot.controls(&HeldKeys::default(), 0, 0.1), steering);
    }

    #[test]
    fn acts_are_chosen_in_turn_and_last_as_long_as_they_are_asked_for() {
        let mut pilot = Pilot::new(None);
        let act = |pilot: &mut Pilot, keys: &HeldKeys| pilot.controls(keys, 3, 0.1).act as usize;
        let held = HeldKeys { act: true, ..HeldKeys::default() };
        assert_eq!([act(&mut pilot, &HeldKeys::default()), act(&mut pilot, &held)], [0, 1]);
        assert_eq!(pilot.take(PadEvent::Pressed(PadButton::LeftStick)), Some(PilotAction::NextAct));
        pilot.next_act(3);
        // A press shorter than a frame counts once.
        pilot.take(PadEvent::Pressed(PadButton::RightStick));
        pilot.take(PadEvent::Released(PadButton::RightStick));
        assert_eq!([act(&mut pilot, &HeldKeys::default()), act(&mut pilot, &HeldKeys::default())], [2, 0]);
        pilot.next_act(3);
        pilot.next_act(3);
        assert_eq!(act(&mut pilot, &held), 1, "the first follows the last");
        assert_eq!(pilot.controls(&held, 0, 0.1).act.to_bits(), 0.0_f64.to_bits(), "a motion without acts");
    }
}

//! Channels that a key of an act may set: joint angles, turns, attitude and controls, each with its range.
//!
//! These ranges hold for any whale; the table `[joints]` of a whale's file has those of its own joints.

use std::f64::consts::{PI, TAU};

use endline_sdk::SPINE_JOINTS;
use endline_sim::whale::Angle;
use endline_sim::whale::acts::{Control, Moves, Turn};

use crate::units::Quantity;

/// A channel.
#[derive(Debug)]
pub struct Channel {
    /// The name.
    pub key: &'static str,
    /// Angle, or a pure number for a control.
    pub quantity: Quantity,
    /// Least and greatest value, of one joint or side [rad or 1].
    pub range: [f64; 2],
    /// Description, for messages and for the manual.
    pub help: &'static str,
    kind: Of,
}

#[derive(Clone, Copy, Debug)]
enum Of {
    /// Angle by joint, and the bend of each joint relative to the others.
    Spine(fn(usize) -> Angle, &'static [f64; SPINE_JOINTS]),
    Pair(fn(usize) -> Angle),
    One(Moves),
}

impl Channel {
    /// Number of joints or sides.
    pub fn places(&self) -> usize {
        match self.kind {
            Of::Spine(..) => SPINE_JOINTS,
            Of::Pair(_) => 2,
            Of::One(_) => 1,
        }
    }

    /// Share of a single value per joint or side: the spine joints divide a bend; both sides of a pair take it in full.
    pub fn shares(&self) -> Vec<f64> {
        match self.kind {
            Of::Spine(_, bends) => {
                bends.iter().map(|bend| bend / bends.iter().sum::<f64>()).collect()
            }
            Of::Pair(_) | Of::One(_) => vec![1.0; self.places()],
        }
    }

    /// Target of each joint or side.
    pub fn moves(&self) -> Vec<Moves> {
        match self.kind {
            Of::Spine(angle, _) | Of::Pair(angle) => {
                (0..self.places()).map(|place| Moves::Angle(angle(place))).collect()
            }
            Of::One(moves) => vec![moves],
        }
    }

    /// Whether it is an accumulated turn, which may grow without bound.
    pub fn turns(&self) -> bool {
        matches!(self.kind, Of::One(Moves::Turn(_)))
    }

    /// Expected value of a key, for messages.
    pub fn expected(&self) -> String {
        match self.kind {
            Of::Spine(..) => format!(
                "expected the total bend of the spine, or a list of {SPINE_JOINTS} from the neck aft"
            ),
            Of::Pair(_) => {
                "expected one angle for both sides, or a list of two: left, right".to_owned()
            }
            Of::One(_) => format!("expected one value: {}", self.help),
        }
    }
}

const fn spine(key: &'static str, most_deg: f64, of: Of, help: &'static str) -> Channel {
    angles(key, [-most_deg, most_deg], of, help)
}

const fn angles(
    key: &'static str,
    [least_deg, most_deg]: [f64; 2],
    kind: Of,
    help: &'static str,
) -> Channel {
    Channel {
        key,
        quantity: Quantity::Angle,
        range: [least_deg * DEGREE, most_deg * DEGREE],
        help,
        kind,
    }
}

const fn control(key: &'static str, least: f64, control: Control, help: &'static str) -> Channel {
    Channel {
        key,
        quantity: Quantity::Ratio,
        range: [least, 1.0],
        help,
        kind: Of::One(Moves::Control(control)),
    }
}

const fn turn(key: &'static str, turn: Turn, help: &'static str) -> Channel {
    Channel {
        key,
        quantity: Quantity::Angle,
        range: [-100.0 * TAU, 100.0 * TAU],
        help,
        kind: Of::One(Moves::Turn(turn)),
    }
}

const DEGREE: f64 = PI / 180.0;

/// Relative bend of the spine joints from the neck aft, by the working ranges of a right whale: estimates.
const PITCH: [f64; SPINE_JOINTS] = [6.0, 6.0, 6.0, 10.0, 13.0, 16.0, 18.0, 17.0];
const YAW: [f64; SPINE_JOINTS] = [5.0, 10.0, 12.0, 12.0, 12.0, 12.0, 12.0, 10.0];
const ROLL: [f64; SPINE_JOINTS] = [1.0, 2.0, 2.5, 2.5, 3.0, 3.0, 3.0, 3.0];

/// Every channel, in the order of the manual.
pub const CHANNELS: &[Channel] = &[
    spine(
        "spine_pitch",
        20.0,
        Of::Spine(Angle::SpinePitch, &PITCH),
        "spine bent down (positive, head and tail down) or arched, total or joint by joint",
    ),
    spine(
        "spine_yaw",
        15.0,
        Of::Spine(Angle::SpineYaw, &YAW),
        "spine bent sideways, positive: the aft end to starboard",
    ),
    spine(
        "spine_roll",
        5.0,
        Of::Spine(Angle::SpineRoll, &ROLL),
        "spine twisted, positive: the aft end starboard side down",
    ),
    angles(
        "fluke_pitch",
        [-60.0, 60.0],
        Of::One(Moves::Angle(Angle::FlukePitch)),
        "flukes, trailing edge down",
    ),
    angles("fluke_flex", [-30.0, 30.0], Of::Pair(Angle::FlukeFlex), "fluke blades bent, tips up"),
    angles(
        "flipper_sweep",
        [-60.0, 80.0],
        Of::Pair(Angle::FlipperSweep),
        "flippers swept aft from rest; negative forward",
    ),
    angles(
        "flipper_raise",
        [-80.0, 60.0],
        Of::Pair(Angle::FlipperRaise),
        "flippers abducted, tips up; negative adducted",
    ),
    angles(
        "flipper_twist",
        [-60.0, 60.0],
        Of::Pair(Angle::FlipperTwist),
        "flippers pronated, leading edge down; negative supinated",
    ),
    angles(
        "flipper_flex",
        [-30.0, 30.0],
        Of::Pair(Angle::FlipperFlex),
        "flipper blades bent, tips up",
    ),
    angles(
        "jaw",
        [0.0, 45.0],
        Of::One(Moves::Angle(Angle::Jaw)),
        "jaw dropped; the control `mouth` opens it as the swim does",
    ),
    angles("lips", [0.0, 60.0], Of::Pair(Angle::Lips), "lower lips turned out"),
    turn("roll", Turn::Roll, "turned to starboard since the start of the act"),
    turn("pitch", Turn::Pitch, "turned nose up since the start of the act"),
    turn("yaw", Turn::Yaw, "turned to port since the start of the act"),
    angles(
        "bank",
        [-360.0, 360.0],
        Of::One(Moves::Bank),
        "target roll against the horizon, starboard side down",
    ),
    angles(
        "climb",
        [-85.0, 85.0],
        Of::One(Moves::Climb),
        "target pitch against the horizon, nose up",
    ),
    control("speed", 0.0, Control::Speed, "swim speed, as the control"),
    control("burst", 0.0, Control::Burst, "burst, as the control"),
    control("mouth", 0.0, Control::Mouth, "mouth, as the control"),
    control("steer_pitch", -1.0, Control::Pitch, "nose up, as the control"),
    control("steer_roll", -1.0, Control::Roll, "roll to starboard, as the control"),
    control("steer_yaw", -1.0, Control::Yaw, "turn to port, as the control"),
];

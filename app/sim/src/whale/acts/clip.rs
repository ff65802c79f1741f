//! A clip: what an act does over time, as numbers.
//!
//! Angles in radians, times in seconds from the act's beginning. Every track is a curve through keys; tracks that
//! a clip does not have stay with the motion that swims.

use endline_sdk::{BodyPart, Controls, Posture};

use super::angles::mirrored;
use super::curve::Curve;
use crate::whale::Angle;
use crate::whale::pose::angle_mut;

/// An act as keys over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Id by which pilots ask for it, such as `roll-away`.
    pub id: String,
    /// Name shown in menus.
    pub name: String,
    /// What it does, in a sentence.
    pub help: String,
    /// What moves and how.
    pub tracks: Vec<Track>,
    /// Time of the last key [s].
    pub length_s: f64,
    /// What comes after the last key.
    pub after: After,
    /// How long the whale takes to get from what it did into the act, and out of it again [s].
    pub fade_s: f64,
    /// Whether its angles take the place of those of swimming or are added to them.
    pub blend: Blend,
    /// Greatest rate at which it turns to a bank or climb [rad/s].
    pub turn_rate_rad_s: f64,
    /// Which side it is for.
    pub side: Side,
    /// Whether it is broken off when rope touches each [`BodyPart`].
    pub ends_at_touch: [bool; BodyPart::ALL.len()],
}

/// What comes after a clip's last key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum After {
    /// Back to swimming.
    Return,
    /// The last key holds for as long as the pilot asks.
    Hold,
    /// From the first key again for as long as the pilot asks.
    Repeat,
}

/// How a clip's angles and swimming come together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blend {
    /// The clip's angles in the place of swimming's.
    Replace,
    /// The clip's angles on top of swimming's.
    Add,
}

/// The side of the whale a clip was written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// As it was written.
    AsWritten,
    /// Its mirror image.
    Mirrored,
    /// Written for rope that touches on the left (port) side; its mirror image where it touches on the right.
    Touched,
}

/// One thing that a clip moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// What.
    pub moves: Moves,
    /// How, over time.
    pub curve: Curve,
}

/// What a track moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moves {
    /// An angle of the posture [rad].
    Angle(Angle),
    /// A control, in the place of the pilot's.
    Control(Control),
    /// How far the whale has turned since the act began [rad].
    Turn(Turn),
    /// Roll against the horizon, starboard side down [rad].
    Bank,
    /// Pitch against the horizon, nose up [rad].
    Climb,
}

/// A control that a clip may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Swim speed.
    Speed,
    /// Burst.
    Burst,
    /// Mouth.
    Mouth,
    /// Pitch, nose up.
    Pitch,
    /// Roll, to starboard.
    Roll,
    /// Yaw, to port.
    Yaw,
}

/// A turn about one of the whale's own axes, in the sense of the [`Controls`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// To starboard.
    Roll,
    /// Nose up.
    Pitch,
    /// To port.
    Yaw,
}

impl Clip {
    /// The angles of swimming with the clip's in their place or on top, `time_s` after the act began.
    #[must_use]
    pub fn posture(&self, time_s: f64, mirror: bool, swimming: &Posture) -> Posture {
        let mut posture = *swimming;
        let at = self.within(time_s);
        for track in &self.tracks {
            let Moves::Angle(angle) = track.moves else { continue };
            let (angle, sign) = if mirror { mirrored(angle) } else { (angle, 1.0) };
            let value = sign * track.curve.at(at);
            if let Some(place) = angle_mut(&mut posture, angle) {
                *place = if self.blend == Blend::Add { *place + value } else { value };
            }
        }
        posture
    }

    /// The pilot's controls with those that the clip holds in their place.
    #[must_use]
    pub fn controls(&self, time_s: f64, mirror: bool, pilots: &Controls) -> Controls {
        let mut controls = *pilots;
        let at = self.within(time_s);
        for track in &self.tracks {
            let Moves::Control(control) = track.moves else { continue };
            let (place, sided) = control_mut(&mut controls, control);
            *place = if sided && mirror { -track.curve.at(at) } else { track.curve.at(at) };
        }
        controls
    }

    /// Angles turned from one time to another about roll, pitch and yaw, in the sense of the [`Controls`] [rad].
    #[must_use]
    pub fn turned(&self, from_s: f64, to_s: f64, mirror: bool) -> [f64; 3] {
        let mut turned = [0.0; 3];
        for track in &self.tracks {
            let Moves::Turn(turn) = track.moves else { continue };
            let sign = if mirror && turn != Turn::Pitch { -1.0 } else { 1.0 };
            turned[turn as usize] +=
                sign * (self.gone(&track.curve, to_s) - self.gone(&track.curve, from_s));
        }
        turned
    }

    /// Bank and climb asked for [rad], where it asks for them.
    #[must_use]
    pub fn attitude(&self, time_s: f64, mirror: bool) -> [Option<f64>; 2] {
        let at = self.within(time_s);
        let of = |moves: Moves| {
            self.tracks.iter().find(|track| track.moves == moves).map(|track| track.curve.at(at))
        };
        [of(Moves::Bank).map(|bank| if mirror { -bank } else { bank }), of(Moves::Climb)]
    }

    /// Whether it is over, `time_s` after it began.
    #[must_use]
    pub fn is_over(&self, time_s: f64) -> bool {
        self.after == After::Return && time_s >= self.length_s
    }

    /// Time in the curves.
    fn within(&self, time_s: f64) -> f64 {
        if self.after == After::Repeat && self.length_s > 0.0 {
            time_s % self.length_s
        } else {
            time_s
        }
    }

    /// Value of a curve that goes on growing where it repeats.
    fn gone(&self, curve: &Curve, time_s: f64) -> f64 {
        let rounds = if self.after == After::Repeat && self.length_s > 0.0 {
            libm::floor(time_s / self.length_s)
        } else {
            0.0
        };
        curve.at(time_s - rounds * self.length_s) + rounds * curve.gain()
    }
}

/// A control, and whether it has a side.
fn control_mut(controls: &mut Controls, control: Control) -> (&mut f64, bool) {
    match control {
        Control::Speed => (&mut controls.speed, false),
        Control::Burst => (&mut controls.burst, false),
        Control::Mouth => (&mut controls.mouth, false),
        Control::Pitch => (&mut controls.pitch, false),
        Control::Roll => (&mut controls.roll, true),
        Control::Yaw => (&mut controls.yaw, true),
    }
}

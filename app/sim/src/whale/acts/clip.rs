//! Clips: the movement of an act over time, its interpolation, mirror image, and turns to an attitude.
//!
//! Angles in radians, times in seconds from the start of the act. Every track is a curve through keys; a value without a track
//! is that of the underlying motion. The curve is a monotone cubic, which never exceeds the keys on either side:
//!
//! ```text
//! between keys 0 and 1, h = t1 - t0, s = (t - t0)/h:
//! v(s) = v0 (1 + 2s)(1-s)² + h m0 s(1-s)² + v1 s²(3-2s) - h m1 s²(1-s)
//! slope at an inner key:  0 if the slopes d of the two intervals differ in sign, else
//!                         (w0 + w1)/(w0/d0 + w1/d1),  w0 = 2 h1 + h0,  w1 = h1 + 2 h0
//! ```
//!
//! The slope is zero at the first and last key and at every extremum.
//! Reference: Fritsch and Butland 1984, SIAM Journal on Scientific and Statistical Computing 5, 300-304.
//!
//! Bank and climb relative to the horizon: with the orientation `R = Rz(heading) Ry(-climb) Rx(bank)` and the target `R'` of
//! the same heading, the turn rates about the whale's own axes are `log(R⁻¹ R')/tau` [rad/s], limited in magnitude.

use std::f64::consts::{FRAC_PI_2, PI};

use endline_sdk::{BodyPart, Controls, Posture, SPINE_JOINTS};
use glam::{DQuat, DVec3};

use crate::whale::Angle;
use crate::whale::pose::angle_mut;

/// An act as keys over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Id in pilot programs, such as `roll-away`.
    pub id: String,
    /// Name shown in menus.
    pub name: String,
    /// Description in one sentence.
    pub help: String,
    /// Tracks.
    pub tracks: Vec<Track>,
    /// Time of the last key [s].
    pub length_s: f64,
    /// Behaviour after the last key.
    pub after: After,
    /// Fade time at the start and the end of the act [s].
    pub fade_s: f64,
    /// Whether its angles replace those of swimming or are added to them.
    pub blend: Blend,
    /// Greatest turn rate towards a bank or climb [rad/s].
    pub turn_rate_rad_s: f64,
    /// Side.
    pub side: Side,
    /// For each [`BodyPart`], whether contact of rope ends it.
    pub ends_at_touch: [bool; BodyPart::ALL.len()],
}

/// Behaviour after a clip's last key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum After {
    /// Return to swimming.
    Return,
    /// Hold the last key while the pilot requests the act.
    Hold,
    /// Repeat from the first key while the pilot requests the act.
    Repeat,
}

/// Combination of a clip's angles with those of swimming.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blend {
    /// The clip's angles replace those of swimming.
    Replace,
    /// The clip's angles are added to those of swimming.
    Add,
}

/// Side of a clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// As written.
    AsWritten,
    /// Mirror image.
    Mirrored,
    /// As written for contact on the left (port) side, mirrored for contact on the right.
    Touched,
}

/// A track of a clip.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Quantity.
    pub moves: Moves,
    /// Value over time.
    pub curve: Curve,
}

/// Quantity of a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moves {
    /// An angle of the posture [rad].
    Angle(Angle),
    /// A control, which replaces the pilot's.
    Control(Control),
    /// Angle turned since the start of the act [rad].
    Turn(Turn),
    /// Roll relative to the horizon, starboard side down [rad].
    Bank,
    /// Pitch relative to the horizon, nose up [rad].
    Climb,
}

/// A control that a clip may replace.
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
    /// Posture of swimming, combined with the clip's angles at `time_s` after the start of the act.
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

    /// The pilot's controls, with those of the clip in their place.
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
    pub fn turned(&self, from_s: f64, to_s: f64, mirror: bool) -> [f64; 3] {
        let mut turned = [0.0; 3];
        for track in &self.tracks {
            let Moves::Turn(turn) = track.moves else { continue };
            let sign = if mirror && turn != Turn::Pitch { -1.0 } else { 1.0 };
            turned[turn as usize] += sign
                * (self.accumulated(&track.curve, to_s) - self.accumulated(&track.curve, from_s));
        }
        turned
    }

    /// Bank and climb, each `None` without a track [rad].
    pub fn attitude(&self, time_s: f64, mirror: bool) -> [Option<f64>; 2] {
        let at = self.within(time_s);
        let of = |moves: Moves| {
            self.tracks.iter().find(|track| track.moves == moves).map(|track| track.curve.at(at))
        };
        [of(Moves::Bank).map(|bank| if mirror { -bank } else { bank }), of(Moves::Climb)]
    }

    /// Whether it has ended at `time_s` after its start.
    pub fn is_over(&self, time_s: f64) -> bool {
        self.after == After::Return && time_s >= self.length_s
    }

    /// Time on the curves [s].
    fn within(&self, time_s: f64) -> f64 {
        if self.after == After::Repeat && self.length_s > 0.0 {
            time_s % self.length_s
        } else {
            time_s
        }
    }

    /// Value of a curve, accumulated over repetitions.
    fn accumulated(&self, curve: &Curve, time_s: f64) -> f64 {
        let rounds = if self.after == After::Repeat && self.length_s > 0.0 {
            libm::floor(time_s / self.length_s)
        } else {
            0.0
        };
        curve.at(time_s - rounds * self.length_s) + rounds * curve.gain()
    }
}

/// Returns a control, and whether it changes sign in the mirror image.
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

/// A curve through keys sorted by time.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    keys: Vec<Key>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Key {
    time_s: f64,
    value: f64,
    slope: f64,
}

impl Curve {
    /// Interpolates `(time [s], value)`, sorted by time; without points the curve is zero.
    ///
    /// `repeats`: the first key follows the last, so that both have the slope of an inner key.
    pub fn through(points: &[(f64, f64)], repeats: bool) -> Self {
        let rise = |from: usize| {
            let ((t0, v0), (t1, v1)) = (points[from], points[from + 1]);
            (t1 - t0, (v1 - v0) / (t1 - t0))
        };
        let last = points.len().saturating_sub(1);
        let slope = |index: usize| match index {
            _ if last == 0 => 0.0,
            0 if repeats => joined(rise(last - 1), rise(0)),
            _ if index == last && repeats => joined(rise(last - 1), rise(0)),
            0 => 0.0,
            _ if index == last => 0.0,
            _ => joined(rise(index - 1), rise(index)),
        };
        let key = |(index, &(time_s, value)): (usize, &(f64, f64))| Key {
            time_s,
            value,
            slope: slope(index),
        };
        Self { keys: points.iter().enumerate().map(key).collect() }
    }

    /// Value at a time; constant before the first and after the last key.
    pub fn at(&self, time_s: f64) -> f64 {
        let after = self.keys.partition_point(|key| key.time_s <= time_s);
        match (after.checked_sub(1).and_then(|before| self.keys.get(before)), self.keys.get(after))
        {
            (Some(from), Some(to)) => between(from, to, time_s),
            (Some(only), None) | (None, Some(only)) => only.value,
            (None, None) => 0.0,
        }
    }

    /// Value of the last key minus that of the first: the increase per repetition.
    pub fn gain(&self) -> f64 {
        self.keys.last().map_or(0.0, |last| last.value - self.keys[0].value)
    }
}

/// Slope at a key between two intervals, each with its duration and slope.
fn joined((h0, d0): (f64, f64), (h1, d1): (f64, f64)) -> f64 {
    if d0 * d1 <= 0.0 {
        return 0.0;
    }
    let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
    (w0 + w1) / (w0 / d0 + w1 / d1)
}

/// Value between two keys.
fn between(from: &Key, to: &Key, time_s: f64) -> f64 {
    let h = to.time_s - from.time_s;
    let s = (time_s - from.time_s) / h;
    let r = 1.0 - s;
    from.value * (1.0 + 2.0 * s) * r * r
        + h * from.slope * s * r * r
        + to.value * s * s * (3.0 - 2.0 * s)
        - h * to.slope * s * s * r
}

/// Number of angles of a posture.
pub const ANGLES: usize = 3 * SPINE_JOINTS + 14;

/// Returns the angle of the mirror image and its sign.
pub fn mirrored(angle: Angle) -> (Angle, f64) {
    let other = |side: usize| 1 - side.min(1);
    match angle {
        Angle::SpinePitch(_) | Angle::FlukePitch | Angle::Jaw => (angle, 1.0),
        Angle::SpineYaw(_) | Angle::SpineRoll(_) => (angle, -1.0),
        Angle::FlukeFlex(side) => (Angle::FlukeFlex(other(side)), 1.0),
        Angle::FlipperSweep(side) => (Angle::FlipperSweep(other(side)), 1.0),
        Angle::FlipperRaise(side) => (Angle::FlipperRaise(other(side)), 1.0),
        Angle::FlipperTwist(side) => (Angle::FlipperTwist(other(side)), 1.0),
        Angle::FlipperFlex(side) => (Angle::FlipperFlex(other(side)), 1.0),
        Angle::Lips(side) => (Angle::Lips(other(side)), 1.0),
    }
}

/// Time constant of a turn to an attitude; an estimate [s].
const TAU_S: f64 = 1.5;

/// Heading (anticlockwise from east), bank (starboard side down) and climb (nose up) of a whale [rad].
pub fn attitude(orientation: DQuat) -> [f64; 3] {
    let (ahead, port) = (orientation * DVec3::X, orientation * DVec3::Y);
    let climb = FRAC_PI_2 - libm::acos(ahead.z.clamp(-1.0, 1.0));
    let heading = libm::atan2(ahead.y, ahead.x);
    let level_port = DVec3::new(-libm::sin(heading), libm::cos(heading), 0.0);
    let bank = libm::atan2(port.dot(ahead.cross(level_port)), port.dot(level_port));
    [heading, bank, climb]
}

/// Turn rates about the whale's own axes towards a bank and a climb; `None` leaves either unchanged [rad/s].
pub fn rates_to(orientation: DQuat, [bank, climb]: [Option<f64>; 2], most_rad_s: f64) -> DVec3 {
    if bank.is_none() && climb.is_none() {
        return DVec3::ZERO;
    }
    let [heading, bank_now, climb_now] = attitude(orientation);
    let wanted = DQuat::from_rotation_z(heading)
        * DQuat::from_rotation_y(-climb.unwrap_or(climb_now))
        * DQuat::from_rotation_x(bank.unwrap_or(bank_now));
    let mut left = (orientation.conjugate() * wanted).to_scaled_axis();
    if left.length() > PI {
        left *= 1.0 - 2.0 * PI / left.length();
    }
    (left / TAU_S).clamp_length_max(most_rad_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_interpolates_its_keys_and_never_exceeds_them() {
        let points = [(0.0, 0.0), (1.0, 2.0), (1.5, 1.9), (4.0, -3.0), (5.0, -3.0), (5.5, 7.0)];
        let curve = Curve::through(&points, false);
        for pair in points.windows(2) {
            let ((t0, v0), (t1, v1)) = (pair[0], pair[1]);
            assert!((curve.at(t0) - v0).abs() < 1e-15 && (curve.at(t1) - v1).abs() < 1e-15);
            for part in 0..=100 {
                let value = curve.at(t0 + (t1 - t0) * f64::from(part) / 100.0);
                assert!(
                    (v0.min(v1) - 1e-12..=v0.max(v1) + 1e-12).contains(&value),
                    "{value} between {v0} and {v1}"
                );
            }
        }
        assert!(curve.at(-1.0).abs() < 1e-15 && (curve.at(99.0) - 7.0).abs() < 1e-15);
    }

    /// A straight line is reproduced between inner keys, with its slope; a single key is a constant.
    #[test]
    fn straight_lines_stay_straight_inside() {
        let points: Vec<(f64, f64)> =
            (0..6).map(|i| (f64::from(i) * 0.7, 3.0 - 2.0 * f64::from(i) * 0.7)).collect();
        let curve = Curve::through(&points, false);
        for part in 0..200 {
            let t = 0.7 + 2.1 * f64::from(part) / 200.0;
            assert!((curve.at(t) - (3.0 - 2.0 * t)).abs() < 1e-12, "{t}");
        }
        assert!((Curve::through(&[(1.0, 4.0)], false).at(0.3) - 4.0).abs() < 1e-15);
    }

    /// A curve that repeats has the same slope at both ends.
    #[test]
    fn a_curve_that_repeats_closes_smoothly() {
        let points = [(0.0, 0.0), (1.0, 1.0), (2.0, 3.0), (3.0, 4.0)];
        let (open, closed) = (Curve::through(&points, false), Curve::through(&points, true));
        let slope =
            |curve: &Curve, from: f64, to: f64| (curve.at(to) - curve.at(from)) / (to - from);
        assert!(slope(&open, 0.0, 1e-6).abs() < 1e-4, "starts with slope zero");
        let (start, end) = (slope(&closed, 0.0, 1e-6), slope(&closed, 3.0 - 1e-6, 3.0));
        assert!(start > 0.5 && (start - end).abs() < 1e-4, "{start} and {end}");
        assert!((closed.gain() - 4.0).abs() < 1e-15);
    }

    #[test]
    fn the_mirror_image_of_the_mirror_image_is_the_angle_itself() {
        for angle in Angle::all() {
            let (other, sign) = mirrored(angle);
            let (back, again) = mirrored(other);
            assert!(back == angle && (sign * again - 1.0).abs() < 1e-15, "{other:?}");
        }
        assert_eq!(Angle::all().count(), ANGLES);
    }

    fn pointing(heading: f64, bank: f64, climb: f64) -> DQuat {
        DQuat::from_rotation_z(heading)
            * DQuat::from_rotation_y(-climb)
            * DQuat::from_rotation_x(bank)
    }

    #[test]
    fn attitude_is_read_back() {
        for (heading, bank, climb) in
            [(0.3, 0.0, 0.0), (-2.0, 1.2, 0.9), (3.0, -3.0, -1.1), (1.0, 0.1, 1.4)]
        {
            let read = attitude(pointing(heading, bank, climb));
            for (read, expected) in read.into_iter().zip([heading, bank, climb]) {
                assert!((read - expected).abs() < 1e-9, "{read} for {expected}");
            }
        }
        let (port_up, nose_up) =
            (DQuat::from_rotation_x(0.5) * DVec3::Y, DQuat::from_rotation_y(-0.5) * DVec3::X);
        assert!(port_up.z > 0.0 && nose_up.z > 0.0);
    }

    /// From several attitudes the whale reaches the target within its rate, without a change of the other angle.
    #[test]
    fn turn_rates_lead_to_the_target_attitude() {
        for (start, asked) in [
            ([0.4, 0.0, 0.0], [None, Some(-1.0)]),
            ([2.4, 0.7, 0.3], [Some(0.0), Some(0.0)]),
            ([-1.0, 0.0, 0.2], [Some(FRAC_PI_2), None]),
            ([-1.0, 0.5, 0.2], [Some(PI), Some(0.1)]),
        ] {
            let [heading, bank, climb] = start;
            let mut orientation = pointing(heading, bank, climb);
            for _ in 0..6000 {
                let rates = rates_to(orientation, asked, 0.35);
                assert!(rates.length() <= 0.35 + 1e-12);
                orientation = (orientation * DQuat::from_scaled_axis(rates * 0.01)).normalize();
            }
            let now = attitude(orientation);
            let off = (now[1] - asked[0].unwrap_or(bank)).rem_euclid(2.0 * PI);
            assert!(off.min(2.0 * PI - off) < 1e-3, "bank {now:?} for {asked:?}");
            assert!(
                (now[2] - asked[1].unwrap_or(climb)).abs() < 1e-3,
                "climb {now:?} for {asked:?}"
            );
        }
    }
}

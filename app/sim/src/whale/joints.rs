//! How far a whale's joints turn, and what becomes of a posture that asks for more.
//!
//! ```text
//! each angle    a  <-  min(max(a, least), most)
//! the spine     a_j  <-  a_j T / |sum a_j|     where |sum a_j| > T, for pitch, yaw and roll each
//! ```
//! `T` is the greatest bend of the whole spine. Ranges come with the whale's file (`[joints]`), each with its source.

use endline_sdk::{Posture, SPINE_JOINTS};

use super::Angle;
use super::pose::{angle_mut, angle_of};
use crate::random::unit;

/// Ranges of all joint angles [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRanges {
    /// Least of each angle.
    pub least: Posture,
    /// Greatest of each angle.
    pub most: Posture,
    /// Greatest sum over the spine's joints either way: pitch, yaw, roll.
    pub spine_total: [f64; 3],
}

impl JointRanges {
    /// No bounds at all.
    #[must_use]
    pub fn unbounded() -> Self {
        let mut ranges = Self {
            least: Posture::default(),
            most: Posture::default(),
            spine_total: [f64::INFINITY; 3],
        };
        for angle in Angle::all() {
            ranges.set(angle, [f64::NEG_INFINITY, f64::INFINITY]);
        }
        ranges
    }

    /// The range of one angle, least and greatest [rad].
    #[must_use]
    pub fn of(&self, angle: Angle) -> [f64; 2] {
        [angle_of(&self.least, angle), angle_of(&self.most, angle)]
    }

    /// Sets the range of one angle, least and greatest [rad]; nothing for a joint or side that is not there.
    pub fn set(&mut self, angle: Angle, [least, most]: [f64; 2]) {
        for (posture, value) in [(&mut self.least, least), (&mut self.most, most)] {
            if let Some(slot) = angle_mut(posture, angle) {
                *slot = value;
            }
        }
    }

    /// Holds a posture within its ranges; whether it was beyond them.
    pub fn hold(&self, posture: &mut Posture) -> bool {
        let asked = *posture;
        for angle in Angle::all() {
            let [least, most] = self.of(angle);
            if let Some(slot) = angle_mut(posture, angle) {
                *slot = slot.max(least).min(most);
            }
        }
        for (axis, total) in Angle::SPINE.into_iter().zip(self.spine_total) {
            let sum: f64 = (0..SPINE_JOINTS).map(|joint| angle_of(posture, axis(joint))).sum();
            // A hair of room, so that holding what was held changes no bit.
            if sum.abs() > total * (1.0 + 1e-12) {
                for joint in 0..SPINE_JOINTS {
                    if let Some(slot) = angle_mut(posture, axis(joint)) {
                        *slot *= total / sum.abs();
                    }
                }
            }
        }
        asked != *posture
    }

    /// A posture within the ranges: each angle drawn evenly, then the whole spine held; one seed gives one posture.
    ///
    /// For tests over the whole range of motion. An angle whose range has no end stays 0.
    #[must_use]
    pub fn random(&self, seed: u64) -> Posture {
        let mut posture = Posture::default();
        for (index, angle) in (0..).zip(Angle::all()) {
            let [least, most] = self.of(angle);
            let drawn = least + (most - least) * unit(seed, index);
            if let Some(slot) = angle_mut(&mut posture, angle).filter(|_| drawn.is_finite()) {
                *slot = drawn;
            }
        }
        self.hold(&mut posture);
        posture
    }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "angles are set and held to the bit")]
mod tests {
    use super::*;

    fn ranges() -> JointRanges {
        let mut ranges = JointRanges {
            least: Posture::default(),
            most: Posture::default(),
            spine_total: [0.5, 0.6, 0.2],
        };
        for (index, angle) in (1..).zip(Angle::all()) {
            ranges.set(angle, [-0.01 * f64::from(index), 0.02 * f64::from(index)]);
        }
        ranges
    }

    fn inside(ranges: &JointRanges, posture: &Posture) -> bool {
        let spine = Angle::SPINE.into_iter().zip(ranges.spine_total).all(|(axis, total)| {
            (0..SPINE_JOINTS).map(|joint| angle_of(posture, axis(joint))).sum::<f64>().abs()
                <= total * (1.0 + 1e-12)
        });
        let each = Angle::all().all(|angle| {
            let [least, most] = ranges.of(angle);
            (least..=most).contains(&angle_of(posture, angle))
        });
        spine && each
    }

    #[test]
    fn every_angle_is_named_once_and_reaches_its_own_place() {
        let mut posture = Posture::default();
        for (index, angle) in (1..).zip(Angle::all()) {
            assert_eq!(angle_of(&posture, angle), 0.0, "{angle:?} shares its place");
            *angle_mut(&mut posture, angle).unwrap() = f64::from(index);
            assert_eq!(angle_of(&posture, angle), f64::from(index));
        }
        assert_eq!(
            Angle::all().count() * size_of::<f64>(),
            size_of::<Posture>(),
            "an angle of the posture has no name"
        );
        assert!(angle_mut(&mut posture, Angle::SpineYaw(SPINE_JOINTS)).is_none());
    }

    #[test]
    fn what_is_within_is_left_and_what_is_beyond_is_held() {
        let ranges = ranges();
        for seed in 0..200 {
            let mut posture = ranges.random(seed);
            let drawn = posture;
            assert!(inside(&ranges, &posture), "seed {seed}");
            assert!(!ranges.hold(&mut posture) && posture == drawn, "seed {seed}: held twice");
            for angle in Angle::all() {
                *angle_mut(&mut posture, angle).unwrap() *= 10.0;
            }
            assert!(ranges.hold(&mut posture) && inside(&ranges, &posture), "seed {seed}");
        }
        assert_ne!(ranges.random(1), ranges.random(2));
    }

    /// Eight joints at 0.1 rad ask for 0.8; 0.5 is shared out evenly.
    #[test]
    fn the_whole_spine_has_its_own_bound() {
        let mut ranges = JointRanges::unbounded();
        ranges.spine_total[0] = 0.5;
        let mut posture = Posture {
            spine_pitch: [0.1; SPINE_JOINTS],
            spine_yaw: [0.1; SPINE_JOINTS],
            ..Posture::default()
        };
        assert!(ranges.hold(&mut posture));
        assert!(posture.spine_pitch.iter().all(|angle| (angle - 0.0625).abs() < 1e-15));
        assert_eq!(posture.spine_yaw, [0.1; SPINE_JOINTS]);
        // A wave bends by far more at each joint and asks for nothing of the whole.
        let mut wave = Posture {
            spine_pitch: [0.4, -0.4, 0.4, -0.4, 0.4, -0.4, 0.4, -0.4],
            ..Posture::default()
        };
        assert!(!ranges.hold(&mut wave));
    }
}

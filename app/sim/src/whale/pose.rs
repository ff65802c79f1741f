//! Postures and the skin: ranges of joints, bone transforms, and skinning.
//!
//! Ranges: with `a` an angle [rad] and `T` the greatest total bend of the spine [rad],
//!
//! ```text
//! each angle    a  <-  min(max(a, least), most)
//! the spine     a_j  <-  a_j T / |sum a_j|     if |sum a_j| > T, for pitch, yaw and roll separately
//! ```
//!
//! The whale's file gives the ranges (`[joints]`), each with its source.
//!
//! Skinning: a vertex `x` is at `Σ_b w_b M_b x` with the transforms `M_b` of its bones and weights `w_b` that sum to 1. This is
//! the only path from a posture to a surface; pictures, contact and audit all use it.
//! Reference: Magnenat-Thalmann, Laperrière and Thalmann 1988, Graphics Interface, 26-33 (linear blend skinning).

use endline_sdk::{Posture, SPINE_JOINTS};
use glam::{DAffine3, DQuat, DVec3};

use super::{Angle, Bone, Skin};
use crate::bits::unit;

/// Ranges of all joint angles [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRanges {
    /// Lower limit of each angle.
    pub least: Posture,
    /// Upper limit of each angle.
    pub most: Posture,
    /// Limit of the magnitude of the sum over the spine's joints: pitch, yaw, roll.
    pub spine_total: [f64; 3],
}

impl JointRanges {
    /// Ranges without limits.
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

    /// Range of an angle: lower and upper limit [rad].
    pub fn of(&self, angle: Angle) -> [f64; 2] {
        [angle_of(&self.least, angle), angle_of(&self.most, angle)]
    }

    /// Sets the range of an angle: lower and upper limit [rad]. Ignores a joint or side that does not exist.
    pub fn set(&mut self, angle: Angle, [least, most]: [f64; 2]) {
        for (posture, value) in [(&mut self.least, least), (&mut self.most, most)] {
            if let Some(slot) = angle_mut(posture, angle) {
                *slot = value;
            }
        }
    }

    /// Clamps a posture to the ranges; returns whether it changed.
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
            // The margin ensures that a clamped posture is not changed again.
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

    /// A random posture within the ranges, determined by the seed, for tests over the whole range of motion.
    ///
    /// Angles are uniformly distributed before the limit of the spine applies; an angle with an infinite range is 0.
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

/// Computes the transforms of all bones, from the rest position in the whale's frame to the world, into `out`.
///
/// `position` is that of the whale frame's origin [m], `orientation` is from the whale's frame to the world.
/// The transforms are rigid. A bone without a parent before it in the list is attached to the whale's frame.
pub fn pose(
    skin: &Skin,
    position: DVec3,
    orientation: DQuat,
    posture: &Posture,
    out: &mut Vec<DAffine3>,
) {
    let whale = DAffine3::from_rotation_translation(orientation, position);
    out.clear();
    for bone in &skin.bones {
        let parent = bone.parent.and_then(|parent| out.get(parent)).copied().unwrap_or(whale);
        out.push(parent * turn(bone, posture));
    }
}

/// Rotation of a bone about its origin, in the whale's rest frame.
fn turn(bone: &Bone, posture: &Posture) -> DAffine3 {
    let rotation = bone.turns.iter().fold(DQuat::IDENTITY, |before, (channel, axis)| {
        DQuat::from_axis_angle(*axis, channel.share * angle_of(posture, channel.angle)) * before
    });
    DAffine3::from_rotation_translation(rotation, bone.origin - rotation * bone.origin)
}

/// Returns an angle of a posture; 0 for a joint or side that does not exist [rad].
pub fn angle_of(posture: &Posture, angle: Angle) -> f64 {
    let of = |angles: &[f64], index: usize| angles.get(index).copied().unwrap_or(0.0);
    match angle {
        Angle::SpinePitch(joint) => of(&posture.spine_pitch, joint),
        Angle::SpineYaw(joint) => of(&posture.spine_yaw, joint),
        Angle::SpineRoll(joint) => of(&posture.spine_roll, joint),
        Angle::FlukePitch => posture.fluke_pitch,
        Angle::FlukeFlex(side) => of(&posture.fluke_flex, side),
        Angle::FlipperSweep(side) => of(&posture.flipper_sweep, side),
        Angle::FlipperRaise(side) => of(&posture.flipper_raise, side),
        Angle::FlipperTwist(side) => of(&posture.flipper_twist, side),
        Angle::FlipperFlex(side) => of(&posture.flipper_flex, side),
        Angle::Jaw => posture.jaw,
        Angle::Lips(side) => of(&posture.lips, side),
    }
}

/// Returns a reference to an angle of a posture; `None` for a joint or side that does not exist.
pub fn angle_mut(posture: &mut Posture, angle: Angle) -> Option<&mut f64> {
    match angle {
        Angle::SpinePitch(joint) => posture.spine_pitch.get_mut(joint),
        Angle::SpineYaw(joint) => posture.spine_yaw.get_mut(joint),
        Angle::SpineRoll(joint) => posture.spine_roll.get_mut(joint),
        Angle::FlukePitch => Some(&mut posture.fluke_pitch),
        Angle::FlukeFlex(side) => posture.fluke_flex.get_mut(side),
        Angle::FlipperSweep(side) => posture.flipper_sweep.get_mut(side),
        Angle::FlipperRaise(side) => posture.flipper_raise.get_mut(side),
        Angle::FlipperTwist(side) => posture.flipper_twist.get_mut(side),
        Angle::FlipperFlex(side) => posture.flipper_flex.get_mut(side),
        Angle::Jaw => Some(&mut posture.jaw),
        Angle::Lips(side) => posture.lips.get_mut(side),
    }
}

/// World position of a vertex under the bones' transforms [m]. Bones without a transform are ignored.
pub fn skin_vertex(skin: &Skin, bones: &[DAffine3], vertex: usize) -> DVec3 {
    let rest = skin.vertices[vertex];
    let mut place = DVec3::ZERO;
    for &(bone, weight) in &skin.weights[vertex] {
        if weight > 0.0
            && let Some(transform) = bones.get(usize::from(bone))
        {
            place += weight * transform.transform_point3(rest);
        }
    }
    place
}

/// Computes the world positions of all vertices into `out` [m].
pub fn skin_all(skin: &Skin, bones: &[DAffine3], out: &mut Vec<DVec3>) {
    out.clear();
    out.extend((0..skin.vertices.len()).map(|vertex| skin_vertex(skin, bones, vertex)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::whale::Channel;
    use std::f64::consts::FRAC_PI_2;

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
    fn every_angle_has_one_name_and_its_own_value() {
        let mut posture = Posture::default();
        for (index, angle) in (1..).zip(Angle::all()) {
            assert_eq!(angle_of(&posture, angle).to_bits(), 0, "{angle:?} shares its place");
            *angle_mut(&mut posture, angle).unwrap() = f64::from(index);
            assert_eq!(angle_of(&posture, angle).to_bits(), f64::from(index).to_bits());
        }
        assert_eq!(
            Angle::all().count() * size_of::<f64>(),
            size_of::<Posture>(),
            "an angle of the posture has no name"
        );
        assert!(angle_mut(&mut posture, Angle::SpineYaw(SPINE_JOINTS)).is_none());
    }

    #[test]
    fn postures_are_clamped_to_the_ranges() {
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

    /// Eight joints at 0.1 rad have the sum 0.8 rad; the limit of 0.5 rad is distributed evenly.
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
        assert!(posture.spine_yaw.iter().all(|yaw| yaw.to_bits() == 0.1_f64.to_bits()));
        // A wave has greater angles at each joint, but the sum zero.
        let mut wave = Posture {
            spine_pitch: [0.4, -0.4, 0.4, -0.4, 0.4, -0.4, 0.4, -0.4],
            ..Posture::default()
        };
        assert!(!ranges.hold(&mut wave));
    }

    /// An arm along -x of two bones, jointed at the origin.
    fn arm() -> Skin {
        let bone = |name: &str, parent, origin, angle: Option<(Angle, DVec3)>| Bone {
            name: name.into(),
            parent,
            origin,
            turns: angle
                .map(|(angle, axis)| (Channel { angle, share: 1.0 }, axis))
                .into_iter()
                .collect(),
        };
        Skin {
            vertices: vec![
                DVec3::X,
                DVec3::NEG_X,
                DVec3::new(-2.0, 0.0, 0.0),
                DVec3::new(-1.5, 0.0, 0.0),
            ],
            triangles: vec![],
            regions: vec![],
            weights: vec![
                [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)],
                only(1),
                only(2),
                [(1, 0.5), (2, 0.5), (0, 0.0), (0, 0.0)],
            ],
            marks: vec![],
            bones: vec![
                bone("control", None, DVec3::ZERO, None),
                bone("upper", Some(0), DVec3::ZERO, Some((Angle::SpinePitch(0), DVec3::NEG_Y))),
                bone("lower", Some(1), DVec3::NEG_X, Some((Angle::SpinePitch(1), DVec3::NEG_Y))),
            ],
        }
    }

    fn only(bone: u16) -> [(u16, f64); 4] {
        [(bone, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]
    }

    /// Two right angles downwards: the hand is below and in front of the elbow.
    #[test]
    fn joints_turn_in_a_chain() {
        let mut posture = Posture::default();
        posture.spine_pitch[0] = FRAC_PI_2;
        posture.spine_pitch[1] = FRAC_PI_2;
        let (mut bones, mut places) = (Vec::new(), Vec::new());
        let at = DVec3::new(10.0, 20.0, -5.0);
        pose(&arm(), at, DQuat::from_rotation_z(FRAC_PI_2), &posture, &mut bones);
        skin_all(&arm(), &bones, &mut places);
        let expected =
            [DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.0, 0.0, -1.0), DVec3::new(0.0, 1.0, -1.0)];
        for (place, expected) in places.iter().zip(expected) {
            assert!(place.distance(at + expected) < 1e-12, "{place} against {}", at + expected);
        }
        // Half upper arm, half lower arm: the mean of (0, 0, -1.5) and (0, 0.5, -1).
        assert!(places[3].distance(at + DVec3::new(0.0, 0.25, -1.25)) < 1e-12);
    }

    #[test]
    fn rest_posture_is_the_rest_mesh() {
        let (mut bones, mut places) = (Vec::new(), Vec::new());
        pose(&arm(), DVec3::ZERO, DQuat::IDENTITY, &Posture::default(), &mut bones);
        skin_all(&arm(), &bones, &mut places);
        assert_eq!(places, arm().vertices);
    }
}

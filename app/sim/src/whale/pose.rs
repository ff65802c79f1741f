//! From posture to skin: bone transforms, then each vertex as the weighted mean of where its bones take it.
//!
//! This is the only path from a posture to a surface: the picture, the contact and the audit all use it.

use endline_sdk::Posture;
use glam::{DAffine3, DQuat, DVec3};

use super::{Angle, Bone, Skin};

/// Transforms of all bones, rest place in the whale's frame to world, written over `out`.
///
/// `position` is that of the whale frame's origin [m], `orientation` turns the whale's frame into the world's.
/// The transforms are rigid. A bone whose parent does not stand before it hangs on the control bone.
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

/// The bone's own turn about its origin, in the whale's rest frame.
fn turn(bone: &Bone, posture: &Posture) -> DAffine3 {
    let rotation = bone.turns.iter().fold(DQuat::IDENTITY, |before, (channel, axis)| {
        DQuat::from_axis_angle(*axis, channel.share * angle_of(posture, channel.angle)) * before
    });
    DAffine3::from_rotation_translation(rotation, bone.origin - rotation * bone.origin)
}

/// The named angle of a posture [rad]; 0 for a joint or side it does not have.
#[must_use]
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

/// The place of a named angle in a posture; none for a joint or side it does not have.
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

/// World place of one vertex under the bones' transforms [m].
///
/// Bones the transforms do not cover move nothing.
#[must_use]
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

/// World places of all vertices, written over `out` [m].
pub fn skin_all(skin: &Skin, bones: &[DAffine3], out: &mut Vec<DVec3>) {
    out.clear();
    out.extend((0..skin.vertices.len()).map(|vertex| skin_vertex(skin, bones, vertex)));
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::whale::Channel;

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

    /// Two right angles down: the hand ends below and in front of the elbow, as drawn on paper.
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

//! The angles of a posture as the other side of the whale has them.

use endline_sdk::SPINE_JOINTS;

use crate::whale::Angle;

/// How many angles a posture has.
pub const ANGLES: usize = 3 * SPINE_JOINTS + 14;

/// The angle that does on the other side of the whale what this one does here, and the sign with which.
#[must_use]
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mirror_image_of_the_mirror_image_is_the_angle_itself() {
        for angle in Angle::all() {
            let (other, sign) = mirrored(angle);
            let (back, again) = mirrored(other);
            assert!(back == angle && (sign * again - 1.0).abs() < 1e-15, "{other:?}");
        }
        assert_eq!(Angle::all().count(), ANGLES);
    }
}

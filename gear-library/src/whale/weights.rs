//! Which bones move the trunk and the head: spine, jaw, lips, and the shoulder round the flipper's base.

use std::f64::consts::PI;

use glam::DVec3;

use super::Builder;
use super::bones::{Skeleton, Weights};
use super::curve::smooth_step;
use super::jaws::Jaws;
use super::layout::{CORNER_ANGLE, corner_at};

/// How far the shoulder draws the skin of the trunk along [share of length].
const SHOULDER_REACH: f64 = 0.1;
/// Share the shoulder has at the rim of the flipper's base.
pub const SHOULDER_RIM: f64 = 0.5;

impl Builder<'_> {
    /// Bones of a place on the trunk.
    #[must_use]
    pub fn trunk_weights(&self, place: DVec3, at: f64, angle: f64) -> Weights {
        let weights = Skeleton::hand_over(
            self.skeleton.along_body(at),
            self.skeleton.jaw,
            self.jaw_share(at, angle, 0),
        );
        Skeleton::hand_over(weights, self.skeleton.flipper[0], self.shoulder_share(place, at))
    }

    /// Bones of the lower jaw: `inside` counts vertices from the rim inwards, 0 for the outside.
    #[must_use]
    pub fn lower_jaw_weights(&self, at: f64, angle: f64, inside: usize) -> Weights {
        let weights = Skeleton::hand_over(
            self.skeleton.along_body(at),
            self.skeleton.jaw,
            self.jaw_share(at, angle, inside),
        );
        Skeleton::hand_over(weights, self.skeleton.lip, self.lip_share(at, angle, inside))
    }

    /// The jaw ends at the corner of the mouth, and farther aft below it.
    fn jaw_share(&self, at: f64, angle: f64, inside: usize) -> f64 {
        let corner = corner_at(self.form);
        if inside > 0 {
            return 1.0 - smooth_step(corner - 0.05, corner, at);
        }
        let below = smooth_step(CORNER_ANGLE, PI, angle.max(0.0));
        let gape = if at < corner { self.jaws().gape(at) } else { CORNER_ANGLE };
        let rim = smooth_step(gape - 0.3, gape, angle);
        let from = corner - 0.05 + 0.02 * below;
        let to = corner + 0.08 * below;
        (1.0 - smooth_step(from, to.max(from + 0.02), at)) * rim
    }

    /// The lip turns about its foot: all of it at the rim, nothing at the height of the groove inside.
    fn lip_share(&self, at: f64, angle: f64, inside: usize) -> f64 {
        let ahead = 1.0 - at / corner_at(self.form);
        let along = smooth_step(0.06, 0.3, ahead) * (1.0 - smooth_step(0.7, 0.93, ahead));
        let gape = self.jaws().gape(at);
        let up = if inside > 0 {
            1.0 - smooth_step(0.0, 5.0, inside as f64)
        } else {
            1.0 - smooth_step(gape, 2.0, angle)
        };
        along * up
    }

    /// The shoulder's share falls off round the flipper's base.
    fn shoulder_share(&self, place: DVec3, at: f64) -> f64 {
        let flippers = &self.form.flippers;
        let root = self.flipper_root();
        let off = place - root;
        let half = flippers.root_chord / 2.0 / libm::cos(flippers.sweep).max(0.3);
        let along = (off.x.abs() / self.form.length_m - half).max(0.0);
        let off = DVec3::new(along * self.form.length_m, off.y, off.z);
        let behind =
            smooth_step(self.layout.rows[0], self.layout.rows[self.layout.hole_rows[0]], at);
        let behind = behind * smooth_step(0.0, 0.03, place.y / self.form.length_m);
        SHOULDER_RIM
            * behind
            * (1.0 - smooth_step(0.005, SHOULDER_REACH, off.length() / self.form.length_m))
    }

    fn jaws(&self) -> Jaws<'_> {
        Jaws::of(self.form, &self.sections)
    }
}

//! Closing of jaw and lips against what is between them.
//!
//! A muscle shortens more slowly under load, and lengthens above its holding force (Hill 1938, doi:10.1098/rspb.1938.0050; here
//! linear and symmetric). With the angle `a` of jaw or lip [rad], its rate of closing `w` without load [rad/s], the moment `M0`
//! that stops it [N m], and the opening moment `M` of contact [N m]:
//!
//! ```text
//! a <- max(requested, a - w h c)    c = 1 - M/M0, from -1 to 1        h step of the model [s]
//! M = Σ g (p - o) × F · e           mean over the last step of the model
//! ```
//!
//! `F` is a force on the skin at `p` [N], `g` the share of that skin which the bone moves, `e` the axis of the hinge, and `o` a
//! point on it. Opening is not restricted.

use endline_sdk::{BodyPart, Posture};
use glam::{DAffine3, DVec3};

use super::Angle;
use super::pose::{angle_mut, angle_of};
use super::skin::Skin;

/// Angles of the mouth.
pub const MOUTH: [Angle; 3] = [Angle::Jaw, Angle::Lips(0), Angle::Lips(1)];

/// Rates of closing of jaw and lips without load [rad/s]: the greatest jaw angle in 1 s, the lip angle of skim feeding in 1 s;
/// estimates.
const CLOSING_RAD_S: [f64; 3] = [0.52, 0.35, 0.35];

/// Closing strength of a mouth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JawStrength {
    /// Moments about the hinges of jaw, left and right lip that stop their closing [N m].
    pub moment_n_m: [f64; 3],
}

impl JawStrength {
    /// Strength from the closing forces of jaw and lips at the points farthest from their hinges [N].
    pub fn of_forces(skin: &Skin, [jaw_n, lip_n]: [f64; 2]) -> Self {
        let load = MouthLoad::new(skin);
        let moment_n_m = std::array::from_fn(|k| match load.hinges[k] {
            Some(hinge) => load.reach_m(skin, k, hinge) * if k == 0 { jaw_n } else { lip_n },
            None => f64::INFINITY,
        });
        Self { moment_n_m }
    }

    /// Closes the mouth from one posture towards the requested one during `dt_s`, against opening moments [N m].
    pub(crate) fn close(
        &self,
        before: &Posture,
        asked: &mut Posture,
        opening_n_m: [f64; 3],
        dt_s: f64,
    ) {
        for (k, angle) in MOUTH.into_iter().enumerate() {
            let from = angle_of(before, angle);
            let Some(slot) = angle_mut(asked, angle).filter(|asked| **asked <= from) else {
                continue;
            };
            let share = (1.0 - opening_n_m[k].max(0.0) / self.moment_n_m[k]).clamp(-1.0, 1.0);
            *slot = slot.max(from - CLOSING_RAD_S[k] * dt_s * share);
        }
    }
}

/// A bone of the mouth.
#[derive(Clone, Copy, Debug)]
struct Hinge {
    bone: usize,
    /// Its axis and a point on it, at rest [m].
    axis: DVec3,
    origin: DVec3,
}

/// Moments about the hinges of a mouth, summed over the solver steps of a step of the model.
#[derive(Clone, Debug, Default)]
pub(crate) struct MouthLoad {
    hinges: [Option<Hinge>; 3],
    /// Hinges that move each bone, one bit each.
    moved: Vec<u8>,
    /// Integral of the moments over time [N m s].
    sum: [f64; 3],
    /// Duration [s].
    span_s: f64,
}

impl MouthLoad {
    /// The hinges of a skin.
    pub fn new(skin: &Skin) -> Self {
        let mut load = Self::default();
        for (index, bone) in skin.bones.iter().enumerate() {
            let mut moved = bone.parent.and_then(|parent| load.moved.get(parent)).copied();
            for (k, angle) in MOUTH.into_iter().enumerate() {
                if let Some((_, axis)) =
                    bone.turns.iter().find(|(channel, _)| channel.angle == angle)
                {
                    load.hinges[k] = Some(Hinge { bone: index, axis: *axis, origin: bone.origin });
                    moved = Some(moved.unwrap_or(0) | 1 << k);
                }
            }
            load.moved.push(moved.unwrap_or(0));
        }
        load
    }

    /// Resets the sums.
    pub fn clear(&mut self) {
        (self.sum, self.span_s) = ([0.0; 3], 0.0);
    }

    /// Adds forces on the head over a solver step: triangle, position [m], force on the skin [N].
    pub fn take(
        &mut self,
        skin: &Skin,
        bones: &[DAffine3],
        forces: impl Iterator<Item = (usize, DVec3, DVec3)>,
        dt_s: f64,
    ) {
        self.span_s += dt_s;
        for (triangle, place, force) in forces {
            if skin.regions[triangle].part() != BodyPart::Head {
                continue;
            }
            for k in 0..MOUTH.len() {
                let Some(hinge) = self.hinges[k] else { continue };
                let Some(bone) = bones.get(hinge.bone) else { continue };
                let arm = place - bone.transform_point3(hinge.origin);
                let moment = arm.cross(force).dot(bone.transform_vector3(hinge.axis));
                self.sum[k] += self.share(skin, triangle, k) * moment * dt_s;
            }
        }
    }

    /// Share of a triangle that a hinge moves.
    fn share(&self, skin: &Skin, triangle: usize, hinge: usize) -> f64 {
        let moves = |bone: u16| {
            self.moved.get(usize::from(bone)).is_some_and(|moved| moved >> hinge & 1 == 1)
        };
        let corners = skin.triangles[triangle];
        let weights = corners.iter().flat_map(|corner| &skin.weights[*corner as usize]);
        weights.filter(|(bone, _)| moves(*bone)).map(|(_, weight)| weight).sum::<f64>() / 3.0
    }

    /// Greatest distance from a hinge's axis of the vertices that it moves, at rest [m].
    fn reach_m(&self, skin: &Skin, hinge: usize, at: Hinge) -> f64 {
        let axis = at.axis.normalize_or_zero();
        let moves = |bone: u16| self.moved[usize::from(bone)] >> hinge & 1 == 1;
        let moved = skin.vertices.iter().zip(&skin.weights).filter(|(_, weights)| {
            weights.iter().filter(|(bone, _)| moves(*bone)).map(|(_, weight)| weight).sum::<f64>()
                > 0.5
        });
        let reaches = moved.map(|(vertex, _)| (*vertex - at.origin).reject_from(axis).length());
        reaches.fold(0.0, f64::max)
    }

    /// Mean opening moments of jaw, left and right lip [N m].
    pub fn mean_n_m(&self) -> [f64; 3] {
        self.sum.map(|sum| if self.span_s > 0.0 { sum / self.span_s } else { 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::whale::{Bone, Channel};
    use endline_sdk::Region;

    const STRENGTH: JawStrength = JawStrength { moment_n_m: [1000.0, 100.0, 100.0] };

    fn jaw_after(from: f64, asked: f64, opening_n_m: f64) -> f64 {
        let posture = |jaw| Posture { jaw, ..Posture::default() };
        let mut next = posture(asked);
        STRENGTH.close(&posture(from), &mut next, [opening_n_m, 0.0, 0.0], 0.01);
        next.jaw
    }

    #[test]
    fn a_loaded_jaw_closes_more_slowly_stops_and_opens() {
        let step = CLOSING_RAD_S[0] * 0.01;
        for (opening_n_m, moved) in
            [(0.0, -1.0), (250.0, -0.75), (1000.0, 0.0), (1500.0, 0.5), (1e9, 1.0)]
        {
            let jaw = jaw_after(0.2, 0.0, opening_n_m);
            assert!((jaw - (0.2 + moved * step)).abs() < 1e-15, "{opening_n_m} N m: {jaw}");
        }
        assert_eq!(jaw_after(0.2, 0.199, 0.0).to_bits(), 0.199_f64.to_bits(), "as requested");
        assert_eq!(jaw_after(0.2, 0.3, 1e9).to_bits(), 0.3_f64.to_bits(), "it opens freely");
    }

    /// A jaw along x on a hinge about y at the origin: a force downwards at 2 m opens it, one on the rostrum does not.
    #[test]
    fn moments_are_force_times_arm_about_the_hinge() {
        let bone = |parent, turns| Bone { name: String::new(), parent, origin: DVec3::ZERO, turns };
        let jaw = vec![(Channel { angle: Angle::Jaw, share: 1.0 }, DVec3::Y)];
        let only = |bone| [(bone, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)];
        let skin = Skin {
            triangles: vec![[0, 0, 0], [1, 1, 1], [0, 1, 1]],
            regions: vec![Region::Lips; 3],
            weights: vec![only(1), only(0)],
            bones: vec![bone(None, vec![]), bone(Some(0), jaw)],
            ..Skin::default()
        };
        let bones = [DAffine3::IDENTITY; 2];
        let at = |triangle| (triangle, DVec3::X * 2.0, DVec3::NEG_Z * 300.0);
        for (triangle, expected) in [(0, 600.0), (1, 0.0), (2, 200.0)] {
            let mut load = MouthLoad::new(&skin);
            load.take(&skin, &bones, [at(triangle)].into_iter(), 0.004);
            load.take(&skin, &bones, [at(triangle)].into_iter(), 0.006);
            let [jaw, left, _] = load.mean_n_m();
            assert!((jaw - expected).abs() < 1e-9 && left.abs() < 1e-12, "{triangle}: {jaw}");
        }
    }
}

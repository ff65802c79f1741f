//! An axis as the bones carry it, and places seen from it.
//!
//! The middle of section k goes to `c_k = sum_b w_kb M_b c_k0`, its two directions across to `u_k = sum_b w_kb M_b u_0`
//! likewise, with `w_kb` the mean weight of bone b over the section's vertices. Between sections the axis is straight. A
//! place is seen from the nearest point of that polyline, drawn out straight at both ends: how far along, how far across
//! (in a frame that goes with the skin, so that a bent or turned whale sees touching rope where it was), and how near.

use glam::{DAffine3, DVec3};

use super::Axis;

/// An axis under a pose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PosedAxis {
    stations: Vec<Station>,
}

/// A section under a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Station {
    along_m: f64,
    middle: DVec3,
    across: [DVec3; 2],
    half_m: [f64; 2],
}

/// A place as seen from an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Place along the axis, in the measure of the rest posture [m].
    pub along_m: f64,
    /// The nearest point of the axis.
    pub middle: DVec3,
    /// Unit vectors across the axis, `across[0] x across[1]` along it.
    pub across: [DVec3; 2],
    /// Half widths of the section there [m].
    pub half_m: [f64; 2],
    /// The place in that frame [m].
    pub at_m: [f64; 2],
}

impl Axis {
    /// Writes the axis over `out` as the bones carry it.
    pub fn pose(&self, bones: &[DAffine3], out: &mut PosedAxis) {
        let carry = |section: &super::Section| {
            let [y, z] = section.middle_m;
            let rest = self.origin
                + self.along * section.along_m
                + self.across[0] * y
                + self.across[1] * z;
            let mut station = Station {
                along_m: section.along_m,
                middle: DVec3::ZERO,
                across: [DVec3::ZERO; 2],
                half_m: section.half_m,
            };
            for (bone, weight) in &section.weights {
                let Some(transform) = bones.get(usize::from(*bone)) else { continue };
                station.middle += *weight * transform.transform_point3(rest);
                for (across, own) in station.across.iter_mut().zip(self.across) {
                    *across += *weight * transform.transform_vector3(own);
                }
            }
            station
        };
        out.stations.clear();
        out.stations.extend(self.sections[self.askew..].iter().map(carry));
    }
}

impl PosedAxis {
    /// A ball around the axis, with the widest of its sections [m].
    #[must_use]
    pub fn ball(&self) -> (DVec3, f64) {
        let middle = self.stations.iter().map(|station| station.middle).sum::<DVec3>()
            / self.stations.len().max(1) as f64;
        let reach = |station: &Station| {
            station.middle.distance(middle) + libm::hypot(station.half_m[0], station.half_m[1])
        };
        (middle, self.stations.iter().map(reach).fold(0.0, f64::max))
    }

    /// A place as seen from the axis; `None` for an axis of fewer than two sections.
    #[must_use]
    pub fn see(&self, place: DVec3) -> Option<Spot> {
        let last = self.stations.len().checked_sub(2)?;
        let (mut nearest, mut found) = (f64::INFINITY, (0, 0.0));
        for (index, pair) in self.stations.windows(2).enumerate() {
            let (from, way) = (pair[0].middle, pair[1].middle - pair[0].middle);
            let share = (place - from).dot(way) / way.length_squared().max(f64::MIN_POSITIVE);
            let least = if index == 0 { f64::NEG_INFINITY } else { 0.0 };
            let most = if index == last { f64::INFINITY } else { 1.0 };
            let share = share.clamp(least, most);
            let apart = place.distance_squared(from + way * share);
            if apart < nearest {
                (nearest, found) = (apart, (index, share));
            }
        }
        Some(self.spot(found.0, found.1, place))
    }

    /// The point of the axis at a place along it, and the frame there; `None` for an axis of fewer than two sections.
    #[must_use]
    pub fn at(&self, along_m: f64) -> Option<Spot> {
        let last = self.stations.len().checked_sub(2)?;
        let index = self.stations[1..=last].partition_point(|station| station.along_m <= along_m);
        let (one, other) = (self.stations[index], self.stations[index + 1]);
        let span = (other.along_m - one.along_m).max(f64::MIN_POSITIVE);
        let share = (along_m - one.along_m) / span;
        Some(self.spot(index, share, one.middle.lerp(other.middle, share)))
    }

    fn spot(&self, index: usize, share: f64, place: DVec3) -> Spot {
        let (one, other) = (&self.stations[index], &self.stations[index + 1]);
        let middle = one.middle.lerp(other.middle, share);
        let along = (other.middle - one.middle).normalize_or(DVec3::X);
        let held = share.clamp(0.0, 1.0);
        let lean = one.across[0].lerp(other.across[0], held);
        let first = (lean - along * lean.dot(along))
            .try_normalize()
            .unwrap_or_else(|| along.any_orthonormal_vector());
        let across = [first, along.cross(first)];
        Spot {
            along_m: one.along_m + share * (other.along_m - one.along_m),
            middle,
            across,
            half_m: [0, 1].map(|k| one.half_m[k] + held * (other.half_m[k] - one.half_m[k])),
            at_m: across.map(|direction| (place - middle).dot(direction)),
        }
    }
}

impl Spot {
    /// Angle of the place about the axis, from the first direction across towards the second [rad].
    #[must_use]
    pub fn azimuth(&self) -> f64 {
        libm::atan2(self.at_m[1], self.at_m[0])
    }

    /// Unit vector along the axis.
    #[must_use]
    pub fn along(&self) -> DVec3 {
        self.across[0].cross(self.across[1])
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::super::axes_of;
    use super::*;
    use crate::metrics::tests::spec;
    use crate::whale::pose;
    use endline_sdk::{BodyPart, Posture};

    /// A whale moved and turned as a rigid body sees each place where it was, whichever part's axis it is seen from.
    #[test]
    fn a_rigid_move_changes_nothing_that_is_seen() {
        let skin = spec(vec![1.0]).whale.expect("a whale").skin;
        let (turn, shift) =
            (DQuat::from_euler(glam::EulerRot::ZYX, 1.0, -0.4, 2.0), DVec3::new(30.0, -7.0, -12.0));
        let (mut still, mut moved) = (Vec::new(), Vec::new());
        pose(&skin, DVec3::ZERO, DQuat::IDENTITY, &Posture::default(), &mut still);
        pose(&skin, shift, turn, &Posture::default(), &mut moved);
        let (mut one, mut other) = (PosedAxis::default(), PosedAxis::default());
        for (part, axis) in BodyPart::ALL.iter().zip(axes_of(&skin)) {
            let Some(axis) = axis else { continue };
            axis.pose(&still, &mut one);
            axis.pose(&moved, &mut other);
            for place in
                [DVec3::new(-5.0, 0.4, 0.1), DVec3::new(1.0, 1.5, -0.2), DVec3::new(1.6, 2.5, -0.7)]
            {
                let (a, b) = (
                    one.see(place).expect("an axis"),
                    other.see(turn * place + shift).expect("an axis"),
                );
                let apart = [a.along_m - b.along_m, a.at_m[0] - b.at_m[0], a.at_m[1] - b.at_m[1]];
                assert!(apart.iter().all(|apart| apart.abs() < 1e-9), "{}: {apart:?}", part.name());
            }
        }
    }

    /// What `at` gives is on the axis, at the place asked for.
    #[test]
    fn places_along_the_axis_are_seen_on_it() {
        let skin = spec(vec![1.0]).whale.expect("a whale").skin;
        let mut bones = Vec::new();
        pose(&skin, DVec3::ZERO, DQuat::IDENTITY, &Posture::default(), &mut bones);
        let mut posed = PosedAxis::default();
        for axis in axes_of(&skin).iter().flatten() {
            axis.pose(&bones, &mut posed);
            for share in [-0.1, 0.0, 0.37, 0.8, 1.0, 1.1] {
                let along = axis.reach_m[0] + share * (axis.reach_m[1] - axis.reach_m[0]);
                let seen =
                    posed.at(along).and_then(|spot| posed.see(spot.middle)).expect("an axis");
                assert!(
                    (seen.along_m - along).abs() < 1e-9
                        && libm::hypot(seen.at_m[0], seen.at_m[1]) < 1e-9,
                    "{along}: {seen:?}"
                );
            }
        }
    }
}

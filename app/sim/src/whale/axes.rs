//! Axes of the whale's parts, for the measurement of wraps: at rest, and under a pose.
//!
//! Head, body and peduncle have the axis of the trunk: along x through the centres of its cross sections. A flipper or fluke
//! has its own axis from root to tip, through the centres of its sections.
//!
//! Under a pose, the centre of section `k` is at `c_k = sum_b w_kb M_b c_k0` [m] and its two transverse directions are
//! `u_k = sum_b w_kb M_b u_0`, with `M_b` the transform of bone `b` and `w_kb` its mean weight over the vertices of the
//! section. The axis is straight between sections and extended straight at both ends. A position is expressed relative to its
//! nearest point on that polyline: the coordinate along the axis, and two coordinates in a transverse frame that moves with the
//! skin. A bend or turn of the whale therefore does not change the coordinates of rope on its skin.

use endline_sdk::BodyPart;
use glam::{DAffine3, DVec3};

use super::Skin;

/// Number of cross sections of an axis.
const SECTIONS: usize = 24;

/// Distance from the axis below which the azimuth is undefined; estimate [m].
const LEAST_RADIUS_M: f64 = 0.01;

/// Share of a part's extent that is its root if it shares no vertex with another part; estimate.
const ROOT_SHARE: f64 = 0.05;

/// Share of a fin's extent at its root where transverse planes cut the body; estimate.
const ASKEW_SHARE: f64 = 0.55;

/// A slightly curved axis: a straight direction and the centres of cross sections along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    origin: DVec3,
    along: DVec3,
    across: [DVec3; 2],
    /// Start and end of the part along the axis [m].
    pub reach_m: [f64; 2],
    /// Number of sections at the root that a posed axis omits because they are oblique; the axis is extended straight there.
    askew: usize,
    /// Sections with vertices, sorted by position along the axis.
    pub sections: Vec<Section>,
}

/// A cross section.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Position along the axis from its origin [m].
    pub along_m: f64,
    /// Centre of the box of its vertices, across the axis [m].
    pub middle_m: [f64; 2],
    /// Half widths of that box [m].
    pub half_m: [f64; 2],
    /// Bones that move it, with weights that sum to 1.
    weights: Vec<(u16, f64)>,
}

impl Axis {
    /// Azimuth about the axis of a position in the rest posture; `None` on the axis [rad].
    pub fn azimuth(&self, place: DVec3) -> Option<f64> {
        let from = place - self.origin;
        let middle = self.middle(from.dot(self.along));
        let (u, v) = (from.dot(self.across[0]) - middle[0], from.dot(self.across[1]) - middle[1]);
        (libm::hypot(u, v) > LEAST_RADIUS_M).then(|| libm::atan2(v, u))
    }

    /// Smallest and greatest position of vertices along the axis [m].
    fn reach_of(&self, vertices: &[DVec3]) -> [f64; 2] {
        let reach = vertices.iter().map(|vertex| (*vertex - self.origin).dot(self.along));
        reach.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], place| {
            [least.min(place), most.max(place)]
        })
    }

    /// Centre of the cross section at a position along the axis.
    fn middle(&self, along_m: f64) -> [f64; 2] {
        let after = self.sections.partition_point(|section| section.along_m < along_m);
        let (Some(low), Some(high)) =
            (self.sections.get(after.saturating_sub(1)), self.sections.get(after))
        else {
            return self.sections.last().map_or([0.0; 2], |section| section.middle_m);
        };
        let span = high.along_m - low.along_m;
        let share = if span > 0.0 { (along_m - low.along_m) / span } else { 0.0 };
        [0, 1].map(|k| low.middle_m[k] + share * (high.middle_m[k] - low.middle_m[k]))
    }
}

/// Axis of every part at rest, by its number; `None` for a part without skin.
pub fn axes_of(skin: &Skin) -> [Option<Axis>; BodyPart::ALL.len()] {
    let trunk = trunk_axis(skin);
    BodyPart::ALL.map(|part| {
        let axis = if part.on_trunk() { trunk.clone() } else { limb_axis(skin, part) }?;
        let own = places(skin, &used_by(skin, |other| other == part));
        (!own.is_empty()).then(|| Axis { reach_m: axis.reach_of(&own), ..axis })
    })
}

/// Axis of head, body and peduncle.
pub(crate) fn trunk_axis(skin: &Skin) -> Option<Axis> {
    sections_along(
        skin,
        &used_by(skin, BodyPart::on_trunk),
        DVec3::ZERO,
        DVec3::X,
        [DVec3::Y, DVec3::Z],
    )
}

/// Axis of a flipper or fluke, from the centre of its root to its farthest vertex.
fn limb_axis(skin: &Skin, part: BodyPart) -> Option<Axis> {
    let own = used_by(skin, |other| other == part);
    let rest = used_by(skin, |other| other != part);
    let vertices = places(skin, &own);
    let shared: Vec<bool> = own.iter().zip(&rest).map(|(own, rest)| *own && *rest).collect();
    let mut root = places(skin, &shared);
    if root.is_empty() {
        root = nearest_the_trunk(&vertices);
    }
    let origin = root.iter().sum::<DVec3>() / root.len().max(1) as f64;
    let tip = vertices
        .iter()
        .copied()
        .max_by(|a, b| a.distance_squared(origin).total_cmp(&b.distance_squared(origin)))?;
    let along = (tip - origin).try_normalize()?;
    let (u, v) = along.any_orthonormal_pair();
    let mut axis = sections_along(skin, &own, origin, along, [u, v])?;
    let [least, most] = axis.reach_m;
    axis.askew = axis
        .sections
        .iter()
        .filter(|section| section.along_m < least + ASKEW_SHARE * (most - least))
        .count();
    Some(axis)
}

/// Vertices of a limb nearest to the whale's midplane.
fn nearest_the_trunk(vertices: &[DVec3]) -> Vec<DVec3> {
    let (least, most) = vertices.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), vertex| {
        (least.min(libm::fabs(vertex.y)), most.max(libm::fabs(vertex.y)))
    });
    let limit = least + ROOT_SHARE * (most - least);
    vertices.iter().copied().filter(|vertex| libm::fabs(vertex.y) <= limit).collect()
}

/// Marks the vertices of triangles of the selected parts.
fn used_by(skin: &Skin, wanted: impl Fn(BodyPart) -> bool) -> Vec<bool> {
    let mut used = vec![false; skin.vertices.len()];
    for (triangle, region) in skin.triangles.iter().zip(&skin.regions) {
        if wanted(region.part()) {
            triangle.iter().for_each(|vertex| used[*vertex as usize] = true);
        }
    }
    used
}

/// Rest positions of the marked vertices.
fn places(skin: &Skin, used: &[bool]) -> Vec<DVec3> {
    skin.vertices.iter().zip(used).filter(|(_, used)| **used).map(|(vertex, _)| *vertex).collect()
}

/// Cross sections of the marked vertices: bounding boxes of slabs of equal thickness along a direction.
fn sections_along(
    skin: &Skin,
    used: &[bool],
    origin: DVec3,
    along: DVec3,
    across: [DVec3; 2],
) -> Option<Axis> {
    let mut axis =
        Axis { origin, along, across, reach_m: [0.0; 2], askew: 0, sections: Vec::new() };
    axis.reach_m = axis.reach_of(&places(skin, used));
    let [least, most] = axis.reach_m;
    if most <= least {
        return None;
    }
    let mut slabs: Vec<Slab> = (0..SECTIONS).map(|_| Slab::empty(skin)).collect();
    for (index, vertex) in skin.vertices.iter().enumerate().filter(|(index, _)| used[*index]) {
        let reach = (*vertex - origin).dot(along);
        let share = (reach - least) / (most - least);
        let slab = ((share * SECTIONS as f64) as usize).min(SECTIONS - 1);
        slabs[slab].take(
            reach,
            across.map(|axis| (*vertex - origin).dot(axis)),
            &skin.weights[index],
        );
    }
    axis.sections = slabs.iter().filter_map(Slab::section).collect();
    Some(axis)
}

/// Bounding box of the vertices in a slab, and the bones that move them.
struct Slab {
    count: f64,
    along_sum: f64,
    low: [f64; 2],
    high: [f64; 2],
    /// Sum of the weights by bone.
    bones: Vec<f64>,
}

impl Slab {
    fn empty(skin: &Skin) -> Self {
        let bones = vec![0.0; skin.bones.len()];
        Self {
            count: 0.0,
            along_sum: 0.0,
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
            bones,
        }
    }

    fn take(&mut self, along: f64, across: [f64; 2], weights: &[(u16, f64)]) {
        self.count += 1.0;
        self.along_sum += along;
        for (k, place) in across.into_iter().enumerate() {
            (self.low[k], self.high[k]) = (self.low[k].min(place), self.high[k].max(place));
        }
        for (bone, weight) in weights {
            if let Some(sum) = self.bones.get_mut(usize::from(*bone)) {
                *sum += weight;
            }
        }
    }

    fn section(&self) -> Option<Section> {
        let whole: f64 = self.bones.iter().sum();
        let bones = (0_u16..).zip(&self.bones).filter(|(_, sum)| **sum > 0.0);
        (self.count > 0.0).then(|| Section {
            along_m: self.along_sum / self.count,
            middle_m: [0, 1].map(|k| 0.5 * (self.low[k] + self.high[k])),
            half_m: [0, 1].map(|k| 0.5 * (self.high[k] - self.low[k])),
            weights: bones.map(|(bone, sum)| (bone, sum / whole)).collect(),
        })
    }
}

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

/// A position relative to an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Coordinate along the axis, as in the rest posture [m].
    pub along_m: f64,
    /// Nearest point of the axis [m].
    pub middle: DVec3,
    /// Transverse unit vectors; `across[0] x across[1]` is along the axis.
    pub across: [DVec3; 2],
    /// Half widths of the section there [m].
    pub half_m: [f64; 2],
    /// Transverse coordinates of the position [m].
    pub at_m: [f64; 2],
}

impl Axis {
    /// Computes the axis under the bones' transforms into `out`.
    pub fn pose(&self, bones: &[DAffine3], out: &mut PosedAxis) {
        let carry = |section: &Section| {
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
    /// Bounding sphere of the axis with its sections: centre and radius [m].
    pub fn ball(&self) -> (DVec3, f64) {
        let middle = self.stations.iter().map(|station| station.middle).sum::<DVec3>()
            / self.stations.len().max(1) as f64;
        let reach = |station: &Station| {
            station.middle.distance(middle) + libm::hypot(station.half_m[0], station.half_m[1])
        };
        (middle, self.stations.iter().map(reach).fold(0.0, f64::max))
    }

    /// Position relative to the axis; `None` for an axis of fewer than two sections.
    pub fn locate(&self, place: DVec3) -> Option<Spot> {
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

    /// Point and frame at a coordinate along the axis; `None` for an axis of fewer than two sections.
    pub fn at(&self, along_m: f64) -> Option<Spot> {
        let last = self.stations.len().checked_sub(2)?;
        let index = self.stations[1..=last].partition_point(|station| station.along_m <= along_m);
        let (one, other) = (self.stations[index], self.stations[index + 1]);
        let span = (other.along_m - one.along_m).max(f64::MIN_POSITIVE);
        let share = (along_m - one.along_m) / span;
        Some(self.spot(index, share, one.middle.lerp(other.middle, share)))
    }

    fn spot(&self, index: usize, share: f64, place: DVec3) -> Spot {
        debug_assert!(
            index + 1 < self.stations.len(),
            "a piece of the axis lies between two sections"
        );
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
    /// Azimuth of the position about the axis, from the first transverse direction towards the second [rad].
    pub fn azimuth(&self) -> f64 {
        libm::atan2(self.at_m[1], self.at_m[0])
    }

    /// Unit vector along the axis.
    pub fn along(&self) -> DVec3 {
        self.across[0].cross(self.across[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::tests::spec;
    use crate::whale::pose;
    use endline_sdk::{BodyPart, Posture};
    use glam::DQuat;

    /// A rigid motion of the whale and a position does not change the coordinates relative to any axis.
    #[test]
    fn a_rigid_motion_does_not_change_coordinates() {
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
                    one.locate(place).expect("an axis"),
                    other.locate(turn * place + shift).expect("an axis"),
                );
                let apart = [a.along_m - b.along_m, a.at_m[0] - b.at_m[0], a.at_m[1] - b.at_m[1]];
                assert!(apart.iter().all(|apart| apart.abs() < 1e-9), "{}: {apart:?}", part.name());
            }
        }
    }

    /// The point of `at` is on the axis at the requested coordinate.
    #[test]
    fn points_of_the_axis_have_their_coordinate() {
        let skin = spec(vec![1.0]).whale.expect("a whale").skin;
        let mut bones = Vec::new();
        pose(&skin, DVec3::ZERO, DQuat::IDENTITY, &Posture::default(), &mut bones);
        let mut posed = PosedAxis::default();
        for axis in axes_of(&skin).iter().flatten() {
            axis.pose(&bones, &mut posed);
            for share in [-0.1, 0.0, 0.37, 0.8, 1.0, 1.1] {
                let along = axis.reach_m[0] + share * (axis.reach_m[1] - axis.reach_m[0]);
                let seen =
                    posed.at(along).and_then(|spot| posed.locate(spot.middle)).expect("an axis");
                assert!(
                    (seen.along_m - along).abs() < 1e-9
                        && libm::hypot(seen.at_m[0], seen.at_m[1]) < 1e-9,
                    "{along}: {seen:?}"
                );
            }
        }
    }
}

//! Axes of the whale's parts in its rest posture, about which wraps are counted.
//!
//! Head, body and peduncle share the trunk's axis: along x through the middles of its cross
//! sections. A flipper or fluke has its own: from root to tip, through the middles of its sections.

use endline_sdk::BodyPart;
use glam::DVec3;

use crate::whale::Skin;

/// How many cross sections an axis is made of.
const SECTIONS: usize = 24;

/// Distance from the axis within which an azimuth says nothing [m]; estimate.
const LEAST_RADIUS_M: f64 = 0.01;

/// Share of a part's reach from the trunk taken as its root where it shares no vertex with another part; estimate.
const ROOT_SHARE: f64 = 0.05;

/// A gently curved axis: a straight direction and the middles of cross sections along it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    origin: DVec3,
    along: DVec3,
    across: [DVec3; 2],
    /// Sections with vertices, by place along the axis.
    pub(super) sections: Vec<Section>,
}

/// A cross section: place along the axis, middle and half widths across it [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Section {
    pub(super) along_m: f64,
    pub(super) middle_m: [f64; 2],
    pub(super) half_m: [f64; 2],
}

impl Axis {
    /// Azimuth of a place of the rest posture about the axis [rad]; `None` where it is on the axis.
    pub(super) fn azimuth(&self, place: DVec3) -> Option<f64> {
        let from = place - self.origin;
        let middle = self.middle(from.dot(self.along));
        let (u, v) = (from.dot(self.across[0]) - middle[0], from.dot(self.across[1]) - middle[1]);
        (libm::hypot(u, v) > LEAST_RADIUS_M).then(|| libm::atan2(v, u))
    }

    /// Middle of the cross section at a place along the axis.
    fn middle(&self, along_m: f64) -> [f64; 2] {
        let after = self.sections.partition_point(|section| section.along_m < along_m);
        let (Some(low), Some(high)) = (self.sections.get(after.saturating_sub(1)), self.sections.get(after)) else {
            return self.sections.last().map_or([0.0; 2], |section| section.middle_m);
        };
        let span = high.along_m - low.along_m;
        let share = if span > 0.0 { (along_m - low.along_m) / span } else { 0.0 };
        [0, 1].map(|k| low.middle_m[k] + share * (high.middle_m[k] - low.middle_m[k]))
    }
}

/// The axis of every part, by its number; `None` for a part the skin lacks.
pub(super) fn axes_of(skin: &Skin) -> [Option<Axis>; BodyPart::ALL.len()] {
    let trunk = trunk_axis(skin);
    BodyPart::ALL.map(|part| if on_trunk(part) { trunk.clone() } else { limb_axis(skin, part) })
}

/// The axis of head, body and peduncle.
pub(super) fn trunk_axis(skin: &Skin) -> Option<Axis> {
    sections_along(&places(skin, &used_by(skin, on_trunk)), DVec3::ZERO, DVec3::X, [DVec3::Y, DVec3::Z])
}

/// Whether a part counts its wraps about the trunk.
fn on_trunk(part: BodyPart) -> bool {
    matches!(part, BodyPart::Head | BodyPart::Body | BodyPart::Peduncle)
}

/// The axis of a flipper or fluke, from the middle of its root to its farthest vertex.
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
    let tip = vertices.iter().copied().max_by(|a, b| a.distance_squared(origin).total_cmp(&b.distance_squared(origin)))?;
    let along = (tip - origin).try_normalize()?;
    let (u, v) = along.any_orthonormal_pair();
    sections_along(&vertices, origin, along, [u, v])
}

/// The vertices of a limb nearest to the whale's midplane.
fn nearest_the_trunk(vertices: &[DVec3]) -> Vec<DVec3> {
    let (least, most) = vertices
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(least, most), vertex| (least.min(libm::fabs(vertex.y)), most.max(libm::fabs(vertex.y))));
    let limit = least + ROOT_SHARE * (most - least);
    vertices.iter().copied().filter(|vertex| libm::fabs(vertex.y) <= limit).collect()
}

/// Which vertices belong to a triangle of some part.
fn used_by(skin: &Skin, wanted: impl Fn(BodyPart) -> bool) -> Vec<bool> {
    let mut used = vec![false; skin.vertices.len()];
    for (triangle, region) in skin.triangles.iter().zip(&skin.regions) {
        if wanted(region.part()) {
            triangle.iter().for_each(|vertex| used[*vertex as usize] = true);
        }
    }
    used
}

fn places(skin: &Skin, used: &[bool]) -> Vec<DVec3> {
    skin.vertices.iter().zip(used).filter(|(_, used)| **used).map(|(vertex, _)| *vertex).collect()
}

/// Cross sections of a cloud of vertices: the boxes of equal slabs along a direction.
fn sections_along(vertices: &[DVec3], origin: DVec3, along: DVec3, across: [DVec3; 2]) -> Option<Axis> {
    let reach = |vertex: &DVec3| (*vertex - origin).dot(along);
    let (least, most) = vertices.iter().map(reach).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    if most <= least {
        return None;
    }
    let mut slabs = [Slab::EMPTY; SECTIONS];
    for vertex in vertices {
        let share = (reach(vertex) - least) / (most - least);
        let slab = ((share * SECTIONS as f64) as usize).min(SECTIONS - 1);
        slabs[slab].take(reach(vertex), across.map(|axis| (*vertex - origin).dot(axis)));
    }
    let sections = slabs.iter().filter_map(Slab::section).collect();
    Some(Axis { origin, along, across, sections })
}

/// The box of the vertices in a slab.
#[derive(Clone, Copy)]
struct Slab {
    count: f64,
    along_sum: f64,
    low: [f64; 2],
    high: [f64; 2],
}

impl Slab {
    const EMPTY: Self = Self { count: 0.0, along_sum: 0.0, low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    fn take(&mut self, along: f64, across: [f64; 2]) {
        self.count += 1.0;
        self.along_sum += along;
        for (k, place) in across.into_iter().enumerate() {
            (self.low[k], self.high[k]) = (self.low[k].min(place), self.high[k].max(place));
        }
    }

    fn section(&self) -> Option<Section> {
        (self.count > 0.0).then(|| Section {
            along_m: self.along_sum / self.count,
            middle_m: [0, 1].map(|k| 0.5 * (self.low[k] + self.high[k])),
            half_m: [0, 1].map(|k| 0.5 * (self.high[k] - self.low[k])),
        })
    }
}

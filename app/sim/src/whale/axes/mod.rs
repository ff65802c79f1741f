//! Axes of the whale's parts, about which rope is wrapped: at rest, and carried along by the bones.
//!
//! Head, body and peduncle share the trunk's axis: along x through the middles of its cross
//! sections. A flipper or fluke has its own: from root to tip, through the middles of its sections.
//! A section goes where the bones take it, weighed as in the mean of its vertices (`posed.rs`).

mod posed;

use endline_sdk::BodyPart;
use glam::DVec3;

use super::Skin;

pub use posed::{PosedAxis, Spot};

/// How many cross sections an axis is made of.
const SECTIONS: usize = 24;

/// Distance from the axis within which an azimuth says nothing [m]; estimate.
const LEAST_RADIUS_M: f64 = 0.01;

/// Share of a part's reach from the trunk taken as its root where it shares no vertex with another part; estimate.
const ROOT_SHARE: f64 = 0.05;

/// Share of a fin's reach at its root where planes across its axis cut the body; estimate.
const ASKEW_SHARE: f64 = 0.55;

/// A gently curved axis: a straight direction and the middles of cross sections along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    origin: DVec3,
    along: DVec3,
    across: [DVec3; 2],
    /// Where the part begins and ends along the axis [m].
    pub reach_m: [f64; 2],
    /// Sections at the root that a posed axis leaves out: they are cut askew there, and it goes on straight instead.
    askew: usize,
    /// Sections with vertices, by place along the axis.
    pub sections: Vec<Section>,
}

/// A cross section: place along the axis, middle and half widths across it [m].
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Place along the axis from its origin [m].
    pub along_m: f64,
    /// Middle of the box of its vertices, across the axis [m].
    pub middle_m: [f64; 2],
    /// Half widths of that box [m].
    pub half_m: [f64; 2],
    /// Bones that carry it, with weights that sum to 1.
    weights: Vec<(u16, f64)>,
}

impl Axis {
    /// Azimuth of a place of the rest posture about the axis [rad]; `None` where it is on the axis.
    #[must_use]
    pub fn azimuth(&self, place: DVec3) -> Option<f64> {
        let from = place - self.origin;
        let middle = self.middle(from.dot(self.along));
        let (u, v) = (from.dot(self.across[0]) - middle[0], from.dot(self.across[1]) - middle[1]);
        (libm::hypot(u, v) > LEAST_RADIUS_M).then(|| libm::atan2(v, u))
    }

    /// Least and greatest place of vertices along the axis [m].
    fn reach_of(&self, vertices: &[DVec3]) -> [f64; 2] {
        let reach = vertices.iter().map(|vertex| (*vertex - self.origin).dot(self.along));
        reach.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], place| {
            [least.min(place), most.max(place)]
        })
    }

    /// Middle of the cross section at a place along the axis.
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

/// The axis of every part at rest, by its number; `None` for a part the skin lacks.
#[must_use]
pub fn axes_of(skin: &Skin) -> [Option<Axis>; BodyPart::ALL.len()] {
    let trunk = trunk_axis(skin);
    BodyPart::ALL.map(|part| {
        let axis = if part.on_trunk() { trunk.clone() } else { limb_axis(skin, part) }?;
        let own = places(skin, &used_by(skin, |other| other == part));
        (!own.is_empty()).then(|| Axis { reach_m: axis.reach_of(&own), ..axis })
    })
}

/// The axis of head, body and peduncle.
pub(crate) fn trunk_axis(skin: &Skin) -> Option<Axis> {
    sections_along(
        skin,
        &used_by(skin, BodyPart::on_trunk),
        DVec3::ZERO,
        DVec3::X,
        [DVec3::Y, DVec3::Z],
    )
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

/// The vertices of a limb nearest to the whale's midplane.
fn nearest_the_trunk(vertices: &[DVec3]) -> Vec<DVec3> {
    let (least, most) = vertices.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), vertex| {
        (least.min(libm::fabs(vertex.y)), most.max(libm::fabs(vertex.y)))
    });
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

/// Cross sections of some of a skin's vertices: the boxes of equal slabs along a direction.
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

/// The box of the vertices in a slab, and the bones that carry them.
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

//! The posed skin of the whale at the start: outlines of its parts, distances from rope, shift of nodes off the skin.
//!
//! A straight segment cuts a bend by up to `l^2/8R`, at the edge of a fin more than the rope's distance from the skin.
//! Nodes of a segment that is too close are shifted from the skin towards the rope. Nodes of a segment that intersects
//! an edge are shifted to the outside of the rope's bend: away from the middle between their neighbours.

use std::sync::Arc;

use endline_sdk::{BodyPart, Region};
use endline_sim::geometry::distance::segment_triangle;
use endline_sim::geometry::sweep::SweptSegment;
use endline_sim::model::Whale;
use endline_sim::whale::axes::{PosedAxis, axes_of};
use endline_sim::whale::{Candidate, Skin, SkinTree, Surface, pose, skin_all};
use endline_sim::{DAffine3, DVec3};

use super::Laid;

/// Greatest measured distance between rope and skin [m].
const MARGIN_M: f64 = 0.05;

/// The skin under the whale's start pose.
pub(super) struct PosedSkin {
    skin: Arc<Skin>,
    places: Vec<DVec3>,
    /// Triangles of each part, and their corners; the trunk is one part.
    own: [Vec<usize>; BodyPart::ALL.len()],
    corners: [Vec<usize>; BodyPart::ALL.len()],
    /// Posed axis of each part with its extent; `None` if the skin has no such part.
    axes: [Option<(PosedAxis, [f64; 2])>; BodyPart::ALL.len()],
    surface: Surface,
    bones: Vec<DAffine3>,
    /// Up direction of the whale.
    pub up: DVec3,
    /// Distance at which the rope's centre line is laid [m].
    pub off_m: f64,
}

/// The nearest skin to a segment.
pub(super) struct Nearest {
    /// Distance from the centre line of the rope [m].
    pub distance_m: f64,
    /// Where on the segment, from 0 to 1.
    pub fraction: f64,
    /// From skin to rope; zero where they cross.
    pub out: DVec3,
    /// The region of skin.
    pub region: Region,
}

impl PosedSkin {
    /// The skin of a whale in its start pose, for rope at a distance `off_m`.
    pub fn of(whale: &Whale, off_m: f64) -> Self {
        let skin = Arc::clone(&whale.skin);
        let (mut bones, mut places) = (Vec::new(), Vec::new());
        pose(&skin, whale.position_m, whale.orientation, &whale.start_posture(), &mut bones);
        skin_all(&skin, &bones, &mut places);
        let posed = |axis: endline_sim::whale::axes::Axis| {
            let mut posed = PosedAxis::default();
            axis.pose(&bones, &mut posed);
            (posed, axis.reach_m)
        };
        let axes = axes_of(&skin).map(|axis| axis.map(posed));
        let surface = Surface::new(Arc::new(SkinTree::new(Arc::clone(&skin))));
        let own: [Vec<usize>; BodyPart::ALL.len()] = BodyPart::ALL.map(|part| {
            let wanted = |region: Region| {
                region.part() == part || (part.on_trunk() && region.part().on_trunk())
            };
            (0..skin.triangles.len()).filter(|triangle| wanted(skin.regions[*triangle])).collect()
        });
        let corners = own.each_ref().map(|triangles| {
            let corners = triangles.iter().flat_map(|triangle| skin.triangles[*triangle]);
            let mut corners: Vec<usize> = corners.map(|corner| corner as usize).collect();
            corners.sort_unstable();
            corners.dedup();
            corners
        });
        let mut posed = Self {
            axes,
            places,
            own,
            corners,
            surface,
            up: whale.orientation * DVec3::Z,
            off_m,
            skin,
            bones,
        };
        posed.surface.begin(&posed.bones, &posed.bones);
        posed
    }

    /// The axis of a part and its extent [m].
    pub fn axis(&self, part: BodyPart) -> Option<&(PosedAxis, [f64; 2])> {
        self.axes[part as usize].as_ref()
    }

    /// The outline of a part in the plane through a place, perpendicular to `along`.
    pub fn outline(&self, part: BodyPart, place: DVec3, along: DVec3) -> Outline {
        let mut heights = vec![0.0; self.places.len()];
        for corner in &self.corners[part as usize] {
            heights[*corner] = (self.places[*corner] - place).dot(along);
        }
        let cut_of = |triangle: &usize| {
            let corners = self.skin.triangles[*triangle].map(|corner| corner as usize);
            let height = corners.map(|corner| heights[corner]);
            let above = height.map(|height| height > 0.0);
            // Nearly all triangles are on one side.
            if above == [true; 3] || above == [false; 3] {
                return None;
            }
            cut(corners.map(|corner| self.places[corner]), height)
        };
        let cuts: Vec<[DVec3; 2]> = self.own[part as usize].iter().filter_map(cut_of).collect();
        let weigh = |(sum, whole): (DVec3, f64), [a, b]: &[DVec3; 2]| {
            (sum + a.midpoint(*b) * a.distance(*b), whole + a.distance(*b))
        };
        let (sum, whole) = cuts.iter().fold((DVec3::ZERO, 0.0), weigh);
        // A thin blade is bent away from its axis: the centroid of its outline is used instead.
        let centre = if part.on_trunk() || whole <= 0.0 { place } else { sum / whole };
        Outline { cuts, centre, along }
    }

    /// Whether a path passes through the skin.
    pub fn goes_through(&mut self, way: &[DVec3]) -> bool {
        let mut pairs = Vec::new();
        self.surface.gather(&still(way), 0.0, &mut pairs);
        let crosses = |pair: &Candidate| {
            let segment = pair.segment as usize;
            segment_triangle(
                [way[segment], way[segment + 1]],
                self.surface.triangle_at(pair.triangle, 0.0),
            )
            .distance
                <= 0.0
        };
        pairs.iter().any(crosses)
    }

    /// The nearest skin to each segment of a path within [`MARGIN_M`].
    pub fn nearest(&mut self, nodes: &[DVec3]) -> Vec<Option<Nearest>> {
        let segments = still(nodes);
        let mut pairs = Vec::new();
        self.surface.gather(&segments, MARGIN_M, &mut pairs);
        let mut found: Vec<Option<Nearest>> = segments.iter().map(|_| None).collect();
        for Candidate { segment, triangle } in pairs {
            let segment = segment as usize;
            let (ends, corners) =
                ([nodes[segment], nodes[segment + 1]], self.surface.triangle_at(triangle, 0.0));
            let near = segment_triangle(ends, corners);
            if found[segment].as_ref().is_none_or(|known| near.distance < known.distance_m) {
                let [i, j, k] = near.barycentric;
                let on_skin = corners[0] * i + corners[1] * j + corners[2] * k;
                let out = (ends[0].lerp(ends[1], near.fraction) - on_skin)
                    .try_normalize()
                    .unwrap_or_default();
                let region = self.skin.regions[triangle as usize];
                found[segment] = Some(Nearest {
                    distance_m: near.distance,
                    fraction: near.fraction,
                    out,
                    region,
                });
            }
        }
        found
    }
}

/// The segments of a path, at rest.
fn still(way: &[DVec3]) -> Vec<SweptSegment> {
    way.windows(2)
        .map(|pair| SweptSegment { a0: pair[0], b0: pair[1], a1: pair[0], b1: pair[1] })
        .collect()
}

/// The cut of the skin of a part by a plane.
pub(super) struct Outline {
    cuts: Vec<[DVec3; 2]>,
    /// A place inside.
    pub centre: DVec3,
    along: DVec3,
}

impl Outline {
    /// Whether the plane cuts no skin.
    pub fn is_empty(&self) -> bool {
        self.cuts.is_empty()
    }

    /// Its farthest place in a direction, which taut rope touches; its centre without skin.
    pub fn farthest(&self, toward: DVec3) -> DVec3 {
        let places = self.cuts.iter().flatten().copied();
        places
            .reduce(|most, place| if place.dot(toward) > most.dot(toward) { place } else { most })
            .unwrap_or(self.centre)
    }

    /// Greatest distance from its centre in a unit direction within the plane [m].
    pub fn radius(&self, toward: DVec3) -> Option<f64> {
        let aside = self.along.cross(toward);
        let crossed = |[a, b]: &[DVec3; 2]| {
            let [p, q] = [*a - self.centre, *b - self.centre]
                .map(|place| (place.dot(aside), place.dot(toward)));
            let meets = (p.0 > 0.0) != (q.0 > 0.0);
            meets.then(|| p.1 + (q.1 - p.1) * p.0 / (p.0 - q.0)).filter(|radius| *radius > 0.0)
        };
        self.cuts.iter().filter_map(crossed).reduce(f64::max)
    }
}

/// The cut of a triangle by a plane above which its corners are so high.
fn cut(corners: [DVec3; 3], heights: [f64; 3]) -> Option<[DVec3; 2]> {
    let mut ends = [(0, 1), (1, 2), (2, 0)]
        .into_iter()
        .filter(|(i, j)| (heights[*i] > 0.0) != (heights[*j] > 0.0));
    let on_edge = |(i, j): (usize, usize)| {
        corners[i].lerp(corners[j], heights[i] / (heights[i] - heights[j]))
    };
    Some([on_edge(ends.next()?), on_edge(ends.next()?)])
}

/// Iteration limit.
const MOST_ROUNDS: usize = 200;
/// Accepted share of the required distance.
const ENOUGH: f64 = 0.98;
/// Shift of a node of a segment that intersects an edge [m].
const OUT_OF_SKIN_M: f64 = 1e-3;
/// Smallest bend at a node [m].
const STRAIGHT_M: f64 = 1e-5;

/// Shifts the inner nodes; `Err` is the region to which rope is still too close.
pub(super) fn shift_off(skin: &mut PosedSkin, laid: &mut Laid) -> Result<(), &'static str> {
    for _ in 0..MOST_ROUNDS {
        let nearest = skin.nearest(&laid.nodes);
        let mut moves = vec![(DVec3::ZERO, 0.0_f64); laid.nodes.len()];
        for (segment, near) in nearest.iter().enumerate() {
            let Some(near) = near.as_ref().filter(|near| near.distance_m < ENOUGH * skin.off_m)
            else {
                continue;
            };
            for (node, share) in [(segment, 1.0 - near.fraction), (segment + 1, near.fraction)] {
                let weight = share.max(0.25);
                let shift = if near.out == DVec3::ZERO {
                    outward(&laid.nodes, node)
                } else {
                    near.out * (skin.off_m - near.distance_m)
                };
                moves[node].0 += shift * weight;
                moves[node].1 += weight;
            }
            let stuck = |node: usize| moves[node].0.length() <= 0.0;
            if near.out == DVec3::ZERO && stuck(segment) && stuck(segment + 1) {
                return Err(near.region.name());
            }
        }
        let last = laid.nodes.len() - 1;
        (moves[0], moves[last]) = ((DVec3::ZERO, 0.0), (DVec3::ZERO, 0.0));
        if moves.iter().all(|(_, weight)| *weight <= 0.0) {
            return Ok(());
        }
        for (node, (shift, weight)) in laid.nodes.iter_mut().zip(&moves) {
            if *weight > 0.0 {
                *node += *shift / *weight;
            }
        }
    }
    let nearest = skin.nearest(&laid.nodes);
    let still = nearest.iter().flatten().find(|near| near.distance_m < 0.5 * skin.off_m);
    still.map_or(Ok(()), |near| Err(near.region.name()))
}

/// A small shift of a node towards the outside of its bend; zero at an end or a straight place.
fn outward(nodes: &[DVec3], node: usize) -> DVec3 {
    let (Some(before), Some(after)) =
        (node.checked_sub(1).and_then(|before| nodes.get(before)), nodes.get(node + 1))
    else {
        return DVec3::ZERO;
    };
    let bend = nodes[node] - before.midpoint(*after);
    if bend.length() > STRAIGHT_M { bend.normalize() * OUT_OF_SKIN_M } else { DVec3::ZERO }
}

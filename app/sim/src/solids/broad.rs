//! Which segments of rope may come near a solid in a step: groups of segments whose boxes come near a ball around the solid, among the
//! neighbours that a list keeps for several steps.
//!
//! The list holds while rope lies in its held boxes (`contact/pieces/held.rs`) and each solid's way lies in a box of its own; it is then
//! narrowed by the boxes of the step, so that what is found does not depend on how long it was kept.

use super::{Pose, Solid};
use crate::contact::pieces::{GROUPS, Pieces};
use crate::whale::Bounds;

/// Slack of a solid's box [m].
const SLACK_M: f64 = 0.04;

/// What rounding may take from the distance of a box from a plane [m].
const ROUNDING_M: f64 = 1e-9;

/// A group of segments near a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NearGroup {
    pub solid: usize,
    pub piece: usize,
    pub group: usize,
}

/// The list, for one layout of held boxes and one distance.
#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbours {
    /// Of which layout of held boxes, and for what distance; of none at first.
    of: Option<(u64, f64)>,
    /// Boxes in which the ways of solids' origins lie.
    held: Vec<Bounds>,
    near: Vec<NearGroup>,
}

impl Neighbours {
    /// Makes the list anew where it is not that of these held boxes, of solids that go from one pose to another, and of this distance.
    pub fn update(
        &mut self,
        all: &Pieces,
        solids: &[Solid],
        poses: &[[Pose; 2]],
        search_distance: f64,
    ) {
        let holds = |(held, poses): (&Bounds, &[Pose; 2])| held.holds(&way_of(poses));
        if self.of == Some((all.holding, search_distance))
            && self.held.len() == solids.len()
            && self.held.iter().zip(poses).all(holds)
        {
            return;
        }
        self.of = Some((all.holding, search_distance));
        self.held.clear();
        self.held.extend(poses.iter().map(|poses| way_of(poses).grown(SLACK_M)));
        self.near.clear();
        for (solid, thing) in solids.iter().enumerate() {
            let reach = Reach::of(thing, &self.held[solid], &poses[solid][0], search_distance);
            for (pieces, _) in &all.lines {
                for piece in pieces.clone() {
                    let own = &all.pieces[piece];
                    if reach.may_hold(&own.held_whole) {
                        let near = (0..GROUPS).filter(|group| reach.may_hold(&own.held[*group]));
                        self.near.extend(near.map(|group| NearGroup { solid, piece, group }));
                    }
                }
            }
        }
    }

    /// Groups whose box comes within a distance, no more than that of the list, of their solid: solid after solid, along each line.
    pub fn within<'a>(
        &'a self,
        all: &'a Pieces,
        solids: &'a [Solid],
        poses: &'a [[Pose; 2]],
        search_distance: f64,
    ) -> impl Iterator<Item = NearGroup> + 'a {
        self.near.iter().copied().filter(move |near| {
            let poses = &poses[near.solid];
            let way = way_of(poses);
            let reach = Reach::of(&solids[near.solid], &way, &poses[0], search_distance);
            reach.holds(&all.pieces[near.piece].groups[near.group])
        })
    }
}

/// The box around the way of a solid's origin.
#[inline(always)]
fn way_of(poses: &[Pose; 2]) -> Bounds {
    let [from, to] = [poses[0].place, poses[1].place];
    Bounds { low: from.min(to), high: from.max(to) }
}

/// Where rope is near a solid.
enum Reach {
    /// Its box meets this one.
    Around(Bounds),
    /// Its box comes within a distance of all that lies below a plane [m].
    Plane(Pose, f64),
}

impl Reach {
    #[inline(always)]
    fn of(solid: &Solid, way: &Bounds, pose: &Pose, search_distance: f64) -> Self {
        if solid.radius_m.is_finite() {
            Self::Around(way.grown(solid.radius_m + search_distance))
        } else {
            Self::Plane(*pose, search_distance)
        }
    }

    #[inline(always)]
    fn holds(&self, bounds: &Bounds) -> bool {
        match self {
            Self::Around(around) => around.meets(bounds),
            Self::Plane(plane, search_distance) => gap_to_plane(bounds, plane) <= *search_distance,
        }
    }

    /// Whether it may hold a box that lies in this one.
    fn may_hold(&self, bounds: &Bounds) -> bool {
        match self {
            Self::Around(around) => around.meets(bounds),
            Self::Plane(plane, search_distance) => {
                // The gap of an empty box is no number.
                gap_to_plane(bounds, plane) <= search_distance + ROUNDING_M
            }
        }
    }
}

/// How far a box lies above a plane [m].
fn gap_to_plane(bounds: &Bounds, plane: &Pose) -> f64 {
    let normal = plane.orientation * glam::DVec3::Z;
    let (middle, half) = (0.5 * (bounds.low + bounds.high), 0.5 * (bounds.high - bounds.low));
    normal.dot(middle - plane.place) - normal.abs().dot(half)
}

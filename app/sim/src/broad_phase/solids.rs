//! Which segments of rope may come near a solid in a step: groups of segments whose boxes come near a ball around the solid, among the
//! neighbours that a list keeps for several steps.
//!
//! The list holds while rope lies in its held boxes (`contact/pieces/held.rs`) and each solid's way lies in a box of its own; it is then
//! narrowed by the boxes of the step, so that what is found does not depend on how long it was kept.

use crate::broad_phase::pieces::{GROUPS, Pieces};
use crate::geometry::Pose;
use crate::solids::Solid;
use crate::whale::Bounds;

/// Initial capacity of the list in groups of rope for each solid, so that it rarely grows.
const USUAL_GROUPS: usize = 32;

/// Slack of a solid's box [m].
const SLACK_M: f64 = 0.04;

/// Margin for rounding in the distance of a box from a plane [m].
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
    /// Number of the layout of held boxes, and the distance, for which the list holds.
    of: Option<(u64, f64)>,
    /// Boxes in which the ways of solids' origins lie.
    held: Vec<Bounds>,
    near: Vec<NearGroup>,
}

impl Neighbours {
    /// Builds the list, if it does not hold for these held boxes, paths of solids and distance.
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
        self.near.reserve(USUAL_GROUPS * solids.len());
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

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3};

    use super::*;
    use crate::bits::unit;
    use crate::geometry::shape::SolidShape;
    use crate::metrics::tests::{model, spec};
    use crate::model::{Obstacle, ROPE_ON_HARD_N_M2, RopeOnRope};

    fn vector(seed: u64, index: usize) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|axis| 2.0 * unit(seed, 3 * index as u64 + axis) - 1.0))
    }

    fn solids() -> Vec<Solid> {
        let shapes =
            [SolidShape::Sphere(0.4), SolidShape::Box(DVec3::splat(0.2)), SolidShape::Plane];
        let obstacle = |shape| Obstacle {
            id: "solid".into(),
            shape,
            position_m: DVec3::NEG_Z,
            orientation: DQuat::from_rotation_y(0.3),
            friction: 0.5,
            stiffness_n_m2: ROPE_ON_HARD_N_M2,
        };
        shapes.map(|shape| Solid::of_obstacle(&obstacle(shape))).into()
    }

    /// Rope and solids wander, now slowly, now fast; every group of every piece is tested one by one.
    #[test]
    fn a_kept_list_finds_all_groups_that_come_near() {
        let mut spec = spec(vec![0.1; 70]);
        spec.settings.rope_on_rope = Some(RopeOnRope::default());
        let model = model(spec);
        let (mut all, mut kept) = (Pieces::new(&model), Neighbours::default());
        let (solids, mut found) = (solids(), [0; 3]);
        let mut places: Vec<DVec3> = (0..71).map(|node| DVec3::X * 0.1 * f64::from(node)).collect();
        let mut poses: Vec<[Pose; 2]> = vec![
            [Pose { place: DVec3::new(2.0, 0.5, 0.2), orientation: DQuat::IDENTITY }; 2],
            [Pose { place: DVec3::new(6.0, -0.5, 0.0), orientation: DQuat::IDENTITY }; 2],
            [Pose { place: DVec3::NEG_Z, orientation: DQuat::from_rotation_y(-0.15) }; 2],
        ];
        for step in 0..400_u64 {
            let pace_m = [0.001, 0.01, 0.2][(step / 30 % 3) as usize];
            // Rope that strays is drawn back.
            let home = |node: usize| DVec3::X * 0.1 * node as f64;
            let moves: Vec<DVec3> = (0..71)
                .map(|node| {
                    let back = 0.5 * (home(node) - places[node]);
                    pace_m * (vector(step / 7, 100) + 0.1 * vector(step, node) + back)
                })
                .collect();
            all.measure(&places, |node| places[node] + moves[node], &[0.1; 70]);
            for (index, poses) in poses.iter_mut().take(2).enumerate() {
                poses[0] = poses[1];
                let home = DVec3::X * [2.0, 6.0][index];
                let back = 0.5 * (home - poses[0].place);
                poses[1].place += pace_m * (vector(step / 7, 200 + index) + back);
            }
            kept.update(&all, &solids, &poses, 0.05);
            let distance = if step % 2 == 0 { 0.05 } else { 0.01 };
            let near: Vec<NearGroup> = kept.within(&all, &solids, &poses, distance).collect();
            let mut expected = Vec::new();
            for (solid, thing) in solids.iter().enumerate() {
                let around = way_of(&poses[solid]).grown(thing.radius_m + distance);
                let normal = poses[solid][0].orientation * DVec3::Z;
                for (piece, own) in all.pieces.iter().enumerate() {
                    for (group, bounds) in own.groups.iter().enumerate() {
                        // The corner of the box that lies deepest below a plane.
                        let deepest =
                            DVec3::select(normal.cmpgt(DVec3::ZERO), bounds.low, bounds.high);
                        let above = normal.dot(deepest - poses[solid][0].place);
                        let is_near = match thing.shape {
                            SolidShape::Plane => above <= distance,
                            _ => around.meets(bounds),
                        };
                        if is_near {
                            expected.push(NearGroup { solid, piece, group });
                            found[solid] += 1;
                        }
                    }
                }
            }
            assert_eq!(near, expected, "step {step}");
            places.iter_mut().zip(&moves).for_each(|(place, moved)| *place += *moved);
        }
        println!("{found:?} found, {} layouts", all.holding);
        assert!(found.iter().all(|count| *count > 50), "{found:?}");
        assert!(all.holding > 5 && all.holding < 200, "{} layouts", all.holding);
    }
}

//! Where two cores are nearest, and where else two bodies may bear on each other.
//!
//! Points, rods and planes by closed forms; boxes, cylinders and spheroids by the library parry: the algorithm of Gilbert, Johnson and Keerthi for the
//! least distance, and the places where two faces overlap. On curved sides that search ends early; from there the nearest places of one core to
//! that of the other are taken by turns.

use glam::DVec3;
use parry3d::math::Pose as Frame;
use parry3d::query::details::{
    closest_points_support_map_support_map, contact_manifold_cuboid_cuboid,
};
use parry3d::query::{ClosestPoints, ContactManifold};
use parry3d::shape::{Segment, SupportMap};

use crate::geometry::Pose;
use crate::geometry::core::convex::{Convex, nearest_to_segment};
use crate::geometry::core::{BodyCore, Core};
use crate::geometry::distance::segment_segment;

/// Most turns from one core to the other, and a move below which they end [m].
const TURNS: usize = 64;
const SETTLED_M: f64 = 1e-11;

impl BodyCore {
    /// Nearest places of this core and another, each in a pose: on this one, then on the other; `None` where they meet.
    pub fn nearest_to(&self, pose: &Pose, other: &Self, other_pose: &Pose) -> Option<[DVec3; 2]> {
        let [mine, others] = match (&self.core, &other.core) {
            (Core::Point, _) => {
                let place = pose.outward(self.middle);
                [place, other.nearest_to_place(other_pose, place)]
            }
            (_, Core::Point) => {
                let place = other_pose.outward(other.middle);
                [self.nearest_to_place(pose, place), place]
            }
            (Core::Rod(_), Core::Rod(_)) => {
                let (one, two) = (self.axis(pose), other.axis(other_pose));
                let (s, t) = segment_segment(one, two);
                [one[0].lerp(one[1], s), two[0].lerp(two[1], t)]
            }
            (Core::Box(cuboid), Core::Rod(_)) => {
                self.nearest_to_rod(pose, cuboid, other.axis(other_pose))?
            }
            (Core::Cylinder(cylinder), Core::Rod(_)) => {
                self.curved_to_rod(pose, cylinder, other.axis(other_pose))
            }
            (Core::Spheroid(spheroid), Core::Rod(_)) => {
                self.curved_to_rod(pose, spheroid, other.axis(other_pose))
            }
            (Core::Rod(_), Core::Box(_) | Core::Spheroid(_)) => {
                let [others, mine] = other.nearest_to(other_pose, self, pose)?;
                [mine, others]
            }
            (Core::Rod(_), Core::Cylinder(cylinder)) => {
                let [_, mine] = other.nearest_to_rod(other_pose, cylinder, self.axis(pose))?;
                self.refined(pose, (other, other_pose), mine)
            }
            (Core::Box(cuboid), Core::Box(second)) => {
                let there = self.frame_of(pose, (other, other_pose));
                self.nearest_to_shape(pose, cuboid, second, &there)?
            }
            (Core::Box(cuboid), Core::Cylinder(cylinder)) => {
                let there = self.frame_of(pose, (other, other_pose));
                let [mine, _] = self.nearest_to_shape(pose, cuboid, cylinder, &there)?;
                self.refined(pose, (other, other_pose), mine)
            }
            (_, Core::HalfSpace) => {
                let lowest = self.lowest_over(pose, (other, other_pose))?;
                [lowest, other.nearest_to_place(other_pose, lowest)]
            }
            (Core::HalfSpace, _) => return None,
            (Core::Box(_) | Core::Cylinder(_) | Core::Spheroid(_), _) => {
                self.nearest_to_curved(pose, (other, other_pose))?
            }
        };
        (mine.distance_squared(others) > 0.0).then_some([mine, others])
    }

    /// Nearest places of this core, which has a shape, and a rod; `None` where they meet.
    fn nearest_to_rod(
        &self,
        pose: &Pose,
        mine: &impl SupportMap,
        rod: [DVec3; 2],
    ) -> Option<[DVec3; 2]> {
        let [from, to] = rod.map(|end| pose.inward(end) - self.middle);
        self.nearest_to_shape(pose, mine, &Segment::new(from, to), &Frame::IDENTITY)
    }

    /// Nearest places of this core, which has a curved side, and a rod; equal where they meet.
    fn curved_to_rod(&self, pose: &Pose, mine: &impl Convex, rod: [DVec3; 2]) -> [DVec3; 2] {
        let inward = rod.map(|end| pose.inward(end) - self.middle);
        nearest_to_segment(mine, inward).map(|place| pose.outward(place + self.middle))
    }

    /// Nearest places of this core and another, of which one at least has a curved side: from one to the other by turns, from where the search for
    /// the least distance ends. `None` where they meet.
    fn nearest_to_curved(
        &self,
        pose: &Pose,
        (other, other_pose): (&Self, &Pose),
    ) -> Option<[DVec3; 2]> {
        let there = self.frame_of(pose, (other, other_pose));
        let mut mine = match (&self.core, &other.core) {
            (Core::Box(one), Core::Spheroid(two)) => self.nearest_to_shape(pose, one, two, &there),
            (Core::Cylinder(one), Core::Box(two)) => self.nearest_to_shape(pose, one, two, &there),
            (Core::Cylinder(one), Core::Cylinder(two)) => {
                self.nearest_to_shape(pose, one, two, &there)
            }
            (Core::Cylinder(one), Core::Spheroid(two)) => {
                self.nearest_to_shape(pose, one, two, &there)
            }
            (Core::Spheroid(one), Core::Box(two)) => self.nearest_to_shape(pose, one, two, &there),
            (Core::Spheroid(one), Core::Cylinder(two)) => {
                self.nearest_to_shape(pose, one, two, &there)
            }
            (Core::Spheroid(one), Core::Spheroid(two)) => {
                self.nearest_to_shape(pose, one, two, &there)
            }
            _ => None,
        }?[0];
        let mut others = other.nearest_to_place(other_pose, mine);
        for _ in 0..TURNS {
            let next = self.nearest_to_place(pose, others);
            others = other.nearest_to_place(other_pose, next);
            let moved = next.distance_squared(mine);
            mine = next;
            if moved < SETTLED_M * SETTLED_M {
                break;
            }
        }
        Some([mine, others])
    }

    /// The lowest place of this core over a plane; `None` if it is a plane itself.
    fn lowest_over(&self, pose: &Pose, (plane, plane_pose): (&Self, &Pose)) -> Option<DVec3> {
        let down = pose.orientation.inverse() * (plane_pose.orientation * DVec3::NEG_Z);
        let outward = |place: DVec3| Some(pose.outward(place + self.middle));
        match &self.core {
            Core::Cylinder(cylinder) => outward(cylinder.local_support_point(down)),
            Core::Spheroid(spheroid) => outward(spheroid.local_support_point(down)),
            _ => {
                let height = |place: DVec3| plane_pose.inward(place).z - plane.middle.z;
                self.ends(pose).min_by(|one, two| height(*one).total_cmp(&height(*two)))
            }
        }
    }

    /// Nearest places of this core and another from one of this core that is nearly the nearest: on a curved side the search ends early.
    fn refined(&self, pose: &Pose, (other, other_pose): (&Self, &Pose), mine: DVec3) -> [DVec3; 2] {
        let mine = self.nearest_to_place(pose, other.nearest_to_place(other_pose, mine));
        [mine, other.nearest_to_place(other_pose, mine)]
    }

    /// The frame of another core in that of this one.
    fn frame_of(&self, pose: &Pose, (other, other_pose): (&Self, &Pose)) -> Frame {
        let middle = pose.inward(other_pose.outward(other.middle)) - self.middle;
        Frame::from_parts(middle, pose.orientation.inverse() * other_pose.orientation)
    }

    /// Nearest places of this core and another shape in its frame, in the world; `None` where they meet.
    fn nearest_to_shape(
        &self,
        pose: &Pose,
        mine: &impl SupportMap,
        shape: &impl SupportMap,
        there: &Frame,
    ) -> Option<[DVec3; 2]> {
        let found = closest_points_support_map_support_map(there, mine, shape, f64::MAX);
        let ClosestPoints::WithinMargin(mine, others) = found else { return None };
        Some([mine, *there * others].map(|place| pose.outward(place + self.middle)))
    }

    /// Places at which the faces of two boxes that lie along each other bear, up to `reach` apart: number, place on this one and on the other.
    /// Empty if either is not a box, or no faces are parallel.
    pub fn faces_along(
        &self,
        pose: &Pose,
        (other, other_pose): (&Self, &Pose),
        reach: f64,
        scratch: &mut ContactManifold<(), ()>,
        found: &mut Vec<(u64, [DVec3; 2])>,
    ) {
        let (Core::Box(mine), Core::Box(others)) = (&self.core, &other.core) else { return };
        let there = self.frame_of(pose, (other, other_pose));
        scratch.clear();
        contact_manifold_cuboid_cuboid(&there, mine, others, reach, scratch);
        found.extend(scratch.points.iter().map(|point| {
            let number = (u64::from(point.fid1.0) << 32) | u64::from(point.fid2.0);
            let places = [point.local_p1, there * point.local_p2];
            (number, places.map(|place| pose.outward(place + self.middle)))
        }));
    }

    /// Ends of a rod, corners of a box and places round the rims of a cylinder in a pose; empty for others.
    pub fn ends(&self, pose: &Pose) -> impl Iterator<Item = DVec3> {
        let rod = matches!(self.core, Core::Rod(_)).then(|| self.axis(pose));
        rod.into_iter().flatten().chain(self.corners(pose))
    }
}

//! Where two cores are nearest, and where else two bodies may bear on each other.
//!
//! Points and rods by closed forms; boxes by the library parry: the algorithm of Gilbert, Johnson and Keerthi for the least distance, and the
//! places where two faces overlap.

use glam::DVec3;
use parry3d::math::Pose as Frame;
use parry3d::query::details::{
    closest_points_support_map_support_map, contact_manifold_cuboid_cuboid,
};
use parry3d::query::{ClosestPoints, ContactManifold};
use parry3d::shape::{Cuboid, Segment, SupportMap};

use crate::contact::bodies::core::{BodyCore, Core};
use crate::contact::distance::segment_segment;
use crate::solids::Pose;

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
                let rod = other.axis(other_pose).map(|end| pose.inward(end) - self.middle);
                self.nearest_to_shape(
                    pose,
                    cuboid,
                    &Segment::new(rod[0], rod[1]),
                    &Frame::IDENTITY,
                )?
            }
            (Core::Rod(_), Core::Box(_)) => {
                let [others, mine] = other.nearest_to(other_pose, self, pose)?;
                [mine, others]
            }
            (Core::Box(cuboid), Core::Box(second)) => {
                let middle = pose.inward(other_pose.outward(other.middle)) - self.middle;
                let turn = pose.orientation.inverse() * other_pose.orientation;
                self.nearest_to_shape(pose, cuboid, second, &Frame::from_parts(middle, turn))?
            }
        };
        (mine.distance_squared(others) > 0.0).then_some([mine, others])
    }

    /// Nearest places of a box core and another shape that lies in the box's frame so, in the world; `None` where they meet.
    fn nearest_to_shape(
        &self,
        pose: &Pose,
        cuboid: &Cuboid,
        shape: &impl SupportMap,
        there: &Frame,
    ) -> Option<[DVec3; 2]> {
        let found = closest_points_support_map_support_map(there, cuboid, shape, f64::MAX);
        let ClosestPoints::WithinMargin(mine, others) = found else { return None };
        Some([mine, *there * others].map(|place| pose.outward(place + self.middle)))
    }

    /// The place of the core in a pose that is nearest to another place.
    pub fn nearest_to_place(&self, pose: &Pose, place: DVec3) -> DVec3 {
        let inward = pose.inward(place) - self.middle;
        let nearest = match &self.core {
            Core::Point => DVec3::ZERO,
            Core::Rod(half) => DVec3::Z * inward.z.clamp(-half, *half),
            Core::Box(cuboid) => inward.clamp(-cuboid.half_extents, cuboid.half_extents),
        };
        pose.outward(nearest + self.middle)
    }

    /// Places at which the faces of two boxes that lie along each other bear, up to `reach` apart: number, place on this one and on the other.
    /// None where either is not a box, or no faces lie along each other.
    pub fn faces_along(
        &self,
        pose: &Pose,
        (other, other_pose): (&Self, &Pose),
        reach: f64,
        scratch: &mut ContactManifold<(), ()>,
        found: &mut Vec<(u64, [DVec3; 2])>,
    ) {
        let (Core::Box(mine), Core::Box(others)) = (&self.core, &other.core) else { return };
        let middle = pose.inward(other_pose.outward(other.middle)) - self.middle;
        let there = Frame::from_parts(middle, pose.orientation.inverse() * other_pose.orientation);
        scratch.clear();
        contact_manifold_cuboid_cuboid(&there, mine, others, reach, scratch);
        found.extend(scratch.points.iter().map(|point| {
            let number = (u64::from(point.fid1.0) << 32) | u64::from(point.fid2.0);
            let places = [point.local_p1, there * point.local_p2];
            (number, places.map(|place| pose.outward(place + self.middle)))
        }));
    }

    /// Ends of a rod and corners of a box in a pose; none of a point.
    pub fn ends(&self, pose: &Pose) -> impl Iterator<Item = DVec3> {
        let rod = matches!(self.core, Core::Rod(_)).then(|| self.axis(pose));
        rod.into_iter().flatten().chain(self.corners(pose))
    }
}

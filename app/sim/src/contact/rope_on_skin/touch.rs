//! A point of rope that touches a face of skin.

use glam::DVec3;

use crate::contact::law::barrier::BarrierForce;
use crate::geometry::norm;

/// A contact point in touch with one face of skin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    pub pair: usize,
    pub barycentric: [f64; 3],
    /// The pair whose region of skin gives the friction: that at the first evaluation of this face in the solver step. Where two regions
    /// meet, friction would else change from iteration to iteration.
    pub region_pair: usize,
    pub place: DVec3,
    /// Direction of the push: across the rope, for skin cannot pull rope along itself.
    pub normal: DVec3,
    /// Direction in which the distance grows: from the closest point of the skin to the place.
    pub away: DVec3,
    pub distance: f64,
    /// The push, and its growth with depth, where it is taken as linear.
    pub barrier: BarrierForce,
    /// Increment of that linear force to this distance; zero if it is evaluated at this distance [N].
    pub growth_n: f64,
    /// Share of the push that this face has beside others, and of the rope's length that lies on it.
    pub share: f64,
    /// Gradient of its share beside one other face; zero beside several [1/m].
    pub share_gradient: DVec3,
    /// Growth of the normal force by a move that changes the share [N/m].
    share_slope: DVec3,
    /// Normal force of the last solution, or expected before the first [N].
    pub solved_n: Option<f64>,
    /// Index of the stored face of the last solver step in `SkinContactPoints::kept`, in the order of `FrictionState`.
    pub kept: Option<usize>,
}

/// Length of `away` across the rope up to which the normal force is along `away`, and from which it is wholly across the rope.
const ACROSS: (f64, f64) = (0.2, 0.4);
/// Least share that a solution may leave a face.
const LEAST_SHARE: f64 = 1e-3;
/// Cosine of the angle of two normals above which a face is the one that was touched before.
pub(crate) const SAME_FACE: f64 = 0.7;

impl Touch {
    /// Skin at a distance along `away`, without a push as yet.
    pub fn new(
        (pair, barycentric): (usize, [f64; 3]),
        place: DVec3,
        (away, distance): (DVec3, f64),
    ) -> Self {
        Self {
            pair,
            barycentric,
            region_pair: pair,
            place,
            normal: away,
            away,
            distance,
            barrier: BarrierForce::default(),
            growth_n: 0.0,
            share: 1.0,
            share_gradient: DVec3::ZERO,
            share_slope: DVec3::ZERO,
            solved_n: None,
            kept: None,
        }
    }

    /// Sets the normal force by the law at this distance, with a contact distance and the stiffness of a face alone.
    pub fn take_law(&mut self, (contact_distance, stiffness): (f64, f64)) {
        self.barrier = BarrierForce::new(self.distance, contact_distance, stiffness * self.share);
    }

    /// Turns the normal force across a rope along `along`.
    ///
    /// Rope that slides over an edge would otherwise be pushed back by each contact point before the edge and drawn on by each
    /// behind it, and the push would turn as the contact point passes.
    pub fn turn_across(&mut self, along: DVec3) {
        let ahead = along * along.dot(self.away);
        let length = norm::length(self.away - ahead);
        let part = ((length - ACROSS.0) / (ACROSS.1 - ACROSS.0)).clamp(0.0, 1.0);
        self.normal = norm::normalize_or(self.away - ahead * part, self.away);
    }

    /// This face as it was touched `before`, if it is among those faces.
    pub fn among<'a>(&self, before: &'a [Self]) -> Option<&'a Self> {
        let alike = |other: &&Self| other.normal.dot(self.normal);
        before
            .iter()
            .filter(|other| alike(other) > SAME_FACE)
            .max_by(|one, other| alike(one).total_cmp(&alike(other)))
    }

    /// Normal force of the last solution, as if it were alone [N].
    pub fn whole_solved_n(&self) -> Option<f64> {
        Some(self.solved_n? / self.share)
    }

    /// Makes the normal force linear about the solved one where the law is steep.
    pub fn take_solved(&mut self, contact_distance: f64, stiffness: f64) {
        let law = (self.distance, contact_distance, stiffness * self.share);
        (self.barrier, self.growth_n) = self.barrier.about_solved(self.solved_n, law);
        self.share_slope =
            self.share_gradient * ((self.barrier.force + self.growth_n) / self.share);
    }

    /// Difference between the normal force of a solution that moves rope by `step` and the law there [N].
    pub fn law_missed(&self, step: DVec3, contact_distance: f64, stiffness: f64) -> f64 {
        let distance = self.distance + self.away.dot(step);
        let law = BarrierForce::new(distance, contact_distance, stiffness * self.share_after(step));
        (self.push_after(step) - law.force).abs()
    }

    /// Makes the normal force linear about a solution that moves rope by `step`; if that force is negative, about the law there.
    pub fn follow_law(&mut self, step: DVec3, contact_distance: f64, stiffness: f64) {
        let (stiffness, solved_n) = (stiffness * self.share_after(step), self.push_after(step));
        let depth = contact_distance - self.distance;
        let (depth_there, barrier) = if solved_n > 0.0 {
            BarrierForce::at_force(solved_n, contact_distance, stiffness)
        } else {
            let distance = self.distance + self.away.dot(step);
            let law = BarrierForce::new(distance, contact_distance, stiffness);
            (contact_distance - distance, law)
        };
        self.barrier = barrier;
        self.growth_n = barrier.stiffness * (depth - depth_there) - self.share_slope.dot(step);
    }

    /// Its share after a move, within what a share can be.
    fn share_after(&self, step: DVec3) -> f64 {
        (self.share + self.share_gradient.dot(step)).clamp(LEAST_SHARE, 1.0)
    }

    /// Decrease of the normal force by a move [N/m].
    pub fn decrease(&self) -> DVec3 {
        self.away * self.barrier.stiffness - self.share_slope
    }

    /// The push here after the rope has moved by a solved step [N].
    pub fn push_after(&self, step: DVec3) -> f64 {
        self.barrier.force + self.growth_n - self.decrease().dot(step)
    }
}

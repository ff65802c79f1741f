//! Contact points: where rope may touch a solid, with the grip and stiffness there.

use glam::{DMat3, DVec3};

use crate::contact::rope_on_solid::RopeOnSolid;
use crate::geometry::Pose;
use crate::solids::{Carrier, Solid};
use crate::state::{Bears, SolidGrip, State};

/// Rope that comes this close in a step may touch [m].
pub(crate) const TOUCH_M: f64 = 2e-3;
/// Length of rope that bears at a point within a segment, for its stiffness [m].
const EDGE_M: f64 = 0.05;
/// How far a grip within a segment may move along the rope in a step [m].
const FOLLOWED_M: f64 = 0.05;
/// Largest total stiffness of contact on a body, as a share of its mass over the step squared: rope and body respond to each other from
/// iteration to iteration, which converges faster the softer the contact is.
const BODY_SHARE: f64 = 0.3;
/// While rope stays on a body, the bound of its stiffness rises by the factor `1 + dt / STIFFER_S` in a step at most. The share above grows
/// with the inverse square of the step; without this limit, rope that lay in soft contact was thrown out when steps became shorter [s].
const STIFFER_S: f64 = 0.5;

/// A point of rope that may touch a solid.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SolidContactPoint {
    pub solid: usize,
    pub line: usize,
    pub segment: usize,
    /// First node of the segment, or the node itself.
    pub node: usize,
    /// Fraction along the segment; `None` at the node itself.
    pub fraction: Option<f64>,
    /// Which part of the rope bears.
    pub bears: Bears,
    /// Half the diameter of the rope, or of the knot [m].
    pub radius_m: f64,
    /// Whether there is anything to touch here.
    pub open: bool,
    /// Stretch of the grip when the step began, in the solid's frame [m].
    pub kept: DVec3,
    /// Depth that is forgiven: rope that began deep inside an obstacle is pushed out softly [m].
    pub forgiven_m: f64,
    /// Stiffness [N/m].
    pub stiffness: f64,
    /// Largest stiffness of a contact on its body in this step [N/m].
    pub most_n_m: f64,
    /// Normal force that the last solve predicted [N].
    pub predicted_n: f64,
    /// Normal force at the places of the last assembly, below zero where there is a gap [N].
    pub push_n: f64,
    /// Whether it pushes in the solution sought.
    pub pushes: bool,
    /// Place of the rope at the last assembly [m].
    pub place: DVec3,
    /// Direction out of the solid there.
    pub normal: DVec3,
    /// Push and friction on the rope at the places of the last assembly, and `-d force / d place` [N], [N/m].
    pub force: DVec3,
    pub block: DMat3,
    /// Push and friction by the last solution: as the rope has them, and as the body has their reaction [N].
    pub solved: [DVec3; 2],
}

impl SolidContactPoint {
    /// Notes normal force, push and friction of a solution in which the rope moves so, in the world and as seen from the solid [m].
    pub fn predict(&mut self, rope: DVec3, relative: DVec3) {
        self.predicted_n = self.push_n - self.stiffness * self.normal.dot(relative);
        self.solved = [rope, relative - rope].map(|step| self.force - self.block * step);
    }

    /// The value of a quantity of nodes at this point of the rope.
    pub fn on_rope(&self, at: impl Fn(usize) -> DVec3) -> DVec3 {
        match self.fraction {
            None => at(self.node),
            Some(fraction) => at(self.node).lerp(at(self.node + 1), fraction),
        }
    }
}

impl RopeOnSolid {
    /// Stiffness, grip and first normal force of a contact point whose rope moves between two places.
    pub(crate) fn begin_point(
        &mut self,
        state: &State,
        solid: &Solid,
        point: SolidContactPoint,
        places: [DVec3; 2],
        poses: &[Pose; 2],
    ) -> SolidContactPoint {
        let radius = point.radius_m;
        let depths = [0, 1].map(|k| radius - solid.shape.distance(poses[k].inward(places[k])));
        self.touching |= depths[0].max(depths[1]) > -TOUCH_M;
        let is_fixed = matches!(solid.carrier, Carrier::World(_));
        let forgiven_m = if is_fixed { (depths[0] - radius).max(0.0) } else { 0.0 };
        let point = SolidContactPoint { forgiven_m, ..self.regrip(state, solid, point) };
        let here_n = point.stiffness * (depths[1] - forgiven_m);
        let known =
            self.predicted.binary_search_by_key(&(point.solid, point.node), |(key, _)| *key).ok();
        let predicted_n = match known.filter(|_| point.bears == Bears::Node) {
            Some(known) => self.predicted[known].1,
            None if point.predicted_n > 0.0 => point.predicted_n,
            None => here_n,
        };
        SolidContactPoint { predicted_n, ..point }
    }

    /// Stiffness of a contact point, and the grip that it continues.
    pub(crate) fn regrip(
        &self,
        state: &State,
        solid: &Solid,
        mut point: SolidContactPoint,
    ) -> SolidContactPoint {
        let along_m = self.along_of(&point);
        let length = match point.bears {
            Bears::Node => self.node_length(point.node),
            Bears::Within => self.length_of(point.node).min(EDGE_M),
            Bears::Knot => 2.0 * point.radius_m,
        };
        point.most_n_m = self.most_on_body(solid, point.solid, state);
        point.stiffness = match self.at_rest_n_m2.filter(|_| solid.mass_kg.is_finite()) {
            Some(soft_n_m2) => soft_n_m2 * length,
            None => (solid.stiffness_n_m2 * length).min(point.most_n_m),
        };
        let farthest = if point.bears == Bears::Within { FOLLOWED_M } else { 1e-9 };
        let mine = |grip: &&SolidGrip| {
            grip.solid == point.solid
                && grip.line == point.line
                && grip.bears == point.bears
                && (grip.along_m - along_m).abs() <= farthest
        };
        let nearest = state
            .rope
            .solid_grips
            .iter()
            .filter(mine)
            .min_by(|a, b| (a.along_m - along_m).abs().total_cmp(&(b.along_m - along_m).abs()));
        if let Some(grip) = nearest {
            (point.kept, point.predicted_n) = (grip.stretch, grip.push_n);
        }
        point
    }

    /// Largest stiffness of a contact point on the body of a solid; infinite on an obstacle [N/m].
    fn most_on_body(&self, solid: &Solid, index: usize, state: &State) -> f64 {
        if solid.mass_kg.is_infinite() {
            return f64::INFINITY;
        }
        let on_body = |grip: &&SolidGrip| self.body_of[grip.solid] == self.body_of[index];
        let held = state.rope.solid_grips.iter().filter(on_body);
        let share = BODY_SHARE * solid.mass_kg / (self.dt * self.dt);
        let (count, before) = held
            .fold((0, f64::INFINITY), |(count, least), grip| (count + 1, least.min(grip.most_n_m)));
        (share / f64::from(count + 1)).min(before * (1.0 + self.dt / STIFFER_S))
    }

    /// Unstretched length that hangs on a node [m].
    fn node_length(&self, node: usize) -> f64 {
        let before = if node > 0 && self.along_m[node] > 0.0 {
            self.along_m[node] - self.along_m[node - 1]
        } else {
            0.0
        };
        let after =
            self.along_m.get(node + 1).map_or(0.0, |next| (next - self.along_m[node]).max(0.0));
        0.5 * (before + after)
    }
}

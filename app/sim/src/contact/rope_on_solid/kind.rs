//! Rope pressed on obstacles and on the bodies of the rig.
//!
//! At a contact point (`contact/rope_on_solid/workspace.rs`) with depth `p` of the rope's surface below the solid's and stiffness `k`: `N = k p` while
//! it pushes, block `k n nᵀ`. Whether it pushes is judged by the normal force that the last solve predicted, as for
//! tension: Newton then ends in a few passes. Friction is the elastic grip that slips at `μN` (`elastic_grip.rs`), its block
//! not symmetric, so that it follows the normal force within the solve.
//! A solid that stands still only acts on the rope. On a body of the rig the reaction acts at the same point, with its
//! own block; what the one's move does to the other is left to the next pass (block Jacobi), which closes in on the
//! balance because the contact is kept softer than the body's inertia.
//! With node turn `φ` and contact at nodes alone, sliding gives `T₂/T₁ = (1 + μ tan φ/2)/(1 - μ tan φ/2)` a node.

use glam::{DMat3, DQuat, DVec3};

use crate::contact::law::elastic_grip::{Grip, Push};
use crate::contact::rope_on_solid::{Pair, SolidContactPoint, least_distance};
use crate::contact::{ANSWER_STRICTER, ContactMissed, GRIP_STRICTER};
use crate::geometry::Pose;
use crate::matrix::outer;
use crate::model::Model;
use crate::solids::{Carrier, Solid};
use crate::solver::Solver;
use crate::state::{SolidGrip, State};
use crate::trial::BodyTrial;
use crate::trial::plan::Attachment;
use crate::trial::scheme::Scheme;

/// Share of a solid's thickness that rope may move in a step without its path being looked at.
const UNWATCHED_SHARE: f64 = 0.4;
/// Share of an obstacle's thickness that rope may go into it in a pass of statics.
const STATIC_SHARE: f64 = 0.1;
/// Share of a solid's thickness between two looks at a path.
const LOOK_SHARE: f64 = 0.2;
/// Most looks at a path.
const MOST_LOOKS: f64 = 64.0;
/// Share of a solid's thickness below its surface at which rope has gone into it.
const INSIDE_SHARE: f64 = 0.25;

/// How a contact point is judged to push.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ActiveSet {
    /// By the normal force that the last solve predicted.
    Predicted,
    /// By its depth where it is.
    AtTrial,
}

/// A contact point at the trial places.
struct Touch {
    normal: DVec3,
    /// Depth of the rope's surface below the solid's; below zero there is a gap [m].
    depth: f64,
    /// Place of the rope's centre line.
    place: DVec3,
    /// Where the solid is.
    pose: Pose,
}

impl Solver {
    /// Adds push and friction of obstacles and bodies on rope near them.
    pub(crate) fn add_solids(&mut self, state: &State, scheme: &Scheme, active_set: ActiveSet) {
        self.measure_solids(state, scheme, active_set);
        for point in self.solid.open_points().filter(|point| point.pushes) {
            let (force, block) = (point.force, &point.block);
            match point.fraction {
                Some(fraction) => {
                    self.tridiagonal.add_at(point.segment, point.node, fraction, force, block)
                }
                None => {
                    self.tridiagonal.force[point.node] += force;
                    self.tridiagonal.diagonal[point.node] += *block;
                }
            }
        }
        self.push_bodies_by_rope();
    }

    /// Measures push and friction of obstacles and bodies on rope near them, where the trial stands.
    pub(crate) fn measure_solids(&mut self, state: &State, scheme: &Scheme, active_set: ActiveSet) {
        let mut work = std::mem::take(&mut self.solid);
        if scheme.is_static() {
            work.gather_at_rest(
                state,
                &mut self.pieces,
                &self.trial.place,
                self.trial.bodies.iter().map(BodyTrial::pose),
            );
        } else if !work.pairs.is_empty() {
            work.follow_all(state, &self.trial.place, |carrier| self.pose_of(carrier));
        }
        for (solids, point) in work.open_points_mut() {
            let solid = &solids[point.solid];
            let touch = self.touch_of(solid, point);
            point.normal = touch.normal;
            point.push_n = point.stiffness * touch.depth;
            point.place = touch.place;
            point.pushes = match active_set {
                ActiveSet::Predicted => point.predicted_n > 0.0 && touch.depth > -point.radius_m,
                ActiveSet::AtTrial => point.push_n > 0.0,
            };
            (point.force, point.block) = if point.pushes {
                force_of(state, scheme, solid, point, &touch)
            } else {
                (DVec3::ZERO, DMat3::ZERO)
            };
        }
        self.solid = work;
    }

    /// The reaction of rope on bodies as measured last.
    pub(crate) fn push_bodies_by_rope(&mut self) {
        for point in self.solid.open_points().filter(|point| point.pushes) {
            if let Some(body) = self.solid.solids[point.solid].carrier.body() {
                let arm = point.place - self.trial.bodies[body].place;
                let attachment = Attachment::Body {
                    block: self.plan.body_block[body],
                    body,
                    offset: DVec3::ZERO,
                };
                self.interface.push(attachment, arm, -point.force);
                self.interface.add(attachment, arm, attachment, arm, point.block);
            }
        }
    }

    /// Hands push and friction as measured last to the lanes.
    pub(crate) fn give_solids_to_lanes(&mut self, model: &Model) {
        for point in self.solid.open_points().filter(|point| point.pushes) {
            let first = model.line_nodes[point.line].start + point.segment
                - model.line_segments[point.line].start;
            let at_node = if point.node == first { 0.0 } else { 1.0 };
            let fraction = point.fraction.unwrap_or(at_node);
            self.lanes.add_contact(point.segment, fraction, point.force, &point.block);
        }
    }

    /// Slope of the push and friction of solids at a share of the solved step.
    pub(crate) fn solid_slope(&self, state: &State, scheme: &Scheme, share: f64) -> f64 {
        let slope_of = |point: &SolidContactPoint| {
            let solid = &self.solid.solids[point.solid];
            let touch = self.touch_moved(solid, point, share);
            let point = SolidContactPoint { push_n: point.stiffness * touch.depth, ..*point };
            if point.push_n <= 0.0 {
                return 0.0;
            }
            let grip = if scheme.is_static() {
                Grip::none()
            } else {
                grip_of(state, solid, &point, &touch)
            };
            -(touch.normal * point.push_n + grip.force).dot(self.step_on(solid, &point))
        };
        self.solid.open_points().map(slope_of).sum()
    }

    /// Where a solid is at a share of the solved step.
    fn pose_moved(&self, carrier: &Carrier, share: f64) -> Pose {
        carrier.pose(|index| {
            let (body, block) = (&self.trial.bodies[index], self.plan.body_block[index]);
            if share == 0.0 || body.held {
                return Pose { place: body.place, orientation: body.orientation };
            }
            let turn = DQuat::from_scaled_axis(self.interface.step[block + 1] * share);
            Pose {
                place: body.place + self.interface.step[block] * share,
                orientation: (turn * body.orientation).normalize(),
            }
        })
    }

    fn pose_of(&self, carrier: &Carrier) -> Pose {
        self.pose_moved(carrier, 0.0)
    }

    fn touch_of(&self, solid: &Solid, point: &SolidContactPoint) -> Touch {
        self.touch_moved(solid, point, 0.0)
    }

    fn touch_moved(&self, solid: &Solid, point: &SolidContactPoint, share: f64) -> Touch {
        let pose = self.pose_moved(&solid.carrier, share);
        let place =
            point.on_rope(|node| self.trial.place[node] + self.tridiagonal.step[node] * share);
        let near = solid.shape.nearest(pose.inward(place));
        Touch {
            normal: pose.orientation * near.normal,
            depth: point.radius_m - near.distance - point.forgiven_m,
            place,
            pose,
        }
    }

    /// The solved step of the rope at a contact point, as seen from the solid.
    fn step_on(&self, solid: &Solid, point: &SolidContactPoint) -> DVec3 {
        let step = point.on_rope(|node| self.tridiagonal.step[node]);
        match solid.carrier.body() {
            None => step,
            Some(body) => {
                let block = self.plan.body_block[body];
                let arm =
                    point.on_rope(|node| self.trial.place[node]) - self.trial.bodies[body].place;
                step - self.interface.step[block] - self.interface.step[block + 1].cross(arm)
            }
        }
    }

    /// After a solve: push and friction that each contact point will have by the linear solution.
    pub(crate) fn predict_pushes(&mut self, share: f64) {
        let mut work = std::mem::take(&mut self.solid);
        for (solids, point) in work.open_points_mut() {
            let rope = point.on_rope(|node| self.tridiagonal.step[node]) * share;
            let relative = self.step_on(&solids[point.solid], point) * share;
            point.predict(rope, relative);
        }
        self.solid = work;
    }

    /// The same after a solution in the lanes, which has moved rope and bodies from where they were before.
    pub(crate) fn predict_pushes_in_lanes(&mut self) {
        let mut work = std::mem::take(&mut self.solid);
        for (solids, point) in work.open_points_mut() {
            let rope = point.on_rope(|node| self.trial.place[node] - self.before[node]);
            let relative = match solids[point.solid].carrier.body() {
                None => rope,
                Some(body) => {
                    let (from, to) =
                        (self.bodies_before[body].pose(), self.trial.bodies[body].pose());
                    let place = point.on_rope(|node| self.before[node]);
                    rope - (to.outward(from.inward(place)) - place)
                }
            };
            point.predict(rope, relative);
        }
        self.solid = work;
    }

    /// What push and friction of the last solution miss at the trial places. Rope and a body each answer their own move alone, and so
    /// differ by what they did not know of each other's.
    pub(crate) fn solids_missed(&self, state: &State, scheme: &Scheme) -> ContactMissed {
        let mut missed = ContactMissed::default();
        for point in self.solid.open_points() {
            let solid = &self.solid.solids[point.solid];
            let force = self.solid_force(state, scheme, solid, point);
            let [on_rope, on_body] = point.solved.map(|solved| solved.distance(force));
            let gap_n = match solid.carrier.body() {
                None => GRIP_STRICTER * on_rope,
                Some(_) => ANSWER_STRICTER * on_rope.max(on_body),
            };
            missed = missed.and(ContactMissed { gap_n, greatest_n: force.length() });
        }
        missed
    }

    /// Push and friction of a solid on rope where the trial stands.
    pub(crate) fn solid_force(
        &self,
        state: &State,
        scheme: &Scheme,
        solid: &Solid,
        point: &SolidContactPoint,
    ) -> DVec3 {
        let touch = self.touch_of(solid, point);
        let there = SolidContactPoint { push_n: point.stiffness * touch.depth, ..*point };
        if there.push_n <= 0.0 {
            DVec3::ZERO
        } else if scheme.is_static() {
            touch.normal * there.push_n
        } else {
            touch.normal * there.push_n + grip_of(state, solid, &there, &touch).force
        }
    }

    /// Share of the solved step of statics, at most `longest`, that takes no rope through a solid: as far as it is away
    /// and a little of the solid's thickness more.
    pub(crate) fn share_past_solids(&self, longest: f64) -> f64 {
        let share_of = |pair: &Pair| {
            let solid = &self.solid.solids[pair.solid];
            let pose = self.pose_of(&solid.carrier);
            let ends = [pair.node, pair.node + 1];
            let [a, b] = ends.map(|node| self.trial.place[node]);
            let room = least_distance(solid, &pose, a, b).max(0.0)
                + STATIC_SHARE * solid.shape.thickness();
            room / ends
                .map(|node| self.tridiagonal.step[node].length())
                .into_iter()
                .fold(1e-12, f64::max)
        };
        let touches = |pair: &&Pair| pair.range.0 < pair.range.1;
        self.solid.pairs.iter().filter(touches).map(share_of).fold(longest, f64::min)
    }

    /// Gathers rope near solids for a step; whether it may touch one.
    pub(crate) fn gather_solids(&mut self, state: &State, dt: f64) -> bool {
        self.solid.gather(state, &self.pieces, dt);
        self.solid.touching
    }

    /// The solid that rope went into or through in this step, if any.
    pub(crate) fn went_through(&self, state: &State) -> Option<(usize, usize)> {
        let through = |pair: &&Pair| self.goes_through(state, &self.solid.solids[pair.solid], pair);
        self.solid.pairs.iter().find(through).map(|pair| (pair.segment, pair.solid))
    }

    fn goes_through(&self, state: &State, solid: &Solid, pair: &Pair) -> bool {
        let thickness = solid.shape.thickness();
        let ends = [pair.node, pair.node + 1];
        let (before, after) = (pose_before(state, solid), self.pose_of(&solid.carrier));
        let from = ends.map(|node| before.inward(state.rope.position[node]));
        let to = ends.map(|node| after.inward(self.trial.place[node]));
        let longest = (to[0] - from[0]).length().max((to[1] - from[1]).length());
        if longest < UNWATCHED_SHARE * thickness {
            return false;
        }
        let looks = (longest / (LOOK_SHARE * thickness)).ceil().min(MOST_LOOKS);
        let still = Pose { place: DVec3::ZERO, orientation: DQuat::IDENTITY };
        let depth = |share: f64| {
            least_distance(solid, &still, from[0].lerp(to[0], share), from[1].lerp(to[1], share))
        };
        let least_depth = depth(0.0).min(0.0) - INSIDE_SHARE * thickness;
        (1..=looks as u32).any(|look| depth(f64::from(look) / looks) < least_depth)
    }

    /// Writes the grips of rope on solids into the state; called while it still holds the places of the step's begin.
    pub(crate) fn keep_solid_grips(&self, scheme: &Scheme, state: &mut State) {
        let mut grips = std::mem::take(&mut state.rope.solid_grips);
        grips.clear();
        if !scheme.is_static() {
            for point in self.solid.open_points() {
                let solid = &self.solid.solids[point.solid];
                let touch = self.touch_of(solid, point);
                let point = SolidContactPoint { push_n: point.stiffness * touch.depth, ..*point };
                if point.push_n > 0.0 {
                    let grip = grip_of(state, solid, &point, &touch);
                    grips.push(self.kept(&point, touch.pose.orientation.inverse() * grip.kept));
                }
            }
        }
        state.rope.solid_grips = grips;
    }

    fn kept(&self, point: &SolidContactPoint, stretch: DVec3) -> SolidGrip {
        let along_m = self.solid.along_of(point);
        SolidGrip {
            solid: point.solid,
            line: point.line,
            along_m,
            bears: point.bears,
            stretch,
            push_n: point.push_n,
        }
    }
}

/// Push and friction of a solid on rope at a contact point that pushes, with `-d force / d place`.
fn force_of(
    state: &State,
    scheme: &Scheme,
    solid: &Solid,
    point: &SolidContactPoint,
    touch: &Touch,
) -> (DVec3, DMat3) {
    let grip = if scheme.is_static() { Grip::none() } else { grip_of(state, solid, point, touch) };
    let block = outer(touch.normal, touch.normal) * point.stiffness + grip.block;
    (touch.normal * point.push_n + grip.force, block)
}

/// Friction at a contact point: the grip, carried along with the solid, stretched by how the rope moved on it.
fn grip_of(state: &State, solid: &Solid, point: &SolidContactPoint, touch: &Touch) -> Grip {
    let before = point.on_rope(|node| state.rope.position[node]);
    let carried = touch.pose.outward(pose_before(state, solid).inward(before));
    let stretch = touch.pose.orientation * point.kept + touch.place - carried;
    Grip::new(
        stretch,
        touch.normal,
        point.stiffness,
        solid.friction,
        Push { force: point.push_n.max(0.0), rate: point.stiffness },
    )
}

fn pose_before(state: &State, solid: &Solid) -> Pose {
    solid.carrier.pose(|body| Pose::of(&state.bodies[body]))
}

//! Rope pressed on rope.
//!
//! At a point (`contact/rope_on_rope/points.rs`) with distance `d` of the centre lines, contact distance `h` (the sum of the radii, of a knot its own),
//! bearing length `l` and stiffness `K` per metre: `N` by the law of `contact/law/barrier.rs`, along the line between the two. Friction
//! is the elastic grip that slips at `μN` (`elastic_grip.rs`), stretched by how the two points of the ropes moved past each other. Both
//! act on the four nodes, in opposite senses; the block joins the linear system (`woodbury.rs`).

use glam::{DMat3, DVec3};

use crate::contact::law::barrier::{BarrierForce, CRUSHED_SHARE, PINCHED_SHARE};
use crate::contact::law::elastic_grip::{Grip, Push};
use crate::contact::rope_on_rope::RopeTouch;
use crate::contact::rope_on_rope::near::{Pair, between};
use crate::contact::rope_on_rope::points::RopeContactPoint;
use crate::contact::{ContactMissed, GRIP_STRICTER};
use crate::matrix::outer;
use crate::model::{Model, RopeOnRope};
use crate::solver::Solver;
use crate::state::State;
use crate::system::woodbury::ContactBlock;
use crate::trial::scheme::Scheme;

/// Most places where rope presses on rope at a time: four times as many as in four tight hitches. Their dense system then has 1,200
/// rows, 12 MB and some 1e9 operations a pass.
const MOST_TOUCHES: usize = 400;

/// What two ropes do to each other at a point.
struct Touch {
    fractions: [f64; 2],
    normal: DVec3,
    distance: f64,
    /// How the first point moved past the second in this step [m].
    moved: DVec3,
    /// The push, and its growth with depth, where it is taken as linear.
    barrier: BarrierForce,
    /// What that linear push grows by from there to this distance [N].
    growth_n: f64,
    grip: Grip,
}

impl Touch {
    /// Force on the first rope [N].
    fn force(&self) -> DVec3 {
        self.normal * (self.barrier.force + self.growth_n) + self.grip.force
    }

    fn block(&self) -> DMat3 {
        outer(self.normal, self.normal) * self.barrier.stiffness + self.grip.block
    }
}

/// What happens at a point with nodes at the places given, if it presses.
fn touch_at(
    law: &RopeOnRope,
    state: &State,
    pair: &Pair,
    point: &RopeContactPoint,
    place: impl Fn(usize) -> DVec3,
) -> Option<Touch> {
    let fractions = point.fractions;
    if point.length <= 0.0 {
        return None;
    }
    let [one, other] = pair.places(place);
    let (gap, distance) = between(one, other, fractions);
    let stiffness = law.stiffness_n_m2 * point.length;
    let apart = distance + point.forgiven_m;
    let at_distance = BarrierForce::new(apart, pair.contact_distance, stiffness);
    if at_distance.force <= 0.0 {
        return None;
    }
    let (barrier, growth_n) =
        at_distance.about_solved(point.solved_n, (apart, pair.contact_distance, stiffness));
    let normal = gap / distance.max(1e-12);
    let [one, other] = pair.places(|node| state.rope.position[node]);
    let before = between(one, other, fractions).0;
    let (moved, stretch) = (gap - before, point.kept + gap - before);
    let grip = Grip::new(
        stretch,
        normal,
        stiffness,
        law.friction,
        Push { force: barrier.force + growth_n, rate: barrier.stiffness },
    );
    Some(Touch { fractions, normal, distance, moved, barrier, growth_n, grip })
}

impl Solver {
    /// Adds push and friction of rope on rope: forces to the block-tridiagonal systems, blocks to the touches of the linear system.
    pub(crate) fn add_ropes(&mut self, state: &State) {
        self.woodbury.touches.clear();
        self.ropes.crowded = None;
        let Some(law) = self.ropes.law else { return };
        let mut pairs = std::mem::take(&mut self.ropes.pairs);
        for pair in &mut pairs {
            for k in 0..pair.points.len() {
                let touch =
                    touch_at(&law, state, pair, &pair.points[k], |node| self.trial.place[node]);
                let point = &mut pair.points[k];
                (point.force, point.block) = touch
                    .as_ref()
                    .map_or((DVec3::ZERO, DMat3::ZERO), |touch| (touch.force(), touch.block()));
                point.normal = touch.as_ref().map_or(DVec3::ZERO, |touch| touch.normal);
                if let Some(touch) = touch {
                    if self.woodbury.touches.len() == MOST_TOUCHES {
                        self.ropes.crowded = Some(pair.segments);
                        break;
                    }
                    self.push_ropes_apart(pair.nodes, &touch);
                }
            }
        }
        self.ropes.pairs = pairs;
    }

    fn push_ropes_apart(&mut self, nodes: [usize; 2], touch: &Touch) {
        let force = touch.force();
        for (k, sign) in [(0, 1.0), (1, -1.0)] {
            let (node, fraction) = (nodes[k], touch.fractions[k]);
            self.tridiagonal.force[node] += force * (sign * (1.0 - fraction));
            self.tridiagonal.force[node + 1] += force * (sign * fraction);
        }
        self.woodbury.touches.push(ContactBlock {
            nodes,
            fractions: touch.fractions,
            block: touch.block(),
        });
    }

    /// After a solution: push and friction of rope on rope by it.
    pub(crate) fn note_solved_ropes(&mut self) {
        let step = &self.tridiagonal.step;
        for pair in &mut self.ropes.pairs {
            let [one, other] = pair.nodes.map(|node| [step[node], step[node + 1]]);
            for point in pair.points.iter_mut().filter(|point| point.length > 0.0) {
                let (moved, _) = between(one, other, point.fractions);
                point.solved = point.force - point.block * moved;
                point.solved_n =
                    (point.force != DVec3::ZERO).then(|| point.solved.dot(point.normal));
            }
        }
    }

    /// What push and friction of the last solution miss at the trial places.
    pub(crate) fn ropes_missed(&self, state: &State) -> ContactMissed {
        let mut missed = ContactMissed::default();
        self.each_touch(state, |_, point, touch| {
            let force = touch.map_or(DVec3::ZERO, |touch| touch.force());
            missed = missed.and(ContactMissed {
                gap_n: GRIP_STRICTER * force.distance(point.solved),
                greatest_n: force.length(),
            });
        });
        missed
    }

    /// Two segments that are pressed together harder than rope can bear at the trial places, if any: on the way to a balance,
    /// or at its end.
    pub(crate) fn crushed_ropes(&self, at_end: bool) -> Option<[usize; 2]> {
        let share = if at_end { PINCHED_SHARE } else { CRUSHED_SHARE };
        let crushed = |pair: &&Pair| {
            let [one, other] = pair.places(|node| self.trial.place[node]);
            let here = |point: &RopeContactPoint| {
                between(one, other, point.fractions).1 + point.forgiven_m
                    < share * pair.contact_distance
            };
            pair.points.iter().any(|point| point.length > 0.0 && here(point))
        };
        self.ropes.pairs.iter().find(crushed).map(|pair| pair.segments)
    }

    /// Writes the grips of rope on rope into the state; called while it still holds the places of the step's begin.
    pub(crate) fn keep_rope_grips(&self, scheme: &Scheme, state: &mut State) {
        let mut grips = std::mem::take(&mut state.rope.rope_grips);
        grips.clear();
        if !scheme.is_static() {
            self.each_touch(state, |pair, point, touch| {
                let forgiven_m = self.still_forgiven_m(pair, point);
                if let Some(touch) = touch {
                    grips.push(self.ropes.grip_of(pair, point, touch.grip.kept, forgiven_m));
                } else if forgiven_m > 0.0 {
                    grips.push(self.ropes.grip_of(pair, point, DVec3::ZERO, forgiven_m));
                }
            });
        }
        state.rope.rope_grips = grips;
    }

    /// How deep two ropes may still lie in each other: as they did when the run began, less by what they have been drawn apart since [m].
    fn still_forgiven_m(&self, pair: &Pair, point: &RopeContactPoint) -> f64 {
        if point.forgiven_m <= 0.0 {
            return 0.0;
        }
        let [one, other] = pair.places(|node| self.trial.place[node]);
        let distance_m = between(one, other, point.fractions).1;
        point.forgiven_m.min((pair.contact_distance - distance_m).max(0.0))
    }

    /// Tells where rope presses on rope at the end of a step of length `dt_s`, from a state that still holds the places of its begin.
    pub(crate) fn report_ropes(&self, state: &State, dt_s: f64, touches: &mut Vec<RopeTouch>) {
        touches.clear();
        self.each_touch(state, |pair, _, touch| {
            touches.extend(touch.map(|touch| {
                RopeTouch {
                    segments: pair.segments,
                    knots: pair.knots,
                    fractions: touch.fractions,
                    position: self.trial.place[pair.nodes[0]]
                        .lerp(self.trial.place[pair.nodes[0] + 1], touch.fractions[0]),
                    normal: touch.normal,
                    distance_m: touch.distance,
                    normal_force_n: touch.barrier.force,
                    friction_n: touch.grip.force,
                    slip_m: touch.moved.reject_from_normalized(touch.normal),
                    dt_s,
                }
            }));
        });
    }

    /// Does something with every point and what happens there at the trial places.
    fn each_touch(
        &self,
        state: &State,
        mut act: impl FnMut(&Pair, &RopeContactPoint, Option<Touch>),
    ) {
        let Some(law) = self.ropes.law else { return };
        for pair in &self.ropes.pairs {
            for point in pair.points.iter().filter(|point| point.length > 0.0) {
                act(pair, point, touch_at(&law, state, pair, point, |node| self.trial.place[node]));
            }
        }
    }

    /// Adds the forces of rope on rope to those on the nodes; the power of all of them [W].
    pub(crate) fn push_touching_ropes(
        &self,
        state: &State,
        scheme: &Scheme,
        on_nodes: &mut [DVec3],
    ) -> f64 {
        let mut power = 0.0;
        let moved = |node: usize| self.trial.place[node] - self.trial.place_history[node];
        self.each_touch(state, |pair, _, touch| {
            let Some(touch) = touch else { return };
            let (force, [one, other]) = (touch.force(), pair.places(moved));
            power += force.dot(between(one, other, touch.fractions).0) * scheme.rate;
            for (k, sign) in [(0, 1.0), (1, -1.0)] {
                let (node, fraction) = (pair.nodes[k], touch.fractions[k]);
                on_nodes[node] += force * (sign * (1.0 - fraction));
                on_nodes[node + 1] += force * (sign * fraction);
            }
        });
        power
    }

    /// Gathers rope near rope for a step; whether any may touch.
    pub(crate) fn gather_ropes(&mut self, model: &Model, state: &State, dt: f64) -> bool {
        self.ropes.gather(model, state, &self.pieces, dt)
    }
}

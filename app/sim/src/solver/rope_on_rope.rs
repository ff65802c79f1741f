//! Rope pressed on rope.
//!
//! At a point (`contact/ropes/points.rs`) with distance `d` of the centre lines, contact distance `h` (the sum of the radii),
//! bearing length `l` and stiffness `K` per metre: `N` by the law of `contact/barrier.rs`, along the line between the two. Friction
//! is the elastic grip that slips at `μN` (`elastic_grip.rs`), stretched by how the two points of the ropes moved past each other. Both
//! act on the four nodes, in opposite senses; the block joins the linear system (`woodbury.rs`).

use glam::{DMat3, DVec3};

use super::Solver;
use super::elastic_grip::{Grip, Push};
use super::rope::outer;
use super::scheme::Scheme;
use super::woodbury::ContactBlock;
use crate::contact::barrier::{BarrierForce, CRUSHED_SHARE, PINCHED_SHARE};
use crate::contact::ropes::RopeTouch;
use crate::contact::ropes::near::{Pair, between};
use crate::contact::ropes::points::RopeContactPoint;
use crate::model::{Model, RopeOnRope};
use crate::state::State;

/// Speed at which ropes that lay in each other when the run began are pushed apart [m/s].
const RECOVERY_M_S: f64 = 0.005;

/// What two ropes do to each other at a point.
struct Touch {
    fractions: [f64; 2],
    normal: DVec3,
    distance: f64,
    barrier: BarrierForce,
    grip: Grip,
}

impl Touch {
    /// Force on the first rope [N].
    fn force(&self) -> DVec3 {
        self.normal * self.barrier.force + self.grip.force
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
    fractions: [f64; 2],
    place: impl Fn(usize) -> DVec3,
) -> Option<Touch> {
    if point.length <= 0.0 {
        return None;
    }
    let [one, other] = pair.places(place);
    let (gap, distance) = between(one, other, fractions);
    let stiffness = law.stiffness_n_m2 * point.length;
    let barrier = BarrierForce::new(distance + point.forgiven_m, pair.contact_distance, stiffness);
    if barrier.force <= 0.0 {
        return None;
    }
    let normal = gap / distance.max(1e-12);
    let [one, other] = pair.places(|node| state.rope.position[node]);
    let stretch = point.kept + gap - between(one, other, fractions).0;
    let grip = Grip::new(
        stretch,
        normal,
        stiffness,
        law.friction,
        Push { force: barrier.force, rate: barrier.stiffness },
    );
    Some(Touch { fractions, normal, distance, barrier, grip })
}

impl Solver {
    /// Adds push and friction of rope on rope: forces to the block-tridiagonal systems, blocks to the touches of the linear system.
    pub(super) fn add_ropes(&mut self, state: &State) {
        self.woodbury.touches.clear();
        let Some(law) = self.ropes.law else { return };
        for pair in &self.ropes.pairs {
            for point in &pair.points {
                let Some(touch) = touch_at(&law, state, pair, point, point.fractions, |node| {
                    self.trial.place[node]
                }) else {
                    continue;
                };
                let force = touch.force();
                for (k, sign) in [(0, 1.0), (1, -1.0)] {
                    let (node, fraction) = (pair.nodes[k], touch.fractions[k]);
                    self.tridiagonal.force[node] += force * (sign * (1.0 - fraction));
                    self.tridiagonal.force[node + 1] += force * (sign * fraction);
                }
                self.woodbury.touches.push(ContactBlock {
                    nodes: pair.nodes,
                    fractions: touch.fractions,
                    block: touch.block(),
                });
            }
        }
    }

    /// Slope of push and friction of rope on rope at a share of the solved step.
    pub(super) fn ropes_slope(&self, state: &State, share: f64) -> f64 {
        let Some(law) = self.ropes.law else { return 0.0 };
        let moved = |node: usize| self.trial.place[node] + self.tridiagonal.step[node] * share;
        let mut slope = 0.0;
        for pair in &self.ropes.pairs {
            let [one, other] = pair.places(moved);
            let [step_one, step_other] = pair.places(|node| self.tridiagonal.step[node]);
            for point in pair.points.iter().filter(|point| point.length > 0.0) {
                let fractions =
                    if self.ropes.follows() { point.followed(one, other) } else { point.fractions };
                if let Some(touch) = touch_at(&law, state, pair, point, fractions, moved) {
                    slope -= touch.force().dot(between(step_one, step_other, fractions).0);
                }
            }
        }
        slope
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
    pub(super) fn keep_rope_grips(&self, scheme: &Scheme, state: &mut State) {
        let mut grips = std::mem::take(&mut state.rope.rope_grips);
        grips.clear();
        if !scheme.is_static() {
            self.each_touch(state, |pair, point, touch| {
                let less_m = (point.forgiven_m - RECOVERY_M_S * scheme.dt).max(0.0);
                if let Some(touch) = touch {
                    let forgiven_m = less_m.min((pair.contact_distance - touch.distance).max(0.0));
                    grips.push(self.ropes.grip_of(pair, point, touch.grip.kept, forgiven_m));
                } else if less_m > 0.0 {
                    grips.push(self.ropes.grip_of(pair, point, DVec3::ZERO, less_m));
                }
            });
        }
        state.rope.rope_grips = grips;
    }

    /// Tells where rope presses on rope, from a state that still holds the places of the step's begin.
    pub(crate) fn report_ropes(&self, state: &State, touches: &mut Vec<RopeTouch>) {
        touches.clear();
        self.each_touch(state, |pair, _, touch| {
            touches.extend(touch.map(|touch| {
                RopeTouch {
                    segments: pair.segments,
                    fractions: touch.fractions,
                    position: self.trial.place[pair.nodes[0]]
                        .lerp(self.trial.place[pair.nodes[0] + 1], touch.fractions[0]),
                    normal: touch.normal,
                    distance_m: touch.distance,
                    normal_force_n: touch.barrier.force,
                    friction_n: touch.grip.force,
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
                act(
                    pair,
                    point,
                    touch_at(&law, state, pair, point, point.fractions, |node| {
                        self.trial.place[node]
                    }),
                );
            }
        }
    }

    /// Gathers rope near rope for a step; whether any may touch.
    pub(crate) fn gather_ropes(&mut self, model: &Model, state: &State, dt: f64) -> bool {
        self.ropes.gather(model, state, dt)
    }

    /// Opens the points of rope on rope at the trial places.
    pub(crate) fn open_ropes(&mut self, state: &State) {
        self.ropes.open(state, &self.trial.place);
    }

    /// Whether rope not taken to touch rope did, on its way to the trial places; it then is from now on.
    pub(crate) fn met_ropes(&mut self, model: &Model, state: &State) -> bool {
        self.ropes.law.is_some() && self.ropes.met(model, state, &self.trial.place)
    }

    /// Whether rope met rope after a step in the lanes that moved rope by `moved_m` from its drift [m].
    pub(crate) fn met_ropes_free(&mut self, model: &Model, state: &State, moved_m: f64) -> bool {
        if self.ropes.pairs.is_empty() && moved_m <= self.ropes.unwatched_m() {
            return false;
        }
        self.lanes.give_places(&mut self.trial.place);
        self.met_ropes(model, state)
    }

    /// Whether rope came near rope beyond what was gathered; it then is from now on.
    pub(crate) fn met_more_ropes(&mut self, model: &Model, state: &State) -> bool {
        self.ropes.gather_more(model, state, &self.trial.place)
    }
}

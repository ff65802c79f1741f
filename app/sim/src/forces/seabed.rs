//! The seabed under rope nodes and the feet of bodies.
//!
//! Depth `p` below the plane, stiffness `k`: `N = k p²/2e` for `0 < p < e`, `N = k (p - e/2)` beyond
//! (smooth onset over `e`). A foot is a point of the body, or a ball whose lowest place touches. The ball sinks by the move of its
//! middle, and grips by the move of the point of the body that touches as the step ends, so that a ball rolls.
//! Friction is an elastic grip (`contact/law/elastic_grip.rs`). The foot of a body starts to slide at `μ_start` and slides at `μ_slide`
//! until it is at rest again; lifted, it is held back until it has broken out (`suction.rs`).

use glam::{DMat3, DQuat, DVec3};

use crate::contact::law::elastic_grip::{Grip, Push};
use crate::forces::{Forces, suction};
use crate::matrix::{outer, plane_across};
use crate::model::{Body, Model, Seabed};
use crate::state::State;
use crate::system::LinearSystem;
use crate::trial::plan::{Attachment, Plan};
use crate::trial::scheme::Scheme;
use crate::trial::{BodyTrial, StepContext, Trial};

/// Depth of the onset of the seabed's normal force [m].
const ONSET_M: f64 = 0.01;
/// Speed below which a sliding foot grips again [m/s].
const HOLD_SPEED_M_S: f64 = 1e-3;
/// Pseudo-mass of statics at which half of a grip's yielding is trusted [1/s²].
const TRUSTED_MASS: f64 = 0.01;
/// Share of critical damping of a foot on the seabed.
const FOOT_DAMPING: f64 = 0.5;

/// Push of the seabed at a depth.
#[inline(always)]
fn push_at(depth: f64, stiffness: f64) -> Push {
    if depth <= 0.0 {
        Push::default()
    } else if depth < ONSET_M {
        Push { force: 0.5 * stiffness * depth * depth / ONSET_M, rate: stiffness * depth / ONSET_M }
    } else {
        Push { force: stiffness * (depth - 0.5 * ONSET_M), rate: stiffness }
    }
}

/// A foot of a body.
#[derive(Clone, Copy)]
struct BodyFoot<'a> {
    body: &'a Body,
    /// Index of the body.
    index: usize,
    /// Index of the foot among those of the body.
    foot: usize,
}

impl BodyFoot<'_> {
    /// From a body turned like this to the foot's lowest place [m].
    fn arm(&self, seabed: &Seabed, orientation: DQuat) -> DVec3 {
        self.body.foot_arm(self.foot, orientation, seabed.normal)
    }

    /// Its lowest place when the step begins [m].
    fn place_before(&self, seabed: &Seabed, state: &State) -> DVec3 {
        let now = &state.bodies[self.index];
        now.position + self.arm(seabed, now.orientation)
    }

    /// Where the point of the body was when the step began that is lowest with the body turned like this [m].
    fn point_before(&self, seabed: &Seabed, state: &State, orientation: DQuat) -> DVec3 {
        if self.body.foot_radius_m.get(self.foot).is_none_or(|radius| *radius <= 0.0) {
            return self.place_before(seabed, state);
        }
        let now = &state.bodies[self.index];
        now.position + now.orientation * (orientation.inverse() * self.arm(seabed, orientation))
    }
}

impl Seabed {
    /// Depth at which one foot bears a load [m].
    pub(crate) fn depth_under(&self, load_n: f64) -> f64 {
        let depth = load_n / self.foot_stiffness_n_m + 0.5 * ONSET_M;
        if depth < ONSET_M {
            (2.0 * ONSET_M * load_n / self.foot_stiffness_n_m).sqrt()
        } else {
            depth
        }
    }

    /// Push on one foot at a place [N].
    pub(crate) fn push_on_foot(&self, place: DVec3) -> f64 {
        push_at(self.depth_of(place), self.foot_stiffness_n_m).force
    }

    /// Depth of a place below the plane [m].
    pub(crate) fn depth_of(&self, place: DVec3) -> f64 {
        -self.normal.dot(place + DVec3::Z * self.depth_m)
    }
}

impl Forces {
    /// Adds the seabed under every rope node.
    pub(crate) fn add_seabed(
        &self,
        context: &StepContext<'_>,
        trial: &Trial,
        system: &mut LinearSystem,
    ) {
        let StepContext { model, state, scheme } = *context;
        let Some(seabed) = &model.spec.seabed else { return };
        let across = outer(seabed.normal, seabed.normal);
        let plane = plane_across(seabed.normal);
        for node in 0..model.node_count {
            let at = self.seabed_at((seabed, &plane), state, scheme, trial, node);
            let Some((push, grip)) = at else { continue };
            system.rope.force[node] += seabed.normal * push.force;
            system.rope.diagonal[node] += across * push.rate;
            if let Some(grip) = grip {
                system.rope.force[node] += grip.force;
                system.rope.diagonal[node] += grip.block;
            }
        }
    }

    /// Push of the seabed on a rope node that lies on it, and its grip where it grips; `plane` is the projection on its plane.
    #[inline(always)]
    pub(crate) fn seabed_at(
        &self,
        (seabed, plane): (&Seabed, &DMat3),
        state: &State,
        scheme: &Scheme,
        trial: &Trial,
        node: usize,
    ) -> Option<(Push, Option<Grip>)> {
        let depth = seabed.depth_of(trial.place[node]);
        if depth <= 0.0 {
            return None;
        }
        let stiffness = seabed.rope_stiffness_n_m2 * self.lengths.node[node];
        let grip = if grips_rope(seabed, state, node, scheme) {
            let at = (node, trial.place[node]);
            Some(rope_grip(seabed, plane, state, scheme, at, stiffness))
        } else {
            None
        };
        Some((push_at(depth, stiffness), grip))
    }

    /// Longest solved move of a body on the seabed, whose feet may then bear or grip differently than in the solution [m].
    pub(crate) fn longest_of_standing(
        model: &Model,
        plan: &Plan,
        trial: &Trial,
        system: &LinearSystem,
    ) -> f64 {
        let Some(seabed) = &model.spec.seabed else { return 0.0 };
        let stands = |index: usize| {
            let (body, trial) = (&model.spec.bodies[index], trial.bodies[index]);
            (0..body.feet_m.len()).any(|foot| {
                let arm = body.foot_arm(foot, trial.orientation, seabed.normal);
                seabed.depth_of(trial.place + arm) > 0.0
            })
        };
        let moves = plan.body_block.iter().map(|block| system.interface.step[*block].length());
        moves.enumerate().fold(0.0, |longest, (index, move_m)| {
            if move_m > longest && stands(index) { move_m } else { longest }
        })
    }

    /// Adds the seabed under a body's feet.
    pub(crate) fn add_feet(
        context: &StepContext<'_>,
        index: usize,
        (plan, trial): (&Plan, &Trial),
        system: &mut LinearSystem,
    ) {
        let StepContext { model, state, scheme } = *context;
        let Some(seabed) = &model.spec.seabed else { return };
        let body = &model.spec.bodies[index];
        for foot in 0..body.feet_m.len() {
            let (at, now) = (BodyFoot { body, index, foot }, trial.bodies[index]);
            let arm = at.arm(seabed, now.orientation);
            let place = now.place + arm;
            let depth = seabed.depth_of(place);
            let attachment = Attachment::Body {
                block: plan.body_block[index],
                body: index,
                offset: body.feet_m[foot],
            };
            if depth <= 0.0 {
                let (pull, rate) =
                    suction::pull(body.foot_break_out_n, -depth, state.bodies[index].lift_m[foot]);
                if pull > 0.0 && !scheme.is_static() {
                    system.interface.push(attachment, arm, seabed.normal * -pull);
                    system.interface.add(
                        attachment,
                        arm,
                        attachment,
                        arm,
                        outer(seabed.normal, seabed.normal) * rate,
                    );
                }
                continue;
            }
            let before = at.place_before(seabed, state);
            let damping = if scheme.is_static() {
                0.0
            } else {
                FOOT_DAMPING * (seabed.foot_stiffness_n_m * body.mass_kg).sqrt() / scheme.dt
            };
            let undamped = push_at(depth, seabed.foot_stiffness_n_m);
            let push = Push {
                force: (undamped.force + damping * seabed.normal.dot(before - place)).max(0.0),
                rate: undamped.rate + damping,
            };
            let from = at.point_before(seabed, state, now.orientation);
            let grip = foot_grip(seabed, state, scheme, at, [from, place], push);
            system.interface.push(attachment, arm, seabed.normal * push.force + grip.force);
            system.interface.add(
                attachment,
                arm,
                attachment,
                arm,
                outer(seabed.normal, seabed.normal) * push.rate + grip.block,
            );
        }
    }

    /// Updates the grips of rope and feet; `state` still holds the places at the start of the step.
    pub(crate) fn keep_grips(
        &self,
        model: &Model,
        scheme: &Scheme,
        trial: &Trial,
        state: &mut State,
    ) {
        let Some(seabed) = &model.spec.seabed else { return };
        let plane = plane_across(seabed.normal);
        for node in 0..model.node_count {
            let on_ground =
                seabed.depth_of(trial.place[node]) > 0.0 && grips_rope(seabed, state, node, scheme);
            let stiffness = seabed.rope_stiffness_n_m2 * self.lengths.node[node];
            state.rope.seabed_grip[node] = if on_ground {
                rope_grip(seabed, &plane, state, scheme, (node, trial.place[node]), stiffness).kept
            } else {
                DVec3::ZERO
            };
        }
        keep_feet(model, scheme, trial, state);
    }

    /// Updates the grips of feet and clears those of rope, if no rope is near the seabed.
    pub(crate) fn keep_grips_free(
        model: &Model,
        scheme: &Scheme,
        trial: &Trial,
        state: &mut State,
    ) {
        if model.spec.seabed.is_some() {
            state.rope.seabed_grip.fill(DVec3::ZERO);
            keep_feet(model, scheme, trial, state);
        }
    }
}

fn keep_feet(model: &Model, scheme: &Scheme, trial: &Trial, state: &mut State) {
    let Some(seabed) = &model.spec.seabed else { return };
    for (index, body) in model.spec.bodies.iter().enumerate() {
        for foot in 0..body.feet_m.len() {
            keep_foot(seabed, scheme, BodyFoot { body, index, foot }, &trial.bodies[index], state);
        }
    }
}

fn keep_foot(
    seabed: &Seabed,
    scheme: &Scheme,
    at: BodyFoot<'_>,
    now: &BodyTrial,
    state: &mut State,
) {
    let BodyFoot { index, foot, .. } = at;
    let place = now.place + at.arm(seabed, now.orientation);
    let push = push_at(seabed.depth_of(place), seabed.foot_stiffness_n_m);
    let (kept, slides) = if push.force > 0.0 {
        let from = at.point_before(seabed, state, now.orientation);
        let grip = foot_grip(seabed, state, scheme, at, [from, place], push);
        let speed = (place - from).length() * scheme.rate;
        // Statics says itself which feet slide.
        let slides = if scheme.is_static() {
            state.bodies[index].sliding[foot]
        } else {
            grip.slips && (speed > HOLD_SPEED_M_S || !state.bodies[index].sliding[foot])
        };
        (grip.kept, slides)
    } else {
        (DVec3::ZERO, false)
    };
    let lift = -seabed.depth_of(place);
    state.bodies[index].lift_m[foot] =
        suction::keep(lift, state.bodies[index].lift_m[foot], scheme);
    state.bodies[index].grip[foot] = kept;
    state.bodies[index].sliding[foot] = slides;
}

/// Friction of the seabed on a node at a place.
#[inline(always)]
fn rope_grip(
    seabed: &Seabed,
    plane: &DMat3,
    state: &State,
    scheme: &Scheme,
    (node, place): (usize, DVec3),
    stiffness: f64,
) -> Grip {
    let stretch = state.rope.seabed_grip[node] + place - state.rope.position[node];
    let push = push_at(seabed.depth_of(place), stiffness);
    if scheme.is_static() {
        return Grip::smooth(
            stretch,
            seabed.normal,
            stiffness,
            seabed.rope_friction * push.force,
            trust(scheme),
        );
    }
    Grip::in_plane(plane, stretch, seabed.normal, [stiffness, seabed.rope_friction], push)
}

/// Share of the yielding of a slipping grip that the block of statics holds: small in rough iterations, one at the end.
fn trust(scheme: &Scheme) -> f64 {
    if scheme.anchored { 1.0 } else { 1.0 / (1.0 + scheme.inertia / TRUSTED_MASS) }
}

/// Whether the seabed grips a node on it: in statics only one that was on it before, because the point of first contact of others
/// is unknown.
fn grips_rope(seabed: &Seabed, state: &State, node: usize, scheme: &Scheme) -> bool {
    !scheme.is_static() || seabed.depth_of(state.rope.position[node]) > 0.0
}

/// Friction of a foot that moved from one place to another: it starts to slide at one coefficient and slides at another.
fn foot_grip(
    seabed: &Seabed,
    state: &State,
    scheme: &Scheme,
    at: BodyFoot<'_>,
    [from, to]: [DVec3; 2],
    push: Push,
) -> Grip {
    let BodyFoot { body, index, foot } = at;
    let stretch = state.bodies[index].grip[foot] + to - from;
    let friction =
        if state.bodies[index].sliding[foot] { body.slide_friction } else { body.start_friction };
    if scheme.is_static() {
        return Grip::smooth(
            stretch,
            seabed.normal,
            seabed.foot_stiffness_n_m,
            friction * push.force,
            trust(scheme),
        );
    }
    let mut grip = Grip::new(stretch, seabed.normal, seabed.foot_stiffness_n_m, friction, push);
    if grip.slips && !state.bodies[index].sliding[foot] {
        // It broke loose in this very step: from here on it slides.
        grip =
            Grip::new(stretch, seabed.normal, seabed.foot_stiffness_n_m, body.slide_friction, push);
    }
    grip
}

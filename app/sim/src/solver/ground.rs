//! The seabed under rope nodes and the feet of bodies.
//!
//! Depth `p` below the plane, stiffness `k`: `N = k p²/2e` for `0 < p < e`, `N = k (p - e/2)` beyond
//! (smooth onset over `e`). Friction is an elastic grip that slips at its limit: with `z*` the grip
//! stretched by this step's move along the plane, `f = -k z*` while `k|z*| ≤ μN`, else `f = -μN z*/|z*|`;
//! the grip keeps `f/k`. It holds without creep. A body's foot starts at `μ_start` and slides at `μ_slide`
//! until it stands still again; lifted, it is held back until it has broken out (`suction.rs`).

use glam::{DMat3, DVec3};

use super::Solver;
use super::interface::Attachment;
use super::rope::outer;
use super::scheme::Scheme;
use super::suction;
use crate::model::{Body, Model, Seabed};
use crate::state::State;

/// Depth over which the seabed's push sets in [m].
const ONSET_M: f64 = 0.01;
/// Speed below which a sliding foot takes hold again [m/s].
const HOLD_SPEED_M_S: f64 = 1e-3;
/// Pseudo-mass of statics at which half of a grip's yielding is trusted [1/s²].
const TRUSTED_MASS: f64 = 0.01;
/// Share of critical damping of a foot on the seabed.
const FOOT_DAMPING: f64 = 0.5;

/// Push of the seabed at a depth: force and its derivative.
fn press(depth: f64, stiffness: f64) -> (f64, f64) {
    if depth <= 0.0 {
        (0.0, 0.0)
    } else if depth < ONSET_M {
        (0.5 * stiffness * depth * depth / ONSET_M, stiffness * depth / ONSET_M)
    } else {
        (stiffness * (depth - 0.5 * ONSET_M), stiffness)
    }
}

/// Friction of an elastic grip.
pub(crate) struct Grip {
    /// Force on the moving part [N].
    pub force: DVec3,
    /// `-d force / d place` [N/m].
    pub block: DMat3,
    /// The grip's stretch kept for the next step [m].
    pub kept: DVec3,
    /// Whether it slips.
    pub slips: bool,
}

impl Grip {
    /// No friction at all.
    pub fn none() -> Self {
        Self { force: DVec3::ZERO, block: DMat3::ZERO, kept: DVec3::ZERO, slips: false }
    }

    /// Grip of stiffness `stiffness` stretched to `stretch` across `normal`, under normal force `push`
    /// with derivative `push_rate` by depth.
    pub fn new(
        stretch: DVec3,
        normal: DVec3,
        stiffness: f64,
        friction: f64,
        (push, push_rate): (f64, f64),
    ) -> Self {
        let plane = DMat3::IDENTITY - outer(normal, normal);
        let stretch = plane * stretch;
        let (length, limit) = (stretch.length(), friction * push);
        if stiffness * length <= limit || length <= 0.0 {
            return Self {
                force: stretch * -stiffness,
                block: plane * stiffness,
                kept: stretch,
                slips: false,
            };
        }
        let direction = stretch / length;
        let block = (plane - outer(direction, direction)) * (limit / length)
            - outer(direction, normal) * (friction * push_rate);
        Self {
            force: direction * -limit,
            block,
            kept: direction * (limit / stiffness),
            slips: true,
        }
    }
}

impl Grip {
    /// The same grip for statics, without the corner where it begins to slip: `f = -k z / √(1 + (k|z|/μN)²)`.
    ///
    /// With a `trust` below one its block yields less along the slip than the force does; at zero it is the secant `k/√…`,
    /// with which passes never overshoot.
    pub fn smooth(stretch: DVec3, normal: DVec3, stiffness: f64, limit: f64, trust: f64) -> Self {
        let plane = DMat3::IDENTITY - outer(normal, normal);
        let stretch = plane * stretch;
        if limit <= 0.0 {
            return Self { force: DVec3::ZERO, block: DMat3::ZERO, kept: DVec3::ZERO, slips: true };
        }
        let reach = stretch * (stiffness / limit);
        let less = 1.0 / libm::sqrt(1.0 + reach.length_squared());
        let block = (plane - outer(reach, reach) * (trust * less * less)) * (stiffness * less);
        let kept = stretch * less;
        Self { force: kept * -stiffness, block, kept, slips: reach.length_squared() > 1.0 }
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
        press(self.depth_of(place), self.foot_stiffness_n_m).0
    }

    /// Depth of a place below the plane [m].
    pub(crate) fn depth_of(&self, place: DVec3) -> f64 {
        -self.normal.dot(place + DVec3::Z * self.depth_m)
    }
}

impl Solver {
    /// Adds the seabed under every rope node.
    pub(super) fn add_seabed(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        let Some(seabed) = &model.spec.seabed else { return };
        for node in 0..model.node_count {
            let depth = seabed.depth_of(self.trial.place[node]);
            if depth <= 0.0 {
                continue;
            }
            let stiffness = seabed.rope_stiffness_n_m2 * self.lengths.node[node];
            let (push, push_rate) = press(depth, stiffness);
            self.tridiagonal.force[node] += seabed.normal * push;
            self.tridiagonal.diagonal[node] += outer(seabed.normal, seabed.normal) * push_rate;
            if grips_rope(seabed, state, node, scheme) {
                let grip = self.rope_grip(seabed, state, scheme, node, stiffness);
                self.tridiagonal.force[node] += grip.force;
                self.tridiagonal.diagonal[node] += grip.block;
            }
        }
    }

    fn rope_grip(
        &self,
        seabed: &Seabed,
        state: &State,
        scheme: &Scheme,
        node: usize,
        stiffness: f64,
    ) -> Grip {
        let stretch =
            state.rope.seabed_grip[node] + self.trial.place[node] - state.rope.position[node];
        let push = press(seabed.depth_of(self.trial.place[node]), stiffness);
        if scheme.is_static() {
            return Grip::smooth(
                stretch,
                seabed.normal,
                stiffness,
                seabed.rope_friction * push.0,
                trust(scheme),
            );
        }
        Grip::new(stretch, seabed.normal, stiffness, seabed.rope_friction, push)
    }

    /// Adds the seabed under a body's feet.
    pub(super) fn add_feet(&mut self, model: &Model, state: &State, index: usize, scheme: &Scheme) {
        let Some(seabed) = &model.spec.seabed else { return };
        let body = &model.spec.bodies[index];
        for foot in 0..body.feet_m.len() {
            let arm = self.trial.bodies[index].orientation * body.feet_m[foot];
            let place = self.trial.bodies[index].place + arm;
            let depth = seabed.depth_of(place);
            let attachment = Attachment::Body {
                block: self.plan.body_block[index],
                body: index,
                offset: body.feet_m[foot],
            };
            if depth <= 0.0 {
                let (pull, rate) =
                    suction::pull(body.foot_break_out_n, -depth, state.bodies[index].lift_m[foot]);
                if pull > 0.0 && !scheme.is_static() {
                    self.interface.push(attachment, arm, seabed.normal * -pull);
                    self.interface.add(
                        attachment,
                        arm,
                        attachment,
                        arm,
                        outer(seabed.normal, seabed.normal) * rate,
                    );
                }
                continue;
            }
            let before = foot_before(state, index, body, foot);
            let damping = if scheme.is_static() {
                0.0
            } else {
                FOOT_DAMPING * (seabed.foot_stiffness_n_m * body.mass_kg).sqrt() / scheme.dt
            };
            let (push, push_rate) = press(depth, seabed.foot_stiffness_n_m);
            let push = (push + damping * seabed.normal.dot(before - place)).max(0.0);
            let push_rate = push_rate + damping;
            let grip =
                foot_grip(seabed, state, scheme, (index, body, foot), place, (push, push_rate));
            self.interface.push(attachment, arm, seabed.normal * push + grip.force);
            self.interface.add(
                attachment,
                arm,
                attachment,
                arm,
                outer(seabed.normal, seabed.normal) * push_rate + grip.block,
            );
        }
    }

    /// Moves the grips of rope and feet on; called while `state` still holds the places of the step's begin.
    pub(super) fn keep_grips(&self, model: &Model, scheme: &Scheme, state: &mut State) {
        let Some(seabed) = &model.spec.seabed else { return };
        for node in 0..model.node_count {
            let on_ground = seabed.depth_of(self.trial.place[node]) > 0.0
                && grips_rope(seabed, state, node, scheme);
            let stiffness = seabed.rope_stiffness_n_m2 * self.lengths.node[node];
            state.rope.seabed_grip[node] = if on_ground {
                self.rope_grip(seabed, state, scheme, node, stiffness).kept
            } else {
                DVec3::ZERO
            };
        }
        self.keep_feet(model, scheme, state);
    }

    /// The same where no rope is near the seabed.
    pub(super) fn keep_grips_free(&self, model: &Model, scheme: &Scheme, state: &mut State) {
        if model.spec.seabed.is_some() {
            state.rope.seabed_grip.fill(DVec3::ZERO);
            self.keep_feet(model, scheme, state);
        }
    }

    fn keep_feet(&self, model: &Model, scheme: &Scheme, state: &mut State) {
        let Some(seabed) = &model.spec.seabed else { return };
        for (index, body) in model.spec.bodies.iter().enumerate() {
            for foot in 0..body.feet_m.len() {
                self.keep_foot(seabed, scheme, (index, body, foot), state);
            }
        }
    }

    fn keep_foot(
        &self,
        seabed: &Seabed,
        scheme: &Scheme,
        (index, body, foot): (usize, &Body, usize),
        state: &mut State,
    ) {
        let place = self.trial.bodies[index].place
            + self.trial.bodies[index].orientation * body.feet_m[foot];
        let push = press(seabed.depth_of(place), seabed.foot_stiffness_n_m);
        let (kept, slides) = if push.0 > 0.0 {
            let grip = foot_grip(seabed, state, scheme, (index, body, foot), place, push);
            let speed = (place - foot_before(state, index, body, foot)).length() * scheme.rate;
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
}

/// How far statics trusts a grip to yield as it slips: little while passes are rough, wholly at the end.
fn trust(scheme: &Scheme) -> f64 {
    if scheme.anchored { 1.0 } else { 1.0 / (1.0 + scheme.inertia / TRUSTED_MASS) }
}

/// Whether the seabed grips a node that lies on it: in statics only one that lay on it before, for where another
/// first touched is not known.
fn grips_rope(seabed: &Seabed, state: &State, node: usize, scheme: &Scheme) -> bool {
    !scheme.is_static() || seabed.depth_of(state.rope.position[node]) > 0.0
}

/// Place of a foot when the step begins.
fn foot_before(state: &State, index: usize, body: &Body, foot: usize) -> DVec3 {
    state.bodies[index].position + state.bodies[index].orientation * body.feet_m[foot]
}

fn foot_grip(
    seabed: &Seabed,
    state: &State,
    scheme: &Scheme,
    (index, body, foot): (usize, &Body, usize),
    place: DVec3,
    push: (f64, f64),
) -> Grip {
    let stretch = state.bodies[index].grip[foot] + place - foot_before(state, index, body, foot);
    let friction =
        if state.bodies[index].sliding[foot] { body.slide_friction } else { body.start_friction };
    if scheme.is_static() {
        return Grip::smooth(
            stretch,
            seabed.normal,
            seabed.foot_stiffness_n_m,
            friction * push.0,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grip_holds_below_its_limit_and_slips_at_it() {
        let push = (100.0, 0.0);
        let holds = Grip::new(DVec3::new(0.004, 0.0, 0.3), DVec3::Z, 1e4, 0.5, push);
        assert!(!holds.slips && (holds.force - DVec3::new(-40.0, 0.0, 0.0)).length() < 1e-12);
        let slips = Grip::new(DVec3::new(0.006, 0.0, 0.0), DVec3::Z, 1e4, 0.5, push);
        assert!(slips.slips && (slips.force - DVec3::new(-50.0, 0.0, 0.0)).length() < 1e-12);
        assert!((slips.kept.x - 0.005).abs() < 1e-15);
    }
}

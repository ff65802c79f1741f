//! Rope on obstacles and on the bodies of the rig in the stages of a solver step.
//!
//! At a contact point (`points.rs`) with depth `p` of the rope's surface below the solid's and stiffness `k`: `N = k p` while it
//! presses, block `k n nᵀ`. Whether it presses is judged by the normal force that the last solution predicted, as for
//! tension: Newton then ends in a few iterations. Friction is the elastic grip that slips at `μN` (`law/elastic_grip.rs`), its block
//! not symmetric, so that it follows the normal force within the solution.
//! A solid that stands still only acts on the rope. On a body of the rig the reaction acts at the same point, with its
//! own block; the effect of one's move on the other is left to the next iteration (block Jacobi), which converges because the
//! contact is kept softer than the body's inertia.
//! With node turn `φ` and contact at nodes alone, sliding gives `T₂/T₁ = (1 + μ tan φ/2)/(1 - μ tan φ/2)` for each node.

use glam::{DMat3, DQuat, DVec3};

use crate::balance::Source;
use crate::balance::source_forces::SourceForces;
use crate::contact::failure::{ContactFailure, Kind, Reason};
use crate::contact::law::elastic_grip::{Grip, Push};
use crate::contact::rope_on_solid::{
    MARGIN_M, Pair, RopeOnSolid, SolidContactPoint, least_distance,
};
use crate::contact::{
    ANSWER_STRICTER, Accepted, ActiveSet, Assembly, ContactError, ContactKind, GRIP_STRICTER,
    Order, Search, Solution,
};
use crate::geometry::Pose;
use crate::matrix::outer;
use crate::solids::{Carrier, Solid};
use crate::state::{SolidGrip, State};
use crate::system::LinearSystem;
use crate::trial::plan::Plan;
use crate::trial::scheme::Scheme;
use crate::trial::{StepContext, Trial};

/// Share of a solid's thickness that rope may move in a step without a check of its path.
const UNWATCHED_SHARE: f64 = 0.4;
/// Share of an obstacle's thickness that rope may go into it in an iteration of statics.
const STATIC_SHARE: f64 = 0.1;
/// Share of a solid's thickness between two samples of a path.
const LOOK_SHARE: f64 = 0.2;
/// Largest number of samples of a path.
const MOST_LOOKS: f64 = 64.0;
/// Longest step in which reversed friction is held. Longer steps that do not converge are redone shorter, which rope at an edge needs: in
/// steps of 10 ms it cuts the edge by 3 mm [s].
const HELD_WITHIN_S: f64 = 4e-3;
/// Share of a solid's thickness below its surface at which rope has gone into it.
const INSIDE_SHARE: f64 = 0.25;

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

/// A trial that moves by a share of a solved step.
#[derive(Clone, Copy)]
struct Moving<'a> {
    trial: &'a Trial,
    /// The solved step and the share; `None` at the trial itself.
    step: Option<(&'a Plan, &'a LinearSystem, f64)>,
}

impl Moving<'_> {
    /// Where a solid is.
    fn pose_of(&self, carrier: &Carrier) -> Pose {
        carrier.pose(|index| {
            let body = &self.trial.bodies[index];
            match self.step {
                Some((plan, system, share)) if share != 0.0 && !body.held => {
                    let block = plan.body_block[index];
                    let turn = DQuat::from_scaled_axis(system.interface.step[block + 1] * share);
                    Pose {
                        place: body.place + system.interface.step[block] * share,
                        orientation: (turn * body.orientation).normalize(),
                    }
                }
                _ => Pose { place: body.place, orientation: body.orientation },
            }
        })
    }

    /// A contact point of rope on a solid.
    fn touch_of(&self, solid: &Solid, point: &SolidContactPoint) -> Touch {
        let pose = self.pose_of(&solid.carrier);
        let place = point.on_rope(|node| match self.step {
            Some((_, system, share)) => self.trial.place[node] + system.rope.step[node] * share,
            None => self.trial.place[node],
        });
        let near = solid.shape.nearest(pose.inward(place));
        Touch {
            normal: pose.orientation * near.normal,
            depth: point.radius_m - near.distance - point.forgiven_m,
            place,
            pose,
        }
    }
}

/// A contact point at the trial itself.
fn touch_at(trial: &Trial, solid: &Solid, point: &SolidContactPoint) -> Touch {
    Moving { trial, step: None }.touch_of(solid, point)
}

/// The solved step of the rope at a contact point, relative to the solid.
fn step_on(
    (plan, trial, system): (&Plan, &Trial, &LinearSystem),
    solid: &Solid,
    point: &SolidContactPoint,
) -> DVec3 {
    let step = point.on_rope(|node| system.rope.step[node]);
    match solid.carrier.body() {
        None => step,
        Some(body) => {
            let block = plan.body_block[body];
            let arm = point.on_rope(|node| trial.place[node]) - trial.bodies[body].place;
            step - system.interface.step[block] - system.interface.step[block + 1].cross(arm)
        }
    }
}

impl ContactKind for RopeOnSolid {
    fn kind(&self) -> Kind {
        Kind::RopeOnSolid
    }

    fn find(&mut self, search: &Search<'_>) -> Result<(), ContactFailure> {
        self.gather(search.state, search.pieces, (search.dt, search.margin_m(MARGIN_M)));
        Ok(())
    }

    fn is_touching(&self) -> bool {
        self.touching
    }

    fn adds_on_rope(&self) -> bool {
        self.touching
    }

    fn assemble_on_rope(
        &mut self,
        order: Order,
        assembly: &Assembly<'_>,
        system: &mut LinearSystem,
    ) {
        if order != Order::First || (system.in_lanes() && !self.touching) {
            return;
        }
        self.evaluate(assembly);
        for point in self.open_points().filter(|point| point.pushes) {
            let site = [point.segment, point.node];
            match point.fraction {
                Some(fraction) => system.add_on_rope(site, fraction, point.force, &point.block),
                None => system.add_on_node(site, point.force, &point.block),
            }
        }
    }

    fn assemble_on_bodies(&self, order: Order, assembly: &Assembly<'_>, system: &mut LinearSystem) {
        if order != Order::First || (system.in_lanes() && !self.touching) {
            return;
        }
        let Assembly { plan, trial, .. } = *assembly;
        for point in self.open_points().filter(|point| point.pushes) {
            if let Some(body) = self.solids[point.solid].carrier.body() {
                let arm = point.place - trial.bodies[body].place;
                system.add_on_body(plan.body(body), arm, -point.force, point.block);
            }
        }
    }

    fn store_solution(&mut self, trial: &Trial, solution: &Solution<'_>) {
        if matches!(solution, Solution::Moved { .. }) && !self.touching {
            return;
        }
        for (solids, point) in self.open_points_mut() {
            let solid = &solids[point.solid];
            let (rope, relative) = match *solution {
                Solution::Step { system, plan, share } => (
                    point.on_rope(|node| system.rope.step[node]) * share,
                    step_on((plan, trial, system), solid, point) * share,
                ),
                Solution::Moved { rope: before, bodies, .. } => {
                    let rope = point.on_rope(|node| trial.place[node] - before[node]);
                    let relative = match solid.carrier.body() {
                        None => rope,
                        Some(body) => {
                            let (from, to) = (bodies[body].pose(), trial.bodies[body].pose());
                            let place = point.on_rope(|node| before[node]);
                            rope - (to.outward(from.inward(place)) - place)
                        }
                    };
                    (rope, relative)
                }
            };
            point.predict(rope, relative);
        }
    }

    /// Rope and a body each respond to their own move alone; their forces differ by the effect of the other's move.
    fn error(&mut self, context: &StepContext<'_>, trial: &Trial) -> ContactError {
        let mut error = ContactError::default();
        for point in self.open_points() {
            let solid = &self.solids[point.solid];
            let force = force_at(context, trial, solid, point);
            let [on_rope, on_body] = point.solved.map(|solved| solved.distance(force));
            let gap_n = match solid.carrier.body() {
                None => GRIP_STRICTER * on_rope,
                Some(_) => ANSWER_STRICTER * on_rope.max(on_body),
            };
            error = error.and(ContactError { gap_n, greatest_n: force.length() });
        }
        error
    }

    fn check_path(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
    ) -> Result<u64, ContactFailure> {
        let through =
            |pair: &&Pair| goes_through(context.state, trial, &self.solids[pair.solid], pair);
        match self.pairs.iter().find(through) {
            Some(pair) => {
                let parts = [pair.segment, pair.solid];
                Err(ContactFailure::refused(Kind::RopeOnSolid, parts, Reason::PassedThrough))
            }
            None => Ok(0),
        }
    }

    fn store(&self, accepted: &Accepted<'_>, state: &mut State) {
        let Accepted { scheme, trial, in_lanes, .. } = *accepted;
        let mut grips = std::mem::take(&mut state.rope.solid_grips);
        grips.clear();
        if !scheme.is_static() && (self.touching || !in_lanes) {
            for point in self.open_points() {
                let solid = &self.solids[point.solid];
                let touch = touch_at(trial, solid, point);
                let point = SolidContactPoint { push_n: point.stiffness * touch.depth, ..*point };
                if point.push_n > 0.0 {
                    let grip = grip_of(state, solid, &point, &touch);
                    let stretch = touch.pose.orientation.inverse() * grip.kept;
                    grips.push(self.grip_to_store(&point, stretch));
                }
            }
        }
        state.rope.solid_grips = grips;
    }

    fn source_forces(&self, sources: &mut SourceForces<'_>) {
        if !self.touching && sources.system.in_lanes() {
            return;
        }
        for point in self.open_points() {
            let solid = &self.solids[point.solid];
            let force = force_at(&sources.context, sources.trial, solid, point);
            let velocity = point.on_rope(|node| sources.velocity_of(node));
            sources.push_at(point.node, point.fraction.unwrap_or(0.0), force);
            let Some(body) = solid.carrier.body() else {
                sources.given.at_end.add(Source::Obstacles, force, velocity);
                continue;
            };
            let place = point.on_rope(|node| sources.trial.place[node]);
            let arm = place - sources.trial.bodies[body].place;
            let apart = velocity - sources.motion_of(body).at(arm);
            sources.given.at_end.contact += force.dot(apart);
            sources.push_body(body, arm, -force);
        }
    }
}

impl RopeOnSolid {
    /// Evaluates normal force and friction at the trial.
    fn evaluate(&mut self, assembly: &Assembly<'_>) {
        let Assembly { context: StepContext { state, scheme, .. }, trial, active_set, .. } =
            *assembly;
        if !scheme.is_static() && !self.pairs.is_empty() {
            let moving = Moving { trial, step: None };
            self.follow_all(state, &trial.place, |carrier| moving.pose_of(carrier));
        }
        for (solids, point) in self.open_points_mut() {
            let solid = &solids[point.solid];
            let touch = touch_at(trial, solid, point);
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
    }

    /// Slope of the normal force and friction of solids at a share of the solved step, for the line search of statics.
    pub fn slope(
        &self,
        context: &StepContext<'_>,
        (plan, trial, system): (&Plan, &Trial, &LinearSystem),
        share: f64,
    ) -> f64 {
        let moving = Moving { trial, step: Some((plan, system, share)) };
        let slope_of = |point: &SolidContactPoint| {
            let solid = &self.solids[point.solid];
            let touch = moving.touch_of(solid, point);
            let point = SolidContactPoint { push_n: point.stiffness * touch.depth, ..*point };
            if point.push_n <= 0.0 {
                return 0.0;
            }
            let grip = if context.scheme.is_static() {
                Grip::none()
            } else {
                grip_of(context.state, solid, &point, &touch)
            };
            let force = touch.normal * point.push_n + grip.force;
            -force.dot(step_on((plan, trial, system), solid, &point))
        };
        self.open_points().map(slope_of).sum()
    }

    /// Share of the solved step of statics, at most `longest`, that takes no rope through a solid: its distance and a little of the
    /// solid's thickness more.
    pub fn share_past(&self, trial: &Trial, system: &LinearSystem, longest: f64) -> f64 {
        let moving = Moving { trial, step: None };
        let share_of = |pair: &Pair| {
            let solid = &self.solids[pair.solid];
            let pose = moving.pose_of(&solid.carrier);
            let ends = [pair.node, pair.node + 1];
            let [a, b] = ends.map(|node| trial.place[node]);
            let room = least_distance(solid, &pose, a, b).max(0.0)
                + STATIC_SHARE * solid.shape.thickness();
            room / ends
                .map(|node| system.rope.step[node].length())
                .into_iter()
                .fold(1e-12, f64::max)
        };
        let touches = |pair: &&Pair| pair.range.0 < pair.range.1;
        self.pairs.iter().filter(touches).map(share_of).fold(longest, f64::min)
    }

    fn grip_to_store(&self, point: &SolidContactPoint, stretch: DVec3) -> SolidGrip {
        let along_m = self.along_of(point);
        SolidGrip {
            solid: point.solid,
            line: point.line,
            along_m,
            bears: point.bears,
            stretch,
            push_n: point.push_n,
            most_n_m: point.most_n_m,
        }
    }
}

/// Normal force and friction of a solid on rope at the trial.
fn force_at(
    context: &StepContext<'_>,
    trial: &Trial,
    solid: &Solid,
    point: &SolidContactPoint,
) -> DVec3 {
    let touch = touch_at(trial, solid, point);
    let there = SolidContactPoint { push_n: point.stiffness * touch.depth, ..*point };
    if there.push_n <= 0.0 {
        DVec3::ZERO
    } else if context.scheme.is_static() {
        touch.normal * there.push_n
    } else {
        touch.normal * there.push_n + grip_of(context.state, solid, &there, &touch).force
    }
}

/// Whether rope goes into or through a solid on its way from the state to the trial.
fn goes_through(state: &State, trial: &Trial, solid: &Solid, pair: &Pair) -> bool {
    let thickness = solid.shape.thickness();
    let ends = [pair.node, pair.node + 1];
    let after = Moving { trial, step: None }.pose_of(&solid.carrier);
    let before = pose_before(state, solid);
    let from = ends.map(|node| before.inward(state.rope.position[node]));
    let to = ends.map(|node| after.inward(trial.place[node]));
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

/// Normal force and friction of a solid on rope at a contact point that presses, with `-d force / d place`.
fn force_of(
    state: &State,
    scheme: &Scheme,
    solid: &Solid,
    point: &SolidContactPoint,
    touch: &Touch,
) -> (DVec3, DMat3) {
    let grip = if scheme.is_static() {
        Grip::none()
    } else {
        grip_to_solve((state, scheme), solid, point, touch)
    };
    let block = outer(touch.normal, touch.normal) * point.stiffness + grip.block;
    (touch.normal * point.push_n + grip.force, block)
}

/// Friction at a contact point for the next solution: a grip that holds at any force if its friction opposes that of the last solution
/// (`law/elastic_grip.rs`).
fn grip_to_solve(
    (state, scheme): (&State, &Scheme),
    solid: &Solid,
    point: &SolidContactPoint,
    touch: &Touch,
) -> Grip {
    let grip = grip_of(state, solid, point, touch);
    if scheme.dt > HELD_WITHIN_S {
        return grip;
    }
    // The force by the moves of rope and body together; each of both stored forces is by the move of one alone.
    let [on_rope, on_body] = point.solved;
    let solved = on_rope + on_body - point.force;
    if grip.is_reversed(point.push_n, solved, touch.normal) {
        Grip::held(stretch_of(state, solid, point, touch), touch.normal, point.stiffness)
    } else {
        grip
    }
}

/// Stretch of the grip at a contact point: carried along with the solid, and stretched by how the rope moved on it [m].
fn stretch_of(state: &State, solid: &Solid, point: &SolidContactPoint, touch: &Touch) -> DVec3 {
    let before = point.on_rope(|node| state.rope.position[node]);
    let carried = touch.pose.outward(pose_before(state, solid).inward(before));
    touch.pose.orientation * point.kept + touch.place - carried
}

/// Friction at a contact point by its law.
fn grip_of(state: &State, solid: &Solid, point: &SolidContactPoint, touch: &Touch) -> Grip {
    Grip::new(
        stretch_of(state, solid, point, touch),
        touch.normal,
        point.stiffness,
        solid.friction,
        Push { force: point.push_n.max(0.0), rate: point.stiffness },
    )
}

fn pose_before(state: &State, solid: &Solid) -> Pose {
    solid.carrier.pose(|body| Pose::of(&state.bodies[body]))
}

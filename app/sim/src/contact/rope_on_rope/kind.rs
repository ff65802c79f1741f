//! Rope on rope in the stages of a solver step.
//!
//! At a point (`points.rs`) with distance `d` of the centre lines, contact distance `h` (the sum of the radii, of a knot its own),
//! bearing length `l` and stiffness `K` per metre: `N` by the law of `law/barrier.rs`, along the line between the two. Friction
//! is the elastic grip that slips at `μN` (`law/elastic_grip.rs`), stretched by the relative move of the two points of the ropes. Both
//! act on the four nodes, in opposite senses; the block joins the linear system as a coupling (`system/coupled.rs`).

use glam::{DMat3, DVec3};

use crate::balance::source_forces::SourceForces;
use crate::contact::failure::{ContactFailure, Kind, Reason};
use crate::contact::law::barrier::{BarrierForce, CRUSHED_SHARE, PINCHED_SHARE};
use crate::contact::law::elastic_grip::{Grip, Push};
use crate::contact::rope_on_rope::RopeTouch;
use crate::contact::rope_on_rope::near::{MARGIN_M, Pair, RopeOnRope, between};
use crate::contact::rope_on_rope::points::RopeContactPoint;
use crate::contact::{
    Accepted, Assembly, ContactError, ContactKind, GRIP_STRICTER, Order, Reports, Search, Solution,
};
use crate::cost::CostClock;
use crate::matrix::outer;
use crate::model::RopeOnRope as RopeLaw;
use crate::state::State;
use crate::system::LinearSystem;
use crate::system::coupled::ContactBlock;
use crate::trial::{StepContext, Trial};

/// Contact of two ropes at a point.
struct Touch {
    fractions: [f64; 2],
    normal: DVec3,
    distance: f64,
    /// Relative move of the first point in this step [m].
    moved: DVec3,
    /// Normal force and its derivative where it is linearised.
    barrier: BarrierForce,
    /// Increment of that linear force to this distance [N].
    growth_n: f64,
    /// Stretch of the grip by this step [m], and its stiffness [N/m].
    stretch: DVec3,
    stiffness: f64,
    grip: Grip,
}

impl Touch {
    /// Force on the first rope [N].
    fn force(&self) -> DVec3 {
        self.normal * self.normal_n() + self.grip.force
    }

    /// Normal force, linear about where it is linearised [N].
    fn normal_n(&self) -> f64 {
        self.barrier.force + self.growth_n
    }

    /// Holds the grip if its slip has reversed since the last solution (`law/elastic_grip.rs`).
    fn hold_if_reversed(&mut self, point: &RopeContactPoint) {
        if self.grip.is_reversed(self.normal_n(), point.solved, point.normal) {
            self.grip = Grip::held(self.stretch, self.normal, self.stiffness);
        }
    }

    fn block(&self) -> DMat3 {
        outer(self.normal, self.normal) * self.barrier.stiffness + self.grip.block
    }
}

/// Contact at a point with nodes at these places; `None` if nothing presses.
fn touch_at(
    law: &RopeLaw,
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
    Some(Touch { fractions, normal, distance, moved, barrier, growth_n, stretch, stiffness, grip })
}

impl ContactKind for RopeOnRope {
    fn kind(&self) -> Kind {
        Kind::RopeOnRope
    }

    fn find(&mut self, search: &Search<'_>) -> Result<(), ContactFailure> {
        let margin_m = search.margin_m(MARGIN_M);
        self.gather(search.model, search.state, search.pieces, (search.dt, margin_m));
        self.check_crowded()
    }

    fn is_touching(&self) -> bool {
        self.touching
    }

    fn adds_on_rope(&self) -> bool {
        self.touching
    }

    fn checks_path_of_rope(&self) -> bool {
        !self.pairs.is_empty()
    }

    fn project_guess(&self, state: &State, trial: &mut Trial) {
        if self.touching {
            self.hold_off(&state.rope.position, &mut trial.place);
        }
    }

    fn open(&mut self, context: &StepContext<'_>, trial: &Trial) {
        if self.touching {
            self.open_points(context.state, &trial.place);
        }
    }

    fn open_more(&mut self, context: &StepContext<'_>, trial: &Trial) -> bool {
        self.touching && self.open_nearer_points(context.state, &trial.place)
    }

    fn measure(
        &mut self,
        _: &StepContext<'_>,
        trial: &Trial,
        _: &mut CostClock,
    ) -> Result<(), ContactFailure> {
        self.check_crowded()?;
        self.check_compressed(trial, CRUSHED_SHARE)
    }

    fn begin_iteration(&mut self, _: &StepContext<'_>, _: &Trial) {
        self.iterations += 1;
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
        self.crowded = None;
        let Some(law) = self.law else { return };
        let Assembly { context, trial, .. } = *assembly;
        self.follow(&trial.place);
        let (mut pairs, opened) =
            (std::mem::take(&mut self.pairs), std::mem::take(&mut self.opened));
        for index in &opened {
            let pair = &mut pairs[*index];
            for k in 0..pair.points.len() {
                let at = |node: usize| trial.place[node];
                let mut touch = touch_at(&law, context.state, pair, &pair.points[k], at);
                let point = &mut pair.points[k];
                touch.iter_mut().for_each(|touch| touch.hold_if_reversed(point));
                (point.force, point.block) = touch
                    .as_ref()
                    .map_or((DVec3::ZERO, DMat3::ZERO), |touch| (touch.force(), touch.block()));
                point.normal = touch.as_ref().map_or(DVec3::ZERO, |touch| touch.normal);
                if let Some(touch) = touch {
                    let coupling = ContactBlock {
                        segments: pair.segments,
                        nodes: pair.nodes,
                        fractions: touch.fractions,
                        block: touch.block(),
                    };
                    if !system.couple_ropes(coupling, touch.force()) {
                        self.crowded = Some(pair.segments);
                        break;
                    }
                }
            }
        }
        (self.pairs, self.opened) = (pairs, opened);
    }

    fn store_solution(&mut self, trial: &Trial, solution: &Solution<'_>) {
        let step = |node: usize| match *solution {
            Solution::Step { system, .. } => system.rope.step[node],
            Solution::Moved { rope: before, share, .. } => {
                (trial.place[node] - before[node]) / share
            }
        };
        for index in &self.opened {
            let pair = &mut self.pairs[*index];
            let [one, other] = pair.nodes.map(|node| [step(node), step(node + 1)]);
            for point in pair.points.iter_mut().filter(|point| point.length > 0.0) {
                let (moved, _) = between(one, other, point.fractions);
                point.solved = point.force - point.block * moved;
                point.solved_n =
                    (point.force != DVec3::ZERO).then(|| point.solved.dot(point.normal));
            }
        }
    }

    fn error(&mut self, context: &StepContext<'_>, trial: &Trial) -> ContactError {
        let mut error = ContactError::default();
        self.each_touch(context.state, trial, |_, point, touch| {
            let force = touch.map_or(DVec3::ZERO, |touch| touch.force());
            error = error.and(ContactError {
                gap_n: GRIP_STRICTER * force.distance(point.solved),
                greatest_n: force.length(),
            });
        });
        error
    }

    fn check_path(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
    ) -> Result<u64, ContactFailure> {
        if self.pairs.is_empty() {
            return Ok(0);
        }
        self.check_compressed(trial, PINCHED_SHARE)?;
        let crossings = self.end(&context.state.rope.position, &trial.place);
        crossings.ok_or(ContactFailure::refused(Kind::RopeOnRope, [0, 0], Reason::PathNotProved))
    }

    fn accept(
        &mut self,
        accepted: &Accepted<'_>,
        state: &mut State,
        reports: &mut Reports<'_>,
    ) -> Result<(), ContactFailure> {
        let trial = accepted.trial;
        self.each_touch(state, trial, |pair, _, touch| {
            reports.rope_on_rope.extend(touch.map(|touch| {
                RopeTouch {
                    segments: pair.segments,
                    knots: pair.knots,
                    fractions: touch.fractions,
                    position: trial.place[pair.nodes[0]]
                        .lerp(trial.place[pair.nodes[0] + 1], touch.fractions[0]),
                    normal: touch.normal,
                    distance_m: touch.distance,
                    normal_force_n: touch.barrier.force,
                    friction_n: touch.grip.force,
                    slip_m: touch.moved.reject_from_normalized(touch.normal),
                    dt_s: accepted.scheme.dt,
                }
            }));
        });
        Ok(())
    }

    fn store(&self, accepted: &Accepted<'_>, state: &mut State) {
        let Accepted { scheme, trial, in_lanes, .. } = *accepted;
        let mut grips = std::mem::take(&mut state.rope.rope_grips);
        grips.clear();
        if !scheme.is_static() && (self.touching || !in_lanes) {
            self.each_touch(state, trial, |pair, point, touch| {
                let forgiven_m = still_forgiven_m(trial, pair, point);
                if let Some(touch) = touch {
                    grips.push(self.grip_of(pair, point, touch.grip.kept, forgiven_m));
                } else if forgiven_m > 0.0 {
                    grips.push(self.grip_of(pair, point, DVec3::ZERO, forgiven_m));
                }
            });
        }
        state.rope.rope_grips = grips;
    }

    fn source_forces(&self, sources: &mut SourceForces<'_>) {
        if !self.touching && sources.system.in_lanes() {
            return;
        }
        let (trial, rate) = (sources.trial, sources.context.scheme.rate);
        let moved = |node: usize| trial.place[node] - trial.place_history[node];
        let mut power = 0.0;
        self.each_touch(sources.context.state, trial, |pair, _, touch| {
            let Some(touch) = touch else { return };
            let (force, [one, other]) = (touch.force(), pair.places(moved));
            power += force.dot(between(one, other, touch.fractions).0) * rate;
            for (k, sign) in [(0, 1.0), (1, -1.0)] {
                let (node, fraction) = (pair.nodes[k], touch.fractions[k]);
                sources.on_nodes[node] += force * (sign * (1.0 - fraction));
                sources.on_nodes[node + 1] += force * (sign * fraction);
            }
        });
        sources.given.at_end.contact += power;
    }
}

impl RopeOnRope {
    fn check_crowded(&self) -> Result<(), ContactFailure> {
        let refused = |parts| ContactFailure::refused(Kind::RopeOnRope, parts, Reason::Crowded);
        self.crowded.map_or(Ok(()), |segments| Err(refused(segments)))
    }

    /// Refuses two segments that are closer than a share of their contact distance at the trial.
    fn check_compressed(&self, trial: &Trial, share: f64) -> Result<(), ContactFailure> {
        let compressed = |pair: &&Pair| {
            let [one, other] = pair.places(|node| trial.place[node]);
            let here = |point: &RopeContactPoint| {
                between(one, other, point.fractions).1 + point.forgiven_m
                    < share * pair.contact_distance
            };
            pair.points.iter().any(|point| point.length > 0.0 && here(point))
        };
        let refused = |pair: &Pair| {
            ContactFailure::refused(Kind::RopeOnRope, pair.segments, Reason::Overcompressed)
        };
        self.opened_pairs().find(compressed).map_or(Ok(()), |pair| Err(refused(pair)))
    }

    /// Pairs with open points, in order.
    fn opened_pairs(&self) -> impl Iterator<Item = &Pair> {
        debug_assert!(
            self.pairs.iter().enumerate().all(|(index, pair)| {
                pair.points.iter().all(|point| point.length <= 0.0)
                    || self.opened.binary_search(&index).is_ok()
            }),
            "every pair with an open point is listed"
        );
        self.opened.iter().map(|index| &self.pairs[*index])
    }

    /// Calls `act` for every open point, with the contact there at the trial.
    fn each_touch(
        &self,
        state: &State,
        trial: &Trial,
        mut act: impl FnMut(&Pair, &RopeContactPoint, Option<Touch>),
    ) {
        let Some(law) = self.law else { return };
        for pair in self.opened_pairs() {
            for point in pair.points.iter().filter(|point| point.length > 0.0) {
                act(pair, point, touch_at(&law, state, pair, point, |node| trial.place[node]));
            }
        }
    }
}

/// Overlap of two ropes that is still allowed: as much as when the run began, less by how far they have separated since [m].
fn still_forgiven_m(trial: &Trial, pair: &Pair, point: &RopeContactPoint) -> f64 {
    if point.forgiven_m <= 0.0 {
        return 0.0;
    }
    let [one, other] = pair.places(|node| trial.place[node]);
    let distance_m = between(one, other, point.fractions).1;
    point.forgiven_m.min((pair.contact_distance - distance_m).max(0.0))
}

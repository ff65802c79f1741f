//! Newton's method for a short solver step with rope near skin: few passes, each of them whole.
//!
//! In a step short enough the balance is nearly linear: from the guess `x + h v` one pass or two reach it. A pass measures push and friction of
//! every contact point and takes them as linear. With them in it, rope is solved until the segments that pull are those that are taut by the
//! solution and their tension is the law's where the trial then stands; a turn of a short slack segment stretches it to second order, which
//! the next solution mends without measuring contact anew. The step has converged when what the last pass took for granted is so where the trial
//! now stands:
//!
//! | quantity | allowed difference between the linear solution and the law at its place |
//! |---|---|
//! | tension of a segment | 2 N or 2 % of the weight of all gear, if that is less; or 2 % of the greatest tension |
//! | push and friction on a contact point | 0.1 N, or 2 % of the greatest |
//! | move of the last solution | 1 mm; of a body 0.1 mm |
//!
//! The share of the greatest push and friction is `contact_tolerance`, here the usual one; the other figures are in proportion to it.
//! A step that has not converged after [`MOST_PASSES`] is made shorter (`step/substeps.rs`). No path is looked at here: whether the step leads
//! through skin is judged by where it ends (`contact/near/substep.rs`).

use glam::DVec3;

use super::Solver;
use super::contact_newton::{ContactEnd, TENSION_GAP_N, TENSION_GAP_SHARE};
use super::scheme::Scheme;
use crate::contact::barrier::CRUSHED_SHARE;
use crate::contact::workspace::ContactWorkspace;
use crate::cost::CostPart;
use crate::model::{CONTACT_TOLERANCE, Model};
use crate::state::State;

/// Most passes, and most again once further contact points are opened.
const MOST_PASSES: usize = 8;
/// Most solutions for rope in a pass, with contact linear.
const MOST_ROPE_SOLUTIONS: usize = 4;
/// Most times a solution is sought again for other taut segments.
const MOST_ACTIVE_SETS: usize = 6;
/// Share of what the pass before missed by, above which a pass has stalled: the next goes half of the way, for whole ones go to and fro.
const STALLED_SHARE: f64 = 0.5;
/// Push and friction that a contact point may miss by, where `contact_tolerance` is the usual one [N].
const CONTACT_N: f64 = 0.1;
/// Move of the last solution, where `contact_tolerance` is the usual one [m].
const MOVE_M: f64 = 1e-3;
/// Move of a body in the last solution, likewise [m].
const BODY_MOVE_M: f64 = 1e-4;

/// A short step that has converged.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Converged {
    /// Passes that it took.
    pub passes: usize,
    /// How much of what is allowed the linear solution missed by, at most 1.
    pub missed: f64,
}

/// Passes of a step so far.
#[derive(Clone, Copy, Debug)]
struct PassCount {
    all: usize,
    /// Since the last contact points were opened.
    since_opened: usize,
    /// What the last missed by; beyond any bound where it went half of the way, or where there was none.
    missed: f64,
    /// Whether the next goes half of the way.
    half: bool,
}

impl Default for PassCount {
    fn default() -> Self {
        Self { all: 0, since_opened: 0, missed: f64::INFINITY, half: false }
    }
}

impl PassCount {
    /// Begins a pass: the share of its move to take.
    fn begin(&mut self) -> f64 {
        self.all += 1;
        self.since_opened += 1;
        if self.half { 0.5 } else { 1.0 }
    }

    /// Takes in what the pass missed by.
    fn end(&mut self, missed: f64) {
        let was_half = self.half;
        self.half = !was_half && missed > STALLED_SHARE * self.missed;
        self.missed = if was_half { f64::INFINITY } else { missed };
    }
}

/// What a pass did.
#[derive(Clone, Copy, Debug)]
struct PassDone {
    /// Longest move of a node or body that it solved for [m].
    longest_m: f64,
    /// What the tension it solved for misses, as a share of what is allowed.
    tension_missed: f64,
}

impl Solver {
    /// Begins a short step: in the lanes of the processor where they know all that touches the rope, else line by line.
    pub(crate) fn begin_short(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        work: &mut ContactWorkspace,
    ) {
        if self.suits_lanes(model) && self.solid.pairs.is_empty() {
            self.begin_in_lanes(model, state, scheme, |solver| solver.hold_off(model, state, work));
        } else {
            self.begin(model, state, scheme);
            self.hold_off(model, state, work);
        }
    }

    /// Solves a short step that has begun, with skin at its end.
    pub(crate) fn solve_short(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        work: &mut ContactWorkspace,
    ) -> Result<Converged, ContactEnd> {
        self.cost.enter(CostPart::Detection);
        work.open_active_points(model, state, &self.lengths.segment, &self.trial.place);
        self.measure_contacts(model, state, scheme, work)?;
        let (mut count, mut opened) = (PassCount::default(), false);
        while count.since_opened < MOST_PASSES {
            let share = count.begin();
            let done = self.whole_pass(model, state, scheme, work, share);
            if !done.longest_m.is_finite() {
                return Err(ContactEnd::NotFinite);
            }
            self.cost.enter(CostPart::Detection);
            work.near.follow(&state.rope.position, &self.trial.place);
            self.measure_contacts(model, state, scheme, work)?;
            let missed = self.missed(&done, model, work);
            count.end(missed);
            if share < 1.0 || missed > 1.0 || missed.is_nan() {
                continue;
            }
            self.cost.enter(CostPart::Detection);
            if opened || work.points.open_more(&work.near, &self.trial.place) == 0 {
                return Ok(Converged { passes: count.all, missed });
            }
            opened = true;
            count = PassCount { all: count.all, ..PassCount::default() };
            self.measure_contacts(model, state, scheme, work)?;
        }
        Err(ContactEnd::Ended { last_m: f64::INFINITY, passes: count.all, crossings: 0 })
    }

    /// One pass with the contacts measured last: rope is solved, with contact linear, until its tension is what the solve took for granted.
    /// A half pass moves the trial by half of its one solution.
    fn whole_pass(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        work: &mut ContactWorkspace,
        share: f64,
    ) -> PassDone {
        work.before.clone_from(&self.trial.place);
        work.note_blocks();
        let mut done = PassDone { longest_m: 0.0, tension_missed: f64::INFINITY };
        for _ in 0..MOST_ROPE_SOLUTIONS {
            done = if self.in_lanes {
                self.solve_in_lanes(model, state, scheme, work, share)
            } else {
                self.solve_lines(model, state, scheme, work, share)
            };
            if share < 1.0 || done.tension_missed <= 1.0 || !done.longest_m.is_finite() {
                break;
            }
        }
        self.predict_contacts(work);
        done
    }

    /// Solves rope with linear contact line by line, and moves the trial by a share of the solution.
    fn solve_lines(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        work: &ContactWorkspace,
        share: f64,
    ) -> PassDone {
        self.assemble(model, state, scheme);
        let Self { tridiagonal, trial, .. } = self;
        for (point, force, block) in work.contacts_at(&trial.place) {
            tridiagonal.add_at(point.segment, point.node, point.fraction, force, block);
        }
        self.solve_taut(model);
        self.advance(model, share);
        let tension_missed = self.tension_missed(model, scheme) / leniency(model);
        PassDone { longest_m: self.longest(), tension_missed }
    }

    /// Solves rope with linear contact in the lanes, and moves the trial by a share of the solution.
    fn solve_in_lanes(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        work: &ContactWorkspace,
        share: f64,
    ) -> PassDone {
        self.lanes.leave_contact();
        let Self { lanes, trial, .. } = self;
        for (point, force, block) in work.contacts_at(&trial.place) {
            lanes.add_contact(point.segment, point.fraction, force, block);
        }
        self.before.clone_from(&self.trial.place);
        self.bodies_before.clone_from(&self.trial.bodies);
        let least_n = TENSION_GAP_N.min(self.tolerance().gap_n);
        for solved in 0..=MOST_ACTIVE_SETS {
            let passed = self.pass_free(model, state, scheme, share);
            let allowed_n = leniency(model) * least_n.max(TENSION_GAP_SHARE * passed.greatest_n);
            if passed.flipped_n <= allowed_n || !passed.finite || solved == MOST_ACTIVE_SETS {
                self.lanes.give_places(&mut self.trial.place);
                let longest_m = if passed.finite { passed.longest_m } else { f64::NAN };
                let tension_missed = passed.gap_n.max(passed.flipped_n) / allowed_n;
                return PassDone { longest_m, tension_missed };
            }
            // Again from the same places, with the segments taut that are so by the solution.
            self.trial.place.clone_from(&self.before);
            self.trial.bodies.clone_from(&self.bodies_before);
            self.lanes.take_places(&self.trial.place);
        }
        PassDone { longest_m: f64::NAN, tension_missed: f64::NAN }
    }

    /// Measures every contact point where the trial stands, and asks for its friction.
    fn measure_contacts(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        work: &mut ContactWorkspace,
    ) -> Result<(), ContactEnd> {
        self.cost.enter(CostPart::Detection);
        work.points.measure(&work.near, &self.trial.place);
        self.cost.enter(CostPart::Contact);
        if let Some((segment, triangle)) = work.nearer_than(CRUSHED_SHARE) {
            return Err(ContactEnd::Crushed(segment, triangle));
        }
        let Some(friction) = &model.spec.friction else { return Ok(()) };
        work.touching.collect(model, &work.near, &work.points, state);
        work.touching.respond(friction, scheme.dt).map_err(ContactEnd::Plugin)
    }

    /// Solves, until the segments that pull are those that are taut by the linear solution.
    fn solve_taut(&mut self, model: &Model) {
        self.linear_part.interface.copy_values(&self.interface);
        self.solve(model);
        for _ in 0..MOST_ACTIVE_SETS {
            self.predict_tension(model, 1.0);
            if self.change_taut(model) == 0 {
                return;
            }
            self.interface.copy_values(&self.linear_part.interface);
            self.solve(model);
        }
    }

    /// After a pass: push and friction of every contact point by the linear solution.
    fn predict_contacts(&self, work: &mut ContactWorkspace) {
        let ContactWorkspace { points, touching, before, .. } = work;
        points.list.iter_mut().for_each(|point| point.missed = DVec3::ZERO);
        for (place, index) in touching.point.iter().enumerate() {
            let point = &mut points.list[*index];
            let step = point.on_rope(|node| self.trial.place[node] - before[node]);
            point.missed += touching.force_of(place) - touching.block[place] * step;
            points.note_solved(*index, touching.face[place], step);
        }
    }

    /// What the linear solution missed by where the trial now stands, as a share of what is allowed.
    fn missed(&self, done: &PassDone, model: &Model, work: &mut ContactWorkspace) -> f64 {
        let leniency = leniency(model);
        let ContactWorkspace { points, touching, .. } = work;
        let mut greatest = 0.0_f64;
        for (place, index) in touching.point.iter().enumerate() {
            let force = touching.force_of(place);
            points.list[*index].missed -= force;
            greatest = greatest.max(force.length_squared());
        }
        let contact =
            points.list.iter().map(|point| point.missed.length_squared()).fold(0.0, f64::max);
        let contact = contact.sqrt()
            / (leniency * CONTACT_N).max(model.spec.settings.contact_tolerance * greatest.sqrt());
        let body = self.plan.body_block.iter().map(|block| self.interface.step[*block].length());
        let body = body.fold(0.0, f64::max) / (leniency * BODY_MOVE_M);
        let solids =
            if self.solid.pairs.is_empty() || self.pushes_are_settled() { 0.0 } else { 2.0 };
        let moved = done.longest_m / (leniency * MOVE_M);
        contact.max(done.tension_missed).max(moved).max(body).max(solids)
    }
}

/// What a step may miss by, as a multiple of what is usual.
fn leniency(model: &Model) -> f64 {
    model.spec.settings.contact_tolerance / CONTACT_TOLERANCE
}

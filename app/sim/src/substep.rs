//! One solver step: free rope in two linear solves, rope near the whale by Newton with contact.
//!
//! With contact (docs/physics.md): skin makes its move and rope drifts on, held off the skin; where that would
//! cross, rope near skin is carried along with it instead, as far as nothing crosses. Then Newton finds the balance
//! at that pose of the skin; where the skin could not make its whole move at once, both are repeated.

use glam::DVec3;

use crate::contact::ContactPoint;
use crate::contact::grip::Failed;
use crate::contact::law::PINCHED_SHARE;
use crate::contact::ropes::RopeTouch;
use crate::contact::work::ContactWork;
use crate::model::Model;
use crate::parting::{self, Parting};
use crate::rope_step::rope_step;
use crate::solids::work;
use crate::solver::{
    BodyTrial, CONTACT_WANTED_M, Fine, FreePass, Scheme, Solver, TENSION_GAP_N, TENSION_GAP_SHARE,
    Touched,
};
use crate::state::State;
use crate::step::{Audit, Workspace};

/// Passes every free solver step takes, unless the first, clear of the seabed, moved so little that a second would change nothing
/// of note.
const LEAST_PASSES: usize = 2;
/// Move below which one pass is enough [m].
const ONE_PASS_M: f64 = 1e-3;
/// Difference between solved and true tension below which one pass is enough [N].
const ONE_PASS_GAP_N: f64 = 0.02;
/// The same as a share of the greatest tension.
const ONE_PASS_GAP_SHARE: f64 = 1e-4;
/// Passes after which a free solver step counts as not converged.
const MOST_PASSES: usize = 12;
/// Move of a pass at which a free solver step has converged [m].
const CONVERGED_M: f64 = 1e-3;
/// The same where rope resists bending: what is left to go, for its passes converge linearly [m].
const BENT_CONVERGED_M: f64 = 1e-5;
/// Passes after which such a step counts as not converged.
const BENT_MOST_PASSES: usize = 40;
/// Passes of such a step that trust what the last solve foretold; later ones are searched.
const FORETOLD_PASSES: usize = 8;
/// Passes after which a step with rope on obstacles or bodies ends.
const MOST_SOLID_PASSES: usize = 30;
/// Most times the move of skin and rope together is cut.
const MOST_CUTS: usize = 20;
/// Times the skin may be stopped within a solver step.
const MOST_STAGES: usize = 8;
/// Rope that begins a step pinched may end it this much nearer to skin, as a share.
const STILL_PINCHED: f64 = 0.99;
/// Move of the last pass with contact above which the step is redone shorter [m].
pub(crate) const CONTACT_CONVERGED_M: f64 = 1e-3;

/// Why a solver step must be redone shorter, or ends the run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Refused {
    NotFinite,
    NotConverged,
    PartsTooLate,
    /// This segment crosses skin before the step begins.
    Crossed(usize),
    /// This segment is pinched at this triangle by skin that closes on it.
    Pinched(usize, usize),
    /// These two segments are pressed into each other harder than rope can bear.
    RopesPinched([usize; 2]),
    /// Rope may touch rope, which needs the shorter step of contact.
    RopesMeet,
    /// This segment went into or through this obstacle or body.
    WentThrough(usize, usize),
    /// The friction plugin failed, with its message.
    Plugin(Failed),
}

/// What free rope met in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Met {
    Nothing,
    /// An obstacle, a body or rope that its drift would not have brought it near to.
    Something,
}

impl Refused {
    /// Whether a shorter step may help.
    pub fn may_halve(&self) -> bool {
        !matches!(self, Self::Crossed(_) | Self::Plugin(_))
    }
}

/// What a solver step was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Took {
    /// No rope near skin.
    Free,
    /// Rope near skin.
    Touching,
    /// Something parted at its end.
    Parted,
}

/// One solver step of length `dt`: kept in `state` where it converges and parts nothing late.
pub(crate) fn solver_step(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    dt: f64,
    careful: bool,
) -> Result<Took, Refused> {
    let Workspace { solver, contact, audit, contacts, rope_touches, peak_tension_n, .. } =
        workspace;
    let mut touching = contact.as_mut();
    if touching.as_mut().is_none_or(|work| !gather(model, state, work, dt)) {
        touching = None;
    }
    contacts.clear();
    rope_touches.clear();
    let on_solid = solver.gather_solids(state, dt);
    let on_rope = solver.gather_ropes(model, state, dt);
    if on_rope && is_long(model, dt) {
        return Err(Refused::RopesMeet);
    }
    let untouched = touching.is_none() && !on_solid && !on_rope;
    let scheme = if careful || !untouched {
        Scheme::backward_euler(dt)
    } else {
        Scheme::bdf2(dt, state.rope.earlier_dt_s)
    };
    let last = dt * 0.5 < model.spec.settings.least_step_s;
    let free = untouched && solver.suits_lanes(model);
    if free && free_step(model, state, solver, &scheme, audit)? == Met::Nothing {
        if !last && parting::too_late(model, state, solver.tension_free()) {
            return Err(Refused::PartsTooLate);
        }
        state.rope.grips.clear();
        solver.keep_free(model, &scheme, state);
    } else {
        step_by_lines(
            model,
            state,
            solver,
            &scheme,
            touching,
            (contacts, rope_touches, audit, last),
        )?;
    }
    audit.ropes_crossed += solver.ropes.crossings;
    audit.ropes_through = audit.ropes_through.max(solver.ropes.count_through());
    audit.solver_steps += 1;
    for (peak, tension) in peak_tension_n.iter_mut().zip(&state.rope.tension) {
        *peak = peak.max(*tension);
    }
    if parting::part(model, state) == Parting::Some {
        state.rope.earlier_dt_s = 0.0;
        return Ok(Took::Parted);
    }
    Ok(if untouched { Took::Free } else { Took::Touching })
}

/// Whether a step is longer than contact allows.
fn is_long(model: &Model, dt: f64) -> bool {
    dt > model.spec.settings.contact_step_s * (1.0 + 1e-9)
}

/// A solver step with rope near the whale, rope, obstacles or bodies, line after line.
fn step_by_lines(
    model: &Model,
    state: &mut State,
    solver: &mut Solver,
    scheme: &Scheme,
    mut touching: Option<&mut ContactWork>,
    (contacts, rope_touches, audit, last): (
        &mut Vec<ContactPoint>,
        &mut Vec<RopeTouch>,
        &mut Audit,
        bool,
    ),
) -> Result<(), Refused> {
    solver.begin(model, state, scheme);
    match &mut touching {
        None if solver.ropes.touching => rope_step(model, state, solver, scheme, audit)?,
        None => {
            if solver.solid.pairs.is_empty() {
                lines_step(model, state, solver, scheme, audit)?;
            } else {
                solid_step(model, state, solver, scheme, audit)?;
            }
            if solver.met_ropes(model, state) {
                if is_long(model, scheme.dt) {
                    return Err(Refused::RopesMeet);
                }
                solver.begin(model, state, scheme);
                rope_step(model, state, solver, scheme, audit)?;
            }
        }
        Some(work) => contact_step(model, state, solver, scheme, work, audit)?,
    }
    if !last && parting::too_late(model, state, solver.tension()) {
        return Err(Refused::PartsTooLate);
    }
    match (touching, &model.spec.friction) {
        (Some(work), Some(friction)) => {
            work.keep(model, friction, scheme.dt, state, contacts).map_err(Refused::Plugin)?;
            audit.contact_steps += 1;
            let deepest = contacts.iter().map(|contact| {
                0.5 * model.rope_of_segment(contact.segment).diameter_m - contact.distance_m
            });
            audit.max_penetration_m = deepest.fold(audit.max_penetration_m, f64::max);
            let nearest = contacts.iter().map(|contact| contact.distance_m).reduce(f64::min);
            audit.least_distance_m =
                [audit.least_distance_m, nearest].into_iter().flatten().reduce(f64::min);
        }
        _ => state.rope.grips.clear(),
    }
    solver.tell_ropes(state, rope_touches);
    solver.keep(model, scheme, state);
    Ok(())
}

/// Gathers rope near the whale for a solver step; whether there is any.
fn gather(model: &Model, state: &State, work: &mut ContactWork, dt: f64) -> bool {
    let [start, end] = &work.bones;
    work.near.begin(
        model,
        [start, end],
        &state.rope.position,
        |node| state.rope.velocity[node] * dt,
        &state.rope.cut,
    )
}

/// Newton where only water and seabed touch the rope; what it met beyond.
fn free_step(
    model: &Model,
    state: &State,
    solver: &mut Solver,
    scheme: &Scheme,
    audit: &mut Audit,
) -> Result<Met, Refused> {
    solver.begin_free(model, state, scheme);
    let fine = solver.fine();
    let (mut patience, at_once) = (Patience::new(model, &fine), !model.bends());
    let mut moved_m = 0.0;
    for pass in 1..=patience.most_passes {
        let passed = solver.pass_free(model, state, scheme);
        audit.passes += 1;
        moved_m += passed.longest_m;
        if !passed.finite {
            audit.non_finite += 1;
            return Err(Refused::NotFinite);
        }
        let rests = patience.rests(pass, passed.longest_m);
        let settled = passed.gap_n
            <= TENSION_GAP_N.min(fine.gap_n).max(TENSION_GAP_SHARE * passed.greatest_n);
        if (rests && settled) || (at_once && is_exact(&passed, &fine)) {
            // Rope that kept to its drift has met nothing but what was gathered.
            let strayed = moved_m > work::MARGIN_M && solver.strayed_free(state, scheme.dt);
            let met = strayed || solver.met_ropes_free(model, state, moved_m);
            return Ok(if met { Met::Something } else { Met::Nothing });
        }
    }
    Err(Refused::NotConverged)
}

/// Whether another pass would change nothing of note.
fn is_exact(passed: &FreePass, fine: &Fine) -> bool {
    let gap_n = ONE_PASS_GAP_N.min(fine.gap_n).max(ONE_PASS_GAP_SHARE * passed.greatest_n);
    !passed.near_seabed && passed.longest_m < ONE_PASS_M.min(fine.move_m) && passed.gap_n < gap_n
}

fn lines_step(
    model: &Model,
    state: &State,
    solver: &mut Solver,
    scheme: &Scheme,
    audit: &mut Audit,
) -> Result<(), Refused> {
    let mut patience = Patience::new(model, &solver.fine());
    for pass in 1..=patience.most_passes {
        let passed = solver.pass(model, state, scheme);
        audit.passes += 1;
        if !passed.finite {
            audit.non_finite += 1;
            return Err(Refused::NotFinite);
        }
        if patience.rests(pass, passed.longest_m) && solver.pull_is_settled(model, scheme) {
            return Ok(());
        }
    }
    Err(Refused::NotConverged)
}

/// How long Newton goes on: rope that bends is solved for only roughly in each pass.
struct Patience {
    bends: bool,
    most_passes: usize,
    converged_m: f64,
    moved_before_m: f64,
}

impl Patience {
    fn new(model: &Model, fine: &Fine) -> Self {
        let bends = model.bends();
        let (most_passes, converged_m) =
            if bends { (BENT_MOST_PASSES, BENT_CONVERGED_M) } else { (MOST_PASSES, CONVERGED_M) };
        let converged_m = converged_m.min(fine.move_m);
        Self { bends, most_passes, converged_m, moved_before_m: f64::INFINITY }
    }

    /// Whether little enough is left to go after a pass that moved so far.
    fn rests(&mut self, pass: usize, moved_m: f64) -> bool {
        // Of moves that shrink by θ each pass, θ/(1-θ) of the last is left.
        let shrinkage = if self.bends { (moved_m / self.moved_before_m).min(0.9999) } else { 0.5 };
        self.moved_before_m = moved_m;
        pass >= LEAST_PASSES && moved_m * shrinkage / (1.0 - shrinkage) < self.converged_m
    }
}

/// Newton with rope on obstacles or bodies.
fn solid_step(
    model: &Model,
    state: &State,
    solver: &mut Solver,
    scheme: &Scheme,
    audit: &mut Audit,
) -> Result<(), Refused> {
    let mut last_m = f64::INFINITY;
    for pass in 1..=MOST_SOLID_PASSES {
        if pass == FORETOLD_PASSES + 1 {
            // What was foretold led astray: begin again.
            solver.begin(model, state, scheme);
            solver.solid.follow_again();
        }
        let passed = if pass <= FORETOLD_PASSES {
            solver.pass(model, state, scheme)
        } else {
            solver.searched_pass(model, state, scheme)
        };
        audit.passes += 1;
        if !passed.finite {
            audit.non_finite += 1;
            return Err(Refused::NotFinite);
        }
        last_m = passed.longest_m;
        let settled = last_m < CONTACT_WANTED_M
            && solver.pushes_are_settled()
            && solver.pull_is_settled(model, scheme);
        if pass >= LEAST_PASSES && settled && !solver.strayed_to_solids(state, scheme.dt) {
            break;
        }
    }
    if last_m > CONTACT_CONVERGED_M {
        return Err(Refused::NotConverged);
    }
    audit.unconverged += u64::from(last_m > CONTACT_WANTED_M);
    solver
        .went_through(state)
        .map_or(Ok(()), |(segment, solid)| Err(Refused::WentThrough(segment, solid)))
}

fn contact_step(
    model: &Model,
    state: &State,
    solver: &mut Solver,
    scheme: &Scheme,
    work: &mut ContactWork,
    audit: &mut Audit,
) -> Result<(), Refused> {
    work.slots.list.clear();
    solver.set_out(state);
    solver.ropes.begin();
    let mut pinched = PINCHED_SHARE;
    for stage in 0..MOST_STAGES {
        work.near.measure(solver.places());
        if let Some(pair) = work.near.pairs.iter().find(|pair| pair.clear <= 0.0) {
            return Err(Refused::Crossed(pair.segment));
        }
        if stage == 0 {
            // Rope that lies there already may stay, and come out again.
            pinched = pinched.min(STILL_PINCHED * work.near.least_share());
        }
        audit.tunnelled += solver.carry(model, work);
        solver.open_ropes(state);
        match solver.solve_touching(model, state, scheme, work) {
            Touched::Ended { last_m, passes, crossings } => {
                audit.passes += passes as u64;
                audit.tunnelled += crossings;
                if last_m > CONTACT_CONVERGED_M {
                    return Err(Refused::NotConverged);
                }
                audit.unconverged += u64::from(last_m > CONTACT_WANTED_M);
            }
            Touched::NotFinite => {
                audit.non_finite += 1;
                return Err(Refused::NotFinite);
            }
            Touched::TooFar => return Err(Refused::NotConverged),
            Touched::Crushed(segment, triangle) => return Err(Refused::Pinched(segment, triangle)),
            Touched::CrushedRopes(segments) => return Err(Refused::RopesPinched(segments)),
            Touched::Plugin(message) => return Err(Refused::Plugin(message)),
        }
        if let Some((segment, triangle)) = work.nearer_than(pinched) {
            return Err(Refused::Pinched(segment, triangle));
        }
        if let Some(segments) = solver.crushed_ropes(true) {
            return Err(Refused::RopesPinched(segments));
        }
        if work.near.fraction >= 1.0 - 1e-12 {
            return if solver.met_more_ropes(model, state) {
                Err(Refused::NotConverged)
            } else {
                Ok(())
            };
        }
    }
    Err(Refused::NotConverged)
}

impl Solver {
    /// Puts rope and bodies back where the step begins; where they would drift to is kept as the first target.
    pub(crate) fn set_out(&mut self, state: &State) {
        self.drift.clone_from(&self.trial.place);
        self.drift_bodies.clone_from(&self.trial.bodies);
        self.trial.place.clone_from(&state.rope.position);
        self.trial.hitches.share = 0.0;
        for (trial, body) in self.trial.bodies.iter_mut().zip(&state.bodies) {
            (trial.place, trial.orientation) = (body.position, body.orientation);
        }
    }

    /// Places of the nodes now.
    pub(crate) fn places(&self) -> &[DVec3] {
        &self.trial.place
    }

    /// Moves skin to the end of its step, and rope and bodies along with it, as far as nothing crosses; the
    /// number of crossings an exact test finds.
    fn carry(&mut self, model: &Model, work: &mut ContactWork) -> u64 {
        work.before.clone_from(&self.trial.place);
        work.bodies_before.clone_from(&self.trial.bodies);
        let first = work.near.fraction <= 0.0;
        if first {
            work.target.clone_from(&self.drift);
            work.near.hold_off(&work.before, &mut work.target);
            if let Ok(crossings) = self.carry_by(model, work, 1.0, first) {
                return crossings;
            }
        }
        work.target.clone_from(if first { &self.drift } else { &work.before });
        work.near.carry(&work.before, &mut work.target);
        let mut share = 1.0;
        for _ in 0..MOST_CUTS {
            match self.carry_by(model, work, share, first) {
                Ok(crossings) => return crossings,
                Err(safe) => share *= 0.95 * safe,
            }
        }
        self.trial.place.clone_from(&work.before);
        self.trial.bodies.clone_from(&work.bodies_before);
        self.trial.hitches.share = work.near.fraction;
        0
    }

    /// Makes a share of the move to the target: the number of crossings found, or the share of it that is safe where
    /// all of it is not.
    fn carry_by(
        &mut self,
        model: &Model,
        work: &mut ContactWork,
        share: f64,
        with_bodies: bool,
    ) -> Result<u64, f64> {
        for (node, place) in self.trial.place.iter_mut().enumerate() {
            *place = work.before[node].lerp(work.target[node], share);
        }
        if with_bodies {
            self.blend_bodies(&work.bodies_before, share);
        }
        let skin_to = work.near.fraction + (1.0 - work.near.fraction) * share;
        self.trial.hitches.share = skin_to;
        self.trial.seat_ends(model, &self.plan);
        let safe = work.near.safe_share(&work.before, |node| self.trial.place[node], skin_to);
        let safe = safe.min(self.safe_of_ropes_from(&work.before));
        if safe < 1.0 {
            return Err(safe);
        }
        self.move_ropes_from(&work.before);
        Ok(work.near.make_move(&work.before, |node| self.trial.place[node], skin_to))
    }

    /// Puts bodies a share of the way from where they were to where they would drift.
    fn blend_bodies(&mut self, from: &[BodyTrial], share: f64) {
        for ((trial, from), to) in self.trial.bodies.iter_mut().zip(from).zip(&self.drift_bodies) {
            trial.place = from.place.lerp(to.place, share);
            trial.orientation = from.orientation.slerp(to.orientation, share);
        }
    }
}

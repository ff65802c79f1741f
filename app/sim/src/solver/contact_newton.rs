//! Newton with contact: push and friction inside the rope solve, every move filtered and searched.
//!
//! A contact point at fraction `α` of a segment acts on its two nodes with weights `1 - α` and `α`, so the
//! matrix stays block-tridiagonal. Push: `N n`, block `N' n nᵀ`. Friction `f(s, N)` from the plugin:
//! block `-∂f/∂s + (∂f/∂N)(N' n)ᵀ`, not symmetric, with the normal force coupled in.
//! Each move is cut by the sweep filter (`contact/near/mod.rs`), then searched along for balance (`line_search.rs`).

use super::Solver;
use super::scheme::Scheme;
use crate::contact::barrier::CRUSHED_SHARE;
use crate::contact::skin_friction::Failed;
use crate::contact::workspace::ContactWorkspace;
use crate::cost::CostPart;
use crate::model::Model;
use crate::state::State;

/// Most Newton passes of a solver step with contact.
pub(super) const MOST_PASSES: usize = 40;
/// Move at which Newton has converged [m].
const CONVERGED_M: f64 = 1e-6;
/// Passes after which a move of less than `CONTACT_WANTED_M` is enough: what still moves then only trembles.
const FINE_PASSES: usize = 10;
/// Share of a move below which a pass has got nowhere.
const STALLED_SHARE: f64 = 0.02;
/// Passes in a row that got nowhere after which no more are made.
const MOST_STALLED: usize = 4;
/// Move of the last pass above which a step counts as not converged [m].
pub(crate) const CONTACT_WANTED_M: f64 = 1e-5;
/// Move below which the search along the step is left out: rounding would decide it [m].
pub(super) const UNSEARCHED_M: f64 = 1e-5;
/// Difference between solved and true tension at which a step has converged [N].
pub(crate) const TENSION_GAP_N: f64 = 2.0;
/// Difference between solved and true tension at which a step has converged, as a share of the greatest tension.
pub(crate) const TENSION_GAP_SHARE: f64 = 0.02;
/// Most active sets of taut segments that are tried in a pass.
const MOST_ACTIVE_SETS: usize = 30;
/// Most times a move is cut because bodies turn.
pub(super) const MOST_CUTS: usize = 12;
/// Least share a cut leaves.
pub(super) const LEAST_CUT: f64 = 0.1;

/// How Newton with contact ended.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ContactEnd {
    /// The last move was this long after so many passes [m].
    Ended { last_m: f64, passes: usize, crossings: u64 },
    /// A number was not finite.
    NotFinite,
    /// Rope left the margin in which pairs were gathered.
    TooFar,
    /// Rope is crushed at this segment by this triangle.
    Crushed(usize, usize),
    /// These two segments are crushed by each other.
    CrushedRopes([usize; 2]),
    /// The friction plugin failed.
    Plugin(Failed),
}

impl Solver {
    /// Newton passes at the skin's present place until the moves are small.
    pub(crate) fn solve_contact(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        work: &mut ContactWorkspace,
    ) -> ContactEnd {
        let (mut last_m, mut crossings) = (f64::INFINITY, 0);
        work.open_points(model, &self.lengths.segment, &self.trial.place);
        let (mut passes, mut stalled) = (0, 0);
        while passes < MOST_PASSES && stalled < MOST_STALLED && last_m > enough(passes) {
            passes += 1;
            if let Err(ended) = self.assemble_touching(model, state, scheme, work) {
                return ended;
            }
            self.solve_active_set(model, state, scheme, Some(work));
            let longest = self.longest();
            if !longest.is_finite() {
                return ContactEnd::NotFinite;
            }
            let moved = |node: usize| self.trial.place[node] + self.tridiagonal.step[node];
            self.cost.enter(CostPart::Detection);
            let safe = work.near.safe_share(&self.trial.place, moved, work.near.fraction);
            let safe = safe.min(self.ropes.safe_share(&self.trial.place, moved));
            self.cost.enter(CostPart::Contact);
            let share = if longest * safe > UNSEARCHED_M {
                self.line_search(model, state, scheme, work, safe)
            } else {
                safe
            };
            self.cost.enter(CostPart::Detection);
            let (taken, crossed) = self.move_by(model, work, share);
            crossings += crossed;
            if work.strayed(&self.trial.place) {
                return ContactEnd::TooFar;
            }
            // What a short share leaves is still to go.
            let moved_before_m = last_m;
            last_m = longest;
            if taken >= 1.0 {
                last_m = left_to_go(last_m, moved_before_m);
            }
            stalled = if taken < STALLED_SHARE { stalled + 1 } else { 0 };
            if (taken < 1.0 || last_m <= enough(passes)) && self.open_more(state, work) {
                last_m = f64::INFINITY;
            }
            self.cost.enter(CostPart::Contact);
        }
        ContactEnd::Ended { last_m, passes, crossings }
    }

    /// Solves, until the segments that pull in the linear system are those that will be taut after the whole step.
    ///
    /// If segments were classified by where they are alone, slack rope that the step would draw taut stops the search along it after a small share,
    /// pass after pass: with segments of a centimetre the passes ran out before anything balanced.
    pub(super) fn solve_active_set(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        mut work: Option<&mut ContactWorkspace>,
    ) {
        self.solve(model);
        for _ in 0..MOST_ACTIVE_SETS {
            self.predict_tension(model, 1.0);
            if self
                .pull
                .iter()
                .zip(&self.trial.tension)
                .all(|(pull, tension)| pull.taut == (*tension > 0.0))
            {
                return;
            }
            self.assemble_again(model, state, scheme);
            if let Some(work) = &mut work {
                self.add_contact_blocks(work);
            }
            self.solve(model);
        }
    }

    /// Opens contact points where rope has come nearer to skin or rope than at those it has; whether there were any.
    fn open_more(&mut self, state: &State, work: &mut ContactWorkspace) -> bool {
        work.points.measure(&work.near, &self.trial.place);
        let on_rope = self.ropes.open_more(state, &self.trial.place);
        work.points.open_more(&work.near, &self.trial.place) > 0 || on_rope
    }

    /// Forces and matrix with contact at the trial places; what is linear in the search is kept apart.
    fn assemble_touching(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        work: &mut ContactWorkspace,
    ) -> Result<(), ContactEnd> {
        self.assemble_searchable(model, state, scheme);
        self.cost.enter(CostPart::Detection);
        work.points.measure(&work.near, &self.trial.place);
        self.cost.enter(CostPart::Contact);
        if let Some((segment, triangle)) = work.nearer_than(CRUSHED_SHARE) {
            return Err(ContactEnd::Crushed(segment, triangle));
        }
        if let Some(segments) = self.crushed_ropes(false) {
            return Err(ContactEnd::CrushedRopes(segments));
        }
        self.add_contacts(model, state, scheme, work).map_err(ContactEnd::Plugin)
    }

    fn add_contacts(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        work: &mut ContactWorkspace,
    ) -> Result<(), Failed> {
        let Some(friction) = &model.spec.friction else { return Ok(()) };
        work.touching.collect(model, &work.near, &work.points, state);
        work.touching.respond(friction, scheme.dt)?;
        self.add_contact_blocks(work);
        Ok(())
    }

    /// Adds push and friction of every contact point in touch.
    pub(super) fn add_contact_blocks(&mut self, work: &mut ContactWorkspace) {
        work.note_blocks();
        for (point, force, block) in work.contacts() {
            self.tridiagonal.add_at(point.segment, point.node, point.fraction, force, block);
        }
    }

    /// Takes the tension of every segment at the trial places as it is.
    pub(super) fn measure_tension(&mut self, model: &Model, scheme: &Scheme) {
        self.each_segment(model, |solver, segment, node| {
            solver.trial.tension[segment] = if solver.cut[segment] {
                0.0
            } else {
                solver.pull_of(segment, node, scheme).tension
            };
        });
    }

    /// Whether the pull of every segment in the last solve is the tension at its place, slack as zero.
    pub(crate) fn pull_is_settled(&mut self, model: &Model, scheme: &Scheme) -> bool {
        self.tension_missed(model, scheme) <= 1.0
    }

    /// Greatest difference between the pull of a segment in the last solve and the tension at its place, slack as zero, as a share
    /// of what is allowed.
    pub(super) fn tension_missed(&mut self, model: &Model, scheme: &Scheme) -> f64 {
        let (mut gap, mut greatest) = (0.0_f64, 0.0_f64);
        self.each_segment(model, |solver, segment, node| {
            if !solver.cut[segment] {
                let solved =
                    if solver.pull[segment].taut { solver.trial.tension[segment] } else { 0.0 };
                let there = solver.pull_of(segment, node, scheme).tension.max(0.0);
                gap = gap.max((solved - there).abs());
                greatest = greatest.max(solved);
            }
        });
        gap / TENSION_GAP_N.min(self.tolerance().gap_n).max(TENSION_GAP_SHARE * greatest)
    }

    fn each_segment(&mut self, model: &Model, mut act: impl FnMut(&mut Self, usize, usize)) {
        for index in 0..model.spec.lines.len() {
            let first_node = model.line_nodes[index].start;
            for (k, segment) in model.line_segments[index].clone().enumerate() {
                act(self, segment, first_node + k);
            }
        }
    }

    /// Moves the trial by at most this share of the step; the share taken and the crossings an exact test finds.
    ///
    /// Line ends on a body follow its turn, which the linear step only approximates, so the move is
    /// checked as it really comes out and made shorter until nothing crosses.
    fn move_by(
        &mut self,
        model: &Model,
        work: &mut ContactWorkspace,
        mut share: f64,
    ) -> (f64, u64) {
        work.before.clone_from(&self.trial.place);
        work.bodies_before.clone_from(&self.trial.bodies);
        for _ in 0..MOST_CUTS {
            self.advance(model, share);
            let safe = work.near.safe_share(
                &work.before,
                |node| self.trial.place[node],
                work.near.fraction,
            );
            let safe = safe.min(self.safe_of_ropes_from(&work.before));
            if safe >= 1.0 {
                self.move_ropes_from(&work.before);
                return (
                    share,
                    work.near.make_move(
                        &work.before,
                        |node| self.trial.place[node],
                        work.near.fraction,
                    ),
                );
            }
            self.trial.place.clone_from(&work.before);
            self.trial.bodies.clone_from(&work.bodies_before);
            share *= (0.9 * safe).max(LEAST_CUT);
        }
        (0.0, 0)
    }
}

/// Move that is small enough after so many passes [m].
pub(super) fn enough(passes: usize) -> f64 {
    if passes < FINE_PASSES { CONVERGED_M } else { CONTACT_WANTED_M }
}

/// What is left to go after a whole Newton move, from how the moves shrink [m]: the move itself where that is not small,
/// for forces are kept as they were before it.
///
/// With `θ = δ/δ'` the ratio of two moves, what is left is about `θ/(1-θ) δ` (Hairer and Wanner, section IV.8).
pub(super) fn left_to_go(last_m: f64, before_m: f64) -> f64 {
    let shrinkage = last_m / before_m;
    if last_m < CONTACT_WANTED_M && shrinkage < 0.5 {
        last_m * shrinkage / (1.0 - shrinkage)
    } else {
        last_m
    }
}

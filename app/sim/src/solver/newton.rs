//! Newton's method for one solver step, in contact or free.
//!
//! ```text
//! predictor x + h v
//! repeat
//!     evaluate contact at the trial; take it as linear
//!     repeat: solve rope and bodies; move the trial
//!     until the taut segments are those of the solution, and tension and normal force agree with their laws
//! until the error is below the tolerance (`stopping.rs`)
//! ```
//!
//! Rotation stretches a short slack segment to second order, and skin stiffens under compression. The next solution corrects both;
//! contact is not evaluated again. In a step short enough the balance is nearly linear, and one iteration or two suffice.
//!
//! A step that does not converge is made shorter (`step/substeps.rs`). Paths are not checked here but at the end of the step
//! (`step/contact.rs`).

use crate::contact::failure::ContactFailure;
use crate::contact::{ActiveSet, Assembly, ContactError, Order, Solution};
use crate::cost::CostPart;
use crate::forces::Forces;
use crate::model::Model;
use crate::solver::Solver;
use crate::solver::lanes::LanePass;
use crate::solver::stopping::{PassCount, PassDone, SHORT_S, Stopping};
use crate::trial::StepContext;
use crate::trial::scheme::Scheme;

/// Largest number of solutions for rope in an iteration, with contact linear.
const MOST_ROPE_SOLUTIONS: usize = 4;
/// Largest number of solutions with another set of taut segments.
const MOST_ACTIVE_SETS: usize = 6;

/// A step that is solved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solved {
    /// Number of iterations.
    pub passes: usize,
    /// Bound of the move of rope in them from the predictor [m].
    pub moved_m: f64,
    /// Error of the last iteration as a share of the tolerance, at most 1; `None` if it did not converge and is accepted anyway.
    pub missed: Option<f64>,
}

/// Why Newton ended without a balance.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum NewtonEnd {
    /// The error is still above the tolerance.
    NotConverged,
    /// A number was not finite.
    NotFinite,
    /// Contact refuses the step.
    Contact(ContactFailure),
}

impl From<ContactFailure> for NewtonEnd {
    fn from(failure: ContactFailure) -> Self {
        Self::Contact(failure)
    }
}

impl Solver {
    /// Solves a step that has begun.
    pub(crate) fn solve_step(&mut self, context: &StepContext<'_>) -> Result<Solved, NewtonEnd> {
        let in_contact = self.in_contact;
        let rules = Stopping::new(context, self.tolerance(), in_contact);
        if in_contact {
            self.cost.enter(CostPart::Detection);
            self.contacts.open(context, &self.trial);
            self.contacts.measure(context, &self.trial, &mut self.cost)?;
        }
        let (mut count, mut opened) = (PassCount::default(), false);
        while let Some(share) = count.begin(&rules) {
            let done = self.iterate(context, &rules, share);
            if !done.longest_m.is_finite() {
                return Err(NewtonEnd::NotFinite);
            }
            let error = if in_contact {
                self.contacts.measure(context, &self.trial, &mut self.cost)?;
                self.contacts.error(context, &self.trial)
            } else {
                ContactError::default()
            };
            let Some(missed) = count.end(&rules, &done, error) else { continue };
            if opened || !in_contact || !self.open_more(context) {
                return Ok(Solved {
                    passes: count.all,
                    moved_m: count.path_m,
                    missed: Some(missed),
                });
            }
            opened = true;
            count.open_more();
            self.contacts.measure(context, &self.trial, &mut self.cost)?;
        }
        if in_contact && context.scheme.dt <= SHORT_S && count.hardly_moves() {
            return Ok(Solved { passes: count.all, moved_m: count.path_m, missed: None });
        }
        Err(NewtonEnd::NotConverged)
    }

    /// Opens contact points where rope is closer to skin or rope than at those it has; returns whether there were any.
    fn open_more(&mut self, context: &StepContext<'_>) -> bool {
        self.cost.enter(CostPart::Detection);
        self.contacts.open_more(context, &self.trial)
    }

    /// One iteration with contact as evaluated last: rope is solved, with contact linear, until its tension is the one that the
    /// solution assumed. A half iteration moves the trial by half of its one solution.
    fn iterate(&mut self, context: &StepContext<'_>, rules: &Stopping, share: f64) -> PassDone {
        self.contacts.begin_iteration(context, &self.trial);
        let most = if rules.is_in_contact() && share >= 1.0 { MOST_ROPE_SOLUTIONS } else { 1 };
        let mut done = self.solve_rope(context, rules, share);
        for _ in 1..most {
            let error_n = done.gap_n.max(done.turned_n);
            let taut = error_n <= rules.tension_n(done.greatest_n);
            let pressed = {
                let error = self.contacts.law_error(&self.trial);
                error.gap_n <= rules.contact_n(error.greatest_n)
            };
            if (taut && pressed) || !done.longest_m.is_finite() {
                break;
            }
            self.contacts.linearise_at_solution(&self.trial);
            done = self.solve_rope(context, rules, share);
        }
        self.contacts.store_iteration(&self.trial);
        done.standing_m =
            Forces::longest_of_standing(context.model, &self.plan, &self.trial, &self.system);
        done
    }

    /// Solves rope with linear contact, and moves the trial by a share of the solution.
    fn solve_rope(&mut self, context: &StepContext<'_>, rules: &Stopping, share: f64) -> PassDone {
        if !self.system.in_lanes() {
            return self.solve_lines(context, share);
        }
        if self.contacts.adds_on_rope() {
            return self.solve_in_lanes(context, rules, share);
        }
        let passed = self.pass_in_lanes(context, share);
        self.pass_done(&passed)
    }

    /// Solves with rope held as lines.
    fn solve_lines(&mut self, context: &StepContext<'_>, share: f64) -> PassDone {
        let StepContext { model, scheme, .. } = *context;
        self.assemble(context);
        self.solve_taut(model);
        let finite = self.advance(model, share);
        let RopeMissed { gap_n, turned_n, greatest_n } = self.rope_missed(model, scheme);
        PassDone {
            longest_m: if finite { self.system.longest(&self.plan) } else { f64::NAN },
            body_m: self.system.longest_of_bodies(&self.plan),
            standing_m: 0.0,
            gap_n,
            turned_n,
            greatest_n,
            near_seabed: true,
        }
    }

    /// Solves with rope held as lanes, from the same places again until the segments that pull are those that are taut by the solution.
    /// If ropes are coupled, other segments keep their stiffness across: iterations then settle sooner (docs/lab-notebook.md).
    fn solve_in_lanes(
        &mut self,
        context: &StepContext<'_>,
        rules: &Stopping,
        share: f64,
    ) -> PassDone {
        let Self { contacts, plan, trial, system, .. } = self;
        system.clear_contact();
        let assembly =
            Assembly { context: *context, plan, trial, active_set: ActiveSet::Predicted };
        for order in [Order::Last, Order::First] {
            contacts.assemble_on_rope(order, &assembly, system);
        }
        self.before.clone_from(&self.trial.place);
        self.bodies_before.clone_from(&self.trial.bodies);
        let coupled = self.system.ropes_are_coupled();
        if coupled {
            self.system.lanes.store_tension();
        }
        let mut solved = 0;
        loop {
            let passed = self.pass_in_lanes(context, share);
            let settled = passed.flipped_n <= rules.tension_n(passed.greatest_n);
            if settled || !passed.finite || solved == MOST_ACTIVE_SETS {
                self.take_places();
                let (rope, bodies) = (&self.before[..], &self.bodies_before[..]);
                self.contacts.store_solution(&self.trial, &Solution::Moved { rope, bodies, share });
                return self.pass_done(&passed);
            }
            solved += 1;
            self.trial.place.clone_from(&self.before);
            self.trial.bodies.clone_from(&self.bodies_before);
            self.system.lanes.take_places(&self.trial.place);
            if coupled {
                self.system.lanes.restore_tension();
            }
        }
    }

    fn pass_done(&self, passed: &LanePass) -> PassDone {
        PassDone {
            longest_m: if passed.finite { passed.longest_m } else { f64::NAN },
            body_m: self.system.longest_of_bodies(&self.plan),
            standing_m: 0.0,
            gap_n: passed.gap_n.max(passed.flipped_n),
            turned_n: passed.turned_n,
            greatest_n: passed.greatest_n,
            near_seabed: passed.near_seabed,
        }
    }

    /// Solves until the segments that pull are those that are taut by the linear solution.
    fn solve_taut(&mut self, model: &Model) {
        self.linear_part.interface.copy_values(&self.system.interface);
        self.solve(model);
        for _ in 0..MOST_ACTIVE_SETS {
            let Self { forces, trial, system, plan, linear_part, .. } = self;
            forces.predict_tension(model, trial, system, 1.0);
            let Some(changed) = forces.change_taut(model, trial, system) else { return };
            system.interface.copy_values(&linear_part.interface);
            system.solve_changed(model, plan, trial, Some(changed));
        }
    }

    /// Error of the last solution for rope at the trial.
    fn rope_missed(&self, model: &Model, scheme: &Scheme) -> RopeMissed {
        let Self { forces, trial, .. } = self;
        let mut missed = RopeMissed::default();
        for (index, segments) in model.line_segments.iter().enumerate() {
            let first_node = model.line_nodes[index].start;
            for (node, segment) in (first_node..).zip(segments.clone()) {
                if forces.cut[segment] {
                    continue;
                }
                let before = &forces.pull[segment];
                let solved = if before.taut { trial.tension[segment] } else { 0.0 };
                let there = forces.pull_of(segment, node, scheme, trial);
                let turn = there.direction.distance(before.direction);
                let change = (solved - before.tension.max(0.0)).abs();
                missed.gap_n = missed.gap_n.max((solved - there.tension.max(0.0)).abs());
                missed.turned_n = missed.turned_n.max((change + solved.max(0.0) * turn) * turn);
                missed.greatest_n = missed.greatest_n.max(solved);
            }
        }
        missed
    }
}

/// Error of a solution for rope at the trial [N].
#[derive(Clone, Copy, Debug, Default)]
struct RopeMissed {
    /// Greatest difference between the pull of a segment in the solution and the tension at its place, slack as zero.
    gap_n: f64,
    /// Greatest difference between the two across the rope, as segments turn.
    turned_n: f64,
    /// Greatest pull.
    greatest_n: f64,
}

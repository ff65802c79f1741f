//! Newton's method for one solver step, whatever touches the rope: water and seabed alone, obstacles and bodies, other rope, skin.
//!
//! From the guess `x + h v` a pass measures push and friction of every contact point and takes them as linear. With them in it, rope is solved
//! until the segments that pull are those that are taut by the solution, and tension and push are the laws' where the trial then stands. A turn of
//! a short slack segment stretches it to second order, and skin stiffens as it is pressed: the next solution mends both without measuring contact
//! anew. In a step short enough the balance is nearly linear, and one pass or two reach it.
//!
//! When passes stop is decided in `stopping.rs`. A step that has not converged is made shorter (`step/substeps.rs`). No path is looked at here:
//! whether the step leads through skin or rope is judged by where it ends (`step/contact.rs`).

use crate::contact::ContactMissed;
use crate::contact::law::friction_arrays::Failed;
use crate::contact::rope_on_skin::ContactWorkspace;
use crate::contact::rope_on_solid::kind::ActiveSet;
use crate::cost::CostPart;
use crate::model::Model;
use crate::solver::Solver;
use crate::solver::in_lanes::LanePass;
use crate::solver::stopping::{PassCount, PassDone, SHORT_S, Stopping};
use crate::trial::StepContext;
use crate::trial::scheme::Scheme;

/// Most solutions for rope in a pass, with contact linear.
const MOST_ROPE_SOLUTIONS: usize = 4;
/// Most times a solution is sought again for other taut segments.
const MOST_ACTIVE_SETS: usize = 6;

/// Rope near skin, where a whale is near.
pub(crate) type Skin<'a> = Option<&'a mut ContactWorkspace>;

/// A step that is solved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solved {
    /// Passes that it took.
    pub passes: usize,
    /// How far rope moved in them from its guess, at most [m].
    pub moved_m: f64,
    /// How much of what is allowed the last solution missed by, at most 1; `None` where it did not converge and is kept all the same.
    pub missed: Option<f64>,
}

/// Why Newton ended without a balance.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum NewtonEnd {
    /// It still missed by more than is allowed.
    NotConverged,
    /// A number was not finite.
    NotFinite,
    /// Rope is crushed at this segment by this triangle.
    Crushed(usize, usize),
    /// The core of this body meets this triangle.
    BodyCrushed(usize, usize),
    /// The cores of these two bodies meet.
    BodiesCrushed([usize; 2]),
    /// These two segments are crushed by each other.
    CrushedRopes([usize; 2]),
    /// More rope lies together at these two segments than is solved.
    CrowdedRopes([usize; 2]),
    /// The friction plugin failed.
    Plugin(Failed),
}

impl Solver {
    /// Solves a step that has begun.
    pub(crate) fn solve_step(
        &mut self,
        context: &StepContext<'_>,
        mut skin: Skin<'_>,
    ) -> Result<Solved, NewtonEnd> {
        let in_contact = self.in_contact;
        let rules = Stopping::new(context, self.tolerance(), in_contact);
        if in_contact {
            self.open_contacts(context, skin.as_deref_mut());
            self.measure_contacts(context, skin.as_deref_mut())?;
        }
        let (mut count, mut opened) = (PassCount::default(), false);
        while let Some(share) = count.begin(&rules) {
            let done = self.newton_pass(context, skin.as_deref_mut(), &rules, share);
            if !done.longest_m.is_finite() {
                return Err(NewtonEnd::NotFinite);
            }
            let missed = if in_contact {
                self.measure_contacts(context, skin.as_deref_mut())?;
                self.contact_missed(context, skin.as_deref_mut())
            } else {
                ContactMissed::default()
            };
            let Some(missed) = count.end(&rules, &done, missed) else { continue };
            if opened || !in_contact || !self.open_more(context, skin.as_deref_mut()) {
                return Ok(Solved {
                    passes: count.all,
                    moved_m: count.path_m,
                    missed: Some(missed),
                });
            }
            opened = true;
            count.open_more();
            self.measure_contacts(context, skin.as_deref_mut())?;
        }
        if in_contact && context.scheme.dt <= SHORT_S && count.hardly_moves() {
            return Ok(Solved { passes: count.all, moved_m: count.path_m, missed: None });
        }
        Err(NewtonEnd::NotConverged)
    }

    /// Opens the contact points of rope on skin and on rope where the trial stands.
    fn open_contacts(&mut self, context: &StepContext<'_>, skin: Skin<'_>) {
        let StepContext { model, state, .. } = *context;
        self.cost.enter(CostPart::Detection);
        if let Some(work) = skin {
            work.open_active_points(model, state, &self.lengths.segment, &self.trial.place);
        }
        if self.ropes.touching {
            self.ropes.open(state, &self.trial.place);
        }
    }

    /// Opens contact points where rope has come nearer to skin or rope than at those it has; whether there were any.
    fn open_more(&mut self, context: &StepContext<'_>, skin: Skin<'_>) -> bool {
        self.cost.enter(CostPart::Detection);
        let on_skin = skin.is_some_and(|work| {
            let opened = work.points.open_more(&work.near, &self.trial.place) > 0;
            if opened {
                work.points.begin(context.model, &context.state.rope.position);
            }
            opened
        });
        let on_rope = self.ropes.touching && self.ropes.open_more(context.state, &self.trial.place);
        on_skin || on_rope
    }

    /// Measures contact with skin where the trial stands, and looks for rope that is crushed.
    fn measure_contacts(
        &mut self,
        context: &StepContext<'_>,
        skin: Skin<'_>,
    ) -> Result<(), NewtonEnd> {
        if let Some(work) = skin {
            self.measure_skin(context, work)?;
        }
        self.measure_bodies(context)?;
        self.measure_body_pairs(context)?;
        if let Some(segments) = self.ropes.crowded {
            return Err(NewtonEnd::CrowdedRopes(segments));
        }
        self.cost.enter(CostPart::Contact);
        self.crushed_ropes(false).map_or(Ok(()), |segments| Err(NewtonEnd::CrushedRopes(segments)))
    }

    /// What the contacts of the last solution miss where the trial now stands.
    fn contact_missed(&mut self, context: &StepContext<'_>, skin: Skin<'_>) -> ContactMissed {
        let on_skin = skin.map_or_else(ContactMissed::default, |work| work.missed());
        on_skin
            .and(self.solids_missed(context.state, context.scheme))
            .and(self.ropes_missed(context.state))
            .and(self.bodies_missed())
            .and(self.body_pairs_missed())
    }

    /// One pass with contact as measured last: rope is solved, with contact linear, until its tension is what the solution took for granted.
    /// A half pass moves the trial by half of its one solution.
    fn newton_pass(
        &mut self,
        context: &StepContext<'_>,
        mut skin: Skin<'_>,
        rules: &Stopping,
        share: f64,
    ) -> PassDone {
        if let Some(work) = skin.as_deref_mut() {
            work.before.clone_from(&self.trial.place);
            work.note_blocks();
        }
        let most = if rules.is_in_contact() && share >= 1.0 { MOST_ROPE_SOLUTIONS } else { 1 };
        let mut done = self.solve_rope(context, skin.as_deref_mut(), rules, share);
        for _ in 1..most {
            let missed_n = done.gap_n.max(done.turned_n);
            let taut = missed_n <= rules.tension_n(done.greatest_n);
            let pushed = skin.as_deref().is_none_or(|work| {
                let missed = work.law_missed(&self.trial.place);
                missed.gap_n <= rules.contact_n(missed.greatest_n)
            });
            if (taut && pushed) || !done.longest_m.is_finite() {
                break;
            }
            if let Some(work) = skin.as_deref_mut() {
                work.follow_law(&self.trial.place);
            }
            done = self.solve_rope(context, skin.as_deref_mut(), rules, share);
        }
        if let Some(work) = skin {
            work.note_solved(&self.trial.place);
        }
        self.note_solved_bodies();
        self.note_solved_body_pairs();
        done.standing_m = self.longest_of_standing(context.model);
        done
    }

    /// Solves rope with linear contact, and moves the trial by a share of the solution.
    fn solve_rope(
        &mut self,
        context: &StepContext<'_>,
        skin: Skin<'_>,
        rules: &Stopping,
        share: f64,
    ) -> PassDone {
        let StepContext { model, state, scheme } = *context;
        match skin {
            None if self.in_lanes && !self.solid.touching => {
                let passed = self.pass_in_lanes(model, state, scheme, share);
                self.pass_done(&passed)
            }
            skin if self.in_lanes => self.solve_in_lanes(context, skin, rules, share),
            skin => self.solve_lines(context, skin, share),
        }
    }

    /// The same line by line.
    fn solve_lines(&mut self, context: &StepContext<'_>, skin: Skin<'_>, share: f64) -> PassDone {
        let StepContext { model, state, scheme } = *context;
        self.ropes.follow(&self.trial.place);
        self.assemble(model, state, scheme);
        if let Some(work) = skin {
            let Self { tridiagonal, trial, .. } = self;
            for (point, force, block) in work.contacts_at(&trial.place) {
                tridiagonal.add_at(point.segment, point.node, point.fraction, force, block);
            }
        }
        self.solve_taut(model);
        self.note_solved_ropes();
        let finite = self.advance(model, share);
        let RopeMissed { gap_n, turned_n, greatest_n } = self.rope_missed(model, scheme);
        PassDone {
            longest_m: if finite { self.longest() } else { f64::NAN },
            body_m: self.longest_of_bodies(),
            standing_m: 0.0,
            gap_n,
            turned_n,
            greatest_n,
            near_seabed: true,
        }
    }

    /// The same in the lanes, from the same places again until the segments that pull are those that are taut by the solution.
    fn solve_in_lanes(
        &mut self,
        context: &StepContext<'_>,
        skin: Skin<'_>,
        rules: &Stopping,
        share: f64,
    ) -> PassDone {
        let StepContext { model, state, scheme } = *context;
        self.lanes.leave_contact();
        if let Some(work) = skin {
            let Self { lanes, trial, .. } = self;
            for (point, force, block) in work.contacts_at(&trial.place) {
                lanes.add_contact(point.segment, point.fraction, force, block);
            }
        }
        if self.solid.touching {
            self.measure_solids(state, scheme, ActiveSet::Predicted);
            self.give_solids_to_lanes(model);
        }
        self.before.clone_from(&self.trial.place);
        self.bodies_before.clone_from(&self.trial.bodies);
        let mut solved = 0;
        loop {
            let passed = self.pass_in_lanes(model, state, scheme, share);
            let settled = passed.flipped_n <= rules.tension_n(passed.greatest_n);
            if settled || !passed.finite || solved == MOST_ACTIVE_SETS {
                self.lanes.give_places(&mut self.trial.place);
                if self.solid.touching {
                    self.predict_pushes_in_lanes();
                }
                return self.pass_done(&passed);
            }
            solved += 1;
            self.trial.place.clone_from(&self.before);
            self.trial.bodies.clone_from(&self.bodies_before);
            self.lanes.take_places(&self.trial.place);
        }
    }

    fn pass_done(&self, passed: &LanePass) -> PassDone {
        PassDone {
            longest_m: if passed.finite { passed.longest_m } else { f64::NAN },
            body_m: self.longest_of_bodies(),
            standing_m: 0.0,
            gap_n: passed.gap_n.max(passed.flipped_n),
            turned_n: passed.turned_n,
            greatest_n: passed.greatest_n,
            near_seabed: passed.near_seabed,
        }
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

    /// What the last solution for rope misses at its place.
    fn rope_missed(&mut self, model: &Model, scheme: &Scheme) -> RopeMissed {
        let mut missed = RopeMissed::default();
        for (index, segments) in model.line_segments.iter().enumerate() {
            let first_node = model.line_nodes[index].start;
            for (node, segment) in (first_node..).zip(segments.clone()) {
                if self.cut[segment] {
                    continue;
                }
                let before = &self.pull[segment];
                let solved = if before.taut { self.trial.tension[segment] } else { 0.0 };
                let there = self.pull_of(segment, node, scheme);
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

/// What a solution for rope misses at its place [N].
#[derive(Clone, Copy, Debug, Default)]
struct RopeMissed {
    /// Greatest difference between the pull of a segment in the solution and the tension at its place, slack as zero.
    gap_n: f64,
    /// Greatest difference between the two across the rope, as segments turn.
    turned_n: f64,
    /// Greatest pull.
    greatest_n: f64,
}

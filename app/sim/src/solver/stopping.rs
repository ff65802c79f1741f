//! Convergence of the iterations of a step, and their number.
//!
//! A step has converged if what its last solution assumed holds at the trial:
//!
//! | quantity | tolerance | step |
//! |---|---|---|
//! | tension of a segment: solution against the law | 2 N or 2 % of the weight of all gear, whichever is less; or 2 % of the greatest tension | of any kind |
//! | force across a segment that turns: solution against the law | as for tension | in contact |
//! | normal force and friction at a contact point of skin: solution against the law | 0.1 N, or 2 % of the greatest | in contact |
//! | normal force and friction of rope on rope and on obstacles | 10 mN, or 0.2 % | in contact |
//! | normal force and friction of rope on bodies of the rig | 1 mN, or 0.02 % | in contact |
//! | move of a body in the last solution | 0.1 mm | in contact; on the seabed in any step |
//! | move of the last solution | 1 mm, or 2 % of the shortest segment, whichever is less | free |
//! | remaining move, if rope resists bending | 10 µm | of any kind |
//!
//! In contact a move is not bounded by itself: it changes the balance only as far as segments under tension turn by it. Slack rope may
//! swing by millimetres from iteration to iteration while every force is known.
//!
//! A step of free rope in two stages has a tenth of that tolerance of tension, along and across a segment.
//! The share of the greatest normal force and friction is `contact_tolerance`; the table states the default. The other tolerances
//! scale with it if rope is in contact. A free step takes two iterations unless the first was nearly exact.
//! If moves shrink by a factor `θ` in each iteration, `θ/(1-θ)` of the last remains (Hairer and Wanner 1996, section IV.8).

use crate::contact::ContactError;
use crate::model::CONTACT_TOLERANCE;
use crate::solver::Tolerance;
use crate::trial::StepContext;

/// Difference of tension [N], and as a share of the greatest.
const TENSION_N: f64 = 2.0;
const TENSION_SHARE: f64 = 0.02;
/// Factor on this tolerance in a step in two stages: its second stage more than doubles the error of the first.
const STAGE_LENIENCY: f64 = 0.1;
/// Difference of push and friction [N].
const CONTACT_N: f64 = 0.1;
/// Move of the last solution, of free rope and of a body [m].
const MOVE_M: f64 = 1e-3;
const BODY_MOVE_M: f64 = 1e-4;
/// Move that is left where rope resists bending, whose passes converge linearly [m].
const BENT_LEFT_M: f64 = 1e-5;

/// Iteration limit in contact, and once more after further contact points are opened.
const MOST_PASSES: usize = 8;
/// Iteration limit of a free step: one per 12 segments, because slack propagates one segment per iteration; at least 12, at most 40.
const SEGMENTS_FOR_A_PASS: usize = 12;
const MOST_FREE_PASSES: [usize; 2] = [12, 40];
/// Iteration limit of a step in two stages as short as [`SHORT_S`]: stiff rope falls slack one segment per iteration.
const MOST_SHORT_FREE_PASSES: usize = 80;
/// Iteration limit if rope resists bending.
const MOST_BENT_PASSES: usize = 40;
/// Smallest number of iterations of a free step.
const LEAST_FREE_PASSES: usize = 2;
/// Error of tension for which one iteration suffices in a free step: [N], and as a share of the greatest tension.
const EXACT_N: f64 = 0.02;
const EXACT_SHARE: f64 = 1e-4;

/// Ratio of an error to that of the iteration before, above which iterations have stalled: the next takes half of its move, because
/// whole moves oscillate.
const STALLED_SHARE: f64 = 0.5;

/// A step up to this length that does not converge is accepted if it hardly moves any more, and counted [s].
pub(crate) const SHORT_S: f64 = 1.3e-4;
/// Iteration limit of such a short step.
const MOST_SHORT_PASSES: usize = 24;
/// Beyond [`MOST_PASSES`], every fifth iteration of a short step takes its whole move, and the others half of it. Whole moves alternate
/// between two states of contact.
const WHOLE_MOVE_EVERY: usize = 5;

/// Result of an iteration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PassDone {
    /// Longest solved move of a node or body [m].
    pub longest_m: f64,
    /// Longest solved move of a body, and of a body on the seabed [m].
    pub body_m: f64,
    pub standing_m: f64,
    /// Greatest difference between the solved tension and the law at the trial [N].
    pub gap_n: f64,
    /// Greatest difference across the rope, as segments turn [N].
    pub turned_n: f64,
    /// Greatest tension [N].
    pub greatest_n: f64,
    /// Whether rope may touch the seabed.
    pub near_seabed: bool,
}

/// Tolerances of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stopping {
    in_contact: bool,
    /// Whether the step is free and in two stages.
    in_stages: bool,
    bends: bool,
    /// Factor on the default tolerances.
    leniency: f64,
    tension_n: f64,
    contact_share: f64,
    most_passes: usize,
    fine: Tolerance,
}

impl Stopping {
    /// Tolerances of a step, in contact or free.
    pub fn new(context: &StepContext<'_>, fine: Tolerance, in_contact: bool) -> Self {
        let StepContext { model, state, scheme } = *context;
        let contact_share = model.spec.settings.contact_tolerance;
        let in_stages = !in_contact && state.step_control.in_two_stages();
        let leniency = match (in_contact, in_stages) {
            (true, _) => contact_share / CONTACT_TOLERANCE,
            (false, true) => STAGE_LENIENCY,
            (false, false) => 1.0,
        };
        let bends = model.bends();
        let most_passes = match (bends, in_contact) {
            (true, _) => MOST_BENT_PASSES,
            (false, true) if scheme.dt <= SHORT_S => MOST_SHORT_PASSES,
            (false, true) => MOST_PASSES,
            (false, false) if in_stages && scheme.dt <= SHORT_S => MOST_SHORT_FREE_PASSES,
            (false, false) => {
                let [least, most] = MOST_FREE_PASSES;
                (model.segment_count / SEGMENTS_FOR_A_PASS).clamp(least, most)
            }
        };
        Self {
            in_contact,
            in_stages,
            bends,
            leniency,
            tension_n: TENSION_N.min(fine.gap_n),
            contact_share,
            most_passes,
            fine,
        }
    }

    /// Whether rope may be in contact.
    pub fn is_in_contact(&self) -> bool {
        self.in_contact
    }

    /// Tolerance of tension [N].
    pub fn tension_n(&self, greatest_n: f64) -> f64 {
        self.leniency * self.tension_n.max(TENSION_SHARE * greatest_n)
    }

    /// Tolerance of normal force and friction on skin [N].
    pub fn contact_n(&self, greatest_n: f64) -> f64 {
        (self.leniency * CONTACT_N).max(self.contact_share * greatest_n)
    }

    /// Error of an iteration as a share of the tolerance; `before_m` is the move of the iteration before [m].
    pub fn missed(&self, done: &PassDone, contact: ContactError, before_m: f64) -> f64 {
        let tension_n = self.tension_n(done.greatest_n);
        let body_move_m = self.leniency * BODY_MOVE_M;
        let mut missed = (done.gap_n / tension_n).max(done.standing_m / body_move_m);
        if self.bends {
            let shrinkage = (done.longest_m / before_m).min(0.9999);
            let left_m = done.longest_m * shrinkage / (1.0 - shrinkage);
            missed = missed.max(left_m / (self.leniency * BENT_LEFT_M.min(self.fine.move_m)));
        } else if !self.in_contact {
            missed = missed.max(done.longest_m / MOVE_M.min(self.fine.move_m));
        }
        if !self.in_contact {
            return if self.in_stages { missed.max(done.turned_n / tension_n) } else { missed };
        }
        let contact_n = self.contact_n(contact.greatest_n);
        missed
            .max(done.turned_n / tension_n)
            .max(contact.gap_n / contact_n)
            .max(done.body_m / body_move_m)
    }

    /// Whether a step may end after an iteration with this number.
    fn is_enough(&self, pass: usize, done: &PassDone) -> bool {
        let exact = || {
            let gap_n = EXACT_N.min(self.fine.gap_n).max(EXACT_SHARE * done.greatest_n);
            !done.near_seabed && done.gap_n < gap_n
        };
        pass >= LEAST_FREE_PASSES || (!self.bends && (self.in_contact || exact()))
    }
}

/// Iterations of a step so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PassCount {
    pub all: usize,
    /// Since the last contact points were opened.
    since_opened: usize,
    /// Error of the last iteration; infinite before the first and after half a move.
    missed: f64,
    /// Move of the last iteration [m].
    moved_m: f64,
    /// Sum of the moves of all iterations [m].
    pub path_m: f64,
    /// Whether the next iteration takes half of its move.
    half: bool,
}

impl Default for PassCount {
    fn default() -> Self {
        Self {
            all: 0,
            since_opened: 0,
            missed: f64::INFINITY,
            moved_m: f64::INFINITY,
            path_m: 0.0,
            half: false,
        }
    }
}

impl PassCount {
    /// Begins an iteration; returns the share of its move to take, `None` at the iteration limit.
    pub fn begin(&mut self, rules: &Stopping) -> Option<f64> {
        if self.since_opened >= rules.most_passes {
            return None;
        }
        self.all += 1;
        self.since_opened += 1;
        Some(if self.half { 0.5 } else { 1.0 })
    }

    /// Ends an iteration; returns its error as a share of the tolerance if the step has converged.
    pub fn end(&mut self, rules: &Stopping, done: &PassDone, contact: ContactError) -> Option<f64> {
        let missed = rules.missed(done, contact, self.moved_m);
        let was_half = self.half;
        let stalled = !was_half && missed > STALLED_SHARE * self.missed;
        let takes_half = if self.since_opened > MOST_PASSES && !rules.bends {
            !self.since_opened.is_multiple_of(WHOLE_MOVE_EVERY)
        } else {
            stalled
        };
        self.half = rules.in_contact && takes_half;
        self.missed = if was_half { f64::INFINITY } else { missed };
        self.moved_m = done.longest_m;
        self.path_m += done.longest_m;
        (!was_half && missed <= 1.0 && rules.is_enough(self.all, done)).then_some(missed)
    }

    /// Restarts the count, with further contact points.
    pub fn open_more(&mut self) {
        *self = Self { all: self.all, path_m: self.path_m, ..Self::default() };
    }

    /// Whether the last iteration hardly moved anything.
    pub fn hardly_moves(&self) -> bool {
        self.moved_m <= MOVE_M
    }
}

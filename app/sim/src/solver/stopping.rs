//! When Newton's passes have converged, and how many are made: the rules of every kind of step.
//!
//! A step has converged when what its last solution took for granted is so where the trial now stands:
//!
//! | quantity | allowed | in a step |
//! |---|---|---|
//! | tension of a segment, by the solution against the law at its place | 2 N or 2 % of the weight of all gear, if that is less; or 2 % of the greatest tension | of any kind |
//! | pull across a segment that turns, likewise | the same | in contact |
//! | push and friction on a contact point of skin, likewise | 0.1 N, or 2 % of the greatest | in contact |
//! | the same of rope on rope and on obstacles | 10 mN, or 0.2 % | in contact |
//! | the same of rope on bodies of the rig | 1 mN, or 0.02 % | in contact |
//! | move of a body in the last solution | 0.1 mm | in contact; of one that stands on the seabed in any kind |
//! | move of the last solution | 1 mm, or 2 % of the shortest segment, if that is less | free |
//! | move that is left, where rope resists bending | 10 µm | of any kind |
//!
//! In contact a move is not bounded by itself: it costs balance only as far as segments under tension turn by it. Slack rope may swing to
//! and fro by millimetres from pass to pass, with every force known.
//!
//! A step of free rope in two stages may miss a tenth of that tension, and as much across a segment.
//! The share of the greatest push and friction is `contact_tolerance`, here the usual one; the other figures are in proportion to it where
//! rope is in contact. A free step takes two passes unless the first was as good as exact.
//! Of moves that shrink by `θ` in each pass, `θ/(1-θ)` of the last is left (Hairer and Wanner 1996, section IV.8).

use crate::contact::ContactError;
use crate::model::CONTACT_TOLERANCE;
use crate::solver::Tolerance;
use crate::trial::StepContext;

/// Difference of tension [N], and as a share of the greatest.
const TENSION_N: f64 = 2.0;
const TENSION_SHARE: f64 = 0.02;
/// A step in two stages may miss so much of this: it is taken for accuracy, and its second stage more than doubles what the first missed.
const STAGE_LENIENCY: f64 = 0.1;
/// Difference of push and friction [N].
const CONTACT_N: f64 = 0.1;
/// Move of the last solution, of free rope and of a body [m].
const MOVE_M: f64 = 1e-3;
const BODY_MOVE_M: f64 = 1e-4;
/// Move that is left where rope resists bending, whose passes converge linearly [m].
const BENT_LEFT_M: f64 = 1e-5;

/// Most passes in contact, and as many again once further contact points are opened.
const MOST_PASSES: usize = 8;
/// Most passes of a free step: as many as this for so many segments, for slack runs along rope segment by segment, and within these bounds.
const SEGMENTS_FOR_A_PASS: usize = 12;
const MOST_FREE_PASSES: [usize; 2] = [12, 40];
/// Most passes of a step in two stages that was made as short as [`SHORT_S`]: hard rope falls slack segment by segment, one in each pass.
const MOST_SHORT_FREE_PASSES: usize = 80;
/// Most passes where rope resists bending.
const MOST_BENT_PASSES: usize = 40;
/// Passes that a free step takes at least.
const LEAST_FREE_PASSES: usize = 2;
/// What a free step may miss of what is allowed for one pass to be enough: of move, of tension by itself and as a share of the greatest.
const EXACT_N: f64 = 0.02;
const EXACT_SHARE: f64 = 1e-4;

/// Share of what the pass before missed by, above which a pass has stalled: the next goes half of the way, for whole ones go to and fro.
const STALLED_SHARE: f64 = 0.5;

/// Step up to which one that does not converge is kept where it hardly moves any more, and counted [s].
pub(crate) const SHORT_S: f64 = 1.3e-4;
/// Most passes of so short a step.
const MOST_SHORT_PASSES: usize = 24;

/// What a pass did.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PassDone {
    /// Longest move of a node or body that it solved for [m].
    pub longest_m: f64,
    /// Longest move of a body, and of one that stands on the seabed [m].
    pub body_m: f64,
    pub standing_m: f64,
    /// Greatest difference between the tension that it solved for and the one at its place [N].
    pub gap_n: f64,
    /// The same across the rope, as segments turn [N].
    pub turned_n: f64,
    /// Greatest tension [N].
    pub greatest_n: f64,
    /// Whether rope may touch the seabed.
    pub near_seabed: bool,
}

/// What is allowed in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stopping {
    in_contact: bool,
    /// Whether the step is free and in two stages.
    in_stages: bool,
    bends: bool,
    /// What is allowed as a multiple of what is usual.
    leniency: f64,
    tension_n: f64,
    contact_share: f64,
    most_passes: usize,
    fine: Tolerance,
}

impl Stopping {
    /// The rules of a step, in contact or free.
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

    /// Difference of tension that is allowed [N].
    pub fn tension_n(&self, greatest_n: f64) -> f64 {
        self.leniency * self.tension_n.max(TENSION_SHARE * greatest_n)
    }

    /// Difference of push and friction on skin that is allowed [N].
    pub fn contact_n(&self, greatest_n: f64) -> f64 {
        (self.leniency * CONTACT_N).max(self.contact_share * greatest_n)
    }

    /// What a pass missed by, as a share of what is allowed; `before_m` is how far the pass before it moved [m].
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

    /// Whether a step may end after its first pass.
    fn is_enough(&self, pass: usize, done: &PassDone) -> bool {
        let exact = || {
            let gap_n = EXACT_N.min(self.fine.gap_n).max(EXACT_SHARE * done.greatest_n);
            !done.near_seabed && done.gap_n < gap_n
        };
        pass >= LEAST_FREE_PASSES || (!self.bends && (self.in_contact || exact()))
    }
}

/// Passes of a step so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PassCount {
    pub all: usize,
    /// Since the last contact points were opened.
    since_opened: usize,
    /// What the last missed by; beyond any bound where it went half of the way, or where there was none.
    missed: f64,
    /// How far it moved [m].
    moved_m: f64,
    /// How far all of them moved [m].
    pub path_m: f64,
    /// Whether the next goes half of the way.
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
    /// Begins a pass: the share of its move to take; `None` where there have been enough.
    pub fn begin(&mut self, rules: &Stopping) -> Option<f64> {
        if self.since_opened >= rules.most_passes {
            return None;
        }
        self.all += 1;
        self.since_opened += 1;
        Some(if self.half { 0.5 } else { 1.0 })
    }

    /// Takes in what a pass missed by, contact included; what that is of what is allowed, where the step has converged.
    pub fn end(&mut self, rules: &Stopping, done: &PassDone, contact: ContactError) -> Option<f64> {
        let missed = rules.missed(done, contact, self.moved_m);
        let was_half = self.half;
        self.half = rules.in_contact && !was_half && missed > STALLED_SHARE * self.missed;
        self.missed = if was_half { f64::INFINITY } else { missed };
        self.moved_m = done.longest_m;
        self.path_m += done.longest_m;
        (!was_half && missed <= 1.0 && rules.is_enough(self.all, done)).then_some(missed)
    }

    /// Begins to count again, with further contact points.
    pub fn open_more(&mut self) {
        *self = Self { all: self.all, path_m: self.path_m, ..Self::default() };
    }

    /// Whether the last pass hardly moved anything.
    pub fn hardly_moves(&self) -> bool {
        self.moved_m <= MOVE_M
    }
}

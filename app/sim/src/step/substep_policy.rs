//! The length of solver steps within a step of the model.
//!
//! | situation | length of the next solver step |
//! |---|---|
//! | nothing may touch | the rest of the model's step, or less if accuracy asks for it (`step_control.rs`) |
//! | rope or a body may be near the whale, or rope may touch rope | at most the contact step, which adapts to the error of Newton |
//! | the same, and rope touches rope at more than four points | the same, at most 2 ms |
//! | near the whale, and all stays clear of skin until the end of the model's step | as if nothing may touch |
//! | after a rejection near the whale | the contact step becomes half of the rejected step, down to 0.1 ms |
//! | after any other rejection | half of the rejected step; after each accepted step twice as long again |
//!
//! Every length divides the rest of the model's step into equal parts. No step is shorter than `settings.least_step_s`.

use super::rejection::{Rejection, StepKind};
use crate::model::Settings;
use crate::state::{LimitedBy, StepControl};

/// Error of Newton, as a share of the tolerance, below which the next contact step is longer, and by which factor. After a single
/// iteration it is longer at any error: a second iteration costs less than a second step.
const LITTLE_MISSED: f64 = 0.3;
const GROWTH: f64 = 1.4;
/// Longest contact step where rope touches rope at more points than these [s]: in longer steps, the solutions for the sets of taut
/// segments cost more than is saved (docs/lab-notebook.md).
const ROPES_STEP_S: f64 = 0.002;
const FEW_ROPE_TOUCHES: usize = 4;
/// Shortest contact step that is chosen; a shorter step is halved for itself [s].
const LEAST_CHOSEN_S: f64 = 1e-4;

/// A solver step to try.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Substep {
    /// Its length [s].
    pub length_s: f64,
    /// What limits it.
    pub limit: LimitedBy,
    /// Whether it is shortened after a rejection.
    pub is_halved: bool,
    /// Whether contact determines its length.
    pub by_contact: bool,
}

/// What follows a rejected step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AfterRejection {
    /// A step that is limited by contact.
    LimitByContact,
    /// A shorter step.
    Shorten,
    /// The run ends.
    End,
}

/// Chooses the solver steps of one step of the model.
#[derive(Clone, Debug)]
pub(super) struct SubstepPolicy<'a> {
    settings: &'a Settings,
    /// Longest solver step at present [s].
    longest_s: f64,
    /// Longest solver step if anything may touch [s].
    longest_contact_s: f64,
    /// Whether rope or a body may be near the whale.
    near: bool,
    /// Whether all may stay clear of skin until the end of the model's step.
    may_stay_clear: bool,
    /// Whether rope may touch rope in a step of full length.
    ropes_meet: bool,
    /// How many times steps are halved.
    halvings: u32,
    /// What the last rejection was due to.
    rejected_by: LimitedBy,
}

impl<'a> SubstepPolicy<'a> {
    /// The policy at the start of a step of the model, where rope touches rope at `rope_touches` points. A line attached to the whale
    /// uses the contact step throughout, because its momentum goes to the whale by backward Euler.
    pub fn new(
        settings: &'a Settings,
        near: bool,
        whale_is_towed: bool,
        rope_touches: usize,
    ) -> Self {
        let most_s = if rope_touches > FEW_ROPE_TOUCHES { ROPES_STEP_S } else { f64::INFINITY };
        let longest_contact_s = settings.contact_step_s.min(settings.step_s).min(most_s);
        Self {
            settings,
            longest_s: if near { longest_contact_s } else { settings.step_s },
            longest_contact_s,
            near,
            may_stay_clear: near && !whale_is_towed,
            ropes_meet: false,
            halvings: 0,
            rejected_by: LimitedBy::Convergence,
        }
    }

    /// The next solver step, with `left_s` to the end of the model's step. `stays_clear` is called only if its answer matters.
    pub fn next(
        &mut self,
        control: &StepControl,
        left_s: f64,
        stays_clear: impl FnOnce() -> bool,
    ) -> Substep {
        debug_assert!(left_s > 0.0, "{left_s} s left");
        self.may_stay_clear = self.may_stay_clear && stays_clear();
        let clear = self.may_stay_clear;
        let longest_s = if clear { self.settings.step_s } else { self.longest_s };
        let (mut chosen_s, limit) = self.wanted(control, longest_s);
        let by_contact = (self.near && !clear) || self.ropes_meet;
        if by_contact {
            chosen_s = chosen_s.min(self.contact_step(control));
        }
        let wanted_s = chosen_s / f64::from(1_u32 << self.halvings.min(30));
        let length_s = left_s / (left_s / wanted_s - 1e-9).ceil().max(1.0);
        let is_halved = self.halvings > 0;
        let limit = if is_halved { self.rejected_by } else { limit };
        Substep { length_s, limit, is_halved, by_contact }
    }

    /// Updates the policy by an accepted step.
    pub fn accepted(
        &mut self,
        substep: &Substep,
        dt: f64,
        kind: StepKind,
        control: &mut StepControl,
    ) {
        if let (true, StepKind::InContact { missed, passes }) = (substep.by_contact, kind) {
            let step_s = self.contact_step(control);
            let may_grow = passes == 1 || missed < LITTLE_MISSED;
            control.contact_step_s = if may_grow { step_s.max(GROWTH * dt) } else { step_s };
        }
        self.halvings = self.halvings.saturating_sub(1);
    }

    /// Updates the policy by a rejected step; `on_ropes` says whether rope may touch rope in it.
    pub fn rejected(
        &mut self,
        why: &Rejection,
        dt: f64,
        on_ropes: bool,
        control: &mut StepControl,
    ) -> AfterRejection {
        if *why == Rejection::RopesMeet {
            self.may_stay_clear = false;
            self.limit_by_ropes();
            return AfterRejection::LimitByContact;
        }
        if !why.may_halve() || 0.5 * dt < self.settings.least_step_s {
            return AfterRejection::End;
        }
        let parts_late = *why == Rejection::PartsTooLate;
        self.rejected_by = if parts_late { LimitedBy::Parting } else { LimitedBy::Convergence };
        self.may_stay_clear = false;
        if on_ropes {
            // Rope that rests on rope did not bear a long step.
            self.limit_by_ropes();
        }
        if (self.near || self.ropes_meet) && !parts_late && dt > LEAST_CHOSEN_S {
            control.contact_step_s = 0.5 * dt;
        } else {
            self.halvings += 1;
        }
        AfterRejection::Shorten
    }

    fn limit_by_ropes(&mut self) {
        self.ropes_meet = true;
        self.longest_s = self.longest_contact_s;
    }

    /// The contact step, which adapts to the error of Newton.
    fn contact_step(&self, control: &StepControl) -> f64 {
        let chosen_s = control.contact_step_s;
        if chosen_s > 0.0 { chosen_s.min(self.longest_contact_s) } else { self.longest_contact_s }
    }

    /// The longest solver step to try, and what limits it.
    fn wanted(&self, control: &StepControl, longest_s: f64) -> (f64, LimitedBy) {
        let is_shorter = control.step_s > 0.0 && control.step_s < longest_s;
        if is_shorter || (control.in_two_stages() && control.step_s <= longest_s) {
            (control.step_s, control.limit)
        } else if longest_s < self.settings.step_s {
            (longest_s, LimitedBy::Contact)
        } else {
            (longest_s, LimitedBy::Inputs)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP_S: f64 = 0.01;
    const CONTACT_S: f64 = 0.002;

    fn settings() -> Settings {
        Settings {
            step_s: STEP_S,
            contact_step_s: CONTACT_S,
            least_step_s: 1e-5,
            ..Settings::default()
        }
    }

    /// What happens to a step that is tried.
    #[derive(Clone)]
    enum Then {
        Free,
        InContact(f64),
        InContactAtOnce,
        Rejected(Rejection),
        RejectedOnRopes(Rejection),
    }
    use Then::{Free, InContact, InContactAtOnce, Rejected, RejectedOnRopes};

    /// Lengths of the steps that are tried, where `near` says whether the whale is near, and all is never clear of it.
    fn tried(near: bool, events: &[Then]) -> Vec<f64> {
        let settings = settings();
        let (mut policy, mut control) =
            (SubstepPolicy::new(&settings, near, false, 0), StepControl::default());
        let (mut left_s, mut lengths) = (STEP_S, Vec::new());
        for event in events {
            let substep = policy.next(&control, left_s, || false);
            let dt = substep.length_s;
            lengths.push(dt);
            let kind = match event {
                Free => StepKind::Free,
                InContact(missed) => StepKind::InContact { missed: *missed, passes: 2 },
                InContactAtOnce => StepKind::InContact { missed: 1.0, passes: 1 },
                Rejected(why) | RejectedOnRopes(why) => {
                    let on_ropes = matches!(event, RejectedOnRopes(_));
                    let after = policy.rejected(why, dt, on_ropes, &mut control);
                    assert_ne!(after, AfterRejection::End, "{why:?} at {dt} s");
                    continue;
                }
            };
            policy.accepted(&substep, dt, kind, &mut control);
            left_s -= dt;
        }
        lengths
    }

    #[test]
    fn lengths_follow_the_table() {
        let not = || Rejected(Rejection::NotConverged);
        for (name, near, events, expected_ms) in [
            ("free", false, vec![Free], vec![10.0]),
            ("near the whale", true, vec![InContact(1.0); 5], vec![2.0; 5]),
            (
                "free and rejected: halved, then twice as long again",
                false,
                vec![not(), not(), Free, Free],
                vec![10.0, 5.0, 2.5, 3.75],
            ),
            (
                "near and rejected: the contact step is halved and stays so",
                true,
                vec![not(), InContact(1.0), InContact(1.0)],
                vec![2.0, 1.0, 1.0],
            ),
            (
                "near with a small error: the contact step grows again by 1.4",
                true,
                vec![not(), InContact(0.1), InContact(1.0)],
                vec![2.0, 1.0, 9.0 / 7.0],
            ),
            (
                "near and solved in one iteration: the contact step grows at any error",
                true,
                vec![not(), InContactAtOnce, InContact(1.0)],
                vec![2.0, 1.0, 9.0 / 7.0],
            ),
            (
                "a late parting is halved for itself, also near the whale",
                true,
                vec![Rejected(Rejection::PartsTooLate), InContact(1.0), InContact(1.0)],
                vec![2.0, 1.0, 1.8],
            ),
            (
                "rope meets rope: the contact step",
                false,
                vec![Rejected(Rejection::RopesMeet), InContact(1.0), InContact(1.0)],
                vec![10.0, 2.0, 2.0],
            ),
            (
                "rope that rested on rope is rejected in a long step",
                false,
                vec![RejectedOnRopes(Rejection::NotConverged), InContact(1.0)],
                vec![10.0, 2.0],
            ),
        ] {
            let lengths = tried(near, &events);
            let apart = lengths.iter().zip(&expected_ms).map(|(s, ms)| (s - 1e-3 * ms).abs());
            assert!(
                lengths.len() == expected_ms.len() && apart.fold(0.0, f64::max) < 1e-9,
                "{name}: {lengths:?} s, not {expected_ms:?} ms"
            );
        }
    }

    #[test]
    fn what_stays_clear_of_the_whale_takes_one_long_step() {
        let (settings, control) = (settings(), StepControl::default());
        let mut policy = SubstepPolicy::new(&settings, true, false, 0);
        let substep = policy.next(&control, STEP_S, || true);
        assert!(substep.length_s == STEP_S && !substep.by_contact);
        let mut towed = SubstepPolicy::new(&settings, true, true, 0);
        let substep = towed.next(&control, STEP_S, || panic!("a towed whale is not asked"));
        assert!(substep.length_s == CONTACT_S && substep.by_contact);
    }

    #[test]
    fn rope_that_touches_rope_at_many_points_takes_short_steps() {
        let settings = Settings { contact_step_s: 0.005, ..settings() };
        for (touches, step_s) in [(FEW_ROPE_TOUCHES, 0.005), (FEW_ROPE_TOUCHES + 1, ROPES_STEP_S)] {
            let mut policy = SubstepPolicy::new(&settings, true, false, touches);
            let substep = policy.next(&StepControl::default(), STEP_S, || false);
            assert!((substep.length_s - step_s).abs() < 1e-9, "{touches}: {} s", substep.length_s);
        }
    }

    #[test]
    fn a_run_ends_at_the_shortest_step_and_where_no_shorter_step_helps() {
        let (settings, mut control) = (settings(), StepControl::default());
        let mut policy = SubstepPolicy::new(&settings, false, false, 0);
        let shortest_s = 1.9 * settings.least_step_s;
        let end = policy.rejected(&Rejection::NotConverged, shortest_s, false, &mut control);
        assert_eq!(end, AfterRejection::End);
    }
}

//! A run is valid up to each bound and not beyond.

use super::*;
use crate::figures::tests::made_up;

/// A run of ten thousand solver steps, half of them in touch.
fn long() -> Audit {
    Audit { solver_steps: 10_000, touching_steps: 5_000, ..Audit::default() }
}

#[test]
fn a_crossing_makes_a_run_invalid() {
    let crossed = reasons(None, &Audit { tunnelled: 2, ..long() }, None);
    assert_eq!(crossed, ["rope passed through skin 2 times"]);
    let audit = Audit { non_finite: 1, tunnelled: 1, ropes_crossed: 1, ..long() };
    assert_eq!(reasons(Some("line parted badly"), &audit, None).len(), 4);
    assert!(reasons(None, &long(), None).is_empty());
}

#[test]
fn steps_that_did_not_converge_are_bounded_as_a_share_of_those_in_touch() {
    let with = |unconverged| reasons(None, &Audit { unconverged, ..long() }, None);
    assert!(with(50).is_empty(), "1 %");
    assert_eq!(
        with(75),
        ["1.5 % of the solver steps in touch did not converge; at most 1.0 % may"]
    );
    let short = |unconverged| {
        let audit = Audit { solver_steps: 20, touching_steps: 20, unconverged, ..Audit::default() };
        reasons(None, &audit, None)
    };
    assert!(short(ALWAYS_ALLOWED).is_empty() && short(ALWAYS_ALLOWED + 1).len() == 1);
}

#[test]
fn spikes_are_bounded_as_a_share_of_all_steps_and_a_parting_must_have_converged() {
    let with = |spikes| reasons(None, &Audit { spikes, ..long() }, None);
    assert!(with(10).is_empty(), "0.1 %");
    assert_eq!(
        with(40),
        ["tension stood alone in time in 0.4 % of the solver steps; at most 0.1 % may"]
    );
    let parted = reasons(None, &Audit { unconverged_parted: 1, ..long() }, None);
    assert_eq!(parted, ["something parted once in a solver step that did not converge"]);
}

#[test]
fn normal_force_beyond_what_rope_can_press_is_bounded() {
    let mut whale = made_up::report().summary.whale.unwrap();
    whale.beyond_rope_share = MOST_BEYOND_ROPE;
    assert!(reasons(None, &long(), Some(&whale)).is_empty());
    whale.beyond_rope_share = 0.25;
    let why = reasons(None, &long(), Some(&whale));
    assert!(why.len() == 1 && why[0].starts_with("25 % of the normal force"), "{why:?}");
}

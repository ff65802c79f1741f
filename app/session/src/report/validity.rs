//! Whether the numbers of a run can be trusted, and why not.

use endline_sim::Audit;
use endline_sim::metrics::WhaleSummary;

/// Greatest share of the solver steps in touch that may be accepted above the wanted residual.
pub const MOST_UNCONVERGED: f64 = 0.01;
/// Greatest share of the solver steps that may have an isolated tension spike.
pub const MOST_SPIKES: f64 = 0.001;
/// Number of either that is allowed in any run, however short.
pub const ALWAYS_ALLOWED: u64 = 3;
/// Greatest share of the normal force on the whale, over time, that may exceed the force that rope can exert.
pub const MOST_BEYOND_ROPE: f64 = 0.05;

/// The reasons why a run is invalid; empty where it is valid.
pub fn reasons(stopped: Option<&str>, audit: &Audit, whale: Option<&WhaleSummary>) -> Vec<String> {
    let times = |count: u64| if count == 1 { "once".to_owned() } else { format!("{count} times") };
    let counted = |count: u64, what: &str| (count > 0).then(|| format!("{what} {}", times(count)));
    let parted = counted(audit.unconverged_parted, "something parted");
    [
        stopped.map(|why| format!("it did not run to its end: {why}")),
        counted(audit.tunnelled, "rope passed through skin"),
        counted(audit.bodies_crossed, "a body passed through skin"),
        counted(audit.ropes_crossed, "rope passed through rope"),
        counted(audit.non_finite, "numbers were not finite"),
        unconverged(audit),
        parted.map(|parted| parted + " in a solver step that did not converge"),
        spikes(audit),
        pressed(whale),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Whether a count passes its share of all, and with it the share.
fn too_many(count: u64, all: u64, most: f64) -> Option<f64> {
    let share = count as f64 / all.max(1) as f64;
    (count > ALWAYS_ALLOWED && share > most).then_some(share)
}

fn unconverged(audit: &Audit) -> Option<String> {
    let share = too_many(audit.unconverged, audit.touching_steps, MOST_UNCONVERGED)?;
    Some(format!(
        "{} % of the solver steps in touch did not converge; at most {} % may",
        percent(share),
        percent(MOST_UNCONVERGED)
    ))
}

fn spikes(audit: &Audit) -> Option<String> {
    let share = too_many(audit.spikes, audit.solver_steps, MOST_SPIKES)?;
    Some(format!(
        "tension had isolated spikes in {} % of the solver steps; at most {} % may",
        percent(share),
        percent(MOST_SPIKES)
    ))
}

fn pressed(whale: Option<&WhaleSummary>) -> Option<String> {
    let share = whale?.beyond_rope_share;
    (share > MOST_BEYOND_ROPE).then(|| {
        format!(
            "{} % of the normal force on the whale exceeds the force that rope can exert; at most {} % may be",
            percent(share),
            percent(MOST_BEYOND_ROPE)
        )
    })
}

/// A share in per cent, to two digits where it is small.
pub(super) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    format!("{percent:.*}", usize::from(percent < 9.95))
}

#[cfg(test)]
mod tests {
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
            let audit =
                Audit { solver_steps: 20, touching_steps: 20, unconverged, ..Audit::default() };
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
            ["tension had isolated spikes in 0.4 % of the solver steps; at most 0.1 % may"]
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
}

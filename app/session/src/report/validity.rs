//! Whether the numbers of a run can be trusted, and why not.

use endline_sim::Audit;

/// What makes a run invalid, one reason each, in plain words; none where it is valid.
pub(super) fn reasons(stopped: Option<&str>, audit: &Audit) -> Vec<String> {
    let times = |count: u64| if count == 1 { "once".to_owned() } else { format!("{count} times") };
    let stopped = stopped.map(|why| format!("it did not run to its end: {why}"));
    let crossed = (audit.tunnelled > 0)
        .then(|| format!("rope passed through skin {}", times(audit.tunnelled)));
    let broken = (audit.non_finite > 0)
        .then(|| format!("numbers were not finite {}", times(audit.non_finite)));
    let through = (audit.ropes_crossed > 0)
        .then(|| format!("rope passed through rope {}", times(audit.ropes_crossed)));
    [stopped, crossed, through, broken].into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crossing_makes_a_run_invalid_and_convergence_does_not() {
        assert!(reasons(None, &Audit { unconverged: 3, ..Audit::default() }).is_empty());
        let crossed = reasons(None, &Audit { tunnelled: 2, ..Audit::default() });
        assert_eq!(crossed, ["rope passed through skin 2 times"]);
        assert_eq!(
            reasons(
                Some("line parted badly"),
                &Audit { non_finite: 1, tunnelled: 1, ropes_crossed: 1, ..Audit::default() }
            )
            .len(),
            4
        );
    }
}

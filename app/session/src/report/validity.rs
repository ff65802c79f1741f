//! Whether the numbers of a run can be trusted, and why not.

use endline_sim::Audit;
use endline_sim::metrics::WhaleSummary;

/// Greatest share of the solver steps in touch that may be accepted above the wanted residual.
pub const MOST_UNCONVERGED: f64 = 0.01;
/// Greatest share of the solver steps that may have a tension that stands alone in time.
pub const MOST_SPIKES: f64 = 0.001;
/// So many of either are allowed in any run, however short.
pub const ALWAYS_ALLOWED: u64 = 3;
/// Greatest share of the normal force on the whale, over time, that may be beyond what rope can press.
pub const MOST_BEYOND_ROPE: f64 = 0.05;

/// What makes a run invalid, one reason each, in plain words; none where it is valid.
#[must_use]
pub fn reasons(stopped: Option<&str>, audit: &Audit, whale: Option<&WhaleSummary>) -> Vec<String> {
    let times = |count: u64| if count == 1 { "once".to_owned() } else { format!("{count} times") };
    let stopped = stopped.map(|why| format!("it did not run to its end: {why}"));
    let crossed = (audit.tunnelled > 0)
        .then(|| format!("rope passed through skin {}", times(audit.tunnelled)));
    let broken = (audit.non_finite > 0)
        .then(|| format!("numbers were not finite {}", times(audit.non_finite)));
    let body = (audit.bodies_crossed > 0)
        .then(|| format!("a body passed through skin {}", times(audit.bodies_crossed)));
    let through = (audit.ropes_crossed > 0)
        .then(|| format!("rope passed through rope {}", times(audit.ropes_crossed)));
    let parted = (audit.unconverged_parted > 0).then(|| {
        format!(
            "something parted {} in a solver step that did not converge",
            times(audit.unconverged_parted)
        )
    });
    [
        stopped,
        crossed,
        body,
        through,
        broken,
        unconverged(audit),
        parted,
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
        "tension stood alone in time in {} % of the solver steps; at most {} % may",
        percent(share),
        percent(MOST_SPIKES)
    ))
}

fn pressed(whale: Option<&WhaleSummary>) -> Option<String> {
    let share = whale?.beyond_rope_share;
    (share > MOST_BEYOND_ROPE).then(|| {
        format!(
            "{} % of the normal force on the whale is beyond what rope can press; at most {} % may be",
            percent(share),
            percent(MOST_BEYOND_ROPE)
        )
    })
}

/// A share in per cent, to two digits where it is small.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    format!("{percent:.*}", usize::from(percent < 9.95))
}

#[cfg(test)]
#[path = "validity_tests.rs"]
mod tests;

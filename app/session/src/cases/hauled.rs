//! A case in which the gear of its scenario is hauled: the pull at the hauler, read by the scenario's one probe.

use endline_gear::{Case, CaseHaul, Diagnostic};
use endline_sim::haul::{Haul, HaulEvent, Hauling, endlines};
use endline_sim::model::BodyRole;
use endline_sim::{Model, settle};

use crate::error::Error;
use crate::haul::HaulRequest;

use super::observed::Observed;

/// Refuses a case whose scenario has no endline to haul, or more to read than the pull at the hauler.
pub(super) fn check(case: &Case, model: &Model) -> Result<(), Error> {
    if case.haul.is_none() {
        return Ok(());
    }
    let (message, help) = if endlines(model).is_empty() {
        (
            "[haul], but no endline from a buoy",
            "name a scenario with gear that has a buoy at the surface",
        )
    } else if model.spec.probes.len() != 1 {
        (
            "[haul] reads the pull at the hauler alone",
            "leave one probe in the scenario, the tension at the buoy",
        )
    } else {
        return Ok(());
    };
    Err(Error::Diagnostics(vec![Diagnostic::of_file(
        case.place.source.path.clone(),
        message,
        help,
    )]))
}

/// Hauls the gear; the greatest pull at the hauler since the last sample, at each. The reason where it does not get to its end.
pub(super) fn observe(model: &Model, haul: &CaseHaul, between_s: f64) -> Result<Observed, String> {
    let settled = settle(model);
    let from = *endlines(model).first().ok_or("no endline to haul")?;
    let mut up = Haul::begin(model, &settled.state, from, how(haul))?;
    let mut observed = Observed { samples: vec![Vec::new()], ..Observed::default() };
    let is_trap = |body: usize| model.spec.bodies[body].role == BodyRole::Trap;
    let traps = (0..model.spec.bodies.len()).filter(|body| is_trap(*body)).count() as u64;
    let (mut aboard, mut greatest_n) = (0, 0.0_f64);
    while aboard < haul.aboard.unwrap_or(traps) {
        let goes_on = up.advance().map_err(|stop| Error::Stopped(stop).to_string())?;
        let traps = |came: &&HaulEvent| matches!(came, HaulEvent::Aboard(body) if is_trap(*body));
        aboard += up.last_step().events.iter().filter(traps).count() as u64;
        greatest_n = greatest_n.max(up.last_step().load_n);
        let time_s = up.state().time_s;
        if observed.times_s.last().is_none_or(|last| time_s >= last + between_s - 1e-9) {
            observed.times_s.push(time_s);
            observed.samples[0].push(std::mem::take(&mut greatest_n));
        }
        if !goes_on {
            break;
        }
    }
    observed.trace = (observed.times_s.clone(), observed.samples.clone());
    Ok(observed)
}

fn how(haul: &CaseHaul) -> Hauling {
    let usual = HaulRequest::default().how;
    Hauling {
        speed_m_s: haul.speed_m_s.unwrap_or(usual.speed_m_s),
        block_m: haul.block_m.unwrap_or(usual.block_m),
        ..usual
    }
}

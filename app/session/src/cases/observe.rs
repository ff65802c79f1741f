//! A run read at the times a case asks for.

use endline_gear::{Case, Samples, Table};
use endline_sim::Model;
use endline_sim::metrics::reading;

use crate::error::Error;
use crate::run::{Run, RunOptions};

use super::hauled;
use super::observed::Observed;
use super::setup::Setup;

/// Points of a curve in a plot.
const TRACE_POINTS: f64 = 400.0;

/// Runs a case at a share of its step and segments; the reason where it does not get to its end.
pub(super) fn observe(
    setup: &Setup,
    case: &Case,
    table: Option<&Table>,
    share: [u32; 2],
) -> Result<Result<Observed, String>, Error> {
    let prepared = setup.finer(share)?;
    if let (Some(haul), Samples::Every(between_s)) = (&case.haul, &case.samples) {
        return Ok(hauled::observe(&prepared.model, haul, *between_s));
    }
    let times = times(case, table, &prepared.model)?;
    let mut run = match Run::new(prepared, RunOptions::default()) {
        Ok(run) => run,
        Err(error @ Error::Unsettled { .. }) => return Ok(Err(error.to_string())),
        Err(error) => return Err(error),
    };
    let Some(times) = times else {
        let mut observed = Observed::default();
        observed.take(&run, 0.0);
        return Ok(Ok(observed));
    };
    let mut observed = Observed::default();
    let between = run.model().spec.settings.duration_s / TRACE_POINTS;
    for time in times {
        while run.state().time_s < time - 1e-9 {
            observed.follow(&run, between);
            if let Err(stop) = run.step(run.pilot()) {
                return Ok(Err(Error::Stopped(stop).to_string()));
            }
        }
        observed.follow(&run, between);
        observed.take(&run, time);
    }
    Ok(Ok(observed))
}

/// When samples are taken [s]; `None` for once at rest.
fn times(case: &Case, table: Option<&Table>, model: &Model) -> Result<Option<Vec<f64>>, Error> {
    match (&case.samples, table) {
        (Samples::Every(between_s), _) => {
            let count = (model.spec.settings.duration_s / between_s + 1e-9).floor();
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a positive whole number"
            )]
            let times = (0..=count as u64).map(|index| index as f64 * between_s);
            Ok(Some(times.collect()))
        }
        (Samples::Table, Some(table)) => table.column("t").map(Some).map_err(Error::from),
        _ => Ok(None),
    }
}

impl Observed {
    fn take(&mut self, run: &Run, time_s: f64) {
        self.times_s.push(time_s);
        read_all(run, &mut self.samples);
    }

    /// Keeps a point for the plot, where it is time for one.
    fn follow(&mut self, run: &Run, between_s: f64) {
        let now = run.state().time_s;
        if self.trace.0.last().is_none_or(|last| now - last >= between_s - 1e-12) {
            self.trace.0.push(now);
            read_all(run, &mut self.trace.1);
        }
    }
}

fn read_all(run: &Run, into: &mut Vec<Vec<f64>>) {
    let model = run.model();
    into.resize(model.spec.probes.len(), Vec::new());
    for (readings, probe) in into.iter_mut().zip(&model.spec.probes) {
        readings.push(reading(model, run.state(), probe.target));
    }
}

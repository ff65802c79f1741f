//! From runs to readings, and from readings to verdicts.

use endline_gear::{At, Case, Check, Diagnostic, Measure, Samples, Table};
use endline_sim::Model;
use endline_sim::metrics::reading;

use super::outcome::{Convergence, Observed, Outcome, Verdict, error_of};
use super::rows::{Reference, begin, of_table, probes};
use super::setup::Setup;
use super::{Finer, rows, setup};
use crate::error::Error;
use crate::run::{Run, RunOptions};

/// Readings nearer than this share of their size are the same: they show no order of convergence.
const SAME: f64 = 1e-10;

/// Refuses a case that names a probe its scenario does not have, or a column its table does not have.
pub(super) fn check_names(case: &Case, model: &Model, table: Option<&Table>) -> Result<(), Error> {
    let mut problems = Vec::new();
    for check in &case.checks {
        for name in probes(&check.measure) {
            if !model.spec.probes.iter().any(|probe| probe.id == name.value) {
                problems.push(rows::no_probe(name, model));
            }
            if let (true, Some(table)) = (of_table(&check.measure), table) {
                problems.extend(table.column(&name.value).err().map(|problem| *problem));
            }
        }
        let fits = match (&check.measure, &case.samples) {
            (Measure::Sums | Measure::Slope(..) | Measure::Fall { .. }, _)
            | (Measure::Rate { .. }, Samples::Rest) => false,
            (measure, Samples::Table) => !matches!(measure, Measure::Gain(..) | Measure::Loss(..)),
            (measure, _) => !of_table(measure),
        };
        if !fits {
            let message = format!("`{}` cannot be measured of what this case samples", check.name);
            let help = "distance, series and peak need at = \"table\"; rate needs times; sums, slope and fall need [rows]";
            problems.push(Diagnostic::of_file(case.place.source.path.clone(), message, help));
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(Error::Diagnostics(problems)) }
}

/// The verdicts of a case, with the orders of convergence.
pub(super) fn outcome(
    case: &Case,
    setup: &Setup,
    table: Option<&Table>,
    base: &Observed,
    finer: &Finer,
) -> Result<Outcome, Error> {
    let reference = Reference { model: &setup.model, table };
    let mut verdicts = Vec::new();
    for check in &case.checks {
        let measured = reference.measure(check, base)?;
        let mut verdict = Verdict::new(
            check.name.clone(),
            measured.unit,
            measured.expected,
            measured.got,
            check.limit,
        );
        verdict.step = reference.convergence(check, base, finer.step.as_ref())?;
        verdict.segment = reference.convergence(check, base, finer.segment.as_ref())?;
        verdicts.push(verdict);
    }
    let curves = rows::of(&reference, case, base)?;
    Ok(Outcome { curves, ..Outcome::begin(case, setup) }.judged(verdicts))
}

/// A measure taken.
struct Measured {
    unit: &'static str,
    expected: f64,
    got: f64,
    /// The readings behind it, for the order of convergence.
    readings: Vec<f64>,
}

impl Reference<'_> {
    fn measure(&self, check: &Check, observed: &Observed) -> Result<Measured, Error> {
        let readings = |name: &At<String>| &observed.samples[self.probe(&name.value)];
        let scalar = |unit, expected, got| Measured { unit, expected, got, readings: vec![got] };
        Ok(match &check.measure {
            Measure::Distance(points) => {
                let flat: Vec<&At<String>> = points.iter().flatten().collect();
                let (off, _, all) = self.squares(&flat, observed)?;
                let count = (points.len() * observed.times_s.len()) as f64;
                Measured { unit: "m", expected: 0.0, got: (off / count).sqrt(), readings: all }
            }
            Measure::Series(probes) => {
                let (off, size, all) =
                    self.squares(&probes.iter().collect::<Vec<_>>(), observed)?;
                Measured { unit: "", expected: 0.0, got: (off / size).sqrt(), readings: all }
            }
            Measure::Peak(of) => scalar(
                self.unit(&of.value),
                greatest(&self.column(&of.value)?),
                greatest(readings(of)),
            ),
            Measure::Value(of, expected) => {
                scalar(self.unit(&of.value), *expected, last(readings(of)))
            }
            Measure::Mean { of, from_s, over, expected } => {
                let unit = if (over - 1.0).abs() > 0.0 { "" } else { self.unit(&of.value) };
                scalar(unit, *expected, mean(&observed.times_s, readings(of), *from_s) / over)
            }
            Measure::Ratio { of, over, from_s, expected } => {
                let [one, other] =
                    [of, over].map(|probe| mean(&observed.times_s, readings(probe), *from_s));
                scalar("", *expected, one / other)
            }
            Measure::Greatest(of, expected) => {
                scalar(self.unit(&of.value), *expected, greatest(readings(of)))
            }
            Measure::First(of, expected) => {
                let begins = readings(of).iter().position(|reading| *reading > 0.0);
                let at_s = begins.and_then(|sample| observed.times_s.get(sample));
                scalar("s", *expected, at_s.copied().unwrap_or(f64::INFINITY))
            }
            Measure::Rate { of, from_s, expected } => scalar(
                by_second(self.unit(&of.value)),
                *expected,
                rate(&observed.times_s, readings(of), *from_s),
            ),
            Measure::Gain(of, over) => scalar(
                "",
                0.0,
                (greatest(readings(of)) - first(readings(of))) / greatest(readings(over)),
            ),
            Measure::Loss(of, over) => {
                let lost = (first(readings(of)) - last(readings(of))) / greatest(readings(over));
                scalar("", 0.0, lost.max(0.0))
            }
            Measure::Sums | Measure::Slope(..) | Measure::Fall { .. } => scalar("", 0.0, f64::NAN),
        })
    }

    /// Sum of the squared differences from the table, that of the table's squares, and all readings.
    fn squares(
        &self,
        probes: &[&At<String>],
        observed: &Observed,
    ) -> Result<(f64, f64, Vec<f64>), Error> {
        let (mut off, mut size, mut all) = (0.0, 0.0, Vec::new());
        for name in probes {
            let readings = &observed.samples[self.probe(&name.value)];
            for (reading, expected) in readings.iter().zip(self.column(&name.value)?) {
                off += (reading - expected) * (reading - expected);
                size += expected * expected;
            }
            all.extend(readings);
        }
        Ok((off, size, all))
    }

    fn convergence(
        &self,
        check: &Check,
        base: &Observed,
        finer: Option<&[Observed; 2]>,
    ) -> Result<Option<Convergence>, Error> {
        let Some([half, quarter]) = finer else { return Ok(None) };
        let [whole, half, quarter] =
            [self.measure(check, base)?, self.measure(check, half)?, self.measure(check, quarter)?];
        let order = order(&whole.readings, &half.readings, &quarter.readings);
        Ok(Some(Convergence {
            error_at_half: error_of(half.expected, half.got, check.limit),
            order,
        }))
    }
}

/// Order of convergence from readings at whole, half and quarter; `None` where they do not differ.
fn order(whole: &[f64], half: &[f64], quarter: &[f64]) -> Option<f64> {
    let apart = |one: &[f64], other: &[f64]| {
        one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    let size = quarter.iter().map(|reading| reading * reading).sum::<f64>().sqrt();
    let (coarse, fine) = (apart(whole, half), apart(half, quarter));
    (coarse > SAME * size && fine > SAME * size).then(|| (coarse / fine).log2())
}

fn greatest(readings: &[f64]) -> f64 {
    readings.iter().copied().fold(f64::MIN, f64::max)
}

fn first(readings: &[f64]) -> f64 {
    readings.first().copied().unwrap_or(f64::NAN)
}

fn last(readings: &[f64]) -> f64 {
    readings.last().copied().unwrap_or(f64::NAN)
}

/// Mean of the samples from a time on; not a number where there is none.
fn mean(times_s: &[f64], readings: &[f64], from_s: f64) -> f64 {
    let late = readings.get(begin(times_s, from_s)..).unwrap_or_default();
    late.iter().sum::<f64>() / late.len() as f64
}

/// Change over time from the first sample at or after a time to the last; not a number where there are not two.
fn rate(times_s: &[f64], readings: &[f64], from_s: f64) -> f64 {
    let begin = begin(times_s, from_s);
    let (times_s, readings) =
        (times_s.get(begin..).unwrap_or_default(), readings.get(begin..).unwrap_or_default());
    (last(readings) - first(readings)) / (last(times_s) - first(times_s))
}

/// Unit of a rate.
fn by_second(unit: &str) -> &'static str {
    match unit {
        "m" => "m/s",
        "N" => "N/s",
        "J" => "W",
        _ => "1/s",
    }
}

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
        return Ok(setup::observe(&prepared.model, haul, *between_s));
    }
    let times = times(case, table, &prepared.model)?;
    let mut run = match Run::new(prepared, RunOptions::default()) {
        Ok(run) => run,
        Err(error @ Error::Unsettled { .. }) => return Ok(Err(error.to_string())),
        Err(error) => return Err(error),
    };
    let mut observed = Observed::default();
    let Some(times) = times else {
        observed.sample(&run, 0.0);
        return Ok(Ok(observed));
    };
    let between = run.model().spec.settings.duration_s / TRACE_POINTS;
    for time in times {
        while run.state().time_s < time - 1e-9 {
            observed.follow(&run, between);
            if let Err(stop) = run.step(run.pilot()) {
                return Ok(Err(Error::Stopped(stop).to_string()));
            }
        }
        observed.follow(&run, between);
        observed.sample(&run, time);
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
    fn sample(&mut self, run: &Run, time_s: f64) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_order_method_is_known_by_its_readings() {
        let at = |step: f64| vec![1.0 + 0.3 * step * step, 2.0 - 0.1 * step * step];
        let found = order(&at(0.1), &at(0.05), &at(0.025)).unwrap();
        assert!((found - 2.0).abs() < 1e-6, "{found}");
        assert_eq!(order(&at(0.1), &at(0.1), &at(0.1)), None);
    }

    #[test]
    fn a_rate_is_that_from_its_time_on() {
        let (times, readings) = ([0.0, 1.0, 2.0, 4.0], [9.0, 0.0, -1.0, -6.0]);
        assert!((rate(&times, &readings, 1.0) + 2.0).abs() < 1e-12);
        assert!(
            rate(&times, &readings, 4.0).is_nan() && rate(&times, &readings, 5.0).is_nan(),
            "one sample or none has no rate"
        );
    }
}

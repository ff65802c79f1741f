//! References of cases: tables, curves and rows of measurements, each compared with readings.

use endline_gear::{At, Case, Check, Diagnostic, Measure, Rows, Table};
use endline_sim::Model;
use endline_sim::metrics::{reading, unit};
use endline_sim::model::Probe;

use super::Cases;
use super::outcome::{Curve, Observed, Outcome, Point, Verdict, failed};
use super::setup::Setup;
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::run::{Run, RunOptions};

/// A row of measurements beside the same simulated.
struct Pair {
    row: usize,
    measured: f64,
    got: f64,
}

/// A group of rows, such as one set of gear.
struct Group {
    name: String,
    pairs: Vec<Pair>,
}

/// Settles every row and judges.
pub(super) fn run(
    cases: &Cases,
    case: &Case,
    rows: &Rows,
    table: &Table,
    host: &PluginHost,
) -> Result<Outcome, Error> {
    let mut groups = Vec::new();
    let mut last = None;
    for name in &rows.groups {
        let mut pairs = Vec::new();
        for row in rows.of_group(table, name)? {
            let setup = Setup::new(cases, case, &rows.fields(table, row)?, host)?;
            match read(&setup, rows)? {
                Ok(got) => pairs.push(Pair {
                    row,
                    measured: table.number(row, &rows.measured.value)?,
                    got,
                }),
                Err(reason) => {
                    return Ok(failed(
                        case,
                        &setup,
                        format!("{} {name}, row {}: {reason}", rows.by.value, row + 1),
                    ));
                }
            }
            last = Some(setup);
        }
        groups.push(Group { name: name.clone(), pairs });
    }
    let Some(setup) = last else {
        let help = "correct `groups`, `by` or `least`";
        return Err(rows
            .by
            .place
            .error("no row of the table belongs to these groups", help)
            .into());
    };
    let mut verdicts = Vec::new();
    for check in &case.checks {
        verdicts.extend(judge(check, &groups, rows, table, &setup)?);
    }
    let point = |group: &Group, pair: &Pair| Point {
        group: group.name.clone(),
        measured: pair.measured,
        got: pair.got,
    };
    let points = groups
        .iter()
        .flat_map(|group| group.pairs.iter().map(move |pair| point(group, pair)))
        .collect();
    Ok(Outcome { points, ..Outcome::begin(case, &setup) }.judged(verdicts))
}

/// Checks that there are rows of every group, and assembles the first of each.
pub(super) fn check(
    cases: &Cases,
    case: &Case,
    rows: &Rows,
    table: &Table,
    host: &PluginHost,
) -> Result<(), Error> {
    for name in &rows.groups {
        let Some(row) = rows.of_group(table, name)?.first().copied() else {
            let message = format!("no row of the table has {} {name}", rows.by.value);
            return Err(rows.by.place.error(message, "correct `groups`, `by` or `least`").into());
        };
        let setup = Setup::new(cases, case, &rows.fields(table, row)?, host)?;
        probe(&setup, rows)?;
        table.number(row, &rows.measured.value)?;
    }
    Ok(())
}

/// The probe that is read.
fn probe<'a>(setup: &'a Setup, rows: &Rows) -> Result<&'a Probe, Error> {
    let found = setup.model.spec.probes.iter().find(|probe| probe.id == rows.read.value);
    found.ok_or_else(|| no_probe(&rows.read, &setup.model).into())
}

/// The problem of a probe that the scenario does not have.
pub(super) fn no_probe(name: &At<String>, model: &Model) -> Diagnostic {
    let known: Vec<&str> = model.spec.probes.iter().map(|probe| probe.id.as_str()).collect();
    let help = format!("its probes are {}", known.join(", "));
    name.place.error(format!("the scenario has no probe `{}`", name.value), help)
}

/// The probe's reading of the gear at rest, or its mean late in the run; or why there is none.
fn read(setup: &Setup, rows: &Rows) -> Result<Result<f64, String>, Error> {
    let target = probe(setup, rows)?.target;
    let mut run = match Run::new(setup.prepared.clone(), RunOptions::default()) {
        Ok(run) => run,
        Err(error @ Error::Unsettled { .. }) => return Ok(Err(error.to_string())),
        Err(error) => return Err(error),
    };
    let Some(from_s) = rows.mean_from_s else {
        return Ok(Ok(reading(&setup.model, run.state(), target)));
    };
    let (mut sum, mut count) = (0.0, 0.0);
    while !run.finished() {
        if let Err(stop) = run.step(run.pilot()) {
            return Ok(Err(Error::Stopped(stop).to_string()));
        }
        if run.state().time_s >= from_s - 1e-9 {
            sum += reading(&setup.model, run.state(), target);
            count += 1.0;
        }
    }
    Ok(if count > 0.0 {
        Ok(sum / count)
    } else {
        Err(format!("the run ends before {from_s} s, where its mean begins"))
    })
}

fn judge(
    check: &Check,
    groups: &[Group],
    rows: &Rows,
    table: &Table,
    setup: &Setup,
) -> Result<Vec<Verdict>, Error> {
    let verdict =
        |name: String, unit, expected, got| Verdict::new(name, unit, expected, got, check.limit);
    match &check.measure {
        Measure::Sums => {
            let unit = unit(probe(setup, rows)?.target);
            let name = |group: &Group| format!("{}, {} {}", check.name, rows.by.value, group.name);
            let mean = |group: &Group| {
                verdict(
                    name(group),
                    unit,
                    mean(group, |pair| pair.measured),
                    mean(group, |pair| pair.got),
                )
            };
            Ok(groups.iter().map(mean).collect())
        }
        Measure::Slope(over, expected) => {
            let at = |group: &Group| match group.pairs.first() {
                Some(pair) => table.number(pair.row, &over.value).map_err(Error::from),
                None => Ok(f64::NAN),
            };
            let places: Vec<f64> = groups.iter().map(at).collect::<Result<_, _>>()?;
            let means: Vec<f64> = groups.iter().map(|group| mean(group, |pair| pair.got)).collect();
            Ok(vec![verdict(check.name.clone(), "", *expected, slope(&places, &means))])
        }
        Measure::Fall { from, to, square } => {
            let squares = table.column(&square.value)?;
            let level = |name: &str, of: fn(&Pair) -> f64| {
                let group = groups.iter().find(|group| group.name == name);
                group.map_or(f64::NAN, |group| {
                    mean(group, |pair| of(pair) / (squares[pair.row] * squares[pair.row]))
                })
            };
            let fall = |of: fn(&Pair) -> f64| 1.0 - level(to, of) / level(from, of);
            Ok(vec![verdict(
                check.name.clone(),
                "",
                fall(|pair| pair.measured),
                fall(|pair| pair.got),
            )])
        }
        _ => {
            let help = "cases with [rows] measure sums, slope or fall";
            let message = format!("`{}` cannot be measured of rows", check.name);
            Err(rows.by.place.error(message, help).into())
        }
    }
}

fn mean(group: &Group, of: impl Fn(&Pair) -> f64) -> f64 {
    group.pairs.iter().map(of).sum::<f64>() / group.pairs.len() as f64
}

/// Slope of the least-squares line.
fn slope(places: &[f64], values: &[f64]) -> f64 {
    let count = places.len() as f64;
    let (middle, level) = (places.iter().sum::<f64>() / count, values.iter().sum::<f64>() / count);
    let across: f64 =
        places.iter().zip(values).map(|(place, value)| (place - middle) * (value - level)).sum();
    across / places.iter().map(|place| (place - middle) * (place - middle)).sum::<f64>()
}

/// The probes that the checks compare, over time, each once; none of gear at rest.
pub(super) fn of(
    reference: &Reference<'_>,
    case: &Case,
    base: &Observed,
) -> Result<Vec<Curve>, Error> {
    let mut curves: Vec<Curve> = Vec::new();
    if base.trace.0.is_empty() {
        return Ok(curves);
    }
    for check in &case.checks {
        for name in probes(&check.measure) {
            if curves.iter().any(|curve| curve.probe == name.value) {
                continue;
            }
            let probe = reference.probe(&name.value);
            let expected = if of_table(&check.measure) {
                base.times_s
                    .iter()
                    .zip(reference.column(&name.value)?)
                    .map(|(time, reading)| [*time, reading])
                    .collect()
            } else {
                expected(check, &base.times_s, &base.samples[probe])
            };
            curves.push(Curve {
                probe: name.value.clone(),
                unit: reference.unit(&name.value),
                times_s: base.trace.0.clone(),
                got: base.trace.1[probe].clone(),
                expected,
            });
        }
    }
    Ok(curves)
}

/// Times [s] and expected readings of a check without a table; a rate continues from the reading where it begins.
fn expected(check: &Check, times_s: &[f64], readings: &[f64]) -> Vec<[f64; 2]> {
    let Some(end_s) = times_s.last().copied() else { return Vec::new() };
    match check.measure {
        Measure::Value(_, expected) => vec![[end_s, expected]],
        Measure::Mean { from_s, over, expected, .. } => {
            vec![[from_s, over * expected], [end_s, over * expected]]
        }
        Measure::Greatest(_, expected) => {
            let peak = readings.iter().zip(times_s).max_by(|one, other| one.0.total_cmp(other.0));
            peak.map(|(_, time)| vec![[*time, expected]]).unwrap_or_default()
        }
        Measure::Rate { from_s, expected, .. } => {
            let first = begin(times_s, from_s);
            let from = times_s.get(first).zip(readings.get(first));
            from.map(|(time, reading)| {
                vec![[*time, *reading], [end_s, reading + expected * (end_s - time)]]
            })
            .unwrap_or_default()
        }
        _ => Vec::new(),
    }
}

/// The reference that readings are compared with.
pub(super) struct Reference<'a> {
    /// The model that is run.
    pub model: &'a Model,
    /// The published table, where the case has one.
    pub table: Option<&'a Table>,
}

impl Reference<'_> {
    /// Index of a probe in the model.
    pub fn probe(&self, name: &str) -> usize {
        // Names were checked before the run.
        self.model.spec.probes.iter().position(|probe| probe.id == name).unwrap_or_default()
    }

    /// Unit of a probe.
    pub fn unit(&self, name: &str) -> &'static str {
        self.model.spec.probes.get(self.probe(name)).map_or("", |probe| unit(probe.target))
    }

    /// A column of the table; empty without one.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, Error> {
        self.table.map_or(Ok(Vec::new()), |table| table.column(name).map_err(Error::from))
    }
}

/// The probes a measure reads.
pub(super) fn probes(measure: &Measure) -> Vec<&At<String>> {
    match measure {
        Measure::Distance(points) => points.iter().flatten().collect(),
        Measure::Series(probes) => probes.iter().collect(),
        Measure::Peak(of)
        | Measure::Value(of, _)
        | Measure::Greatest(of, _)
        | Measure::First(of, _)
        | Measure::Mean { of, .. }
        | Measure::Rate { of, .. } => {
            vec![of]
        }
        Measure::Gain(of, over) | Measure::Loss(of, over) | Measure::Ratio { of, over, .. } => {
            vec![of, over]
        }
        Measure::Sums | Measure::Slope(..) | Measure::Fall { .. } => Vec::new(),
    }
}

/// Whether a measure compares with the table's columns.
pub(super) fn of_table(measure: &Measure) -> bool {
    matches!(measure, Measure::Distance(_) | Measure::Series(_) | Measure::Peak(_))
}

/// Number of the first sample at or after a time.
pub(super) fn begin(times_s: &[f64], from_s: f64) -> usize {
    times_s.iter().position(|time| *time >= from_s - 1e-9).unwrap_or(times_s.len())
}

#[cfg(test)]
mod tests {
    use endline_gear::Limit;

    use super::*;

    #[test]
    fn the_slope_of_points_on_a_line_is_the_lines() {
        assert!((slope(&[1.0, 2.0, 5.0], &[3.5, 4.0, 5.5]) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn expected_readings_stand_where_they_are_compared() {
        let case = "format = 1\nkind = \"case\"\nname = \"x\"\nsource = \"x\"\nconfidence = \"derived\"\ngroup = \"x\"\nscenario = \"x\"\n\
                    every = \"1 s\"\n[[check]]\nname = \"a\"\nmeasure = \"rate\"\nof = \"z\"\nfrom = \"1 s\"\nexpected = \"2 m/s\"\n\
                    tolerance = 0.1\n[[check]]\nname = \"b\"\nmeasure = \"greatest\"\nof = \"z\"\nexpected = \"9 m\"\ntolerance = 0.1\n";
        let case = Case::read("x.toml", case).unwrap();
        let (times, readings) = ([0.0, 1.0, 2.0, 3.0], [5.0, 4.0, 7.0, 6.0]);
        assert_eq!(expected(&case.checks[0], &times, &readings), [[1.0, 4.0], [3.0, 8.0]]);
        assert_eq!(expected(&case.checks[1], &times, &readings), [[2.0, 9.0]]);
        assert_eq!(case.checks[0].limit, Limit::Share(0.1));
    }
}

//! A case over rows of measurements: each row's gear is settled or run, and read.

use endline_gear::{Case, Check, Measure, Rows, Table};
use endline_sim::metrics::{reading, unit};
use endline_sim::model::Probe;

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::run::{Run, RunOptions};

use super::Cases;
use super::outcome::{Outcome, Point, Verdict, failed};
use super::setup::Setup;

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
        return Err(Error::Diagnostics(vec![
            rows.by.place.error("no row of the table belongs to these groups", help),
        ]));
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
            return Err(Error::Diagnostics(vec![
                rows.by.place.error(message, "correct `groups`, `by` or `least`"),
            ]));
        };
        let setup = Setup::new(cases, case, &rows.fields(table, row)?, host)?;
        probe(&setup, rows)?;
        table.number(row, &rows.measured.value)?;
    }
    Ok(())
}

/// The probe that is read.
fn probe<'a>(setup: &'a Setup, rows: &Rows) -> Result<&'a Probe, Error> {
    setup.model.spec.probes.iter().find(|probe| probe.id == rows.read.value).ok_or_else(|| {
        let known: Vec<&str> =
            setup.model.spec.probes.iter().map(|probe| probe.id.as_str()).collect();
        let help = format!("its probes are {}", known.join(", "));
        Error::Diagnostics(vec![
            rows.read.place.error(format!("the scenario has no probe `{}`", rows.read.value), help),
        ])
    })
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
            Err(Error::Diagnostics(vec![rows.by.place.error(message, help)]))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_points_on_a_line_is_the_lines() {
        assert!((slope(&[1.0, 2.0, 5.0], &[3.5, 4.0, 5.5]) - 0.5).abs() < 1e-12);
    }
}

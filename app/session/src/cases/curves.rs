//! Readings over time beside what they should be, for a plot.

use endline_gear::{Case, Check, Measure};

use crate::error::Error;

use super::observed::Observed;
use super::outcome::Curve;
use super::reference::{Reference, begin, of_table, probes};

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

/// Where a check without a table says what is expected: times [s] and readings; a rate goes on from the reading where it begins.
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

#[cfg(test)]
mod tests {
    use endline_gear::Limit;

    use super::*;

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

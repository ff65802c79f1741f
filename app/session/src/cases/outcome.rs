//! Observed readings and the outcome of a case, for a table, a plot, words and JSON (schema `endline.validate/1`).

use endline_gear::{Case, Limit};
use schemars::JsonSchema;
use serde::Serialize;

use super::setup::Setup;

/// The outcome of a case.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Outcome {
    /// Id.
    pub id: String,
    /// Name.
    pub name: String,
    /// Remarks; may be empty.
    pub notes: String,
    /// Heading it stands under.
    pub group: String,
    /// Id of its scenario.
    pub scenario: String,
    /// Where the expected values come from.
    pub source: String,
    /// How well they are known: `measured`, `derived` or `estimate`. The schema calls it `sureness`.
    #[serde(rename = "sureness")]
    pub confidence: &'static str,
    /// Step between inputs [s].
    pub step_s: f64,
    /// Rope segments.
    pub segments: usize,
    /// Whether all verdicts are good and nothing stopped it.
    pub passed: bool,
    /// Why there are no verdicts: the run stopped, or statics found no rest.
    pub stopped: Option<String>,
    /// One for each comparison.
    pub verdicts: Vec<Verdict>,
    /// Readings over time, where it is a run.
    pub curves: Vec<Curve>,
    /// Measured and simulated, where it compares rows of measurements.
    pub points: Vec<Point>,
}

/// A comparison.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Verdict {
    /// The quantity compared.
    pub name: String,
    /// Unit of `expected` and `got`: `m`, `N`, `J`, one of these by second, or empty for a pure number.
    pub unit: &'static str,
    /// Expected value; 0 where `got` is itself a difference.
    pub expected: f64,
    /// Observed value.
    pub got: f64,
    /// The error: a share where `limit` is one, else in `unit`; the distance outside the limits where there are two.
    pub error: f64,
    /// How far off it may be.
    pub limit: f64,
    /// The two values it must lie between, where that is asked; `limit` is then 0.
    pub between: Option<[f64; 2]>,
    /// Whether `error` and `limit` are shares.
    pub share: bool,
    /// Whether it is within its limit.
    pub passed: bool,
    /// With the step halved.
    pub step: Option<Convergence>,
    /// With the segments halved.
    pub segment: Option<Convergence>,
}

/// What halving changes.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
pub struct Convergence {
    /// Error at half.
    pub error_at_half: f64,
    /// Order of convergence from whole, half and quarter; `null` where the readings do not differ.
    pub order: Option<f64>,
}

/// A probe over time, beside its expected value.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Curve {
    /// Id of the probe.
    pub probe: String,
    /// Unit of the readings.
    pub unit: &'static str,
    /// Times [s].
    pub times_s: Vec<f64>,
    /// Readings.
    pub got: Vec<f64>,
    /// Time [s] and expected reading, where it is known.
    pub expected: Vec<[f64; 2]>,
}

/// A measurement, and the same simulated.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Point {
    /// Group it belongs to.
    pub group: String,
    /// Measured.
    pub measured: f64,
    /// Simulated.
    pub got: f64,
}

impl Outcome {
    /// An outcome without verdicts yet.
    pub(super) fn begin(case: &Case, setup: &Setup) -> Self {
        Self {
            id: case.id.clone(),
            name: case.name.clone(),
            notes: case.notes.clone(),
            group: case.group.clone(),
            scenario: case.scenario.value.clone(),
            source: case.source.clone(),
            confidence: case.confidence.word(),
            step_s: setup.model.spec.settings.step_s,
            segments: setup.model.segment_count,
            passed: false,
            stopped: None,
            verdicts: Vec::new(),
            curves: Vec::new(),
            points: Vec::new(),
        }
    }

    /// With its verdicts.
    pub(super) fn judged(mut self, verdicts: Vec<Verdict>) -> Self {
        self.passed = !verdicts.is_empty() && verdicts.iter().all(|verdict| verdict.passed);
        self.verdicts = verdicts;
        self
    }
}

/// A case that did not get to its end.
pub(super) fn failed(case: &Case, setup: &Setup, reason: String) -> Outcome {
    Outcome { stopped: Some(reason), ..Outcome::begin(case, setup) }
}

impl Verdict {
    /// Judges an observed value.
    pub(super) fn new(
        name: String,
        unit: &'static str,
        expected: f64,
        got: f64,
        limit: Limit,
    ) -> Self {
        let error = error_of(expected, got, limit);
        let (most, between, share) = match limit {
            Limit::Share(most) => (most, None, true),
            Limit::Absolute(most) => (most, None, false),
            Limit::Between(least, most) => (0.0, Some([least, most]), false),
        };
        // What is not a number is not within.
        let passed = error <= most;
        Self {
            name,
            unit,
            expected,
            got,
            error,
            limit: most,
            between,
            share,
            passed,
            step: None,
            segment: None,
        }
    }
}

/// The error of an observed value, in the terms of its limit.
pub(super) fn error_of(expected: f64, got: f64, limit: Limit) -> f64 {
    match limit {
        Limit::Share(_) if expected != 0.0 => (got / expected - 1.0).abs(),
        Limit::Share(_) | Limit::Absolute(_) => (got - expected).abs(),
        Limit::Between(least, most) if got.is_finite() => (least - got).max(got - most).max(0.0),
        Limit::Between(..) => f64::NAN,
    }
}

/// Readings of every probe.
#[derive(Clone, Debug, Default)]
pub(super) struct Observed {
    /// Times of the samples [s].
    pub times_s: Vec<f64>,
    /// By probe of the model: its reading at each time.
    pub samples: Vec<Vec<f64>>,
    /// Readings at closer times, for a plot: times and readings.
    pub trace: (Vec<f64>, Vec<Vec<f64>>),
}

/// A value with its unit: metres below a centimetre in millimetres, six significant digits.
pub fn value(number: f64, unit: &str) -> String {
    match unit {
        "m" if number.abs() < 0.01 && number.abs() > 0.0 => {
            format!("{} mm", significant(1e3 * number))
        }
        "" => significant(number),
        _ => format!("{} {unit}", significant(number)),
    }
}

/// A share in percent.
pub fn percent(share: f64) -> String {
    let digits = if share.abs() < 0.1 { 3 } else { 1 };
    format!("{:.digits$} %", 100.0 * share)
}

/// How far off a verdict is.
pub fn error(verdict: &Verdict, error: f64) -> String {
    if verdict.share { percent(error) } else { value(error, verdict.unit) }
}

/// How far off it may be.
pub fn limit(verdict: &Verdict) -> String {
    match verdict.between {
        Some([least, most]) => {
            format!("{} to {}", value(least, verdict.unit), value(most, verdict.unit))
        }
        None if verdict.share => format!("{} %", significant(100.0 * verdict.limit)),
        None => value(verdict.limit, verdict.unit),
    }
}

/// Six significant digits, without zeros at the end.
fn significant(number: f64) -> String {
    let rounded: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    if rounded.abs() >= 1e6 || (rounded.abs() < 1e-4 && rounded.abs() > 0.0) {
        format!("{rounded:e}")
    } else {
        format!("{rounded}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_in_the_terms_of_their_limit() {
        assert!((error_of(200.0, 201.0, Limit::Share(0.01)) - 0.005).abs() < 1e-12);
        assert!((error_of(200.0, 199.0, Limit::Absolute(2.0)) - 1.0).abs() < 1e-12);
        assert!((error_of(0.0, 0.003, Limit::Share(0.01)) - 0.003).abs() < 1e-12);
        assert!(error_of(0.5, 0.4, Limit::Between(0.3, 0.6)).abs() < 1e-12);
        assert!((error_of(0.5, 0.7, Limit::Between(0.3, 0.6)) - 0.1).abs() < 1e-12);
    }

    #[test]
    fn what_is_not_a_number_has_not_passed() {
        for limit in [Limit::Share(1.0), Limit::Absolute(1.0), Limit::Between(0.0, 1.0)] {
            assert!(!Verdict::new("x".into(), "N", 1.0, f64::NAN, limit).passed);
        }
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!(value(0.000_523_4, "m"), "0.5234 mm");
        assert_eq!(value(50.340_610_59, "m"), "50.3406 m");
        assert_eq!(value(23.936_301, "N"), "23.9363 N");
        assert_eq!(value(2.566_316, ""), "2.56632");
        assert_eq!(percent(0.001_31), "0.131 %");
        assert_eq!(percent(0.25), "25.0 %");
    }
}

//! What came of a case, for a table, a plot and JSON (schema `endline.validate/1`).

use endline_gear::{Case, Limit};
use schemars::JsonSchema;
use serde::Serialize;

use super::setup::Setup;

/// What came of a case.
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
    /// Why there are no verdicts: the run stopped, or the gear did not come to rest.
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
    /// What is compared.
    pub name: String,
    /// Unit of `expected` and `got`: `m`, `N`, `J`, one of these by second, or empty for a pure number.
    pub unit: &'static str,
    /// What should come out; 0 where `got` is itself a difference.
    pub expected: f64,
    /// What came out.
    pub got: f64,
    /// How far off it is: a share where `limit` is one, else in `unit`; outside of the limits where there are two.
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

/// What halving comes to.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
pub struct Convergence {
    /// Error at half.
    pub error_at_half: f64,
    /// Order of convergence from whole, half and quarter; `null` where the readings do not differ.
    pub order: Option<f64>,
}

/// A probe over time, beside what it should be.
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
    /// Judges what was got.
    pub(super) fn new(
        name: String,
        unit: &'static str,
        expected: f64,
        got: f64,
        limit: Limit,
    ) -> Self {
        let error = error(expected, got, limit);
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

/// How far what was got is off, in the terms of its limit.
pub(super) fn error(expected: f64, got: f64, limit: Limit) -> f64 {
    match limit {
        Limit::Share(_) if expected != 0.0 => (got / expected - 1.0).abs(),
        Limit::Share(_) | Limit::Absolute(_) => (got - expected).abs(),
        Limit::Between(least, most) if got.is_finite() => (least - got).max(got - most).max(0.0),
        Limit::Between(..) => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_in_the_terms_of_their_limit() {
        assert!((error(200.0, 201.0, Limit::Share(0.01)) - 0.005).abs() < 1e-12);
        assert!((error(200.0, 199.0, Limit::Absolute(2.0)) - 1.0).abs() < 1e-12);
        assert!((error(0.0, 0.003, Limit::Share(0.01)) - 0.003).abs() < 1e-12);
        assert!(error(0.5, 0.4, Limit::Between(0.3, 0.6)).abs() < 1e-12);
        assert!((error(0.5, 0.7, Limit::Between(0.3, 0.6)) - 0.1).abs() < 1e-12);
    }

    #[test]
    fn what_is_not_a_number_has_not_passed() {
        for limit in [Limit::Share(1.0), Limit::Absolute(1.0), Limit::Between(0.0, 1.0)] {
            assert!(!Verdict::new("x".into(), "N", 1.0, f64::NAN, limit).passed);
        }
    }
}

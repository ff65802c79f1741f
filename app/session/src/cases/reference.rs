//! What readings are compared with: the probes of a model and the columns of a table.

use endline_gear::{At, Measure, Table};
use endline_sim::Model;
use endline_sim::metrics::unit;

use crate::error::Error;

/// What readings are compared with.
pub(super) struct Reference<'a> {
    /// The model that is run.
    pub model: &'a Model,
    /// The published table, where the case has one.
    pub table: Option<&'a Table>,
}

impl Reference<'_> {
    /// Place of a probe among those of the model.
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

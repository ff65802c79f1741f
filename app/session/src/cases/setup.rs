//! A case's scenario with its fields set, and the same model at a share of its step and segments.

use std::sync::Arc;

use endline_gear::{Case, Document};
use endline_sim::model::{Line, ModelError};
use endline_sim::{DVec3, Model};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::{Overrides, Prepared, Source};

use super::Cases;

/// A case ready to run.
pub(super) struct Setup {
    pub prepared: Prepared,
    pub model: Arc<Model>,
}

impl Setup {
    /// Reads the case's scenario and sets its fields and `more`.
    pub fn new(
        cases: &Cases,
        case: &Case,
        more: &[(String, String)],
        host: &PluginHost,
    ) -> Result<Self, Error> {
        let path = cases.root.join("scenarios").join(format!("{}.toml", case.scenario.value));
        let text = endline_gear::read::text(&path).map_err(|error| {
            let message = format!("the scenario `{}` cannot be read: {error}", case.scenario.value);
            Error::Diagnostics(vec![
                case.scenario
                    .place
                    .error(message, "write the name of a file of scenarios/ without .toml"),
            ])
        })?;
        let fault = |message: String| Error::at(&path, format!("cannot be set: {message}"));
        let mut document = Document::parse(&text).map_err(|error| fault(error.message))?;
        for (field, value) in &case.set {
            let as_error = |error: endline_gear::EditError| {
                Error::Diagnostics(vec![
                    field.place.error(error.message, "name a field of the scenario"),
                ])
            };
            document.set(&field.value, value).map_err(as_error)?;
        }
        for (field, value) in more {
            document.set(field, value).map_err(|error| fault(error.message))?;
        }
        let source = Source {
            scenario_name: path.display().to_string(),
            scenario: document.text(),
            library: cases.sources.clone(),
            overrides: Overrides::default(),
        };
        let prepared = source.prepare(host)?;
        let model = Arc::clone(&prepared.model);
        Ok(Self { prepared, model })
    }

    /// The same at its step divided by the first number and its segments by the second.
    pub fn finer(&self, [step, segment]: [u32; 2]) -> Result<Prepared, Error> {
        let mut spec = self.model.spec.clone();
        spec.settings.step_s /= f64::from(step);
        spec.settings.contact_step_s /= f64::from(step);
        spec.lines.iter_mut().for_each(|line| divide(line, segment as usize));
        let as_error = |error: ModelError| {
            endline_gear::Diagnostic::of_file(
                &self.prepared.source.scenario_name,
                error.message,
                error.part,
            )
        };
        let model = Model::new(spec)
            .map_err(|errors| Error::Diagnostics(errors.into_iter().map(as_error).collect()))?;
        Ok(Prepared { model: Arc::new(model), ..self.prepared.clone() })
    }
}

/// Cuts every segment into as many equal ones.
fn divide(line: &mut Line, into: usize) {
    if into < 2 {
        return;
    }
    line.start_m = match line.start_m.split_last() {
        None => Vec::new(),
        Some((last, _)) => {
            let between = |pair: &[DVec3]| {
                (0..into).map(|k| pair[0].lerp(pair[1], k as f64 / into as f64)).collect::<Vec<_>>()
            };
            line.start_m.windows(2).flat_map(between).chain([*last]).collect()
        }
    };
    line.segments_m = line
        .segments_m
        .iter()
        .flat_map(|length| std::iter::repeat_n(length / into as f64, into))
        .collect();
}

#[cfg(test)]
mod tests {
    use endline_sim::model::Strength;

    use super::*;

    #[test]
    fn a_divided_line_keeps_its_length_and_shape() {
        let start_m = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 0.0, 2.0)];
        let mut line = Line {
            id: "line".into(),
            rope: 0,
            from: 0,
            to: 1,
            segments_m: vec![1.0, 2.0],
            strength: Strength::default(),
            knots_m: [0.0; 2],
            start_m,
        };
        divide(&mut line, 2);
        assert_eq!(line.segments_m, [0.5, 0.5, 1.0, 1.0]);
        assert_eq!(
            line.start_m,
            [
                DVec3::ZERO,
                DVec3::X * 0.5,
                DVec3::X,
                DVec3::new(1.0, 0.0, 1.0),
                DVec3::new(1.0, 0.0, 2.0)
            ]
        );
    }
}

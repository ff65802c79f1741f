//! A case's scenario with its fields set, the same model at a share of its step and segments, and gear hauled for a case.

use std::sync::Arc;

use endline_gear::{Case, CaseHaul, Diagnostic, Document};
use endline_sim::haul::{Haul, HaulEvent, Hauling, endlines};
use endline_sim::model::{BodyRole, Line, ModelError};
use endline_sim::{DVec3, Model, settle};

use super::Cases;
use super::outcome::Observed;
use crate::error::Error;
use crate::haul::HaulRequest;
use crate::plugins::PluginHost;
use crate::source::{Prepared, Source};

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
            let help = "write the name of a file of scenarios/ without .toml";
            Error::from(case.scenario.place.error(message, help))
        })?;
        let mut document = Document::parse(&text).map_err(Error::on(&path, "cannot be set"))?;
        for (field, value) in &case.set {
            document.set(&field.value, value).map_err(|error| {
                field.place.error(error.message, "name a field of the scenario")
            })?;
        }
        for (field, value) in more {
            document.set(field, value).map_err(Error::on(&path, "cannot be set"))?;
        }
        let prepared =
            Source::new(path.display(), document.text(), cases.sources.clone()).prepare(host)?;
        let model = Arc::clone(&prepared.model);
        Ok(Self { prepared, model })
    }

    /// The model with its step divided by the first number and its segments by the second.
    pub fn finer(&self, [step, segment]: [u32; 2]) -> Result<Prepared, Error> {
        let mut spec = self.model.spec.clone();
        spec.settings.step_s /= f64::from(step);
        spec.settings.contact_step_s /= f64::from(step);
        spec.lines.iter_mut().for_each(|line| divide(line, segment as usize));
        let as_error = |error: ModelError| {
            Diagnostic::of_file(&self.prepared.source.scenario_name, error.message, error.part)
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
    Err(Diagnostic::of_file(case.place.source.path.clone(), message, help).into())
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
        let continues = up.advance().map_err(|stop| Error::Stopped(stop).to_string())?;
        let traps = |event: &&HaulEvent| matches!(event, HaulEvent::Aboard(body) if is_trap(*body));
        aboard += up.last_step().events.iter().filter(traps).count() as u64;
        greatest_n = greatest_n.max(up.last_step().load_n);
        let time_s = up.state().time_s;
        if observed.times_s.last().is_none_or(|last| time_s >= last + between_s - 1e-9) {
            observed.times_s.push(time_s);
            observed.samples[0].push(std::mem::take(&mut greatest_n));
        }
        if !continues {
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
            weak_places: Vec::new(),
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

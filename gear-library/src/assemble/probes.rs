//! Probes, looked up.

use endline_sim::model::{Probe, ProbeTarget};

use crate::diagnostic::At;
use crate::scenario::ProbePart;

use super::builder::{Builder, Part};

impl Builder<'_> {
    /// Every probe of the scenario.
    pub fn add_probes(&mut self) {
        for probe in &self.scenario.probes {
            let target = match &probe.part {
                ProbePart::Tension(line, end) => self.line(line).map(|line| ProbeTarget::EndTension(line, *end)),
                ProbePart::TensionAt(line, length_m) => self.line(line).map(|line| ProbeTarget::TensionAt(line, *length_m)),
                ProbePart::LineAt(line, length_m, axis) => self.line(line).map(|line| ProbeTarget::LineAt(line, *length_m, *axis)),
                ProbePart::Energy(form) => Some(ProbeTarget::Energy(*form)),
                ProbePart::Middle(line, axis) => self.line(line).map(|line| ProbeTarget::LineMiddle(line, *axis)),
                ProbePart::Place(part, axis) => self.placed(part, *axis),
            };
            if self.spec.probes.iter().any(|known| known.id == probe.id.value) {
                let message = format!("there are two probes with the id `{}`", probe.id.value);
                self.problems.push(probe.id.place.error(message, "give one of them another id"));
            }
            self.spec.probes.extend(target.map(|target| Probe { id: probe.id.value.clone(), target }));
        }
    }

    fn line(&self, id: &At<String>) -> Option<usize> {
        if let Some(Part::Line(line)) = self.part(&id.value) {
            return Some(line);
        }
        self.unknown("line", id, |part| matches!(part, Part::Line(_)));
        None
    }

    fn placed(&self, id: &At<String>, axis: usize) -> Option<ProbeTarget> {
        match self.part(&id.value) {
            Some(Part::Body(body)) => Some(ProbeTarget::Body(body, axis)),
            Some(Part::Joint(joint)) => Some(ProbeTarget::Joint(joint, axis)),
            _ => {
                self.unknown("body or joint", id, |part| matches!(part, Part::Body(_) | Part::Joint(_)));
                None
            }
        }
    }
}

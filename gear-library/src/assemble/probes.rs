//! Probes, looked up.

use endline_sdk::LineEnd;
use endline_sim::DVec3;
use endline_sim::model::{Probe, ProbeTarget, WhaleFigure};

use crate::diagnostic::At;
use crate::scenario::ProbePart;

use super::builder::{Builder, Part};

impl Builder<'_> {
    /// Every probe of the scenario.
    pub fn add_probes(&mut self) {
        for probe in &self.scenario.probes {
            let target = match &probe.part {
                ProbePart::Tension(line, end) => {
                    let at_end =
                        |[first, last]: [usize; 2]| if *end == LineEnd::A { first } else { last };
                    self.line(line).map(|pieces| ProbeTarget::EndTension(at_end(pieces), *end))
                }
                ProbePart::Middle(line, axis) => {
                    self.whole_line(line).map(|line| ProbeTarget::LineMiddle(line, *axis))
                }
                ProbePart::TensionAt(line, length_m) => {
                    self.whole_line(line).map(|line| ProbeTarget::TensionAt(line, *length_m))
                }
                ProbePart::LineAt(line, length_m, axis) => {
                    self.whole_line(line).map(|line| ProbeTarget::LineAt(line, *length_m, *axis))
                }
                ProbePart::Height(line, away_m) => {
                    self.whole_line(line).map(|line| ProbeTarget::Height(line, *away_m))
                }
                ProbePart::Energy(form) => Some(ProbeTarget::Energy(*form)),
                ProbePart::Whale(figure) => self.of_whale(figure),
                ProbePart::Place { part, point_m, axis } => self.placed(part, *point_m, *axis),
            };
            if self.spec.probes.iter().any(|known| known.id == probe.id.value) {
                let message = format!("there are two probes with the id `{}`", probe.id.value);
                self.problems.push(probe.id.place.error(message, "give one of them another id"));
            }
            self.spec
                .probes
                .extend(target.map(|target| Probe { id: probe.id.value.clone(), target }));
        }
    }

    /// A figure of the scenario's whale, which must have it.
    fn of_whale(&mut self, figure: &At<WhaleFigure>) -> Option<ProbeTarget> {
        let error = match &self.spec.whale {
            None => (
                "there is no whale to read",
                "give the scenario a [whale], or leave this probe out",
            ),
            Some(whale) if whale.kinetic.is_none() && figure.value != WhaleFigure::Speed => (
                "this whale has no effort: it goes where its pilot sends it",
                "write dynamics = \"kinetic\" in [whale], or read `speed`",
            ),
            Some(_) => return Some(ProbeTarget::Whale(figure.value)),
        };
        self.problems.push(figure.place.error(error.0, error.1));
        None
    }

    /// First and last piece of a line.
    fn line(&self, id: &At<String>) -> Option<[usize; 2]> {
        if let Some(Part::Line { first, last }) = self.part(&id.value) {
            return Some([first, last]);
        }
        self.unknown("line", id, |part| matches!(part, Part::Line { .. }));
        None
    }

    /// A line that is in one piece.
    fn whole_line(&self, id: &At<String>) -> Option<usize> {
        let [first, last] = self.line(id)?;
        if first != last {
            let message = format!("line `{}` is in {} pieces", id.value, last + 1 - first);
            let help = format!(
                "name the piece whose middle is meant, such as `{}`",
                self.spec.lines[first].id
            );
            self.problems.push(id.place.error(message, help));
            return None;
        }
        Some(first)
    }

    /// A body's middle or another point of it, or a joint.
    fn placed(&self, id: &At<String>, point_m: Option<DVec3>, axis: usize) -> Option<ProbeTarget> {
        match self.part(&id.value) {
            Some(Part::Body(body)) => {
                Some(ProbeTarget::Body { body, offset_m: point_m.unwrap_or_default(), axis })
            }
            Some(Part::Joint(joint)) if point_m.is_none() => Some(ProbeTarget::Joint(joint, axis)),
            _ if point_m.is_some() => {
                self.unknown("body", id, |part| matches!(part, Part::Body(_)));
                None
            }
            _ => {
                self.unknown("body or joint", id, |part| {
                    matches!(part, Part::Body(_) | Part::Joint(_))
                });
                None
            }
        }
    }
}

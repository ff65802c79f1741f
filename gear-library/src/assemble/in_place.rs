//! Parts written into the scenario: obstacles, fixtures, joints, bodies, lines, weak links and probes.

use endline_sdk::LineEnd;
use endline_sim::DVec3;
use endline_sim::model::{Joint, JointKind, Obstacle, Probe, ProbeTarget, WhaleFigure};

use crate::diagnostic::At;
use crate::scenario::{ObstacleOf, PositionOf, ProbePart};

use super::body;
use super::builder::{Builder, Part};
use super::gear::Rated;
use super::line::{NewLine, WHALE};

impl Builder<'_> {
    /// Adds the obstacles.
    pub fn add_obstacles(&mut self) {
        for obstacle in &self.scenario.obstacles {
            let ObstacleOf { id, shape, position_m, orientation, friction, stiffness_n_m2 } =
                obstacle.clone();
            self.name(id.value.clone(), Part::Obstacle(self.spec.obstacles.len()), &id.place);
            self.spec.obstacles.push(Obstacle {
                id: id.value,
                shape,
                position_m,
                orientation,
                friction,
                stiffness_n_m2,
            });
        }
    }

    /// Adds the fixed, driven and pulled points.
    pub fn add_fixtures(&mut self) {
        for fixture in &self.scenario.fixtures {
            let kind = match (fixture.drive, fixture.pull) {
                (Some((velocity_m_s, from_s, until_s)), _) => {
                    JointKind::Driven { velocity_m_s, from_s, until_s }
                }
                (None, Some((force_n, from_s))) => JointKind::Pulled { force_n, from_s },
                (None, None) => JointKind::Fixed,
            };
            self.name(
                fixture.id.value.clone(),
                Part::Joint(self.spec.joints.len()),
                &fixture.id.place,
            );
            self.spec.joints.push(Joint {
                id: fixture.id.value.clone(),
                kind,
                position_m: fixture.position_m,
            });
        }
    }

    /// Adds the free joints.
    pub fn add_free_joints(&mut self) {
        for (id, position_m) in &self.scenario.joints {
            self.name(id.value.clone(), Part::Joint(self.spec.joints.len()), &id.place);
            self.spec.joints.push(Joint {
                id: id.value.clone(),
                kind: JointKind::Free,
                position_m: *position_m,
            });
        }
    }

    /// Adds the bodies.
    pub fn add_free_bodies(&mut self) {
        for free in &self.scenario.bodies {
            self.name(free.id.value.clone(), Part::Body(self.spec.bodies.len()), &free.id.place);
            self.spec.bodies.push(body::of_free(free, self.spec.water.density_kg_m3));
            self.points.push(vec![("middle".to_owned(), DVec3::ZERO)]);
        }
    }

    /// Adds the lines.
    pub fn add_free_lines(&mut self) {
        for (line, start) in &self.scenario.lines {
            let ends = (self.end(&line.from), self.end(&line.to));
            let (id, rope) = (line.id.clone(), line.rope.clone());
            self.add_line(&NewLine {
                id,
                rope,
                ends,
                length_m: line.length_m,
                start: start.clone(),
                laid_m: Vec::new(),
                make: &line.make,
            });
        }
    }

    /// Adds the weak links.
    pub fn add_free_links(&mut self) {
        for link in &self.scenario.links {
            let item = link.item.as_ref().and_then(|item| self.rating(item, &link.id.value));
            let written =
                link.rating_n.map(|rating_n| Rated { rating_n, ..item.unwrap_or_default() });
            self.add_link(&link.id, written.or(item), &link.line, link.end);
        }
    }
}

impl Builder<'_> {
    /// Adds the probes.
    pub fn add_probes(&mut self) {
        for probe in &self.scenario.probes {
            let id = &probe.id.value;
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
                ProbePart::Position(of) => {
                    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                        // A part that does not exist is reported once.
                        let Some(target) = self.position(of, axis) else { break };
                        self.add_probe(format!("{id} {name}"), &probe.id, target);
                    }
                    continue;
                }
            };
            if let Some(target) = target {
                self.add_probe(id.clone(), &probe.id, target);
            }
        }
    }

    /// Adds a probe with this id, which `written` names in the file.
    fn add_probe(&mut self, id: String, written: &At<String>, target: ProbeTarget) {
        if self.spec.probes.iter().any(|known| known.id == id) {
            let message = format!("there are two probes with the id `{id}`");
            self.problems.push(written.place.error(message, "give one of them another id"));
        }
        self.spec.probes.push(Probe { id, target });
    }

    /// A coordinate of a probe of a position.
    fn position(&self, of: &PositionOf, axis: usize) -> Option<ProbeTarget> {
        match of {
            PositionOf::Part(part, point_m) => self.placed(part, *point_m, axis),
            PositionOf::Line(line, length_m) => {
                self.whole_line(line).map(|line| ProbeTarget::LineAt(line, *length_m, axis))
            }
        }
    }

    /// The target of a figure of the whale, which must have that figure.
    fn of_whale(&mut self, figure: &At<WhaleFigure>) -> Option<ProbeTarget> {
        let error = match &self.spec.whale {
            None => ("the scenario has no whale", "add a [whale], or remove this probe"),
            Some(whale)
                if whale.kinetic.is_none()
                    && !matches!(figure.value, WhaleFigure::Speed | WhaleFigure::ContactForce) =>
            {
                (
                    "a kinematic whale has no thrust, power or drag",
                    "write dynamics = \"kinetic\" in [whale], or read `speed` or `contact-force`",
                )
            }
            Some(_) => return Some(ProbeTarget::Whale(figure.value)),
        };
        self.problems.refuse(figure.place.error(error.0, error.1))
    }

    /// First and last piece of a line.
    fn line(&self, id: &At<String>) -> Option<[usize; 2]> {
        if let Some(Part::Line { first, last }) = self.part(&id.value) {
            return Some([first, last]);
        }
        self.unknown("line", id, |part| matches!(part, Part::Line { .. }));
        None
    }

    /// A line that consists of one piece.
    fn whole_line(&self, id: &At<String>) -> Option<usize> {
        let [first, last] = self.line(id)?;
        if first != last {
            let message = format!("line `{}` consists of {} pieces", id.value, last + 1 - first);
            let help = format!("name one of its pieces, such as `{}`", self.spec.lines[first].id);
            return self.problems.refuse(id.place.error(message, help));
        }
        Some(first)
    }

    /// A point of a body, a joint, the whale, or a spot of it.
    fn placed(&self, id: &At<String>, point_m: Option<DVec3>, axis: usize) -> Option<ProbeTarget> {
        let part = self.part(&id.value);
        if part.is_none() && point_m.is_none() {
            match id.value.split_once(':') {
                Some((WHALE, spot)) => {
                    return Some(ProbeTarget::Skin(self.whale_spot(spot, id)?, axis));
                }
                None if id.value == WHALE => {
                    let origin = self.whale_placed(id).then_some(ProbeTarget::WhaleOrigin(axis));
                    return origin;
                }
                _ => {}
            }
        }
        match part {
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

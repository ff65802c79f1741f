//! Parts written into the scenario: obstacles, fixtures, joints, bodies, lines and weak links.

use endline_sim::DVec3;
use endline_sim::model::{Joint, JointKind, Obstacle};

use crate::scenario::ObstacleOf;

use super::body;
use super::builder::{Builder, Part};
use super::line::NewLine;
use super::rig::Rated;

impl Builder<'_> {
    /// Obstacles of the scenario.
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

    /// Fixed, driven and pulled points of the scenario.
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

    /// Free joints written into the scenario.
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

    /// Bodies written into the scenario.
    pub fn add_free_bodies(&mut self) {
        for free in &self.scenario.bodies {
            self.name(free.id.value.clone(), Part::Body(self.spec.bodies.len()), &free.id.place);
            self.spec.bodies.push(body::of_free(free, self.spec.water.density_kg_m3));
            self.points.push(vec![("middle".to_owned(), DVec3::ZERO)]);
        }
    }

    /// Lines written into the scenario.
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

    /// Weak links written into the scenario.
    pub fn add_free_links(&mut self) {
        for link in &self.scenario.links {
            let item = link.item.as_ref().and_then(|item| self.rating(item, &link.id.value));
            let written =
                link.rating_n.map(|rating_n| Rated { rating_n, ..item.unwrap_or_default() });
            self.add_link(&link.id, written.or(item), &link.line, link.end);
        }
    }
}

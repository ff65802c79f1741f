//! Where lines end: a joint's own place, or a point of a body.
//!
//! `trap-1` names a body and means its usual point; `trap-1:bridle-port` names another, `whale:peduncle` a spot on the whale's skin. Lines made fast at one
//! point share a joint.

use endline_sim::DVec3;
use endline_sim::model::{Joint, JointKind};

use crate::diagnostic::At;
use crate::nearest::hint;

use super::builder::{Builder, Part};

/// The word by which an end names the whale.
const WHALE: &str = "whale";

/// The part that an end names, and the point of it where one is named.
pub(super) fn split(end: &str) -> (&str, Option<&str>) {
    end.rsplit_once(':').map_or((end, None), |(part, point)| (part, Some(point)))
}

impl Builder<'_> {
    /// The joint a line's end names: a joint's own, or one at a point of a body.
    pub fn end(&mut self, end: &At<String>) -> Option<usize> {
        let (part, point) = split(&end.value);
        if part == WHALE && self.part(part).is_none() {
            return self.whale_joint(point, end);
        }
        match (self.part(part), point) {
            (Some(Part::Joint(joint)), None) => Some(joint),
            (Some(Part::Joint(_)), Some(point)) => {
                let message = format!("joint `{part}` has no point `{point}`");
                self.problems.push(
                    end.place.error(
                        message,
                        "only a body has points; take the colon and what follows out",
                    ),
                );
                None
            }
            (Some(Part::Body(body)), point) => self.body_joint(body, point, end),
            _ => {
                let wanted = At { value: part.to_owned(), place: end.place.clone() };
                self.unknown("body or joint", &wanted, |part| {
                    matches!(part, Part::Body(_) | Part::Joint(_))
                });
                None
            }
        }
    }

    /// The joint at a point of a body; one for all lines made fast there.
    fn body_joint(&mut self, body: usize, point: Option<&str>, end: &At<String>) -> Option<usize> {
        let points = &self.points[body];
        let found = match point {
            Some(name) => points.iter().position(|(known, _)| known == name),
            None => Some(0),
        };
        let holder = &self.spec.bodies[body];
        let Some(found) = found else {
            let name = point.unwrap_or_default();
            let known = points.iter().map(|(name, _)| name.as_str());
            let message = format!("body `{}` has no point `{name}`", holder.id);
            self.problems.push(end.place.error(message, hint(name, known)));
            return None;
        };
        let (name, offset_m) = &points[found];
        let (id, offset_m) = (
            if found == 0 { holder.id.clone() } else { format!("{}:{name}", holder.id) },
            *offset_m,
        );
        let at_point = |joint: &Joint| {
            matches!(joint.kind, JointKind::Body { body: of, .. } if of == body) && joint.id == id
        };
        if let Some(joint) = self.spec.joints.iter().position(at_point) {
            return Some(joint);
        }
        let position_m: DVec3 = holder.position_m + holder.orientation * offset_m;
        self.spec.joints.push(Joint { id, kind: JointKind::Body { body, offset_m }, position_m });
        Some(self.spec.joints.len() - 1)
    }
}

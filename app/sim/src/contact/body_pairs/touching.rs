//! Which bodies touch one another at a moment shown.

use glam::{DQuat, DVec3};

use crate::contact::bodies::core::BodyCore;
use crate::model::Model;
use crate::solids::Pose;

/// Indices of the bodies that touch one, all of them at the places and in the orientations given; none in a model whose bodies do not.
#[must_use]
pub fn bodies_touching(model: &Model, bodies: &[(DVec3, DQuat)], body: usize) -> Vec<usize> {
    let (Some(mine), Some(at)) = (model.spec.bodies.get(body), bodies.get(body)) else {
        return Vec::new();
    };
    if !model.spec.settings.bodies_on_bodies {
        return Vec::new();
    }
    let (core, pose) = (BodyCore::of(mine), pose(at));
    let others = model.spec.bodies.iter().zip(bodies).enumerate();
    let touches = others.filter(|(index, (other, at))| {
        *index != body && touch((&core, &pose), (&BodyCore::of(other), &self::pose(at)))
    });
    touches.map(|(index, _)| index).collect()
}

fn pose(&(place, orientation): &(DVec3, DQuat)) -> Pose {
    Pose { place, orientation }
}

/// Whether two bodies are nearer than their contact distances, or overlap.
fn touch((core, pose): (&BodyCore, &Pose), (other, other_pose): (&BodyCore, &Pose)) -> bool {
    if pose.place.distance(other_pose.place) > core.radius + other.radius {
        return false;
    }
    let nearest = core.nearest_to(pose, other, other_pose);
    nearest.is_none_or(|[one, two]| one.distance(two) < core.reach + other.reach)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::tests::body;
    use crate::model::{Body, BodyRole, Shape};

    #[test]
    fn bodies_touch_where_their_surfaces_meet() {
        let it = |shape| Body { shape, ..body("it", BodyRole::Trap, DVec3::ZERO) };
        let trap = BodyCore::of(&it(Shape::Box(DVec3::new(0.5, 0.3, 0.2))));
        let ball = BodyCore::of(&it(Shape::Sphere(0.25)));
        let at = |place| Pose { place, orientation: DQuat::IDENTITY };
        let above = |gap_m: f64| at(DVec3::new(0.1, 0.0, 0.2 + 0.25 + gap_m));
        let origin = at(DVec3::ZERO);
        assert!(touch((&trap, &origin), (&ball, &above(-1e-3))));
        assert!(!touch((&trap, &origin), (&ball, &above(1e-3))));
        assert!(touch((&ball, &above(-1e-3)), (&trap, &origin)), "whichever is asked first");
        assert!(touch((&trap, &origin), (&ball, &origin)), "one inside the other");
    }
}

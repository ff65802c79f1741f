//! Which bodies touch one another at a moment shown.

use glam::{DQuat, DVec3};

use crate::geometry::Pose;
use crate::geometry::core::BodyCore;
use crate::model::{Body, Model};

/// Indices of the bodies that touch a body, all of them at these places and orientations; empty if bodies of the model do not touch.
pub fn bodies_touching(model: &Model, bodies: &[(DVec3, DQuat)], body: usize) -> Vec<usize> {
    let (Some(mine), Some(at)) = (model.spec.bodies.get(body), bodies.get(body)) else {
        return Vec::new();
    };
    if !model.spec.settings.bodies_on_bodies {
        return Vec::new();
    }
    let (cores, pose) = (cores(mine), pose(at));
    let others = model.spec.bodies.iter().zip(bodies).enumerate();
    let touches = others.filter(|(index, (other, at))| {
        *index != body && touch((&cores, &pose), (&self::cores(other), &self::pose(at)))
    });
    touches.map(|(index, _)| index).collect()
}

fn pose(&(place, orientation): &(DVec3, DQuat)) -> Pose {
    Pose { place, orientation }
}

fn cores(body: &Body) -> Vec<BodyCore> {
    BodyCore::of_bodies(std::slice::from_ref(body)).collect()
}

/// Whether any parts of two bodies are nearer than their contact distances, or overlap.
fn touch((cores, pose): (&[BodyCore], &Pose), (others, other_pose): (&[BodyCore], &Pose)) -> bool {
    let away_m = pose.place.distance(other_pose.place);
    let mut pairs = cores.iter().flat_map(|core| others.iter().map(move |other| (core, other)));
    pairs.any(|(core, other)| {
        let nearest = || core.nearest_to(pose, other, other_pose);
        let reach = core.reach + other.reach;
        away_m <= core.radius + other.radius
            && nearest().is_none_or(|[one, two]| one.distance(two) < reach)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::tests::body;
    use crate::model::{BodyRole, PlacedShape, Shape};

    #[test]
    fn bodies_touch_where_their_surfaces_meet() {
        let of = |shape| {
            let parts = vec![PlacedShape::about_origin(shape)];
            cores(&Body { parts, ..body("it", BodyRole::Trap, DVec3::ZERO) })
        };
        let trap = of(Shape::Box(DVec3::new(0.5, 0.3, 0.2)));
        let ball = of(Shape::Sphere(0.25));
        let at = |place| Pose { place, orientation: DQuat::IDENTITY };
        let above = |gap_m: f64| at(DVec3::new(0.1, 0.0, 0.2 + 0.25 + gap_m));
        let origin = at(DVec3::ZERO);
        assert!(touch((&trap, &origin), (&ball, &above(-1e-3))));
        assert!(!touch((&trap, &origin), (&ball, &above(1e-3))));
        assert!(touch((&ball, &above(-1e-3)), (&trap, &origin)), "whichever is asked first");
        assert!(touch((&trap, &origin), (&ball, &origin)), "one inside the other");
    }
}

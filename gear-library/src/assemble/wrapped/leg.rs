//! Rope between wraps and ends: straight, and over the trunk where straight would go through it.

use endline_sdk::{BodyPart, Limb};
use endline_sim::DVec3;

use super::skin::PosedSkin;
use super::stretch::Stretch;

/// Distance of places looked at [m].
const EACH_M: f64 = 0.05;
/// The trunk's skin is nowhere farther from its axis than so many times the half diagonal of its section's box.
const WIDEST: f64 = 1.2;

/// The way from one place to another as a stretch, with so much rope where that is given.
pub(super) fn lay(skin: &PosedSkin, ends: [DVec3; 2], rope_m: Option<f64>) -> Stretch {
    Stretch { way: way(skin, ends, EACH_M), rope_m, fine_m: None }
}

/// The way from one place to another, looked at every `each_m`.
pub(super) fn way(skin: &PosedSkin, [from, to]: [DVec3; 2], each_m: f64) -> Vec<DVec3> {
    let steps = (from.distance(to) / each_m).ceil().max(1.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a way of metres in steps of centimetres"
    )]
    let steps = steps as u32;
    let over = |step: u32| {
        let place = from.lerp(to, f64::from(step) / f64::from(steps));
        if step == 0 || step == steps { place } else { over_trunk(skin, place) }
    };
    (0..=steps).map(over).collect()
}

/// A place, moved straight out from the trunk's axis where it lies within the trunk.
fn over_trunk(skin: &PosedSkin, place: DVec3) -> DVec3 {
    let trunk = Limb::Trunk.parts().find_map(|part| skin.axis(part));
    let Some(spot) = trunk.and_then(|(axis, _)| axis.locate(place)) else { return place };
    let toward = place - spot.middle;
    if toward.length() > WIDEST * libm::hypot(spot.half_m[0], spot.half_m[1]) + skin.off_m {
        return place;
    }
    let Some(out) = toward.try_normalize() else { return place };
    let along = spot.along();
    let Some(across) = (along - out * along.dot(out)).try_normalize() else { return place };
    match skin.outline(BodyPart::Body, spot.middle, across).radius(out) {
        Some(radius) if toward.length() < radius + skin.off_m => {
            spot.middle + out * (radius + skin.off_m)
        }
        _ => place,
    }
}

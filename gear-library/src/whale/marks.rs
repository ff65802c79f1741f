//! What is seen on the skin, and the relief of the callosities.

use std::f64::consts::PI;

use endline_sim::whale::Mark;

use super::curve::smooth_step;
use super::form::WhaleForm;
use super::layout::corner_at;

/// A patch of callosity: middle and half length along the head [share of the mouth's length], middle and half
/// width round it, from the back [share of the gape's angle, or rad past the gape on the lower jaw], height [share of the bonnet's].
struct Patch {
    upper: bool,
    at: [f64; 2],
    angle: [f64; 2],
    height: f64,
}

/// Positions: bonnet, rostral islands, coaming, behind the blowholes, above the eye, chin, lip (facts 4.5); sizes by eye.
const PATCHES: [Patch; 9] = [
    Patch { upper: true, at: [0.09, 0.09], angle: [0.0, 0.65], height: 1.0 },
    Patch { upper: true, at: [0.33, 0.07], angle: [0.0, 0.55], height: 0.7 },
    Patch { upper: true, at: [0.56, 0.06], angle: [0.0, 0.6], height: 0.7 },
    Patch { upper: true, at: [0.63, 0.05], angle: [0.0, 0.8], height: 0.8 },
    Patch { upper: true, at: [0.80, 0.05], angle: [0.0, 0.22], height: 0.5 },
    Patch { upper: true, at: [0.93, 0.04], angle: [0.72, 0.12], height: 0.7 },
    Patch { upper: false, at: [0.10, 0.07], angle: [1.35, 0.28], height: 0.8 },
    Patch { upper: false, at: [0.34, 0.05], angle: [1.2, 0.2], height: 0.5 },
    Patch { upper: false, at: [0.45, 0.10], angle: [0.12, 0.12], height: 0.4 },
];

/// Half width of the white patch behind the navel, from the middle of the belly [rad]; zero where there is none.
fn belly_patch(at: f64) -> f64 {
    let along = (at - 0.52) / 0.07;
    let round = libm::sqrt((1.0 - along * along).max(0.0));
    // Its edge is uneven, as on living animals.
    round * (0.55 + 0.14 * libm::sin(150.0 * at) + 0.08 * libm::sin(61.0 * at + 1.0))
}

/// Marks of a form.
pub struct Marks {
    relief: f64,
    corner: f64,
}

impl Marks {
    /// The marks of a form.
    #[must_use]
    pub fn of(form: &WhaleForm) -> Self {
        Self { relief: form.head.callosity_m / form.length_m, corner: corner_at(form) }
    }

    /// What is seen on the trunk.
    #[must_use]
    pub fn trunk(&self, at: f64, angle: f64) -> Mark {
        let eye = (at - (self.corner + 0.004)).abs() < 0.006 && (angle - 1.45).abs() < 0.09;
        match (eye, angle > PI - belly_patch(at)) {
            (true, _) => Mark::Eye,
            (_, true) => Mark::White,
            _ => Mark::Skin,
        }
    }

    /// What is seen on the head's outside, and how far it stands out [share of length].
    #[must_use]
    pub fn head(&self, at: f64, angle: f64, upper: bool, gape: f64) -> (Mark, f64) {
        if self.relief <= 0.0 {
            return (Mark::Skin, 0.0);
        }
        let round = if upper { angle / gape.max(0.1) } else { angle - gape };
        let on = |patch: &Patch| {
            let near = |value: f64, [middle, half]: [f64; 2]| {
                1.0 - smooth_step(0.5, 1.25, (value - middle).abs() / half)
            };
            near(at / self.corner, patch.at) * near(round, patch.angle)
        };
        let own = PATCHES
            .iter()
            .filter(|patch| patch.upper == upper)
            .map(|patch| (on(patch), patch.height));
        let (most, height) =
            own.fold((0.0, 0.0), |best, patch| if patch.0 > best.0 { patch } else { best });
        let mark = if most > 0.35 { Mark::Callosity } else { Mark::Skin };
        (mark, most * height * self.relief)
    }
}

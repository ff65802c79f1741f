//! The elastic catenary between two points: the shape a held line starts in.
//!
//! With `H` the horizontal and `V` the vertical part of the tension at the start, `w` the weight by
//! length and `s` the unstretched length from the start:
//! `x = H s/EA + H/w [asinh((V + w s)/H) - asinh(V/H)]`,
//! `z = (V s + w s²/2)/EA + H/w [√(1 + ((V + w s)/H)²) - √(1 + (V/H)²)]`.

use endline_sim::DVec3;

/// Newton passes before it gives up.
const PASSES: usize = 200;

/// An elastic catenary in the vertical plane through its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Catenary {
    along: DVec3,
    weight: f64,
    stiffness: f64,
    horizontal: f64,
    vertical: f64,
}

impl Catenary {
    /// The catenary that spans `reach` with an unstretched length, a weight by length and a stiffness EA.
    pub fn between(reach: DVec3, length: f64, weight: f64, stiffness: f64) -> Option<Self> {
        let span = libm::hypot(reach.x, reach.y);
        if span < 1e-9 || weight.abs() < 1e-12 {
            return None;
        }
        let along = DVec3::new(reach.x, reach.y, 0.0) / span;
        let (horizontal, vertical) = first_guess(span, reach.z, length, weight, stiffness);
        let mut shape = Self { along, weight, stiffness, horizontal, vertical };
        let scale = 1e-12 * (1.0 + span + reach.z.abs());
        let miss = |shape: &Self| {
            let (x, z) = shape.plane(length);
            (x - span, z - reach.z)
        };
        for _ in 0..PASSES {
            let (x, z) = miss(&shape);
            if libm::hypot(x, z) < scale {
                return Some(shape);
            }
            shape = shape.newton(length, x, z)?;
        }
        let (x, z) = miss(&shape);
        (libm::hypot(x, z) < 1e-8 * (1.0 + span)).then_some(shape)
    }

    /// Place at an unstretched length from the start.
    pub fn at(&self, s: f64) -> DVec3 {
        let (x, z) = self.plane(s);
        self.along * x + DVec3::Z * z
    }

    fn plane(&self, s: f64) -> (f64, f64) {
        let (h, v, w, ea) = (self.horizontal, self.vertical, self.weight, self.stiffness);
        let (low, high) = (v / h, (v + w * s) / h);
        let x = h * s / ea + h / w * (libm::asinh(high) - libm::asinh(low));
        let z = (v * s + 0.5 * w * s * s) / ea
            + h / w * (libm::hypot(1.0, high) - libm::hypot(1.0, low));
        (x, z)
    }

    /// One damped Newton pass against a miss, with derivatives by differences; `H` stays above zero.
    fn newton(&self, length: f64, x: f64, z: f64) -> Option<Self> {
        let by = |change: fn(&mut Self, f64), step: f64| {
            let (mut up, mut down) = (*self, *self);
            change(&mut up, step);
            change(&mut down, -step);
            let ((xu, zu), (xd, zd)) = (up.plane(length), down.plane(length));
            ((xu - xd) / (2.0 * step), (zu - zd) / (2.0 * step))
        };
        let tension = libm::hypot(self.horizontal, self.vertical);
        let (xh, zh) = by(|shape, step| shape.horizontal += step, 1e-5 * self.horizontal);
        let (xv, zv) = by(|shape, step| shape.vertical += step, 1e-6 * tension);
        let det = xh * zv - xv * zh;
        if det == 0.0 || !det.is_finite() {
            return None;
        }
        let (dh, dv) = (-(x * zv - z * xv) / det, -(z * xh - x * zh) / det);
        let damp = if dh < -0.5 * self.horizontal { -0.5 * self.horizontal / dh } else { 1.0 };
        Some(Self {
            horizontal: self.horizontal + damp * dh,
            vertical: self.vertical + damp * dv,
            ..*self
        })
    }
}

/// Tension at the start of a taut or slack line, near enough for Newton.
fn first_guess(span: f64, rise: f64, length: f64, weight: f64, stiffness: f64) -> (f64, f64) {
    let chord = libm::hypot(span, rise);
    if chord >= length {
        let tension = stiffness * (chord / length - 1.0) + weight.abs() * length;
        return (tension * span / chord, tension * rise / chord - 0.5 * weight * length);
    }
    let slack =
        libm::sqrt((3.0 * ((length * length - rise * rise) / (span * span) - 1.0)).max(1e-4));
    let horizontal = (weight * span / (2.0 * slack)).abs();
    (horizontal, 0.5 * weight * (rise / libm::tanh(slack) - length))
}

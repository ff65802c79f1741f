//! Initial shapes of lines: paths through places, the elastic catenary, rope round a cylinder, two half hitches.
//!
//! # Elastic catenary
//!
//! `H` and `V` are the horizontal and vertical tension at the start, `w` is the weight by length and `s` the unstretched
//! length from the start:
//! `x = H s/EA + H/w [asinh((V + w s)/H) - asinh(V/H)]`,
//! `z = (V s + w s²/2)/EA + H/w [√(1 + ((V + w s)/H)²) - √(1 + (V/H)²)]`.
//!
//! # Rope round a cylinder
//!
//! Straight to the cylinder, a helix round it, straight away from it. In the plane across the axis, with the centre as
//! origin and `ρ` the radius of the rope's centre line, the tangent from an end `p` is `√(|p|² - ρ²)` long and touches
//! `acos(ρ/|p|)` further round. Along the axis the rope rises evenly with its length. Unrolled it is a straight line and
//! therefore in equilibrium without friction.
//!
//! # Two half hitches (clove hitch)
//!
//! The rope makes a turn to one side of its start, crosses over itself to a turn on the other side and leaves under the
//! crossing. The path is that of two turns, shifted along the cylinder and lifted by the rope's diameter at the crossing.

use std::f64::consts::TAU;

use endline_sim::DVec3;

/// Length of a path [m].
pub(super) fn length(way: &[DVec3]) -> f64 {
    way.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// The place at a share of the length of a path of at least two places.
pub(super) fn along(way: &[DVec3], share: f64) -> DVec3 {
    let whole = length(way);
    let mut left = share * whole;
    for pair in way.windows(2) {
        let step = pair[0].distance(pair[1]);
        if left <= step && step > 0.0 {
            return pair[0].lerp(pair[1], left / step);
        }
        left -= step;
    }
    way.last().copied().unwrap_or_default()
}

/// The part of a path between two shares of its length.
pub(super) fn part_of(way: &[DVec3], [from, to]: [f64; 2]) -> Vec<DVec3> {
    let whole = length(way);
    let mut part = vec![along(way, from)];
    let mut passed = 0.0;
    for pair in way.windows(2) {
        passed += pair[0].distance(pair[1]) / whole.max(f64::MIN_POSITIVE);
        if passed > from && passed < to {
            part.push(pair[1]);
        }
    }
    part.push(along(way, to));
    part
}

/// Iteration limit of Newton's method.
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
    /// The catenary between two ends `reach` apart, with unstretched length, weight by length and stiffness EA.
    pub fn between(reach: DVec3, length: f64, weight: f64, stiffness: f64) -> Option<Self> {
        let span = libm::hypot(reach.x, reach.y);
        if span < 1e-9 || weight.abs() < 1e-12 {
            return None;
        }
        let along = DVec3::new(reach.x, reach.y, 0.0) / span;
        let (horizontal, vertical) = first_guess(span, reach.z, length, weight, stiffness);
        let mut shape = Self { along, weight, stiffness, horizontal, vertical };
        let scale = 1e-12 * (1.0 + span + reach.z.abs());
        let residual = |shape: &Self| {
            let (x, z) = shape.plane(length);
            (x - span, z - reach.z)
        };
        for _ in 0..PASSES {
            let (x, z) = residual(&shape);
            if libm::hypot(x, z) < scale {
                return Some(shape);
            }
            shape = shape.newton(length, x, z)?;
        }
        let (x, z) = residual(&shape);
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

    /// One damped Newton iteration on a residual, with finite differences; `H` stays positive.
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

/// Initial guess of the tension at the start of a taut or slack line.
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

/// A path round a cylinder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around {
    centre: DVec3,
    /// Axes across (two) and along.
    axes: [DVec3; 3],
    /// Radius of the path round [m].
    radius: f64,
    /// Winding: 1 is right-handed about the axis.
    sense: f64,
    /// Angle of the first contact [rad].
    first: f64,
    /// Lengths of tangent, arc and tangent in the plane across the axis [m].
    parts: [f64; 3],
    /// Heights of the ends along the axis [m].
    heights: (f64, f64),
}

impl Around {
    /// The path between two places with the number of turns closest to `turns`; `None` if an end is inside the cylinder.
    pub fn between(
        ends: [DVec3; 2],
        centre: DVec3,
        axes: [DVec3; 3],
        radius: f64,
        turns: f64,
    ) -> Option<Self> {
        let [from, to] = ends.map(|end| end - centre);
        let flat = |place: DVec3| (place.dot(axes[0]), place.dot(axes[1]));
        let reach = |(x, y): (f64, f64)| libm::hypot(x, y);
        let (p, q) = (flat(from), flat(to));
        if reach(p) < radius || reach(q) < radius {
            return None;
        }
        let sense = if turns < 0.0 { -1.0 } else { 1.0 };
        let lead = |place: (f64, f64)| libm::acos(radius / reach(place));
        let straight = |place: (f64, f64)| {
            libm::sqrt((reach(place) * reach(place) - radius * radius).max(0.0))
        };
        let first = libm::atan2(p.1, p.0) + sense * lead(p);
        let last = libm::atan2(q.1, q.0) - sense * lead(q);
        let least = (sense * (last - first)).rem_euclid(TAU);
        let round = (least + TAU * (turns.abs() - least / TAU).round()).max(0.0);
        let parts = [straight(p), radius * round, straight(q)];
        Some(Self {
            centre,
            axes,
            radius,
            sense,
            first,
            parts,
            heights: (from.dot(axes[2]), to.dot(axes[2])),
        })
    }

    /// Total length in the plane across the axis [m].
    fn length(&self) -> f64 {
        self.parts.iter().sum()
    }

    /// Angle from the first contact at a share of the length [rad].
    pub fn angle(&self, share: f64) -> f64 {
        (share * self.length() - self.parts[0]).clamp(0.0, self.parts[1]) / self.radius
    }

    /// Place at a share of the length.
    pub fn at(&self, share: f64) -> DVec3 {
        self.shifted(share, 0.0, 0.0)
    }

    /// Place at a share of the length, shifted outward from the axis and up along it [m].
    pub fn shifted(&self, share: f64, out: f64, up: f64) -> DVec3 {
        let along = share * self.length();
        let angle = self.first + self.sense * self.angle(share);
        let (sin, cos) = libm::sincos(angle);
        let ahead =
            (along - self.parts[0] - self.parts[1]).max(0.0) - (self.parts[0] - along).max(0.0);
        let radius = self.radius + out;
        let (x, y) =
            (radius * cos - self.sense * ahead * sin, radius * sin + self.sense * ahead * cos);
        let height = up + self.heights.0 + share * (self.heights.1 - self.heights.0);
        self.centre + self.axes[0] * x + self.axes[1] * y + self.axes[2] * height
    }
}

/// Distance of each turn from the middle along the cylinder, in rope diameters.
const APART: f64 = 2.8;
/// Height of the upper over the lower rope at the crossing, in rope diameters.
const OVER: f64 = 1.05;
/// Angles between which the rope moves from its start to its turn along the axis [rad].
const LEAVES: (f64, f64) = (0.5, 2.0);
/// Half of the angle of the crossing between the turns [rad].
const CROSSES: f64 = 1.2;
/// Angles from the middle between which the crossing rope descends to the cylinder [rad].
const LANDS: (f64, f64) = (0.6, 1.5);
/// Number of steps of the path.
const STEPS: u32 = 4000;

/// The path from end to end, for rope of a diameter [m].
pub(super) fn hitched(around: &Around, thick: f64) -> Vec<DVec3> {
    let turn = around.angle(1.0);
    let place = |step: u32| {
        let share = f64::from(step) / f64::from(STEPS);
        let angle = around.angle(share);
        let aside = 2.0 * rise(angle, (0.5 * turn - CROSSES, 0.5 * turn + CROSSES))
            - rise(angle, LEAVES)
            - rise(angle, (turn - LEAVES.1, turn - LEAVES.0));
        let out = 1.0 - rise((angle - 0.5 * turn).abs(), LANDS);
        around.shifted(share, OVER * thick * out, APART * thick * aside)
    };
    (0..=STEPS).map(place).collect()
}

/// Smooth step from 0 to 1.
fn rise(at: f64, (from, to): (f64, f64)) -> f64 {
    let share = ((at - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_round_a_drum_has_the_ends_and_length_of_its_formula() {
        let (radius, tail) = (0.5, 2.0);
        for (turns, to) in [
            (0.5, DVec3::new(-radius, -tail, 0.1)),
            (1.0, DVec3::new(radius, tail, 0.1)),
            (2.5, DVec3::new(-radius, -tail, 0.1)),
        ] {
            let from = DVec3::new(radius, -tail, 0.0);
            let path = Around::between(
                [from, to],
                DVec3::ZERO,
                [DVec3::X, DVec3::Y, DVec3::Z],
                radius,
                turns,
            )
            .unwrap();
            assert!(
                (path.length() - 2.0 * tail - radius * TAU * turns).abs() < 1e-12,
                "{turns}: {}",
                path.length()
            );
            assert!((path.at(0.0) - from).length() < 1e-12 && (path.at(1.0) - to).length() < 1e-12);
            assert!((1..100).all(|k| libm::hypot(
                path.at(f64::from(k) / 100.0).x,
                path.at(f64::from(k) / 100.0).y
            ) > radius - 1e-12));
        }
        assert!(
            Around::between(
                [DVec3::ZERO, DVec3::X],
                DVec3::ZERO,
                [DVec3::X, DVec3::Y, DVec3::Z],
                radius,
                1.0
            )
            .is_none()
        );
    }

    /// Places more than four diameters apart along the rope are at least one diameter apart, and the centre line is outside
    /// the cylinder.
    #[test]
    #[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    fn a_hitch_touches_and_does_not_penetrate_itself() {
        let (radius, thick) = (0.055, 0.01);
        let ends = [DVec3::new(radius, -0.3, 0.01), DVec3::new(radius, 0.3, -0.01)];
        let around =
            Around::between(ends, DVec3::ZERO, [DVec3::X, DVec3::Y, DVec3::Z], radius, 2.0)
                .unwrap();
        let way: Vec<DVec3> = hitched(&around, thick).into_iter().step_by(5).collect();
        let mut along = vec![0.0];
        way.windows(2)
            .for_each(|pair| along.push(along[along.len() - 1] + pair[0].distance(pair[1])));
        let mut least = f64::INFINITY;
        for one in 0..way.len() {
            assert!(way[one].truncate().length() > radius - 1e-9);
            for other in one + 1..way.len() {
                if along[other] - along[one] > 4.0 * thick {
                    least = least.min(way[one].distance(way[other]));
                }
            }
        }
        assert!(least > 0.98 * thick && least < 1.2 * thick, "{least}");
    }
}

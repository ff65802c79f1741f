//! The place of an ellipse that is nearest to another place of its plane.
//!
//! With half axes `e₀ ≥ e₁`, a place `y₀, y₁ ≥ 0` and `z = y/e`, the nearest place is `x₀ = r y₀/(s + r)`, `x₁ = y₁/(s + 1)`, `r = (e₀/e₁)²`, where
//! `s > -1` solves
//!
//! ```text
//! |p(s)| = 1        p = (r z₀/(s + r), z₁/(s + 1))
//! ```
//!
//! Reference: Eberly, Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid (geometrictools.com/Documentation,
//! `DistancePointEllipseEllipsoid.pdf`). The root is found by Newton's method on `1 - 1/|p|`, which is convex and almost straight, so that it
//! closes in on the root from one side (Moré and Sorensen 1983, doi:10.1137/0904038).

/// Passes of Newton's method; four or five do unless a place lies all but on the longer axis.
const PASSES: usize = 100;

/// The place of the ellipse of these half axes about the origin that is nearest to a place; on the axes, one of the two that are.
pub(crate) fn nearest_on_ellipse(half: [f64; 2], place: [f64; 2]) -> [f64; 2] {
    let [x, y] = if half[0] >= half[1] {
        in_quadrant(half, place.map(f64::abs))
    } else {
        let [y, x] = in_quadrant([half[1], half[0]], [place[1].abs(), place[0].abs()]);
        [x, y]
    };
    [x.copysign(place[0]), y.copysign(place[1])]
}

fn in_quadrant([e0, e1]: [f64; 2], [y0, y1]: [f64; 2]) -> [f64; 2] {
    if y1 <= 0.0 {
        let (numerator, denominator) = (e0 * y0, e0 * e0 - e1 * e1);
        if numerator >= denominator {
            return [e0, 0.0];
        }
        let share = numerator / denominator;
        return [e0 * share, e1 * libm::sqrt(1.0 - share * share)];
    }
    if y0 <= 0.0 {
        return [0.0, e1];
    }
    let ratio = (e0 / e1) * (e0 / e1);
    let s = root(ratio, y0 / e0, y1 / e1);
    [ratio * y0 / (s + ratio), y1 / (s + 1.0)]
}

fn root(ratio: f64, z0: f64, z1: f64) -> f64 {
    let n0 = ratio * z0;
    // One term alone is one there, so the root lies beyond.
    let mut s = (z1 - 1.0).max(n0 - ratio);
    if z0 * z0 + z1 * z1 >= 1.0 {
        s = s.max(0.0);
    }
    for _ in 0..PASSES {
        let (p0, p1) = (n0 / (s + ratio), z1 / (s + 1.0));
        let square = p0 * p0 + p1 * p1;
        let slope = p0 * p0 / (s + ratio) + p1 * p1 / (s + 1.0);
        let step = square / slope * (libm::sqrt(square) - 1.0);
        s += step;
        if step <= f64::EPSILON * (s + 1.0) {
            break;
        }
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The way to the nearest place lies along the ellipse's normal there, and no place of a net is nearer.
    #[test]
    fn it_is_the_foot_of_a_normal_and_nothing_is_nearer() {
        for half in [[0.4, 0.1], [0.15, 0.3], [0.2, 0.2], [1.0, 0.02]] {
            for k in 1..400 {
                let share = |step: f64| 2.0 * (f64::from(k) * step).fract() - 1.0;
                let place = [share(0.754_877_666), share(0.569_840_291)];
                let [x, y] = nearest_on_ellipse(half, place);
                let on = (x / half[0]) * (x / half[0]) + (y / half[1]) * (y / half[1]);
                assert!((on - 1.0).abs() < 1e-12, "{half:?} {place:?}: {on}");
                let normal = [x / (half[0] * half[0]), y / (half[1] * half[1])];
                let out = [place[0] - x, place[1] - y];
                let aside = out[0] * normal[1] - out[1] * normal[0];
                let lengths = libm::hypot(normal[0], normal[1]);
                assert!(aside.abs() < 1e-12 * lengths, "{half:?} {place:?}: {aside}");
                let far = libm::hypot(out[0], out[1]);
                for n in 0..1000 {
                    let angle = core::f64::consts::TAU * f64::from(n) / 1000.0;
                    let other = [half[0] * libm::cos(angle), half[1] * libm::sin(angle)];
                    let away = libm::hypot(place[0] - other[0], place[1] - other[1]);
                    assert!(far <= away + 1e-12, "{half:?} {place:?}: {far} {away}");
                }
            }
        }
    }

    #[test]
    fn places_on_the_axes_have_their_feet() {
        let near = |place| nearest_on_ellipse([0.4, 0.1], place);
        let is_at = |found: [f64; 2], wanted: [f64; 2]| {
            libm::hypot(found[0] - wanted[0], found[1] - wanted[1]) <= 0.0
        };
        assert!(is_at(near([0.0, 0.0]), [0.0, 0.1]));
        assert!(is_at(near([0.0, -3.0]), [0.0, -0.1]));
        assert!(is_at(near([-3.0, 0.0]), [-0.4, 0.0]));
        assert!(is_at(nearest_on_ellipse([0.1, 0.4], [0.2, 0.0]), [0.1, 0.0]));
        // Inside the evolute's cusp, the foot leaves the axis.
        let [x, y] = near([0.1, 0.0]);
        assert!((x - 0.4 * 0.04 / 0.15).abs() < 1e-15 && y > 0.05);
    }
}

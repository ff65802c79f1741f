//! Rope laid round a cylinder: straight to it, round it in a helix, straight away from it.
//!
//! Seen along the axis, let the centre be the origin and `ρ` the radius of the rope's centre line. The
//! straight rope from an end `p` to where it touches is `√(|p|² - ρ²)` long, and it touches
//! `acos(ρ/|p|)` further round. Along the axis the rope rises evenly with its length. Unrolled, it is a
//! straight line, and so it lies still without friction.

use std::f64::consts::TAU;

use endline_sim::DVec3;

/// A path round a cylinder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around {
    centre: DVec3,
    /// Axes across (two) and along.
    axes: [DVec3; 3],
    /// Radius of the path round [m].
    radius: f64,
    /// Direction of winding: 1 is right-handed about the axis.
    sense: f64,
    /// Angle at which it first touches [rad].
    first: f64,
    /// Straight, round, straight: length across the axis of each [m].
    parts: [f64; 3],
    /// Height along the axis at the two ends [m].
    heights: (f64, f64),
}

impl Around {
    /// The path between two places that comes nearest to so many turns; `None` where an end lies within the cylinder.
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

    /// Length across the axis of the whole [m].
    fn length(&self) -> f64 {
        self.parts.iter().sum()
    }

    /// Angle round the axis at a share of the whole, from where it first touches [rad].
    pub fn angle(&self, share: f64) -> f64 {
        (share * self.length() - self.parts[0]).clamp(0.0, self.parts[1]) / self.radius
    }

    /// Place at a share of the whole.
    pub fn at(&self, share: f64) -> DVec3 {
        self.shifted(share, 0.0, 0.0)
    }

    /// Place at a share of the whole, moved outward from the axis and up along it [m].
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_round_a_drum_ends_where_it_should_and_is_as_long_as_it_should_be() {
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
}

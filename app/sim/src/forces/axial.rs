//! Axial law of a segment: tension from strain and strain rate, without a branch.
//!
//! `T = EA ε + EA2 ε max(ε, 0) + BA ε̇`, and the caller lets it pull only while `T > 0`.
//! With `EA2 = 0` the law is linear. The soft toe of a new rope, `T = S (0.35 r + 0.65 r²)` with `r = ε/ε_b`, `S` the
//! strength and `ε_b` the stretch at break, is `EA = 0.35 S/ε_b`, `EA2 = 0.65 S/ε_b²`; below zero strain the law stays
//! linear, so that its slope has no jump. The law is convex and its slope never below `EA`: Newton's matrix stays
//! positive whatever the guess.
//!
//! Damping is a number `BA` [N s], or a ratio `ζ` of a segment's critical damping: the dashpot of a segment of length `l`
//! is `c = 2 ζ √(k m)` with `k = EA/l`, `m = mass·l`, which is `BA = c l = 2 ζ l √(EA·mass)`. Where the law is not linear
//! `EA` is its tangent at zero strain, so that `BA` does not change as the rope stretches: the dashpot then only takes
//! energy, and the named ratio is the greatest met. A mode of the rope with frequency `ω` has the ratio `ζ ω √(m/k)`;
//! the highest one of a chain of equal segments, `ω = 2 √(k/m)`, has `2ζ`.
//! Reference: Clough and Penzien 1975, Dynamics of Structures, chapter 12 (stiffness-proportional damping); the toe is
//! a fit to fishing rope (docs/physics.md, Rope law).

use crate::model::Rope;
use crate::simd::real::Real;

/// Axial law of one segment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Axial<R = f64> {
    /// Stiffness at zero strain [N].
    pub ea: R,
    /// Growth of the tension with the square of the strain [N].
    pub ea2: R,
    /// Damping: tension by strain rate [N s].
    pub damping: R,
}

impl Axial {
    /// The law of a segment of this unstretched length [m].
    pub fn of(rope: &Rope, length_m: f64) -> Self {
        let ratio = 2.0
            * rope.axial_damping_ratio
            * length_m
            * (rope.axial_stiffness_n * rope.mass_kg_m).sqrt();
        Self {
            ea: rope.axial_stiffness_n,
            ea2: rope.axial_stiffening_n,
            damping: rope.axial_damping_n_s + ratio,
        }
    }
}

impl<R: Real> Axial<R> {
    /// Tension from strain and strain rate [1/s]; below zero the segment is slack [N].
    #[inline(always)]
    pub fn tension(&self, strain: R, rate: R) -> R {
        ((self.ea + self.bent(strain)) * strain).plus(self.damping, rate)
    }

    /// Derivative of the tension by the strain, where a strain changes the strain rate by `rate_by_strain` [1/s] [N].
    #[inline(always)]
    pub fn slope(&self, strain: R, rate_by_strain: R) -> R {
        let bent = self.bent(strain);
        (self.ea + bent + bent).plus(self.damping, rate_by_strain)
    }

    #[inline(always)]
    fn bent(&self, strain: R) -> R {
        self.ea2 * strain.max(strain.splat(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The toe of 3/8 in polypropylene: strength 10,854 N at a stretch of 0.22.
    fn toe() -> Axial {
        let (strength, stretch) = (10_854.0, 0.22);
        Axial {
            ea: 0.35 * strength / stretch,
            ea2: 0.65 * strength / (stretch * stretch),
            damping: 0.0,
        }
    }

    #[test]
    fn toe_passes_through_its_named_points() {
        for (r, share) in [(0.0, 0.0), (0.5, 0.3375), (1.0, 1.0)] {
            assert!((toe().tension(0.22 * r, 0.0) - 10_854.0 * share).abs() < 1e-9);
        }
    }

    /// Work to break is the integral of the toe, `S ε_b (0.35/2 + 0.65/3)`, against Simpson's rule on the law.
    #[test]
    fn work_to_break_is_that_of_the_toe() {
        let expected = 10_854.0 * 0.22 * (0.35 / 2.0 + 0.65 / 3.0);
        let work = 0.22 / 6.0
            * (toe().tension(0.0, 0.0) + 4.0 * toe().tension(0.11, 0.0) + toe().tension(0.22, 0.0));
        assert!((work / expected - 1.0).abs() < 1e-12, "{work} against {expected}");
    }

    #[test]
    fn slope_is_the_derivative_on_both_sides_of_zero() {
        let law = Axial { damping: 3.0, ..toe() };
        for strain in [-0.05, -1e-3, 0.02, 0.15] {
            let step = 1e-6;
            let difference = (law.tension(strain + step, 40.0 * (strain + step))
                - law.tension(strain - step, 40.0 * (strain - step)))
                / (2.0 * step);
            assert!((law.slope(strain, 40.0) / difference - 1.0).abs() < 1e-6);
        }
    }
}

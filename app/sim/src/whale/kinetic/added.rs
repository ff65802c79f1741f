//! Added mass of a slender body: water that must be moved with it.
//!
//! Prolate spheroid of half axes `a` along and `b` across, `e² = 1 - b²/a²`, as shares of the displaced water:
//! `α₀ = 2(1-e²)/e³ (½ ln((1+e)/(1-e)) - e)`, `β₀ = 1/e² - (1-e²)/(2e³) ln((1+e)/(1-e))`,
//! `k₁ = α₀/(2-α₀)` along, `k₂ = β₀/(2-β₀)` across, and of the moment of inertia of the displaced water about a cross axis
//! `k' = e⁴ (β₀-α₀) / ((2-e²) (2e² - (2-e²)(β₀-α₀)))`. About its own axis it moves none; fins do: two plates of half span `s` and chord `c`
//! that stand off the axis move `(π/8) ρ c s⁴`.
//! References: Lamb 1932, Hydrodynamics, articles 114 and 115; Newman 1977, Marine Hydrodynamics, section 4.15 for the plates.

/// Shares of the displaced water that move with a prolate spheroid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    /// Along, `k₁`.
    pub along: f64,
    /// Across, `k₂`.
    pub across: f64,
    /// In rotation about a cross axis, `k'`.
    pub turning: f64,
}

/// Shares for a spheroid of a length over its breadth, above 1.
///
/// Errors are below 1e-9 for slendernesses of 1.05 and more; nearer to a sphere the difference of logarithms loses digits, and that of 1.05 is given.
#[must_use]
pub fn spheroid(slenderness: f64) -> Shares {
    let slenderness = slenderness.max(1.05);
    let square = 1.0 - 1.0 / (slenderness * slenderness);
    let e = square.sqrt();
    let log = libm::log1p(e) - libm::log1p(-e);
    let alpha = 2.0 * (1.0 - square) / (square * e) * (0.5 * log - e);
    let beta = 1.0 / square - (1.0 - square) / (2.0 * square * e) * log;
    let (less, more) = (2.0 - square, beta - alpha);
    Shares {
        along: alpha / (2.0 - alpha),
        across: beta / (2.0 - beta),
        turning: square * square * more / (less * (2.0 * square - less * more)),
    }
}

/// Added moment of inertia about the axis of a pair of fins of half span `s` and chord `c` [kg m²].
#[must_use]
pub fn fins(density_kg_m3: f64, half_span_m: f64, chord_m: f64) -> f64 {
    let square = half_span_m * half_span_m;
    core::f64::consts::FRAC_PI_8 * density_kg_m3 * chord_m * square * square
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_those_of_lambs_table() {
        // Lamb, article 115, printed to three places of which the last is out by up to two: slenderness, k1, k2, k'.
        let table = [
            (1.50, 0.305, 0.621, 0.094),
            (2.00, 0.209, 0.702, 0.240),
            (3.99, 0.082, 0.860, 0.608),
            (6.01, 0.045, 0.918, 0.764),
            (9.97, 0.021, 0.960, 0.883),
        ];
        for (slenderness, along, across, turning) in table {
            let shares = spheroid(slenderness);
            for (ours, lamb) in
                [(shares.along, along), (shares.across, across), (shares.turning, turning)]
            {
                assert!((ours - lamb).abs() < 2.5e-3, "{slenderness}: {ours} against {lamb}");
            }
        }
    }
}

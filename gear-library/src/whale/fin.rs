//! The section of a fin: a flat lens with rounded edges, and how it ends at a tip.

use std::f64::consts::TAU;

use glam::DVec2;

/// Least half chord and half thickness, so that any form has a section [m].
const LEAST_M: f64 = 1e-6;

/// One section of a fin in its own plane: `x` ahead along the chord, `z` across the thickness [m].
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Leading edge [m].
    pub lead: f64,
    /// Trailing edge [m].
    pub trail: f64,
    /// Half the greatest thickness [m].
    pub half_thickness: f64,
    /// Radius of both edges [m].
    pub edge_radius: f64,
}

impl Section {
    /// The corner at a share of the way round, from the leading edge over the upper side, and its
    /// place along the chord from -1 (trailing edge) to 1 (leading edge).
    ///
    /// A flat lens rolled round by a disc of the edge's radius: the edges are as blunt as asked for,
    /// and equal steps crowd where the outline turns.
    #[must_use]
    pub fn corner(&self, share: f64) -> (f64, f64, f64) {
        let half_chord = ((self.lead - self.trail) / 2.0).max(LEAST_M);
        let half_thickness = self.half_thickness.max(LEAST_M);
        let radius = self.edge_radius.min(0.9 * half_thickness).min(0.45 * half_chord);
        let long = half_chord - radius;
        let short = (half_thickness - radius).max(0.03 * long);
        let turn = TAU * share;
        let crowd = libm::pow(short / long, 0.6);
        let around = libm::atan2(crowd * libm::sin(turn), libm::cos(turn));
        let (cos, sin) = (libm::cos(around), libm::sin(around));
        let normal = DVec2::new(cos / long, sin / short).normalize();
        let x = long * cos + radius * normal.x;
        let z = short * sin * (1.0 + 0.25 * cos * sin * sin) + radius * normal.y;
        ((self.lead + self.trail) / 2.0 + x, z, x / half_chord)
    }
}

/// How much of chord and of thickness is left near a tip that rounds off; `blunt` is high for a square tip.
#[must_use]
pub fn tip_rounding(s: f64, blunt: f64) -> f64 {
    libm::sqrt((1.0 - libm::pow(s.clamp(0.0, 1.0), blunt)).max(0.0))
}

/// Exponent that rounds a tip of some half thickness to a radius over a span.
#[must_use]
pub fn tip_bluntness(radius: f64, span: f64, half_thickness: f64) -> f64 {
    (2.0 * radius * span / (half_thickness * half_thickness).max(LEAST_M * LEAST_M))
        .clamp(8.0, 80.0)
}

/// Shares of the span at which a fin's rings stand, without its root (0) and tip (1): close at the root's fillet and at the tip.
#[must_use]
pub fn spans(rings: usize) -> Vec<f64> {
    (1..rings)
        .map(|ring| {
            let share = ring as f64 / rings as f64;
            let slow = 1.0 - libm::pow(1.0 - share, 2.2);
            slow * libm::pow(share, 0.45)
        })
        .collect()
}

/// How much of a fillet is left at a share of the span, 1 at the root; `s` runs out slowly at first, so the skin bends round smoothly.
#[must_use]
pub fn fillet(s: f64, reach: f64) -> f64 {
    let left = (1.0 - libm::pow((s / reach).clamp(0.0, 1.0), 0.6)).max(0.0);
    left * left
}

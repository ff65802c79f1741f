//! How far apart rope and knots are looked for.

use crate::whale::Bounds;

/// How far apart things are looked for [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    /// Segments.
    pub ropes_m: f64,
    /// Knots from segments; not less.
    pub knots_m: f64,
}

impl Reach {
    /// A box around a segment or more, grown so that two of them meet within reach.
    #[inline(always)]
    pub fn of_segment(&self, bounds: &Bounds) -> Bounds {
        bounds.grown(0.5 * self.ropes_m)
    }

    /// The greater of the two, with a little for what rounding may take [m].
    pub fn farthest_m(&self) -> f64 {
        self.ropes_m.max(self.knots_m) + 2e-9
    }
}

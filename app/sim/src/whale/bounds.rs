//! Boxes along the axes, for the search of what is near.

use glam::DVec3;

/// A box along the axes; the empty box has `low` above `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least corner [m].
    pub low: DVec3,
    /// Greatest corner [m].
    pub high: DVec3,
}

impl Bounds {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The least box around points.
    #[must_use]
    pub fn around(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |bounds, &point| bounds.with(point))
    }

    /// Grown to hold a point.
    #[must_use]
    pub fn with(self, point: DVec3) -> Self {
        Self { low: self.low.min(point), high: self.high.max(point) }
    }

    /// Grown to hold another box.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Grown by a margin on every side [m].
    #[must_use]
    pub fn grown(self, margin: f64) -> Self {
        Self { low: self.low - margin, high: self.high + margin }
    }

    /// Whether the two have a point in common.
    #[inline]
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        (self.low.x <= other.high.x)
            & (other.low.x <= self.high.x)
            & (self.low.y <= other.high.y)
            & (other.low.y <= self.high.y)
            & (self.low.z <= other.high.z)
            & (other.low.z <= self.high.z)
    }

    /// Whether another lies in it.
    #[inline]
    #[must_use]
    pub fn holds(&self, other: &Self) -> bool {
        (self.low.x <= other.low.x)
            & (self.low.y <= other.low.y)
            & (self.low.z <= other.low.z)
            & (other.high.x <= self.high.x)
            & (other.high.y <= self.high.y)
            & (other.high.z <= self.high.z)
    }

    /// Distance between the two, zero where they meet [m].
    #[must_use]
    pub fn gap(&self, other: &Self) -> f64 {
        (self.low - other.high).max(other.low - self.high).max(DVec3::ZERO).length()
    }

    /// Length of the longest side [m].
    #[must_use]
    pub fn longest(&self) -> f64 {
        (self.high - self.low).max_element()
    }
}

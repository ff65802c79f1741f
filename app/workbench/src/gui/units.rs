//! Units of labels: forces in lbf or N, and the compass.

use serde::{Deserialize, Serialize};

use crate::scene::N_PER_LBF;

/// Unit that forces are shown in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ForceUnit {
    /// Pounds-force, as breaking strengths are given in the trade.
    #[default]
    Lbf,
    /// Newtons.
    Newton,
}

impl ForceUnit {
    /// Its symbol.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Lbf => "lbf",
            Self::Newton => "N",
        }
    }

    /// A force given in newtons, in this unit.
    #[must_use]
    pub fn of_newtons(self, force_n: f64) -> f64 {
        match self {
            Self::Lbf => force_n / N_PER_LBF,
            Self::Newton => force_n,
        }
    }

    /// A force given in newtons, as text with its unit.
    #[must_use]
    pub fn text(self, force_n: f64) -> String {
        let value = self.of_newtons(force_n);
        let digits = usize::from(value.abs() < 100.0);
        format!("{value:.digits$} {}", self.symbol())
    }
}

/// Compass bearing of a heading in the world: 0 north, 90 east [degrees, 0 to 360).
#[must_use]
pub fn bearing_degrees(east: f64, north: f64) -> f64 {
    east.atan2(north).to_degrees().rem_euclid(360.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seventeen_hundred_pounds_are_the_newtons_of_the_weak_rope_rule() {
        assert_eq!(ForceUnit::Lbf.text(7_561.976_746), "1700 lbf");
        assert_eq!(ForceUnit::Newton.text(7_561.976_746), "7562 N");
        assert_eq!(ForceUnit::Newton.text(12.34), "12.3 N");
    }

    #[test]
    fn bearings_run_clockwise_from_north() {
        for (east, north, bearing) in [(0.0, 1.0, 0.0), (1.0, 0.0, 90.0), (0.0, -1.0, 180.0), (-1.0, 0.0, 270.0)] {
            assert!((bearing_degrees(east, north) - bearing).abs() < 1e-9);
        }
    }
}

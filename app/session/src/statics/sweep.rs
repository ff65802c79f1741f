//! One gear at rest over depths of water and currents.

use endline_sim::model::{Body, BodyRole};
use endline_sim::{DQuat, DVec3};

use super::{RigAtRest, Trial, TrialGear, TrialSea};
use crate::settled::BodyShape;
use crate::units::{METRES_PER_FATHOM, Units};

/// Depths of water [fathom].
const DEPTHS_FATHOM: [f64; 6] = [5.0, 10.0, 20.0, 40.0, 60.0, 100.0];

/// Surface speeds of the current [kn].
const CURRENTS_KN: [f64; 5] = [0.0, 0.5, 1.0, 1.5, 2.0];

/// Depths of water, the rows of the table [m].
pub fn depths_m() -> [f64; DEPTHS_FATHOM.len()] {
    DEPTHS_FATHOM.map(|fathom| fathom * METRES_PER_FATHOM)
}

/// Surface speeds of the current, the columns of the table [m/s].
pub fn currents_m_s() -> [f64; CURRENTS_KN.len()] {
    CURRENTS_KN.map(|knots| Units::Noaa.to_m_s(knots))
}

/// Trials of a gear in all depths and currents, row by row.
pub fn trials(gear: &TrialGear) -> Vec<Trial> {
    let in_depth = |fathom: f64| {
        currents_m_s().map(|current_m_s| Trial {
            gear: gear.clone(),
            sea: TrialSea {
                depth: Some(format!("{fathom} fathom")),
                current_m_s: Some(current_m_s),
            },
        })
    };
    DEPTHS_FATHOM.into_iter().flat_map(in_depth).collect()
}

impl RigAtRest {
    /// The greatest tension in any line [N].
    pub fn greatest_tension_n(&self) -> f64 {
        let tensions = self.shape.lines.iter().flat_map(|line| &line.tension_N);
        tensions.copied().fold(0.0, f64::max)
    }

    /// Whether the highest point of any buoy is below the calm surface.
    pub fn has_buoy_under_water(&self) -> bool {
        let bodies = self.model.spec.bodies.iter().zip(&self.shape.bodies);
        let mut buoys = bodies.filter(|(body, _)| body.role == BodyRole::Buoy);
        buoys.any(|(body, at)| top_m(body, at) < 0.0)
    }
}

/// Height of a body's highest point above the calm surface [m].
pub fn top_m(body: &Body, at: &BodyShape) -> f64 {
    let turn = DQuat::from_array(at.orientation);
    let heights = body.corners().map(|corner| (turn * corner).z);
    DVec3::from_array(at.position_m).z + heights.fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trials_are_in_the_order_of_rows_and_columns() {
        let trials = trials(&TrialGear::Own);
        assert_eq!(trials.len(), depths_m().len() * currents_m_s().len());
        let last = &trials[trials.len() - 1].sea;
        assert_eq!(last.depth.as_deref(), Some("100 fathom"));
        // A fathom is 6 ft of 0.3048 m, a knot 1852 m in an hour.
        assert!((depths_m()[5] - 600.0 * 0.3048).abs() < 1e-9);
        assert!((currents_m_s()[4] - 2.0 * 1852.0 / 3600.0).abs() < 1e-9);
        assert_eq!(last.current_m_s, Some(currents_m_s()[4]));
    }
}

//! Water and current.
//!
//! Power-law profile: `U(z) = U_s ((z + d) / d)^p`, with `U_s` the surface speed, `d` the depth
//! and `p` the exponent (1/7 for a tidal stream); zero below the seabed, `U_s` above the surface.

use glam::DVec3;

/// The sea around the gear.
#[derive(Clone, Debug, PartialEq)]
pub struct Water {
    /// Density [kg/m³]; zero for a vacuum.
    pub density_kg_m3: f64,
    /// Gravity, pointing down [m/s²].
    pub gravity_m_s2: f64,
    /// Water depth [m].
    pub depth_m: f64,
    /// Whether rope above z = 0 is dry; off, water drags and lifts it at any height.
    pub rope_dries: bool,
    /// Current.
    pub current: Current,
}

/// Steady current as a function of height.
#[derive(Clone, Debug, PartialEq)]
pub struct Current {
    /// Velocity at the surface [m/s].
    pub surface_m_s: DVec3,
    /// Exponent of the power law; zero for a uniform current.
    pub exponent: f64,
}

impl Water {
    /// Velocity of the water at a place [m/s].
    #[must_use]
    pub fn velocity(&self, place: DVec3) -> DVec3 {
        if self.current.exponent <= 0.0 {
            return self.current.surface_m_s;
        }
        let height = ((place.z + self.depth_m) / self.depth_m).clamp(0.0, 1.0);
        self.current.surface_m_s * libm::pow(height, self.current.exponent)
    }
}

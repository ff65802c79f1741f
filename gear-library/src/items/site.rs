//! A place at sea.

use crate::entry::Entry;

use super::rope::GRAVITY_M_S2;

/// A site: water, running tide and seabed.
#[derive(Clone, Debug, PartialEq)]
pub struct SeaSite {
    /// Its file.
    pub entry: Entry,
    /// Water depth [m].
    pub depth_m: f64,
    /// Density of the water [kg/m³].
    pub density_kg_m3: f64,
    /// Gravity [m/s²].
    pub gravity_m_s2: f64,
    /// Surface speed of a running tide [m/s].
    pub current_m_s: f64,
    /// Exponent of the current's power law.
    pub current_exponent: f64,
    /// Slope of the seabed [rad].
    pub slope_rad: f64,
    /// Compass bearing towards which it falls [rad].
    pub slope_toward_rad: f64,
    /// Friction of rope on it.
    pub rope_friction: f64,
    /// Its stiffness under rope [N/m²].
    pub rope_stiffness_n_m2: f64,
    /// Its stiffness under one corner of a trap [N/m].
    pub foot_stiffness_n_m: f64,
}

impl SeaSite {
    /// From a file's figures; `None` where one is missing, which is a problem already told.
    pub(crate) fn from_entry(entry: Entry) -> Option<Self> {
        Some(Self {
            depth_m: entry.value("depth")?,
            density_kg_m3: entry.value("density")?,
            gravity_m_s2: entry.value("gravity").unwrap_or(GRAVITY_M_S2),
            current_m_s: entry.value("current")?,
            current_exponent: entry.value("current_exponent")?,
            slope_rad: entry.value("slope").unwrap_or(0.0),
            slope_toward_rad: entry.value("slope_toward").unwrap_or(0.0),
            rope_friction: entry.value("rope_friction")?,
            rope_stiffness_n_m2: entry.value("rope_stiffness")?,
            foot_stiffness_n_m: entry.value("foot_stiffness")?,
            entry,
        })
    }
}

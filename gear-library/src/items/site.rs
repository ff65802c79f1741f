//! A place at sea.

use crate::entry::Entry;
use crate::fields::Problems;

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
    /// Speed of a running tide at the surface or at `current_height_m` [m/s].
    pub current_m_s: f64,
    /// Height above the seabed at which the speed applies; `None` for the surface [m].
    pub current_height_m: Option<f64>,
    /// Exponent of a power law of the current.
    pub current_exponent: Option<f64>,
    /// Roughness length of the bed of a logarithmic law [m].
    pub current_roughness_m: Option<f64>,
    /// Slope of the seabed [rad].
    pub slope_rad: f64,
    /// Compass bearing towards which the seabed falls [rad].
    pub slope_toward_rad: f64,
    /// Friction of rope on the seabed.
    pub rope_friction: f64,
    /// Stiffness of the seabed under rope [N/m²].
    pub rope_stiffness_n_m2: f64,
    /// Stiffness of the seabed under one corner of a trap [N/m].
    pub foot_stiffness_n_m: f64,
}

impl SeaSite {
    /// Builds it from a file's figures; `None` if one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry, problems: &Problems) -> Option<Self> {
        check_law(&entry, problems);
        Some(Self {
            depth_m: entry.value("depth")?,
            density_kg_m3: entry.value("density")?,
            gravity_m_s2: entry.value("gravity").unwrap_or(GRAVITY_M_S2),
            current_m_s: entry.value("current")?,
            current_height_m: entry.value("current_height"),
            current_exponent: entry.value("current_exponent"),
            current_roughness_m: entry.value("current_roughness"),
            slope_rad: entry.value("slope").unwrap_or(0.0),
            slope_toward_rad: entry.value("slope_toward").unwrap_or(0.0),
            rope_friction: entry.value("rope_friction")?,
            rope_stiffness_n_m2: entry.value("rope_stiffness")?,
            foot_stiffness_n_m: entry.value("foot_stiffness")?,
            entry,
        })
    }
}

/// Checks that the current has one law and that the height of its speed is within the water.
fn check_law(entry: &Entry, problems: &Problems) {
    let help = "write current_exponent = 0.142857 for a power law, or current_roughness = \"3 mm\" for a logarithmic one";
    match (entry.figure("current_exponent"), entry.figure("current_roughness")) {
        (None, None) => problems.push(
            entry
                .place
                .error("the current has neither `current_exponent` nor `current_roughness`", help),
        ),
        (Some(_), Some(roughness)) => {
            problems.push(
                roughness
                    .place
                    .error("both `current_exponent` and `current_roughness` are present", help),
            );
        }
        _ => {}
    }
    if let (Some(height), Some(depth)) = (entry.figure("current_height"), entry.value("depth"))
        && height.value > depth
    {
        let message = format!("`current_height` is above the surface: the water is {depth} m deep");
        problems
            .push(height.place.error(message, "write a height above the seabed within the water"));
    }
}

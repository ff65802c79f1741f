//! The sea of a scenario: site, seabed, current and waves.

use endline_sim::water::waves::Waves;

use crate::diagnostic::{At, Place};
use crate::fields::{Fields, Range};
use crate::units::Quantity;

use super::current::{self, CurrentOf};
use super::waves;

/// Site, seabed, current and waves.
#[derive(Clone, Debug, PartialEq)]
pub struct Sea {
    /// Library site, if one is named.
    pub item: Option<At<String>>,
    /// Depth, over the site's [m].
    pub depth_m: Option<f64>,
    /// Density, over the site's [kg/m³].
    pub density_kg_m3: Option<f64>,
    /// Gravity, over the site's [m/s²].
    pub gravity_m_s2: Option<f64>,
    /// Whether rope above the surface is dry.
    pub rope_dries: bool,
    /// The seabed; `None` where the scenario takes it away.
    pub seabed: Option<Bed>,
    /// The current.
    pub current: CurrentOf,
    /// The waves, if any, with the place of their height.
    pub waves: Option<At<Waves>>,
    /// Where `[site]` stands.
    pub place: Place,
}

/// What a scenario says of the seabed, over its site.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bed {
    /// Slope [rad].
    pub slope_rad: Option<f64>,
    /// Compass bearing towards which it falls [rad].
    pub toward_rad: Option<f64>,
    /// Friction of rope.
    pub rope_friction: Option<f64>,
    /// Stiffness under rope [N/m²].
    pub rope_stiffness_n_m2: Option<f64>,
    /// Stiffness under one corner of a trap [N/m].
    pub foot_stiffness_n_m: Option<f64>,
}

/// `[site]`, `[current]` and `[waves]`.
pub(super) fn read(fields: &Fields<'_>) -> Sea {
    let site = fields.table("site");
    let current = fields.table("current");
    let waves = fields.table("waves").as_ref().and_then(waves::read);
    let mut sea = Sea {
        item: None,
        depth_m: None,
        density_kg_m3: None,
        gravity_m_s2: None,
        rope_dries: true,
        seabed: Some(Bed::default()),
        current: current.as_ref().map_or_else(|| CurrentOf::of_site(fields.place), current::read),
        waves,
        place: site.as_ref().map_or_else(|| fields.place.clone(), |site| site.place.clone()),
    };
    match site {
        Some(site) => read_site(&site, &mut sea),
        None => fields.missing(
            "site",
            "write [site] with item = \"cape-cod-bay\", or with depth and density",
        ),
    }
    sea
}

fn read_site(site: &Fields<'_>, sea: &mut Sea) {
    let value = |key, quantity, range| site.value(key, quantity, range).map(|value| value.value);
    sea.item = site.text("item");
    sea.depth_m = value("depth", Quantity::Length, Range::Between(0.5, 6000.0));
    sea.density_kg_m3 = value("density", Quantity::Density, Range::Between(0.0, 2000.0));
    sea.gravity_m_s2 = value("gravity", Quantity::Acceleration, Range::Between(0.0, 20.0));
    let bed = Bed {
        slope_rad: value("slope", Quantity::Angle, Range::Between(0.0, 1.0)),
        toward_rad: value("slope_toward", Quantity::Angle, Range::Any),
        rope_friction: value("rope_friction", Quantity::Ratio, Range::Between(0.0, 10.0)),
        rope_stiffness_n_m2: value("rope_stiffness", Quantity::Pressure, Range::Positive),
        foot_stiffness_n_m: value("foot_stiffness", Quantity::ForceByLength, Range::Positive),
    };
    sea.seabed = site.flag("seabed").unwrap_or(true).then_some(bed);
    sea.rope_dries = site.flag("rope_dries").unwrap_or(true);
    if sea.item.is_none() && sea.depth_m.is_none() {
        site.missing("depth", "name a site of the library as `item`, or give a depth such as 25 m");
    }
    if sea.item.is_none() && sea.density_kg_m3.is_none() {
        site.missing("density", "name a site of the library as `item`, or give a density such as 1025 kg/m3; 0 kg/m3 is a vacuum");
    }
    site.finish();
}

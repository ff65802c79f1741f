//! Water and seabed.

use endline_sim::DVec3;
use endline_sim::model::Seabed;
use endline_sim::water::{Current, Water};

use crate::items::SeaSite;
use crate::schema::Kind;

use super::builder::Builder;

/// What a scenario without a library site has for its seabed.
const ROPE_FRICTION: f64 = 0.5;
const ROPE_STIFFNESS_N_M2: f64 = 5e3;
const FOOT_STIFFNESS_N_M: f64 = 2e4;

/// East and north of a compass bearing.
pub(super) fn bearing(bearing_rad: f64) -> DVec3 {
    let clean = |share: f64| if share.abs() < 1e-15 { 0.0 } else { share };
    DVec3::new(clean(libm::sin(bearing_rad)), clean(libm::cos(bearing_rad)), 0.0)
}

impl Builder<'_> {
    /// Water and seabed from the scenario over its site.
    pub fn add_sea(&mut self) {
        let sea = &self.scenario.sea;
        let site = sea.item.as_ref().and_then(|item| {
            let site = self.library.sites.iter().find(|site| site.entry.id == item.value);
            if site.is_none() {
                self.no_item(Kind::Site, &item.value, &item.place);
            }
            site
        });
        if let Some(site) = site {
            self.uses(&site.entry.path);
        }
        let from_site = |own: Option<f64>, of: fn(&SeaSite) -> f64, usual: f64| own.unwrap_or_else(|| site.map_or(usual, of));
        let depth_m = from_site(sea.depth_m, |site| site.depth_m, 1.0);
        let speed = from_site(sea.current_m_s, |site| site.current_m_s, 0.0);
        let exponent = from_site(sea.exponent, |site| site.current_exponent, 0.0);
        self.spec.water = Water {
            density_kg_m3: from_site(sea.density_kg_m3, |site| site.density_kg_m3, 0.0),
            gravity_m_s2: from_site(sea.gravity_m_s2, |site| site.gravity_m_s2, 9.81),
            depth_m,
            rope_dries: sea.rope_dries,
            current: Current::power(bearing(sea.toward_rad) * speed, exponent),
            waves: None,
        };
        self.spec.seabed = sea.seabed.then(|| seabed(depth_m, site));
    }

    /// Height of the seabed below a place [m].
    pub fn seabed_height(&self, place: DVec3) -> f64 {
        let depth = self.spec.water.depth_m;
        self.spec.seabed.as_ref().map_or(-depth, |bed| -depth - (bed.normal.x * place.x + bed.normal.y * place.y) / bed.normal.z)
    }
}

/// A plane that falls by the site's slope towards its bearing.
fn seabed(depth_m: f64, site: Option<&SeaSite>) -> Seabed {
    let slope = site.map_or(0.0, |site| site.slope_rad);
    let toward = bearing(site.map_or(0.0, |site| site.slope_toward_rad));
    Seabed {
        depth_m,
        normal: toward * libm::sin(slope) + DVec3::Z * libm::cos(slope),
        rope_stiffness_n_m2: site.map_or(ROPE_STIFFNESS_N_M2, |site| site.rope_stiffness_n_m2),
        foot_stiffness_n_m: site.map_or(FOOT_STIFFNESS_N_M, |site| site.foot_stiffness_n_m),
        rope_friction: site.map_or(ROPE_FRICTION, |site| site.rope_friction),
    }
}

//! Adds water and seabed to the spec.

use endline_sim::DVec3;
use endline_sim::model::Seabed;
use endline_sim::water::current::{Profile, ProfileRow};
use endline_sim::water::waves::breaking_height;
use endline_sim::water::{Current, Water};

use crate::items::SeaSite;
use crate::scenario::direction;
use crate::scenario::{Bed, CurrentOf};
use crate::schema::Kind;

use super::builder::Builder;

/// Default seabed of a scenario without a library site.
const ROPE_FRICTION: f64 = 0.5;
const ROPE_STIFFNESS_N_M2: f64 = 5e3;
const FOOT_STIFFNESS_N_M: f64 = 2e4;
/// Tolerance of the heights of a profile for rounding, as a share of the depth.
const ROUNDING: f64 = 1e-9;

impl Builder<'_> {
    /// Adds water and seabed; the scenario overrides its site.
    pub fn add_sea(&mut self) {
        let sea = &self.scenario.sea;
        let sites = &self.library.sites;
        let site = sea.item.as_ref();
        let site = site.and_then(|id| self.item(Kind::Site, id, sites, |site| &site.entry));
        let from_site = |own: Option<f64>, of: fn(&SeaSite) -> f64, usual: f64| {
            own.unwrap_or_else(|| site.map_or(usual, of))
        };
        let depth_m = from_site(sea.depth_m, |site| site.depth_m, 1.0);
        self.spec.water = Water {
            density_kg_m3: from_site(sea.density_kg_m3, |site| site.density_kg_m3, 0.0),
            gravity_m_s2: from_site(sea.gravity_m_s2, |site| site.gravity_m_s2, 9.81),
            depth_m,
            rope_dries: sea.rope_dries,
            current: self.current(&sea.current, site, depth_m),
            waves: sea.waves.as_ref().map(|waves| waves.value.clone()),
        };
        self.spec.seabed = sea.seabed.as_ref().map(|bed| seabed(bed, depth_m, site));
        self.check_waves();
    }

    fn current(&self, current: &CurrentOf, site: Option<&SeaSite>, depth_m: f64) -> Current {
        if !current.rows.is_empty() {
            return self.tabled(current, depth_m);
        }
        let profile = law(current, site, depth_m);
        let (speed, height_m) = match current.speed_m_s {
            Some(speed) => (speed, current.speed_height_m.as_ref().map(|height| height.value)),
            None => site.map_or((0.0, None), |site| (site.current_m_s, site.current_height_m)),
        };
        if let Some(height) =
            current.speed_height_m.as_ref().filter(|height| height.value > depth_m)
        {
            let message = format!("`speed_height` is outside the water, which is {depth_m} m deep");
            self.problems.push(
                height.place.error(message, "write a height above the seabed within the water"),
            );
        }
        // In shallower water than the site's, the surface replaces its height.
        let share =
            height_m.map_or(1.0, |height| profile.turn(DVec3::X, (height / depth_m).min(1.0)).x);
        Current {
            surface_m_s: direction(current.toward_rad) * (speed / share),
            profile,
            tide: current.tide.clone(),
        }
    }

    /// A profile in rows, relative to the fastest row, which is the velocity that the tide turns.
    fn tabled(&self, current: &CurrentOf, depth_m: f64) -> Current {
        let by_speed = |row: &&crate::scenario::CurrentRow| row.velocity_m_s.length_squared();
        let fastest =
            current.rows.iter().max_by(|one, other| by_speed(one).total_cmp(&by_speed(other)));
        let fastest = fastest.map_or(DVec3::ZERO, |row| row.velocity_m_s);
        let whole = fastest.length_squared();
        let left = DVec3::new(-fastest.y, fastest.x, 0.0);
        let share =
            |velocity: DVec3, way: DVec3| if whole > 0.0 { velocity.dot(way) / whole } else { 0.0 };
        let mut rows = Vec::new();
        for row in &current.rows {
            let height = row.at.value.share(depth_m);
            if !(-ROUNDING..=1.0 + ROUNDING).contains(&height) {
                let message = format!("this row is outside the water, which is {depth_m} m deep");
                self.problems.push(row.at.place.error(
                    message,
                    "write a height above the seabed, or a depth, within the water",
                ));
            }
            if rows.iter().any(|known: &ProfileRow| (known.height - height).abs() < ROUNDING) {
                self.problems
                    .push(row.at.place.error("there are two rows at this height", "remove one"));
            }
            rows.push(ProfileRow {
                height,
                along: share(row.velocity_m_s, fastest),
                left: share(row.velocity_m_s, left),
            });
        }
        rows.sort_by(|one, other| one.height.total_cmp(&other.height));
        Current { surface_m_s: fastest, profile: Profile::Table(rows), tide: current.tide.clone() }
    }

    /// Reports waves that would break.
    fn check_waves(&self) {
        let (Some(waves), water) = (&self.scenario.sea.waves, &self.spec.water) else { return };
        let (height, period) = waves.value.height_and_period();
        if water.gravity_m_s2 <= 0.0 || water.density_kg_m3 <= 0.0 {
            self.problems.push(waves.place.error(
                "waves without gravity or water",
                "write gravity and density of the site, or remove [waves]",
            ));
            return;
        }
        let greatest = breaking_height(period, water.depth_m, water.gravity_m_s2);
        if height > greatest {
            let message =
                format!("waves of {height} m and {period} s break in {} m of water", water.depth_m);
            self.problems.push(
                waves.place.error(
                    message,
                    format!("expected {greatest:.2} m at most, or a longer period"),
                ),
            );
        }
    }

    /// Height of the seabed at a place, negative [m].
    pub fn seabed_height(&self, place: DVec3) -> f64 {
        self.spec.seabed.as_ref().map_or(-self.spec.water.depth_m, |bed| bed.height_at(place))
    }
}

/// The current by height: the law of the scenario, else of its site, else uniform.
fn law(current: &CurrentOf, site: Option<&SeaSite>, depth_m: f64) -> Profile {
    match (current.exponent, current.roughness_m) {
        (Some(exponent), _) => Profile::power(exponent),
        (None, Some(roughness_m)) => Profile::Log(roughness_m / depth_m),
        (None, None) => match site.map(|site| (site.current_exponent, site.current_roughness_m)) {
            Some((None, Some(roughness_m))) => Profile::Log(roughness_m / depth_m),
            Some((Some(exponent), _)) => Profile::power(exponent),
            _ => Profile::Uniform,
        },
    }
}

/// The seabed: a plane with a slope towards a bearing.
fn seabed(bed: &Bed, depth_m: f64, site: Option<&SeaSite>) -> Seabed {
    let from_site = |own: Option<f64>, of: fn(&SeaSite) -> f64, usual: f64| {
        own.unwrap_or_else(|| site.map_or(usual, of))
    };
    let slope = from_site(bed.slope_rad, |site| site.slope_rad, 0.0);
    let toward = direction(from_site(bed.toward_rad, |site| site.slope_toward_rad, 0.0));
    Seabed {
        depth_m,
        normal: toward * libm::sin(slope) + DVec3::Z * libm::cos(slope),
        rope_stiffness_n_m2: from_site(
            bed.rope_stiffness_n_m2,
            |site| site.rope_stiffness_n_m2,
            ROPE_STIFFNESS_N_M2,
        ),
        foot_stiffness_n_m: from_site(
            bed.foot_stiffness_n_m,
            |site| site.foot_stiffness_n_m,
            FOOT_STIFFNESS_N_M,
        ),
        rope_friction: from_site(bed.rope_friction, |site| site.rope_friction, ROPE_FRICTION),
    }
}

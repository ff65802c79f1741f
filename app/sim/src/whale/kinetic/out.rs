//! A living whale's weight in air: what is out of the water is no longer carried.
//!
//! ```text
//! F = -ρ g (V - V_wet) ẑ      at the middle of what is dry;      M = r_dry × F
//! ```
//!
//! `V` is the volume of its skin at rest, `V_wet` what of it lies below the surface over its centre, as by `hull`; `r` is measured
//! from its centre of mass. Deep down both are nothing: what it then weighs in water is `Kinetic::buoyancy`.
//! So a whale that swims up out of the sea at `u` comes `u √(L/g)` of its length out before its weight stops it, if it is as thick all along.

use glam::DVec3;

use super::Kinetic;
use super::pull::centre_of;
use crate::model::Model;
use crate::state::WhaleState;

/// Deeper than this no part is ever out, whatever the sea [m].
const HIGHEST_WAVE_M: f64 = 20.0;

/// Force and moment about its centre of mass, in its own axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Weight {
    pub force: DVec3,
    pub moment: DVec3,
}

/// What the dry part of a whale weighs; `hull_scratch` is scratch of its hull.
pub(crate) fn weight_out(
    model: &Model,
    kinetic: &Kinetic,
    whale: &WhaleState,
    time_s: f64,
    hull_scratch: &mut Vec<DVec3>,
) -> Weight {
    let (hull, centre) = (&kinetic.hull, centre_of(kinetic, whale));
    let reach_m = hull.reach_m + kinetic.centre_m.length();
    if hull.volume_m3 <= 0.0 || centre.z + reach_m < -HIGHEST_WAVE_M {
        return Weight::default();
    }
    let height_m = centre.z - model.sea.at(centre, time_s).surface_m;
    if height_m + reach_m < 0.0 {
        return Weight::default();
    }
    let wet = hull.wetted(kinetic.centre_m, whale.orientation, height_m, hull_scratch);
    let middle = whale.orientation * (hull.middle_m - kinetic.centre_m) * hull.volume_m3;
    let lift = model.spec.water.density_kg_m3 * model.spec.water.gravity_m_s2;
    let [east, north] = [wet.moment_m4[0] - middle.x, wet.moment_m4[1] - middle.y];
    let inward = whale.orientation.conjugate();
    Weight {
        force: inward * DVec3::Z * (lift * (wet.volume_m3 - hull.volume_m3).min(0.0)),
        moment: inward * DVec3::new(north, -east, 0.0) * lift,
    }
}

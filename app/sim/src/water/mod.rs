//! Water: density, depth, current and waves.
//!
//! Velocity `u = S(t) p(h) + u_w(x, t)` [m/s], with `S` the velocity of the current at its fastest height as a function of the
//! tide, `p` its profile over the height ([`current`]), and `u_w` the orbital velocity of waves ([`waves`], [`field`]).
//! `h` is the height above the seabed as a share of the local depth, so that the current follows a sloping bed; above the mean
//! surface it is 1. Current and waves are superposed without interaction.
//! References: in [`current`], [`waves`] and [`field`].

pub mod check;
pub mod current;
pub mod field;
pub mod waves;

use glam::DVec3;

use crate::model::Seabed;
use current::{LawTable, Profile, Tide};
use field::{Field, Walk};
use waves::Waves;

/// Least local depth on a slope; a shallower bed is treated as this deep [m].
const LEAST_DEPTH_M: f64 = 0.01;

/// The sea as a scenario declares it.
#[derive(Clone, Debug, PartialEq)]
pub struct Water {
    /// Density [kg/m³]; zero for a vacuum.
    pub density_kg_m3: f64,
    /// Gravity, downwards [m/s²].
    pub gravity_m_s2: f64,
    /// Water depth at the origin [m].
    pub depth_m: f64,
    /// Whether rope above the surface is dry; if not, drag and buoyancy act at any height.
    pub rope_dries: bool,
    /// Current.
    pub current: Current,
    /// Waves, if any.
    pub waves: Option<Waves>,
}

/// Current by height and time.
#[derive(Clone, Debug, PartialEq)]
pub struct Current {
    /// Velocity at the surface, or at the fastest height of a tabulated profile, before the effect of the tide [m/s].
    pub surface_m_s: DVec3,
    /// Variation with height.
    pub profile: Profile,
    /// Variation with time.
    pub tide: Tide,
}

impl Current {
    /// Steady and uniform over the depth.
    pub fn uniform(velocity_m_s: DVec3) -> Self {
        Self { surface_m_s: velocity_m_s, profile: Profile::Uniform, tide: Tide::Steady }
    }

    /// Steady, with a power law; an exponent of zero is uniform.
    pub fn power(surface_m_s: DVec3, exponent: f64) -> Self {
        Self { profile: Profile::power(exponent), ..Self::uniform(surface_m_s) }
    }

    /// Steady, with the logarithmic law; the roughness length is a positive share of the depth.
    pub fn log(surface_m_s: DVec3, roughness: f64) -> Self {
        Self { profile: Profile::Log(roughness), ..Self::uniform(surface_m_s) }
    }

    /// Velocity at a share of the depth above the seabed and a time, by the exact formulas [m/s].
    pub fn at(&self, height: f64, time_s: f64) -> DVec3 {
        self.profile.turn(self.tide.velocity(self.surface_m_s, time_s), height.clamp(0.0, 1.0))
    }
}

impl Water {
    /// Velocity of the current over a level seabed at time zero, by the exact formulas [m/s].
    pub fn velocity(&self, place: DVec3) -> DVec3 {
        self.current.at((place.z + self.depth_m) / self.depth_m, 0.0)
    }
}

/// Motion of the water at a position and time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaterAt {
    /// Velocity of current and waves [m/s].
    pub velocity_m_s: DVec3,
    /// Acceleration due to waves [m/s²].
    pub acceleration_m_s2: DVec3,
    /// Height of the surface above z = 0 [m].
    pub surface_m: f64,
}

/// Output of [`Sea::add_waves`], one entry per position.
#[derive(Debug)]
pub struct WavesOut<'a> {
    /// Velocity; that of the waves is added [m/s].
    pub flow: &'a mut [DVec3],
    /// Acceleration [m/s²].
    pub acceleration: &'a mut Vec<DVec3>,
    /// Height of the surface above z = 0 [m].
    pub surface: &'a mut Vec<f64>,
}

/// The sea prepared for the solver: tables of the profile and components of the waves.
#[derive(Clone, Debug)]
pub struct Sea {
    current: Current,
    law: Option<LawTable>,
    depth_m: f64,
    inverse_depth: f64,
    /// Increase of depth per metre east and north; `None` for a level bed.
    slope: Option<(f64, f64)>,
    field: Option<Field>,
}

impl Sea {
    /// Scales the current.
    pub(crate) fn weaken_current(&mut self, share: f64) {
        self.current.surface_m_s *= share;
    }

    /// Prepares a model's water over its seabed; the seed determines irregular waves.
    pub fn new(water: &Water, seabed: Option<&Seabed>, seed: u64) -> Self {
        let normal = seabed.map_or(DVec3::Z, |seabed| seabed.normal);
        let slope = (normal.x / normal.z, normal.y / normal.z);
        let is_wet = water.density_kg_m3 > 0.0;
        Self {
            law: LawTable::of(&water.current.profile),
            current: water.current.clone(),
            depth_m: water.depth_m,
            inverse_depth: 1.0 / water.depth_m,
            slope: (slope != (0.0, 0.0)).then_some(slope),
            field: water
                .waves
                .as_ref()
                .filter(|_| is_wet)
                .map(|waves| Field::new(waves, water.depth_m, water.gravity_m_s2, seed)),
        }
    }

    /// The waves, if any.
    pub fn field(&self) -> Option<&Field> {
        self.field.as_ref()
    }

    /// Height above the seabed as a share of the local depth, from 0 to 1.
    fn height(&self, place: DVec3) -> f64 {
        let share = match self.slope {
            None => place.z * self.inverse_depth,
            Some((east, north)) => {
                place.z / (self.depth_m + east * place.x + north * place.y).max(LEAST_DEPTH_M)
            }
        };
        (1.0 + share).clamp(0.0, 1.0)
    }

    /// Velocity of the current [m/s].
    pub fn current(&self, place: DVec3, time_s: f64) -> DVec3 {
        let fastest = self.current.tide.velocity(self.current.surface_m_s, time_s);
        match &self.law {
            Some(table) => fastest * table.share(self.height(place)),
            None => self.current.profile.turn(fastest, self.height(place)),
        }
    }

    /// Computes the velocity of the current at many positions into `out`, which has the same length [m/s].
    pub fn current_at(&self, places: &[DVec3], time_s: f64, out: &mut [DVec3]) {
        debug_assert_eq!(places.len(), out.len(), "one velocity per position");
        let fastest = self.current.tide.velocity(self.current.surface_m_s, time_s);
        let pairs = out.iter_mut().zip(places);
        match (&self.law, &self.current.profile) {
            (Some(table), _) => pairs.for_each(|(velocity, place)| {
                *velocity = fastest * table.share(self.height(*place))
            }),
            (None, Profile::Uniform) => out.fill(fastest),
            (None, profile) => pairs.for_each(|(velocity, place)| {
                *velocity = profile.turn(fastest, self.height(*place))
            }),
        }
    }

    /// Current and waves at one position.
    pub fn at(&self, place: DVec3, time_s: f64) -> WaterAt {
        let velocity_m_s = self.current(place, time_s);
        let waves =
            self.field.as_ref().map_or_else(WaterAt::default, |field| field.at(place, time_s));
        WaterAt { velocity_m_s: velocity_m_s + waves.velocity_m_s, ..waves }
    }

    /// Adds the velocity of waves at many positions to `flow`, and writes their acceleration and surface height.
    ///
    /// Both lists remain empty if the sea has no waves or they have not started.
    pub fn add_waves(&self, places: &[DVec3], time_s: f64, walk: &mut Walk, out: WavesOut<'_>) {
        let WavesOut { flow, acceleration, surface } = out;
        debug_assert_eq!(places.len(), flow.len(), "one velocity per position");
        acceleration.clear();
        surface.clear();
        let Some(field) = self.field.as_ref().filter(|field| field.runs_at(time_s)) else { return };
        field.begin(walk, time_s);
        for (place, flow) in places.iter().zip(flow) {
            let at = field.walk_to(walk, *place);
            *flow += at.velocity_m_s;
            acceleration.push(at.acceleration_m_s2);
            surface.push(at.surface_m);
        }
    }
}

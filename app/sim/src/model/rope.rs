//! Rope materials, the lengths of rope between joints, and how rope touches rope.

use glam::DVec3;

use super::obstacle::ROPE_ON_HARD_N_M2;

/// Friction of wet synthetic rope on itself: 0.1 to 0.2, the order of wet yarn on yarn of nylon and polyester with a
/// marine finish (Flory, Hearle and Goksoy 1990, known from a secondary source; estimate).
pub const ROPE_ON_ROPE_FRICTION: f64 = 0.15;

/// A rope material, per metre of unstretched length.
#[derive(Clone, Debug, PartialEq)]
pub struct Rope {
    /// Id in the gear library.
    pub id: String,
    /// Nominal diameter, for drag and contact [m].
    pub diameter_m: f64,
    /// Mass in air [kg/m].
    pub mass_kg_m: f64,
    /// Volume of fibre, for buoyancy [m³/m].
    pub displaced_m3_m: f64,
    /// Axial stiffness EA at zero strain [N].
    pub axial_stiffness_n: f64,
    /// Stiffening EA2: tension = EA·strain + EA2·strain² where stretched; zero for a linear law [N].
    pub axial_stiffening_n: f64,
    /// Internal damping BA: tension grows by BA·strain rate [N s].
    pub axial_damping_n_s: f64,
    /// Internal damping besides, as a ratio of a segment's critical damping `2 √(EA/l · mass·l)`.
    pub axial_damping_ratio: f64,
    /// Bending stiffness EI; zero for a rope that bends freely [N m²].
    pub bending_stiffness_n_m2: f64,
    /// Drag coefficient across, on `d·l`.
    pub drag_normal: f64,
    /// Drag coefficient along, on `π·d·l`, at `drag_tangential_speed_m_s`.
    pub drag_tangential: f64,
    /// Share of that coefficient that falls with the inverse root of the speed; zero for drag by the square of the speed.
    pub drag_tangential_viscous: f64,
    /// Speed along at which `drag_tangential` holds [m/s].
    pub drag_tangential_speed_m_s: f64,
    /// Added-mass coefficient across.
    pub added_mass_normal: f64,
    /// Added-mass coefficient along.
    pub added_mass_tangential: f64,
    /// Breaking strength of the rope itself; infinite for a rope that cannot break [N].
    pub strength_n: f64,
}

impl Default for Rope {
    /// A rope of which nothing is known: it has no damping, no stiffening, no bending stiffness, and cannot break. Its
    /// diameter, mass and stiffness are zero, which [`Model::new`](crate::Model::new) refuses, so that none is forgotten.
    fn default() -> Self {
        Self {
            id: String::new(),
            diameter_m: 0.0,
            mass_kg_m: 0.0,
            displaced_m3_m: 0.0,
            axial_stiffness_n: 0.0,
            axial_stiffening_n: 0.0,
            axial_damping_n_s: 0.0,
            axial_damping_ratio: 0.0,
            bending_stiffness_n_m2: 0.0,
            drag_normal: 0.0,
            drag_tangential: 0.0,
            drag_tangential_viscous: 0.0,
            drag_tangential_speed_m_s: 1.0,
            added_mass_normal: 0.0,
            added_mass_tangential: 0.0,
            strength_n: f64::INFINITY,
        }
    }
}

impl Rope {
    /// `w` of the drag along, `½ρ C_t π d w u` by metre: `(1 - q) |u| + q √(U_r |u|)` with `q` the viscous share, which is
    /// `|u|` without one [m/s].
    #[must_use]
    pub fn drag_speed_along_m_s(&self, speed_m_s: f64) -> f64 {
        let speed = libm::fabs(speed_m_s);
        let viscous = self.drag_tangential_viscous;
        (1.0 - viscous) * speed + viscous * (self.drag_tangential_speed_m_s * speed).sqrt()
    }
}

/// What a line keeps of its rope's breaking strength, as shares of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// All along: wear and variation of strength.
    pub all: f64,
    /// At end A besides, in the first segment: a knot or splice.
    pub end_a: f64,
    /// At end B besides, in the last segment.
    pub end_b: f64,
}

impl Default for Strength {
    fn default() -> Self {
        Self { all: 1.0, end_a: 1.0, end_b: 1.0 }
    }
}

/// A length of one rope between two joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Id, such as `endline-top`.
    pub id: String,
    /// Index of its rope.
    pub rope: usize,
    /// Joint at end A.
    pub from: usize,
    /// Joint at end B.
    pub to: usize,
    /// Unstretched length of each segment from A to B at the start of a run; the state knows them as they are [m].
    pub segments_m: Vec<f64>,
    /// What it keeps of its rope's strength.
    pub strength: Strength,
    /// Radius of the knot, splice, swivel or link at ends A and B, a ball on the rope; zero where there is none [m].
    pub knots_m: [f64; 2],
    /// First guess of its nodes, both ends included; empty for a straight line [m].
    pub start_m: Vec<DVec3>,
}

/// Friction of rope on rope and how hard ropes are under each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeOnRope {
    /// Coulomb friction.
    pub friction: f64,
    /// Stiffness, by length over which two ropes bear on each other [N/m²].
    pub stiffness_n_m2: f64,
}

impl Default for RopeOnRope {
    fn default() -> Self {
        Self { friction: ROPE_ON_ROPE_FRICTION, stiffness_n_m2: ROPE_ON_HARD_N_M2 }
    }
}

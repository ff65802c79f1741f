//! Rope materials, lines, weak links, and the joints where line ends meet.

use endline_sdk::LineEnd;
use glam::DVec3;

use super::ROPE_ON_HARD_N_M2;

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
    /// Displaced volume, for buoyancy [m³/m].
    pub displaced_m3_m: f64,
    /// Axial stiffness EA at zero strain [N].
    pub axial_stiffness_n: f64,
    /// Second-order stiffness EA2: tension = EA·strain + EA2·strain² where stretched; zero for a linear law [N].
    pub axial_stiffening_n: f64,
    /// Internal damping BA: it adds BA·strain rate to the tension [N s].
    pub axial_damping_n_s: f64,
    /// Additional internal damping, as a ratio of a segment's critical damping `2 √(EA/l · mass·l)`.
    pub axial_damping_ratio: f64,
    /// Bending stiffness EI; zero for a rope that bends freely [N m²].
    pub bending_stiffness_n_m2: f64,
    /// Normal drag coefficient, on the area `d·l`.
    pub drag_normal: f64,
    /// Tangential drag coefficient, on the area `π·d·l`, at `drag_tangential_speed_m_s`.
    pub drag_tangential: f64,
    /// Share of that coefficient that falls with the inverse square root of the speed; zero for quadratic drag.
    pub drag_tangential_viscous: f64,
    /// Tangential speed at which `drag_tangential` holds [m/s].
    pub drag_tangential_speed_m_s: f64,
    /// Normal added-mass coefficient.
    pub added_mass_normal: f64,
    /// Tangential added-mass coefficient.
    pub added_mass_tangential: f64,
    /// Breaking strength of the rope itself; infinite for a rope that cannot break [N].
    pub strength_n: f64,
}

impl Default for Rope {
    /// A rope without damping, stiffening or bending stiffness that cannot break.
    ///
    /// Diameter, mass and stiffness are zero, which [`Model::new`](crate::Model::new) rejects: the caller must set them.
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
    /// Effective speed `w` of the tangential drag `½ρ C_t π d w u` per metre [m/s]: `w = (1 - q) |u| + q √(U_r |u|)` with
    /// `q` the viscous share and `U_r` the reference speed.
    pub fn drag_speed_along_m_s(&self, speed_m_s: f64) -> f64 {
        let speed = libm::fabs(speed_m_s);
        let viscous = self.drag_tangential_viscous;
        (1.0 - viscous) * speed + viscous * (self.drag_tangential_speed_m_s * speed).sqrt()
    }
}

/// Strength of a line as shares of its rope's breaking strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// Share along the whole line: wear and variation of strength.
    pub all: f64,
    /// Additional factor in the first segment, for a knot or splice at end A.
    pub end_a: f64,
    /// Additional factor in the last segment, for end B.
    pub end_b: f64,
}

impl Default for Strength {
    fn default() -> Self {
        Self { all: 1.0, end_a: 1.0, end_b: 1.0 }
    }
}

/// A place at which a line parts at a lower tension than elsewhere. It changes nothing but strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeakPlace {
    /// Unstretched length from end A of its line [m].
    pub at_m: f64,
    /// Tension above which the line parts there [N].
    pub strength_n: f64,
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
    /// Unstretched length of each segment from A to B at the start of a run; the state holds the current ones [m].
    pub segments_m: Vec<f64>,
    /// Shares of its rope's strength.
    pub strength: Strength,
    /// Places that are weaker than the rest of it, sorted by their length from end A.
    pub weak_places: Vec<WeakPlace>,
    /// Radius of the knot, splice, swivel or link at ends A and B, modelled as a ball on the rope; zero for none [m].
    pub knots_m: [f64; 2],
    /// Initial guess of its nodes, both ends included; empty for a straight line [m].
    pub start_m: Vec<DVec3>,
}

/// Friction and contact stiffness of rope on rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeOnRope {
    /// Coulomb friction.
    pub friction: f64,
    /// Contact stiffness, per length of contact between two ropes [N/m²].
    pub stiffness_n_m2: f64,
}

impl Default for RopeOnRope {
    fn default() -> Self {
        Self { friction: ROPE_ON_ROPE_FRICTION, stiffness_n_m2: ROPE_ON_HARD_N_M2 }
    }
}

/// A weak link at one end of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Id.
    pub id: String,
    /// Index of its line.
    pub line: usize,
    /// End of the line.
    pub end: LineEnd,
    /// Tension above which it parts [N].
    pub rating_n: f64,
    /// Whether it can part.
    pub enabled: bool,
}

/// A point where line ends meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Id, for reports.
    pub id: String,
    /// Constraint.
    pub kind: JointKind,
    /// Initial guess of its position, or its position where fixed or driven [m].
    pub position_m: DVec3,
}

/// Constraint of a joint.
#[derive(Clone, Debug, PartialEq)]
pub enum JointKind {
    /// None: it moves with the lines, as a splice does.
    Free,
    /// A fixture.
    Fixed,
    /// A fixture that moves at a constant velocity between two times.
    Driven {
        /// Velocity [m/s].
        velocity_m_s: DVec3,
        /// Start of the motion [s].
        from_s: f64,
        /// End of the motion [s].
        until_s: f64,
    },
    /// A constant force on a free end that is hauled or tailed.
    Pulled {
        /// Force [N].
        force_n: DVec3,
        /// Start of the force; the end is held until then, statics included. If negative, it is never held [s].
        from_s: f64,
    },
    /// Attached to a body at `offset_m` in the body's frame.
    Body {
        /// Index of the body.
        body: usize,
        /// Position in the body's frame [m].
        offset_m: DVec3,
    },
    /// Attached to the whale's skin: it moves with the skin and its force acts on the whale.
    Whale(Hitch),
}

/// A point of the whale's skin to which rope is attached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hitch {
    /// Index of the triangle.
    pub triangle: usize,
    /// Barycentric coordinates on it.
    pub barycentric: [f64; 3],
    /// Distance from the skin at which the rope's centre line begins [m].
    pub stand_off_m: f64,
}

//! The laws of a rope's nodes and segments, written once for one number (`rope.rs`) and for a row of lanes (`lanes/sweep/mod.rs`).
//!
//! Node with hanging length `L`, tangent `t`, water velocity relative to it `u = U - v`, `u_t = u·t`, `u_n = u - u_t t`
//! (Morison): `F = L [½ρ C_n d |u_n| u_n + ½ρ C_t π d w u_t t - (m - ρ A_m) g ẑ] - M (v - v̂)/h`, with
//! `w = (1 - q) |u_t| + q √(U_r |u_t|)` (`q` the viscous share of `C_t`, `U_r` the speed at which `C_t` holds) and
//! `M = L [m 1 + ρ (π d²/4)(C_a (1 - t tᵀ) + C_at t tᵀ)]`, `v = (x - x̂)/h` and `A_m` the volume of fibre per metre.
//! Segment of unstretched length `l` along `t`, strain `ε = |x_b - x_a|/l - 1`, strain rate `ε̇ = t·(v_b - v_a)/l`:
//! `T = T(ε, ε̇)` (`axial.rs`), pulling only while taut. It is judged taut, and stiffened across, by the tension that the last
//! linear solve predicted rather than by that at the guess: one or two solves a step then suffice (docs/physics.md).
//! Blocks are `-dF/dx`, symmetric, without the turning of the tangent.
//! Reference: Morison et al. 1950 (doi:10.2118/950149-G); drag coefficients from the gear library.

use core::f64::consts::PI;

use crate::forces::axial::Axial;
use crate::model::{Model, Rope};
use crate::simd::real::Real;
use crate::simd::space::{Sym3, Vec3};
use crate::trial::scheme::Scheme;
use crate::water::Water;

/// Height over which a node changes from wet to dry at the surface [m].
pub(crate) const SURFACE_HEIGHT_M: f64 = 0.1;
/// Least chord or speed that is divided by.
const TINY: f64 = 1e-12;

/// A rope in its water, per metre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PerMetre<R> {
    /// Mass [kg/m].
    pub mass: R,
    /// Added mass across, wet [kg/m].
    pub added: R,
    /// How much less it is along [kg/m].
    pub spared: R,
    /// Weight in air [N/m].
    pub weight: R,
    /// Buoyancy, wet [N/m].
    pub lift: R,
    /// `½ρ C_n d` [kg/m²].
    pub across: R,
    /// `½ρ C_t π d (1 - q)` [kg/m²].
    pub along: R,
    /// `½ρ C_t π d q √U_r` [kg/m^1.5/s^0.5].
    pub along_root: R,
}

impl PerMetre<f64> {
    /// A rope in this water.
    pub fn of(rope: &Rope, water: &Water) -> Self {
        let density = water.density_kg_m3;
        let along = 0.5 * density * rope.diameter_m * rope.drag_tangential * PI;
        let viscous = rope.drag_tangential_viscous;
        let displaced = density * PI * rope.diameter_m * rope.diameter_m / 4.0;
        Self {
            mass: rope.mass_kg_m,
            added: displaced * rope.added_mass_normal,
            spared: displaced * (rope.added_mass_normal - rope.added_mass_tangential),
            weight: rope.mass_kg_m * water.gravity_m_s2,
            lift: density * rope.displaced_m3_m * water.gravity_m_s2,
            across: 0.5 * density * rope.diameter_m * rope.drag_normal,
            along: along * (1.0 - viscous),
            along_root: along * viscous * rope.drag_tangential_speed_m_s.sqrt(),
        }
    }
}

/// Constants of all nodes in a step.
#[derive(Clone, Copy)]
pub(crate) struct Shared<R> {
    /// `1/h` of the scheme [1/s].
    pub rate: R,
    /// Weight of the mass in the matrix [1/s²].
    pub inertia: R,
    /// Wet share is `clamp(wet - height · drying, 0, 1)`.
    pub wet: R,
    /// [1/m].
    pub drying: R,
    /// Whether the drag along some rope has a viscous share; the square root is skipped if not.
    pub viscous: bool,
}

impl Shared<f64> {
    /// A step of this scheme.
    pub fn of(model: &Model, scheme: &Scheme) -> Self {
        let (wet, drying) =
            if model.spec.water.rope_dries { (0.5, 1.0 / SURFACE_HEIGHT_M) } else { (1.0, 0.0) };
        let viscous = model.spec.ropes.iter().any(|rope| rope.drag_tangential_viscous > 0.0);
        Self { rate: scheme.rate, inertia: scheme.inertia, wet, drying, viscous }
    }
}

impl<R: Real> Shared<R> {
    /// Share of a node that is under water at a height above the surface.
    #[inline(always)]
    pub fn wet_at(&self, height: R) -> R {
        self.wet.less(height, self.drying).max(height.splat(0.0)).min(height.splat(1.0))
    }
}

/// A node at the trial.
#[derive(Clone, Copy)]
pub(crate) struct NodeAt<R> {
    pub place: Vec3<R>,
    /// The nodes before and after it, or itself at an end.
    pub before: Vec3<R>,
    pub after: Vec3<R>,
    pub place_history: Vec3<R>,
    pub velocity_history: Vec3<R>,
    /// Velocity of the water, and the height of its surface.
    pub flow: Vec3<R>,
    pub surface: R,
    /// Hanging length.
    pub length: R,
}

/// Force on a node and `-dF/dx`.
#[inline(always)]
pub(crate) fn node<R: Real>(
    rope: &PerMetre<R>,
    shared: &Shared<R>,
    at: &NodeAt<R>,
) -> (Vec3<R>, Sym3<R>) {
    let one = shared.rate.splat(1.0);
    let tiny = shared.rate.splat(TINY);
    let chord = at.after.sub(at.before);
    let tangent = chord.scale(one / chord.dot(chord).sqrt().max(tiny));
    let height = at.place.z - at.surface;
    let wet = shared.wet_at(height);
    let velocity = at.place.sub(at.place_history).scale(shared.rate);
    // Drag.
    let relative = at.flow.sub(velocity);
    let along_speed = relative.dot(tangent);
    let normal = relative.less(tangent, along_speed);
    let normal_speed = normal.dot(normal).sqrt();
    let wet_length = at.length * wet;
    let across = rope.across * wet_length * normal_speed;
    let zero = shared.rate.splat(0.0);
    let rough = rope.along * wet_length * along_speed.abs();
    let root =
        if shared.viscous { rope.along_root * wet_length * along_speed.abs().sqrt() } else { zero };
    let along = rough + root;
    let drag = normal.scale(across).plus(tangent, along * along_speed);
    // -dF/dv of the drag is `across (1 - ttᵀ) + (2 rough + 3/2 root) ttᵀ + across nnᵀ/n²`; the added mass lies along
    // `1 - ttᵀ` too.
    let added = rope.added * wet_length;
    let mass = rope.mass * at.length;
    let acceleration = velocity.sub(at.velocity_history).scale(shared.rate);
    let along_acceleration = acceleration.dot(tangent);
    let spared = rope.spared * wet_length;
    let sideways = across * shared.rate;
    let round = (mass + added) * shared.inertia + sideways;
    let along_slope = rough + rough + root * shared.rate.splat(1.5);
    let lengthways = along_slope * shared.rate - sideways - spared * shared.inertia;
    let turning = rope.across * wet_length * shared.rate / normal_speed.max(tiny);
    let block = Sym3::round(round, tangent, lengthways).plus_outer(normal, turning);
    // Weight and buoyancy, which fades towards the surface.
    let lift = rope.lift * at.length;
    let fading = wet.positive((one - wet).positive(lift * shared.drying, zero), zero);
    let mut force =
        drag.less(acceleration, mass + added).plus(tangent, spared * along_acceleration);
    force.z = force.z.plus(lift, wet).less(rope.weight, at.length);
    (force, Sym3 { zz: block.zz + fading, ..block })
}

/// A segment at the trial.
#[derive(Clone, Copy)]
pub(crate) struct SegmentAt<R> {
    /// From its first node to its second, and the history `x̂` of this vector.
    pub between: Vec3<R>,
    pub history: Vec3<R>,
    /// Unstretched length and its inverse.
    pub length: R,
    pub inverse_length: R,
    /// All zero where it is cut.
    pub law: Axial<R>,
    /// Tension by the last solve: taut above zero.
    pub predicted: R,
}

/// The pull of a segment.
#[derive(Clone, Copy)]
pub(crate) struct PullOf<R> {
    pub direction: Vec3<R>,
    pub inverse_chord: R,
    pub tension: R,
    /// Slope of the tension by length.
    pub stiffness: R,
    /// Pull on the first node; on the second its opposite.
    pub force: Vec3<R>,
    pub block: Sym3<R>,
}

/// Tension of a segment, its force and block; both zero where it is slack.
#[inline(always)]
pub(crate) fn pull<R: Real>(at: &SegmentAt<R>, rate: R) -> PullOf<R> {
    let zero = rate.splat(0.0);
    let inverse_length = at.inverse_length;
    let chord = at.between.dot(at.between).sqrt().max(at.length * rate.splat(1e-9));
    let inverse_chord = rate.splat(1.0) / chord;
    let direction = at.between.scale(inverse_chord);
    let strain_rate = direction.dot(at.between.sub(at.history)) * rate * inverse_length;
    let strain = (chord - at.length) * inverse_length;
    let tension = at.law.tension(strain, strain_rate);
    let stiffness = at.law.slope(strain, rate) * inverse_length;
    let across = at.predicted.max(zero) * inverse_chord;
    let block = Sym3::round(across, direction, stiffness - across);
    let none = Vec3 { x: zero, y: zero, z: zero };
    PullOf {
        direction,
        inverse_chord,
        tension,
        stiffness,
        force: Vec3::choose(at.predicted, direction.scale(tension), none),
        block: Sym3::choose(at.predicted, block, Sym3::diagonal(zero)),
    }
}

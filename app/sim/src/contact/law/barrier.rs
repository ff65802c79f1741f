//! The push of skin on rope: blubber, which stiffens as it is pressed, so that rope bears out before its core is reached.
//!
//! Distance `d` of the centre line from the skin, contact distance `h` (the rope's radius), least
//! distance `d_min`, `δ = h - d`, `D = h - d_min`, stiffness `K` per metre, length `l`:
//!
//! ```text
//! N = l K D (e^(b δ/D) - 1)/b        dN/dδ = l K e^(b δ/D) = l K + b N/D
//! ```
//!
//! Linear and soft while `b δ < D`; at `d_min` two thousand times what it would be were it linear all along (`b` = 10), which is some
//! 3 MN on a metre of rope. Its stiffness grows with the push and not with the square of it, as that of a barrier does that is infinite
//! at `d_min`: rope that bears kilonewtons then shares them among its contact points within a tenth of a millimetre instead of a micrometre.
//! Blubber has a law of this form, and a modulus from which `K` follows (Raymond 2007, in the gear library); `b` is a choice.
//! Comparison with a barrier: docs/lab-notebook.md.

/// Least distance as a share of the contact distance.
const LEAST_SHARE: f64 = 0.25;
/// `u` where the centre line meets the skin.
const AT_SKIN: f64 = 1.0 / (1.0 - LEAST_SHARE);
/// `b`, by which the skin stiffens.
const STIFFENING: f64 = 10.0;
/// Share of the way to the least distance from which the law counts as steep.
#[cfg(test)]
const STEEP_SHARE: f64 = 0.5;
/// The push there, in units of `l K D`: `(e^(b/2) - 1)/b`.
const STEEP_PUSH: f64 = 14.74131591025766;

/// Share of the contact distance below which rope is pinched when a step ends: skin is overrun, the force means nothing.
pub(crate) const PINCHED_SHARE: f64 = 0.8 * LEAST_SHARE;
/// Share of the contact distance below which rope is crushed during Newton's passes; a step does not recover from it.
pub(crate) const CRUSHED_SHARE: f64 = 0.02;

/// Push of the skin at one distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct BarrierForce {
    /// Normal force [N].
    pub force: f64,
    /// Its growth with depth [N/m].
    pub stiffness: f64,
}

impl BarrierForce {
    /// Push at distance `distance` for a contact distance `contact_distance` and stiffness `stiffness` (per metre
    /// of rope, times the length of rope) [N/m].
    pub fn new(distance: f64, contact_distance: f64, stiffness: f64) -> Self {
        let depth = contact_distance - distance;
        if depth <= 0.0 {
            return Self::default();
        }
        let room = room_of(contact_distance);
        let (push, slope) = law(depth / room);
        Self { force: stiffness * room * push, stiffness: stiffness * slope }
    }

    /// The push from which on the law counts as steep [N].
    pub fn steep_n(contact_distance: f64, stiffness: f64) -> f64 {
        stiffness * room_of(contact_distance) * STEEP_PUSH
    }

    /// The depth at which the push is `force`, and the push there.
    pub fn at_force(force: f64, contact_distance: f64, stiffness: f64) -> (f64, Self) {
        let room = room_of(contact_distance);
        let stiffened = STIFFENING * force / (stiffness * room);
        let depth = room * libm::log1p(stiffened) / STIFFENING;
        (depth, Self { force, stiffness: stiffness * (1.0 + stiffened) })
    }

    /// Where the law is steep: the tangent at the solved normal force, and its increment to a distance; else the law itself.
    ///
    /// From a trial that came too near, the law's tangents lead back by `D/b` in each pass; taken at the solved push instead of the
    /// distance, they lead there at once.
    pub fn about_solved(
        self,
        solved_n: Option<f64>,
        (distance, contact_distance, stiffness): (f64, f64, f64),
    ) -> (Self, f64) {
        let steep_n = Self::steep_n(contact_distance, stiffness);
        match solved_n {
            Some(solved_n) if self.force > steep_n => {
                let (depth, barrier) =
                    Self::at_force(solved_n.max(steep_n), contact_distance, stiffness);
                let growth_n = barrier.stiffness * (contact_distance - distance - depth);
                // So far out that the tangent would pull, the solved push was that of another place.
                if barrier.force + growth_n < 0.0 { (self, 0.0) } else { (barrier, growth_n) }
            }
            _ => (self, 0.0),
        }
    }
}

/// Depth from the first touch to the least distance [m].
fn room_of(contact_distance: f64) -> f64 {
    contact_distance * (1.0 - LEAST_SHARE)
}

/// Normal force and its derivative by `u`, in units of `l K D`; beyond the skin it continues as a straight line, so that a bad predictor
/// has a finite force.
fn law(u: f64) -> (f64, f64) {
    let within = u.min(AT_SKIN);
    let growth = libm::exp(STIFFENING * within);
    ((growth - 1.0) / STIFFENING + (u - within) * growth, growth)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Energy that the push stores [J].
    fn energy(distance: f64, contact_distance: f64, stiffness: f64) -> f64 {
        let room = room_of(contact_distance);
        let u = (contact_distance - distance) / room;
        let stored = (libm::expm1(STIFFENING * u) / STIFFENING - u) / STIFFENING;
        stiffness * room * room * stored
    }

    #[test]
    fn force_and_stiffness_are_derivatives_of_the_energy() {
        for distance in [0.0059, 0.004, 0.002, 0.001_6] {
            let (contact_distance, stiffness, step) = (0.006, 5e4, 1e-7);
            let energy = |by: f64| energy(distance + by, contact_distance, stiffness);
            let here = BarrierForce::new(distance, contact_distance, stiffness);
            let force = (energy(-step) - energy(step)) / (2.0 * step);
            assert!((force / here.force - 1.0).abs() < 1e-5, "{distance}");
        }
        for distance in [0.0059, 0.004, 0.002, 0.001_502, 0.001] {
            let (contact_distance, stiffness, step) = (0.006, 5e4, 1e-9);
            let force =
                |by: f64| BarrierForce::new(distance + by, contact_distance, stiffness).force;
            let here = BarrierForce::new(distance, contact_distance, stiffness);
            let growth = (force(-step) - force(step)) / (2.0 * step);
            assert!((growth / here.stiffness - 1.0).abs() < 1e-4, "{distance}");
        }
        assert_eq!(BarrierForce::new(0.006, 0.006, 5e4), BarrierForce::default());
        let beyond = BarrierForce::new(-1e3, 0.006, 5e4);
        assert!(beyond.force.is_finite() && beyond.stiffness.is_finite());
    }

    #[test]
    fn the_law_is_steep_from_half_the_way_to_the_least_distance() {
        assert_eq!(STEEP_PUSH.to_bits(), law(STEEP_SHARE).0.to_bits());
    }

    #[test]
    fn the_depth_of_a_force_is_where_the_law_has_it() {
        for force in [1.0, 200.0, BarrierForce::steep_n(0.006, 5e4), 3e4, 1e5] {
            let (depth, push) = BarrierForce::at_force(force, 0.006, 5e4);
            let there = BarrierForce::new(0.006 - depth, 0.006, 5e4);
            assert!((there.force / force - 1.0).abs() < 1e-9, "{force}");
            assert!((there.stiffness / push.stiffness - 1.0).abs() < 1e-9, "{force}");
        }
    }
}

//! The push of skin on rope: blubber when shallow, a barrier before the rope's core is reached.
//!
//! Distance `d` of the centre line from the skin, contact distance `h` (the rope's radius), least
//! distance `d_min`, `δ = h - d`, `D = h - d_min`, `u = δ/D`, stiffness `K` per metre, length `l`:
//! `E = l K D² (-ln(1-u) - u)`, `N = -dE/dd = l K δ/(1-u)`, `dN/dδ = l K/(1-u)²`.
//! Linear and soft like blubber while `u` is small, infinite at `d_min`; beyond `u = U_LINEAR` it goes on
//! as a straight line so that a bad first guess has a finite force.
//! Reference: barrier contact after Li et al. 2020 (doi:10.1145/3386569.3392425); blubber stiffness from
//! Raymond 2007 in the gear library.

/// Least distance as a share of the contact distance.
const LEAST_SHARE: f64 = 0.25;
/// Where the barrier goes over into a straight line.
const U_LINEAR: f64 = 0.995;

/// Share of the contact distance below which rope is pinched when a step ends: the barrier was overrun, the force
/// means nothing.
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
        let room = contact_distance * (1.0 - LEAST_SHARE);
        let u = depth / room;
        let at = |u: f64| Self {
            force: stiffness * room * u / (1.0 - u),
            stiffness: stiffness / ((1.0 - u) * (1.0 - u)),
        };
        if u < U_LINEAR {
            return at(u);
        }
        let (end, beyond) = (at(U_LINEAR), (u - U_LINEAR) * room);
        Self { force: end.force + beyond * end.stiffness, stiffness: end.stiffness }
    }

    /// The push at half of the greatest depth, from which on the law counts as steep [N].
    pub fn steep_n(contact_distance: f64, stiffness: f64) -> f64 {
        stiffness * contact_distance * (1.0 - LEAST_SHARE)
    }

    /// The depth at which the push is `force`, and the push there.
    pub fn at_force(force: f64, contact_distance: f64, stiffness: f64) -> (f64, Self) {
        let room = contact_distance * (1.0 - LEAST_SHARE);
        let greatest = stiffness * room * U_LINEAR / (1.0 - U_LINEAR);
        let u = (force / (stiffness * room + force)).min(U_LINEAR);
        let stiffness = stiffness / ((1.0 - u) * (1.0 - u));
        let beyond = (force - greatest).max(0.0) / stiffness;
        (u * room + beyond, Self { force, stiffness })
    }

    /// The push linear about the solved one where the law is steep, and what it grows by from there to a distance; else as it is.
    ///
    /// The law grows without bound near the least distance. From a trial that came too near, its tangents lead back by half of the
    /// excess in each pass; taken at the solved push instead of the distance, they lead there at once.
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

    /// A share of this push.
    pub fn share(self, share: f64) -> Self {
        Self { force: self.force * share, stiffness: self.stiffness * share }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Energy that the push stores, up to where the barrier goes over into a straight line [J].
    fn energy(distance: f64, contact_distance: f64, stiffness: f64) -> f64 {
        let room = contact_distance * (1.0 - LEAST_SHARE);
        let u = (contact_distance - distance) / room;
        stiffness * room * room * (-libm::log1p(-u) - u)
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

//! The boat: where its block is, and when the hauler turns.
//!
//! The line is first lifted from the surface to the block at the hauler's speed, then the hauler comes up to its speed `V`.
//! The block rises with the surface of the sea below it, `z = h + r η(x, y, t)`. The helmsman follows the line: with `θ` its angle
//! from the vertical and `θ₀` the one at which the boat keeps pace, the speed wanted is `V min(tan θ / tan θ₀, 1.5)` towards where the line
//! leads; the boat's own speed comes after it within [`HELM_S`]. A drift comes on top. The law of following is an estimate.

use glam::DVec3;

use super::Hauling;
use crate::water::Sea;

/// Time in which the boat takes up the speed that is wanted; an estimate [s].
const HELM_S: f64 = 3.0;
/// Greatest speed of the boat over the hauler's; an estimate.
const MOST_PACE: f64 = 1.5;
/// Least drop of the line by its length at the block that counts for its angle.
const LEAST_DROP: f64 = 0.02;

/// A boat that hauls.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boat {
    /// Where the line's end was before it was lifted [m].
    from: DVec3,
    /// The block without heave [m].
    block: DVec3,
    following_m_s: DVec3,
    /// Time of lifting the line to the block [s].
    lift_s: f64,
}

impl Boat {
    /// A boat above a line's end.
    pub fn at(from: DVec3, how: &Hauling) -> Self {
        let lift_s = (how.block_m - from.z).max(0.0) / how.speed_m_s;
        Self { from, block: from, following_m_s: DVec3::ZERO, lift_s }
    }

    /// Rope that the hauler takes in over a step [m].
    pub fn rope_m(&self, how: &Hauling, time_s: f64, step_s: f64) -> f64 {
        let since = time_s + 0.5 * step_s - self.lift_s;
        how.speed_m_s * step_s * (since / how.start_s.max(step_s)).clamp(0.0, 1.0)
    }

    /// Moves on over a step; the place of the block at its end.
    pub fn advance(
        &mut self,
        how: &Hauling,
        sea: &Sea,
        way: DVec3,
        time_s: f64,
        step_s: f64,
    ) -> DVec3 {
        let end_s = time_s + step_s;
        if end_s > self.lift_s {
            let wanted = follow(how, way);
            self.following_m_s += (wanted - self.following_m_s) * (step_s / HELM_S).min(1.0);
            self.block += (self.following_m_s + how.drift_m_s) * step_s;
        }
        let lifted = if self.lift_s > 0.0 { (end_s / self.lift_s).min(1.0) } else { 1.0 };
        self.block.z = self.from.z + (how.block_m - self.from.z) * lifted;
        let surface_m = sea.at(DVec3::new(self.block.x, self.block.y, 0.0), end_s).surface_m;
        self.block + DVec3::Z * (how.heave * lifted * surface_m)
    }
}

/// Velocity with which the helmsman wants to follow the line [m/s].
fn follow(how: &Hauling, way: DVec3) -> DVec3 {
    let Some(lead_rad) = how.lead_rad else { return DVec3::ZERO };
    let level = DVec3::new(way.x, way.y, 0.0);
    let slant = level.length() / (-way.z).max(LEAST_DROP);
    let pace = (slant / libm::tan(lead_rad)).min(MOST_PACE);
    level.normalize_or_zero() * (how.speed_m_s * pace)
}

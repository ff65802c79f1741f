//! How long a run takes: settling, the approach, and the time with rope near the whale apart.

use std::sync::LazyLock;
use std::time::{Duration, Instant};

use endline_sim::{Cost, CostPart};

/// Time since it was first asked for: the clock that steps tell their costs by [ns].
pub(crate) fn clock_ns() -> u64 {
    static BEGAN: LazyLock<Instant> = LazyLock::new(Instant::now);
    BEGAN.elapsed().as_nanos() as u64
}

/// Real time spent and simulated time gained.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phase {
    /// Simulated time [s].
    pub simulated_s: f64,
    /// Real time [s].
    pub wall_s: f64,
}

/// Real time of a run by phase.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// Real time of the statics [s].
    pub settle_wall_s: f64,
    /// Steps before rope first came near the whale; all of them where it never did.
    pub approach: Phase,
    /// That step and all after it.
    pub contact: Phase,
    /// What the time of the steps, and of what is measured after them, went to.
    pub cost: Cost,
    near: bool,
}

impl Phase {
    /// Simulated seconds for each real one; 0 where nothing was simulated.
    #[must_use]
    pub fn times_real_time(&self) -> f64 {
        if self.wall_s > 0.0 { self.simulated_s / self.wall_s } else { 0.0 }
    }
}

impl Timing {
    /// Nothing but statics done.
    #[must_use]
    pub fn settled_in(wall: Duration) -> Self {
        Self { settle_wall_s: wall.as_secs_f64(), ..Self::default() }
    }

    /// Adds a step; `near` tells that rope was near the whale in it.
    pub fn add(&mut self, wall: Duration, simulated_s: f64, near: bool) {
        self.near |= near;
        let phase = if self.near { &mut self.contact } else { &mut self.approach };
        phase.simulated_s += simulated_s;
        phase.wall_s += wall.as_secs_f64();
    }

    /// Adds what a step went to, and the time taken after it to measure it.
    pub fn add_cost(&mut self, step: &Cost, measured_in: Duration) {
        self.cost.add(step);
        self.cost.add_ns(CostPart::Metrics, measured_in.as_nanos() as u64);
    }

    /// Both phases together, without the statics.
    #[must_use]
    pub fn whole(&self) -> Phase {
        Phase {
            simulated_s: self.approach.simulated_s + self.contact.simulated_s,
            wall_s: self.approach.wall_s + self.contact.wall_s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn once_near_always_contact() {
        let mut timing = Timing::settled_in(Duration::from_millis(500));
        for near in [false, true, false, false] {
            timing.add(Duration::from_millis(250), 0.5, near);
        }
        assert!((timing.approach.times_real_time() - 2.0).abs() < 1e-12);
        assert!((timing.contact.simulated_s - 1.5).abs() < 1e-12);
        assert!((timing.whole().times_real_time() - 2.0).abs() < 1e-12);
        assert!(Phase::default().times_real_time().abs() < 1e-12);
    }
}

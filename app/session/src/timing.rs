//! How long a run takes: settling, the approach, and the time with rope near the whale apart.

use std::sync::LazyLock;
use std::time::{Duration, Instant};

use endline_sim::{Cost, CostPart};

/// Time since the first call: the clock of the costs of steps [ns].
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
    /// Steps before rope was first near the whale; all of them where it never was.
    pub approach: Phase,
    /// That step and all after it.
    pub contact: Phase,
    /// The time of the steps, and of the metrics after them, by purpose.
    pub cost: Cost,
    near: bool,
}

impl Phase {
    /// Simulated seconds for each real one; 0 where no time was simulated.
    pub fn times_real_time(&self) -> f64 {
        if self.wall_s > 0.0 { self.simulated_s / self.wall_s } else { 0.0 }
    }
}

impl Timing {
    /// The time of statics alone.
    pub fn settled_in(wall: Duration) -> Self {
        Self { settle_wall_s: wall.as_secs_f64(), ..Self::default() }
    }

    /// Adds a step; `near` is whether rope was near the whale in it.
    pub fn add(&mut self, wall: Duration, simulated_s: f64, near: bool) {
        self.near |= near;
        let phase = if self.near { &mut self.contact } else { &mut self.approach };
        phase.simulated_s += simulated_s;
        phase.wall_s += wall.as_secs_f64();
    }

    /// Adds the cost of a step, and the time of its metrics.
    pub fn add_cost(&mut self, step: &Cost, measured_in: Duration) {
        self.cost.add(step);
        self.cost.add_ns(CostPart::Metrics, measured_in.as_nanos() as u64);
    }

    /// Both phases together, without the statics.
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

//! Keeping simulated time at a wanted multiple of real time.

use std::time::{Duration, Instant};

/// Falling further behind than this is forgotten, so that a slow stretch is not made up in a rush.
const PATIENCE: Duration = Duration::from_millis(250);

/// Which simulated time is due when.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    speed: f64,
    wall: Instant,
    simulated_s: f64,
}

impl Pace {
    /// From this moment on at this speed.
    pub(super) fn new(speed: f64, wall: Instant, simulated_s: f64) -> Self {
        Self { speed, wall, simulated_s }
    }

    /// Simulated seconds wanted for each real one.
    pub(super) fn speed(&self) -> f64 {
        self.speed
    }

    /// How long to wait until a simulated time is due; nothing where it is due already.
    pub(super) fn wait(&mut self, now: Instant, simulated_s: f64) -> Duration {
        let due = Duration::try_from_secs_f64((simulated_s - self.simulated_s) / self.speed)
            .unwrap_or_default();
        let gone = now.saturating_duration_since(self.wall);
        if gone > due + PATIENCE {
            *self = Self::new(self.speed, now, simulated_s);
        }
        due.saturating_sub(gone)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_speed_waits_twice_as_long_and_lateness_is_forgotten() {
        let start = Instant::now();
        let mut pace = Pace::new(0.5, start, 10.0);
        assert_eq!(pace.wait(start, 10.5), Duration::from_secs(1));
        let late = start + Duration::from_secs(5);
        assert_eq!(pace.wait(late, 10.5), Duration::ZERO);
        assert_eq!(pace.wait(late, 11.0), Duration::from_secs(1));
        assert_eq!(Pace::new(f64::INFINITY, start, 0.0).wait(start, 100.0), Duration::ZERO);
    }
}

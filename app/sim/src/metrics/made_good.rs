//! Speed made good: how far the whale got over the ground in a straight line, by time.
//!
//! `v = |x(t) - x(t - τ)| / τ`, with `τ` = [`MADE_GOOD_S`], or the time since the start where that is shorter.
//! A whale that tows its gear makes way; one that hangs at gear that is fast does not, though it swims.

use std::collections::VecDeque;

use glam::DVec3;

/// Time over which way is measured [s]; estimate: longer than a turn at the end of a line of some body lengths.
pub const MADE_GOOD_S: f64 = 30.0;
/// Time between places that are kept [s].
const EVERY_S: f64 = 1.0;

/// Places of the whale over the last [`MADE_GOOD_S`].
#[derive(Clone, Debug, Default)]
pub(super) struct MadeGood {
    kept: VecDeque<(f64, DVec3)>,
    now: (f64, DVec3),
}

impl MadeGood {
    pub fn fold(&mut self, time_s: f64, place_m: DVec3) {
        self.now = (time_s, place_m);
        if self.kept.back().is_none_or(|(last_s, _)| time_s - last_s >= EVERY_S) {
            self.kept.push_back(self.now);
        }
        // The first place kept is the last one that is old enough.
        while self.kept.get(1).is_some_and(|(second_s, _)| time_s - second_s >= MADE_GOOD_S) {
            self.kept.pop_front();
        }
    }

    /// Speed made good [m/s]; zero at the start.
    pub fn speed_m_s(&self) -> f64 {
        let Some((then_s, then_m)) = self.kept.front() else { return 0.0 };
        let (now_s, now_m) = self.now;
        if now_s > *then_s { (now_m - *then_m).length() / (now_s - then_s) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(seconds: f64, place: impl Fn(f64) -> DVec3) -> f64 {
        let mut meter = MadeGood::default();
        for step in 0..=(seconds / 0.05).round() as u32 {
            let time_s = 0.05 * f64::from(step);
            meter.fold(time_s, place(time_s));
        }
        meter.speed_m_s()
    }

    #[test]
    fn a_straight_way_is_made_good_whole_and_a_circle_comes_back() {
        let ahead = |time_s: f64| DVec3::new(0.8 * time_s, -0.6 * time_s, 0.0);
        for seconds in [5.0, 30.0, 200.0] {
            assert!((after(seconds, ahead) - 1.0).abs() < 1e-9, "{seconds}");
        }
        // Once round in the time of the window.
        let round = |time_s: f64| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * time_s / MADE_GOOD_S);
            10.0 * DVec3::new(cos, sin, 0.0)
        };
        assert!(after(90.0, round) < 1e-9);
        // What lies longer back than the window does not count.
        let then_still = |time_s: f64| DVec3::X * time_s.min(50.0);
        assert!(after(100.0, then_still) < 1e-9);
        assert!(after(0.0, ahead).abs() < 1e-15);
    }
}

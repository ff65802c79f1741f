//! Break-out: the force with which the seabed holds back a foot that has rested on it and is lifted.
//!
//! With `d` the height of the foot above the bed and `λ` the greatest height since it last set, the force is
//! `F(d) = d E(λ)/λ`. `E` rises in proportion to the break-out force up to 5 mm and falls to zero at 30 mm: beyond, the foot is loose;
//! lowered before, it follows the straight line back to zero. Lifting takes at least the work that lowering returns, so that no energy
//! is gained. On the bed `λ` returns to zero within a minute: the foot sets again.
//! In statics feet set at once and nothing holds them back. The force is a figure of the item; the lengths and the time are
//! estimates; the shape is that of cohesive zones (Alfano and Crisfield 2001, doi:10.1002/nme.93).

use crate::trial::scheme::Scheme;

/// Lift at which the pull is greatest [m].
const PEAK_M: f64 = 0.005;
/// Lift at which a foot is loose [m].
pub(crate) const LOOSE_M: f64 = 0.03;
/// Time in which a loose foot sets again on the bed [s].
const SETTING_S: f64 = 60.0;

/// Downward pull and its stiffness for the solver's matrix at a lift, `before` the greatest so far.
pub(crate) fn pull(break_out_n: f64, lift_m: f64, before_m: f64) -> (f64, f64) {
    let greatest = before_m.max(lift_m);
    if lift_m <= 0.0 || greatest >= LOOSE_M {
        return (0.0, 0.0);
    }
    let envelope = break_out_n * (greatest / PEAK_M).min((LOOSE_M - greatest) / (LOOSE_M - PEAK_M));
    let stiffness = envelope / greatest;
    (stiffness * lift_m, stiffness)
}

/// The greatest lift after a step that ends at a lift.
pub(crate) fn keep(lift_m: f64, before_m: f64, scheme: &Scheme) -> f64 {
    match (lift_m > 0.0, scheme.is_static()) {
        (true, true) => LOOSE_M,
        (true, false) => before_m.max(lift_m).min(LOOSE_M),
        (false, true) => 0.0,
        (false, false) => (before_m - LOOSE_M * scheme.dt / SETTING_S).max(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pull reaches the break-out force, is gone at 30 mm, and any way up and down costs energy.
    #[test]
    fn a_foot_breaks_out_and_gains_nothing() {
        let scheme = Scheme::backward_euler(0.01);
        let (mut mark, mut work, mut peak, mut before) = (0.0, 0.0, 0.0_f64, 0.0);
        for count in 0..20_000 {
            let turn = f64::from(count) * 1e-3;
            let lift = (libm::sin(turn) + 0.3 * libm::sin(7.0 * turn)) * 0.002 * turn;
            let (force, _) = pull(100.0, lift, mark);
            work += force * (lift - before);
            peak = peak.max(force);
            mark = keep(lift, mark, &scheme);
            before = lift;
            assert!(work > -1e-3, "{work} J at {lift} m");
        }
        assert!((peak / 100.0 - 1.0).abs() < 0.01, "{peak}");
        assert!((mark - LOOSE_M).abs() < 1e-12 || work > 0.0);
        assert!(pull(100.0, 0.004, LOOSE_M).0 == 0.0);
    }

    #[test]
    fn a_loose_foot_sets_again_within_a_minute() {
        let scheme = Scheme::backward_euler(0.01);
        let mark = (0..3000).fold(LOOSE_M, |mark, _| keep(-0.001, mark, &scheme));
        assert!((mark - 0.5 * LOOSE_M).abs() < 1e-9, "{mark}");
        assert!((pull(100.0, 0.005, 0.0).0 - 100.0).abs() < 1e-9);
    }
}

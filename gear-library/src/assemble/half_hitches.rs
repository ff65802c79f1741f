//! Two half hitches on a cylinder (a clove hitch).
//!
//! The rope makes a turn to one side of its beginning, crosses over itself to a turn on the other side,
//! and leaves under the crossing. The way is that of two turns (`around.rs`), shifted along the
//! cylinder, and lifted by one thickness of the rope where it crosses.

use endline_sim::DVec3;

use super::around::Around;

/// How far along the cylinder each turn lies from the middle, in thicknesses of the rope.
const APART: f64 = 2.8;
/// Height of what crosses over what it crosses, in thicknesses.
const OVER: f64 = 1.05;
/// Angles at which rope leaves its beginning's height and reaches its turn's [rad].
const LEAVES: (f64, f64) = (0.5, 2.0);
/// Half of the angle over which rope crosses from one turn to the other [rad].
const CROSSES: f64 = 1.2;
/// Angles from the middle at which what crosses begins to come down to the cylinder, and has [rad].
const LANDS: (f64, f64) = (0.6, 1.5);
/// Steps of the way.
const STEPS: u32 = 4000;

/// The way through many places from end to end, for rope of this thickness [m].
pub(super) fn hitched(around: &Around, thick: f64) -> Vec<DVec3> {
    let turn = around.angle(1.0);
    let place = |step: u32| {
        let share = f64::from(step) / f64::from(STEPS);
        let angle = around.angle(share);
        let aside = 2.0 * rise(angle, (0.5 * turn - CROSSES, 0.5 * turn + CROSSES))
            - rise(angle, LEAVES)
            - rise(angle, (turn - LEAVES.1, turn - LEAVES.0));
        let out = 1.0 - rise((angle - 0.5 * turn).abs(), LANDS);
        around.shifted(share, OVER * thick * out, APART * thick * aside)
    };
    (0..=STEPS).map(place).collect()
}

/// 0 before the first, 1 after the second, smooth between.
fn rise(at: f64, (from, to): (f64, f64)) -> f64 {
    let share = ((at - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No two places of the rope more than four thicknesses apart along it come nearer than its thickness, and the centre line
    /// stays off the cylinder.
    #[test]
    #[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    fn a_hitch_lies_on_itself_and_not_in_itself() {
        let (radius, thick) = (0.055, 0.01);
        let ends = [DVec3::new(radius, -0.3, 0.01), DVec3::new(radius, 0.3, -0.01)];
        let around =
            Around::between(ends, DVec3::ZERO, [DVec3::X, DVec3::Y, DVec3::Z], radius, 2.0)
                .unwrap();
        let way: Vec<DVec3> = hitched(&around, thick).into_iter().step_by(5).collect();
        let mut along = vec![0.0];
        way.windows(2)
            .for_each(|pair| along.push(along[along.len() - 1] + pair[0].distance(pair[1])));
        let mut least = f64::INFINITY;
        for one in 0..way.len() {
            assert!(way[one].truncate().length() > radius - 1e-9);
            for other in one + 1..way.len() {
                if along[other] - along[one] > 4.0 * thick {
                    least = least.min(way[one].distance(way[other]));
                }
            }
        }
        assert!(least > 0.98 * thick && least < 1.2 * thick, "{least}");
    }
}

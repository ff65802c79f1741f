//! Ways through places, and places along them.

use endline_sim::DVec3;

/// Length of a way [m].
pub(super) fn length(way: &[DVec3]) -> f64 {
    way.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// The place at a share of the length of a way through two places or more.
pub(super) fn along(way: &[DVec3], share: f64) -> DVec3 {
    let whole = length(way);
    let mut left = share * whole;
    for pair in way.windows(2) {
        let step = pair[0].distance(pair[1]);
        if left <= step && step > 0.0 {
            return pair[0].lerp(pair[1], left / step);
        }
        left -= step;
    }
    way.last().copied().unwrap_or_default()
}

/// A part of a way between two shares of its length.
pub(super) fn part_of(way: &[DVec3], [from, to]: [f64; 2]) -> Vec<DVec3> {
    let whole = length(way);
    let mut part = vec![along(way, from)];
    let mut passed = 0.0;
    for pair in way.windows(2) {
        passed += pair[0].distance(pair[1]) / whole.max(f64::MIN_POSITIVE);
        if passed > from && passed < to {
            part.push(pair[1]);
        }
    }
    part.push(along(way, to));
    part
}

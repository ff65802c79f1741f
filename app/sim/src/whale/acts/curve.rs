//! A value over time through keys: smooth, and never beyond the keys on either side.
//!
//! ```text
//! between keys 0 and 1, h = t1 - t0, s = (t - t0)/h:
//! v(s) = v0 (1 + 2s)(1-s)² + h m0 s(1-s)² + v1 s²(3-2s) - h m1 s²(1-s)
//! slope at an inner key:  0 where the slopes d of the two stretches differ in sign, else
//!                         (w0 + w1)/(w0/d0 + w1/d1),  w0 = 2 h1 + h0,  w1 = h1 + 2 h0
//! ```
//! The value eases in and out at the first and last key, and at every turning point.
//!
//! Reference: Fritsch and Butland, SIAM Journal on Scientific and Statistical Computing 5 (1984) 300-304.

/// A curve through keys in rising order of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    keys: Vec<Key>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Key {
    time_s: f64,
    value: f64,
    slope: f64,
}

impl Curve {
    /// Through `(time [s], value)` in rising order of time; none makes a curve that is zero.
    ///
    /// `repeats`: the last key is followed by the first, so that the curve runs through there as through an inner key.
    #[must_use]
    pub fn through(points: &[(f64, f64)], repeats: bool) -> Self {
        let rise = |from: usize| {
            let ((t0, v0), (t1, v1)) = (points[from], points[from + 1]);
            (t1 - t0, (v1 - v0) / (t1 - t0))
        };
        let last = points.len().saturating_sub(1);
        let slope = |index: usize| match index {
            _ if last == 0 => 0.0,
            0 if repeats => joined(rise(last - 1), rise(0)),
            _ if index == last && repeats => joined(rise(last - 1), rise(0)),
            0 => 0.0,
            _ if index == last => 0.0,
            _ => joined(rise(index - 1), rise(index)),
        };
        let key = |(index, &(time_s, value)): (usize, &(f64, f64))| Key {
            time_s,
            value,
            slope: slope(index),
        };
        Self { keys: points.iter().enumerate().map(key).collect() }
    }

    /// The value at a time; before the first key that of the first, after the last that of the last.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        let after = self.keys.partition_point(|key| key.time_s <= time_s);
        match (after.checked_sub(1).and_then(|before| self.keys.get(before)), self.keys.get(after))
        {
            (Some(from), Some(to)) => between(from, to, time_s),
            (Some(only), None) | (None, Some(only)) => only.value,
            (None, None) => 0.0,
        }
    }

    /// Value of the last key less that of the first: what a curve that repeats gains each time round.
    #[must_use]
    pub fn gain(&self) -> f64 {
        self.keys.last().map_or(0.0, |last| last.value - self.keys[0].value)
    }
}

/// Slope where two stretches, each a length of time and a slope, meet.
fn joined((h0, d0): (f64, f64), (h1, d1): (f64, f64)) -> f64 {
    if d0 * d1 <= 0.0 {
        return 0.0;
    }
    let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
    (w0 + w1) / (w0 / d0 + w1 / d1)
}

fn between(from: &Key, to: &Key, time_s: f64) -> f64 {
    let h = to.time_s - from.time_s;
    let s = (time_s - from.time_s) / h;
    let r = 1.0 - s;
    from.value * (1.0 + 2.0 * s) * r * r
        + h * from.slope * s * r * r
        + to.value * s * s * (3.0 - 2.0 * s)
        - h * to.slope * s * s * r
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_through_its_keys_and_nowhere_beyond_them() {
        let points = [(0.0, 0.0), (1.0, 2.0), (1.5, 1.9), (4.0, -3.0), (5.0, -3.0), (5.5, 7.0)];
        let curve = Curve::through(&points, false);
        for pair in points.windows(2) {
            let ((t0, v0), (t1, v1)) = (pair[0], pair[1]);
            assert!((curve.at(t0) - v0).abs() < 1e-15 && (curve.at(t1) - v1).abs() < 1e-15);
            for part in 0..=100 {
                let value = curve.at(t0 + (t1 - t0) * f64::from(part) / 100.0);
                assert!(
                    (v0.min(v1) - 1e-12..=v0.max(v1) + 1e-12).contains(&value),
                    "{value} between {v0} and {v1}"
                );
            }
        }
        assert!(curve.at(-1.0).abs() < 1e-15 && (curve.at(99.0) - 7.0).abs() < 1e-15);
    }

    /// A straight line is reproduced between inner keys, with its slope; a single key is a constant.
    #[test]
    fn straight_lines_stay_straight_inside() {
        let points: Vec<(f64, f64)> =
            (0..6).map(|i| (f64::from(i) * 0.7, 3.0 - 2.0 * f64::from(i) * 0.7)).collect();
        let curve = Curve::through(&points, false);
        for part in 0..200 {
            let t = 0.7 + 2.1 * f64::from(part) / 200.0;
            assert!((curve.at(t) - (3.0 - 2.0 * t)).abs() < 1e-12, "{t}");
        }
        assert!((Curve::through(&[(1.0, 4.0)], false).at(0.3) - 4.0).abs() < 1e-15);
    }

    /// A curve that repeats has one slope where it closes.
    #[test]
    fn a_curve_that_repeats_closes_smoothly() {
        let points = [(0.0, 0.0), (1.0, 1.0), (2.0, 3.0), (3.0, 4.0)];
        let (open, closed) = (Curve::through(&points, false), Curve::through(&points, true));
        let slope =
            |curve: &Curve, from: f64, to: f64| (curve.at(to) - curve.at(from)) / (to - from);
        assert!(slope(&open, 0.0, 1e-6).abs() < 1e-4, "eases in");
        let (start, end) = (slope(&closed, 0.0, 1e-6), slope(&closed, 3.0 - 1e-6, 3.0));
        assert!(start > 0.5 && (start - end).abs() < 1e-4, "{start} and {end}");
        assert!((closed.gain() - 4.0).abs() < 1e-15);
    }
}

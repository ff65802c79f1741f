//! Smooth curves through tables, without the overshoot of ordinary splines.

/// A monotone cubic through points (Fritsch and Carlson 1980): it rises and falls only where the table does.
#[derive(Clone, Debug)]
pub struct MonotoneCubic {
    points: Vec<[f64; 2]>,
    slopes: Vec<f64>,
}

impl MonotoneCubic {
    /// A curve through points in rising order of their first number; others are left out.
    #[must_use]
    pub fn through(points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for point in points {
            if kept.last().is_none_or(|last| point[0] > last[0]) {
                kept.push(point);
            }
        }
        let slopes = slopes(&kept);
        Self { points: kept, slopes }
    }

    /// The curve's value; beyond its ends that of the end, 0 for a curve without points.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        let above = self.points.partition_point(|point| point[0] <= x);
        match (
            above.checked_sub(1).and_then(|below| self.points.get(below)),
            self.points.get(above),
        ) {
            (Some(&low), Some(&high)) => self.between(above - 1, low, high, x),
            (Some(end), None) | (None, Some(end)) => end[1],
            (None, None) => 0.0,
        }
    }

    fn between(&self, index: usize, low: [f64; 2], high: [f64; 2], x: f64) -> f64 {
        let width = high[0] - low[0];
        let t = (x - low[0]) / width;
        let (t2, t3) = (t * t, t * t * t);
        low[1] * (2.0 * t3 - 3.0 * t2 + 1.0)
            + high[1] * (3.0 * t2 - 2.0 * t3)
            + width
                * (self.slopes[index] * (t3 - 2.0 * t2 + t) + self.slopes[index + 1] * (t3 - t2))
    }
}

/// Slope at each point: the harmonic mean of its neighbours' where they agree in sign, else level.
fn slopes(points: &[[f64; 2]]) -> Vec<f64> {
    let rises: Vec<f64> = points
        .windows(2)
        .map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]))
        .collect();
    (0..points.len())
        .map(|index| match (index.checked_sub(1).map(|before| rises[before]), rises.get(index)) {
            (Some(before), Some(&after)) if before * after > 0.0 => {
                2.0 * before * after / (before + after)
            }
            (Some(_), Some(_)) | (None, None) => 0.0,
            (Some(rise), None) | (None, Some(&rise)) => rise,
        })
        .collect()
}

/// 0 below `low`, 1 above `high`, smooth between; a plain step where the two are one.
#[must_use]
pub fn smooth_step(low: f64, high: f64, x: f64) -> f64 {
    if high <= low {
        return if x < low { 0.0 } else { 1.0 };
    }
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_passes_through_the_table_and_never_overshoots() {
        let table = [[0.0, 1.0], [1.0, 3.0], [1.5, 3.0], [4.0, -2.0], [5.0, 0.0]];
        let curve = MonotoneCubic::through(table);
        for [x, y] in table {
            assert!((curve.at(x) - y).abs() < 1e-12);
        }
        for step in 0..=500 {
            let value = curve.at(f64::from(step) / 100.0);
            assert!((-2.0 - 1e-12..=3.0 + 1e-12).contains(&value));
        }
        assert!((curve.at(1.2) - 3.0).abs() < 1e-12, "level between equal points");
        assert!((curve.at(-1.0) - 1.0).abs() < 1e-12 && curve.at(9.0).abs() < 1e-12);
    }

    /// A straight line comes back as itself.
    #[test]
    fn a_line_stays_a_line() {
        let curve = MonotoneCubic::through([[0.0, 1.0], [0.3, 1.6], [2.0, 5.0]]);
        for step in 0..=20 {
            let x = f64::from(step) / 10.0;
            assert!((curve.at(x) - 1.0 - 2.0 * x).abs() < 1e-12);
        }
    }
}

//! Intervals of statistics without a formula: the statistic of encounters resampled with replacement.
//!
//! Draws come from BLAKE3 of a label, so that a report says the same each time.
//! Reference: Efron 1979 (doi:10.1214/aos/1176344552); the percentile interval.

use super::interval::Interval;

/// Number of resamples.
pub(super) const RESAMPLES: usize = 2000;

/// Indices drawn at random from a label.
pub(super) struct Draws(blake3::OutputReader);

impl Draws {
    pub(super) fn of(label: &str) -> Self {
        Self(
            blake3::Hasher::new_derive_key("endline study bootstrap 1")
                .update(label.as_bytes())
                .finalize_xof(),
        )
    }

    /// An index below `count`.
    pub(super) fn below(&mut self, count: usize) -> usize {
        let mut bytes = [0; 8];
        self.0.fill(&mut bytes);
        // The high half of a product: even to within count/2⁶⁴.
        ((u128::from(u64::from_le_bytes(bytes)) * count as u128) >> 64) as usize
    }

    /// Shuffles values (Fisher and Yates).
    pub(super) fn shuffle<T>(&mut self, values: &mut [T]) {
        for last in (1..values.len()).rev() {
            values.swap(last, self.below(last + 1));
        }
    }
}

/// The interval of a statistic of `count` encounters, given their indices; none where it is mostly undefined.
pub(in crate::study) fn interval(
    label: &str,
    count: usize,
    statistic: impl Fn(&[usize]) -> Option<f64>,
) -> Option<Interval> {
    if count == 0 {
        return None;
    }
    let mut draws = Draws::of(label);
    let mut indices = vec![0; count];
    let mut values: Vec<f64> = (0..RESAMPLES)
        .filter_map(|_| {
            indices.iter_mut().for_each(|index| *index = draws.below(count));
            statistic(&indices)
        })
        .collect();
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        values.get((share * (values.len().max(1) - 1) as f64).round() as usize).copied()
    };
    (2 * values.len() > RESAMPLES).then_some(Interval { low: at(0.025)?, high: at(0.975)? })
}

//! Greatest tension along each line, by unstretched length.
//!
//! A line is divided into bins of [`TENSION_BIN_M`] from end A; the last one may be shorter. The value of a bin is the greatest
//! tension of any segment that lay in it, at least in part, in any accepted solver step, converged or not. It is therefore at least
//! the greatest tension of every place in the bin, also where segments moved along the line.
//!
//! Lengths change rarely. Tensions are therefore collected by segment, and enter the bins when the lengths of their line change.

use crate::model::Model;
use crate::simd::greater;
use crate::state::State;

use super::lines::Peaks;

/// Length of a bin [m]: a few segments near the whale, and less than the distance between two inserts by an order of magnitude.
pub const TENSION_BIN_M: f64 = 0.5;

/// Greatest tensions of all lines by bin.
#[derive(Clone, Debug)]
pub(super) struct BinMeter {
    /// Of each line, from end A [N].
    bins_n: Vec<Vec<f64>>,
    /// Greatest tension of each segment while it had its length of `lengths_m` [N].
    segments_n: Vec<f64>,
    /// Unstretched length of each segment at the last step [m].
    lengths_m: Vec<f64>,
}

impl BinMeter {
    pub(super) fn new(model: &Model) -> Self {
        let count = |segments_m: &[f64]| {
            (segments_m.iter().sum::<f64>() / TENSION_BIN_M).ceil().max(1.0) as usize
        };
        let lines = model.spec.lines.iter();
        Self {
            bins_n: lines.map(|line| vec![0.0; count(&line.segments_m)]).collect(),
            segments_n: vec![0.0; model.segment_count],
            lengths_m: vec![0.0; model.segment_count],
        }
    }

    /// Adds a step with the greatest tension of each segment during it, throughout which segments had the lengths of the state.
    pub(super) fn fold(&mut self, model: &Model, state: &State, peaks: &Peaks<'_>) {
        let now_m = &state.rope.segment_length;
        for (own, bins_n) in model.line_segments.iter().zip(&mut self.bins_n) {
            if are_equal(&self.lengths_m[own.clone()], &now_m[own.clone()]) {
                continue;
            }
            raise_bins(bins_n, &self.lengths_m[own.clone()], &self.segments_n[own.clone()]);
            self.lengths_m[own.clone()].copy_from_slice(&now_m[own.clone()]);
            self.segments_n[own.clone()].fill(0.0);
        }
        for peaks_n in [peaks.converged_n, peaks.unconverged_n] {
            for (greatest_n, peak_n) in self.segments_n.iter_mut().zip(peaks_n) {
                *greatest_n = greater(*greatest_n, *peak_n);
            }
        }
    }

    /// Greatest tension of each bin of a line so far [N].
    pub(super) fn of_line(&self, model: &Model, line: usize) -> Vec<f64> {
        let own = model.line_segments[line].clone();
        let mut bins_n = self.bins_n[line].clone();
        raise_bins(&mut bins_n, &self.lengths_m[own.clone()], &self.segments_n[own]);
        bins_n
    }
}

/// Index of the bin of a place, by its length from end A [m].
pub(super) fn bin_at(at_m: f64, bins: usize) -> usize {
    debug_assert!(at_m >= 0.0 && bins > 0, "a place on a line");
    ((at_m / TENSION_BIN_M) as usize).min(bins - 1)
}

/// Raises each bin to the tensions [N] of the segments in it, by their lengths from end A [m].
fn raise_bins(bins_n: &mut [f64], lengths_m: &[f64], tensions_n: &[f64]) {
    let mut to_m = 0.0;
    for (length_m, tension_n) in lengths_m.iter().zip(tensions_n) {
        let first = bin_at(to_m, bins_n.len());
        to_m += length_m;
        let last = bin_at(to_m, bins_n.len());
        for bin_n in &mut bins_n[first..=last] {
            *bin_n = greater(*bin_n, *tension_n);
        }
    }
}

/// Whether two lists of one length have the same bits, without an early exit, so that the compiler vectorises it.
fn are_equal(one: &[f64], other: &[f64]) -> bool {
    let pairs = one.iter().zip(other);
    pairs.fold(0, |differ, (one, other)| differ | (one.to_bits() ^ other.to_bits())) == 0
}

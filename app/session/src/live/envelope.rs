//! Least and greatest tension along each line over a run so far, so that a plot along the rope shows what it bore.
//!
//! A line is divided into even stretches of its unstretched length, for segments may move along it
//! (`[resolution]`); a segment counts in every stretch that it reaches into.

use endline_sim::{Model, State};

/// Stretches a line is divided into.
pub const STRETCHES: usize = 240;

/// What each stretch of a line bore.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineEnvelope {
    /// Unstretched length of the line [m].
    pub length_m: f64,
    /// Least tension of each stretch, from the line's first end [N].
    pub least_n: Vec<f64>,
    /// Greatest tension of each, peaks between two moments included [N].
    pub greatest_n: Vec<f64>,
}

/// An envelope for each line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Envelope {
    /// By line of the model.
    pub lines: Vec<LineEnvelope>,
}

impl Envelope {
    /// Takes in a state; `peaks_n` are the greatest tensions of its step, by segment.
    pub(super) fn fold(&mut self, model: &Model, state: &State, peaks_n: &[f64]) {
        self.lines.resize(model.spec.lines.len(), LineEnvelope::default());
        for (line, segments) in self.lines.iter_mut().zip(&model.line_segments) {
            let lengths_m = state.rope.segment_length.get(segments.clone()).unwrap_or_default();
            line.begin(lengths_m.iter().sum());
            let mut from_m = 0.0;
            for (segment, length_m) in segments.clone().zip(lengths_m) {
                let tension_n =
                    state.rope.tension.get(segment).map_or(0.0, |tension| tension.max(0.0));
                let peak_n = peaks_n.get(segment).map_or(tension_n, |peak| peak.max(tension_n));
                line.take([from_m, from_m + length_m], tension_n, peak_n);
                from_m += length_m;
            }
        }
    }
}

impl LineEnvelope {
    fn begin(&mut self, length_m: f64) {
        self.length_m = length_m;
        if self.least_n.is_empty() {
            (self.least_n, self.greatest_n) =
                (vec![f64::INFINITY; STRETCHES], vec![0.0; STRETCHES]);
        }
    }

    /// Takes in a segment that lies from and to these lengths of rope [m].
    fn take(&mut self, reach_m: [f64; 2], tension_n: f64, peak_n: f64) {
        let [first, end] = reach_m.map(|at_m| STRETCHES as f64 * at_m / self.length_m.max(1e-12));
        // A segment that ends where a stretch begins does not reach into it, but for the last bits of a sum.
        let (first, last) = ((first + 1e-6) as usize, ((end - 1e-6) as usize).min(STRETCHES - 1));
        for stretch in first.min(last)..=last {
            self.least_n[stretch] = self.least_n[stretch].min(tension_n);
            self.greatest_n[stretch] = self.greatest_n[stretch].max(peak_n);
        }
    }
}

//! Greatest tensions of a step, and those that last one solver step alone.
//!
//! A solver step that did not converge has tensions that are not in balance; its peaks are recorded apart.
//! A spike is an isolated tension: the greatest of a line in a solver step that is [`SPIKE_RATIO`] times that of the one
//! before and of the one after, and [`SPIKE_N`] above both. No mesh and no step follows so short a pull, whether the gear had one or not.

use crate::model::Model;
use crate::simd::greater;

/// How many times the greatest tension of a line is that of the solver steps before and after, in a spike.
pub const SPIKE_RATIO: f64 = 3.0;
/// How far a spike rises above both [N].
pub const SPIKE_N: f64 = 50.0;

/// Counts isolated tensions.
#[derive(Clone, Debug)]
pub(crate) struct SpikeWatch {
    /// Greatest tension of each line in the solver step before the last, and in the last [N]; `None` before there are any.
    earlier: Vec<[Option<f64>; 2]>,
}

impl SpikeWatch {
    /// Nothing seen yet.
    pub fn new(model: &Model) -> Self {
        Self { earlier: vec![[None; 2]; model.spec.lines.len()] }
    }

    /// Records the tensions of a solver step [N]; returns how many lines had a spike in the step before.
    pub fn take(&mut self, model: &Model, tension_n: &[f64]) -> u64 {
        let mut spikes = 0;
        for (earlier, segments) in self.earlier.iter_mut().zip(&model.line_segments) {
            let now = tension_n[segments.clone()].iter().copied().fold(0.0, greater);
            if let [Some(before), Some(peak)] = *earlier {
                spikes += u64::from(is_spike(before, peak, now));
            }
            *earlier = [earlier[1], Some(now)];
        }
        spikes
    }
}

/// Whether the second of three tensions is isolated [N].
fn is_spike(before: f64, peak: f64, after: f64) -> bool {
    let beside = before.max(after);
    peak > SPIKE_RATIO * beside && peak > beside + SPIKE_N
}

/// Raises each peak to a tension above it [N].
pub(super) fn raise(peaks_n: &mut [f64], tension_n: &[f64]) {
    for (peak, tension) in peaks_n.iter_mut().zip(tension_n) {
        *peak = greater(*peak, *tension);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::tests::{model, spec};

    /// Spikes found in the tensions of a line of one segment.
    fn spikes(tensions: &[f64]) -> u64 {
        let model = model(spec(vec![1.0]));
        let mut watch = SpikeWatch::new(&model);
        tensions.iter().map(|tension| watch.take(&model, &[*tension])).sum()
    }

    #[test]
    fn a_tension_alone_in_time_is_a_spike_and_a_snap_that_lasts_is_none() {
        assert_eq!(spikes(&[10.0, 400.0, 12.0]), 1);
        assert_eq!(spikes(&[10.0, 400.0, 380.0, 12.0]), 0, "two steps");
        assert_eq!(spikes(&[10.0, 200.0, 400.0, 150.0, 10.0]), 0, "it rises and falls");
        assert_eq!(spikes(&[300.0, 700.0, 300.0]), 0, "not three times its neighbours");
        assert_eq!(spikes(&[1.0, 40.0, 1.0]), 0, "small");
        assert_eq!(spikes(&[400.0, 10.0, 10.0]), 0, "what came before the first is not known");
        assert_eq!(spikes(&[0.0, 400.0, 0.0, 400.0, 0.0]), 2);
    }
}

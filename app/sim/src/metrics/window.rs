//! Means over the last seconds of a run.

use std::collections::VecDeque;

use crate::model::Model;

/// Over how long drag and effort are averaged [s]; estimate.
pub const DRAG_WINDOW_S: f64 = 5.0;

/// Some readings, now and over the last [`DRAG_WINDOW_S`].
#[derive(Clone, Debug)]
pub(super) struct Window<const N: usize> {
    pub(super) now: [f64; N],
    /// Length of a step and the readings at its end.
    steps: VecDeque<(f64, [f64; N])>,
    held_s: f64,
}

impl<const N: usize> Window<N> {
    pub(super) fn new(model: &Model) -> Self {
        let steps = DRAG_WINDOW_S / model.spec.settings.step_s.max(1e-4);
        Self { now: [0.0; N], steps: VecDeque::with_capacity(steps as usize + 3), held_s: 0.0 }
    }

    pub(super) fn fold(&mut self, readings: [f64; N], dt_s: f64) {
        self.now = readings;
        self.steps.push_back((dt_s, readings));
        self.held_s += dt_s;
        while let Some((oldest_s, _)) = self.steps.front() {
            if self.held_s - oldest_s < DRAG_WINDOW_S {
                break;
            }
            self.held_s -= oldest_s;
            self.steps.pop_front();
        }
    }

    /// Means over the last [`DRAG_WINDOW_S`], or over what there was.
    pub(super) fn mean(&self) -> [f64; N] {
        let time: f64 = self.steps.iter().map(|(dt, _)| dt).sum();
        if time <= 0.0 {
            return self.now;
        }
        std::array::from_fn(|index| {
            self.steps.iter().map(|(dt, readings)| dt * readings[index]).sum::<f64>() / time
        })
    }
}

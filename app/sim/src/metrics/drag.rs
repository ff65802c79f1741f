//! Drag that rope and gear add to the whale.

use std::collections::VecDeque;

use glam::DVec3;

use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::WhaleState;

/// Over how long the added drag is averaged [s]; estimate.
pub const DRAG_WINDOW_S: f64 = 5.0;

/// Added drag, now and over the last seconds.
#[derive(Clone, Debug)]
pub(super) struct DragMeter {
    pub(super) now_n: f64,
    /// Length of a step and the drag at its end.
    window: VecDeque<(f64, f64)>,
    held_s: f64,
}

impl DragMeter {
    pub(super) fn new(model: &Model) -> Self {
        let steps = DRAG_WINDOW_S / model.spec.settings.step_s.max(1e-4);
        Self { now_n: 0.0, window: VecDeque::with_capacity(steps as usize + 3), held_s: 0.0 }
    }

    pub(super) fn fold(&mut self, whale: &WhaleState, contacts: &[ContactPoint], dt_s: f64) {
        self.now_n = added_drag(whale, contacts);
        self.window.push_back((dt_s, self.now_n));
        self.held_s += dt_s;
        while let Some((oldest_s, _)) = self.window.front() {
            if self.held_s - oldest_s < DRAG_WINDOW_S {
                break;
            }
            self.held_s -= oldest_s;
            self.window.pop_front();
        }
    }

    /// Mean over the last [`DRAG_WINDOW_S`], or over what there was [N].
    pub(super) fn mean_n(&self) -> f64 {
        let (time, sum) = self.window.iter().fold((0.0, 0.0), |(time, sum), (dt, drag)| (time + dt, sum + dt * drag));
        if time > 0.0 { sum / time } else { self.now_n }
    }
}

/// How hard contact holds the whale back along its x axis [N].
fn added_drag(whale: &WhaleState, contacts: &[ContactPoint]) -> f64 {
    let on_rope: DVec3 = contacts.iter().map(|contact| contact.normal * contact.normal_force_n + contact.friction_n).sum();
    on_rope.dot(whale.orientation * DVec3::X)
}

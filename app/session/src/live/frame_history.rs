//! Frames kept for looking back, thinned as a run grows so that memory stays bounded.

use std::sync::Arc;

use endline_sim::Frame;

/// Frames kept at most.
const MOST: usize = 3600;

/// Frames of a run at an even stride of steps.
pub(super) struct FrameHistory {
    frames: Vec<Arc<Frame>>,
    stride: u64,
}

impl FrameHistory {
    /// An empty history that keeps every `stride`-th step to begin with.
    pub(super) fn new(stride: u64) -> Self {
        Self { frames: Vec::new(), stride: stride.max(1) }
    }

    /// Whether the frame of a step is one to keep.
    pub(super) fn wants(&self, step: u64) -> bool {
        step.is_multiple_of(self.stride)
    }

    /// Keeps a frame; where the history is full, every other one goes and the stride doubles.
    pub(super) fn keep(&mut self, frame: Arc<Frame>) {
        if self.frames.len() >= MOST {
            self.stride *= 2;
            let stride = self.stride;
            self.frames.retain(|frame| frame.step.is_multiple_of(stride));
        }
        if self.wants(frame.step) {
            self.frames.push(frame);
        }
    }

    /// Every kept frame, in order.
    pub(super) fn all(&self) -> &[Arc<Frame>] {
        &self.frames
    }

    /// The kept frame nearest to a time.
    pub(super) fn nearest(&self, time_s: f64) -> Option<Arc<Frame>> {
        let after = self.frames.partition_point(|frame| frame.time_s < time_s);
        let near = self.frames.get(after.saturating_sub(1)..(after + 1).min(self.frames.len()))?;
        near.iter()
            .min_by(|a, b| (a.time_s - time_s).abs().total_cmp(&(b.time_s - time_s).abs()))
            .cloned()
    }
}

impl FrameHistory {
    /// The frame so many kept frames after the one nearest to a time, or before it; the first or last where there are
    /// no more.
    pub(super) fn beside(&self, time_s: f64, by: i64) -> Option<Arc<Frame>> {
        let at = self.nearest(time_s)?;
        let index = self.frames.partition_point(|frame| frame.step < at.step);
        let last = self.frames.len().checked_sub(1)?;
        self.frames
            .get(index.saturating_add_signed(isize::try_from(by).unwrap_or(0)).min(last))
            .cloned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_beside_one_another_are_found_however_thin_the_history() {
        let mut history = FrameHistory::new(3);
        for step in 0..60_000_u32 {
            if history.wants(u64::from(step)) {
                history.keep(Arc::new(Frame {
                    step: u64::from(step),
                    time_s: f64::from(step) * 0.01,
                    ..Frame::default()
                }));
            }
        }
        let middle = history.nearest(300.0).unwrap();
        let (after, before) =
            (history.beside(300.0, 1).unwrap(), history.beside(300.0, -1).unwrap());
        assert_eq!([after.step - middle.step, middle.step - before.step], [history.stride; 2]);
        assert_eq!(history.beside(300.0, -100_000).unwrap().step, 0);
        assert_eq!(
            history.beside(300.0, 100_000).unwrap().step,
            history.frames.last().unwrap().step
        );
    }

    #[test]
    fn a_long_run_stays_bounded_and_whole() {
        let mut history = FrameHistory::new(3);
        for step in 0..100_000_u32 {
            if history.wants(u64::from(step)) {
                history.keep(Arc::new(Frame {
                    step: u64::from(step),
                    time_s: f64::from(step) * 0.01,
                    ..Frame::default()
                }));
            }
        }
        assert!(history.frames.len() <= MOST);
        for time_s in [0.0, 123.4, 567.8, 999.0] {
            let near = history.nearest(time_s).unwrap();
            assert!(
                (near.time_s - time_s).abs() <= 0.5 * 0.01 * history.stride as f64 + 1e-9,
                "{time_s}: {}",
                near.time_s
            );
        }
        assert_eq!(history.nearest(1e9).unwrap().step, history.frames.last().unwrap().step);
    }
}

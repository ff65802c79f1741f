//! The history of a run for plots and for playback: depth, speed, wraps and forces, tensions along lines, frames.
//!
//! For tensions, a line is divided into even stretches of its unstretched length, because segments may move along it
//! (`[resolution]`); a segment counts in every stretch that it reaches into.

use std::sync::Arc;

use endline_sdk::BodyPart;
use endline_sim::{ContactPoint, Frame, Model, State};

use crate::run::{Moment, Run};

const PARTS: usize = BodyPart::ALL.len();

/// A value kept over time; its index is where it stands in a sample of [`LiveView::history`](super::LiveView::history).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Depth of the whale's middle [m].
    Depth,
    /// Its speed through the water [m/s].
    Speed,
    /// Place of its middle, to the east [m].
    East,
    /// Place of its middle, to the north [m].
    North,
    /// Wraps on a part [turns].
    Wraps(BodyPart),
    /// Greatest sum of normal forces on a part since the sample before [N].
    Force(BodyPart),
}

/// Number of channels of the whole whale, which precede those of its parts.
const WHOLE: usize = 4;

impl Channel {
    /// Where it stands in a sample.
    pub fn index(self) -> usize {
        match self {
            Self::Depth => 0,
            Self::Speed => 1,
            Self::East => 2,
            Self::North => 3,
            Self::Wraps(part) => WHOLE + part as usize,
            Self::Force(part) => WHOLE + PARTS + part as usize,
        }
    }
}

/// Greatest force on each part since the last sample.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    peak_n: [f64; PARTS],
}

impl Watch {
    /// Takes in the contacts of a step.
    pub(super) fn fold(&mut self, contacts: &[ContactPoint]) {
        let mut now_n = [0.0; PARTS];
        for contact in contacts {
            now_n[contact.region.part() as usize] += contact.normal_force_n.max(0.0);
        }
        self.peak_n.iter_mut().zip(now_n).for_each(|(peak, now)| *peak = peak.max(now));
    }

    /// The sample of a run's moment; forces start from zero. Empty where there is no whale.
    pub(super) fn sample(&mut self, run: &Run) -> Vec<f64> {
        let peak_n = std::mem::take(&mut self.peak_n);
        let Some((whale, summary)) = run.state().whale.as_ref().zip(run.summary().whale) else {
            return Vec::new();
        };
        let place = whale.position;
        let mut sample = vec![-place.z, whale.speed_m_s, place.x, place.y];
        debug_assert_eq!(sample.len(), WHOLE);
        sample.extend(summary.regions.iter().map(|region| region.wraps));
        sample.extend(peak_n);
        sample
    }
}

/// Stretches a line is divided into.
pub const STRETCHES: usize = 240;

/// Tensions of each stretch of a line.
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
                line.widen([from_m, from_m + length_m], tension_n, peak_n);
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
    fn widen(&mut self, reach_m: [f64; 2], tension_n: f64, peak_n: f64) {
        let [first, end] = reach_m.map(|at_m| STRETCHES as f64 * at_m / self.length_m.max(1e-12));
        // A segment that ends where a stretch begins does not reach into it, but for the last bits of a sum.
        let (first, last) = ((first + 1e-6) as usize, ((end - 1e-6) as usize).min(STRETCHES - 1));
        for stretch in first.min(last)..=last {
            self.least_n[stretch] = self.least_n[stretch].min(tension_n);
            self.greatest_n[stretch] = self.greatest_n[stretch].max(peak_n);
        }
    }
}

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

    /// Stores a frame; where the history is full, every other one is dropped and the stride doubles.
    pub(super) fn store(&mut self, frame: Arc<Frame>) {
        if self.frames.len() >= MOST {
            self.stride *= 2;
            let stride = self.stride;
            self.frames.retain(|frame| frame.step.is_multiple_of(stride));
        }
        if self.wants(frame.step) {
            self.frames.push(frame);
        }
    }

    /// Drops the frames after a step.
    pub(super) fn truncate(&mut self, step: u64) {
        self.frames.retain(|frame| frame.step <= step);
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
    /// The stored frame `by` frames after the one nearest to a time, before it where `by` is negative; the first or last where there are
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

/// Simulated time between kept states of a run [s].
const BETWEEN_STATES_S: f64 = 2.0;

/// States kept at most.
const MOST_STATES: usize = 64;

/// A state of a run from which it can be continued, with what was stored of the run until then.
#[derive(Clone)]
pub(super) struct KeptState {
    pub(super) moment: Moment,
    /// Samples of each series.
    pub(super) samples: usize,
    pub(super) watch: Watch,
    pub(super) peak_n: Vec<f64>,
    pub(super) envelope: Envelope,
}

/// States of a run at an even stride of steps; where they are too many, every other one is dropped and the stride doubles.
pub(super) struct KeptStates {
    states: Vec<KeptState>,
    stride: u64,
}

impl KeptStates {
    /// No states; the first stride is two simulated seconds of a run with steps of this length [s].
    pub(super) fn new(step_s: f64) -> Self {
        Self { states: Vec::new(), stride: (BETWEEN_STATES_S / step_s).round().max(1.0) as u64 }
    }

    /// Whether the state of a step is one to keep.
    pub(super) fn wants(&self, step: u64) -> bool {
        step > 0 && step.is_multiple_of(self.stride)
    }

    /// Stores a state, later than all before.
    pub(super) fn store(&mut self, state: KeptState) {
        if self.states.len() >= MOST_STATES {
            self.stride *= 2;
            let stride = self.stride;
            self.states.retain(|kept| (kept.moment.step() as u64).is_multiple_of(stride));
        }
        if self.wants(state.moment.step() as u64) {
            self.states.push(state);
        }
    }

    /// The last state at or before a step; those after it are dropped.
    pub(super) fn back_to(&mut self, step: usize) -> Option<KeptState> {
        self.states.truncate(self.states.partition_point(|kept| kept.moment.step() <= step));
        self.states.last().cloned()
    }

    /// Replaces each moment by that of another model; those that are not known are dropped.
    pub(super) fn convert(&mut self, other: impl Fn(Moment) -> Option<Moment>) {
        let states = std::mem::take(&mut self.states).into_iter();
        let converted = |kept: KeptState| Some(KeptState { moment: other(kept.moment)?, ..kept });
        self.states = states.filter_map(converted).collect();
    }
}

/// Samples in a full chunk.
const CHUNK: usize = 256;

/// Samples of every line. Full chunks are shared, so that a copy costs little however long the
/// run is.
#[derive(Clone, Debug, Default)]
pub struct Series {
    full: Vec<Arc<Chunk>>,
    open: Chunk,
}

/// Samples in a row.
#[derive(Clone, Debug, Default)]
struct Chunk {
    time_s: Vec<f64>,
    /// By sample, then line.
    values: Vec<Vec<f64>>,
}

/// Least and greatest value over a stretch of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Start of the stretch [s].
    pub time_s: f64,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
}

impl Series {
    /// Adds a sample: a time, later than all before, and a value for each line.
    pub fn push(&mut self, time_s: f64, values: Vec<f64>) {
        self.open.time_s.push(time_s);
        self.open.values.push(values);
        if self.open.time_s.len() == CHUNK {
            self.full.push(Arc::new(std::mem::take(&mut self.open)));
        }
    }

    /// Drops all samples after the first `count`.
    pub(super) fn truncate(&mut self, count: usize) {
        if let Some(chunk) = self.full.get(count / CHUNK) {
            self.open = Chunk::clone(chunk);
            self.full.truncate(count / CHUNK);
        }
        self.open.time_s.truncate(count % CHUNK);
        self.open.values.truncate(count % CHUNK);
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.full.len() * CHUNK + self.open.time_s.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Every sample of a line: time and value.
    pub fn samples(&self, line: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        let chunks = self.full.iter().map(Arc::as_ref).chain(std::iter::once(&self.open));
        chunks.flat_map(move |chunk| {
            chunk
                .time_s
                .iter()
                .zip(&chunk.values)
                .filter_map(move |(time_s, values)| Some((*time_s, *values.get(line)?)))
        })
    }

    /// A line as at most `count` spans, so that no peak is lost however many samples there are.
    pub fn spans(&self, line: usize, count: usize) -> Vec<Span> {
        let stride = self.len().div_ceil(count.max(1)).max(1);
        let mut spans: Vec<Span> = Vec::with_capacity(count);
        for (index, (time_s, value)) in self.samples(line).enumerate() {
            match spans.last_mut() {
                Some(span) if !index.is_multiple_of(stride) => {
                    span.min = span.min.min(value);
                    span.max = span.max.max(value);
                }
                _ => spans.push(Span { time_s, min: value, max: value }),
            }
        }
        spans
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_has_a_place_of_its_own() {
        let parts = || BodyPart::ALL.into_iter();
        let all = [Channel::Depth, Channel::Speed, Channel::East, Channel::North]
            .into_iter()
            .chain(parts().map(Channel::Wraps))
            .chain(parts().map(Channel::Force));
        let places: Vec<usize> = all.map(Channel::index).collect();
        assert_eq!(places, (0..WHOLE + 2 * PARTS).collect::<Vec<_>>());
    }

    #[test]
    fn frames_beside_one_another_are_found_however_thin_the_history() {
        let mut history = FrameHistory::new(3);
        for step in 0..60_000_u32 {
            if history.wants(u64::from(step)) {
                history.store(Arc::new(Frame {
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
                history.store(Arc::new(Frame {
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

    #[test]
    fn spans_keep_every_peak() {
        let mut series = Series::default();
        for index in 0..1000_u32 {
            let value = if index == 777 { 42.0 } else { 1.0 };
            series.push(f64::from(index) * 0.1, vec![0.0, value]);
        }
        assert_eq!(series.len(), 1000);
        assert_eq!(series.samples(1).count(), 1000);
        let spans = series.spans(1, 100);
        assert_eq!(spans.len(), 100);
        let peak = spans.iter().max_by(|a, b| a.max.total_cmp(&b.max)).unwrap();
        assert!((peak.max - 42.0).abs() < 1e-12 && (peak.time_s - 77.0).abs() < 1e-9, "{peak:?}");
        assert!(spans.is_sorted_by(|a, b| a.time_s < b.time_s));
    }
}

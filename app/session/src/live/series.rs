//! A value of every line over time, cheap to publish and quick to draw.

use std::sync::Arc;

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

    /// How many samples there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.full.len() * CHUNK + self.open.time_s.len()
    }

    /// Whether there are none.
    #[must_use]
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
    #[must_use]
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

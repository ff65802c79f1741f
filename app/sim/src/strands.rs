//! Strands: lines joined end to end at splices, so that a wrap across a splice is counted as one.

use endline_sdk::LineEnd;

use crate::model::{JointKind, Model};

/// Position of every segment in its strand; lengths are those of the last [`Strands::measure`].
#[derive(Clone, Debug)]
pub(crate) struct Strands {
    /// Position of each segment of the model's layout.
    pub(crate) places: Vec<Place>,
    /// Segments of each strand, in order from its start.
    segments: Vec<Vec<usize>>,
}

/// Position of a segment in its strand.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Place {
    /// Index of the strand.
    pub(crate) strand: usize,
    /// Number of segments of the strand before it.
    pub(crate) order: usize,
    /// Unstretched length before the segment [m].
    pub(crate) arc_m: f64,
    /// Its unstretched length [m].
    pub(crate) length_m: f64,
    /// Whether its line runs opposite to the strand.
    pub(crate) reversed: bool,
}

impl Place {
    /// Unstretched length from the strand's start to a fraction of the segment [m].
    pub(crate) fn arc_at(&self, fraction: f64) -> f64 {
        self.arc_m + self.length_m * if self.reversed { 1.0 - fraction } else { fraction }
    }
}

impl Strands {
    pub(crate) fn new(model: &Model) -> Self {
        let mut strands =
            Self { places: vec![Place::default(); model.segment_count], segments: Vec::new() };
        let mut laid = vec![false; model.spec.lines.len()];
        for line in 0..model.spec.lines.len() {
            if !laid[line] {
                let (first, end) = strand_start(model, line);
                strands.lay(model, first, end, &mut laid);
            }
        }
        strands
    }

    /// Segments of each strand, in order.
    pub(crate) fn lists(&self) -> &[Vec<usize>] {
        &self.segments
    }

    /// Updates the lengths from a state.
    pub(crate) fn measure(&mut self, segment_length: &[f64]) {
        debug_assert_eq!(segment_length.len(), self.places.len(), "one length per segment");
        for strand in &self.segments {
            let mut arc_m = 0.0;
            for &segment in strand {
                let place = &mut self.places[segment];
                (place.arc_m, place.length_m) = (arc_m, segment_length[segment]);
                arc_m += place.length_m;
            }
        }
    }

    /// Whether no segment between two segments of a strand is cut, both included.
    pub(crate) fn whole(&self, from: &Place, to: &Place, cut: &[bool]) -> bool {
        debug_assert_eq!(from.strand, to.strand, "both segments belong to one strand");
        let (low, high) = (from.order.min(to.order), from.order.max(to.order));
        self.segments[from.strand][low..=high].iter().all(|segment| !cut[*segment])
    }

    /// Appends a strand that starts at end `entered` of `line` and continues across splices.
    fn lay(&mut self, model: &Model, mut line: usize, mut entered: LineEnd, laid: &mut [bool]) {
        let (strand, mut order) = (self.segments.len(), Vec::new());
        loop {
            laid[line] = true;
            let reversed = entered == LineEnd::B;
            let segments = model.line_segments[line].clone();
            let mut lay_one = |segment: usize| {
                self.places[segment] =
                    Place { strand, order: order.len(), arc_m: 0.0, length_m: 0.0, reversed };
                order.push(segment);
            };
            if reversed {
                segments.rev().for_each(&mut lay_one)
            } else {
                segments.for_each(&mut lay_one)
            }
            match spliced_to(model, line, other(entered)) {
                Some((next, end)) if !laid[next] => (line, entered) = (next, end),
                _ => break,
            }
        }
        self.segments.push(order);
    }
}

/// Line and end at which the strand through `line` starts; `line` itself if the strand is a ring.
fn strand_start(model: &Model, line: usize) -> (usize, LineEnd) {
    let (mut at, mut end) = (line, LineEnd::A);
    while let Some((before, joined)) = spliced_to(model, at, end) {
        if before == line {
            return (line, LineEnd::A);
        }
        (at, end) = (before, other(joined));
    }
    (at, end)
}

/// The other line end at the free joint of `end` of `line`, if exactly two line ends meet there.
fn spliced_to(model: &Model, line: usize, end: LineEnd) -> Option<(usize, LineEnd)> {
    let joint = joint_at(model, line, end);
    if model.spec.joints.get(joint).is_none_or(|joint| joint.kind != JointKind::Free) {
        return None;
    }
    let mut others = ends_at(model, joint).filter(|found| *found != (line, end));
    let found = others.next();
    if others.next().is_some() { None } else { found }
}

/// All line ends at a joint.
pub(crate) fn ends_at(model: &Model, joint: usize) -> impl Iterator<Item = (usize, LineEnd)> {
    let ends =
        (0..model.spec.lines.len()).flat_map(|line| [(line, LineEnd::A), (line, LineEnd::B)]);
    ends.filter(move |(line, end)| joint_at(model, *line, *end) == joint)
}

/// The joint at an end of a line.
pub(crate) fn joint_at(model: &Model, line: usize, end: LineEnd) -> usize {
    match end {
        LineEnd::A => model.spec.lines[line].from,
        LineEnd::B => model.spec.lines[line].to,
    }
}

/// The other end.
pub(crate) fn other(end: LineEnd) -> LineEnd {
    match end {
        LineEnd::A => LineEnd::B,
        LineEnd::B => LineEnd::A,
    }
}

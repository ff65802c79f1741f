//! Places on lines: where a length of rope lies, and which rope is near a place of a picture.

use endline_sim::{Frame, Model};
use glam::{DVec2, DVec3};

use super::{NEAR, Picked, Sight, Thin};

/// The rope nearest to the pointer on screen, of those within reach.
pub(super) fn rope(model: &Model, frame: &Frame, sight: &Sight<'_>) -> Option<Thin> {
    let mut best: Option<Thin> = None;
    for (line, segments) in model.line_segments.iter().enumerate() {
        let (first, mut before_m) = (model.line_nodes[line].start, 0.0);
        for (order, segment) in segments.clone().enumerate() {
            let length_m = *frame.segment_length_m.get(segment)?;
            let ends = [*frame.nodes.get(first + order)?, *frame.nodes.get(first + order + 1)?];
            let whole = !frame.cut.get(segment).copied().unwrap_or(false);
            if let Some((beside, share)) = sight.beside(ends).filter(|_| whole)
                && beside <= NEAR
                && best.is_none_or(|best| beside < best.beside)
            {
                let away_m = sight.away_m(ends[0].lerp(ends[1], share));
                let picked = Picked::Rope { line, at_m: before_m + share * length_m };
                best = Some(Thin { beside, away_m, picked });
            }
            before_m += length_m;
        }
    }
    best
}

/// Where a length of rope from a line's first end lies: its segment and the share of it; `None` where there is no such line.
#[must_use]
pub fn on_line(model: &Model, frame: &Frame, line: usize, at_m: f64) -> Option<(usize, f64)> {
    let segments = model.line_segments.get(line)?.clone();
    let (mut before_m, last) = (0.0, segments.end.checked_sub(1)?);
    for segment in segments {
        let length_m = *frame.segment_length_m.get(segment)?;
        if at_m <= before_m + length_m || segment == last {
            return Some((segment, ((at_m - before_m) / length_m.max(1e-12)).clamp(0.0, 1.0)));
        }
        before_m += length_m;
    }
    None
}

/// Unstretched rope from a line's first end to a share of one of its segments [m].
#[must_use]
pub fn along_m(
    model: &Model,
    frame: &Frame,
    line: usize,
    segment: usize,
    share: f64,
) -> Option<f64> {
    let first = model.line_segments.get(line)?.start;
    let before = frame.segment_length_m.get(first..segment)?.iter().sum::<f64>();
    Some(before + share * frame.segment_length_m.get(segment)?)
}

/// Both ends of a segment of a line [m].
#[must_use]
pub fn ends(model: &Model, frame: &Frame, line: usize, segment: usize) -> Option<[DVec3; 2]> {
    let first = model.line_nodes.get(line)?.start
        + segment.checked_sub(model.line_segments.get(line)?.start)?;
    Some([*frame.nodes.get(first)?, *frame.nodes.get(first + 1)?])
}

/// Unstretched length of a line [m].
#[must_use]
pub fn length_m(model: &Model, frame: &Frame, line: usize) -> f64 {
    model
        .line_segments
        .get(line)
        .and_then(|segments| frame.segment_length_m.get(segments.clone()))
        .map_or(0.0, |all| all.iter().sum())
}

impl Sight<'_> {
    /// How far beside a straight stretch the pointer is on screen, and the share of it that is nearest [points]; `None` behind the eye.
    pub(super) fn beside(&self, ends: [DVec3; 2]) -> Option<(f64, f64)> {
        let [a, b] = ends.map(|end| self.camera.project(end, self.size));
        let (a, b): (DVec2, DVec2) = (a?, b?);
        let share =
            ((self.at - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
        Some(((a + (b - a) * share - self.at).length(), share))
    }
}

//! Weak links and ropes part: a link when the tension at its end of the line passes its rating, a rope
//! when the tension of a segment passes its strength there, which a knot or splice lowers in the segment at that end (of
//! segments above it the one most above its own goes). The segment is then cut: it pulls and touches nothing.

use endline_sdk::LineEnd;

use crate::model::{Link, Model, Strength};
use crate::state::State;

/// How far above its rating something may part before the step is redone shorter.
const LATE: f64 = 1.005;

/// The segment a link sits on.
#[must_use]
pub fn link_segment(model: &Model, link: &Link) -> usize {
    let segments = &model.line_segments[link.line];
    match link.end {
        LineEnd::A => segments.start,
        LineEnd::B => segments.end - 1,
    }
}

/// Whether no tension comes up to the weakest link or line end of all.
fn holds(model: &Model, tension: &[f64]) -> bool {
    let links = model.spec.links.iter().filter(|link| link.enabled).map(|link| link.rating_n);
    let lines = model.spec.lines.iter().map(|line| {
        let Strength { all, end_a, end_b } = line.strength;
        model.spec.ropes[line.rope].strength_n * all * end_a.min(end_b).min(1.0)
    });
    let weakest = links.chain(lines).fold(f64::INFINITY, f64::min);
    tension.iter().all(|tension| *tension <= weakest)
}

/// Whether these tensions pass a rating or strength by so much that it should have parted sooner.
pub(crate) fn too_late(model: &Model, state: &State, tension: &[f64]) -> bool {
    if holds(model, tension) {
        return false;
    }
    let link_late = |link: &Link| {
        let segment = link_segment(model, link);
        link.enabled && !state.rope.cut[segment] && tension[segment] > LATE * link.rating_n
    };
    let rope_late = |segment: usize| {
        !state.rope.cut[segment] && tension[segment] > LATE * model.segment_strength_n[segment]
    };
    model.spec.links.iter().any(link_late) || (0..model.segment_count).any(rope_late)
}

/// Parts what is above its rating or strength; whether anything parted.
pub(crate) fn part(model: &Model, state: &mut State) -> bool {
    let mut parted = false;
    if holds(model, &state.rope.tension) {
        return parted;
    }
    for (index, link) in model.spec.links.iter().enumerate() {
        let segment = link_segment(model, link);
        if link.enabled && !state.rope.cut[segment] && state.rope.tension[segment] > link.rating_n {
            state.link_parted_s[index] = Some(state.time_s);
            cut(state, segment);
            parted = true;
        }
    }
    for index in 0..model.spec.lines.len() {
        let load = |segment: usize| state.rope.tension[segment] / model.segment_strength_n[segment];
        let over = |segment: &usize| !state.rope.cut[*segment] && load(*segment) > 1.0;
        let segments = model.line_segments[index].clone();
        let Some(worst) =
            segments.filter(over).max_by(|one, other| load(*one).total_cmp(&load(*other)))
        else {
            continue;
        };
        note_line(model, state, worst);
        cut(state, worst);
        parted = true;
    }
    parted
}

/// Notes when and where a line parts for the first time: at the middle of a segment.
pub(crate) fn note_line(model: &Model, state: &mut State, segment: usize) {
    let place = (state.time_s, state.arc(model, segment, 0.5));
    state.line_parted[model.segment_line[segment]].get_or_insert(place);
}

/// Cuts one segment.
pub(crate) fn cut(state: &mut State, segment: usize) {
    state.rope.cut[segment] = true;
    state.rope.tension[segment] = 0.0;
}

//! Parting of weak links and ropes.
//!
//! A link parts when the tension `T` of the end segment of its line exceeds its rating. A rope parts at the segment with the
//! greatest ratio `T/S > 1`, where the strength `S` of a segment includes the factor of a knot or splice at that end, and is at most
//! that of the weak places that lie in it. The segment is then cut: it exerts no force and has no contact. `T`, `S` and ratings are in newtons.

use endline_sdk::LineEnd;

use crate::model::{Link, Model, Strength, Weakest};
use crate::state::State;

/// Ratio of tension to rating above which the step is repeated with a shorter length.
const LATE: f64 = 1.005;

/// Segment of a link.
pub fn link_segment(model: &Model, link: &Link) -> usize {
    let segments = &model.line_segments[link.line];
    match link.end {
        LineEnd::A => segments.start,
        LineEnd::B => segments.end - 1,
    }
}

/// Whether no tension exceeds the rating or strength of the weakest link, line end or weak place, or nothing can part.
fn holds(model: &Model, tension: &[f64]) -> bool {
    debug_assert_eq!(tension.len(), model.segment_count, "one tension per segment");
    if model.spec.settings.unbreakable {
        return true;
    }
    let links = model.spec.links.iter().filter(|link| link.enabled).map(|link| link.rating_n);
    let lines = model.spec.lines.iter().map(|line| {
        let Strength { all, end_a, end_b } = line.strength;
        model.spec.ropes[line.rope].strength_n * all * end_a.min(end_b).min(1.0)
    });
    let places = model.spec.lines.iter().flat_map(|line| &line.weak_places);
    let places = places.map(|place| place.strength_n);
    let weakest = links.chain(lines).chain(places).fold(f64::INFINITY, f64::min);
    tension.iter().all(|tension| *tension <= weakest)
}

/// Whether a tension exceeds a rating or strength by more than [`LATE`] allows.
pub(crate) fn too_late(model: &Model, state: &State, tension: &[f64]) -> bool {
    if holds(model, tension) {
        return false;
    }
    let link_late = |link: &Link| {
        let segment = link_segment(model, link);
        link.enabled && !state.rope.cut[segment] && tension[segment] > LATE * link.rating_n
    };
    let segment_late = |(segment, weakest): (usize, Weakest)| {
        !state.rope.cut[segment] && tension[segment] > LATE * weakest.strength_n
    };
    let line_late = |line: usize| weakest(model, state, line).any(segment_late);
    model.spec.links.iter().any(link_late) || (0..model.spec.lines.len()).any(line_late)
}

/// The segments of a line, each with where it is weakest now.
fn weakest<'a>(
    model: &'a Model,
    state: &'a State,
    line: usize,
) -> impl Iterator<Item = (usize, Weakest)> + 'a {
    model.line_segments[line].clone().zip(model.weakest(line, &state.rope.segment_length))
}

/// Parts links and ropes above their rating or strength; returns whether any parted.
pub(crate) fn part(model: &Model, state: &mut State) -> bool {
    let mut parted = false;
    if holds(model, &state.rope.tension) {
        return parted;
    }
    for (index, link) in model.spec.links.iter().enumerate() {
        let segment = link_segment(model, link);
        if link.enabled && !state.rope.cut[segment] && state.rope.tension[segment] > link.rating_n {
            state.link_parted_s[index] = Some(state.time_s);
            cut(model, state, segment);
            parted = true;
        }
    }
    for index in 0..model.spec.lines.len() {
        let load = |(segment, weakest): &(usize, Weakest)| {
            state.rope.tension[*segment] / weakest.strength_n
        };
        let over = |one: &(usize, Weakest)| !state.rope.cut[one.0] && load(one) > 1.0;
        let all = weakest(model, state, index);
        let Some((worst, Weakest { at_m, .. })) =
            all.filter(over).max_by(|one, other| load(one).total_cmp(&load(other)))
        else {
            continue;
        };
        record_parted_line(model, state, worst, at_m);
        cut(model, state, worst);
        parted = true;
    }
    parted
}

/// Records time and position of a line's first break in a segment: at a length from end A [m], or at the segment's middle.
pub(crate) fn record_parted_line(
    model: &Model,
    state: &mut State,
    segment: usize,
    at_m: Option<f64>,
) {
    let at_m = at_m.unwrap_or_else(|| state.arc(model, segment, 0.5));
    let time_s = state.time_s;
    state.line_parted[model.segment_line[segment]].get_or_insert((time_s, at_m));
}

/// Cuts a segment. Its gear is released if it is held.
pub(crate) fn cut(model: &Model, state: &mut State, segment: usize) {
    state.step_control.still_steps[model.gears.of_line[model.segment_line[segment]]] = 0;
    state.rope.cut[segment] = true;
    state.rope.tension[segment] = 0.0;
}

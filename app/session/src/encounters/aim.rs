//! Where the whale starts, aimed at rope of gear at rest.
//!
//! The snout starts `gap` short of the aim along the whale's bearing and `offset` to starboard of it: with the unit vectors
//! `f` ahead and `s` to starboard, mid-body is at `aim - (gap + L/2) f + offset s`, at the depth drawn, for a whale of length L.
//! The aim is the place of the line at rest at that depth. With the prior `along` it is instead the place of the lines at rest at that
//! share of their length, whatever the depth, as suits lines that lie along the seabed.
//! Bearings count from where the current flows: 0 goes with the tide.

use endline_gear::{At, hint};
use endline_sim::{DVec3, Model, State};

use crate::error::Error;

/// The lines of a model that a study aims at, in its order; a line made of pieces is all its pieces. All lines if it names none.
pub(crate) fn lines_aimed_at(model: &Model, wanted: &[At<String>]) -> Result<Vec<usize>, Error> {
    if wanted.is_empty() {
        return Ok((0..model.spec.lines.len()).collect());
    }
    let mut lines = Vec::new();
    for id in wanted {
        let own = lines_named(model, &id.value);
        if own.is_empty() {
            let message = format!("the baseline's gear has no line `{}`", id.value);
            let known = model.spec.lines.iter().map(|line| line.id.as_str());
            return Err(id.place.error(message, hint(&id.value, known)).into());
        }
        lines.extend(own);
    }
    Ok(lines)
}

/// The lines of an id: the line itself, or the pieces of which it is made.
pub(crate) fn lines_named(model: &Model, id: &str) -> Vec<usize> {
    let is_piece = |known: &str| known.strip_prefix(id).is_some_and(|rest| rest.starts_with('.'));
    let lines = model.spec.lines.iter().enumerate();
    let own = lines.filter(|(_, line)| line.id == id || is_piece(&line.id));
    own.map(|(index, _)| index).collect()
}

/// East and north of the first of these lines at a depth, else of the node nearest to that depth [m].
pub(crate) fn rope_at(
    model: &Model,
    state: &State,
    lines: &[usize],
    depth_m: f64,
) -> Option<[f64; 2]> {
    let mut nearest: Option<(f64, [f64; 2])> = None;
    for line in lines {
        let nodes = &state.rope.position[model.line_nodes[*line].clone()];
        for pair in nodes.windows(2) {
            let [above, below] = [pair[0].z + depth_m, pair[1].z + depth_m];
            if (above < 0.0) != (below < 0.0) {
                let place = pair[0].lerp(pair[1], above / (above - below));
                return Some([place.x, place.y]);
            }
        }
        for node in nodes {
            let off = (node.z + depth_m).abs();
            if nearest.is_none_or(|(least, _)| off < least) {
                nearest = Some((off, [node.x, node.y]));
            }
        }
    }
    nearest.map(|(_, place)| place)
}

/// East and north of these lines, one after another, at a share of their whole length at rest [m].
pub(crate) fn rope_along(
    model: &Model,
    state: &State,
    lines: &[usize],
    share: f64,
) -> Option<[f64; 2]> {
    let lines = lines.iter().map(|line| &state.rope.position[model.line_nodes[*line].clone()]);
    let segments: Vec<[DVec3; 2]> =
        lines.flat_map(|nodes| nodes.windows(2).map(|pair| [pair[0], pair[1]])).collect();
    along(&segments, share).map(|place| [place.x, place.y])
}

/// The place at a share of the length of segments, one after another.
fn along(segments: &[[DVec3; 2]], share: f64) -> Option<DVec3> {
    let whole: f64 = segments.iter().map(|[from, to]| from.distance(*to)).sum();
    let mut left = share * whole;
    for [from, to] in segments {
        let length = from.distance(*to);
        if left <= length && length > 0.0 {
            return Some(from.lerp(*to, left / length));
        }
        left -= length;
    }
    segments.last().map(|[_, end]| *end)
}

/// East and north of mid-body at the start: `back_m` behind the aim along the bearing, `aside_m` to starboard [m].
pub(crate) fn start_m(aim_m: [f64; 2], bearing: f64, [back_m, aside_m]: [f64; 2]) -> [f64; 2] {
    let (east, north) = (libm::sin(bearing), libm::cos(bearing));
    [aim_m[0] - back_m * east + aside_m * north, aim_m[1] - back_m * north - aside_m * east]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two lines of 3 m and 1 m, apart from each other: half of their length is 2 m along the first, 7/8 the middle of the second.
    #[test]
    fn a_share_of_lines_counts_their_lengths() {
        let place = |x, z| DVec3::new(x, 0.0, z);
        let segments = [[place(0.0, 0.0), place(3.0, 0.0)], [place(9.0, 0.0), place(9.0, 1.0)]];
        for (share, x, z) in [(0.0, 0.0, 0.0), (0.5, 2.0, 0.0), (0.875, 9.0, 0.5), (1.0, 9.0, 1.0)]
        {
            let found = along(&segments, share).unwrap();
            assert!(found.distance(place(x, z)) < 1e-12, "{share}: {found:?}");
        }
        assert!(along(&[], 0.5).is_none());
    }

    /// A whale that swims east, 10 m before the aim and 2 m to starboard, starts 10 m west and 2 m south of it.
    #[test]
    fn a_whale_starts_behind_the_aim_and_to_starboard() {
        let start = start_m([3.0, 4.0], std::f64::consts::FRAC_PI_2, [10.0, 2.0]);
        assert!((start[0] + 7.0).abs() < 1e-12 && (start[1] - 2.0).abs() < 1e-12, "{start:?}");
    }
}

//! Where the whale starts, aimed at rope of gear at rest.
//!
//! The snout starts `gap` short of the aim along the whale's bearing and `offset` to starboard of it: with the unit vectors
//! `f` ahead and `s` to starboard, mid-body is at `aim - (gap + L/2) f + offset s`, at the depth drawn, for a whale of length L.
//! The aim is the place of the line at rest at that depth. Bearings count from where the current flows: 0 goes with the tide.

use endline_gear::{At, hint};
use endline_sim::{Model, State};

use crate::error::Error;

/// The lines of a model that a study aims at, in its order; a line made of pieces is all its pieces. All lines if it names none.
pub(crate) fn lines_aimed_at(model: &Model, wanted: &[At<String>]) -> Result<Vec<usize>, Error> {
    let ids = || model.spec.lines.iter().map(|line| line.id.as_str());
    if wanted.is_empty() {
        return Ok((0..ids().count()).collect());
    }
    let mut lines = Vec::new();
    for id in wanted {
        let is_piece =
            |known: &str| known.strip_prefix(&id.value).is_some_and(|rest| rest.starts_with('.'));
        let found = ids().enumerate().filter(|(_, known)| *known == id.value || is_piece(known));
        let before = lines.len();
        lines.extend(found.map(|(line, _)| line));
        if lines.len() == before {
            let message = format!("the baseline's gear has no line `{}`", id.value);
            return Err(id.place.error(message, hint(&id.value, ids())).into());
        }
    }
    Ok(lines)
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

/// East and north of mid-body at the start: `back_m` behind the aim along the bearing, `aside_m` to starboard [m].
pub(crate) fn start_m(aim_m: [f64; 2], bearing: f64, [back_m, aside_m]: [f64; 2]) -> [f64; 2] {
    let (east, north) = (libm::sin(bearing), libm::cos(bearing));
    [aim_m[0] - back_m * east + aside_m * north, aim_m[1] - back_m * north - aside_m * east]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A whale that swims east, 10 m before the aim and 2 m to starboard, starts 10 m west and 2 m south of it.
    #[test]
    fn a_whale_starts_behind_the_aim_and_to_starboard() {
        let start = start_m([3.0, 4.0], std::f64::consts::FRAC_PI_2, [10.0, 2.0]);
        assert!((start[0] + 7.0).abs() < 1e-12 && (start[1] - 2.0).abs() < 1e-12, "{start:?}");
    }
}

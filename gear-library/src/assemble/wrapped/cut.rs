//! Stretches of a wrapped line: rope shared out to them, cut into segments, laid evenly along.

use endline_sim::DVec3;

use crate::assemble::way::{along, length};

use super::TAUT;
use super::stretch::Stretch;

/// Segments may grow by this share of the distance from a fine stretch.
const GROWTH: f64 = 0.4;

/// Nodes of a line and the unstretched lengths between them.
pub(super) struct Laid {
    /// Places of the nodes, one more than segments [m].
    pub nodes: Vec<DVec3>,
    /// Unstretched length of each segment [m].
    pub segments_m: Vec<f64>,
}

/// Gives the stretches that have none yet their part of the rope, in proportion to their ways.
///
/// # Errors
/// With rope needed and had [m] where a stretch would be longer than its rope.
pub(super) fn share_out(stretches: &mut [Stretch], length_m: f64) -> Result<(), (f64, f64)> {
    let given: f64 = stretches.iter().filter_map(|stretch| stretch.rope_m).sum();
    let open: f64 = stretches
        .iter()
        .filter(|stretch| stretch.rope_m.is_none())
        .map(|stretch| length(&stretch.way))
        .sum();
    let left = length_m - given;
    let legs = stretches.iter().filter(|stretch| stretch.fine_m.is_none());
    let short: f64 = legs.filter_map(|leg| Some((length(&leg.way) - leg.rope_m?).max(0.0))).sum();
    if left < open * (1.0 - TAUT) || short > TAUT * length_m {
        return Err((given + open + short, length_m));
    }
    let share = if open > 0.0 { left / open } else { 0.0 };
    for stretch in stretches.iter_mut().filter(|stretch| stretch.rope_m.is_none()) {
        stretch.rope_m = Some(share * length(&stretch.way));
    }
    Ok(())
}

/// More segments than [`cut`] makes of these: counted before memory is taken for them.
pub(super) fn most_segments(stretches: &[Stretch], coarse_m: f64) -> f64 {
    let of = |stretch: &Stretch| {
        let whole = stretch.rope_m.unwrap_or_default();
        let grown = stretches.iter().filter_map(|other| other.fine_m).fold(coarse_m, f64::min);
        let growing = 2.0 * (1.0 + libm::log(coarse_m / grown) / libm::log1p(GROWTH));
        whole / stretch.fine_m.unwrap_or(coarse_m) + growing + 1.0
    };
    stretches.iter().map(of).sum()
}

/// Cuts every stretch: wraps into their own segments, the rest into longer ones the farther from a wrap.
pub(super) fn cut(stretches: &[Stretch], coarse_m: f64) -> Laid {
    let mut laid = Laid { nodes: vec![stretches[0].way[0]], segments_m: Vec::new() };
    for (number, stretch) in stretches.iter().enumerate() {
        let fine = |other: Option<usize>| other.and_then(|other| stretches.get(other)?.fine_m);
        let beside = [fine(number.checked_sub(1)), fine(Some(number + 1))];
        let whole = stretch.rope_m.unwrap_or_default();
        let lengths = match stretch.fine_m {
            Some(fine_m) => graded(whole, [None, None], fine_m),
            None => graded(whole, beside, coarse_m),
        };
        let mut passed = 0.0;
        for length_m in lengths {
            passed += length_m;
            laid.nodes.push(along(&stretch.way, passed / whole));
            laid.segments_m.push(length_m);
        }
    }
    laid
}

/// Lengths that add up to `whole`, no longer than `coarse` nor than a fine neighbour's grown with the distance from it.
fn graded(whole: f64, beside: [Option<f64>; 2], coarse: f64) -> Vec<f64> {
    if whole <= 0.0 {
        return Vec::new();
    }
    let longest = |at: f64| {
        let by =
            |fine: Option<f64>, away: f64| fine.map_or(f64::INFINITY, |fine| fine + GROWTH * away);
        coarse.min(by(beside[0], at)).min(by(beside[1], whole - at))
    };
    let (mut lengths, mut at) = (Vec::new(), 0.0);
    while at < whole {
        let next = longest(at).min(longest((at + longest(at)).min(whole)));
        lengths.push(next);
        at += next;
    }
    lengths.iter_mut().for_each(|length| *length *= whole / at);
    lengths
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn graded_segments_add_up_and_grow_slowly() {
        for (whole, beside, coarse) in [
            (7.3, [Some(0.02), None], 0.5),
            (2.0, [Some(0.05), Some(0.02)], 0.4),
            (0.01, [None, None], 0.4),
        ] {
            let lengths = graded(whole, beside, coarse);
            assert!((lengths.iter().sum::<f64>() - whole).abs() < 1e-12);
            assert!(lengths.iter().all(|length| *length <= coarse + 1e-12), "{lengths:?}");
            assert!(
                lengths.windows(2).all(|pair| pair[1] / pair[0] < 1.9 && pair[0] / pair[1] < 1.9),
                "{lengths:?}"
            );
        }
    }
}

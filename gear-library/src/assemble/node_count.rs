//! How many rope nodes a scenario needs so that its segments can have the lengths that `[resolution]` asks for.
//!
//! Rope that lies on a whale of length `L` from end to end needs `L / near` segments; of it, at most the share [`ALONG_EDGES`] of `L` lies along
//! thin edges and needs `1 / edges` each metre. What is left of the line has segments of the far length, with room to grow between. A whale
//! may meet any line, so each has as many; the count depends on gear and whale alone, and options of a study that differ in
//! strength have equal meshes.

use endline_sim::model::Resolution;

/// Rope along thin edges, as a share of the whale's length: both edges of two flippers and of the flukes.
const ALONG_EDGES: f64 = 0.6;
/// Segments between near and far length: neighbours differ by 30 % of their distance, on both sides of the whale.
const BETWEEN: f64 = 2.0 / 0.3;
/// Most nodes that are chosen; more must be asked for.
pub(super) const MOST_NODES: u64 = 2_000;

/// Nodes for lines of these lengths [m] near a whale of this length [m], at most [`MOST_NODES`].
pub(super) fn needed(lengths: &[f64], whale_m: f64, resolution: &Resolution) -> u64 {
    let all: f64 = lengths.iter().map(|length| of_line(*length, whale_m, resolution)).sum();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, and bounded by the most that are chosen"
    )]
    let nodes = all.min(MOST_NODES as f64).ceil() as u64;
    nodes.max(2 * lengths.len() as u64)
}

/// Nodes for one line.
fn of_line(length_m: f64, whale_m: f64, resolution: &Resolution) -> f64 {
    let along_edges = (ALONG_EDGES * whale_m).min(length_m);
    let near = (whale_m - along_edges).min(length_m - along_edges);
    let far = length_m - along_edges - near;
    let between = BETWEEN * libm::log(resolution.far_m / resolution.edge_m);
    let graded = far / resolution.far_m + between.min(far / resolution.near_m);
    along_edges / resolution.edge_m + near / resolution.near_m + graded + 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const FINE: Resolution = Resolution { near_m: 0.05, edge_m: 0.0125, far_m: 2.0 };

    #[test]
    fn a_short_line_is_cut_to_the_edge_length() {
        assert_eq!(needed(&[5.0], 13.7, &FINE), 401);
    }

    #[test]
    fn a_long_line_has_what_lies_on_the_whale_and_far_segments_beyond() {
        let of = |length| needed(&[length], 10.0, &FINE);
        // 6 m along edges, 4 m near.
        assert!((561..640).contains(&of(30.0)), "{}", of(30.0));
        assert_eq!(of(230.0) - of(30.0), 100);
    }

    #[test]
    fn coarse_resolution_needs_few_nodes_and_no_choice_is_beyond_the_most() {
        let coarse = Resolution { near_m: 0.5, edge_m: 0.5, far_m: 2.0 };
        assert!(needed(&[30.0], 13.7, &coarse) < 60);
        assert_eq!(needed(&[40.0; 9], 13.7, &FINE), MOST_NODES);
    }
}

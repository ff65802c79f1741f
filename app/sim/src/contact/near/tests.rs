//! Short cuts against what they cut short.

use glam::DVec3;

use super::*;
use crate::metrics::tests::{model, spec};

/// Two lines of 50 segments beside each other.
fn two_lines() -> Model {
    let mut spec = spec(vec![0.2; 50]);
    let mut second = spec.lines[0].clone();
    second.id = "second".into();
    spec.lines.push(second);
    model(spec)
}

/// Places of all nodes, a line in 10 m along x, moved by a vector.
fn places(model: &Model, by: DVec3) -> Vec<DVec3> {
    let along = |node: usize| by + DVec3::X * (0.2 * (node % 51) as f64);
    (0..model.node_count).map(along).collect()
}

fn moves(node: usize) -> DVec3 {
    DVec3::new(0.01, 0.02 * libm::sin(node as f64), 0.01)
}

/// Rope strays where a single node lies too far beside its path, or beyond an end of it.
#[test]
fn a_single_node_that_strays_is_found() {
    let model = two_lines();
    let mut near = Near::new(&model, model.skin_tree.clone().expect("a skin"));
    let (places, most_m) = (places(&model, DVec3::ZERO), 0.03);
    near.sweep([&[], &[]], &places, moves);
    let halfway: Vec<DVec3> =
        (0..places.len()).map(|node| places[node] + 0.5 * moves(node)).collect();
    assert!(!near.strayed(&halfway, most_m));
    for node in 0..places.len() {
        let (begin, path) = (places[node], moves(node));
        let along = path.normalize();
        let across = along.any_orthonormal_vector();
        for (from, out) in [(begin + 0.3 * path, across), (begin, -along), (begin + path, along)] {
            for (share, strays) in [(0.999, false), (1.001, true)] {
                let mut moved = halfway.clone();
                moved[node] = from + out * (share * most_m);
                assert_eq!(near.strayed(&moved, most_m), strays, "node {node}, {share}");
            }
        }
    }
}

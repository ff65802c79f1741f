//! Bounds that avoid work, against the full computation.

use glam::{DQuat, DVec3};

use crate::contact::rope_on_skin::near::*;
use crate::metrics::tests::{model, spec};
use crate::whale::pose;
use endline_sdk::Posture;

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
    near.sweep(&places, moves);
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

/// The boxes around pieces of rope give the result of the search through all segments.
#[test]
fn rope_clear_of_the_whole_skin_is_near_none_of_it() {
    let model = two_lines();
    let skin = &model.spec.whale.as_ref().expect("a whale").skin;
    let mut near = Near::new(&model, model.skin_tree.clone().expect("a skin"));
    let (mut bones, mut counts, mut pieces) = (Vec::new(), [0; 2], Pieces::new(&model));
    for step in 0..80 {
        let shift = DVec3::new(-5.0, 0.25 * f64::from(step - 40), 0.1);
        pose(skin, DVec3::ZERO, DQuat::from_rotation_z(0.3), &Posture::default(), &mut bones);
        let places = places(&model, shift);
        pieces.measure(&places, |node| places[node] + moves(node), &vec![0.2; 100]);
        let found = near.begin_search([&bones, &bones], &pieces, &places, moves, 0.2)
            && near.is_any_near(0.2);
        near.surface.begin(&bones, &bones);
        near.sweep(&places, moves);
        assert_eq!(found, near.surface.is_any_near(&near.sweeps, 0.2));
        counts[usize::from(found)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
}

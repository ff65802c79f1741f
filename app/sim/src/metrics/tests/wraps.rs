//! Wraps of rope of known turns: by construction, cut otherwise, moved, loose, and coming near.

use std::f64::consts::TAU;

use super::*;
use crate::metrics::EventKind;

/// Where the fixture's whale lies.
const WHALE: DVec3 = DVec3::new(0.0, 0.0, -20.0);

/// Places round the peduncle: `turns` at radius `r`, straight on at both ends for `tail` metres.
fn wrapped(turns: f64, r: f64, each_turn: f64, tail: f64) -> Vec<DVec3> {
    let count = (each_turn * turns.abs()).ceil();
    let at = |angle: f64, share: f64| {
        let x = -5.0 + 0.3 * share;
        trunk_middle(x) + DVec3::new(0.0, libm::cos(angle), libm::sin(angle)) * r
    };
    let mut nodes: Vec<DVec3> = (0..=count as u32)
        .map(|k| f64::from(k) / count)
        .map(|share| at(0.3 + TAU * turns * share, share))
        .collect();
    let tangent =
        |angle: f64| DVec3::new(0.0, -libm::sin(angle), libm::cos(angle)) * turns.signum();
    let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
    for k in 1..=20 {
        let away = tail * f64::from(k) / 20.0;
        nodes.insert(0, first - tangent(0.3) * away);
        nodes.push(last + tangent(0.3 + TAU * turns) * away);
    }
    nodes
}

/// A model whose rope has these segments, and its state with the rope lying there beside the whale.
fn laid(nodes: &[DVec3]) -> (Model, State) {
    let model = model(spec(nodes.windows(2).map(|pair| pair[0].distance(pair[1])).collect()));
    let mut state = State::start(&model);
    state.rope.position = nodes.iter().map(|node| *node + WHALE).collect();
    (model, state)
}

/// Something on the peduncle to press on.
fn on_peduncle(model: &Model) -> (usize, [f64; 3]) {
    ray(&model.spec.whale.as_ref().unwrap().skin, BodyPart::Peduncle, trunk_middle(-4.85), DVec3::Y)
}

/// Wraps about the peduncle of rope at these places that touches at its middle only.
fn wraps(nodes: &[DVec3]) -> f64 {
    let (model, mut state) = laid(nodes);
    let mut metrics = Metrics::new(&model);
    let contacts = [contact(&model, model.segment_count / 2, on_peduncle(&model))];
    advance(&mut metrics, &model, &mut state, &contacts);
    metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Peduncle as usize].wraps
}

#[test]
fn turns_by_construction_are_counted_whatever_the_segments() {
    for turns in [0.5, 1.0, 2.25, 3.0, -1.5] {
        let [coarse, fine] =
            [24.0, 48.0].map(|each_turn| wraps(&wrapped(turns, 0.31, each_turn, 2.0)));
        println!("{turns}: {coarse:.4} and {fine:.4}");
        assert!(
            (fine - turns.abs()).abs() < 0.02 && (coarse - fine).abs() < 0.01,
            "{turns}: {coarse}, {fine}"
        );
    }
}

#[test]
fn loose_loops_count_as_tight_ones() {
    for turns in [1.0, 2.0] {
        let loose = wraps(&wrapped(turns, 0.6, 24.0, 2.0));
        assert!((loose - turns).abs() < 0.03, "{turns}: {loose}");
    }
}

#[test]
fn rope_that_touches_but_does_not_wrap_counts_nothing() {
    let straight = |from: DVec3, to: DVec3| -> Vec<DVec3> {
        (0..=40).map(|k| from.lerp(to, f64::from(k) / 40.0)).collect()
    };
    let beside = trunk_middle(-4.85) + DVec3::Y * 0.305;
    // Along the axis, which sags by a third of the radius on the way, rope goes a little round it.
    for (way, most) in [
        (DVec3::Z, 0.02),
        (DVec3::new(0.3, 0.0, 1.0), 0.02),
        (DVec3::new(-0.5, 0.0, 1.0), 0.02),
        (DVec3::X, 0.12),
    ] {
        let way = way.normalize() * 3.0;
        let count = wraps(&straight(beside - way, beside + way));
        assert!(count < most, "along {way}: {count}");
    }
    // Bent round by a right angle.
    let quarter = wraps(&wrapped(0.25, 0.31, 48.0, 2.0));
    assert!((quarter - 0.25).abs() < 0.02, "{quarter}");
}

#[test]
fn a_rigid_move_of_whale_and_rope_changes_nothing() {
    let nodes = wrapped(2.25, 0.31, 24.0, 2.0);
    let (model, mut state) = laid(&nodes);
    let (turn, shift) =
        (DQuat::from_euler(glam::EulerRot::ZYX, 1.0, -0.4, 2.0), DVec3::new(30.0, -7.0, -12.0));
    state.rope.position = nodes.iter().map(|node| turn * *node + shift).collect();
    let whale = state.whale.as_mut().unwrap();
    (whale.position, whale.orientation) = (shift, turn);
    let mut metrics = Metrics::new(&model);
    let contacts = [contact(&model, model.segment_count / 2, on_peduncle(&model))];
    advance(&mut metrics, &model, &mut state, &contacts);
    let moved =
        metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Peduncle as usize].wraps;
    assert!((moved - wraps(&nodes)).abs() < 1e-9, "{moved}");
}

/// A loop that is drawn up from below until it hangs about the peduncle grows its count with no jump, and so does one
/// slid off over the end of the part.
#[test]
fn wraps_grow_and_shrink_without_a_jump() {
    let nodes = wrapped(0.5, 0.4, 48.0, 3.0);
    let turned = DQuat::from_rotation_x(-0.3 - std::f64::consts::PI);
    let at = |shift: DVec3| -> Vec<DVec3> {
        let middle = trunk_middle(-4.85);
        nodes.iter().map(|node| turned * (*node - middle) + middle + shift).collect()
    };
    let (model, mut state) = laid(&at(DVec3::ZERO));
    let contacts = [contact(&model, model.segment_count / 2, on_peduncle(&model))];
    let mut metrics = Metrics::new(&model);
    let mut count = |nodes: Vec<DVec3>| {
        state.rope.position = nodes.iter().map(|node| *node + WHALE).collect();
        advance(&mut metrics, &model, &mut state, &contacts);
        metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Peduncle as usize].wraps
    };
    for way in [DVec3::NEG_Z * 2.5, DVec3::new(0.3, 0.4, -2.5), DVec3::NEG_X * 2.5] {
        let counts: Vec<f64> = (0..=250).map(|k| count(at(way * (f64::from(k) / 250.0)))).collect();
        let jump = counts.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        let most = counts.iter().copied().fold(0.0, f64::max);
        println!(
            "{way}: from {:.3} to {:.3}, at most {most:.3}, greatest change in a centimetre {jump:.3}",
            counts[0], counts[250]
        );
        assert!(counts[0] > 0.45 && counts[250] < 0.02, "{way}: {} to {}", counts[0], counts[250]);
        // The bend leaves the neighbourhood as the root of its depth there: fast at first, but from nothing.
        assert!(way.x < -1.0 || jump < 0.15, "{way}: {jump}");
    }
}

/// Contact lost for less than a second leaves the wraps, a longer loss ends them; levels are reported up and down.
#[test]
fn wraps_outlast_flicker_and_are_told_as_made_and_undone() {
    let (model, mut state) = laid(&wrapped(1.0, 0.31, 24.0, 2.0));
    let mut metrics = Metrics::new(&model);
    let contacts = [contact(&model, model.segment_count / 2, on_peduncle(&model))];
    let now = |metrics: &Metrics, state: &State| {
        metrics.summary(&model, state).whale.unwrap().regions[BodyPart::Peduncle as usize].wraps
    };
    state.rope.position = wrapped(1.2, 0.31, 24.0, 2.0)
        .iter()
        .take(model.node_count)
        .map(|node| *node + WHALE)
        .collect();
    advance(&mut metrics, &model, &mut state, &contacts);
    (0..90).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
    assert!(now(&metrics, &state) > 0.9, "{}", now(&metrics, &state));
    (0..20).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
    assert!(now(&metrics, &state).abs() < 1e-12);
    let told: Vec<_> = metrics.events().iter().map(|event| (event.kind, event.value)).collect();
    for (kind, value) in [
        (EventKind::Wrap, 0.5),
        (EventKind::Wrap, 1.0),
        (EventKind::WrapUndone, 1.0),
        (EventKind::WrapUndone, 0.5),
    ] {
        assert!(told.contains(&(kind, value)), "{told:?}");
    }
}

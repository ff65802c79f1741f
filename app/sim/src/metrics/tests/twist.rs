//! Twist of legs of known turns, and what must not change it.

use std::f64::consts::TAU;

use super::*;

/// Length of the legs [m].
const LEG_M: f64 = 2.0;

/// The twist of a strand that lies along `nodes`, with one touch in the middle of segment `touched`; the state is changed first.
fn twist(nodes: &[DVec3], touched: usize, change: impl Fn(&mut State)) -> [f64; 2] {
    let model = model(spec(nodes.windows(2).map(|ends| ends[0].distance(ends[1])).collect()));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    state.rope.position.copy_from_slice(nodes);
    change(&mut state);
    let mut touch = touch(&model);
    touch[0].segment = touched;
    advance(&mut metrics, &model, &mut state, &touch);
    let summary = metrics.summary(&model, &state);
    [summary.lines[0].twist, summary.lines[0].peak_twist]
}

/// Nodes of a bight: `one` from its far end to the whale, a bend of one segment, then `other` out again.
fn bight(one: &[DVec3], other: &[DVec3]) -> (Vec<DVec3>, usize) {
    (one.iter().rev().chain(other).copied().collect(), one.len() - 1)
}

/// A leg that winds about the x axis from `turn` on, its radius growing by `grows` along it.
fn helix(turns: f64, turn: f64, radius: f64, grows: f64, segments: usize) -> Vec<DVec3> {
    let place = |k: usize| {
        let share = k as f64 / segments as f64;
        let (angle, wide) = (TAU * (turns * share + turn), radius + grows * share);
        DVec3::new(LEG_M * share, wide * libm::cos(angle), wide * libm::sin(angle))
    };
    (0..=segments).map(place).collect()
}

#[test]
fn helices_twist_by_their_turns() {
    for turns in [1.0_f64, 2.5, -3.0, 0.0] {
        for (segments, others) in [(200, 200), (200, 170), (60, 91)] {
            for radius in [0.005, 0.02, 0.07] {
                let (nodes, touched) = bight(
                    &helix(turns, 0.0, radius, 0.0, segments),
                    &helix(turns, 0.5, radius, 0.0, others),
                );
                let [now, most] = twist(&nodes, touched, |_| {});
                assert!(
                    (now - turns).abs() < 0.02 * turns.abs() + 1e-9
                        && now.to_bits() == most.to_bits(),
                    "{segments} and {others} segments, {radius} m: {now} for {turns}"
                );
            }
        }
    }
}

/// A straight leg with the other wound about it, and legs that lean away from each other.
#[test]
fn legs_need_not_be_alike() {
    let straight = helix(0.0, 0.0, 0.0, 0.0, 150);
    let (nodes, touched) = bight(&straight, &helix(4.0, 0.0, 0.01, 0.0, 200));
    let now = twist(&nodes, touched, |_| {})[0];
    assert!((now / 4.0 - 1.0).abs() < 0.02, "{now}");
    let (nodes, touched) =
        bight(&helix(1.5, 0.0, 0.01, 0.2, 150), &helix(1.5, 0.5, 0.01, 0.2, 150));
    let now = twist(&nodes, touched, |_| {})[0];
    assert!((now / 1.5 - 1.0).abs() < 0.02, "{now}");
}

/// Moved and turned as a whole, or with the legs bent round a curve in a plane, they twist as before.
#[test]
fn how_the_whole_lies_changes_nothing() {
    let (nodes, touched) =
        bight(&helix(2.5, 0.0, 0.02, 0.0, 200), &helix(2.5, 0.5, 0.02, 0.0, 200));
    let straight = twist(&nodes, touched, |_| {})[0];
    let turned = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 1.1);
    let moved: Vec<DVec3> = nodes.iter().map(|at| turned * *at + DVec3::splat(7.0)).collect();
    assert!((twist(&moved, touched, |_| {})[0] - straight).abs() < 1e-9);
    let bend = |at: &DVec3| {
        let (angle, out) = (at.x / 1.2, 1.2 + at.y);
        DVec3::new(out * libm::sin(angle), out * libm::cos(angle), at.z)
    };
    let bent: Vec<DVec3> = nodes.iter().map(bend).collect();
    let now = twist(&bent, touched, |_| {})[0];
    assert!((now / straight - 1.0).abs() < 0.02, "{now} for {straight}");
}

/// A rope that goes straight on has no legs side by side; neither have legs far apart, nor those beyond a cut.
#[test]
fn only_legs_side_by_side_count() {
    let straight: Vec<DVec3> = (0..=80).map(|k| DVec3::X * (0.05 * f64::from(k))).collect();
    assert!(twist(&straight, 40, |_| {})[0].abs() < 1e-12);
    let (nodes, touched) = bight(&helix(0.5, 0.0, 0.3, 0.0, 100), &helix(0.5, 0.5, 0.3, 0.0, 100));
    assert!(twist(&nodes, touched, |_| {})[0].abs() < 1e-12);
    let (nodes, touched) =
        bight(&helix(2.0, 0.0, 0.01, 0.0, 100), &helix(2.0, 0.5, 0.01, 0.0, 100));
    let half = twist(&nodes, touched, |state| state.rope.cut[touched + 51] = true)[0];
    assert!((half - 1.0).abs() < 0.02, "{half}");
}

/// Legs stay legs for a second after the last touch.
#[test]
fn legs_end_a_second_after_the_last_touch() {
    let (nodes, touched) =
        bight(&helix(1.0, 0.0, 0.01, 0.0, 100), &helix(1.0, 0.5, 0.01, 0.0, 100));
    let model = model(spec(nodes.windows(2).map(|ends| ends[0].distance(ends[1])).collect()));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    state.rope.position.copy_from_slice(&nodes);
    let mut touch = touch(&model);
    touch[0].segment = touched;
    advance(&mut metrics, &model, &mut state, &touch);
    let mut after = |steps: usize| {
        (0..steps).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
        let line = metrics.summary(&model, &state).lines.remove(0);
        [line.twist, line.peak_twist]
    };
    assert!(after(90).iter().all(|turns| (turns - 1.0).abs() < 0.02));
    let [now, most] = after(20);
    assert!(now.abs() < 1e-12 && (most - 1.0).abs() < 0.02, "{now}, {most}");
}

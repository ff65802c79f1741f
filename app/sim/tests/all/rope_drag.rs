//! Drag along a rope against closed forms: `F = ½ρ C_t π d L [(1 - q) U² + q √U_r U^1.5]`, with the viscous share `q` of the
//! coefficient and the speed `U_r` at which it holds.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use std::f64::consts::PI;

use endline_fixtures::gear::{fixed, line, model, rope, water};
use endline_sim::metrics::Metrics;
use endline_sim::model::{Joint, JointKind, Settings};
use endline_sim::{DVec3, Input, Model, State, Workspace, settle, step};

const DENSITY: f64 = 1025.0;
/// Speed at which the coefficient holds [m/s].
const AT_M_S: f64 = 2.0;

fn free(id: &str, position_m: DVec3) -> Joint {
    Joint { id: id.into(), kind: JointKind::Free, position_m }
}

/// A line of 10 m between two joints, its drag along with a viscous share.
fn lone(joints: Vec<Joint>, current_m_s: f64, viscous: f64, at_m_s: f64) -> Model {
    let settings = Settings { as_placed: true, ..Settings::default() };
    let lines = vec![line("rope", 10.0, 20)];
    let mut spec =
        model(water(DENSITY, current_m_s), joints, lines, Vec::new(), settings).spec.clone();
    let own = &mut spec.ropes[0];
    (own.drag_tangential_viscous, own.drag_tangential_speed_m_s) = (viscous, at_m_s);
    // In the current it neither sinks nor floats.
    own.displaced_m3_m = if current_m_s > 0.0 { own.mass_kg_m / DENSITY } else { 0.5 * 6e-5 };
    Model::new(spec).expect("a sound model")
}

/// Drag on a metre of the rope [N/m].
fn drag_n_m(viscous: f64, speed_m_s: f64) -> f64 {
    let rope = rope();
    let law = (1.0 - viscous) * speed_m_s * speed_m_s
        + viscous * AT_M_S.sqrt() * speed_m_s * speed_m_s.sqrt();
    0.5 * DENSITY * rope.drag_tangential * PI * rope.diameter_m * law
}

fn run(model: &Model, until_s: f64) -> State {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    while state.time_s < until_s - 1e-9 {
        step(model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    state
}

/// A vertical rope sinks along itself until drag equals its weight in water.
#[test]
fn a_rope_that_sinks_along_itself_reaches_its_terminal_speed() {
    for viscous in [0.0, 0.3, 1.0] {
        let joints = vec![free("top", DVec3::Z * -5.0), free("end", DVec3::Z * -15.0)];
        let model = lone(joints, 0.0, viscous, AT_M_S);
        let own = &model.spec.ropes[0];
        let weight_n_m = (own.mass_kg_m - DENSITY * own.displaced_m3_m) * 9.81;
        let (mut low, mut high) = (0.0, 10.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if drag_n_m(viscous, middle) < weight_n_m { low = middle } else { high = middle }
        }
        let state = run(&model, 6.0);
        let speeds: Vec<f64> = state.rope.velocity.iter().map(|velocity| -velocity.z).collect();
        println!("{viscous}: {low} m/s, {speeds:?}");
        assert!(speeds.iter().all(|speed| (speed / low - 1.0).abs() < 1e-4), "{low} {speeds:?}");
    }
}

/// A rope held at one end in a current along it: the hand bears the drag of all of it, at rest by statics and in motion.
#[test]
fn a_rope_held_in_a_current_bears_its_drag() {
    for (viscous, speed_m_s) in [(0.3, 0.7), (0.3, 2.0), (1.0, 1.3)] {
        let joints =
            vec![fixed("hand", DVec3::Z * -5.0), free("tail", DVec3::new(10.0, 0.0, -5.0))];
        let model = lone(joints, speed_m_s, viscous, AT_M_S);
        let expected = 10.0 * drag_n_m(viscous, speed_m_s);
        let settled = settle(&model);
        assert!(settled.converged);
        for state in [&settled.state, &run(&model, 20.0)] {
            let tension_n = Metrics::new(&model).summary(&model, state).lines[0].end_a_tension_n;
            println!("{viscous} {speed_m_s}: {tension_n} N for {expected} N");
            assert!((tension_n / expected - 1.0).abs() < 1e-3, "{tension_n} N for {expected} N");
        }
    }
}

/// Without a viscous share the speed at which the coefficient holds means nothing, to the last bit.
#[test]
fn drag_by_the_square_does_not_know_the_speed_of_its_coefficient() {
    let at = |at_m_s: f64| {
        let joints = vec![fixed("hand", DVec3::Z * -5.0), free("tail", DVec3::new(8.0, 3.0, -9.0))];
        run(&lone(joints, 0.8, 0.0, at_m_s), 1.0).rope.position
    };
    assert_eq!(at(1.0), at(3.0));
}

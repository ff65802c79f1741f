//! Momentum and energy of the gear by source: against what is known of falls, tows, slides and a rope over a drum.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use std::f64::consts::PI;

use endline_fixtures::gear::{
    fixed, line, model, model_with, obstacle, on_body, rope, water, weight,
};
use endline_sim::balance::{BalanceSummary, Source};
use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::{Joint, JointKind, Seabed, Settings};
use endline_sim::water::Water;
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, step};

/// What a free joint is.
fn free(id: &str, position_m: DVec3) -> Joint {
    Joint { id: id.into(), kind: JointKind::Free, position_m }
}

/// Settings with the balance kept.
fn kept(auto_step: bool) -> Settings {
    Settings { balance: true, auto_step, ..Settings::default() }
}

fn run(model: &Model, state: &mut State, workspace: &mut Workspace, until_s: f64) {
    while state.time_s < until_s - 1e-9 {
        step(model, &Input::default(), state, workspace).unwrap_or_else(|stop| panic!("{stop:?}"));
    }
}

fn summary(model: &Model, state: &State, workspace: &Workspace) -> BalanceSummary {
    workspace.balance.summary(model, state).expect("a balance")
}

/// Impulse of a source.
fn impulse(balance: &BalanceSummary, source: Source) -> DVec3 {
    balance.impulse_ns[source as usize]
}

/// Work of a source.
fn work(balance: &BalanceSummary, source: Source) -> f64 {
    balance.work_j[source as usize]
}

/// Two weights and the slack rope between them fall by `½ g t²`: the only impulse is that of the weight.
#[test]
fn a_fall_in_a_vacuum_has_the_impulse_of_weight_alone() {
    for auto_step in [false, true] {
        let ends = [DVec3::ZERO, DVec3::X * 4.0];
        let bodies = ends.map(|end| weight("weight", 3.0, end, None)).to_vec();
        let joints = vec![on_body("one", 0), on_body("other", 1)];
        let rope = line("rope", 5.0, 20);
        let model = model(water(0.0, 0.0), joints, vec![rope], bodies, kept(auto_step));
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        run(&model, &mut state, &mut workspace, 1.0);
        let balance = summary(&model, &state, &workspace);
        let mass_kg = 6.0 + 5.0 * 0.06;
        let expected = DVec3::Z * (-9.81 * mass_kg);
        println!("{balance:?}");
        assert!(impulse(&balance, Source::Weight).distance(expected) < 1e-9);
        assert!(balance.momentum_ns.distance(expected) < 1e-9);
        assert!(balance.residual_share() < 1e-12, "{}", balance.residual_share());
        let fallen_j = mass_kg * 9.81 * 9.81 / 2.0;
        let damped = balance.numerical_damping_j();
        // The scheme starts with a step of backward Euler.
        assert!((work(&balance, Source::Weight) / fallen_j - 1.0).abs() < 2e-4, "{balance:?}");
        assert!(damped.abs() < 2e-4 * fallen_j, "{damped} J of {fallen_j} J");
    }
}

/// A body on a rope that swings and snaps: tension is the rope's own, and the fixture gives what weight and momentum leave.
#[test]
fn a_snap_leaves_no_residual_in_any_scheme() {
    for (auto_step, step_s) in [(false, 0.01), (true, 0.02), (false, 0.003)] {
        let body = weight("weight", 5.0, DVec3::new(1.0, 0.0, 0.5), None);
        let joints = vec![fixed("top", DVec3::ZERO), on_body("bottom", 0)];
        let settings = Settings { step_s, ..kept(auto_step) };
        let rope = line("rope", 2.0, 16);
        let model = model(water(0.0, 0.0), joints, vec![rope], vec![body], settings);
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        run(&model, &mut state, &mut workspace, 3.0);
        let balance = summary(&model, &state, &workspace);
        println!("{step_s} {:.1e} {:.3}", balance.residual_share(), balance.numerical_damping_j());
        assert!(balance.residual_share() < 1e-4, "{balance:?}");
        assert!(
            work(&balance, Source::Fixtures).abs() < 1e-9,
            "a fixture does no work: {balance:?}"
        );
        assert!(balance.damping_j < 0.0, "{balance:?}");
    }
}

/// A weight that swings on a taut rope: what the scheme takes shrinks with the step, and work and energy then agree.
#[test]
fn a_swing_keeps_its_energy_but_for_what_the_scheme_takes() {
    let lost = [0.02, 0.01, 0.005].map(|step_s| {
        let place = DVec3::new(2.0, 0.0, 0.0);
        let joints = vec![fixed("top", DVec3::ZERO), on_body("bottom", 0)];
        let settings = Settings { step_s, ..kept(false) };
        let bodies = vec![weight("weight", 5.0, place, None)];
        let rope = line("rope", 2.0, 8);
        let model = model(water(0.0, 0.0), joints, vec![rope], bodies, settings);
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        run(&model, &mut state, &mut workspace, 0.6);
        let balance = summary(&model, &state, &workspace);
        println!("{step_s} {:.4} J, {balance:?}", balance.numerical_damping_j());
        assert!(balance.residual_share() < 1e-3, "{balance:?}");
        assert!(work(&balance, Source::Weight) > 50.0, "{balance:?}");
        balance.numerical_damping_j() / work(&balance, Source::Weight)
    });
    assert!(lost[2].abs() < 0.3 * lost[0].abs() && lost[2].abs() < 2e-3, "{lost:?}");
}

/// A rope that neither sinks nor floats, drawn along itself: the hand gives `½ρ C_t π d L U²` and the water takes it.
#[test]
fn a_tow_at_steady_speed_gives_what_drag_takes() {
    let (length_m, speed_m_s) = (10.0, 1.5);
    let common = rope();
    let density = common.mass_kg_m / common.displaced_m3_m;
    let hand = JointKind::Driven {
        velocity_m_s: DVec3::X * speed_m_s,
        from_s: 0.0,
        until_s: f64::INFINITY,
    };
    let joints = vec![
        Joint { id: "hand".into(), kind: hand, position_m: DVec3::Z * -5.0 },
        free("tail", DVec3::new(-length_m, 0.0, -5.0)),
    ];
    let rope = line("rope", length_m, 20);
    let model = model(water(density, 0.0), joints, vec![rope], Vec::new(), kept(false));
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    run(&model, &mut state, &mut workspace, 20.0);
    let before = summary(&model, &state, &workspace);
    run(&model, &mut state, &mut workspace, 30.0);
    let balance = summary(&model, &state, &workspace);
    let area = PI * common.diameter_m * length_m;
    let drag_n = 0.5 * density * common.drag_tangential * area * speed_m_s * speed_m_s;
    let given = |source| impulse(&balance, source) - impulse(&before, source);
    let expected = DVec3::X * (10.0 * drag_n);
    println!("{} {expected} {:.1e}", given(Source::Fixtures), balance.residual_share());
    assert!(given(Source::Fixtures).distance(expected) < 1e-3 * expected.x);
    let buoyant = given(Source::Water) + given(Source::Weight);
    assert!((buoyant + expected).length() < 1e-3 * expected.x, "{buoyant}");
    let done_j = work(&balance, Source::Fixtures) - work(&before, Source::Fixtures);
    assert!((done_j / (expected.x * speed_m_s) - 1.0).abs() < 1e-3, "{done_j}");
    assert!(balance.residual_share() < 1e-5, "{}", balance.residual_share());
}

/// A box pushed over the seabed stops by friction: the seabed takes its momentum and its energy, and bears its weight.
#[test]
fn a_box_that_slides_to_rest_gives_the_seabed_its_momentum() {
    let half = DVec3::new(0.6, 0.3, 0.2);
    let mut trap = weight("trap", 18.0, DVec3::Z * -29.8, None);
    trap.inertia_kg_m2 = DVec3::new(0.8, 2.4, 2.7);
    (trap.start_friction, trap.slide_friction) = (0.5, 0.5);
    let sign = |k: usize, bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
    trap.feet_m = (0..8).map(|k| half * DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2))).collect();
    let mut spec =
        model(water(0.0, 0.0), Vec::new(), Vec::new(), vec![trap], kept(false)).spec.clone();
    spec.seabed = Some(Seabed {
        depth_m: 30.0,
        normal: DVec3::Z,
        rope_stiffness_n_m2: 1e4,
        foot_stiffness_n_m: 2e4,
        rope_friction: 0.5,
    });
    let model = Model::new(spec).expect("a sound model");
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    run(&model, &mut state, &mut workspace, 2.0);
    state.bodies[0].velocity = DVec3::X;
    state.rope.earlier_dt_s = 0.0;
    let mut workspace = Workspace::new(&model);
    run(&model, &mut state, &mut workspace, 4.0);
    let balance = summary(&model, &state, &workspace);
    let seabed = impulse(&balance, Source::Seabed);
    println!("{balance:?}");
    // The grip breaks within the first step, with an error of a tenth of a newton second.
    assert!((seabed.x + 18.0).abs() < 0.15, "{seabed}");
    assert!((seabed.z - 18.0 * 9.81 * 2.0).abs() < 0.05, "{seabed}");
    assert!(balance.residual_share() < 1e-3, "{}", balance.residual_share());
    let motion_j = 0.5 * 18.0;
    assert!((balance.kinetic_j + motion_j).abs() < 1e-2, "{balance:?}");
    assert!(work(&balance, Source::Seabed) < -0.9 * motion_j, "{balance:?}");
}

/// Rope drawn over a drum by a hand, with a steady pull on its other end: drum, hand and pull are in balance.
#[test]
fn a_rope_over_a_drum_is_held_by_drum_and_fixtures() {
    let model = over_a_drum(true);
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    run(&model, &mut state, &mut workspace, 1.0);
    let balance = summary(&model, &state, &workspace);
    let (drum, ends) = (impulse(&balance, Source::Obstacles), impulse(&balance, Source::Fixtures));
    println!("{drum} {ends} {:.1e} {balance:?}", balance.residual_share());
    assert!(drum.z > 100.0 && (drum + ends - balance.momentum_ns).length() < 1e-3 * drum.length());
    assert!(balance.residual_share() < 1e-3, "{}", balance.residual_share());
    assert!(work(&balance, Source::Obstacles) < 0.0, "{balance:?}");
}

/// A rope over half a drum of 0.5 m, 50 N on one end and a hand at the other.
fn over_a_drum(balance: bool) -> Model {
    let (radius, tail, count) = (0.5, 1.0, 80);
    let whole = 2.0 * tail + PI * radius;
    let path = |s: f64| {
        let angle = ((s - tail) / radius).clamp(0.0, PI);
        let below = (tail - s).max(0.0) + (s - tail - PI * radius).max(0.0);
        DVec3::new(-radius * libm::cos(angle), 0.0, radius * libm::sin(angle) - below)
    };
    let pulled = JointKind::Pulled { force_n: DVec3::Z * -50.0, from_s: 0.0 };
    let hand =
        JointKind::Driven { velocity_m_s: DVec3::Z * -0.2, from_s: 0.2, until_s: f64::INFINITY };
    let joints = vec![
        Joint { id: "slack".into(), kind: pulled, position_m: path(0.0) },
        Joint { id: "hand".into(), kind: hand, position_m: path(whole) },
    ];
    let mut rope = line("rope", whole, count);
    rope.start_m = (0..=count).map(|k| path(whole * k as f64 / count as f64)).collect();
    let shape = SolidShape::Cylinder { radius_m: radius - 0.005, half_length_m: 1.0 };
    let drum = obstacle(shape, DVec3::ZERO, DQuat::from_rotation_x(PI / 2.0), 0.3);
    let vacuum = Water { gravity_m_s2: 0.0, ..water(0.0, 0.0) };
    let settings = Settings { step_s: 0.005, balance, ..Settings::default() };
    model_with(vacuum, joints, vec![rope], Vec::new(), settings, vec![drum])
}

/// No number of a state depends on whether the balance is kept.
#[test]
fn a_state_is_the_same_with_and_without_the_balance() {
    let states = [false, true].map(|balance| {
        let model = over_a_drum(balance);
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        run(&model, &mut state, &mut workspace, 1.0);
        assert_eq!(workspace.balance.summary(&model, &state).is_some(), balance);
        state
    });
    assert_eq!(states[0], states[1]);
}

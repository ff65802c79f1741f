//! What must hold for any gear: no stiffness, mass ratio or segment length makes the solver blow up, links
//! part at their rating, bodies fall and slide as rigid bodies do, bad models are refused by name.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use endline_fixtures::gear::{fixed, line, model, on_body, water, weight};
use endline_sdk::LineEnd;
use endline_sim::model::{Link, Seabed, Settings};
use endline_sim::{DQuat, DVec3, Input, Model, State, Stop, Workspace, settle, step};

fn pendulum(stiffness_times: f64, mass_kg: f64, segments: usize, step_s: f64) -> Model {
    let end = DVec3::new(30.0, 0.0, -51.9);
    let settings = Settings { step_s, ..Settings::default() };
    let weights = vec![weight("weight", mass_kg, end, Some(0.0))];
    let mut spec = model(
        water(0.0, 0.0),
        vec![fixed("pin", DVec3::ZERO), on_body("weight", 0)],
        vec![line("line", 60.0, segments)],
        weights,
        settings,
    )
    .spec;
    spec.ropes[0].axial_stiffness_n *= stiffness_times;
    Model::new(spec).expect("a sound model")
}

/// Greatest energy above the start of a free fall from rest, as a share of the work of gravity.
fn gained(model: &Model, seconds: f64) -> f64 {
    let mut state = State::start(model);
    let mut workspace = Workspace::new(model);
    let energy = |state: &State| {
        let rope: f64 = (0..model.node_count - 1)
            .map(|node| {
                0.06 * 60.0 / model.segment_count as f64
                    * (0.5 * state.rope.velocity[node].length_squared()
                        + 9.81 * state.rope.position[node].z)
            })
            .sum();
        let body = &state.bodies[0];
        rope + model.spec.bodies[0].mass_kg
            * (0.5 * body.velocity.length_squared() + 9.81 * body.position.z)
    };
    let start = energy(&state);
    let mut most = 0.0_f64;
    while state.time_s < seconds {
        step(model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        assert!(
            state.rope.position.iter().all(|place| place.is_finite() && place.length() < 100.0)
        );
        most = most.max(energy(&state) - start);
    }
    most / (9.81 * 60.0 * (model.spec.bodies[0].mass_kg + 3.6))
}

#[test]
fn no_stiffness_mass_ratio_or_segment_length_blows_up() {
    for (stiffness_times, mass_kg, segments, step_s) in [
        (1.0, 20.0, 100, 0.01),
        (1e3, 20.0, 100, 0.02),
        (1e6, 20.0, 100, 0.02),
        (1.0, 360.0, 1000, 0.02),
        (1e3, 36_000.0, 100, 0.01),
        (1.0, 0.000_36, 100, 0.02),
        (1.0, 20.0, 3, 0.05),
    ] {
        let share = gained(&pendulum(stiffness_times, mass_kg, segments, step_s), 4.0);
        println!(
            "EA x {stiffness_times}, {mass_kg} kg, {segments} segments, step {step_s}: energy gained {share:.2e}"
        );
        assert!(share < 1e-3, "energy grew by {share} of the work of gravity");
    }
}

/// Numbers drawn from a seed.
struct Dice(u64);

impl Dice {
    /// Between two bounds, even in the logarithm.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low * libm::pow(high / low, (self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// Energy gained by a weight let go from the level on a drawn pendulum, as a share of what its fall can give, or why it ended.
fn let_go(dice: &mut Dice, auto_step: bool) -> (String, Result<f64, Stop>) {
    let (stiffness, ratio) = (dice.between(1.0, 1e6), dice.between(1e-4, 1e4));
    let (segment_m, step_s, segments) =
        (dice.between(1e-3, 10.0), dice.between(1e-4, 0.1), dice.between(2.0, 40.0) as usize);
    let drawn = format!(
        "EA x {stiffness:.3e}, mass ratio {ratio:.3e}, {segments} segments of {segment_m:.3e} m, step {step_s:.3e} s, auto {auto_step}"
    );
    let length = segment_m * segments as f64;
    let (rope_kg, weight_kg) = (0.06 * length, 0.06 * length * ratio);
    let joints = vec![fixed("pin", DVec3::ZERO), on_body("weight", 0)];
    let settings = Settings { step_s, auto_step, ..Settings::default() };
    let bodies = vec![weight("weight", weight_kg, DVec3::X * length, None)];
    let mut spec =
        model(water(0.0, 0.0), joints, vec![line("line", length, segments)], bodies, settings).spec;
    spec.ropes[0].axial_stiffness_n *= stiffness;
    let model = Model::new(spec).expect("a sound model");
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    let mut most = 0.0_f64;
    for _ in 0..60 {
        if let Err(stop) = step(&model, &Input::default(), &mut state, &mut workspace) {
            return (drawn, Err(stop));
        }
        let rope: f64 = (0..model.node_count)
            .map(|node| {
                let share = if node == 0 || node == segments { 0.5 } else { 1.0 } / segments as f64;
                share
                    * (0.5 * state.rope.velocity[node].length_squared()
                        + 9.81 * state.rope.position[node].z)
            })
            .sum();
        let body = &state.bodies[0];
        let energy = rope_kg * rope
            + weight_kg * (0.5 * body.velocity.length_squared() + 9.81 * body.position.z);
        assert!(
            energy.is_finite() && state.rope.tension.iter().all(|tension| tension.is_finite()),
            "{drawn}"
        );
        most = most.max(energy / (9.81 * length * (rope_kg + weight_kg)));
    }
    (drawn, Ok(most))
}

/// EA to 10⁶ times, mass ratio 1:10 000 either way, segments of 1 mm to 10 m, steps of 0.1 ms to 0.1 s.
#[test]
fn no_drawn_setting_blows_up() {
    let seed = 20_261_122;
    let mut dice = Dice(seed);
    let (mut ended, mut worst) = (0, 0.0_f64);
    for case in 0..200 {
        let (drawn, outcome) = let_go(&mut dice, case % 2 == 0);
        match outcome {
            Ok(gained) => {
                worst = worst.max(gained);
                assert!(
                    gained < 5e-2,
                    "seed {seed}, case {case}: {drawn}: energy grew by {gained:.2e}"
                );
            }
            Err(stop) => {
                ended += 1;
                println!("{drawn}: {stop:?}");
                assert!(!stop.part.is_empty() && !stop.reason.is_empty());
            }
        }
    }
    println!(
        "seed {seed}: 200 drawn, {ended} ended with a reason, energy gained {worst:.2e} at most"
    );
    assert!(ended < 10, "{ended} of 200 ended");
}

/// A hand draws a line tight against a fixture through a link.
fn drawn(rating_n: f64, enabled: bool) -> (Model, f64) {
    use endline_sim::model::{Joint, JointKind};
    let driven =
        JointKind::Driven { velocity_m_s: DVec3::X * 2.0, from_s: 0.0, until_s: f64::INFINITY };
    let far = Joint { id: "hand".into(), kind: driven, position_m: DVec3::X * 59.5 };
    let mut spec = model(
        water(0.0, 0.0),
        vec![fixed("pin", DVec3::ZERO), far],
        vec![line("line", 60.0, 60)],
        Vec::new(),
        Settings::default(),
    )
    .spec;
    spec.links = vec![Link { id: "link".into(), line: 0, end: LineEnd::A, rating_n, enabled }];
    (Model::new(spec).expect("a sound model"), rating_n)
}

#[test]
fn a_weak_link_parts_at_its_rating_and_only_when_enabled() {
    for (rating, enabled, parts) in
        [(800.0, true, true), (800.0, false, false), (8000.0, true, false)]
    {
        let (model, rating) = drawn(rating, enabled);
        let settled = settle(&model);
        assert!(settled.converged);
        let (mut state, mut workspace) = (settled.state, Workspace::new(&model));
        let mut peak = 0.0_f64;
        while state.time_s < 1.0 {
            step(&model, &Input::default(), &mut state, &mut workspace)
                .unwrap_or_else(|stop| panic!("{stop:?}"));
            peak = peak.max(workspace.peak_tension_n[0]);
        }
        println!(
            "rating {rating} N, enabled {enabled}: peak {peak:.1} N, parted {:?}",
            state.link_parted_s[0]
        );
        assert_eq!(state.link_parted_s[0].is_some(), parts);
        if parts {
            assert!((peak / rating - 1.0).abs() < 0.02, "parted at {peak} N");
        }
    }
}

/// A box thrown along a level seabed stops after `v²/2μg`, and does not creep afterwards.
#[test]
fn a_box_slides_to_rest_as_coulomb_says() {
    let half = DVec3::new(0.5, 0.3, 0.2);
    let mut body = weight("box", 20.0, DVec3::new(0.0, 0.0, -30.0 + half.z), None);
    body.feet_m = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(x, y)| DVec3::new(x * half.x, y * half.y, -half.z))
        .to_vec();
    body.inertia_kg_m2 = DVec3::new(1.0, 2.0, 2.5);
    (body.start_friction, body.slide_friction) = (0.6, 0.4);
    let mut spec = model(
        water(0.0, 0.0),
        Vec::new(),
        Vec::new(),
        vec![body],
        Settings { step_s: 0.002, ..Settings::default() },
    )
    .spec;
    spec.seabed = Some(Seabed {
        depth_m: 30.0,
        normal: DVec3::Z,
        rope_stiffness_n_m2: 1e4,
        foot_stiffness_n_m: 1e5,
        rope_friction: 0.5,
    });
    let model = Model::new(spec).expect("a sound model");
    let (mut state, mut workspace) = (settle(&model).state, Workspace::new(&model));
    state.bodies[0].velocity = DVec3::X * 2.0;
    let start = state.bodies[0].position.x;
    let go = |until: f64, state: &mut State, workspace: &mut Workspace| {
        while state.time_s < until {
            step(&model, &Input::default(), state, workspace)
                .unwrap_or_else(|stop| panic!("{stop:?}"));
        }
        state.bodies[0].position.x
    };
    let rest = go(2.0, &mut state, &mut workspace);
    let later = go(6.0, &mut state, &mut workspace);
    let expected = 2.0 * 2.0 / (2.0 * 0.4 * 9.81);
    println!("slid {:.4} m for {expected:.4} m, crept {:.2e} m", rest - start, later - rest);
    assert!(((rest - start) / expected - 1.0).abs() < 0.03);
    assert!((later - rest).abs() < 1e-6);
}

/// On a slope of `θ` a box holds while `tan θ` is below its starting friction, and else slides off with
/// `g (sin θ - μ cos θ)`.
#[test]
fn a_box_on_a_slope_holds_or_slides_as_coulomb_says() {
    // Flat, so that its feet share weight and friction alike.
    let (half, start, slide) = (DVec3::new(0.5, 0.3, 0.02), 0.6, 0.4);
    for (angle, seconds) in [(0.5, 4.0), (0.6, 1.5)] {
        let turn = DQuat::from_rotation_y(angle);
        let normal = turn * DVec3::Z;
        let mut body = weight("box", 20.0, DVec3::Z * -30.0 + normal * (half.z - 0.001), None);
        body.feet_m = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
            .map(|(x, y)| DVec3::new(x * half.x, y * half.y, -half.z))
            .to_vec();
        (body.start_friction, body.slide_friction, body.orientation) = (start, slide, turn);
        let mut spec = model(
            water(0.0, 0.0),
            Vec::new(),
            Vec::new(),
            vec![body],
            Settings { step_s: 0.002, ..Settings::default() },
        )
        .spec;
        spec.seabed = Some(Seabed {
            depth_m: 30.0,
            normal,
            rope_stiffness_n_m2: 1e4,
            foot_stiffness_n_m: 1e5,
            rope_friction: 0.5,
        });
        let model = Model::new(spec).expect("a sound model");
        // One that holds starts at rest; one that cannot starts where it stands.
        let at_rest =
            if libm::tan(angle) < start { settle(&model).state } else { State::start(&model) };
        let (mut state, mut workspace) = (at_rest, Workspace::new(&model));
        let begin = state.bodies[0].position;
        let mut go = |until: f64| {
            while state.time_s < until {
                step(&model, &Input::default(), &mut state, &mut workspace)
                    .unwrap_or_else(|stop| panic!("{stop:?}"));
            }
            (state.bodies[0].position - begin).dot(turn * DVec3::X)
        };
        if libm::tan(angle) < start {
            let (early, late) = (go(1.0), go(seconds));
            println!(
                "on {angle} rad it gives {:.2} mm and creeps {:.1e} m",
                1e3 * early,
                late - early
            );
            assert!(early < 0.003 && (late - early).abs() < 1e-6);
        } else {
            let expected =
                0.5 * 9.81 * (libm::sin(angle) - slide * libm::cos(angle)) * seconds * seconds;
            let slid = go(seconds);
            println!("on {angle} rad it slides {slid:.4} m for {expected:.4}");
            assert!((slid / expected - 1.0).abs() < 0.02);
        }
    }
}

/// Spin about the middle axis tumbles (Dzhanibekov), about the long axis keeps its momentum.
#[test]
fn a_free_body_keeps_its_angular_momentum() {
    let mut body = weight("box", 18.0, DVec3::ZERO, None);
    body.inertia_kg_m2 = DVec3::new(1.2, 2.4, 2.8);
    let model = model(
        water(0.0, 0.0),
        Vec::new(),
        Vec::new(),
        vec![body],
        Settings { step_s: 0.001, ..Settings::default() },
    );
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    state.bodies[0].spin = DVec3::new(2.0, 0.05, 0.02);
    let momentum = |state: &State| {
        let body = &state.bodies[0];
        body.orientation
            * (model.spec.bodies[0].inertia_kg_m2 * (body.orientation.inverse() * body.spin))
    };
    let start = momentum(&state);
    while state.time_s < 3.0 {
        step(&model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    let off = (momentum(&state) - start).length() / start.length();
    println!(
        "angular momentum off by {:.3} %, fallen {:.3} m",
        100.0 * off,
        -state.bodies[0].position.z
    );
    assert!(off < 0.01);
    assert!((state.bodies[0].position.z / (-0.5 * 9.81 * 9.0) - 1.0).abs() < 1e-3);
}

#[test]
fn bad_models_are_refused_with_the_part_and_the_reason() {
    let mut spec = pendulum(1.0, 20.0, 10, 0.01).spec;
    spec.ropes[0].diameter_m = -0.01;
    spec.lines[0].segments_m[3] = f64::NAN;
    spec.bodies[0].mass_kg = 0.0;
    spec.links =
        vec![Link { id: "weak".into(), line: 7, end: LineEnd::A, rating_n: 0.0, enabled: true }];
    let errors = Model::new(spec).err().expect("errors");
    let parts: Vec<&str> = errors.iter().map(|error| error.part.as_str()).collect();
    assert_eq!(parts, ["rope reference", "body weight", "line line", "link weak", "link weak"]);
    assert_eq!(errors[0].message, "diameter is -0.01, expected a number above zero");
}

//! Error of the step that the program chooses: snaps against analytic and resolved peaks, swings against resolved motion.
#![allow(clippy::expect_used, reason = "a test fails by panicking, in its helpers too")]

use endline_fixtures::gear::{fixed, line, model, on_body, water, weight};
use endline_sim::model::{Joint, JointKind, ModelSpec, Settings};
use endline_sim::{DVec3, Input, Model, State, Workspace, settle, step};

const SEA_KG_M3: f64 = 1025.0;

fn set(step_s: f64) -> Settings {
    Settings { step_s, ..Settings::default() }
}

fn chosen() -> Settings {
    Settings { auto_step: true, ..Settings::default() }
}

/// Greatest tension of any segment until then, over all solver steps [N], and how many there were.
fn peak(model: &Model, mut state: State, until_s: f64) -> (f64, u64) {
    let (mut workspace, mut peak) = (Workspace::new(model), 0.0);
    while state.time_s < until_s - 1e-9 {
        step(model, &Input::default(), &mut state, &mut workspace).expect("a step");
        peak = workspace.peak_tension_n.iter().copied().fold(peak, f64::max);
    }
    (peak, workspace.audit.solver_steps)
}

/// A mass that light rope catches at a speed `U`: from slack without gravity, `U √(k m)`; from taut with gravity,
/// `m g + √((m g)² + k m U²)` where the rope pulls nothing at first.
#[test]
fn a_mass_caught_by_light_rope_has_the_analytic_peak() {
    let (length, mass, speed, slack): (f64, f64, f64, f64) = (20.0, 20.0, 3.0, 0.05);
    let stiffness = 1e5 / length;
    for (gravity, slack) in [(0.0, slack), (9.81, 0.0)] {
        let sea = water(0.0, 0.0);
        let sea = endline_sim::water::Water { gravity_m_s2: gravity, ..sea };
        let place = DVec3::Z * (slack - length);
        let mut spec: ModelSpec = model(
            sea,
            vec![fixed("pin", DVec3::ZERO), on_body("mass", 0)],
            vec![line("rope", length, 40)],
            vec![weight("mass", mass, place, None)],
            Settings { as_placed: true, ..chosen() },
        )
        .spec;
        spec.ropes[0].mass_kg_m = 6e-4;
        let model = Model::new(spec).expect("a sound model");
        let mut state = State::start(&model);
        state.bodies[0].velocity = DVec3::Z * -speed;
        for (node, velocity) in state.rope.velocity.iter_mut().enumerate() {
            *velocity = DVec3::Z * (-speed * node as f64 / 40.0);
        }
        let weight_n = mass * gravity;
        let expected = weight_n + (weight_n * weight_n + stiffness * mass * speed * speed).sqrt();
        let (peak, steps) = peak(&model, state, 0.4);
        println!("gravity {gravity}: {peak:.2} N for {expected:.2} N in {steps} steps");
        assert!((peak / expected - 1.0).abs() < 0.003, "{peak} N for {expected} N");
    }
}

/// 60 m of rope across 59 m, drawn taut at a speed over 2 m (reference problem c2 at 2 m/s).
fn drawn_taut(density_kg_m3: f64, speed: f64, settings: Settings) -> (Model, State) {
    let driven =
        JointKind::Driven { velocity_m_s: DVec3::X * speed, from_s: 0.0, until_s: 2.0 / speed };
    let far = Joint { id: "hand".into(), kind: driven, position_m: DVec3::X * 59.0 };
    let model = model(
        water(density_kg_m3, 0.0),
        vec![fixed("pin", DVec3::ZERO), far],
        vec![line("line", 60.0, 100)],
        Vec::new(),
        settings,
    );
    let state = settle(&model).state;
    (model, state)
}

/// In a vacuum the waves that the hand sets off run to and fro until the snap, whose peak is off by several per cent where
/// their phase is.
#[test]
fn the_programs_step_finds_the_resolved_peak_of_a_snap() {
    for (density, speed) in [(0.0, 2.0), (0.0, 3.0), (SEA_KG_M3, 3.0)] {
        let peak_at = |settings: Settings| {
            let (model, state) = drawn_taut(density, speed, settings);
            peak(&model, state, 1.5)
        };
        let (resolved, _) = peak_at(set(1e-4));
        let (fixed, _) = peak_at(set(0.01));
        let (found, steps) = peak_at(chosen());
        println!(
            "{speed} m/s, {density} kg/m3: {found:.2} N in {steps} steps, {fixed:.2} N at 10 ms, {resolved:.2} N resolved"
        );
        let error = |peak: f64| (peak / resolved - 1.0).abs();
        assert!(error(found) < 0.005 && error(found) < error(fixed), "{found} N for {resolved} N");
        assert!(steps < 6000, "{steps} steps");
    }
}

/// 45 m of rope with 12 kg at its end, let go 40 degrees from the vertical.
fn pendulum(density_kg_m3: f64, settings: Settings) -> (Model, State) {
    let (sin, cos) = libm::sincos(40.0_f64.to_radians());
    let mut spec = model(
        water(density_kg_m3, 0.0),
        vec![fixed("pin", DVec3::ZERO), on_body("weight", 0)],
        vec![line("rope", 45.0, 100)],
        vec![weight("weight", 12.0, DVec3::new(45.0 * sin, 0.0, -45.0 * cos), Some(0.0))],
        settings,
    )
    .spec;
    spec.ropes[0].axial_stiffness_n = 6e4;
    let model = Model::new(spec).expect("a sound model");
    let state = settle(&model).state;
    (model, state)
}

/// End, middle and tension at the pin, every 0.1 s of two swings, and how many solver steps there were.
fn swing(density_kg_m3: f64, settings: Settings) -> (Vec<(DVec3, DVec3, f64)>, u64) {
    let (model, mut state) = pendulum(density_kg_m3, settings);
    let mut workspace = Workspace::new(&model);
    let mut seen = Vec::new();
    while seen.len() < 280 {
        let until = 0.1 * (seen.len() + 1) as f64;
        while state.time_s < until - 1e-9 {
            step(&model, &Input::default(), &mut state, &mut workspace).expect("a step");
        }
        let rope = &state.rope;
        seen.push((rope.position[100], rope.position[50], rope.tension[0]));
    }
    (seen, workspace.audit.solver_steps)
}

/// Where nothing drags, an error stays: steps are taken in two stages at the default setting too. In water BDF2 at 10 ms will do.
#[test]
fn a_swing_follows_the_resolved_motion_at_the_default_step() {
    for density in [0.0, SEA_KG_M3] {
        let (resolved, _) = swing(density, set(2.5e-4));
        for settings in [Settings::default(), chosen()] {
            let auto = settings.auto_step;
            let (found, steps) = swing(density, settings);
            let (mut place, mut tension, mut size) = (0.0_f64, 0.0, 0.0);
            for (found, resolved) in found.iter().zip(&resolved) {
                place = place.max(found.0.distance(resolved.0)).max(found.1.distance(resolved.1));
                tension += (found.2 - resolved.2) * (found.2 - resolved.2);
                size += resolved.2 * resolved.2;
            }
            let tension = (tension / size).sqrt();
            println!(
                "pendulum in {density} kg/m3, auto {auto}: {:.2} mm at most, tension {:.3} % in {steps} steps",
                1e3 * place,
                1e2 * tension
            );
            assert!(place < 0.003, "{place} m");
            assert!(tension < 0.006, "{tension}");
            if density > 0.0 && !auto {
                assert_eq!(steps, 2800, "no more than one for each input");
            }
        }
    }
}

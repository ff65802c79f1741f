//! The reference problems: analytic and independently solved answers with their tolerances.
#![allow(clippy::expect_used, reason = "a test fails by panicking, in its helpers too")]

use endline_fixtures::gear::{fixed, line, model, on_body, water, weight};
use endline_sim::model::{Float, Joint, JointKind, Settings};
use endline_sim::state::LimitedBy;
use endline_sim::{DVec3, Input, Model, State, Workspace, settle, step};

/// (t, end x, end z, middle x, middle z, tension at the pin) of the pendulum with axial waves, by RK4 with
/// N = 200, 400, 800 and Richardson extrapolation.
const PENDULUM: [[f64; 6]; 10] = [
    [1.0, 27.84200815, -53.28016142, 13.95575125, -26.62453783, 209.2617619],
    [2.0, 21.40860085, -56.18367479, 10.20955498, -28.28385356, 245.53398],
    [3.0, 11.16567814, -59.10424017, 5.813083088, -29.51120787, 272.1661144],
    [4.0, -1.202510678, -60.14385092, -0.8873775777, -30.06956014, 284.9071821],
    [5.0, -13.38645408, -58.6398814, -6.34509473, -29.40226781, 275.0977249],
    [6.0, -22.94263779, -55.58436872, -11.4558516, -27.8012515, 238.9658529],
    [7.0, -28.61861246, -52.85348484, -13.82262659, -26.69236277, 211.0526681],
    [8.0, -29.94330771, -52.11983558, -14.89911839, -26.10381362, 198.7644264],
    [9.0, -26.95078671, -53.7230781, -12.95189947, -27.12514599, 215.6016308],
    [10.0, -19.67981946, -56.82836398, -9.937168175, -28.38363216, 251.9943426],
];

fn pendulum(segments: usize, step_s: f64) -> Model {
    let end = DVec3::new(30.04414861, 0.0, -52.03799186);
    let joints = vec![fixed("pin", DVec3::ZERO), on_body("weight", 0)];
    let settings = Settings { step_s, ..Settings::default() };
    model(
        water(0.0, 0.0),
        joints,
        vec![line("pendulum", 60.0, segments)],
        vec![weight("weight", 20.0, end, Some(0.0))],
        settings,
    )
}

fn run_until(model: &Model, state: &mut State, workspace: &mut Workspace, time_s: f64) {
    while state.time_s < time_s - 1e-9 {
        step(model, &Input::default(), state, workspace).expect("a step");
    }
}

#[test]
fn problem_a_pendulum_with_axial_waves() {
    let segments = 100;
    let model = pendulum(segments, 0.01);
    let settled = settle(&model);
    assert!(settled.converged, "{:?}", settled.trace_n);
    let mut state = settled.state;
    assert!(
        (state.rope.position[segments / 2] - DVec3::new(14.4026908, 0.0, -26.3797929)).length()
            < 1e-3
    );
    let mut workspace = Workspace::new(&model);
    let (mut place, mut tension, mut size) = (0.0, 0.0, 0.0);
    for [time, end_x, end_z, middle_x, middle_z, pin] in PENDULUM {
        run_until(&model, &mut state, &mut workspace, time);
        let (end, middle) = (state.rope.position[segments], state.rope.position[segments / 2]);
        place += (end - DVec3::new(end_x, 0.0, end_z)).length_squared()
            + (middle - DVec3::new(middle_x, 0.0, middle_z)).length_squared();
        tension += (state.rope.tension[0] - pin) * (state.rope.tension[0] - pin);
        size += pin * pin;
    }
    let place_cm = 100.0 * (place / 20.0).sqrt();
    let tension_percent = 100.0 * (tension / size).sqrt();
    println!(
        "problem a: {place_cm:.3} cm, {tension_percent:.3} %, passes per step {}",
        workspace.audit.passes as f64 / workspace.audit.solver_steps as f64
    );
    assert!(place_cm < 0.3, "{place_cm} cm");
    assert!(tension_percent < 0.6, "{tension_percent} %");
}

/// A rope anchored at 30 m to a buoy at the surface, in a current of 0.5 m/s.
fn buoy(segments: usize, step_s: f64) -> Model {
    let mut buoy = weight("buoy", 1.0, DVec3::new(51.9615, 0.0, 0.0), None);
    buoy.floats = vec![Float::level(DVec3::ZERO, 0.010, 0.25)];
    buoy.drag_area_m2 = DVec3::splat(0.0281);
    buoy.added_mass_kg = DVec3::splat(0.5 * 1025.0 * 0.010);
    let joints = vec![fixed("anchor", DVec3::new(0.0, 0.0, -30.0)), on_body("buoy", 0)];
    let settings = Settings { step_s, ..Settings::default() };
    model(water(1025.0, 0.5), joints, vec![line("endline", 60.0, segments)], vec![buoy], settings)
}

#[test]
fn problem_b_static_agrees_with_shooting() {
    let segments = 500;
    let model = buoy(segments, 0.01);
    let settled = settle(&model);
    println!("problem b: {} passes, residual {:.2e} N", settled.trace_n.len(), settled.residual_n);
    assert!(settled.converged, "{:?}", settled.trace_n);
    let rope = &settled.state.rope;
    for (s, x, z) in [
        (15.0, 13.91000, -24.37792),
        (30.0, 27.63402, -18.31986),
        (45.0, 40.75153, -11.06805),
        (60.0, 50.34061059, 0.06596101),
    ] {
        let node = (s / 60.0 * segments as f64).round() as usize;
        let error = (rope.position[node] - DVec3::new(x, 0.0, z)).length();
        println!("  node at {s} m: {:.3} mm", 1e3 * error);
        assert!(error < 0.01, "node at {s} m is off by {error} m");
    }
    // A segment's tension is that of its middle: half a segment off the end.
    let ends = [(rope.tension[0], 23.93630), (rope.tension[segments - 1], 14.39362)];
    for (got, expected) in ends {
        println!("  tension {got:.5} N for {expected:.5} N");
        assert!((got / expected - 1.0).abs() < 0.002, "{got} N for {expected} N");
    }
}

#[test]
fn problem_b_transient_agrees_with_rk4() {
    let segments = 500;
    let model = buoy(segments, 0.05);
    let mut state = State::start(&model);
    let mut workspace = Workspace::new(&model);
    for (time, x, z, middle_x, middle_z, anchor) in [
        (20.0, 51.5936385, 0.0842443, 26.7187191, -16.3767837, 17.3695591),
        (40.0, 51.1079912, 0.0756044, 27.1825812, -17.316029, 20.4465109),
        (60.0, 50.7414679, 0.0704749, 27.414102, -17.8168656, 22.3007823),
    ] {
        run_until(&model, &mut state, &mut workspace, time);
        let buoy_off = (state.bodies[0].position - DVec3::new(x, 0.0, z)).length();
        let middle_off =
            (state.rope.position[segments / 2] - DVec3::new(middle_x, 0.0, middle_z)).length();
        println!(
            "problem b at {time} s: buoy {:.2} mm, middle {:.2} mm, anchor {:.4} N",
            1e3 * buoy_off,
            1e3 * middle_off,
            state.rope.tension[0]
        );
        assert!(buoy_off < 0.005 && middle_off < 0.005, "{buoy_off} m, {middle_off} m");
        assert!((state.rope.tension[0] / anchor - 1.0).abs() < 0.003);
    }
}

/// Slack to taut: the peak of the snap, at a step that resolves it.
#[test]
fn problem_c2_snap_load() {
    let segments = 100;
    let driven = JointKind::Driven { velocity_m_s: DVec3::X * 2.0, from_s: 0.0, until_s: 1.0 };
    let far = Joint { id: "hand".into(), kind: driven, position_m: DVec3::X * 59.0 };
    let settings = Settings { step_s: 0.0005, ..Settings::default() };
    let model = model(
        water(0.0, 0.0),
        vec![fixed("pin", DVec3::ZERO), far],
        vec![line("line", 60.0, segments)],
        Vec::new(),
        settings,
    );
    let settled = settle(&model);
    assert!(settled.converged);
    let mut state = settled.state;
    assert!((state.rope.position[50].z + 4.8094).abs() < 2e-3, "sag {}", state.rope.position[50].z);
    let mut workspace = Workspace::new(&model);
    let mut peak = 0.0_f64;
    while state.time_s < 1.5 - 1e-9 {
        let time = state.time_s + 0.05;
        run_until(&model, &mut state, &mut workspace, time);
        peak = peak.max(state.rope.tension[0]);
    }
    println!("problem c2: peak of the samples {peak:.2} N for 1840.51 N");
    assert!((peak / 1840.513769 - 1.0).abs() < 0.005);
}

/// Two weights on the seabed with slack rope between them, and a buoy on an endline from one: the groundline
/// lies down, the rest is as the lone endline would be.
#[test]
fn a_slack_groundline_settles_on_the_seabed() {
    use endline_sim::model::Seabed;
    let feet = [(0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.2)]
        .map(|(x, y)| DVec3::new(x, y, -0.15))
        .to_vec();
    let trap = |id: &str, x: f64| {
        let mut body = weight(id, 15.0, DVec3::new(x, 0.0, -29.85), None);
        body.feet_m.clone_from(&feet);
        (body.start_friction, body.slide_friction) = (0.8, 0.6);
        body
    };
    let mut float = weight("buoy", 1.0, DVec3::new(-10.0, 0.0, 0.0), None);
    float.floats = vec![Float::level(DVec3::ZERO, 0.010, 0.25)];
    float.drag_area_m2 = DVec3::splat(0.0281);
    let joints = vec![on_body("a", 0), on_body("b", 1), on_body("c", 2)];
    let mut endline = line("endline", 40.0, 80);
    (endline.from, endline.to) = (0, 2);
    for slack in [1.001, 1.02, 1.1, 1.5] {
        let lines = vec![line("groundline", 20.0 * slack, 40), endline.clone()];
        let bodies = vec![trap("one", 0.0), trap("two", 20.0), float.clone()];
        let mut spec =
            model(water(1025.0, 0.3), joints.clone(), lines, bodies, Settings::default()).spec;
        // Sinking rope: 65 N/km in water would float off, so give it more.
        spec.ropes[0].mass_kg_m = 0.09;
        spec.seabed = Some(Seabed {
            depth_m: 30.0,
            normal: DVec3::Z,
            rope_stiffness_n_m2: 5e3,
            foot_stiffness_n_m: 2e4,
            rope_friction: 0.5,
        });
        let settled = settle(&Model::new(spec).expect("a sound model"));
        println!(
            "slack {slack}: {} passes, residual {:.1e} N",
            settled.trace_n.len(),
            settled.residual_n
        );
        assert!(
            settled.converged,
            "slack {slack}: {:?}",
            settled.trace_n.iter().rev().take(12).collect::<Vec<_>>()
        );
        let highest =
            settled.state.rope.position[..41].iter().map(|place| place.z).fold(f64::MIN, f64::max);
        assert!(highest < -29.4, "the groundline rises to {highest} m");
    }
}

/// The snap load with the step chosen by the program, from an interval of inputs far too long for the snap.
#[test]
fn problem_c2_snap_load_at_the_programs_own_step() {
    let driven = JointKind::Driven { velocity_m_s: DVec3::X * 2.0, from_s: 0.0, until_s: 1.0 };
    let far = Joint { id: "hand".into(), kind: driven, position_m: DVec3::X * 59.0 };
    let settings = Settings { step_s: 0.02, auto_step: true, ..Settings::default() };
    let model = model(
        water(0.0, 0.0),
        vec![fixed("pin", DVec3::ZERO), far],
        vec![line("line", 60.0, 100)],
        Vec::new(),
        settings,
    );
    let (mut state, mut workspace) = (settle(&model).state, Workspace::new(&model));
    let mut peak = 0.0_f64;
    while state.time_s < 1.5 - 1e-9 {
        let time = state.time_s + 0.1;
        run_until(&model, &mut state, &mut workspace, time);
        peak = peak.max(state.rope.tension[0]);
    }
    let audit = workspace.audit;
    println!(
        "problem c2 at the program's step: peak of the samples {peak:.2} N in {} steps, limited by {:?}",
        audit.solver_steps, audit.limited_by
    );
    assert!((peak / 1840.513769 - 1.0).abs() < 0.003, "{peak} N");
    assert!(audit.solver_steps < 6000);
    assert_eq!(LimitedBy::mostly(&audit.limited_by).0, LimitedBy::Accuracy);
    assert_eq!(audit.limited_by.iter().sum::<u64>(), audit.solver_steps);
}

//! Bodies on the seabed: round ones roll and lie at their radius however they are turned, and a stack of traps rests.
#![allow(clippy::expect_used, reason = "a test fails by panicking, in its helpers too")]

use endline_sim::model::{Body, PlacedShape, Seabed, Settings, Shape};
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, step};

use endline_fixtures::gear::{model, water, weight};

const RADIUS: f64 = 0.15;
const MASS: f64 = 5.0;

fn ball(place: DVec3) -> Body {
    Body {
        parts: vec![PlacedShape::about_origin(Shape::Sphere(RADIUS))],
        inertia_kg_m2: DVec3::splat(0.4 * MASS * RADIUS * RADIUS),
        feet_m: vec![DVec3::ZERO],
        foot_radius_m: vec![RADIUS],
        start_friction: 0.5,
        slide_friction: 0.5,
        ..weight("ball", MASS, place, None)
    }
}

/// In a vacuum over a seabed at 30 m that falls to the east by an angle.
fn on_seabed(bodies: Vec<Body>, angle: f64) -> Model {
    let mut spec = model(water(0.0, 0.0), Vec::new(), Vec::new(), bodies, Settings::default()).spec;
    spec.seabed = Some(Seabed {
        depth_m: 30.0,
        normal: DQuat::from_rotation_y(angle) * DVec3::Z,
        foot_stiffness_n_m: 2e4,
        rope_stiffness_n_m2: 1e4,
        rope_friction: 0.5,
    });
    Model::new(spec).expect("a sound model")
}

fn run(model: &Model, state: &mut State, seconds: f64) {
    let mut workspace = Workspace::new(model);
    while state.time_s < seconds - 1e-9 {
        step(model, &Input::default(), state, &mut workspace).expect("a step");
    }
}

#[test]
fn a_ball_that_rolls_on_the_seabed_lies_at_its_radius() {
    let model = on_seabed(vec![ball(DVec3::Z * (RADIUS - 30.0))], 0.0);
    let mut state = State::start(&model);
    // It is set rolling at 0.5 m/s.
    state.bodies[0].velocity = DVec3::X * 0.5;
    state.bodies[0].spin = DVec3::Y * (0.5 / RADIUS);
    let (mut workspace, mut turned) = (Workspace::new(&model), 0.0_f64);
    while state.time_s < 3.0 {
        step(&model, &Input::default(), &mut state, &mut workspace).expect("a step");
        let now = &state.bodies[0];
        turned = turned.max((now.orientation * DVec3::Z).angle_between(DVec3::Z));
        let height = now.position.z + 30.0;
        assert!((height - RADIUS).abs() < 0.01, "{height} m at {} s", state.time_s);
    }
    let now = &state.bodies[0];
    println!(
        "turned by {turned:.2} rad, rolls at {:.4} m/s after {:.3} m",
        now.velocity.x, now.position.x
    );
    assert!(turned > 3.0);
    assert!((now.velocity.x / 0.5 - 1.0).abs() < 0.02, "{} m/s", now.velocity.x);
    let slip = now.velocity + now.spin.cross(DVec3::NEG_Z * RADIUS);
    assert!(slip.length() < 0.01, "slips at {slip} m/s");
}

#[test]
fn a_ball_rolls_down_a_sloping_seabed_without_slip() {
    let angle = 15.0_f64.to_radians();
    let normal = DQuat::from_rotation_y(angle) * DVec3::Z;
    let model = on_seabed(vec![ball(DVec3::NEG_Z * 30.0 + normal * (RADIUS - 5e-3))], angle);
    let mut state = State::start(&model);
    run(&model, &mut state, 0.5);
    let early = state.bodies[0].velocity;
    run(&model, &mut state, 1.5);
    let gained = (state.bodies[0].velocity - early).length();
    let wanted = 5.0 / 7.0 * 9.81 * libm::sin(angle);
    println!("rolls: {:.3} %", 100.0 * (gained / wanted - 1.0));
    assert!((gained / wanted - 1.0).abs() < 0.01, "{gained} and {wanted} m/s");
}

/// A buoy let fall upright topples and lies on its side, at its radius.
#[test]
fn a_capsule_that_topples_lies_at_its_radius() {
    let (radius_m, half_length_m) = (0.1, 0.4);
    let straight = DVec3::Z * (half_length_m - radius_m);
    let buoy = Body {
        parts: vec![PlacedShape::about_origin(Shape::Capsule { radius_m, half_length_m })],
        inertia_kg_m2: DVec3::new(0.3, 0.3, 0.03),
        orientation: DQuat::from_rotation_y(0.1),
        feet_m: vec![-straight, straight],
        foot_radius_m: vec![radius_m; 2],
        turn_drag_m5: DVec3::splat(0.01),
        start_friction: 0.5,
        slide_friction: 0.5,
        ..weight("buoy", 6.0, DVec3::Z * (half_length_m - 30.0), None)
    };
    let model = on_seabed(vec![buoy], 0.0);
    let mut state = State::start(&model);
    run(&model, &mut state, 5.0);
    let now = &state.bodies[0];
    let (height, axis) = (now.position.z + 30.0, now.orientation * DVec3::Z);
    println!("lies at {height:.4} m, axis {:.1e} off level", axis.z);
    assert!((height - radius_m).abs() < 0.01 && axis.z.abs() < 0.01, "{height} m, axis {axis}");
}

#[test]
fn a_stack_of_three_traps_rests_on_the_seabed() {
    let half = DVec3::new(0.5, 0.3, 0.2);
    let corner = |k: u32| {
        let sign = |bit: u32| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
        half * DVec3::new(sign(0), sign(1), sign(2))
    };
    let trap = |level: u32, turn: f64| Body {
        parts: vec![PlacedShape::about_origin(Shape::Box(half))],
        inertia_kg_m2: DVec3::new(0.9, 1.9, 2.3),
        orientation: DQuat::from_rotation_z(turn),
        feet_m: (0..8).map(corner).collect(),
        start_friction: 0.6,
        slide_friction: 0.4,
        ..weight("trap", 20.0, at(level), None)
    };
    let model = on_seabed(vec![trap(0, 0.0), trap(1, 0.2), trap(2, -0.1)], 0.0);
    let mut state = State::start(&model);
    run(&model, &mut state, 2.0);
    let settled: Vec<DVec3> = state.bodies.iter().map(|body| body.position).collect();
    run(&model, &mut state, 6.0);
    for (level, (now, before)) in (0..).zip(state.bodies.iter().zip(&settled)) {
        let (crept, sunk) = (now.position.distance(*before), now.position.distance(at(level)));
        println!("{level}: creeps {crept:.1e} m, sunk {:.1} mm", 1e3 * sunk);
        assert!(crept < 1e-4 && sunk < 0.015, "{level}: {crept} m, {sunk} m");
        assert!(now.velocity.length() < 1e-4 && now.spin.length() < 1e-3, "{level}: {now:?}");
    }
}

/// Where a trap of the stack is put [m].
fn at(level: u32) -> DVec3 {
    DVec3::new(
        0.03 * f64::from(level),
        -0.02 * f64::from(level),
        0.2 - 30.0 + 0.4 * f64::from(level),
    )
}

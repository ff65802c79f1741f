//! Bodies against each other: a stack that rests, a trap that slides on another, fast meetings, momentum.
#![allow(clippy::expect_used, reason = "a test fails by panicking, in its helpers too")]

use endline_sim::model::{Body, PlacedShape, Settings, Shape};
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, step};

use endline_fixtures::gear::{model, water, weight};

/// Friction of bodies on each other, as the engine has it.
const MU: f64 = 0.3;
const GRAVITY: f64 = 9.81;
const HALF: DVec3 = DVec3::new(0.5, 0.3, 0.2);
const FOREVER: Option<f64> = Some(1e9);

fn trap(id: &str, place: DVec3, turn: DQuat, held_until_s: Option<f64>) -> Body {
    Body {
        parts: vec![PlacedShape::about_origin(Shape::Box(HALF))],
        inertia_kg_m2: DVec3::new(0.9, 1.9, 2.3),
        orientation: turn,
        ..weight(id, 20.0, place, held_until_s)
    }
}

fn ball(id: &str, radius: f64, mass: f64, place: DVec3) -> Body {
    Body {
        parts: vec![PlacedShape::about_origin(Shape::Sphere(radius))],
        inertia_kg_m2: DVec3::splat(0.4 * mass * radius * radius),
        ..weight(id, mass, place, None)
    }
}

fn vacuum(bodies: Vec<Body>) -> Model {
    model(water(0.0, 0.0), Vec::new(), Vec::new(), bodies, Settings::default())
}

fn run(model: &Model, state: &mut State, seconds: f64) {
    let mut workspace = Workspace::new(model);
    while state.time_s < seconds - 1e-9 {
        step(model, &Input::default(), state, &mut workspace).expect("a step");
    }
}

#[test]
fn a_stack_of_three_rests() {
    let at = |level: f64| DVec3::new(0.03 * level, -0.02 * level, -10.0 + 0.4 * level);
    let still = DQuat::IDENTITY;
    let model = vacuum(vec![
        trap("low", at(0.0), still, FOREVER),
        trap("middle", at(1.0), DQuat::from_rotation_z(0.2), None),
        trap("high", at(2.0), still, None),
    ]);
    let mut state = State::start(&model);
    run(&model, &mut state, 2.0);
    let settled: Vec<DVec3> = state.bodies.iter().map(|body| body.position).collect();
    run(&model, &mut state, 6.0);
    for (body, (now, before)) in state.bodies.iter().zip(&settled).enumerate() {
        let crept = now.position.distance(*before);
        assert!(crept < 1e-4, "{body} crept {crept} m");
        assert!(now.velocity.length() < 1e-4 && now.spin.length() < 1e-3, "{body}: {now:?}");
        let sunk = (now.position - at(body as f64)).length();
        assert!(sunk < 5e-3, "{body} moved {sunk} m from where it was put");
    }
}

#[test]
fn a_trap_slides_on_another_by_coulombs_law_and_holds_on_a_lesser_slope() {
    let slope = |degrees: f64| {
        let turn = DQuat::from_rotation_y(degrees.to_radians());
        let long = Body {
            parts: vec![PlacedShape::about_origin(Shape::Box(DVec3::new(6.0, 0.6, 0.2)))],
            ..trap("slope", DVec3::NEG_Z * 10.0, turn, FOREVER)
        };
        let place = DVec3::NEG_Z * 10.0 + turn * DVec3::new(-4.0, 0.0, 0.4);
        let model = vacuum(vec![long, trap("slides", place, turn, None)]);
        let mut state = State::start(&model);
        run(&model, &mut state, 0.3);
        let early = (state.bodies[1].velocity, state.bodies[1].position);
        run(&model, &mut state, 1.3);
        let late = (state.bodies[1].velocity, state.bodies[1].position);
        ((late.0 - early.0).length(), late.1.distance(early.1))
    };
    let angle = 28.0_f64.to_radians();
    let wanted = GRAVITY * (libm::sin(angle) - MU * libm::cos(angle));
    let (gained, _) = slope(28.0);
    assert!((gained / wanted - 1.0).abs() < 0.01, "{gained} and {wanted} m/s");
    let (_, crept) = slope(14.0);
    assert!(crept < 1e-4, "{crept} m");
}

/// Small balls that fly at each other, by up to ten times their size in a step: none comes out on the other side.
#[test]
fn fast_balls_do_not_pass_and_keep_their_momentum() {
    for k in 0..400_u32 {
        let share = |step: f64| (f64::from(k) * step).fract();
        let (radius, speed) =
            (0.03 + 0.1 * share(0.754_877_666), 2.0 + 38.0 * share(0.569_840_291));
        let aside = 0.05 * radius * (2.0 * share(0.419_725_169) - 1.0);
        let (one_kg, two_kg) = (2.0, 2.0 + 60.0 * share(0.317_672_196));
        let gap = 0.3 + 0.37 * share(0.618_033_989);
        let mut model = vacuum(vec![
            ball("one", radius, one_kg, DVec3::new(-gap, 0.0, -10.0)),
            ball("two", 1.3 * radius, two_kg, DVec3::new(gap, aside, -10.0)),
        ]);
        let mut spec = model.spec.clone();
        spec.water.gravity_m_s2 = 0.0;
        model = Model::new(spec).expect("a sound model");
        let mut state = State::start(&model);
        for (body, velocity) in state.bodies.iter_mut().zip([speed, -speed]) {
            body.velocity = DVec3::X * velocity;
            body.earlier_velocity = body.velocity;
            body.earlier_position = body.position - body.velocity * 0.01;
        }
        let momentum =
            |state: &State| state.bodies[0].velocity * one_kg + state.bodies[1].velocity * two_kg;
        let before = momentum(&state);
        run(&model, &mut state, (2.0 * gap / speed).max(0.1));
        let [one, two] = [0, 1].map(|body| state.bodies[body].position);
        assert!(one.x < two.x, "{k}: {speed} m/s, radius {radius}: they have passed");
        let after = momentum(&state);
        let scale = speed * (one_kg + two_kg);
        assert!(after.distance(before) < 1e-6 * scale, "{k}: {before} and {after} N s");
    }
}

/// A buoy stowed in its trap is not driven out of it.
#[test]
fn bodies_that_overlap_as_they_are_placed_stay_where_they_are() {
    let mut model = vacuum(vec![
        trap("trap", DVec3::NEG_Z * 10.0, DQuat::IDENTITY, None),
        ball("buoy", 0.15, 2.0, DVec3::new(0.0, 0.0, -9.72)),
    ]);
    let mut spec = model.spec.clone();
    spec.water.gravity_m_s2 = 0.0;
    model = Model::new(spec).expect("a sound model");
    let mut state = State::start(&model);
    run(&model, &mut state, 1.0);
    assert!(state.bodies.iter().all(|body| body.velocity.length() < 1e-9), "{:?}", state.bodies);
    assert!(!state.pair_grips.is_empty());
}

//! Bodies on skin against known answers: weight, Hertz, Coulomb on a slope, a rolling ball, momentum.
#![allow(clippy::expect_used, reason = "a test fails by panicking, in its helpers too")]

use endline_sim::model::{Body, PlacedShape, Settings, Shape, Whale};
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, step};

use endline_fixtures::gear::weight;
use endline_fixtures::skin::cuboid;
use endline_fixtures::whale::{kinetic, spec, spindle_whale, still, swimming};

const MU: f64 = 0.2;
const GRAVITY: f64 = 9.81;
const HALF: DVec3 = DVec3::new(6.0, 2.0, 0.5);

/// A whale like a crate that stands still, its back tilted by an angle, as it goes.
fn slab(angle: f64) -> Whale {
    Whale {
        orientation: DQuat::from_rotation_y(angle),
        contact_stiffness_n_m2: 4e5,
        ..still(cuboid(HALF))
    }
}

/// A body placed on the slab's back with a gap [m], in a vacuum.
fn on_slab(body: Body, height: f64, angle: f64, settings: Settings) -> Model {
    let turn = DQuat::from_rotation_y(angle);
    let place = turn * DVec3::new(-3.0, 0.3, HALF.z + height);
    let mut spec = spec(slab(angle), 0.0);
    let friction = spec.friction.as_mut().expect("friction");
    friction.coefficients_of_bodies.fill(MU);
    spec.bodies = vec![Body { position_m: place, orientation: turn, ..body }];
    spec.settings = settings;
    Model::new(spec).expect("a sound model")
}

fn ball(radius: f64, mass: f64) -> Body {
    let inertia = 0.4 * mass * radius * radius;
    Body {
        parts: vec![PlacedShape::about_origin(Shape::Sphere(radius))],
        inertia_kg_m2: DVec3::splat(inertia),
        ..weight("ball", mass, DVec3::ZERO, None)
    }
}

fn trap() -> Body {
    Body {
        parts: vec![PlacedShape::about_origin(Shape::Box(DVec3::new(0.5, 0.3, 0.2)))],
        inertia_kg_m2: DVec3::new(0.9, 1.9, 2.3),
        ..weight("trap", 20.0, DVec3::ZERO, None)
    }
}

fn run(model: &Model, seconds: f64) -> (State, Workspace) {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    while state.time_s < seconds - 1e-9 {
        step(model, &Input::default(), &mut state, &mut workspace).expect("a step");
    }
    assert_eq!(workspace.audit.bodies_crossed, 0);
    (state, workspace)
}

/// Depth at which Hertz's law with the engine's stiffening bears a load.
fn depth_under(load_n: f64, radius: f64) -> f64 {
    let push = |depth: f64| {
        16.0 / 9.0
            * 4e5
            * libm::sqrt(radius * depth)
            * depth
            * libm::exp(10.0 * depth / (0.75 * radius))
    };
    let (mut low, mut high) = (0.0, radius);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if push(middle) < load_n { low = middle } else { high = middle }
    }
    low
}

#[test]
fn a_ball_lies_as_deep_as_its_weight_presses_it() {
    let (radius, mass) = (0.15, 40.0);
    let depth = depth_under(mass * GRAVITY, radius);
    let model = on_slab(ball(radius, mass), radius - 0.8 * depth, 0.0, Settings::default());
    let (state, workspace) = run(&model, 4.0);
    let push: f64 = workspace.body_contacts.iter().map(|contact| contact.normal_force_n).sum();
    assert!((push / (mass * GRAVITY) - 1.0).abs() < 1e-3, "{push} N");
    let lies = HALF.z + radius - state.bodies[0].position.z;
    assert!((lies / depth - 1.0).abs() < 1e-3, "{lies} m, {depth} m");
}

/// A staff with a heavy float, laid on skin at its full length and let go: skin bears its weight, and no part goes through.
#[test]
fn a_staff_laid_on_skin_lies_on_it() {
    let (staff_m, float_m, mass) = (0.019, 0.1, 20.0);
    let part = |shape: Shape, height: f64| PlacedShape { shape, middle_m: DVec3::Z * height };
    let flyer = Body {
        parts: vec![
            part(Shape::Spheroid { across_m: float_m, along_m: 0.2 }, 0.0),
            part(Shape::Cylinder { radius_m: staff_m, half_length_m: 0.9 }, 0.1),
            part(Shape::Cylinder { radius_m: 0.05, half_length_m: 0.075 }, -0.7),
        ],
        inertia_kg_m2: DVec3::new(3.0, 3.0, 0.1),
        ..weight("flyer", mass, DVec3::ZERO, None)
    };
    let mut spec = on_slab(flyer, float_m - 1e-3, 0.0, Settings::default()).spec.clone();
    spec.bodies[0].orientation = DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    let model = Model::new(spec).expect("a sound model");
    let (state, workspace) = run(&model, 6.0);
    let push: f64 = workspace.body_contacts.iter().map(|contact| contact.normal_force_n).sum();
    assert!((push / (mass * GRAVITY) - 1.0).abs() < 0.02, "{push} N");
    let body = &state.bodies[0];
    for PlacedShape { shape, middle_m } in &model.spec.bodies[0].parts {
        let (across, along) = (shape.half_m().x, shape.half_m().z);
        for end in [-1.0, 1.0] {
            let at = body.position + body.orientation * (*middle_m + DVec3::Z * (end * along));
            let is_round = matches!(shape, Shape::Spheroid { .. });
            let least = if is_round { -0.01 } else { 0.4 * across };
            assert!(at.z - HALF.z > least, "{shape:?}: {}", at.z - HALF.z);
        }
    }
}

#[test]
fn a_trap_slides_down_a_slope_by_coulombs_law_and_holds_on_a_lesser_one() {
    let settings = || Settings { step_s: 0.01, ..Settings::default() };
    let steep = 25.0_f64.to_radians();
    let model = on_slab(trap(), 0.2 - 1e-4, steep, settings());
    let (early, _) = run(&model, 0.2);
    let (late, _) = run(&model, 1.2);
    let gained = (late.bodies[0].velocity - early.bodies[0].velocity).length();
    let wanted = GRAVITY * (libm::sin(steep) - MU * libm::cos(steep));
    assert!((gained / wanted - 1.0).abs() < 0.01, "{gained} and {wanted} m/s");

    let slight = 9.0_f64.to_radians();
    let model = on_slab(trap(), 0.2 - 1e-4, slight, settings());
    let ([early, _], late) = ([run(&model, 2.0).0, run(&model, 0.1).0], run(&model, 4.0).0);
    let crept = late.bodies[0].position.distance(early.bodies[0].position);
    assert!(crept < 1e-4, "{crept} m");
}

#[test]
fn a_ball_rolls_down_a_slope() {
    let (radius, mass, angle) = (0.15, 12.0, 10.0_f64.to_radians());
    let depth = depth_under(mass * GRAVITY * libm::cos(angle), radius);
    let model = on_slab(ball(radius, mass), radius - depth, angle, Settings::default());
    let (early, _) = run(&model, 0.3);
    let (late, _) = run(&model, 1.5);
    let gained = (late.bodies[0].velocity - early.bodies[0].velocity).length();
    // It rolls about the place where its surface meets the skin, which lies nearer to its middle by the depth.
    let arm = radius - depth;
    let wanted = 1.2 * GRAVITY * libm::sin(angle) / (1.0 + 0.4 * radius * radius / (arm * arm));
    assert!((gained / wanted - 1.0).abs() < 0.01, "{gained} and {wanted} m/s");
    assert!(late.bodies[0].spin.y > 0.9 * gained / radius);
}

/// A kinetic whale swims into a ball at rest, without water: what the one loses the other has.
#[test]
fn whale_and_ball_keep_their_momentum() {
    let mass = 300.0;
    let swimmer = kinetic(4.0, 2000.0, 1.0);
    let mut animal = spindle_whale(swimmer, 2.0, swimming(0.0, [0.0; 3]));
    animal.position_m = DVec3::ZERO;
    animal.skin = std::sync::Arc::new(cuboid(DVec3::new(1.0, 0.8, 0.8)));
    let whole_kg = animal.kinetic.as_ref().expect("kinetic").whole_mass_kg().x;
    let mut spec = spec(animal, 0.0);
    spec.water.gravity_m_s2 = 0.0;
    spec.bodies = vec![Body { position_m: DVec3::new(1.4, 0.11, -0.07), ..ball(0.3, mass) }];
    let model = Model::new(spec).expect("a sound model");
    let (state, workspace) = run(&model, 1.0);
    assert!(workspace.audit.touching_steps > 0);
    let whale = state.whale.as_ref().expect("a whale");
    let ball = state.bodies[0].velocity;
    let before = whole_kg * 2.0;
    let after = whole_kg * whale.speed_m_s + mass * ball.x;
    assert!(ball.x > 2.0, "it is struck off: {ball}");
    assert!((after / before - 1.0).abs() < 1e-3, "{before} {after} N s");
}

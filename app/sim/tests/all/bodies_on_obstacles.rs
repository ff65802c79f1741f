//! Bodies on obstacles: they slide and roll by Newton's and Coulomb's laws, and none goes in.
#![allow(clippy::expect_used, reason = "a test fails by panicking, in its helpers too")]

use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::{Body, Obstacle, PlacedShape, Settings, Shape};
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, step};

use endline_fixtures::gear::{model_with, obstacle, water, weight};

const GRAVITY: f64 = 9.81;
const HALF: DVec3 = DVec3::new(0.5, 0.3, 0.2);

fn trap(place: DVec3, turn: DQuat) -> Body {
    Body {
        parts: vec![PlacedShape::about_origin(Shape::Box(HALF))],
        inertia_kg_m2: DVec3::new(0.9, 1.9, 2.3),
        orientation: turn,
        ..weight("trap", 20.0, place, None)
    }
}

fn ball(radius: f64, place: DVec3) -> Body {
    Body {
        parts: vec![PlacedShape::about_origin(Shape::Sphere(radius))],
        inertia_kg_m2: DVec3::splat(0.4 * 5.0 * radius * radius),
        ..weight("ball", 5.0, place, None)
    }
}

fn of_shape(shape: Shape, place: DVec3, turn: DQuat) -> Body {
    Body { parts: vec![PlacedShape::about_origin(shape)], ..buoy(place, turn) }
}

fn buoy(place: DVec3, turn: DQuat) -> Body {
    Body {
        parts: vec![PlacedShape::about_origin(Shape::Capsule {
            radius_m: 0.1,
            half_length_m: 0.4,
        })],
        inertia_kg_m2: DVec3::new(0.3, 0.3, 0.03),
        orientation: turn,
        ..weight("buoy", 6.0, place, None)
    }
}

fn vacuum(bodies: Vec<Body>, obstacles: Vec<Obstacle>) -> Model {
    let settings = Settings::default();
    model_with(water(0.0, 0.0), Vec::new(), Vec::new(), bodies, settings, obstacles)
}

fn run(model: &Model, state: &mut State, seconds: f64) {
    let mut workspace = Workspace::new(model);
    while state.time_s < seconds - 1e-9 {
        step(model, &Input::default(), state, &mut workspace).expect("a step");
    }
}

/// Speed gained between 0.3 and 1.3 s, and the state at the end of it.
fn gained(model: &Model) -> (f64, State) {
    let mut state = State::start(model);
    run(model, &mut state, 0.3);
    let early = state.bodies[0].velocity;
    run(model, &mut state, 1.3);
    ((state.bodies[0].velocity - early).length(), state)
}

#[test]
fn a_ball_rolls_down_a_plane_without_slip() {
    let (radius, angle) = (0.15, 20.0_f64.to_radians());
    let turn = DQuat::from_rotation_y(angle);
    let plane = obstacle(SolidShape::Plane, DVec3::NEG_Z * 10.0, turn, 0.4);
    let model = vacuum(
        vec![ball(radius, plane.position_m + turn * (DVec3::Z * radius))],
        vec![plane.clone()],
    );
    let (speed, state) = gained(&model);
    let wanted = 5.0 / 7.0 * GRAVITY * libm::sin(angle);
    assert!((speed / wanted - 1.0).abs() < 0.01, "{speed} and {wanted} m/s");
    let now = &state.bodies[0];
    let slip = now.velocity + now.spin.cross(turn * (DVec3::NEG_Z * radius));
    println!("rolls: {:.3} %, slip {:.1e} m/s", 100.0 * (speed / wanted - 1.0), slip.length());
    assert!(slip.length() < 0.01 * now.velocity.length(), "slips at {slip} m/s");
    let height = (turn.inverse() * (now.position - plane.position_m)).z;
    assert!((height - radius).abs() < 1e-3, "{height} m above the plane");
}

#[test]
fn a_box_slides_down_a_plane_by_coulombs_law_and_holds_on_a_lesser_slope() {
    let slope = |degrees: f64, shape: SolidShape| {
        let turn = DQuat::from_rotation_y(degrees.to_radians());
        let top = if shape == SolidShape::Plane { 0.0 } else { 1.0 };
        let under = obstacle(shape, DVec3::NEG_Z * 10.0, turn, 0.3);
        let place = under.position_m + turn * DVec3::new(-4.0, 0.0, HALF.z + top);
        gained(&vacuum(vec![trap(place, turn)], vec![under]))
    };
    let angle = 28.0_f64.to_radians();
    let wanted = GRAVITY * (libm::sin(angle) - 0.3 * libm::cos(angle));
    for shape in [SolidShape::Plane, SolidShape::Box(DVec3::new(9.0, 3.0, 1.0))] {
        let (speed, _) = slope(28.0, shape.clone());
        println!("slides: {:.3} %", 100.0 * (speed / wanted - 1.0));
        assert!((speed / wanted - 1.0).abs() < 0.01, "{shape:?}: {speed} and {wanted} m/s");
        let (speed, state) = slope(14.0, shape);
        assert!(speed < 1e-4 && state.bodies[0].velocity.length() < 1e-4, "{speed} m/s");
    }
}

/// Bodies of each shape fall from some metres on obstacles of each shape, askew: an impact compresses contact by at most 40 mm.
#[test]
fn bodies_that_fall_on_obstacles_stay_out_of_them() {
    let askew = DQuat::from_scaled_axis(DVec3::new(0.2, 0.3, 0.1));
    let upright = DQuat::IDENTITY;
    let lying = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let under = [
        (SolidShape::Plane, upright),
        (SolidShape::Sphere(0.8), upright),
        (SolidShape::Cylinder { radius_m: 0.7, half_length_m: 0.5 }, upright),
        (SolidShape::Cylinder { radius_m: 0.4, half_length_m: 2.0 }, lying),
        (SolidShape::Cylinder { radius_m: 0.15, half_length_m: 0.5 }, upright),
        (SolidShape::Capsule { radius_m: 0.4, half_length_m: 2.0 }, lying),
        (SolidShape::Box(DVec3::new(2.0, 2.0, 0.3)), askew),
        (SolidShape::Box(DVec3::new(0.1, 2.0, 0.1)), askew),
    ];
    for (shape, turn) in under {
        for fallen in 0..5 {
            let over = DVec3::new(0.02, 0.03, -6.5);
            let body = match fallen {
                0 => ball(0.15, over),
                1 => buoy(over, askew),
                3 => of_shape(Shape::Cylinder { radius_m: 0.12, half_length_m: 0.2 }, over, askew),
                4 => of_shape(Shape::Spheroid { across_m: 0.12, along_m: 0.25 }, over, askew),
                _ => trap(over, askew),
            };
            let rock = obstacle(shape.clone(), DVec3::NEG_Z * 10.0, turn, 0.3);
            let model = vacuum(vec![body], vec![rock]);
            let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
            let (mut deepest, mut touched) = (0.0_f64, false);
            while state.time_s < 3.0 {
                step(&model, &Input::default(), &mut state, &mut workspace).expect("a step");
                deepest = deepest.max(depth(&model, &state));
                touched |= !state.pair_grips.is_empty();
            }
            println!("{shape:?}, body {fallen}: {:.1} mm", 1e3 * deepest);
            assert!(touched && deepest < 0.04, "{shape:?}, body {fallen}: {deepest} m");
        }
    }
}

/// How deep places of the body's surface lie in the obstacle [m].
fn depth(model: &Model, state: &State) -> f64 {
    let (body, rock) = (&model.spec.bodies[0], &model.spec.obstacles[0]);
    let now = &state.bodies[0];
    let inward = |place: DVec3| {
        rock.orientation.inverse() * (now.position + now.orientation * place - rock.position_m)
    };
    let inner = |place: DVec3, radius: f64| radius - distance(&rock.shape, inward(place));
    match body.parts[0].shape {
        Shape::Sphere(radius) => inner(DVec3::ZERO, radius),
        Shape::Capsule { radius_m, half_length_m } => (-10..=10)
            .map(|k| inner(DVec3::Z * (half_length_m - radius_m) * f64::from(k) / 10.0, radius_m))
            .fold(f64::MIN, f64::max),
        // A net over the box without its rounding, which lies that far out.
        Shape::Box(half) => (0..11 * 11 * 11)
            .map(|k: i32| DVec3::new(f64::from(k % 11), f64::from(k / 11 % 11), f64::from(k / 121)))
            .map(|net| inner((net / 5.0 - 1.0) * (half - 0.05), 0.05))
            .fold(f64::MIN, f64::max),
        // A net over the surface of a cylinder without its rounding, which is of 0.05 m here.
        Shape::Cylinder { radius_m, half_length_m } => (0..24 * 11 * 2)
            .map(|k: i32| (f64::from(k % 24), f64::from(k / 24 % 11) / 5.0 - 1.0, k / 264))
            .map(|(turn, share, part)| {
                let (radius, half) = (radius_m - 0.05, half_length_m - 0.05);
                let (off, height) =
                    if part == 0 { (radius, half * share) } else { (radius * share, half) };
                let around = DQuat::from_rotation_z(turn * std::f64::consts::TAU / 24.0);
                let side = around * DVec3::new(off, 0.0, height);
                inner(side, 0.05).max(inner(side.with_z(-height), 0.05))
            })
            .fold(f64::MIN, f64::max),
        // A net over the surface itself.
        Shape::Spheroid { across_m, along_m } => (0..24 * 21)
            .map(|k: i32| (f64::from(k % 24), f64::from(k / 24) / 20.0))
            .map(|(turn, share)| {
                let polar = std::f64::consts::PI * share;
                let around = DQuat::from_rotation_z(turn * std::f64::consts::TAU / 24.0);
                let on_ball = around * DVec3::new(libm::sin(polar), 0.0, libm::cos(polar));
                inner(on_ball * DVec3::new(across_m, across_m, along_m), 0.0)
            })
            .fold(f64::MIN, f64::max),
    }
}

/// Signed distance of a place from a shape, written down anew.
fn distance(shape: &SolidShape, place: DVec3) -> f64 {
    let beyond = |excess: DVec3| excess.max(DVec3::ZERO).length() + excess.max_element().min(0.0);
    let across = libm::hypot(place.x, place.y);
    match shape {
        SolidShape::Plane => place.z,
        SolidShape::Sphere(radius) => place.length() - radius,
        SolidShape::Capsule { radius_m, half_length_m } => {
            let straight = half_length_m - radius_m;
            libm::hypot(across, (place.z.abs() - straight).max(0.0)) - radius_m
        }
        SolidShape::Cylinder { radius_m, half_length_m } => {
            let (side, end) = (across - radius_m, place.z.abs() - half_length_m);
            beyond(DVec3::new(side, end, f64::MIN))
        }
        SolidShape::Box(half) => beyond(place.abs() - *half),
        SolidShape::Spheroid { .. } => unreachable!("no such obstacle is drawn here"),
    }
}

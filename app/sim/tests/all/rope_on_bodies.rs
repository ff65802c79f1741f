//! Rope and the bodies that it lies on or in: at rest over a trap, and stowed within one.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use endline_fixtures::gear::{fixed, line, model, water, weight};
use endline_sim::model::{Body, Joint, JointKind, PlacedShape, Seabed, Settings, Shape};
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, settle, step};

const HALF: DVec3 = DVec3::new(0.6, 0.3, 0.2);

fn trap(position_m: DVec3) -> Body {
    let mut trap = weight("trap", 18.0, position_m, None);
    trap.parts = vec![PlacedShape::about_origin(Shape::Box(HALF))];
    trap.inertia_kg_m2 = DVec3::new(0.8, 2.4, 2.7);
    (trap.start_friction, trap.slide_friction) = (0.6, 0.5);
    let corner = |k: usize| {
        let sign = |bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
        HALF * DVec3::new(sign(0), sign(1), sign(2))
    };
    trap.feet_m = (0..8).map(corner).collect();
    trap
}

/// Least distance of the centre line from the trap, and where along x it is nearest [m].
fn clearance(model: &Model, state: &State) -> f64 {
    let body = &state.bodies[0];
    let outside = |place: DVec3| {
        let inward = body.orientation.inverse() * (place - body.position);
        let over = inward.abs() - HALF;
        over.max(DVec3::ZERO).length() + over.max_element().min(0.0)
    };
    let nodes = &state.rope.position[model.line_nodes[0].clone()];
    let along = |ends: &[DVec3]| {
        (0..=10).map(|k| outside(ends[0].lerp(ends[1], f64::from(k) / 10.0))).fold(1.0, f64::min)
    };
    nodes.windows(2).map(along).fold(f64::INFINITY, f64::min)
}

fn run(model: &Model, state: &mut State, until_s: f64) -> Workspace {
    let mut workspace = Workspace::new(model);
    while state.time_s < until_s - 1e-9 {
        step(model, &Input::default(), state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    workspace
}

/// A sinking line that hangs between two points into a trap on the seabed, by itself 8 cm deep.
fn across(rope_on_bodies: bool) -> Model {
    let ends = [DVec3::new(0.1, -3.0, -29.35), DVec3::new(0.1, 3.0, -29.35)];
    let rope = line("rope", 6.05, 66);
    let settings = Settings { rope_on_bodies, ..Settings::default() };
    let joints = ends.map(|end| fixed("end", end)).to_vec();
    let laid = model(water(500.0, 0.0), joints, vec![rope], vec![trap(DVec3::Z * -29.8)], settings);
    let mut spec = laid.spec.clone();
    spec.seabed = Some(Seabed {
        depth_m: 30.0,
        normal: DVec3::Z,
        rope_stiffness_n_m2: 1e4,
        foot_stiffness_n_m: 2e4,
        rope_friction: 0.5,
    });
    Model::new(spec).expect("the model")
}

#[test]
fn rope_laid_across_a_trap_is_at_rest_on_it() {
    let through = settle(&across(false));
    assert!(through.converged && clearance(&across(false), &through.state) < -0.05);
    let model = across(true);
    let settled = settle(&model);
    assert!(settled.converged, "{}", settled.why());
    let clear_m = clearance(&model, &settled.state);
    println!("at rest {:.2} mm from the trap, {} passes", 1e3 * clear_m, settled.trace_n.len());
    assert!(clear_m > 0.0, "the centre line is {clear_m} m from the trap");
    let (mut state, place) = (settled.state.clone(), settled.state.bodies[0].position);
    let nodes = state.rope.position.clone();
    let workspace = run(&model, &mut state, 2.0);
    let moves = nodes.iter().zip(&state.rope.position).map(|(one, two)| one.distance(*two));
    let moved_m = moves.fold(0.0, f64::max);
    println!(
        "in 2 s rope moves {moved_m:.4} m, the trap {:.1e} m",
        place.distance(state.bodies[0].position)
    );
    assert!(workspace.audit.rope_within_m == 0.0 && clearance(&model, &state) > 0.0);
    assert!(place.distance(state.bodies[0].position) < 1e-3 && moved_m < 0.02);
}

/// A sinking line that hangs between two points across the staff of a high-flyer that is held level, by itself some centimetres lower.
#[test]
fn rope_laid_across_a_staff_is_held_by_it() {
    const STAFF_M: f64 = 0.019;
    let ends = [DVec3::new(0.6, -3.0, -29.35), DVec3::new(0.6, 3.0, -29.35)];
    let place = DVec3::Z * -29.6;
    let mut flyer = weight("flyer", 18.0, place, Some(1e3));
    flyer.orientation = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let staff = Shape::Cylinder { radius_m: STAFF_M, half_length_m: 1.8 };
    let float = PlacedShape { shape: Shape::Sphere(0.15), middle_m: DVec3::Z * -0.8 };
    flyer.parts = vec![float, PlacedShape { shape: staff, middle_m: DVec3::Z * 0.2 }];
    flyer.inertia_kg_m2 = DVec3::new(8.0, 8.0, 0.1);
    let laid = |rope_on_bodies: bool| {
        let settings = Settings { rope_on_bodies, ..Settings::default() };
        let joints = ends.map(|end| fixed("end", end)).to_vec();
        let rope = line("rope", 6.05, 66);
        model(water(500.0, 0.0), joints, vec![rope], vec![flyer.clone()], settings)
    };
    // The staff's axis lies along x of the world at the body's place: how high the centre line is over it.
    let over_m = |state: &State| {
        let height = |ends: &[DVec3]| {
            let share = ends[0].y / (ends[0].y - ends[1].y);
            ends[0].lerp(ends[1], share).z - place.z
        };
        let mut over = state.rope.position.windows(2).filter(|ends| ends[0].y * ends[1].y <= 0.0);
        over.next().map_or(f64::NEG_INFINITY, height)
    };
    let through = settle(&laid(false));
    assert!(through.converged && over_m(&through.state) < -STAFF_M, "it hangs lower by itself");
    let model = laid(true);
    let least_m = |state: &State| {
        let off = |place_of: DVec3| libm::hypot(place_of.y, place_of.z - place.z);
        let along = |ends: &[DVec3]| {
            (0..=20).map(|k| off(ends[0].lerp(ends[1], f64::from(k) / 20.0))).fold(1.0, f64::min)
        };
        state.rope.position.windows(2).map(along).fold(1.0, f64::min)
    };
    // From where it is laid, straight and above the staff: statics would take it through what is so thin.
    let mut state = State::start(&model);
    assert!(over_m(&state) > 0.1);
    let workspace = run(&model, &mut state, 8.0);
    println!("after 8 s {} m over the staff's axis, {STAFF_M} m thick", over_m(&state));
    assert!(workspace.audit.rope_within_m == 0.0 && least_m(&state) > STAFF_M);
    assert!(over_m(&state) > STAFF_M && over_m(&state) < 0.05, "{}", over_m(&state));
}

/// Rope stowed in a trap that floats free is drawn out of it, and pushes it no farther than its own friction in water would: not at all
/// in a vacuum. Once out, it touches the trap as any other.
#[test]
fn rope_stowed_within_a_trap_touches_it_once_it_is_out() {
    let (from, to) = (DVec3::new(-0.3, 0.0, 0.0), DVec3::new(0.3, 0.0, 0.0));
    let joints = vec![
        Joint { id: "tail".into(), kind: JointKind::Free, position_m: from },
        Joint {
            id: "hand".into(),
            kind: JointKind::Driven { velocity_m_s: DVec3::X, from_s: 0.0, until_s: 1.5 },
            position_m: to,
        },
    ];
    let mut sea = water(0.0, 0.0);
    sea.gravity_m_s2 = 0.0;
    let settings = Settings { rope_on_bodies: true, as_placed: true, ..Settings::default() };
    let model = model(sea, joints, vec![line("rope", 0.6, 6)], vec![trap(DVec3::ZERO)], settings);
    let mut state = State::start(&model);
    let workspace = run(&model, &mut state, 0.5);
    assert!((workspace.audit.rope_within_m - 0.6).abs() < 1e-9);
    let held_m = state.rope.within.iter().map(|within| within.to_m - within.from_m).sum::<f64>();
    assert!(held_m > 0.3 && held_m < 0.6, "{held_m} m are still within");
    run(&model, &mut state, 1.5);
    assert!(state.rope.within.is_empty());
    assert!(state.bodies[0].velocity.length() < 1e-9, "nothing pushed the trap");
    // Thrown back at the trap, it does not enter it.
    state.rope.velocity.fill(DVec3::X * -2.0);
    let mut back = model.spec.clone();
    back.joints[1].kind = JointKind::Free;
    let back = Model::new(back).expect("the model");
    let end_s = state.time_s + 1.0;
    run(&back, &mut state, end_s);
    println!(
        "thrown back, {:.4} m from the trap at {}",
        clearance(&back, &state),
        state.bodies[0].velocity
    );
    assert!(clearance(&back, &state) > 0.0 && state.bodies[0].velocity.x < -1e-3);
}

//! Rigid bodies against an independent engine: a spinning box in free flight, by Endline and by Rapier.

#![allow(clippy::panic, reason = "a test fails by panicking, in its helpers too")]

use crate::common::{model, water, weight};
use endline_sim::model::Settings;
use endline_sim::{DQuat, DVec3, Input, State, Workspace, step};
use rapier3d::prelude::{MassProperties, PhysicsWorld, RigidBodyBuilder};

const MASS: f64 = 18.0;
const INERTIA: DVec3 = DVec3::new(1.2, 2.4, 2.8);
const SPIN: DVec3 = DVec3::new(0.3, 2.5, 0.2);
const STEP: f64 = 0.001;
const SECONDS: f64 = 2.0;

fn by_endline() -> (DVec3, DQuat) {
    let mut body = weight("box", MASS, DVec3::ZERO, None);
    body.inertia_kg_m2 = INERTIA;
    let model = model(
        water(0.0, 0.0),
        Vec::new(),
        Vec::new(),
        vec![body],
        Settings { step_s: STEP, ..Settings::default() },
    );
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    state.bodies[0].spin = SPIN;
    while state.time_s < SECONDS - 1e-9 {
        step(&model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    (state.bodies[0].position, state.bodies[0].orientation)
}

fn by_rapier() -> (DVec3, DQuat) {
    let mut world = PhysicsWorld::new();
    world.gravity = DVec3::Z * -9.81;
    world.integration_parameters.dt = STEP;
    let properties = MassProperties::new(DVec3::ZERO, MASS, INERTIA);
    let handle = world.insert_body(
        RigidBodyBuilder::dynamic()
            .additional_mass_properties(properties)
            .angvel(SPIN)
            .can_sleep(false),
    );
    for _ in 0..(SECONDS / STEP).round() as usize {
        world.step();
    }
    let body = &world.bodies[handle];
    (body.translation(), *body.rotation())
}

/// Spun about its middle axis the box tumbles; both engines must turn it over alike.
#[test]
fn a_tumbling_box_turns_as_rapier_turns_it() {
    let ((place, turn), (other_place, other_turn)) = (by_endline(), by_rapier());
    let angle = turn.angle_between(other_turn);
    println!("after {SECONDS} s: {:.2e} m and {:.4} rad apart", place.distance(other_place), angle);
    assert!(place.distance(other_place) < 0.02);
    assert!(angle < 0.05, "{angle} rad apart");
}

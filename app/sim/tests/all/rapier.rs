//! Rigid bodies against an independent engine and against Euler's equations: a box that tumbles in free flight.

#![allow(clippy::panic, reason = "a test fails by panicking, in its helpers too")]

use endline_fixtures::gear::{model, water, weight};
use endline_sim::model::Settings;
use endline_sim::{DQuat, DVec3, Input, State, Workspace, step};
use glam::DVec4;
use rapier3d::prelude::{MassProperties, PhysicsWorld, RigidBodyBuilder};

const MASS: f64 = 18.0;
const INERTIA: DVec3 = DVec3::new(1.2, 2.4, 2.8);
const SPIN: DVec3 = DVec3::new(0.3, 2.5, 0.2);
const SECONDS: f64 = 2.0;

fn by_endline(step_s: f64) -> (DVec3, DQuat) {
    let mut body = weight("box", MASS, DVec3::ZERO, None);
    body.inertia_kg_m2 = INERTIA;
    let model = model(
        water(0.0, 0.0),
        Vec::new(),
        Vec::new(),
        vec![body],
        Settings { step_s, ..Settings::default() },
    );
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    state.bodies[0].spin = SPIN;
    while state.time_s < SECONDS - 1e-9 {
        step(&model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    (state.bodies[0].position, state.bodies[0].orientation)
}

/// Orientation by a Runge-Kutta method of fourth order on Euler's equations in the body's frame, `I dω/dt = Iω × ω`, `dq/dt = q ω/2`.
fn by_eulers_equations() -> DQuat {
    type Turning = (DVec4, DVec3);
    let rate = |(q, spin): Turning| -> Turning {
        let by = DQuat::from_vec4(q) * DQuat::from_xyzw(spin.x, spin.y, spin.z, 0.0);
        (DVec4::from(by) * 0.5, (INERTIA * spin).cross(spin) / INERTIA)
    };
    let after =
        |from: Turning, rate: Turning, time: f64| (from.0 + rate.0 * time, from.1 + rate.1 * time);
    let steps = 20_000;
    let h = SECONDS / f64::from(steps);
    let mut at = (DVec4::W, SPIN);
    for _ in 0..steps {
        let a = rate(at);
        let b = rate(after(at, a, 0.5 * h));
        let c = rate(after(at, b, 0.5 * h));
        let d = rate(after(at, c, h));
        for (slope, share) in [(a, 1.0), (b, 2.0), (c, 2.0), (d, 1.0)] {
            at = after(at, slope, share * h / 6.0);
        }
    }
    DQuat::from_vec4(at.0).normalize()
}

fn by_rapier(step_s: f64) -> (DVec3, DQuat) {
    let mut world = PhysicsWorld::new();
    world.gravity = DVec3::Z * -9.81;
    world.integration_parameters.dt = step_s;
    let properties = MassProperties::new(DVec3::ZERO, MASS, INERTIA);
    let handle = world.insert_body(
        RigidBodyBuilder::dynamic()
            .additional_mass_properties(properties)
            .angvel(SPIN)
            .can_sleep(false),
    );
    for _ in 0..(SECONDS / step_s).round() as usize {
        world.step();
    }
    let body = &world.bodies[handle];
    (body.translation(), *body.rotation())
}

/// Spun about its middle axis the box tumbles; both engines must turn it over alike.
#[test]
fn a_tumbling_box_turns_as_rapier_turns_it() {
    let ((place, turn), (other_place, other_turn)) = (by_endline(1e-3), by_rapier(1e-3));
    let angle = turn.angle_between(other_turn);
    println!("after {SECONDS} s: {:.2e} m and {angle:.2e} rad apart", place.distance(other_place));
    assert!(place.distance(other_place) < 0.01);
    assert!(angle < 1e-3, "{angle} rad apart");
    let of_rapier = other_turn.angle_between(by_eulers_equations());
    assert!(of_rapier < 1e-4, "rapier is {of_rapier} rad off");
}

/// The error falls with the square of the step, down from a fifth of a milliradian at the usual one.
#[test]
fn a_tumbling_box_turns_by_eulers_equations_to_second_order() {
    let exact = by_eulers_equations();
    let off = [0.01, 0.005, 1e-3].map(|step_s| by_endline(step_s).1.angle_between(exact));
    println!("off by {off:?} rad at 10, 5 and 1 ms");
    assert!(off[0] < 5e-4 && off[2] < 5e-6, "{off:?} rad");
    let order = libm::log2(off[0] / off[1]);
    assert!((order - 2.0).abs() < 0.2, "order {order}");
}

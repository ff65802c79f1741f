//! The kinetic whale alone in the sea: it coasts as its drag law integrates, and swims as it is asked to.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use std::sync::Arc;

use endline_fixtures::skin::cuboid;
use endline_fixtures::whale::{kinetic, spec, spindle_whale, swimming, swims};
use endline_sdk::{Controls, Posture};
use endline_sim::whale::Kinetic;
use endline_sim::whale::kinetic::Hull;
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, step};

/// Eg 1223: 13.60 m, 32.67 t, 2.93 m.
fn eg_1223() -> Kinetic {
    kinetic(13.6, 32_670.0, 2.93)
}

fn run(model: &Model, controls: Controls, time_s: f64) -> State {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    while state.time_s < time_s - 1e-9 {
        step(model, &Input { controls }, &mut state, &mut workspace).expect("a step");
    }
    state
}

#[test]
fn a_whale_that_stops_fluking_slows_as_the_drag_law_integrates() {
    let kinetic = eg_1223();
    let (factor, mass) = (kinetic.drag.factor(1025.0, 0.0), kinetic.whole_mass_kg().x);
    let model = Model::new(spec(spindle_whale(kinetic, 2.0, swimming(2.0, [0.0; 3])), 1025.0))
        .expect("a sound model");
    // m dU/dt = -c U^1.8: U = (U0^-0.8 + 0.8 c t/m)^-1.25, and the way is its integral, (U0^0.2 - U^0.2) m/0.2c.
    for time_s in [5.0, 60.0, 240.0] {
        let state = run(&model, Controls::default(), time_s);
        let now = state.whale.as_ref().expect("a whale");
        let speed = libm::pow(libm::pow(2.0, -0.8) + 0.8 * factor * time_s / mass, -1.25);
        let way = (libm::pow(2.0, 0.2) - libm::pow(speed, 0.2)) * mass / (0.2 * factor);
        assert!(
            (now.speed_m_s / speed - 1.0).abs() < 1e-9,
            "{time_s} s: {} against {speed} m/s",
            now.speed_m_s
        );
        assert!(
            (now.position.x / way - 1.0).abs() < 1e-6,
            "{time_s} s: {} against {way} m",
            now.position.x
        );
        assert!(now.exertion.thrust_n.abs() < 1e-12);
    }
}

#[test]
fn a_clean_whale_swims_as_it_is_asked_to_and_pays_for_its_drag() {
    let (turn, speed) = (0.05, 1.23);
    let kinetic = eg_1223();
    let model =
        Model::new(spec(spindle_whale(kinetic, speed, swimming(speed, [0.0, 0.0, turn])), 1025.0))
            .expect("a sound model");
    let now = run(&model, swims(), 40.0).whale.expect("a whale");
    assert!(
        (now.speed_m_s - speed).abs() < 1e-9 && (now.turn_rate - DVec3::Z * turn).length() < 1e-12
    );
    // 2 rad round a circle of radius U/ω.
    let circle =
        DVec3::new(libm::sin(40.0 * turn), 1.0 - libm::cos(40.0 * turn), 0.0) * (speed / turn);
    assert!((now.position - circle + DVec3::Z * 12.0).length() < 1e-3, "{}", now.position);
    // 328 N in the table; power input D U / 0.13.
    assert!(
        (now.exertion.drag_n / 328.0 - 1.0).abs() < 0.01
            && (now.exertion.thrust_n / now.exertion.drag_n - 1.0).abs() < 1e-3
    );
    assert!(
        (now.exertion.power_w / (328.0 * 1.23 / 0.13) - 1.0).abs() < 0.02,
        "{} W",
        now.exertion.power_w
    );
}

/// A box as heavy as the water it displaces glides straight up: `m s'' = -ρ g A s` with `s` of its length out, so `u √(L/g)` comes out,
/// and half a period `π √(L/g)` later it is back under at the speed it came with.
#[test]
fn what_is_out_of_the_water_weighs_on_the_whale() {
    let (half, speed) = (DVec3::new(4.0, 1.5, 0.5), 2.0);
    let mut kinetic = kinetic(8.0, 24.0 * 1025.0, 3.0);
    kinetic.hull = Arc::new(Hull::of(&cuboid(half), &Posture::default()));
    (kinetic.drag.wetted_area_m2, kinetic.side_drag_m2) = (0.0, [0.0; 2]);
    (kinetic.added_mass_kg, kinetic.added_inertia_kg_m2) = (DVec3::ZERO, DVec3::ZERO);
    let mut whale = spindle_whale(kinetic, speed, swimming(0.0, [0.0; 3]));
    whale.orientation = DQuat::from_rotation_y(-std::f64::consts::FRAC_PI_2);
    whale.position_m = DVec3::Z * -5.0;
    let mut spec = spec(whale, 1025.0);
    spec.settings.step_s = 0.005;
    let model = Model::new(spec).expect("a sound model");
    let swing_s = std::f64::consts::PI * libm::sqrt(8.0 / 9.81);
    let (mut state, mut workspace, mut highest) =
        (State::start(&model), Workspace::new(&model), f64::NEG_INFINITY);
    while state.time_s < 0.5 + swing_s + 0.2 {
        step(&model, &Input::default(), &mut state, &mut workspace).expect("a step");
        highest = highest.max(state.whale.as_ref().expect("a whale").position.z + 4.0);
    }
    let expected = speed * libm::sqrt(8.0 / 9.81);
    assert!((highest / expected - 1.0).abs() < 0.01, "{highest} against {expected} m out");
    let now = state.whale.as_ref().expect("a whale");
    assert!(
        (now.speed_m_s + speed).abs() < 0.02 && now.position.z < -4.0,
        "{} m/s at {} m",
        now.speed_m_s,
        now.position.z
    );
}

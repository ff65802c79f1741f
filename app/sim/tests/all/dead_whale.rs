//! A dead whale afloat, as a box whose draught, roll and drift are known.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use std::sync::Arc;

use endline_fixtures::skin::cuboid;
use endline_fixtures::whale::{kinetic, spec, spindle_whale, swimming};
use endline_sdk::Posture;
use endline_sim::whale::kinetic::{Dead, Hull};
use endline_sim::{DQuat, DVec3, Input, Model, ModelSpec, State, Workspace, step};

/// Half sides of the box: 8 m long, 3 m wide, 1 m high.
const HALF: DVec3 = DVec3::new(4.0, 1.5, 0.5);
/// Its mass over that of the water it would displace wholly under.
const DENSITY: f64 = 0.6;
const MASS_KG: f64 = DENSITY * 1025.0 * 24.0;
/// Draught, and height of the middle over the water.
const DRAUGHT_M: f64 = DENSITY;
const HEIGHT_M: f64 = 0.5 - DRAUGHT_M;

/// The box at a height and heel, without added mass, and with this drag area.
fn afloat(height_m: f64, heel_rad: f64, drag_area_m2: f64) -> ModelSpec {
    let mut kinetic = kinetic(8.0, MASS_KG, 3.0);
    let skin = cuboid(HALF);
    kinetic.drag.wetted_area_m2 = 0.0;
    kinetic.inertia_kg_m2 = DVec3::new(1.5 * 1.5 + 0.25, 16.25, 18.25) * (MASS_KG / 3.0);
    (kinetic.added_mass_kg, kinetic.added_inertia_kg_m2) = (DVec3::ZERO, DVec3::ZERO);
    kinetic.side_drag_m2 = [drag_area_m2; 2];
    kinetic.turn_drag_m5 = DVec3::splat(drag_area_m2);
    kinetic.hull = Arc::new(Hull::of(&skin, &Posture::default()));
    kinetic.dead = Some(Dead { posture: Posture::default() });
    let mut whale = spindle_whale(kinetic, 0.0, swimming(0.0, [0.0; 3]));
    whale.skin = Arc::new(skin);
    whale.position_m = DVec3::Z * height_m;
    whale.orientation = DQuat::from_rotation_x(heel_rad);
    spec(whale, 1025.0)
}

fn run(model: &Model, time_s: f64, mut look: impl FnMut(f64, DVec3, f64)) {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    while state.time_s < time_s - 1e-9 {
        step(model, &Input::default(), &mut state, &mut workspace).expect("a step");
        let now = state.whale.as_ref().expect("a whale");
        let side = now.orientation * DVec3::Y;
        look(state.time_s, now.position, libm::atan2(side.z, side.y));
    }
}

#[test]
fn it_floats_at_the_draught_of_archimedes_and_rests_there() {
    let model = Model::new(afloat(0.2, 0.5, 20.0)).expect("a sound model");
    let mut last = (DVec3::ZERO, 0.0);
    run(&model, 120.0, |_, place, heel| last = (place, heel));
    assert!((last.0.z - HEIGHT_M).abs() < 0.01, "{} against {HEIGHT_M} m", last.0.z);
    assert!(last.1.abs() < 0.02, "it rights itself: {} rad", last.1);
    let model = Model::new(afloat(HEIGHT_M, 0.0, 0.0)).expect("a sound model");
    run(&model, 20.0, |_, place, heel| {
        assert!(
            (place - DVec3::Z * HEIGHT_M).length() < 1e-6 && heel.abs() < 1e-9,
            "{place} {heel}"
        )
    });
}

/// `T = 2π √(I/(m g GM))`, `GM = KB + b²/(12 d) - KG` for breadth `b` and draught `d`; heave `2π √(d/g)`. Neither dies out without drag.
#[test]
fn it_rolls_and_heaves_at_its_own_periods() {
    let inertia = (1.5 * 1.5 + 0.25) * MASS_KG / 3.0;
    let metacentre = 0.5 * DRAUGHT_M + 9.0 / (12.0 * DRAUGHT_M) - 0.5;
    let roll_s = std::f64::consts::TAU * libm::sqrt(inertia / (MASS_KG * 9.81 * metacentre));
    let heave_s = std::f64::consts::TAU * libm::sqrt(DRAUGHT_M / 9.81);
    for (height, heel, period_s) in [(HEIGHT_M, 0.02, roll_s), (HEIGHT_M + 0.02, 0.0, heave_s)] {
        let model = Model::new(afloat(height, heel, 0.0)).expect("a sound model");
        let (mut last, mut crossings, mut greatest) = (1.0, Vec::new(), 0.0_f64);
        run(&model, 10.3 * period_s, |time, place, angle| {
            let now = if heel > 0.0 { angle } else { place.z - HEIGHT_M };
            if last > 0.0 && now <= 0.0 {
                crossings.push(time);
            }
            if time > 9.0 * period_s {
                greatest = greatest.max(now.abs());
            }
            last = now;
        });
        let found = (crossings[9] - crossings[0]) / 9.0;
        assert!((found / period_s - 1.0).abs() < 5e-3, "{found} against {period_s} s");
        assert!(
            (greatest / 0.02 - 1.0).abs() < 0.02,
            "after nine periods still {greatest} of 0.02"
        );
    }
}

#[test]
fn it_drifts_with_the_current() {
    let mut spec = afloat(HEIGHT_M, 0.0, 20.0);
    spec.water.current = endline_sim::water::Current::uniform(DVec3::Y * 0.4);
    let model = Model::new(spec).expect("a sound model");
    let mut last = DVec3::ZERO;
    run(&model, 30.0, |_, place, _| last = place);
    assert!((last - DVec3::new(0.0, 12.0, HEIGHT_M)).length() < 1e-3, "{last}");
}

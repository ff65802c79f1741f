//! Jaws of the right whale that close on a buoy: they stop with the moment of their muscles, and close after its removal.
#![allow(
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test fails by panicking, in its helpers too"
)]

use crate::fins::bodies::adrift;
use crate::fins::rig::{sea, whale};
use crate::mouth::{LENGTH_M, motion, open, open_mouth};
use endline_gear::whale::{WhaleForm, build_skin};
use endline_sim::geometry::distance::{point_triangle, segment_triangle};
use endline_sim::model::{Body, PlacedShape, Settings, Shape, Whale};
use endline_sim::whale::{JawStrength, Skin};
use endline_sim::{DVec3, Input, Model, ModelSpec, State, Workspace, step};

/// Forces with which jaw and lips close at their ends [N].
const FORCES_N: [f64; 2] = [1600.0, 480.0];

/// The place on the midplane of the open mouth that is farthest from all skin, jaw below and rostrum above, and that distance [m].
fn room(skin: &[[DVec3; 3]]) -> (DVec3, f64) {
    let head: Vec<_> = skin.iter().filter(|corners| corners[0].x > 0.2 * LENGTH_M).collect();
    let grid = (0..20).flat_map(|x| (0..40).map(move |z| (f64::from(x), f64::from(z))));
    let places =
        grid.map(|(x, z)| DVec3::new(0.5 * LENGTH_M - 1.4 - 0.05 * x, 0.0, 0.05 * z - 1.6));
    let away = |place: DVec3| {
        head.iter().map(|corners| point_triangle(place, **corners).0).fold(f64::INFINITY, f64::min)
    };
    // In the water of the mouth, not inside a jaw: lines up and down each enter and leave a jaw.
    let covered = |place: &DVec3| {
        let beside = *place + DVec3::new(0.0031, 0.0127, 0.0);
        let met = |sign: f64| {
            let line = [beside, beside + DVec3::Z * (sign * 3.0)];
            head.iter().filter(|corners| segment_triangle(line, ***corners).distance <= 0.0).count()
        };
        [met(1.0), met(-1.0)].iter().all(|met| *met > 0 && met % 2 == 0)
    };
    let best = places.filter(covered).map(|place| (place, away(place)));
    best.max_by(|one, other| one.1.total_cmp(&other.1)).unwrap()
}

fn ball(radius_m: f64, position_m: DVec3) -> Body {
    let shape = PlacedShape::about_origin(Shape::Sphere(radius_m));
    adrift(vec![shape], 10.0, position_m)
}

fn spec(skin: &Skin, ball: Body, friction: f64) -> ModelSpec {
    let strength = JawStrength::of_forces(skin, FORCES_N);
    let whale = Whale {
        motion: motion(0.0, [0.2, 2.2]),
        position_m: DVec3::NEG_Z * 20.0,
        jaws: Some(strength),
        ..whale(skin.clone(), 0.0, [0.0; 3])
    };
    let mut spec =
        ModelSpec { bodies: vec![ball], ..sea(whale, &[], 0.005, 0.2, Settings::default()) };
    spec.water.gravity_m_s2 = 0.0;
    if let Some(law) = &mut spec.friction {
        law.coefficients_of_bodies.fill(friction);
    }
    spec
}

#[test]
fn jaws_stand_still_on_a_buoy_and_close_once_it_is_gone() {
    let skin = build_skin(&WhaleForm::right_whale(LENGTH_M));
    let (place, room_m) = room(&open_mouth(&skin));
    println!("room for {room_m:.3} m about {place:.2}");
    let strength = JawStrength::of_forces(&skin, FORCES_N);
    println!("{strength:?}");
    for radius_m in [0.07, 0.11, 0.15] {
        assert!(radius_m < room_m, "{radius_m} m fits");
        // Rough enough to stay in place.
        let model = Model::new(spec(&skin, ball(radius_m, place - DVec3::Z * 20.0), 2.0)).unwrap();
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        state.whale.as_mut().unwrap().posture = open();
        let mut swing = [f64::INFINITY, 0.0];
        while state.time_s < 8.0 {
            step(&model, &Input::default(), &mut state, &mut workspace)
                .unwrap_or_else(|stop| panic!("{radius_m} m: {stop:?} {:?}", workspace.audit));
            let whale = state.whale.as_ref().unwrap();
            if state.step % 50 == 0 {
                println!(
                    "{:.2} s jaw {:.4} lips {:.4?} moments {:.0?} ball {:.3} v {:.3}",
                    state.time_s,
                    whale.posture.jaw,
                    whale.posture.lips,
                    whale.mouth_moment_n_m,
                    state.bodies[0].position,
                    state.bodies[0].velocity.length(),
                );
            }
            if state.time_s > 6.0 {
                swing = [swing[0].min(whale.posture.jaw), swing[1].max(whale.posture.jaw)];
            }
        }
        let whale = state.whale.as_ref().unwrap();
        println!("{:?} swing {swing:?}", workspace.audit);
        assert_eq!(workspace.audit.bodies_crossed, 0, "{radius_m} m");
        let bears = whale.mouth_moment_n_m[0] / strength.moment_n_m[0];
        assert!((bears - 1.0).abs() < 0.02, "{radius_m} m: {bears} of what the jaw has");
        assert!(swing[0] > 0.01 && swing[1] - swing[0] < 2e-3, "{radius_m} m: {swing:?} rad");
        // The buoy is removed.
        state.bodies[0].position.x += 5.0;
        for _ in 0..150 {
            step(&model, &Input::default(), &mut state, &mut workspace).unwrap();
        }
        assert!(state.whale.as_ref().unwrap().posture.jaw.abs() < 1e-12, "{radius_m} m");
    }
}

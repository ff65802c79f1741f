//! Rope against the swimming whale: nothing tunnels, forces are finite, friction holds.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use std::sync::Arc;

use endline_gear::whale::{WhaleForm, build_skin};
use endline_sdk::{Controls, FrictionModel, WhaleMotion};
use endline_sim::model::{Body, BodyRole, Float, Friction, Joint, JointKind, Line, Model, ModelSpec, Rope, Seabed, Settings, Shape};
use endline_sim::water::{Current, Water};
use endline_sim::whale::{PilotProgram, Whale};
use endline_sim::{DQuat, DVec3, Input, Workspace, settle, step};

fn rope() -> Rope {
    Rope {
        id: "sink".into(),
        diameter_m: 0.0095,
        mass_kg_m: 0.0536,
        displaced_m3_m: 0.0536 / 1170.0,
        axial_stiffness_n: 6e4,
        axial_damping_n_s: 20.0,
        drag_normal: 1.2,
        drag_tangential: 0.015,
        added_mass_normal: 1.0,
        strength_n: 12_000.0,
    }
}

fn buoy(at: DVec3) -> Body {
    Body {
        id: "buoy".into(),
        role: BodyRole::Buoy,
        shape: Shape::Capsule { radius_m: 0.08, half_length_m: 0.18 },
        mass_kg: 0.6,
        inertia_kg_m2: DVec3::new(0.005, 0.005, 0.002),
        added_mass_kg: DVec3::splat(2.5),
        added_inertia_kg_m2: DVec3::splat(0.01),
        drag_area_m2: DVec3::new(0.04, 0.04, 0.01),
        turn_drag_m5: DVec3::splat(1e-4),
        floats: (0..5).map(|k| Float { offset_m: DVec3::Z * (0.07 * f64::from(k - 2)), volume_m3: 0.001, height_m: 0.07 }).collect(),
        wetted_drag: true,
        feet_m: Vec::new(),
        start_friction: 0.0,
        slide_friction: 0.0,
        position_m: at,
        orientation: DQuat::IDENTITY,
        held_until_s: None,
    }
}

fn trap() -> Body {
    let half = DVec3::new(0.45, 0.26, 0.18);
    let corner = |k: i32| {
        DVec3::new(
            if k & 1 == 0 { half.x } else { -half.x },
            if k & 2 == 0 { half.y } else { -half.y },
            if k & 4 == 0 { half.z } else { -half.z },
        )
    };
    Body {
        id: "trap".into(),
        role: BodyRole::Trap,
        shape: Shape::Box(half),
        mass_kg: 18.0,
        inertia_kg_m2: DVec3::new(1.2, 2.4, 2.8),
        added_mass_kg: DVec3::splat(60.0),
        added_inertia_kg_m2: DVec3::splat(3.0),
        drag_area_m2: DVec3::new(0.2, 0.35, 0.5),
        turn_drag_m5: DVec3::splat(0.01),
        floats: vec![Float { offset_m: DVec3::ZERO, volume_m3: 0.005, height_m: 0.36 }],
        wetted_drag: true,
        feet_m: (0..8).map(corner).collect(),
        start_friction: 0.8,
        slide_friction: 0.6,
        position_m: DVec3::new(0.0, 0.0, -25.0 + half.z),
        orientation: DQuat::IDENTITY,
        held_until_s: None,
    }
}

/// A single endline in 25 m of water with a whale that swims at it.
fn encounter(start: DVec3, segments: usize, step_s: f64) -> Model {
    let skin = Arc::new(build_skin(&WhaleForm::right_whale(13.7)));
    let motion = Arc::new(endline_whale_motions::Swim::new());
    let friction = Arc::new(endline_friction_models::Coulomb::new());
    let defaults =
        |list: &[endline_sdk::Attribute]| list.iter().filter_map(|attribute| attribute.default_value().number()).collect::<Vec<_>>();
    let controls = Controls { speed: 1.0, ..Controls::default() };
    let on =
        |id: &str, body: usize, offset_m: DVec3| Joint { id: id.into(), kind: JointKind::Body { body, offset_m }, position_m: DVec3::ZERO };
    let spec = ModelSpec {
        water: Water {
            density_kg_m3: 1025.0,
            gravity_m_s2: 9.81,
            depth_m: 25.0,
            rope_dries: true,
            current: Current { surface_m_s: DVec3::new(0.0, 0.3, 0.0), exponent: 1.0 / 7.0 },
        },
        seabed: Some(Seabed { depth_m: 25.0, normal: DVec3::Z, rope_stiffness_n_m2: 1e4, foot_stiffness_n_m: 1e5, rope_friction: 0.5 }),
        ropes: vec![rope()],
        joints: vec![on("trap", 0, DVec3::new(0.45, 0.0, 0.0)), on("buoy", 1, DVec3::new(0.0, 0.0, -0.18))],
        lines: vec![Line {
            id: "endline".into(),
            rope: 0,
            from: 0,
            to: 1,
            segments_m: vec![32.0 / segments as f64; segments],
            start_m: Vec::new(),
        }],
        bodies: vec![trap(), buoy(DVec3::new(0.0, 18.0, 0.0))],
        links: Vec::new(),
        gear: Vec::new(),
        whale: Some(Whale {
            skin,
            length_m: 13.7,
            burst_speed_m_s: 4.0,
            position_m: start,
            orientation: DQuat::IDENTITY,
            speed_m_s: 1.2,
            motion_attributes: defaults(&motion.descriptor().attributes),
            motion,
            pilot: PilotProgram { commands: vec![(0.0, controls)] },
            contact_stiffness_n_m2: 2e5,
        }),
        friction: Some(Friction {
            attributes: defaults(&friction.descriptor().attributes),
            model: friction,
            coefficients: vec![[0.2; endline_sdk::Region::ALL.len()]],
        }),
        probes: Vec::new(),
        settings: Settings { step_s, ..Settings::default() },
    };
    Model::new(spec).expect("a sound model")
}

#[test]
fn a_whale_swims_into_an_endline_and_nothing_tunnels() {
    let model = encounter(DVec3::new(-16.0, 9.0, -12.0), 500, 0.01);
    let began = std::time::Instant::now();
    let settled = settle(&model);
    println!(
        "settled {} in {} passes, residual {:.1e}, {:?}",
        settled.converged,
        settled.trace_n.len(),
        settled.residual_n,
        began.elapsed()
    );
    assert!(settled.converged, "{:?}", &settled.trace_n[settled.trace_n.len().saturating_sub(20)..]);
    let mut state = settled.state;
    let mut workspace = Workspace::new(&model);
    let began = std::time::Instant::now();
    let whale = model.spec.whale.as_ref().expect("a whale");
    let mut peak = 0.0_f64;
    for _ in 0..3000 {
        let input = Input { controls: whale.pilot.at(state.time_s) };
        step(&model, &input, &mut state, &mut workspace).unwrap_or_else(|stop| panic!("{stop:?} {:?}", workspace.audit));
        peak = workspace.peak_tension_n.iter().copied().fold(peak, f64::max);
        if state.step.is_multiple_of(200) {
            let position = state.whale.as_ref().expect("a whale").position;
            println!(
                "{:5.1} s whale {:6.2} {:5.2} {:6.2} contacts {:3} peak {:8.1} N {:?} wall {:?}",
                state.time_s,
                position.x,
                position.y,
                position.z,
                workspace.contacts.len(),
                peak,
                workspace.audit,
                began.elapsed()
            );
        }
    }
    assert_eq!(workspace.audit.tunnelled, 0);
    assert!(peak.is_finite());
}

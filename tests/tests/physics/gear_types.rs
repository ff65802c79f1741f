//! Gear that acts, in the water: the on-demand buoy against its equation of motion, the cutter against its own clock.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::model;
use endline_sim::{Input, Model, State, Workspace, settle, step};

/// A shipped scenario at rest.
fn settled(name: &str) -> (Model, State) {
    let model = model(name, &[]);
    let settled = settle(&model);
    assert!(settled.converged, "{name}: {} N", settled.residual_n);
    (model, settled.state)
}

/// Runs to the end and shows every step.
fn run(model: &Model, state: &mut State, mut look: impl FnMut(&State)) {
    let mut workspace = Workspace::new(model);
    while state.time_s < model.spec.settings.duration_s - 1e-9 {
        step(model, &Input::default(), state, &mut workspace).unwrap();
        look(state);
    }
    assert_eq!(workspace.audit.non_finite, 0);
}

fn line(model: &Model, id: &str) -> usize {
    model.spec.lines.iter().position(|line| line.id == id).unwrap()
}

/// Time that a buoy needs from its depth to the surface, paying out rope [s].
///
/// `z' = v` with the forces in balance: `B - w z = ½ρ v² (C_d A + C_t π d z)`, z the rope that hangs below it. Added mass
/// and the rope picked up from rest take less than 1 % of the lift.
fn rise_s(model: &Model, from_m: f64) -> f64 {
    let (water, buoy) =
        (&model.spec.water, model.spec.bodies.iter().find(|body| body.id == "buoy").unwrap());
    let rope = &model.spec.ropes[model.spec.lines[line(model, "endline-1")].rope];
    let volume: f64 = buoy.floats.iter().map(|float| float.volume_m3).sum();
    let lift = (water.density_kg_m3 * volume - buoy.mass_kg) * water.gravity_m_s2;
    let weight = (rope.mass_kg_m - water.density_kg_m3 * rope.displaced_m3_m) * water.gravity_m_s2;
    let speed = |z: f64| {
        let area = buoy.whole_drag_area_m2().z
            + rope.drag_tangential * std::f64::consts::PI * rope.diameter_m * z;
        (2.0 * (lift - weight * z) / (water.density_kg_m3 * area)).sqrt()
    };
    let pieces = 1000;
    let dz = from_m / f64::from(pieces);
    (0..pieces).map(|piece| dz / speed((f64::from(piece) + 0.5) * dz)).sum()
}

#[test]
fn the_on_demand_buoy_comes_up_in_the_time_its_lift_and_drag_give_it() {
    let (model, mut state) = settled("on-demand-release.toml");
    let buoy = model.spec.bodies.iter().position(|body| body.id == "buoy").unwrap();
    let from_m = -state.bodies[buoy].position.z;
    let highest = |state: &State| {
        state.rope.position.iter().map(|place| place.z).fold(f64::NEG_INFINITY, f64::max)
    };
    assert!(highest(&state) < -25.0 + 2.0, "no rope stands in the water before the call");
    let (mut rose_s, mut up_s) = (None, None);
    run(&model, &mut state, |state| {
        let z = state.bodies[buoy].position.z;
        if z > 0.1 - from_m && rose_s.is_none() {
            rose_s = Some(state.time_s);
        }
        if z > -0.1 && up_s.is_none() {
            up_s = Some(state.time_s);
        }
    });
    let rose_s = rose_s.unwrap();
    assert!((20.0..20.5).contains(&rose_s), "released at 20 s, rose at {rose_s} s");
    assert!(model.spec.gear[0].links.iter().all(|link| {
        state.link_parted_s[*link].is_some_and(|time_s| (time_s - 20.0).abs() < 0.011)
    }));
    let (took, expected) = (up_s.unwrap() - 20.0, rise_s(&model, from_m));
    println!("{took:.2} s to the surface, {expected:.2} s by its equation");
    assert!((took / expected - 1.0).abs() < 0.10, "{took} s for {expected} s");
}

/// The cutter parts the line in the step in which the tension has stayed above its own for the time it holds.
#[test]
fn the_cutter_parts_the_line_when_its_time_is_up() {
    let (model, mut state) = settled("time-tension-cutter.toml");
    let (foot, threshold_n, hold_s) =
        (line(&model, "endline-bottom"), 40.0 * 4.448_221_615_260_5, 20.0);
    let (segment, dt_s) = (model.line_segments[foot].start, model.spec.settings.step_s);
    let mut since_s = None;
    run(&model, &mut state, |state| {
        if state.line_parted[foot].is_none() {
            since_s = (state.rope.tension[segment] >= threshold_n)
                .then(|| since_s.unwrap_or(state.time_s));
        }
    });
    let ((cut_s, at), due_s) = (state.line_parted[foot].unwrap(), since_s.unwrap() + hold_s);
    assert!(at < 1.0, "in the first segment from the trap, not {at} m up");
    println!("above {threshold_n:.0} N from {:.2} s, cut at {cut_s:.2} s", due_s - hold_s);
    assert!((cut_s - due_s).abs() <= 1.5 * dt_s, "cut at {cut_s} s, due at {due_s} s");
    assert!(cut_s > 25.0, "the pull begins at 5 s");
    assert_eq!(state.line_parted.iter().flatten().count(), 1);
}

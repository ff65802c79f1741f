//! What rope can press, by balances that are known.

use std::f64::consts::{FRAC_PI_2, PI};

use endline_sdk::Region;
use glam::DVec3;

use super::{model, spec};
use crate::contact::ContactPoint;
use crate::metrics::mouth::inside_of_mouth;
use crate::metrics::press::PressMeter;
use crate::model::Model;
use crate::state::State;
use crate::whale::{Mark, Skin};

/// A contact of segment `segment`, with a normal force.
fn pressed(segment: usize, normal: DVec3, normal_force_n: f64) -> ContactPoint {
    ContactPoint {
        is_knot: false,
        line: 0,
        segment,
        fraction: 0.5,
        triangle: 0,
        barycentric: [1.0, 0.0, 0.0],
        region: Region::ALL[0],
        position: DVec3::ZERO,
        normal,
        distance_m: 0.005,
        length_m: 0.1,
        normal_force_n,
        friction_n: DVec3::ZERO,
        slip_m: DVec3::ZERO,
        dt_s: 0.01,
    }
}

/// Triangle 1 of a skin that is inside the mouth.
const INSIDE: usize = 1;

/// Share beyond what rope can press, of contacts that last.
fn share(model: &Model, state: &State, contacts: &[ContactPoint]) -> f64 {
    let skin = Skin {
        vertices: vec![DVec3::ZERO; 4],
        triangles: vec![[0, 1, 2], [1, 2, 3]],
        regions: vec![Region::Head; 2],
        weights: Vec::new(),
        marks: vec![Mark::Skin, Mark::Mouth, Mark::Mouth, Mark::Mouth],
        bones: Vec::new(),
    };
    let mut meter = PressMeter::new(inside_of_mouth(&skin));
    (0..10).for_each(|_| meter.fold(model, state, contacts, 0.01));
    meter.beyond_share()
}

/// A line of `count` segments under a tension, bent evenly by `turn` about the z axis, straight where that is zero.
fn bent(count: usize, turn: f64, tension_n: f64) -> (Model, State) {
    let model = model(spec(vec![0.1; count]));
    let mut state = State::start(&model);
    let mut place = DVec3::ZERO;
    for node in 0..=count {
        state.rope.position[node] = place;
        let angle = turn * node as f64 / (count - 1) as f64;
        place += 0.1 * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
    }
    state.rope.tension.fill(tension_n);
    (model, state)
}

/// Normal forces `T θ` in all, away from the axis of the bend, on the inner segments.
fn capstan(count: usize, turn: f64, tension_n: f64) -> Vec<ContactPoint> {
    let each = tension_n * turn / (count - 2) as f64;
    let away = |segment: usize| {
        let angle = turn * segment as f64 / (count - 1) as f64 - FRAC_PI_2;
        DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
    };
    (1..count - 1).map(|segment| pressed(segment, away(segment), each)).collect()
}

#[test]
fn rope_drawn_round_a_drum_or_an_edge_presses_what_it_can() {
    for turn in [0.3, PI, 3.0 * PI, 8.0 * PI] {
        let (model, state) = bent(40, turn, 250.0);
        let share = share(&model, &state, &capstan(40, turn, 250.0));
        assert!(share.abs() < 1e-12, "{share} at {turn} rad");
    }
}

#[test]
fn a_load_that_skin_holds_is_no_more_than_its_resultant() {
    // Slack rope that a fluke pushes along: no tension, and all of it one way.
    let (model, state) = bent(20, 0.2, 0.0);
    let contacts: Vec<_> = (3..12).map(|segment| pressed(segment, DVec3::Y, 40.0)).collect();
    assert!(share(&model, &state, &contacts).abs() < 1e-12);
}

#[test]
fn rope_squeezed_from_two_sides_is_pressed_beyond_what_it_can() {
    let (model, state) = bent(20, 0.0, 10.0);
    let contacts =
        [pressed(5, DVec3::Y, 1000.0), pressed(5, -DVec3::Y, 1000.0), pressed(15, DVec3::Z, 15.0)];
    // Of 2,015 N, two stretches of straight rope under 10 N press 20 N each and what their resultants are.
    let expected = (2000.0 - 20.0) / 2015.0;
    assert!((share(&model, &state, &contacts) - expected).abs() < 1e-12);
}

/// A wedge between the lips, or inside the mouth, keeps what rope pressed when it pulled; the same between two other places does not count as
/// held.
#[test]
fn a_mouth_may_press_rope_from_two_sides() {
    let (model, state) = bent(20, 0.0, 10.0);
    let mut contacts =
        [pressed(5, DVec3::Y, 1000.0), pressed(5, -DVec3::Y, 900.0), pressed(15, DVec3::Z, 15.0)];
    let free = share(&model, &state, &contacts);
    assert!((free - (1900.0 - 20.0 - 100.0) / 1915.0).abs() < 1e-12, "{free}");
    contacts[0].region = Region::Lips;
    // 1,800 N cancel; the 100 N left over are the resultant.
    assert!(share(&model, &state, &contacts).abs() < 1e-12);
    contacts[0].region = Region::Head;
    contacts[1].triangle = INSIDE;
    assert!(share(&model, &state, &contacts).abs() < 1e-12);
    contacts[1].triangle = 0;
    // Lips elsewhere on the rope excuse nothing here.
    contacts[2].region = Region::Lips;
    assert!((share(&model, &state, &contacts) - free).abs() < 1e-12);
}

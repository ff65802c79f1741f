//! A knot at a gap: it holds where the gap is narrower than it is, and passes where it is wider.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use endline_fixtures::gear::{coulomb, line, model, obstacle, water};
use endline_fixtures::skin::rigid;
use endline_fixtures::whale::still;
use endline_sdk::Region;
use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::{Joint, JointKind, Settings};
use endline_sim::whale::Skin;
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, step};

/// Width of the gap over the diameter of the knot, and whether the knot holds.
const SIZES: [(f64, f64, bool); 6] = [
    (0.016, 0.020, true),
    (0.016, 0.015, false),
    (0.022, 0.026, true),
    (0.022, 0.020, false),
    (0.030, 0.036, true),
    (0.030, 0.027, false),
];
/// Half the depth of the gap along the rope, and half its breadth across [m].
const HALF_M: f64 = 0.05;

/// Rope along x through a gap at the origin, with a knot 0.2 m before it, drawn on by a force against 5 N.
fn drawn(knot_m: f64, force_n: f64) -> Model {
    let at = |x: f64| DVec3::X * x;
    let pulled = |x: f64, force_n: f64| Joint {
        id: format!("end at {x}"),
        kind: JointKind::Pulled { force_n: at(force_n), from_s: -1.0 },
        position_m: at(x),
    };
    let middle = Joint { id: "knot".into(), kind: JointKind::Free, position_m: at(-0.2) };
    let mut lines = vec![line("before", 1.0, 40), line("behind", 1.6, 64)];
    (lines[0].from, lines[0].to, lines[1].from, lines[1].to) = (0, 1, 1, 2);
    lines[0].knots_m = [0.0, 0.5 * knot_m];
    let mut sea = water(1025.0, 0.0);
    (sea.gravity_m_s2, sea.depth_m) = (0.0, 1000.0);
    let settings =
        Settings { step_s: 0.002, contact_step_s: 0.001, as_placed: true, ..Settings::default() };
    model(sea, vec![pulled(-1.2, -5.0), middle, pulled(1.4, force_n)], lines, Vec::new(), settings)
}

/// How far along x the knot has come, and the push on it.
fn end_of(model: &Model, until_s: f64) -> f64 {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    while state.time_s < until_s - 1e-9 {
        step(model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("at {} s: {stop:?}", state.time_s));
    }
    assert_eq!(workspace.audit.tunnelled, 0);
    state.rope.position[model.line_nodes[1].start].x
}

fn check(what: &str, [gap_m, knot_m]: [f64; 2], holds: bool, (model, until_s): (&Model, f64)) {
    let x = end_of(model, until_s);
    println!("{what} {:.0} mm, knot {:.0} mm: at {x:.3} m", 1e3 * gap_m, 1e3 * knot_m);
    let expected = if holds { -HALF_M - knot_m..0.0 } else { HALF_M..10.0 };
    assert!(expected.contains(&x), "{what} {gap_m} m, knot {knot_m} m: {x} m");
}

#[test]
fn a_knot_holds_at_a_gap_of_two_blocks_that_is_narrower() {
    for (gap_m, knot_m, holds) in SIZES {
        let mut spec = drawn(knot_m, 60.0).spec.clone();
        spec.obstacles = [-1.0, 1.0]
            .map(|side| {
                let shape = SolidShape::Box(DVec3::new(HALF_M, 0.1, 0.1));
                let place = DVec3::Y * (side * (0.1 + 0.5 * gap_m));
                obstacle(shape, place, DQuat::IDENTITY, 0.1)
            })
            .to_vec();
        let model = Model::new(spec).expect("a sound model");
        check("blocks", [gap_m, knot_m], holds, (&model, 1.0));
    }
}

/// Radius of the edges of the lips [m].
const ROUNDED_M: f64 = 0.02;

/// Two lips of skin: blocks with rounded edges towards the gap.
fn lips(gap_m: f64) -> Skin {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for side in [-1.0, 1.0] {
        let corner = |x: f64, from: f64, k: i32| {
            let angle = from + std::f64::consts::FRAC_PI_2 * f64::from(k) / 6.0;
            [x + ROUNDED_M * libm::cos(angle), 0.5 * gap_m + ROUNDED_M * (1.0 + libm::sin(angle))]
        };
        let (left, right) = (ROUNDED_M - HALF_M, HALF_M - ROUNDED_M);
        let mut profile: Vec<[f64; 2]> = (0..=6)
            .map(|k| corner(left, std::f64::consts::PI, k))
            .chain((0..=6).map(|k| corner(right, 1.5 * std::f64::consts::PI, k)))
            .collect();
        profile.extend([[HALF_M, 0.15], [-HALF_M, 0.15]]);
        let (first, count) = (vertices.len() as u32, profile.len() as u32);
        for [x, y] in &profile {
            vertices.extend([-0.3, 0.3].map(|z| DVec3::new(*x, side * y, z)));
        }
        for k in 0..count {
            let (a, b) = (first + 2 * k, first + 2 * ((k + 1) % count));
            triangles.extend([[a, b, a + 1], [b, b + 1, a + 1]]);
        }
        for k in 1..count - 1 {
            let (a, b, c) = (first, first + 2 * k, first + 2 * (k + 1));
            triangles.extend([[a, c, b], [a + 1, b + 1, c + 1]]);
        }
    }
    rigid(vertices, triangles, |_| Region::Body)
}

#[test]
fn a_knot_holds_between_two_lips_that_are_narrower() {
    for (gap_m, knot_m, holds) in SIZES {
        // Lips are soft: what holds a knot by a tenth of its breadth on either side holds some ten newtons.
        let mut spec = drawn(knot_m, 8.0).spec.clone();
        spec.whale = Some(still(lips(gap_m)));
        spec.friction = Some(coulomb(0.1));
        let model = Model::new(spec).expect("a sound model");
        check("lips", [gap_m, knot_m], holds, (&model, 1.5));
    }
}

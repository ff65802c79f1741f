//! The capstan law on a skinned mesh by dynamic contact, and grips that do not creep.
//!
//! A rope lies half a turn over a horizontal drum of skin; a weight hangs on one side, the other side is
//! drawn away. Sliding steadily, the tensions stand as `T₂/T₁ = e^{μπ}`. A drum of 2 cm stands for the edge of a fin.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use endline_fixtures::gear::{self, coulomb, line, on_body, water, weight};
use endline_fixtures::skin::drum;
use endline_fixtures::whale::still;
use endline_sdk::Region;
use endline_sim::model::{Joint, JointKind, Model, ModelSpec, Resolution, Settings};
use endline_sim::{DVec3, Input, State, Workspace, step};

const RADIUS: f64 = 0.3;
const FRICTION: f64 = 0.3;
const HANGING_KG: f64 = 20.0;

/// Segments that begin at 1 cm within `inside` of the middle, so that chords clear an edge, and are equal beyond.
fn finer_inside(whole: f64, segments: usize, inside: f64) -> Vec<f64> {
    let outer = 0.5 * whole - inside;
    let count = (0.5 * segments as f64 * outer / (0.5 * whole)).ceil();
    let fine = (2.0 * inside / 0.01).ceil();
    let beyond = vec![outer / count; count as usize];
    [beyond.clone(), vec![2.0 * inside / fine; fine as usize], beyond].concat()
}

/// The rope over the drum; the free side is drawn down at `speed` from 0.5 s on.
fn capstan(speed: f64, segments: usize) -> Model {
    Model::new(over_drum(RADIUS, Region::Body, speed, segments)).expect("a sound model")
}

fn over_drum(radius: f64, region: Region, speed: f64, segments: usize) -> ModelSpec {
    let (over, tail) = (radius + 0.004, 1.0);
    let whole = 2.0 * tail + std::f64::consts::PI * over;
    let path = |s: f64| {
        if s < tail {
            DVec3::new(-over, 0.0, s - tail)
        } else if s > whole - tail {
            DVec3::new(over, 0.0, whole - tail - s)
        } else {
            let angle = std::f64::consts::PI - (s - tail) / over;
            DVec3::new(over * libm::cos(angle), 0.0, over * libm::sin(angle))
        }
    };
    let mut rope = gear::rope();
    rope.axial_damping_n_s = 200.0;
    let hanging = weight("hanging", HANGING_KG, path(0.0), None);
    let driven =
        JointKind::Driven { velocity_m_s: DVec3::Z * -speed, from_s: 0.5, until_s: f64::INFINITY };
    let mut line = line("rope", whole, segments);
    if radius < RADIUS {
        line.segments_m = finer_inside(whole, segments, 0.06 + 0.5 * std::f64::consts::PI * over);
    }
    let mut along = 0.0;
    line.start_m = line
        .segments_m
        .iter()
        .map(|length| {
            along += length;
            path(along)
        })
        .collect();
    line.start_m.insert(0, path(0.0));
    let joints = vec![
        on_body("hanging", 0),
        Joint { id: "hand".into(), kind: driven, position_m: path(whole) },
    ];
    ModelSpec {
        ropes: vec![rope],
        joints,
        lines: vec![line],
        bodies: vec![hanging],
        whale: Some(still(drum(radius, (5.0 * radius).min(0.5), region, 96))),
        friction: Some(coulomb(FRICTION)),
        settings: Settings { step_s: 0.002, ..Settings::default() },
        ..gear::spec(water(0.0, 0.0))
    }
}

/// Mean of the tensions at both ends and of the weight's height over the last part of a run.
fn run(model: &Model, until_s: f64, from_s: f64) -> ([f64; 2], f64, Workspace) {
    let mut state = State::start(model);
    let mut workspace = Workspace::new(model);
    let (mut sum, mut count) = ([0.0; 2], 0.0);
    let last = model.segment_count - 1;
    while state.time_s < until_s - 1e-9 {
        step(model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        if state.time_s > from_s {
            sum[0] += state.rope.tension[0];
            sum[1] += state.rope.tension[last];
            count += 1.0;
        }
    }
    (sum.map(|total| total / count), state.bodies[0].position.z, workspace)
}

#[test]
fn rope_sliding_over_skin_obeys_the_capstan_law() {
    let model = capstan(0.2, 96);
    let ([slack, taut], _, workspace) = run(&model, 3.5, 1.5);
    let effective = libm::log(taut / slack) / std::f64::consts::PI;
    println!(
        "capstan: {slack:.1} N against {taut:.1} N, effective friction {effective:.4} for {FRICTION}, {:?}",
        workspace.audit
    );
    assert!((effective / FRICTION - 1.0).abs() < 0.02, "effective friction {effective}");
    assert_eq!(workspace.audit.tunnelled, 0);
}

#[test]
fn rope_that_sticks_does_not_creep() {
    // Held still: the weight hangs on friction and the hand, and must not sink.
    let model = capstan(0.0, 96);
    let (_, early, _) = run(&model, 1.0, 0.5);
    let (_, late, _) = run(&model, 4.0, 1.0);
    println!("creep over 3 s: {:.4} mm", 1e3 * (early - late));
    assert!((early - late).abs() < 1e-4, "crept {} m", early - late);
}

/// Mean friction and its ripple, as shares of the plugin's, of rope drawn over an edge of 2 cm radius.
fn over_an_edge(segments: usize, resolution: Option<Resolution>) -> (f64, f64, u64) {
    let mut spec = over_drum(0.02, Region::LeftFlukeTrailing, 0.2, segments);
    spec.settings.resolution = resolution;
    let model = Model::new(spec).expect("a sound model");
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    let (mut readings, last) = (Vec::new(), model.segment_count - 1);
    while state.time_s < 3.0 {
        step(&model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        if state.time_s > 1.0 {
            readings.push(
                libm::log(state.rope.tension[last] / state.rope.tension[0])
                    / (std::f64::consts::PI * FRICTION),
            );
        }
    }
    let mean = readings.iter().sum::<f64>() / readings.len() as f64;
    let spread = readings.iter().map(|reading| (reading - mean) * (reading - mean)).sum::<f64>()
        / readings.len() as f64;
    println!(
        "{segments} segments, {resolution:?}: friction {mean:.3} of it, ripple {:.3}, {:?}",
        spread.sqrt(),
        workspace.audit
    );
    assert_eq!(workspace.audit.tunnelled, 0);
    (mean, spread.sqrt(), workspace.audit.splits)
}

#[test]
fn remeshing_corrects_friction_over_a_thin_edge() {
    let (uniform, uniform_ripple, _) = over_an_edge(60, None);
    let (follows, ripple, splits) =
        over_an_edge(60, Some(Resolution { near_m: 0.05, edge_m: 0.0125, far_m: 0.2 }));
    assert!(splits > 20, "{splits} splits");
    assert!(uniform < 0.96, "the error to be corrected: {uniform}");
    assert!((follows - 1.0).abs() < 0.03, "{follows}");
    assert!(ripple < 0.3 * uniform_ripple, "{ripple} against {uniform_ripple}");
}

//! What a step of free rope with drag costs, by number of nodes: `cargo bench -p endline-sim --bench free_rope`.
//!
//! Throughput is in nodes stepped per second; its inverse is the time of a node and step (docs/lab-notebook.md, Speed).

#![allow(clippy::expect_used, reason = "a benchmark says what it needs")]

use divan::Bencher;
use divan::counter::ItemsCount;
use endline_fixtures::gear::{self, fixed, line, water};
use endline_sim::model::{Joint, Line, Settings};
use endline_sim::{DVec3, Input, Model, State, Workspace, step};

/// Length of a segment, as in the shipped encounter [m].
const SEGMENT_M: f64 = 0.07;
/// Distance of the ends as a share of the rope's length.
const SPAN: f64 = 0.8;
/// Steps before timing, in which the rope begins to swing and scratch memory grows.
const WARM_STEPS: usize = 20;

fn main() {
    divan::main();
}

/// A slack rope between two fixed points, across a current.
fn slack_rope(nodes: usize) -> Model {
    let length_m = SEGMENT_M * (nodes - 1) as f64;
    let ends =
        vec![fixed("near", DVec3::NEG_Z), fixed("far", DVec3::new(0.0, SPAN * length_m, -1.0))];
    gear::model(
        water(1025.0, 0.5),
        ends,
        vec![line("rope", length_m, nodes - 1)],
        Vec::new(),
        Settings::default(),
    )
}

#[divan::bench(args = [100, 500, 2_000, 20_000])]
fn node_step(bencher: Bencher, nodes: usize) {
    time(bencher, &slack_rope(nodes), nodes);
}

/// Eight rigs with this number of nodes each, stepped together: a rig in each lane.
#[divan::bench(args = [100, 500, 2_000])]
fn node_step_of_eight_rigs(bencher: Bencher, nodes: usize) {
    let mut spec = slack_rope(nodes).spec;
    let (joints, rope) = (spec.joints.clone(), spec.lines[0].clone());
    for rig in 1..8 {
        spec.joints.extend(
            joints.iter().map(|joint| Joint { id: format!("{}-{rig}", joint.id), ..joint.clone() }),
        );
        spec.lines.push(Line {
            id: format!("rope-{rig}"),
            from: 2 * rig,
            to: 2 * rig + 1,
            ..rope.clone()
        });
    }
    time(bencher, &Model::new(spec).expect("eight ropes"), 8 * nodes);
}

fn time(bencher: Bencher, model: &Model, nodes: usize) {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    let mut advance =
        || step(model, &Input::default(), &mut state, &mut workspace).expect("a rope that swings");
    (0..WARM_STEPS).for_each(|_| advance());
    bencher.counter(ItemsCount::new(nodes)).bench_local(advance);
}

//! What a step of an encounter costs: `cargo bench -p endline-gear --bench encounter`.
//!
//! Five hundred nodes far from the whale, near it without touch, sliding over it, wound about it, and wound tight with 150
//! segments in touch. Of each: solver steps and Newton passes, CPU time a solver step, how much of it is finding what is near
//! (the same search, distances and sweeps made once more outside the step), and how many seconds of the run a second gives.
//! A name after `--` runs those whose names hold it.

#![allow(clippy::expect_used, clippy::panic, reason = "a benchmark says what it needs")]

#[path = "encounter/detection.rs"]
mod detection;
#[path = "../../tests/tests/linked/mod.rs"]
mod linked;

use cpu_time::ThreadTime;
use detection::Detection;
use endline_sim::{Audit, Input, Model, State, Workspace, settle, step};
use linked::model;

/// A stretch of a scenario's run.
struct Stretch {
    name: &'static str,
    scenario: &'static str,
    /// Pieces of its text, and what takes their place.
    changes: &'static [(&'static str, &'static str)],
    from_s: f64,
    to_s: f64,
}

const STRETCHES: [Stretch; 5] = [
    Stretch { name: "far", scenario: "hello-endline", changes: &[], from_s: 1.0, to_s: 9.0 },
    Stretch { name: "near", scenario: "hello-endline", changes: &[], from_s: 10.5, to_s: 12.0 },
    Stretch { name: "sliding", scenario: "hello-endline", changes: &[], from_s: 15.0, to_s: 33.0 },
    Stretch { name: "wound", scenario: "dead-whale-wraps", changes: &[], from_s: 1.0, to_s: 4.0 },
    Stretch {
        name: "wound-tight",
        scenario: "dead-whale-wraps",
        changes: TIGHT,
        from_s: 1.0,
        to_s: 2.0,
    },
];

/// More turns, laid on taut: more of the rope bears on skin.
const TIGHT: &[(&str, &str)] = &[
    ("turns = 2\n", "turns = 3\n"),
    ("turns = 2.5", "turns = 6"),
    ("pretension = \"20 N\"", "pretension = \"300 N\""),
    ("length = \"38 m\"", "length = \"60 m\""),
];

fn main() {
    let asked: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    println!(
        "stretch      run s   steps  passes  touches  pairs  us a step  detection us  times real time"
    );
    for stretch in STRETCHES.iter().filter(|stretch| {
        asked.is_empty() || asked.iter().any(|word| stretch.name.contains(word.as_str()))
    }) {
        run(stretch);
    }
}

/// What a stretch took.
#[derive(Default)]
struct Taken {
    seconds: f64,
    touches: u64,
    model_steps: u64,
}

fn run(stretch: &Stretch) {
    let model = model(stretch.scenario, stretch.changes);
    let start =
        if model.spec.settings.as_placed { State::start(&model) } else { settle(&model).state };
    let (mut state, mut workspace) = (start, Workspace::new(&model));
    while state.time_s < stretch.from_s - 1e-9 {
        advance(&model, &mut state, &mut workspace);
    }
    let (before, mut taken) = (workspace.audit, Taken::default());
    let mut detection = Detection::of(&model);
    while state.time_s < stretch.to_s - 1e-9 {
        let earlier = state.clone();
        let start = ThreadTime::now();
        advance(&model, &mut state, &mut workspace);
        taken.seconds += start.elapsed().as_secs_f64();
        taken.touches += workspace.contacts.len() as u64;
        taken.model_steps += 1;
        detection.measure(&model, &earlier, &state);
    }
    tell(stretch, (&before, &workspace.audit), &taken, &detection);
}

fn advance(model: &Model, state: &mut State, workspace: &mut Workspace) {
    let pilot = model.spec.whale.as_ref().map(|whale| whale.pilot.at(state)).unwrap_or_default();
    step(model, &Input { controls: pilot }, state, workspace)
        .unwrap_or_else(|stop| panic!("{stop:?}"));
}

fn tell(
    stretch: &Stretch,
    (before, after): (&Audit, &Audit),
    taken: &Taken,
    detection: &Detection,
) {
    let steps = (after.solver_steps - before.solver_steps) as f64;
    let passes = (after.passes - before.passes) as f64 / steps;
    let [touches, pairs] =
        [taken.touches, detection.pairs].map(|count| count as f64 / taken.model_steps as f64);
    println!(
        "{:<12} {:5.1} {:7} {:7.1} {:8.0} {:6.0} {:10.1} {:13.1} {:16.1}",
        stretch.name,
        stretch.to_s - stretch.from_s,
        steps,
        passes,
        touches,
        pairs,
        1e6 * taken.seconds / steps,
        1e6 * detection.seconds / detection.steps as f64,
        (stretch.to_s - stretch.from_s) / taken.seconds
    );
    let [tunnelled, unconverged, halved] = [
        after.tunnelled - before.tunnelled,
        after.unconverged - before.unconverged,
        after.halved - before.halved,
    ];
    println!(
        "             {tunnelled} crossed, {unconverged} not converged, {halved} redone shorter"
    );
}

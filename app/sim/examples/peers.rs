//! Endline's row of the peers' table: `cargo run --release -p endline-sim --example peers -- CASE SEGMENTS STEP_S…`.
//!
//! `CASE` is `a` (a pendulum of rope with axial waves, 10 s) or `c2` (slack to taut, 1.5 s) of the reference problems;
//! `tests/peers/table.py` runs this beside MoorDyn and divides. A line for each step: times real time on one core (the
//! fastest of several runs), root mean square of the place of end and middle [cm], of the tension at the pin [%], and
//! the error of the greatest sampled tension [%].

#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    clippy::disallowed_methods,
    reason = "a program for the terminal that reads its reference"
)]

use cpu_time::ThreadTime;
use endline_fixtures::gear::{fixed, line, model, on_body, water, weight};
use endline_sim::model::{Joint, JointKind, Settings};
use endline_sim::{DVec3, Input, Model, State, Workspace, settle, step};

/// Runs of which the fastest counts.
const RUNS: usize = 5;

/// A problem: its model and the reference, rows of time, end x, end z, middle x, middle z, tension at the pin.
struct Case {
    model: Model,
    reference: Vec<Vec<f64>>,
}

fn main() {
    let mut words = std::env::args().skip(1);
    let name = words.next().expect("a case: a or c2");
    let segments: usize =
        words.next().and_then(|word| word.parse().ok()).expect("a number of segments");
    for step_s in words.map(|word| word.parse().expect("a step in seconds")) {
        let case = case(&name, segments, step_s);
        let settled = settle(&case.model);
        assert!(settled.converged, "the start is at rest");
        let runs = (0..RUNS).map(|_| run(&case, settled.state.clone()));
        let (seconds, rows) = runs.min_by(|one, other| one.0.total_cmp(&other.0)).expect("a run");
        let simulated = case.reference.last().expect("a row")[0];
        let (place, tension, peak) = errors(&rows, &case.reference);
        println!(
            "{name} {segments} {step_s} {:.3} {place:.4} {tension:.4} {peak:.4}",
            simulated / seconds
        );
    }
}

fn case(name: &str, segments: usize, step_s: f64) -> Case {
    let settings = Settings { step_s, ..Settings::default() };
    let rope = vec![line("rope", 60.0, segments)];
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/peers/data");
    let text = std::fs::read_to_string(format!("{folder}/ref_{name}.txt"))
        .expect("the reference of a case a or c2");
    let numbers =
        |row: &str| row.split_whitespace().map(|word| word.parse().expect("a number")).collect();
    let reference = text.lines().map(numbers).collect();
    let vacuum = water(0.0, 0.0);
    let model = if name == "a" {
        let end = DVec3::new(30.04414861, 0.0, -52.03799186);
        model(
            vacuum,
            vec![fixed("pin", DVec3::ZERO), on_body("weight", 0)],
            rope,
            vec![weight("weight", 20.0, end, Some(0.0))],
            settings,
        )
    } else {
        let driven = JointKind::Driven { velocity_m_s: DVec3::X * 2.0, from_s: 0.0, until_s: 1.0 };
        let hand = Joint { id: "hand".into(), kind: driven, position_m: DVec3::X * 59.0 };
        model(vacuum, vec![fixed("pin", DVec3::ZERO), hand], rope, Vec::new(), settings)
    };
    Case { model, reference }
}

/// Seconds of the processor the run took and its samples.
fn run(case: &Case, mut state: State) -> (f64, Vec<[f64; 5]>) {
    let (model, mut workspace) = (&case.model, Workspace::new(&case.model));
    let (begin, mut rows) = (ThreadTime::now(), Vec::with_capacity(case.reference.len()));
    for row in &case.reference {
        while state.time_s < row[0] - 1e-9 {
            step(model, &Input::default(), &mut state, &mut workspace).expect("a step");
        }
        let nodes = &state.rope.position;
        let (end, middle) = (nodes[nodes.len() - 1], nodes[nodes.len() / 2]);
        rows.push([end.x, end.z, middle.x, middle.z, state.rope.tension[0]]);
    }
    (begin.elapsed().as_secs_f64(), rows)
}

/// Errors of place [cm], tension and peak [%].
fn errors(rows: &[[f64; 5]], reference: &[Vec<f64>]) -> (f64, f64, f64) {
    let (mut place, mut tension, mut size) = (0.0, 0.0, 0.0);
    for (got, expected) in rows.iter().zip(reference) {
        let off = |k: usize| (got[k] - expected[k + 1]).powi(2);
        place += off(0) + off(1) + off(2) + off(3);
        tension += off(4);
        size += expected[5].powi(2);
    }
    let greatest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::MIN, f64::max);
    let peak = greatest(&mut rows.iter().map(|row| row[4]))
        / greatest(&mut reference.iter().map(|row| row[5]));
    (
        100.0 * (place / (2.0 * rows.len() as f64)).sqrt(),
        100.0 * (tension / size).sqrt(),
        100.0 * (peak - 1.0),
    )
}

//! Cost of a step of an encounter: `cargo bench -p endline-gear --bench encounter`.
//!
//! Five hundred nodes: far from the whale, near it without contact, sliding over it on uniform segments and on fine ones near the whale,
//! wound about it, and wound tight with 150 segments in contact. Of each: solver steps and Newton passes, CPU time a solver step, its share for the search of near pairs
//! (search, distances and sweeps repeated outside the step), and seconds of the run per second.
//! A name after `--` selects the sections with that name; `contact_step=0.5` sets the contact step in milliseconds, `tolerance=0.01` the contact
//! tolerance, `from=17 to=18` the section of the run, `scenario=PATH` runs that scenario instead; `detection=0` omits that measurement. Also of each section: peak tension, mean and ripple of the tension at the top of the first line, work against friction, mean speed of slip by push.
//! Ripple is the mean deviation from a running mean over 0.25 s, as a share of the whole mean.

#![allow(clippy::expect_used, clippy::panic, reason = "a benchmark says what it needs")]

#[path = "encounter/detection.rs"]
mod detection;
#[path = "../../tests/tests/linked/mod.rs"]
mod linked;

use cpu_time::ThreadTime;
use detection::Detection;
use endline_sim::{Audit, Input, Model, State, Workspace, settle, step};
use linked::{built, spec};

/// Steps of the model in the running mean of a tension.
const RIPPLE_STEPS: usize = 25;

/// A section of a scenario's run.
struct Stretch<'a> {
    name: &'static str,
    scenario: &'a str,
    /// Replacements in its text.
    changes: &'static [(&'static str, &'static str)],
    from_s: f64,
    to_s: f64,
}

const STRETCHES: [Stretch<'_>; 6] = [
    Stretch { name: "far", scenario: "hello-endline", changes: &[NODES], from_s: 1.0, to_s: 9.0 },
    Stretch {
        name: "near",
        scenario: "hello-endline",
        changes: &[NODES],
        from_s: 10.5,
        to_s: 12.0,
    },
    Stretch {
        name: "sliding",
        scenario: "hello-endline",
        changes: UNIFORM,
        from_s: 15.0,
        to_s: 33.0,
    },
    Stretch {
        name: "fine",
        scenario: "hello-endline",
        changes: &[NODES],
        from_s: 15.0,
        to_s: 33.0,
    },
    Stretch { name: "wound", scenario: "dead-whale-wraps", changes: &[], from_s: 1.0, to_s: 4.0 },
    Stretch {
        name: "wound-tight",
        scenario: "dead-whale-wraps",
        changes: TIGHT,
        from_s: 1.0,
        to_s: 2.0,
    },
];

/// Half of the nodes of the shipped scenario.
const NODES: (&str, &str) = ("rope_nodes = 1000", "rope_nodes = 500");

/// Segments of constant length.
const UNIFORM: &[(&str, &str)] =
    &[NODES, ("[resolution]\nnear = \"5 cm\"\nedges = \"1.25 cm\"\n", "")];

/// More turns, laid taut: more of the rope presses on skin.
const TIGHT: &[(&str, &str)] = &[
    ("turns = 2\n", "turns = 3\n"),
    ("turns = 2.5", "turns = 6"),
    ("pretension = \"20 N\"", "pretension = \"300 N\""),
    ("length = \"38 m\"", "length = \"60 m\""),
];

/// Settings of the command line for every section.
#[derive(Default)]
struct Changes {
    contact_step_s: Option<f64>,
    tolerance: Option<f64>,
    from_s: Option<f64>,
    to_s: Option<f64>,
    /// Whether detection is measured too.
    detects: bool,
}

fn main() {
    let (set, asked): (Vec<String>, Vec<String>) = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with('-'))
        .partition(|word| word.contains('='));
    let word = |key: &str| set.iter().find_map(|word| word.strip_prefix(key)?.strip_prefix('='));
    let value = |key: &str| Some(word(key)?.parse::<f64>().expect("a number after ="));
    let changes = Changes {
        contact_step_s: value("contact_step").map(|ms| 1e-3 * ms),
        tolerance: value("tolerance"),
        from_s: value("from"),
        to_s: value("to"),
        detects: value("detection") != Some(0.0),
    };
    let own = word("scenario").map(|scenario| Stretch {
        name: "own",
        scenario,
        changes: &[],
        from_s: 0.0,
        to_s: 25.0,
    });
    println!(
        "stretch      run s   steps  passes  touches  pairs  us a step  detection us  times real time"
    );
    let is_asked = |stretch: &&Stretch<'_>| {
        asked.is_empty() || asked.iter().any(|word| stretch.name.contains(word.as_str()))
    };
    if let Some(own) = own {
        run(&own, &changes);
    } else {
        STRETCHES.iter().filter(is_asked).for_each(|stretch| run(stretch, &changes));
    }
}

/// Costs of a section.
#[derive(Default)]
struct Taken {
    seconds: f64,
    touches: u64,
    model_steps: u64,
    peak_n: f64,
    top_n: Vec<f64>,
    friction_j: f64,
    /// Slip speed of each contact at the end of each step times its normal force [N m/s], and the normal forces [N].
    slip: [f64; 2],
}

fn run(stretch: &Stretch<'_>, changes: &Changes) {
    let mut spec = spec(stretch.scenario, stretch.changes);
    let settings = &mut spec.settings;
    settings.contact_step_s = changes.contact_step_s.unwrap_or(settings.contact_step_s);
    settings.contact_tolerance = changes.tolerance.unwrap_or(settings.contact_tolerance);
    let model = built(spec);
    let stretch = &Stretch {
        from_s: changes.from_s.unwrap_or(stretch.from_s),
        to_s: changes.to_s.unwrap_or(stretch.to_s),
        ..*stretch
    };
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
        taken.peak_n = workspace.peak_tension_n.iter().copied().fold(taken.peak_n, f64::max);
        taken.top_n.push(state.rope.tension[model.line_segments[0].end - 1].max(0.0));
        taken.friction_j += workspace.sums.friction_work_j();
        for contact in workspace.contacts.iter().filter(|contact| contact.dt_s > 0.0) {
            taken.slip[0] += contact.normal_force_n * contact.slip_m.length() / contact.dt_s;
            taken.slip[1] += contact.normal_force_n;
        }
        if changes.detects {
            detection.measure(&model, &earlier, &state);
        }
    }
    print_costs(stretch, (&before, &workspace.audit), &taken, &detection);
}

fn advance(model: &Model, state: &mut State, workspace: &mut Workspace) {
    let pilot = model.spec.whale.as_ref().map(|whale| whale.pilot.at(state)).unwrap_or_default();
    step(model, &Input { controls: pilot }, state, workspace)
        .unwrap_or_else(|stop| panic!("{stop:?}"));
}

fn print_costs(
    stretch: &Stretch<'_>,
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
        1e6 * detection.seconds / detection.steps.max(1) as f64,
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
    let (mean_n, ripple) = ripple(&taken.top_n);
    println!(
        "             peak {:.2} N, top {mean_n:.2} N, ripple {:.2} %, friction {:.4} J, slip {:.4} m/s",
        taken.peak_n,
        100.0 * ripple,
        taken.friction_j,
        taken.slip[0] / taken.slip[1].max(1e-9)
    );
}

/// Mean of tensions at the model's steps, and their mean deviation from a running mean as a share of it.
fn ripple(tension_n: &[f64]) -> (f64, f64) {
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len().max(1) as f64;
    let around = |at: usize| {
        let span = at.saturating_sub(RIPPLE_STEPS / 2)..(at + RIPPLE_STEPS / 2 + 1);
        mean(&tension_n[span.start..span.end.min(tension_n.len())])
    };
    let departures: Vec<f64> =
        tension_n.iter().enumerate().map(|(at, tension)| (tension - around(at)).abs()).collect();
    (mean(tension_n), mean(&departures) / mean(tension_n).max(1e-9))
}

//! Cost of a step of an encounter: `cargo bench -p endline-gear --bench encounter`.
//!
//! The sections are in `encounter/sections.rs`. Of each: solver steps and Newton passes, CPU time a solver step, its share for the search of near pairs
//! (search, distances and sweeps repeated outside the step), and seconds of the run per second.
//! A name after `--` selects the sections with that name; `contact_step=0.5` sets the contact step in milliseconds, `tolerance=0.01` the contact
//! tolerance, `from=17 to=18` the section of the run, `scenario=PATH` runs that scenario instead; `detection=0` omits that measurement; `sections=all` prints the names alone, `count=NAME` runs one section for [`count`]. Also of each section: peak tension, mean and ripple of the tension at the top of the first line, work against friction, mean speed of slip by push.
//! Ripple is the mean deviation from a running mean over 0.25 s, as a share of the whole mean.

#![allow(clippy::expect_used, clippy::panic, reason = "a benchmark says what it needs")]

#[path = "encounter/count.rs"]
mod count;
#[path = "encounter/detection.rs"]
mod detection;
#[path = "../../tests/tests/linked/mod.rs"]
mod linked;
#[path = "encounter/sections.rs"]
mod sections;

use cpu_time::ThreadTime;
use detection::Detection;
use endline_sim::{Audit, Input, Model, State, Workspace, settle, step};
use linked::{built, spec};
use sections::{SECTIONS, Section};

/// Steps of the model in the running mean of a tension.
const RIPPLE_STEPS: usize = 25;

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
    let own = word("scenario").map(|scenario| Section {
        name: "own",
        scenario,
        changes: &[],
        time_s: [0.0, 25.0],
        counted_s: 0.0,
    });
    if let Some(name) = word("count") {
        let section = SECTIONS.iter().find(|section| section.name == name);
        return count(section.unwrap_or_else(|| panic!("no section {name}")));
    }
    if word("sections").is_some() {
        return SECTIONS.iter().for_each(|section| println!("{}", section.name));
    }
    println!(
        "section      run s   steps  passes  touches  pairs  us a step  detection us  times real time"
    );
    let is_asked = |section: &&Section<'_>| {
        asked.is_empty() || asked.iter().any(|word| section.name.contains(word.as_str()))
    };
    if let Some(own) = own {
        run(&own, &changes);
    } else {
        SECTIONS.iter().filter(is_asked).for_each(|section| run(section, &changes));
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

fn run(section: &Section<'_>, changes: &Changes) {
    let mut spec = spec(section.scenario, section.changes);
    let settings = &mut spec.settings;
    settings.contact_step_s = changes.contact_step_s.unwrap_or(settings.contact_step_s);
    settings.contact_tolerance = changes.tolerance.unwrap_or(settings.contact_tolerance);
    let model = built(spec);
    let [from_s, to_s] = section.time_s;
    let [from_s, to_s] = [changes.from_s.unwrap_or(from_s), changes.to_s.unwrap_or(to_s)];
    let section = &Section { time_s: [from_s, to_s], ..*section };
    let (mut state, mut workspace) = brought_to(&model, from_s);
    let (before, mut taken) = (workspace.audit, Taken::default());
    let mut detection = Detection::of(&model);
    while state.time_s < to_s - 1e-9 {
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
    print_costs(section, (&before, &workspace.audit), &taken, &detection);
}

/// The run of a model up to a time [s].
fn brought_to(model: &Model, from_s: f64) -> (State, Workspace) {
    let start =
        if model.spec.settings.as_placed { State::start(model) } else { settle(model).state };
    let (mut state, mut workspace) = (start, Workspace::new(model));
    while state.time_s < from_s - 1e-9 {
        advance(model, &mut state, &mut workspace);
    }
    (state, workspace)
}

/// Runs the first part of a section with its instructions counted; prints its simulated time.
fn count(section: &Section<'_>) {
    let model = built(spec(section.scenario, section.changes));
    let from_s = section.time_s[0];
    let (mut state, mut workspace) = brought_to(&model, from_s);
    count::counted(|| {
        while state.time_s < from_s + section.counted_s - 1e-9 {
            advance(&model, &mut state, &mut workspace);
        }
    });
    println!("{} {:.6}", section.name, state.time_s - from_s);
}

fn advance(model: &Model, state: &mut State, workspace: &mut Workspace) {
    let pilot = model.spec.whale.as_ref().map(|whale| whale.pilot.at(state)).unwrap_or_default();
    step(model, &Input { controls: pilot }, state, workspace)
        .unwrap_or_else(|stop| panic!("{stop:?}"));
}

fn print_costs(
    section: &Section<'_>,
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
        section.name,
        section.time_s[1] - section.time_s[0],
        steps,
        passes,
        touches,
        pairs,
        1e6 * taken.seconds / steps,
        1e6 * detection.seconds / detection.steps.max(1) as f64,
        (section.time_s[1] - section.time_s[0]) / taken.seconds
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

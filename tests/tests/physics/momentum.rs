//! The balance of momentum of bundled scenarios: the change of the gear's momentum equals the impulse of all sources.
//!
//! With ENDLINE_LONG set they run as long as the table of docs/lab-notebook.md says.

use endline_sim::balance::{BalanceSummary, Source};
use endline_sim::{Input, Model, State, Workspace, settle, step};

use crate::linked::{built, spec};

/// Greatest residual, as a share of the greatest impulse.
const MOST_SHARE: f64 = 1e-3;

/// A scenario with replacements in its text, by which contact begins sooner.
struct Case {
    name: &'static str,
    changes: &'static [(&'static str, &'static str)],
    seconds: f64,
    long_s: f64,
}

const fn case(name: &'static str, seconds: f64, long_s: f64) -> Case {
    Case { name, changes: &[], seconds, long_s }
}

const CASES: [Case; 8] = [
    Case {
        changes: &[("[\"11.4 m\", \"-22 m\"]", "[\"13.9 m\", \"-7 m\"]")],
        ..case("hello-endline", 4.0, 30.0)
    },
    case("buoy-jams", 30.0, 30.0),
    case("case-e25-05-roll", 12.0, 17.0),
    case("trawl-10", 2.0, 20.0),
    case("on-demand-release", 2.0, 40.0),
    // A trap that is jerked round takes drag across other axes within a step: 0.95 N s are missed in the first two seconds.
    case("towing-trap", 6.0, 30.0),
    case("hitches", 0.1, 1.0),
    case("dead-whale-wraps", 1.0, 1.0),
];

/// A scenario's model, with or without the balance.
fn model(case: &Case, balance: bool) -> Model {
    let mut spec = spec(case.name, case.changes);
    spec.settings.balance = balance;
    spec.settings.holds_still = false; // the balance is that of solver steps
    built(spec)
}

/// Steps of a scenario's model for some seconds, from its gear at rest or as placed.
pub(crate) fn run(model: &Model, seconds: f64) -> (State, Workspace) {
    let settings = &model.spec.settings;
    let mut state = if settings.as_placed { State::start(model) } else { settle(model).state };
    let mut workspace = Workspace::new(model);
    for _ in 0..(seconds / settings.step_s).round() as u64 {
        let pilot = model.spec.whale.as_ref().map(|whale| &whale.pilot);
        let controls = pilot.map(|pilot| pilot.at(&state)).unwrap_or_default();
        if let Err(stop) = step(model, &Input { controls }, &mut state, &mut workspace) {
            panic!("{stop:?}");
        }
    }
    (state, workspace)
}

fn summary_of(case: &Case, seconds: f64) -> BalanceSummary {
    let model = model(case, true);
    let (state, workspace) = run(&model, seconds);
    let summary = workspace.balance.summary(&model, &state).unwrap();
    println!("{} {seconds} s: {:.2e}", case.name, summary.residual_share());
    for source in Source::ALL {
        let (impulse, work) =
            (summary.impulse_ns[source as usize], summary.work_j[source as usize]);
        println!("  {:9} {impulse:.2} N s  {work:.2} J", source.name());
    }
    println!(
        "  momentum {:.2} residual {:.2e} N s; kinetic {:.2} elastic {:.2} damping {:.2} contact {:.2} numerical {:.2} J; whale {:?}",
        summary.momentum_ns,
        summary.residual_ns,
        summary.kinetic_j,
        summary.elastic_j,
        summary.damping_j,
        summary.contact_j,
        summary.numerical_damping_j(),
        summary.whale_missed_ns
    );
    summary
}

#[test]
fn momentum_of_bundled_scenarios_is_balanced() {
    let long = std::env::var_os("ENDLINE_LONG").is_some();
    for case in &CASES {
        let share =
            summary_of(case, if long { case.long_s } else { case.seconds }).residual_share();
        assert!(share < MOST_SHARE, "{}: {share}", case.name);
    }
}

/// No bit of a state depends on whether the balance is kept.
#[test]
fn states_are_the_same_with_and_without_the_balance() {
    let case = &CASES[0];
    let [one, other] = [false, true].map(|balance| run(&model(case, balance), 2.0).0);
    assert_eq!(one, other);
}

//! The scenarios, each with what it must show, and how they are run.

use endline_sdk::BodyPart;
use endline_session::hash::StateHash;
use endline_sim::metrics::{Metrics, Summary};
use endline_sim::{Audit, Input, Model, State, Workspace, settle, step};

use crate::linked::model;
use crate::table::Row;

/// States of a run that the table holds, besides the one it starts from.
const CHECKPOINTS: u64 = 10;

/// A bundled scenario, shortened.
pub struct Case {
    /// Its name in the table.
    pub name: &'static str,
    /// The scenario, without `.toml`.
    pub scenario: &'static str,
    /// Replacements in its text, by which the event occurs sooner.
    pub changes: &'static [(&'static str, &'static str)],
    /// How long it is run [s].
    pub seconds: f64,
    /// Asserts that the run was of its kind.
    pub shows: fn(&Shown),
}

/// What a run came to.
pub struct Shown {
    pub model: Model,
    pub start: State,
    pub state: State,
    pub summary: Summary,
    pub audit: Audit,
}

pub const CASES: [Case; 8] = [
    Case {
        name: "free",
        scenario: "reference-b-settling",
        changes: &[],
        seconds: 10.0,
        shows: |shown| {
            assert!(shown.model.spec.whale.is_none() && shown.audit.rope_steps == 0);
            let moved = shown.start.bodies[0].position.distance(shown.state.bodies[0].position);
            assert!(moved > 0.1, "the buoy moved by {moved} m");
        },
    },
    Case {
        name: "sliding",
        scenario: "hello-endline",
        changes: &[("[\"11.4 m\", \"-22 m\"]", "[\"13.9 m\", \"-7 m\"]")],
        seconds: 4.0,
        shows: |shown| {
            let whale = shown.summary.whale.as_ref().unwrap();
            let work: f64 = whale.regions.iter().map(|region| region.friction_work_j).sum();
            assert!(whale.contact_time_s > 0.5, "{} s in contact", whale.contact_time_s);
            assert!(work.abs() > 1.0, "{work} J of friction");
        },
    },
    Case {
        name: "wrapped",
        scenario: "dead-whale-wraps",
        changes: &[],
        seconds: 0.15,
        shows: |shown| {
            let whale = shown.summary.whale.as_ref().unwrap();
            let wraps = |part| whale.regions.iter().find(|one| one.part == part).unwrap().wraps;
            assert!(wraps(BodyPart::Peduncle) > 1.5, "{} turns", wraps(BodyPart::Peduncle));
        },
    },
    Case {
        name: "lodged",
        scenario: "case-e7-99-sideways",
        changes: &[],
        seconds: 6.0,
        shows: |shown| {
            let whale = shown.summary.whale.as_ref().unwrap();
            assert!(whale.lodged_in_mouth, "{whale:?}");
        },
    },
    Case {
        name: "parted",
        scenario: "weak-link-pull",
        changes: &[],
        seconds: 6.0,
        shows: |shown| {
            assert!(shown.summary.links[0].parted_at_s.is_some(), "{:?}", shown.summary.links);
        },
    },
    Case {
        name: "kinetic",
        scenario: "towing-trap",
        changes: &[],
        seconds: 5.0,
        shows: |shown| {
            let whale = shown.summary.whale.as_ref().unwrap();
            let kinetic = whale.kinetic.as_ref().unwrap();
            assert!(kinetic.peak_rope_pull_n > 100.0, "{kinetic:?}");
        },
    },
    Case {
        name: "waves",
        scenario: "waves-buoy",
        changes: &[("ramp = \"10 s\"", "ramp = \"1 s\"")],
        seconds: 5.0,
        shows: |shown| {
            let buoy = shown.summary.probes.iter().find(|probe| probe.id == "buoy height").unwrap();
            assert!(buoy.max - buoy.min > 0.2, "the buoy rides the waves: {buoy:?}");
        },
    },
    Case {
        name: "rope on rope",
        scenario: "hitches",
        changes: &[],
        seconds: 0.1,
        shows: |shown| {
            assert!(shown.audit.rope_steps > 20, "{:?}", shown.audit);
        },
    },
];

/// Runs a scenario and gives what it came to, with its states at checkpoints.
pub fn run(case: &Case) -> (Shown, Vec<Row>) {
    let model = model(case.scenario, case.changes);
    let settings = &model.spec.settings;
    let start = if settings.as_placed { State::start(&model) } else { settled(&model) };
    let steps = (case.seconds / settings.step_s).round() as u64;
    let row = |state: &State, input: &Input| Row {
        case: case.name.to_owned(),
        step: state.step,
        hash: StateHash::of(input, state),
    };
    let (mut state, mut workspace, mut metrics) =
        (start.clone(), Workspace::new(&model), Metrics::new(&model));
    let mut rows = vec![row(&state, &Input::default())];
    metrics.fold(&model, &state, &[]);
    while state.step < steps {
        let input = input(&model, &state);
        step(&model, &input, &mut state, &mut workspace).unwrap_or_else(|stop| panic!("{stop:?}"));
        metrics.fold_step(&model, &state, &workspace);
        if state.step.is_multiple_of(steps.div_ceil(CHECKPOINTS)) || state.step == steps {
            rows.push(row(&state, &input));
        }
    }
    let (summary, audit) = (metrics.summary(&model, &state), workspace.audit);
    (Shown { model, start, state, summary, audit }, rows)
}

fn settled(model: &Model) -> State {
    let settled = settle(model);
    assert!(settled.converged, "residual {} N", settled.residual_n);
    settled.state
}

/// The pilot program's controls for the next step.
fn input(model: &Model, state: &State) -> Input {
    let pilot = model.spec.whale.as_ref().map(|whale| &whale.pilot);
    Input { controls: pilot.map(|pilot| pilot.at(state)).unwrap_or_default() }
}

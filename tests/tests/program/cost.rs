//! A run tells what its computing time went to.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::sync::atomic::{AtomicU64, Ordering};

use endline_session::plugins::PluginHost;
use endline_session::{Overrides, Prepared, Report, Run, RunOptions, json, prepare};
use endline_sim::{CostPart, Input, Workspace, settle, step};

use crate::common::Place;

/// Steps taken: rope is touched within them.
const STEPS: u64 = 250;
/// Readings of the clock that a step of the model needs besides its solver steps.
const IN_A_STEP: u64 = 8;
/// Readings in a try of a solver step besides its passes, and in a pass.
const IN_A_TRY: u64 = 10;
const IN_A_PASS: u64 = 6;

/// The shipped encounter, its whale set down just before the rope.
fn encounter(place: &Place) -> Prepared {
    let plugins = endline_tests::products().unwrap().join("plugins");
    let (host, problems) = PluginHost::discover(&[plugins]);
    assert!(problems.is_empty(), "{problems:?}");
    prepare(place.encounter().as_ref(), None, &host, Overrides::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_parts_sum_to_the_real_time_and_contact_costs_nothing_before_it() {
    let place = Place::new("cost");
    let mut run = Run::new(encounter(&place), RunOptions::default()).unwrap();
    while run.state().step < STEPS {
        run.step(run.pilot()).unwrap();
        let cost = run.timing().cost;
        if run.audit().contact_steps == 0 {
            assert!(cost.of_s(CostPart::Contact) <= 0.0, "{cost:?}");
        }
    }
    assert!(run.audit().contact_steps > 0, "the rope was never touched");
    let cost = run.timing().cost;
    for part in CostPart::ALL.iter().copied() {
        assert!(cost.of_s(part) > 0.0, "{part:?} of {cost:?}");
    }
    // The steps lie within what is measured around them; little else does.
    let steps_s = cost.whole_s() - cost.of_s(CostPart::Metrics);
    let wall_s = run.timing().whole().wall_s;
    assert!(steps_s <= wall_s * (1.0 + 1e-12) && steps_s > 0.9 * wall_s, "{steps_s} of {wall_s} s");
    let json: serde_json::Value =
        serde_json::from_str(&json::line(&Report::from_run(&run))).unwrap();
    let parts = json["cost"].as_object().unwrap();
    let sum: f64 =
        parts.iter().filter(|(key, _)| *key != "whole_s").map(|(_, s)| s.as_f64().unwrap()).sum();
    assert_eq!(parts.len(), CostPart::ALL.len() + 1);
    assert!((sum - json["cost"]["whole_s"].as_f64().unwrap()).abs() < 1e-9, "{parts:?}");
}

#[test]
fn the_clock_is_read_at_phases_and_never_for_a_segment() {
    static READ: AtomicU64 = AtomicU64::new(0);
    let place = Place::new("clock");
    let prepared = encounter(&place);
    let model = &*prepared.model;
    let (mut state, mut workspace) = (settle(model).state, Workspace::new(model));
    workspace.lend_clock(|| READ.fetch_add(1, Ordering::Relaxed));
    for _ in 0..STEPS {
        let controls = model.spec.whale.as_ref().unwrap().pilot.at(&state);
        let (before, read) = (workspace.audit, READ.load(Ordering::Relaxed));
        step(model, &Input { controls }, &mut state, &mut workspace).unwrap();
        let (audit, read) = (workspace.audit, READ.load(Ordering::Relaxed) - read);
        let tries = audit.solver_steps - before.solver_steps + audit.halved - before.halved;
        // Passes of a try that failed are not all counted: six are the most of a short step.
        let passes = audit.passes - before.passes + 6 * (audit.halved - before.halved);
        let most = IN_A_STEP + IN_A_TRY * tries + IN_A_PASS * passes;
        assert!(read > 3 && read <= most, "{read} readings in {tries} tries, {passes} passes");
        let ticks = (workspace.cost().whole_s() * 1e9).round() as u64;
        assert_eq!(ticks + 1, read, "every reading ends a part but the first");
    }
    assert!(workspace.audit.contact_steps > 0, "the rope was never touched");
}

//! The same run gives the same bits: twice, on any number of threads, and with its scratch memory dropped at any time.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

mod common;

use common::Place;
use endline_session::hash::StateHash;
use endline_session::plugins::PluginHost;
use endline_session::{Overrides, Run, RunOptions, prepare};
use endline_sim::{Input, Workspace, settle, step};

/// Steps compared: the rope is touched within them.
const STEPS: u64 = 250;

#[test]
fn the_same_run_has_the_same_hash_on_any_number_of_threads() {
    let place = Place::new("threads");
    let scenario = place.encounter();
    let hash = |threads: &str| {
        let summary =
            place.endline(&["run", &scenario, "--json", "--threads", threads]).done().json();
        assert!(summary["whale"]["first_contact_s"].is_number(), "the rope was never touched");
        summary["state_hash"].as_str().unwrap().to_owned()
    };
    let first = hash("1");
    assert_eq!(first, hash("1"));
    assert_eq!(first, hash("2"));
}

#[test]
fn dropping_the_workspace_between_steps_changes_no_bit() {
    let place = Place::new("workspace");
    let scenario = place.encounter();
    // Resolution that follows the whale must come from the state alone, too.
    let text = std::fs::read_to_string(&scenario).unwrap();
    std::fs::write(&scenario, text.replace("[site]", "[resolution]\n\n[site]")).unwrap();
    let plugins = endline_tests::products().unwrap().join("plugins");
    let (host, problems) = PluginHost::discover(&[plugins]);
    assert!(problems.is_empty(), "{problems:?}");
    let prepared = prepare(scenario.as_ref(), None, &host, Overrides::default())
        .unwrap_or_else(|error| panic!("{error}"));
    let model = &*prepared.model;

    let start = settle(model).state;
    let (mut kept, mut dropped) = (start.clone(), start);
    let (mut workspace, mut touched) = (Workspace::new(model), false);
    for _ in 0..STEPS {
        let controls = model.spec.whale.as_ref().unwrap().pilot.at(&kept);
        let input = Input { controls };
        step(model, &input, &mut kept, &mut workspace).unwrap();
        let mut fresh = Workspace::new(model);
        step(model, &input, &mut dropped, &mut fresh).unwrap();
        touched |= !fresh.contacts.is_empty();
        let (kept, dropped) = (StateHash::of(&input, &kept), StateHash::of(&input, &dropped));
        assert_eq!(kept.first_difference(&dropped), None);
    }
    assert!(touched, "the rope was never touched");
    assert!(workspace.audit.splits > 10, "{} splits", workspace.audit.splits);

    // The session's own run walks the same states.
    let mut run =
        Run::new(prepared.clone(), RunOptions::default()).unwrap_or_else(|error| panic!("{error}"));
    while run.state().step < STEPS {
        run.step(run.pilot()).unwrap();
    }
    assert_eq!(StateHash::of(&Input::default(), &kept).parts[1..], run.state_hash().parts[1..]);
}

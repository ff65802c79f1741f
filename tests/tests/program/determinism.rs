//! A run repeated gives equal bits: twice, on any number of threads, and with its scratch memory dropped at any time.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::sync::Arc;

use crate::common::{Called, Place, edit, text};
use endline_session::hash::StateHash;
use endline_session::plugins::PluginHost;
use endline_session::{Overrides, Prepared, Run, RunOptions, prepare};
use endline_sim::{Input, Settled, Workspace, settle, step};

/// Steps compared: the rope is touched within them.
const STEPS: u64 = 250;

/// The shipped encounter, its whale set down just before the rope, made ready with the shipped plugins.
fn prepared(scenario: &str) -> Prepared {
    let plugins = endline_tests::products().unwrap().join("plugins");
    let (host, problems) = PluginHost::discover(&[plugins]);
    assert!(problems.is_empty(), "{problems:?}");
    prepare(scenario.as_ref(), None, &host, Overrides::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Hashes of the states of a run after each step.
fn hashes(prepared: &Prepared, settled: &Arc<Settled>) -> Vec<StateHash> {
    let mut run = Run::from_settled(prepared.clone(), RunOptions::default(), Arc::clone(settled));
    let hash_of_step = |_| {
        run.step(run.pilot()).unwrap();
        run.state_hash()
    };
    let hashes = (0..STEPS).map(hash_of_step).collect();
    let whale = run.summary().whale.unwrap();
    assert!(whale.first_contact_s.is_some(), "the rope was never touched");
    hashes
}

/// Runs of one model, which share it and the loaded plugins, as the runs of a study do.
#[test]
fn runs_side_by_side_on_any_number_of_threads_have_the_hashes_of_one_alone() {
    let place = Place::new("threads");
    let prepared = prepared(&place.encounter());
    let settled = Arc::new(settle(&prepared.model));
    let alone = hashes(&prepared, &settled);
    for threads in [1, 2, 4] {
        let run = || hashes(&prepared, &settled);
        let together: Vec<Vec<StateHash>> = std::thread::scope(|scope| {
            let runs: Vec<_> = (0..threads).map(|_| scope.spawn(run)).collect();
            runs.into_iter().map(|run| run.join().unwrap()).collect()
        });
        for (of, run) in together.iter().enumerate() {
            let other = run.iter().zip(&alone).position(|(one, other)| one != other);
            assert_eq!(
                other, None,
                "place of the first step that differs, in run {of} of {threads}"
            );
        }
    }
}

#[test]
fn dropping_the_workspace_between_steps_changes_no_bit() {
    let place = Place::new("workspace");
    let scenario = place.encounter();
    // Resolution that follows the whale must come from the state alone, too.
    let text = std::fs::read_to_string(&scenario).unwrap();
    std::fs::write(&scenario, text.replace("[site]", "[resolution]\n\n[site]")).unwrap();
    let prepared = prepared(&scenario);
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

/// A moment of a run, continued with a pilot program that has one more entry later, has the hashes of a run with that program from the
/// start; a program whose memory cannot be known from the moment is refused.
#[test]
fn another_pilot_program_continues_from_a_moment_as_from_the_start() {
    let place = Place::new("repiloted");
    let file = place.encounter();
    let with = |entry: &str| {
        let other = place.folder.join("other.toml");
        let text = std::fs::read_to_string(&file).unwrap();
        std::fs::write(&other, format!("{text}\n[[whale.pilot]]\n{entry}\n")).unwrap();
        prepared(&other.display().to_string())
    };
    let (before, after) = (prepared(&file), with("at = \"1.5 s\"\nyaw = 0.5"));
    let mut run = Run::new(before, RunOptions::default()).unwrap();
    (0..100).for_each(|_| run.step(run.pilot()).unwrap());
    let moment = run.moment();
    (100..STEPS).for_each(|_| run.step(run.pilot()).unwrap());
    let inputs = run.inputs(120).unwrap();

    let mut whole = Run::new(after.clone(), RunOptions::default()).unwrap();
    let known = moment.clone().with_pilot_of(run.model(), &after.model).unwrap();
    let mut continued = run.branched(&known, after).unwrap();
    for (begun, of) in [(0, &mut whole), (100, &mut continued)] {
        inputs[begun..].iter().for_each(|controls| of.step(*controls).unwrap());
        (120..STEPS).for_each(|_| of.step(of.pilot()).unwrap());
    }
    assert_eq!(continued.state_hash(), whole.state_hash());
    assert_ne!(continued.state_hash(), run.state_hash(), "the entry has an effect");

    for unknown in ["touch = \"any\"\nyaw = 0.5", "at = \"0.5 s\"\nyaw = 0.5"] {
        let other = with(unknown);
        assert!(moment.clone().with_pilot_of(run.model(), &other.model).is_none(), "{unknown}");
    }
}

/// The program without gear library and plugins beside it, and with an empty home.
#[test]
fn the_program_alone_runs_the_same_encounter_and_keeps_what_was_edited() {
    let place = Place::new("alone");
    let first = place.alone(&["settle", "hello-endline"]).done();
    assert!(
        first.stderr.contains("gear-library (") && first.stderr.contains("yours to edit"),
        "{first}"
    );
    let scenario = place.path("data/endline/gear-library/scenarios/hello-endline.toml");
    edit(&scenario, "duration", "duration = \"1 s\"");

    // Plugins inside the program and plugins from files are the same code: the state at the end has the same bits.
    let run = place.alone(&["run", "hello-endline", "--json"]).done();
    assert!(run.stderr.lines().all(|line| !line.contains("gear-library (")), "written once; {run}");
    let hash = |called: &Called| called.json()["state_hash"].clone();
    assert!(hash(&run).is_string() && run.json()["simulated_s"] == 1.0, "{run}");
    let beside = place.endline(&["run", &text(&scenario), "--json"]).done();
    assert_eq!(hash(&run), hash(&beside));

    let listed = place.alone(&["plugins", "list"]).done();
    for id in ["motion.swim", "friction.baleen", "gear.trawl"] {
        assert!(listed.stdout.contains(id), "{id}; {listed}");
    }
    assert!(listed.stdout.contains("linked in") && listed.stderr.is_empty(), "{listed}");
}

//! The cases of the report of 2012 (`gear-library/scenarios/case-*.toml`) end with its wraps, and their ends replay to the bit.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::model;
use endline_sdk::BodyPart;
use endline_session::hash::StateHash;
use endline_sim::metrics::{Metrics, Outcome, RegionSummary, WhaleSummary};
use endline_sim::{Input, Model, State, Workspace, settle, step};

/// How long before its end a run is taken up again [s].
const AGAIN_S: f64 = 1.0;

/// Steps until `until_s`, calls `observe` after each step and returns the hash of the last state.
fn steps_to(
    model: &Model,
    until_s: f64,
    state: &mut State,
    mut observe: impl FnMut(&State, &Workspace),
) -> StateHash {
    let pilot = &model.spec.whale.as_ref().unwrap().pilot;
    let mut workspace = Workspace::new(model);
    let mut input = Input { controls: pilot.at(state) };
    while state.time_s < until_s - 1e-9 {
        input = Input { controls: pilot.at(state) };
        step(model, &input, state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?} {:?}", workspace.audit));
        observe(state, &workspace);
    }
    assert_eq!(
        (workspace.audit.tunnelled, workspace.audit.ropes_crossed),
        (0, 0),
        "nothing passes through"
    );
    StateHash::of(&input, state)
}

/// Returns the result of a case. The last second is run twice, the second time from the state alone.
fn ends(name: &str) -> WhaleSummary {
    let model = model(name, &[]);
    let settled = settle(&model);
    assert!(settled.converged, "residual {} N", settled.residual_n);
    let (end_s, mut state, mut metrics) =
        (model.spec.settings.duration_s, settled.state, Metrics::new(&model));
    metrics.fold(&model, &state, &[]);
    let mut fold =
        |state: &State, workspace: &Workspace| metrics.fold_step(&model, state, workspace);
    steps_to(&model, end_s - AGAIN_S, &mut state, &mut fold);
    let mut again = state.clone();
    let once = steps_to(&model, end_s, &mut state, &mut fold);
    let twice = steps_to(&model, end_s, &mut again, |_, _| {});
    assert_eq!(once.first_difference(&twice), None, "the last {AGAIN_S} s replay to the bit");
    for event in metrics.events() {
        println!("{:7.2} s {:?} {} {:.2}", event.time_s, event.kind, event.subject, event.value);
    }
    let whale = metrics.summary(&model, &state).whale.unwrap();
    println!("{name}: {whale:?}");
    whale
}

/// The nearest number of half turns: the reports on the real whales fix the kind of a wrap, not its angle.
fn half_turns(turns: f64) -> u32 {
    (2.0 * turns.abs()).round() as u32
}

/// Returns the measurements of a part.
fn part(whale: &WhaleSummary, part: BodyPart) -> &RegionSummary {
    whale.regions.iter().find(|region| region.part == part).unwrap()
}

#[test]
fn e7_99_ends_with_rope_lodged_in_the_mouth_and_half_a_turn_about_the_head() {
    let whale = ends("case-e7-99-slack.toml");
    assert_eq!(whale.outcome, Outcome::Entangled);
    assert!(whale.lodged_in_mouth && whale.hooked);
    let head = part(&whale, BodyPart::Head).wraps;
    assert_eq!(half_turns(head), 1, "{head} turns");
    assert!(whale.trailing_m > 0.0, "the buoy's end trails: {} m", whale.trailing_m);
    assert!(
        whale.carried.iter().any(|id| id.ends_with("trap")),
        "the trap comes along: {:?}",
        whale.carried
    );
}

#[test]
fn e7_99_on_its_side_ends_with_rope_lodged_in_the_mouth() {
    let whale = ends("case-e7-99-sideways.toml");
    assert_eq!(whale.outcome, Outcome::Entangled);
    assert!(whale.lodged_in_mouth);
    let head = part(&whale, BodyPart::Head);
    assert!(head.contact_length_m > 0.3, "{} m of rope", head.contact_length_m);
    assert!(head.wraps < 0.2, "it goes straight through: {} turns", head.wraps);
}

#[test]
fn e25_05_with_a_roll_ends_with_rope_about_flipper_and_body() {
    let whale = ends("case-e25-05-roll.toml");
    assert_eq!(whale.outcome, Outcome::Entangled);
    assert!(whale.hooked);
    let (flipper, body) = (part(&whale, BodyPart::LeftFlipper), part(&whale, BodyPart::Body));
    assert_eq!(half_turns(flipper.wraps), 1, "{} turns about the flipper", flipper.wraps);
    // Turns between contacts: along the whole strand, those before and behind the flipper have opposite signs.
    let about_body = body.touching_wraps;
    assert!(half_turns(about_body) >= 1, "{about_body} turns about the body");
    assert!(body.contact_length_m > 0.0, "rope touches the body");
}

#[test]
fn e25_05_with_thrashing_keeps_the_bight_round_the_flipper() {
    let whale = ends("case-e25-05-thrash.toml");
    assert_eq!(whale.outcome, Outcome::Entangled);
    assert!(whale.hooked);
    let flipper = part(&whale, BodyPart::LeftFlipper).wraps;
    assert_eq!(half_turns(flipper), 1, "{flipper} turns");
}

/// Wraps about the left and the right fluke.
fn flukes(whale: &WhaleSummary) -> [f64; 2] {
    [BodyPart::LeftFluke, BodyPart::RightFluke].map(|fluke| part(whale, fluke).wraps)
}

#[test]
fn e15_02_ends_with_rope_about_both_flukes() {
    let whale = ends("case-e15-02.toml");
    assert_eq!(whale.outcome, Outcome::Entangled);
    assert!(whale.hooked);
    let turns = flukes(&whale);
    assert!(turns.iter().all(|turns| half_turns(*turns) >= 1), "{turns:?} turns");
}

#[test]
fn e15_02_at_slack_water_ends_with_rope_about_both_flukes() {
    let whale = ends("case-e15-02-slack.toml");
    assert_eq!(whale.outcome, Outcome::Entangled);
    assert!(whale.hooked);
    let turns = flukes(&whale);
    assert!(turns.iter().all(|turns| half_turns(*turns) == 1), "{turns:?} turns");
    assert!(half_turns(turns.iter().sum()) >= 2, "{turns:?} turns about the tail stock");
}

//! A roll twists the legs of a bight on the tail stock: rope on rope holds the twist, and without it nothing stays.

use endline_session::report::validity;
use endline_sim::metrics::Metrics;
use endline_sim::{Input, State, Workspace, step};

use crate::linked::model;

/// The roll is over, and the whale rests [s].
const ROLLED_S: f64 = 15.0;

/// Twist once the roll is over and at the end of a run, with its sign [turns]; nothing passes through, and the run is valid.
fn twists(changes: &[(&str, &str)]) -> [f64; 2] {
    let model = model("twisted-bight", changes);
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    let (mut metrics, mut rolled) = (Metrics::new(&model), None);
    let pilot = &model.spec.whale.as_ref().unwrap().pilot;
    while state.time_s < model.spec.settings.duration_s - 1e-9 {
        let input = Input { controls: pilot.at(&state) };
        step(&model, &input, &mut state, &mut workspace).unwrap_or_else(|stop| panic!("{stop:?}"));
        metrics.fold_step(&model, &state, &workspace);
        if state.time_s > ROLLED_S && rolled.is_none() {
            rolled = Some(metrics.summary(&model, &state).lines[0].twist);
        }
    }
    let (summary, audit) = (metrics.summary(&model, &state), workspace.audit);
    println!("{:?}\n{audit:?}", summary.lines);
    assert_eq!((audit.tunnelled, audit.ropes_crossed, audit.ropes_through), (0, 0, 0));
    let reasons = validity::reasons(None, &audit, summary.whale.as_ref());
    assert!(reasons.is_empty(), "{reasons:?}");
    [rolled.unwrap(), summary.lines[0].twist]
}

#[test]
fn legs_twisted_by_a_roll_stay_twisted_where_rope_holds_rope() {
    let [rolled, end] = twists(&[]);
    assert!(end < -1.0, "a whole turn, left-handed as the roll to port: {end}");
    assert!((end - rolled).abs() < 0.05, "it stays: {rolled}, then {end}");
    let [_, through] = twists(&[("seed = 1", "seed = 1\nrope_on_rope = false")]);
    assert!(through.abs() < 0.5, "legs that pass through each other: {through}");
}

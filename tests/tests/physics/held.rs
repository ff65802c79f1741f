//! Gear that stands still is held, and is then where it would be without that.

use endline_sim::{DVec3, Input, Model, State, Workspace};

use crate::linked::{built, spec};
use crate::momentum;

/// A bundled scenario after some seconds, with gear that is held while it stands still or not.
fn run(name: &str, seconds: f64, holds_still: bool) -> (Model, State, Workspace) {
    run_changed(name, &[], seconds, holds_still)
}

/// A bundled scenario with replacements in its text after some seconds.
fn run_changed(
    name: &str,
    changes: &[(&str, &str)],
    seconds: f64,
    holds_still: bool,
) -> (Model, State, Workspace) {
    let mut spec = spec(name, changes);
    spec.settings.holds_still = holds_still;
    let model = built(spec);
    let (state, workspace) = momentum::run(&model, seconds);
    (model, state, workspace)
}

fn greatest(distances: impl Iterator<Item = f64>) -> f64 {
    distances.fold(0.0, f64::max)
}

#[test]
fn an_endline_that_waits_for_a_whale_is_where_it_would_be() {
    let seconds = 11.5;
    let (_, held, workspace) = run("hello-endline", seconds, true);
    let (model, solved, other) = run("hello-endline", seconds, false);
    let apart = |one: &[DVec3], two: &[DVec3]| {
        greatest(one.iter().zip(two).map(|(one, two)| one.distance(*two)))
    };
    let apart_m = apart(&held.rope.position, &solved.rope.position);
    let tensions = held.rope.tension.iter().zip(&solved.rope.tension);
    let apart_n = greatest(tensions.map(|(one, two)| (one - two).abs()));
    println!("{apart_m:.2e} m, {apart_n:.2e} N, {} steps held", workspace.audit.held_steps);
    assert_eq!(held.time_s.to_bits(), solved.time_s.to_bits());
    assert_eq!(held.whale, solved.whale, "gear has not met the whale");
    assert!(apart_m < 1e-6, "{apart_m}");
    assert!(apart_n < 1e-3, "{apart_n}");
    let steps = held.step;
    assert!(
        workspace.audit.held_steps > steps * 9 / 10,
        "{} of {steps}",
        workspace.audit.held_steps
    );
    assert_eq!(other.audit.held_steps, 0);
    // The greatest tension of a step is also that of held gear.
    let peak_n = greatest(workspace.peak_tension_n.iter().copied());
    let tension_n = greatest(solved.rope.tension.iter().copied());
    assert!((peak_n - tension_n).abs() < 1e-3, "{peak_n} {tension_n}, {}", model.node_count);
}

/// Slack gangions on the seabed move by the tolerance of force; traps, groundline and endlines do not.
#[test]
fn a_trawl_at_rest_is_where_it_would_be() {
    let (_, held, workspace) = run("trawl-10", 10.0, true);
    let (_, solved, _) = run("trawl-10", 10.0, false);
    let bodies = held.bodies.iter().zip(&solved.bodies);
    let apart_m = greatest(bodies.map(|(one, two)| one.position.distance(two.position)));
    println!("{apart_m:.2e} m, {} steps held", workspace.audit.held_steps);
    assert!(apart_m < 1e-6, "{apart_m}");
    assert!(workspace.audit.held_steps > 900, "{}", workspace.audit.held_steps);
}

#[test]
fn gear_in_a_tide_or_in_waves_is_not_held() {
    for name in ["tide-turns", "waves-buoy"] {
        let (_, _, workspace) = run(name, 1.0, true);
        assert_eq!(workspace.audit.held_steps, 0, "{name}");
    }
}

/// The cutter at the buoy, which feels more than 0.3 lbf from the start, cuts an endline at rest after three seconds.
const CUT_AT_REST: &[(&str, &str)] = &[
    (
        "cutter_hold = \"20 s\"",
        "cutter_hold = \"3 s\"\ncutter_tension = \"0.3 lbf\"\ncutter_at = \"buoy\"",
    ),
    ("velocity = [\"1.5 m/s\", \"0 m/s\", \"0 m/s\"]\nfrom = \"5 s\"\nuntil = \"60 s\"\n", ""),
];

#[test]
fn a_gear_type_releases_gear_that_is_held() {
    let (_, state, workspace) = run_changed("time-tension-cutter", CUT_AT_REST, 6.0, true);
    let (_, solved, _) = run_changed("time-tension-cutter", CUT_AT_REST, 6.0, false);
    let parted = |state: &State| state.line_parted.iter().flatten().next().copied();
    let (at_s, _) = parted(&state).expect("the cutter cuts");
    let places = state.rope.position.iter().zip(&solved.rope.position);
    let apart_m = greatest(places.map(|(one, two)| one.distance(*two)));
    let speed_m_s = greatest(state.rope.velocity.iter().map(|velocity| velocity.length()));
    println!(
        "cut at {at_s:.2} s; {apart_m:.2e} m, {speed_m_s:.2} m/s, {} steps held",
        workspace.audit.held_steps
    );
    assert_eq!(parted(&state), parted(&solved));
    assert!(workspace.audit.held_steps > 250, "it is held before: {}", workspace.audit.held_steps);
    assert!(speed_m_s > 0.01, "the rope falls: {speed_m_s}");
    assert!(apart_m < 0.02, "slack rope that recoils: {apart_m}");
}

/// The gear of `hello-endline` with a second one.
const TWO_GEARS: &[(&str, &str)] = &[
    ("part = \"buoy\"", "part = \"near/buoy\""),
    ("rope_nodes = 1000\n", "rope_nodes = 2000\n"),
    (
        "[[gear]]\nassembly = \"single\"\n",
        "[[gear]]\nid = \"near\"\nassembly = \"single\"\n\n[[gear]]\nid = \"far\"\nassembly = \"single\"\nposition = [\"300 m\", \"0 m\"]\n",
    ),
];

/// A whale meets an endline in a field: the other gear is held to the bit, and the endline moves as it would alone.
#[test]
fn gear_that_the_whale_meets_moves_and_the_other_gear_is_held() {
    let (model, before, _) = run_changed("hello-endline", TWO_GEARS, 11.0, true);
    let seconds = 14.0;
    let (_, state, workspace) = run_changed("hello-endline", TWO_GEARS, seconds, true);
    let (alone, alone_state, other) = run("hello-endline", seconds, true);
    let gears = &model.gears;
    assert_eq!(gears.count, 2);
    let mut far = 0;
    for (line, nodes) in model.line_nodes.iter().enumerate() {
        let is_far = model.spec.lines[line].id.starts_with("far");
        assert_eq!(is_far, gears.of_line[line] != gears.of_line[0], "the first line is near");
        if is_far {
            let of = |state: &State| state.rope.position[nodes.clone()].to_vec();
            assert_eq!(of(&before), of(&state), "held");
            far += nodes.len();
        }
    }
    assert!(far > 0);
    let near = &state.rope.position[..alone.node_count];
    let apart_m =
        greatest(near.iter().zip(&alone_state.rope.position).map(|(one, two)| one.distance(*two)));
    let moved_m =
        greatest(near.iter().zip(&before.rope.position).map(|(one, two)| one.distance(*two)));
    println!("{apart_m:.2e} m apart, moved {moved_m:.2} m");
    assert!(
        workspace.contacts.iter().all(|contact| gears.of_line[contact.line] == gears.of_line[0])
    );
    assert_eq!(workspace.contacts.len(), other.contacts.len());
    assert!(moved_m > 0.05, "the whale moves the endline: {moved_m}");
    assert!(apart_m < 1e-3 * moved_m, "{apart_m}");
}

/// A workspace is scratch: without it, gear held beside gear that moves continues to the same bits.
#[test]
fn a_new_workspace_continues_a_field_to_the_same_bits() {
    let model = built(spec("hello-endline", TWO_GEARS));
    let (mut one, mut own) = momentum::run(&model, 12.5);
    let mut two = one.clone();
    let mut fresh = Workspace::new(&model);
    for _ in 0..100 {
        endline_sim::step(&model, &Input::default(), &mut one, &mut own).unwrap();
        endline_sim::step(&model, &Input::default(), &mut two, &mut fresh).unwrap();
    }
    assert!(!own.contacts.is_empty() || one.whale.is_some());
    assert_eq!(one, two);
}

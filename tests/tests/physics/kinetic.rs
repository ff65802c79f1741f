//! Shipped scenarios of the whale that feels the gear: strength by length, a carcass with gear, the same bits again.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{Linked, built, library, model, report, scenario_text, spec_of};
use endline_gear::{Options, Scenario, assemble};
use endline_sdk::LineEnd;
use endline_sim::balance::Source;
use endline_sim::metrics::{Metrics, end_tension};
use endline_sim::whale::pose::{pose, skin_all};
use endline_sim::{DVec3, Input, Model, State, Workspace, step};

/// Steps a model to a time or until `done`.
fn run(model: &Model, time_s: f64, mut done: impl FnMut(&State) -> bool) -> (State, Workspace) {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    while state.time_s < time_s && !done(&state) {
        let input = controls(model, &state);
        step(model, &input, &mut state, &mut workspace).unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    (state, workspace)
}

fn controls(model: &Model, state: &State) -> Input {
    Input { controls: model.spec.whale.as_ref().unwrap().pilot.at(state) }
}

/// Arthur et al. 2015: 14.6 kN at 10 m, 23.8 kN at 13.7 m, against rope of 18 kN.
#[test]
fn a_grown_whale_parts_the_rope_that_holds_a_young_one() {
    let young = model("part-rope-10m.toml", &[]);
    let (state, _) = run(&young, young.spec.settings.duration_s, |_| false);
    assert!(state.line_parted[0].is_none(), "a 10 m whale cannot part it");
    let whale = state.whale.as_ref().unwrap();
    assert!(
        (whale.exertion.thrust_n / (401.0 * 10_f64.powf(1.56)) - 1.0).abs() < 1e-3,
        "{} N",
        whale.exertion.thrust_n
    );
    let pull = end_tension(&young, &state, 0, LineEnd::A);
    assert!(
        (pull / whale.exertion.thrust_n - 1.0).abs() < 0.12,
        "it hangs in the rope with all it has: {pull} N"
    );

    let grown = model("part-rope-13m7.toml", &[]);
    let (state, _) =
        run(&grown, grown.spec.settings.duration_s, |state| state.line_parted[0].is_some());
    let whale = state.whale.as_ref().unwrap();
    assert!(state.line_parted[0].is_some(), "a 13.7 m whale parts it");
    assert!(
        (16_000.0..23_900.0).contains(&whale.exertion.thrust_n),
        "by thrust, not by a snatch: {} N",
        whale.exertion.thrust_n
    );
}

/// The energy bound of a snatch: a whale of mass `m`, with the water that it carries along, swims at `v` when a rope of length `L`
/// becomes taut. Rope of strength `S` that stretches by `e` there parts if `S < m v^2 / (e L)`. With `k = S / (e L)` for the stiffness
/// of the rope, this is `S < v sqrt(k m)`: rope that does not part bears that peak.
#[test]
fn a_snatch_at_a_fixed_foot_bears_its_energy_bound() {
    let cases = [
        (8.0, 0.8, 20.0, 60.0),
        (10.0, 1.2, 26.0, 90.0),
        (13.0, 1.0, 40.0, 250.0),
        (13.0, 1.6, 15.0, 60.0),
    ];
    for (length_m, speed_m_s, rope_m, stiffness_kn) in cases {
        let text = scenario_text("part-rope-10m.toml");
        let (before, _) = text.split_once("[[whale.pilot]]").unwrap();
        let (_, after) = text.split_once("[friction]").unwrap();
        let mut text =
            format!("{before}[[whale.pilot]]\nat = \"0 s\"\nspeed = 0.0\n\n[friction]{after}");
        let post_m = rope_m + 0.25 * length_m;
        let changes = [
            ("strength = \"18 kN\"", "strength = \"900 kN\"".to_owned()),
            ("stiffness = \"90 kN\"", format!("stiffness = \"{stiffness_kn} kN\"")),
            ("damping = \"500 N s\"", "damping = \"0 N s\"".to_owned()),
            ("density = \"940 kg/m3\"", "density = \"1025 kg/m3\"".to_owned()),
            ("length = \"26 m\"", format!("length = \"{rope_m} m\"")),
            ("length = \"10 m\"", format!("length = \"{length_m} m\"")),
            ("speed = \"0 m/s\"\nmotion", format!("speed = \"{speed_m_s} m/s\"\nmotion")),
            ("\"-30 m\", \"0 m\", \"-9.2 m\"", format!("\"-{post_m} m\", \"0 m\", \"-9.8 m\"")),
        ];
        for (from, to) in changes {
            assert!(text.contains(from), "the scenario says {from}");
            text = text.replace(from, &to);
        }
        let model = built(spec_of("snatch.toml", &text));
        let kinetic = model.spec.whale.as_ref().unwrap().kinetic.as_ref().unwrap();
        let (mut speed_when_taut, mut peak_n) = (0.0, 0.0_f64);
        run(&model, 12.0, |state| {
            let pull_n = end_tension(&model, state, 0, LineEnd::A);
            if peak_n < 100.0 {
                speed_when_taut = state.whale.as_ref().unwrap().speed_m_s;
            }
            peak_n = peak_n.max(pull_n);
            peak_n > 500.0 && pull_n < 0.5 * peak_n
        });
        let stiffness = 1e3 * stiffness_kn / rope_m;
        let bound_n = speed_when_taut * (stiffness * kinetic.whole_mass_kg().x).sqrt();
        println!(
            "{length_m} m at {speed_when_taut:.2} m/s, {rope_m} m of {stiffness_kn} kN: {peak_n:.0} N of {bound_n:.0} N"
        );
        assert!((peak_n / bound_n - 1.0).abs() < 0.1, "{peak_n} N, the bound is {bound_n} N");
    }
}

/// Line and trap of the library made fast to the tail stock: she slows until body and gear take the power that her body alone took at
/// 1.23 m/s, `(D + R + m du/dt) u = D₀ u₀`, with what the gear pulls at that speed. Measured of such gear: 158 N at 1 m/s, as the square.
#[test]
fn a_whale_that_tows_a_trap_slows_by_the_power_ratio() {
    let model = model("towing-trap.toml", &[]);
    let mut seen = Vec::new();
    let (state, workspace) = run(&model, model.spec.settings.duration_s, |state| {
        let whale = state.whale.as_ref().unwrap();
        let pull = -whale.exertion.rope_force_n.dot(whale.orientation * DVec3::X);
        seen.extend((state.time_s > 35.0).then_some([
            state.time_s,
            whale.speed_m_s,
            whale.exertion.thrust_n,
            pull,
        ]));
        false
    });
    let mean = |of: usize| seen.iter().map(|row| row[of]).sum::<f64>() / seen.len() as f64;
    let (first, last) = (seen[0], seen[seen.len() - 1]);
    let kinetic = model.spec.whale.as_ref().unwrap().kinetic.as_ref().unwrap();
    let inertia = kinetic.whole_mass_kg().x * (last[1] - first[1]) / (last[0] - first[0]);
    let [speed, thrust, pull] = [1, 2, 3].map(mean);
    let (clean, asked) = (|speed: f64| kinetic.drag.drag_n(1025.0, speed), 1.23);
    let (mut low, mut high) = (0.1, asked);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let needed = (clean(middle) + pull * (middle / speed).powi(2) + inertia) * middle;
        if needed > clean(asked) * asked { high = middle } else { low = middle }
    }
    println!(
        "{speed:.3} m/s against {low:.3}; body {:.1} N, gear {pull:.1} N, {inertia:.1} N for its mass, thrust {thrust:.1} N",
        clean(speed)
    );
    assert!(
        (speed / low - 1.0).abs() < 0.015,
        "she tows at {speed} m/s, the power law says {low}; the gear pulls {pull} N"
    );
    assert!(
        (thrust / (clean(speed) + pull + inertia) - 1.0).abs() < 0.03,
        "{thrust} N of thrust against {} + {pull} N",
        clean(speed)
    );
    assert!(
        (pull / (speed * speed) / 158.0 - 1.0).abs() < 0.25,
        "the gear drags with {pull} N at {speed} m/s"
    );
    assert!(workspace.audit.tunnelled == 0);
    assert!((state.whale.as_ref().unwrap().position.z + 11.5).abs() < 3.0, "she keeps her depth");
}

#[test]
fn a_carcass_floats_belly_up_and_drifts_with_its_gear() {
    let model = model("dead-whale-gear.toml", &[]);
    let spec = model.spec.whale.as_ref().unwrap();
    let kinetic = spec.kinetic.as_ref().unwrap();
    let hull = &kinetic.hull;
    let centre = |state: &State| {
        let whale = state.whale.as_ref().unwrap();
        whale.position + whale.orientation * kinetic.centre_m
    };
    let mut dry = Vec::new();
    let (state, workspace) = run(&model, 24.0, |state| {
        let orientation = state.whale.as_ref().unwrap().orientation;
        let wet = hull
            .wetted(kinetic.centre_m, orientation, centre(state).z, &mut hull.scratch())
            .volume_m3;
        dry.push(1.0 - wet / spec.measures.volume_m3);
        false
    });
    let whale = state.whale.as_ref().unwrap();
    assert!((whale.orientation * DVec3::Z).z < -0.85, "belly up: {}", whale.orientation * DVec3::Z);
    // It still heaves; about four hundredths of its volume above the water.
    let late = &dry[dry.len() / 4..];
    let afloat = late.iter().sum::<f64>() / late.len() as f64;
    assert!((afloat - 0.04).abs() < 0.015, "{afloat}");
    let centre = centre(&state);
    assert!((centre.x - 0.25 * 24.0).abs() < 1.5, "carried by the tide: {} m", centre.x);
    assert_eq!(workspace.audit.tunnelled, 0);
}

/// Balance of a whale that tows a trap straight ahead: the residuals of momentum and energy are small, and the impulse of the gear on
/// the whale is opposite to that of the whale on the gear, as the solver's balance of the gear reports it.
#[test]
fn the_books_of_a_whale_close() {
    let mut spec = model("towing-trap.toml", &[]).spec;
    spec.settings.balance = true;
    let model = Model::new(spec).unwrap();
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    let mut metrics = Metrics::new(&model);
    metrics.fold(&model, &state, &[]);
    while state.time_s < 20.0 {
        let input = controls(&model, &state);
        step(&model, &input, &mut state, &mut workspace).unwrap_or_else(|stop| panic!("{stop:?}"));
        metrics.fold_step(&model, &state, &workspace);
    }
    let books = metrics.summary(&model, &state).whale.unwrap().kinetic.unwrap().balance;
    let whale = state.whale.as_ref().unwrap();
    let ahead = whale.orientation * DVec3::X;
    let gear = workspace.balance.summary(&model, &state).unwrap();
    let given_ns = -gear.impulse_ns[Source::Skin as usize].dot(ahead);
    println!(
        "{books:?}, missed {} N s and {} J, gear {given_ns} N s",
        books.residual_ns(),
        books.residual_j()
    );
    assert!(books.thrust_impulse_ns > 1e3 && books.gear_impulse_ns < -1e3, "{books:?}");
    assert!(books.residual_ns().abs() < 2e-3 * books.thrust_impulse_ns, "{}", books.residual_ns());
    assert!(books.residual_j().abs() < 2e-3 * books.thrust_work_j, "{}", books.residual_j());
    assert!(
        (books.gear_impulse_ns / given_ns - 1.0).abs() < 0.01,
        "{} of {given_ns}",
        books.gear_impulse_ns
    );
}

#[test]
fn a_kinetic_run_keeps_its_bits_without_its_workspace() {
    let model = model("part-rope-10m.toml", &[]);
    let (whole, _) = run(&model, 3.0, |_| false);
    let mut state = State::start(&model);
    while state.time_s < 3.0 {
        let input = controls(&model, &state);
        step(&model, &input, &mut state, &mut Workspace::new(&model))
            .unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    assert!(state == whole);
    assert!(
        whole.whale.as_ref().unwrap().exertion.rope_force_n.length() > 100.0,
        "the rope is taut by then"
    );
}

/// A whale that dives to the seabed and rolls on it: no part of its skin goes below it, and the lowest lies on it.
#[test]
fn a_whale_at_the_seabed_lies_on_it() {
    let text = scenario_text("part-rope-10m.toml");
    let (before, _) = text.split_once("[[whale.pilot]]").unwrap();
    let (_, after) = text.split_once("[friction]").unwrap();
    let pilot = "[[whale.pilot]]\nat = \"0 s\"\nspeed = 1.0\npitch = -0.5\nroll = 0.8\n\n";
    let mut text = format!("{before}{pilot}[friction]{after}");
    for (from, to) in [
        ("depth = \"40 m\"\n", "depth = \"14 m\"\n"),
        ("seabed = false", "seabed = true"),
        ("to = \"whale:peduncle\"", "to = \"stake\""),
        ("length = \"26 m\"", "length = \"9 m\""),
        (
            "id = \"post\"\n",
            "id = \"stake\"\nposition = [\"-40 m\", \"5 m\", \"-9.2 m\"]\n\n[[fixture]]\nid = \"post\"\n",
        ),
        ("\"-30 m\", \"0 m\"", "\"-40 m\", \"-5 m\""),
    ] {
        assert!(text.contains(from), "the scenario says {from}");
        text = text.replacen(from, to, 1);
    }
    let model = built(spec_of("floor.toml", &text));
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    let (mut bones, mut vertices, mut lowest_m) = (Vec::new(), Vec::new(), f64::INFINITY);
    run(&model, 30.0, |state| {
        let whale = state.whale.as_ref().unwrap();
        pose(skin, whale.position, whale.orientation, &whale.posture, &mut bones);
        skin_all(skin, &bones, &mut vertices);
        lowest_m = vertices.iter().map(|vertex| vertex.z + 14.0).fold(lowest_m, f64::min);
        false
    });
    assert!(lowest_m.abs() < 1e-9, "the lowest vertex is at {lowest_m} m");
}

#[test]
fn an_impossible_whale_is_reported_with_its_place() {
    let text = scenario_text("part-rope-10m.toml");
    let problems = |from: &str, to: &str| {
        assert!(text.contains(from), "the scenario says {from}");
        let changed = text.replace(from, to);
        let message_of = Scenario::read("whale.toml", &changed)
            .map(|scenario| assemble(&scenario, &library(), &Linked, &Options::default()).err());
        report(&message_of.unwrap_or_else(Some).unwrap_or_else(|| panic!("{to} is taken")))
    };
    let spot = problems("whale:peduncle", "whale:pedunkle");
    assert!(
        spot.contains("whale.toml:45")
            && spot.contains("no spot `pedunkle`")
            && spot.contains("peduncle"),
        "{spot}"
    );
    let dynamics = problems("dynamics = \"kinetic\"", "dynamics = \"kinetik\"");
    assert!(dynamics.contains("whale.toml:56") && dynamics.contains("kinetic"), "{dynamics}");
    let dead = problems("dynamics = \"kinetic\"", "state = \"dead\"");
    assert!(dead.contains("speed") || dead.contains("motion"), "a dead whale has neither: {dead}");
}

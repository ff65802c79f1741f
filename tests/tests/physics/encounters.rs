//! The shipped encounters: what a newcomer runs first must be true.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{built, spec};
use crate::recovery::{Way, hide, host, opened, recover};
use endline_sim::metrics::{Metrics, Summary};
use endline_sim::{Audit, Input, ModelSpec, State, Workspace, settle, step};

/// An encounter run to its end.
struct Ran {
    settled_peak_n: f64,
    summary: Summary,
    audit: Audit,
    state: State,
}

fn run(spec: ModelSpec) -> Ran {
    let model = built(spec);
    let settled = settle(&model);
    assert!(
        settled.converged,
        "residual {} N after {} passes",
        settled.residual_n,
        settled.trace_n.len()
    );
    let (mut state, mut workspace, mut metrics) =
        (settled.state, Workspace::new(&model), Metrics::new(&model));
    let settled_peak_n = state.rope.tension.iter().copied().fold(0.0, f64::max);
    metrics.fold(&model, &state, &[]);
    let pilot = model.spec.whale.as_ref().map(|whale| whale.pilot.clone()).unwrap_or_default();
    while state.time_s < model.spec.settings.duration_s - 1e-9 {
        let input = Input { controls: pilot.at(&state) };
        step(&model, &input, &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?} {:?}", workspace.audit));
        metrics.fold_step(&model, &state, &workspace);
    }
    let summary = metrics.summary(&model, &state);
    for event in metrics.events() {
        println!("{:7.2} s {:?} {} {:.2}", event.time_s, event.kind, event.subject, event.value);
    }
    println!(
        "{:?}\n{:?}\nsettled peak {settled_peak_n:.1} N\n{:?}",
        workspace.audit, summary.lines, summary.links
    );
    println!("{:?}", summary.whale);
    Ran { settled_peak_n, summary, audit: workspace.audit, state }
}

#[test]
fn hello_endline_meets_the_whale() {
    let ran = run(spec("hello-endline.toml", &[]));
    let whale = ran.summary.whale.unwrap();
    let peak = ran.summary.lines.iter().map(|line| line.peak_tension_n).fold(0.0, f64::max);
    assert!(
        whale.regions.iter().any(|region| region.peak_normal_n > 0.0),
        "the whale touches the rope"
    );
    assert!(
        peak.is_finite() && peak > ran.settled_peak_n,
        "{peak} N above {} N",
        ran.settled_peak_n
    );
    assert_eq!(ran.audit.tunnelled, 0);
    assert!(ran.state.rope.position.iter().all(|place| place.is_finite()));
}

/// Fast water, a whale near the surface: the buoy itself is drawn onto its back. The line's end turns with the
/// buoy, which the linear step only approximates, and still nothing may pass through.
#[test]
fn a_buoy_drawn_onto_the_whale_lets_no_rope_through() {
    let changes = [
        ("duration = \"60 s\"", "duration = \"22 s\""),
        ("speed = \"0.25 m/s\"", "speed = \"0.64 m/s\""),
        ("speed = \"1.3 m/s\"", "speed = \"1.84 m/s\""),
        (r#"["11.4 m", "-22 m"]"#, r#"["13.61 m", "-18 m"]"#),
        ("depth = \"12 m\"", "depth = \"5.56 m\""),
    ];
    let ran = run(spec("hello-endline.toml", &changes));
    assert_eq!(ran.audit.tunnelled, 0);
    assert!(ran.summary.whale.unwrap().contact_time_s > 1.0);
}

/// A search recovers an encounter from its ending alone, which is reported with errors and with a part hidden.
/// `cargo bench -p endline-tests --bench recovery` does the same with twenty encounters.
#[test]
fn a_hidden_encounter_is_found_by_what_it_left() {
    let host = host();
    let hidden = hide(&opened(&host), 1);
    let [hidden] = hidden.as_slice() else { panic!("no draw ends entangled") };
    let folder = std::env::temp_dir().join(format!("endline-recovered-{}", std::process::id()));
    let found = recover(hidden, 0, &Way { trials: 96, net: 64, folder: &folder }, &host);
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(found.nearest <= 1.0, "{}: {}", hidden.class, found.nearest);
}

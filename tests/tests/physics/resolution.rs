//! `[resolution]` of a scenario: its lengths, and the rope nodes that it has where none are asked for.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{Linked, library, report, scenario_text, spec_of};
use endline_gear::{Diagnostic, Options, Scenario, assemble};
use endline_sim::Model;
use endline_sim::model::Resolution;

fn refused(text: &str) -> Vec<Diagnostic> {
    match Scenario::read("test.toml", text) {
        Err(problems) => problems,
        Ok(scenario) => match assemble(&scenario, &library(), &Linked, &Options::default()) {
            Err(problems) => problems,
            Ok(_) => panic!("this assembles: {text}"),
        },
    }
}

#[test]
fn resolution_follows_the_whale_by_lengths_in_order() {
    let text = scenario_text("hello-slack-tide.toml");
    let with =
        |lengths: &str| text.replacen("[site]", &format!("[resolution]\n{lengths}\n\n[site]"), 1);
    let spec = spec_of("test.toml", &with("near = \"8 cm\"\nfar = \"2 m\""));
    assert_eq!(
        spec.settings.resolution,
        Some(Resolution { near_m: 0.08, edge_m: 0.0125, far_m: 2.0 })
    );
    assert_eq!(spec_of("test.toml", &text).settings.resolution, None);
    for (lengths, part) in [
        ("edges = \"9 cm\"\nnear = \"8 cm\"", "`edges` is longer than `near`"),
        ("far = \"4 cm\"\nnear = \"8 cm\"", "`far` is shorter than `near`"),
        ("near = \"0.1 mm\"", "`near`"),
        ("nearer = \"8 cm\"", "unknown field `nearer`"),
    ] {
        let problems = refused(&with(lengths));
        assert!(
            problems.len() == 1 && problems[0].to_string().contains(part),
            "{}",
            report(&problems)
        );
    }
    let whaleless =
        scenario_text("reference-a-pendulum.toml").replacen("[site]", "[resolution]\n\n[site]", 1);
    assert!(refused(&whaleless)[0].to_string().contains("the resolution needs a whale"));
}

/// With the lengths of `[resolution]` and no count, nodes come from lengths and whale alone, whatever a strength.
#[test]
fn a_resolution_without_a_count_has_nodes_enough_for_it() {
    let nodes = |changes: &[(&str, &str)]| {
        let mut text = scenario_text("hello-endline.toml").replace("rope_nodes = 1000", "");
        for (from, to) in changes {
            assert!(text.contains(from), "{from}");
            text = text.replace(from, to);
        }
        Model::new(spec_of("test.toml", &text)).unwrap().node_count
    };
    let shipped = nodes(&[]);
    assert!((1200..2000).contains(&shipped), "{shipped}");
    assert_eq!(nodes(&[("weak_links = true", "weak_links = false")]), shipped);
    assert!(nodes(&[("\"1.25 cm\"", "\"2.5 cm\"")]) < shipped);
    assert!(nodes(&[("\"13.7 m\"", "\"9 m\"")]) < shipped);
}

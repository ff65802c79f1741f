//! Extreme numbers are rejected with their places before memory is allocated.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::idle::{TestHooks, library};
use endline_gear::limits::{DIAGNOSTICS, EXCERPT_CHARS, ROPE_NODES};
use endline_gear::{Diagnostic, Library, Options, Scenario, assemble};

/// A right whale and a rope wrapped about its tail stock.
const WRAPPED: &str = "format = 1\nkind = \"scenario\"\nname = \"n\"\nsource = \"test\"\nconfidence = \"estimate\"\nduration = \"1 s\"\n\
    segment = \"0.5 m\"\nstart = \"placed\"\n[site]\nitem = \"cape-cod-bay\"\n[current]\nspeed = \"0 m/s\"\n\
    [whale]\nitem = \"right-whale\"\nlength = \"13 m\"\nposition = [\"0 m\", \"0 m\"]\ndepth = \"20 m\"\nheading = \"0 deg\"\n\
    speed = \"0 m/s\"\nmotion = \"test.idle\"\n[friction]\nmodel = \"test.idle\"\n\
    [[joint]]\nid = \"low\"\nposition = [\"-6 m\", \"0 m\", \"-26 m\"]\n[[joint]]\nid = \"high\"\nposition = [\"-6 m\", \"1 m\", \"-14 m\"]\n\
    [[line]]\nid = \"rope\"\nrope = \"polysteel-3-8\"\nfrom = \"low\"\nto = \"high\"\nlength = \"50 m\"\nstart = \"wrapped\"\n\
    [[line.wrap]]\npart = \"peduncle\"\nturns = 1\n";

fn problems(text: &str, options: &Options) -> Vec<Diagnostic> {
    let read = Scenario::read("test.toml", text);
    let made = read
        .and_then(|scenario| assemble(&scenario, library(), &TestHooks::without_effect(), options));
    made.err().unwrap_or_default()
}

/// The scenario with a replaced text is rejected at the line of that text, with these words.
fn refused(from: &str, to: &str, words: &[&str]) {
    let text = WRAPPED.replacen(from, to, 1);
    let line = 1 + text[..text.find(to).unwrap()].matches('\n').count();
    let found = problems(&text, &Options::default());
    let reported = found.iter().find(|problem| problem.line == line);
    let reported = reported.unwrap_or_else(|| panic!("{to}: {found:#?}")).to_string();
    for word in words {
        assert!(reported.contains(word), "`{reported}` lacks `{word}`");
    }
}

#[test]
fn the_scenario_itself_is_sound() {
    assert_eq!(problems(WRAPPED, &Options::default()), []);
}

#[test]
fn nodes_without_end_are_refused_before_they_are_made() {
    for nodes in ["1000000", "1000000000", "1000000000000"] {
        let asked = format!("rope_nodes = {nodes}");
        refused("segment = \"0.5 m\"", &asked, &[nodes, "100000", "because", "longer `segment`"]);
    }
    // Nine kilometres of rope in segments of a millimetre.
    let long = WRAPPED.replace("length = \"50 m\"", "length = \"9 km\"");
    let fine = long.replace("segment = \"0.5 m\"", "segment = \"1 mm\"");
    let found = problems(&fine, &Options::default());
    assert!(found.iter().any(|one| one.line == 7 && one.message.contains("GB")), "{found:#?}");
    assert!(ROPE_NODES.holds(100_000.0) && !ROPE_NODES.holds(100_001.0));
}

#[test]
fn a_wrapped_rope_to_a_far_fixture_takes_no_memory() {
    refused(
        "\"-6 m\", \"0 m\", \"-26 m\"",
        "\"-1e15 m\", \"0 m\", \"-26 m\"",
        &["1e15", "because"],
    );
    refused("\"-6 m\", \"0 m\", \"-26 m\"", "\"-4000000 m\", \"0 m\", \"-26 m\"", &["1000000 m"]);
    let far = WRAPPED.replace("\"-6 m\", \"0 m\", \"-26 m\"", "\"-90 km\", \"0 m\", \"-26 m\"");
    let found = problems(&far, &Options::default());
    assert!(
        found.iter().any(|one| one.message.contains("of rope, and it has 50.00 m")),
        "{found:#?}"
    );
}

#[test]
fn places_and_springs_beyond_sense_are_refused() {
    refused(
        "position = [\"0 m\", \"0 m\"]",
        "position = [\"1e300 m\", \"0 m\"]",
        &["1e300", "kilometres"],
    );
    let stiff = "item = \"cape-cod-bay\"\nfoot_stiffness = \"20000000000000 N/m\"";
    let text = WRAPPED.replace("item = \"cape-cod-bay\"", stiff);
    assert!(problems(&text, &Options::default()).iter().any(|one| one.help.contains("resolves")));
}

#[test]
fn options_are_held_to_the_limits_of_files() {
    for step_s in [1e-12, 1e9, f64::NAN, 0.0] {
        let options = Options { step_s: Some(step_s), ..Options::default() };
        let found = problems(WRAPPED, &options);
        assert!(found.len() == 1 && found[0].message.contains("`step` is"), "{found:#?}");
    }
    let options = Options { rope_nodes: Some(1_000_000_000), ..Options::default() };
    assert!(problems(WRAPPED, &options)[0].message.contains("`rope_nodes`"));
}

#[test]
fn problems_of_a_hostile_file_are_counted_and_do_not_copy_its_line() {
    // All keys of an act on one line, and twenty thousand unknown keys.
    let keys: String = (0..20_000).map(|key| format!("k{key} = 1, ")).collect();
    let act =
        format!("format = 1\nkind = \"act\"\nname = \"n\"\nkeys = {{ {keys}z = 1 }}\nzz = 2\n");
    for (path, text) in [("acts/hostile.toml", act), ("ropes/hostile.toml", rope_of(20_000))] {
        let found = Library::check_file(path, &text);
        assert!((1..=DIAGNOSTICS + 1).contains(&found.len()), "{path}: {}", found.len());
        let longest = found.iter().map(|one| one.excerpt.chars().count()).max().unwrap();
        assert!(longest <= EXCERPT_CHARS, "{path}: {longest}");
        let reported: usize = found.iter().map(|one| one.to_string().len()).sum();
        assert!(reported < 400_000, "{path}: {reported} bytes");
    }
    let found = Library::check_file("ropes/hostile.toml", &rope_of(20_000));
    let last = found.last().unwrap();
    assert!(last.message.contains("more problems"), "{last}");
}

fn rope_of(unknown: usize) -> String {
    let lines: String = (0..unknown).map(|key| format!("unknown_{key} = {key}\n")).collect();
    format!("format = 1\nkind = \"rope\"\n{lines}")
}

//! A search as its users call it: located errors, and the same stories after an interruption and for any threads.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::fs;

use crate::common::{Place, form, library};

const OBSERVATION: &str = r#"format = 1
kind = "observation"
name = "Seen"
source = "a test"
confidence = "estimate"
encounters = "small"
[[site]]
part = "body"
wraps = [1, 2]
"#;

/// Encounters with a small rig without a whale: what is checked here is the running, not the physics.
const STUDY: &str = r#"format = 1
kind = "study"
name = "Small"
scenario = "small-rig.toml"
encounters = 10
baseline = "one"
[[option]]
id = "one"
[encounter."body.0.drag_area"]
uniform = ["0.1 m2", "0.3 m2"]
source = "assumed"
"#;

/// The shipped rig of studies, short and coarse, without its whale, in a library of the test's own.
fn place(name: &str) -> Place {
    let place = Place::new(name);
    let studies = place.library().join("studies");
    let scenario = fs::read_to_string(library().join("scenarios/study-endline-held.toml")).unwrap();
    let (gear, _) = scenario.split_once("[whale]").unwrap();
    let gear = gear
        .replace("duration = \"660 s\"", "duration = \"0.2 s\"")
        .replace("rope_nodes = 500", "rope_nodes = 12")
        .replace("[resolution]\nnear = \"5 cm\"\nedges = \"1.25 cm\"\n", "");
    fs::write(studies.join("small-rig.toml"), gear).unwrap();
    fs::write(studies.join("small.toml"), STUDY).unwrap();
    place.write("seen.toml", OBSERVATION);
    place
}

#[test]
fn a_search_continues_after_an_end_and_says_when_it_found_nothing() {
    let place = place("search");
    let call = |out: &str, trials: &str, threads: &str| {
        let arguments = [
            "--library",
            "gear-library",
            "search",
            "seen.toml",
            "--out",
            out,
            "--trials",
            trials,
            "--threads",
            threads,
            "--eager",
        ];
        place.endline(&arguments).done()
    };
    let whole = call("whole", "96", "2");
    assert!(whole.stdout.contains("Not found: no run ends like `seen`"), "{whole}");
    assert!(
        whole.stdout.contains("end like it (distance at most 1): 0 of 96; with 95 % confidence"),
        "{whole}"
    );
    call("parts", "32", "1");
    fs::remove_file(place.path("parts/stories.json")).unwrap();
    call("parts", "96", "1");
    let stories = |out: &str| fs::read(place.path(out).join("stories.json")).unwrap();
    assert_eq!(stories("parts"), stories("whole"));
    form::hold(&serde_json::from_slice(&stories("whole")).unwrap(), "endline.stories/1");
}

#[test]
fn mistakes_are_located_and_reported_all_at_once() {
    let place = place("search-mistakes");
    let wrong = OBSERVATION.replace("\"body\"", "\"bodi\"").replace("[1, 2]", "[2, 1]");
    place.write("wrong.toml", &wrong);
    let call = |arguments: &[&str]| {
        place.endline(&[["--library", "gear-library"].as_slice(), arguments].concat())
    };
    call(&["search", "wrong.toml"]).fails(
        1,
        &["wrong.toml:8:8", "`bodi` is not a value of `part`", "wrong.toml:9:9", "do not rise"],
    );
    call(&["check", "wrong.toml"])
        .fails(1, &["wrong.toml:8:8", "wrong.toml:9:9", "2 of the problems are errors"]);
    call(&["check", "seen.toml"]).done();
    place.write("lost.toml", &OBSERVATION.replace("\"small\"", "\"smal\""));
    call(&["search", "lost.toml"]).fails(1, &["lost.toml:6", "no `smal.toml`", "small"]);
    call(&["search", "no-such"]).fails(1, &["no `no-such.toml` in", "observations"]);
    call(&["search", "seen.toml", "--encounters", "weak-links"]).fails(1, &["16 options"]);
}

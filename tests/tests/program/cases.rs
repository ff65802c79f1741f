//! Validation cases: the cheap ones hold, faults are reported at their places, and the document agrees with the cases.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::common;
use crate::common::{Place, library, text};
use endline_session::cases::{Cases, Effort, Outcome, outcome};
use endline_session::load_plugins;

fn outcome(cases: &Cases, id: &str) -> Outcome {
    let (host, problems) = load_plugins(&[]);
    assert!(problems.is_empty());
    let loaded = cases.load(id).unwrap_or_else(|error| panic!("{error}"));
    cases.run(&loaded, Effort::Plain, &host).unwrap_or_else(|error| panic!("{error}"))
}

fn document() -> String {
    std::fs::read_to_string(endline_tests::root().join("docs/validation.md")).unwrap()
}

/// Cheap cases at their own step and segments; the document has what they expect and how far off they may be.
#[test]
fn quick_cases_pass_and_the_document_says_what_they_expect() {
    let cases = Cases::open(Some(&library())).unwrap();
    let document = document();
    for id in cases.ids().unwrap().iter().filter(|id| cases.load(id).unwrap().case.quick) {
        let outcome = outcome(&cases, id);
        for verdict in &outcome.verdicts {
            let row = document
                .lines()
                .find(|line| line.starts_with(&format!("| {id} | {} |", verdict.name)));
            let row =
                row.unwrap_or_else(|| panic!("docs/validation.md lacks {id}, {}", verdict.name));
            let cells: Vec<&str> = row.split('|').map(str::trim).collect();
            assert_eq!(
                cells[3],
                outcome::value(verdict.expected, verdict.unit),
                "expected in {row}"
            );
            assert_eq!(cells[6], outcome::limit(verdict), "tolerance in {row}");
        }
        let verdicts: Vec<String> = outcome
            .verdicts
            .iter()
            .map(|verdict| format!("{}: {}", verdict.name, verdict.error))
            .collect();
        assert!(outcome.passed, "{id}: {:?} {}", outcome.stopped, verdicts.join(", "));
    }
}

#[test]
fn the_document_names_every_case_with_its_source_and_its_picture() {
    let (cases, document) = (Cases::open(Some(&library())).unwrap(), document());
    let pictures = endline_tests::root().join("docs/pictures/validation");
    for id in cases.ids().unwrap() {
        let case = cases.load(&id).unwrap().case;
        assert!(
            document.contains(&format!("### {id}: {}", case.name)),
            "write docs/validation.md anew: it lacks {id}"
        );
        assert!(
            document.contains(&case.source),
            "write docs/validation.md anew: it lacks the source of {id}"
        );
        let picture = format!("{id}.svg");
        assert_eq!(document.contains(&picture), pictures.join(&picture).is_file(), "{picture}");
    }
}

/// A wrong expectation is found out, and the program says so by its exit code.
#[test]
fn a_wrong_expectation_does_not_pass() {
    let place = Place::new("case-wrong");
    let library = place.library();
    common::edit(
        &library.join("cases/reference-b-static.toml"),
        "expected",
        "expected = \"24.1 N\"",
    );
    let failed =
        place.endline(&["--library", &text(&library), "validate", "reference-b-static", "--plain"]);
    failed.fails(1, &["MISSED", "1 of 1 cases"]);
    assert!(failed.stdout.contains("24.1 N"), "{failed}");
}

#[test]
fn a_case_comes_as_json_with_orders_of_convergence() {
    let place = Place::new("case-json");
    let json = place
        .endline(&["--library", &text(&library()), "validate", "reference-b-static", "--json"])
        .done()
        .json();
    assert_eq!(json["schema"], "endline.validate/1");
    assert_eq!(json["passed"], true);
    let order = json["cases"][0]["verdicts"][2]["segment"]["order"].as_f64().unwrap();
    assert!((order - 2.0).abs() < 0.1, "lumped mass is second order in space: {order}");
}

/// The page and its plots are written where no font of the system is known.
#[test]
fn the_page_of_cases_has_plots_with_text() {
    let place = Place::new("case-page");
    let page = place.path("validation.md");
    let (library, written) = (text(&library()), text(&page));
    place
        .endline(&["--library", &library, "validate", "reference-a-20", "--write", &written])
        .done();
    assert!(std::fs::read_to_string(&page).unwrap().contains("validation/reference-a-20.svg"));
    let plot = place.path("pictures/validation/reference-a-20.svg");
    assert!(std::fs::read_to_string(plot).unwrap().contains("<text"));
}

/// Faults of a case file are reported with file, line and what was expected; `check` and `validate` say the same.
#[test]
fn errors_of_a_case_are_located() {
    let (place, mut whole) = (Place::new("case-faults"), None);
    for (start, line, words) in [
        (
            "measure",
            "measure = \"distanze\"",
            &["reference-a-100.toml:18", "did you mean `distance`"][..],
        ),
        ("measure", "measure = \"rate\"", &["reference-a-100.toml", "`from` is missing"]),
        ("tolerance", "tolerance = \"3 furlongs\"", &["reference-a-100.toml:20", "furlongs"]),
        ("of = ", "of = [[\"end x\", \"end q\"]]", &["no probe `end q`", "middle z"]),
        ("table", "table = \"reference-z\"", &["reference-z.csv"]),
        ("scenario", "scenario = \"reference-q\"", &["reference-a-100.toml:7", "reference-q"]),
        ("rope_nodes", "rope_nodez = \"101\"", &["rope_nodez"]),
        ("at = ", "at = \"rest\"", &["cannot be measured"]),
        ("halve", "halve = [\"mass\"]", &["reference-a-100.toml:10", "step, segment"]),
    ] {
        let library = place.library();
        let case = library.join("cases/reference-a-100.toml");
        common::edit(&case, start, line);
        let library = text(&library);
        place
            .endline(&["--library", &library, "validate", "reference-a-100", "--plain"])
            .fails(1, words);
        place.endline(&["--library", &library, "check", &text(&case)]).fails(1, words);
        whole = Some((library, words));
    }
    // The whole library takes seconds: once is enough.
    let (faulty, words) = whole.unwrap();
    place.endline(&["check", &faulty]).fails(1, words);
    place
        .endline(&["--library", &text(&library()), "validate", "reference-y"])
        .fails(1, &["reference-y", "reference-a-100"]);
}

/// A line drawn through still water from rest approaches the force it has at rest in a current of that speed.
#[test]
fn towing_by_dynamics_and_by_statics_agree() {
    let cases = Cases::open(Some(&library())).unwrap();
    let (at_rest, driven) =
        (outcome(&cases, "towed-reference-lines"), outcome(&cases, "towed-driven"));
    let at_rest: Vec<f64> =
        at_rest.points.iter().filter(|point| point.group == "18").map(|point| point.got).collect();
    assert_eq!(at_rest.len(), driven.points.len());
    for (still, driven) in at_rest.iter().zip(&driven.points) {
        assert!(
            (driven.got / still - 1.0).abs() < 0.02,
            "{} N by dynamics, {still} N by statics",
            driven.got
        );
    }
}

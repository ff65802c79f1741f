//! Obstacles of a scenario: reading, problems, rope laid round a drum.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::path::Path;

use crate::idle::TestHooks;
use endline_gear::{Diagnostic, Library, Options, Scenario, Sources, assemble};
use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::JointKind;
use endline_sim::{DVec3, ModelSpec};

/// The drum of the file, and a box instead.
const DRUM: &str = "shape = \"cylinder\"\nposition = [\"0 m\", \"0 m\", \"-10 m\"]\nradius = \"0.495 m\"\nlength = \"2 m\"";
const BOX: &str = "shape = \"box\"\nposition = [\"9 m\", \"0 m\", \"-10 m\"]\nsize = [\"2 m\", \"1 m\", \"1 m\"]\nheading = \"0 deg\"\npitch = \"30 deg\"";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn drum() -> String {
    std::fs::read_to_string(root().join("scenarios/reference-d-capstan-full.toml")).unwrap()
}

fn read(text: &str) -> Result<ModelSpec, Vec<Diagnostic>> {
    let (library, _) = Library::read(&Sources::from_folder(root()).unwrap());
    assemble(
        &Scenario::read("test.toml", text)?,
        &library,
        &TestHooks::default(),
        &Options::default(),
    )
}

/// The only problem of the full capstan with one change: its line, field and words.
fn refused(from: &str, to: &str, at: &str, words: &[&str]) {
    let text = drum();
    assert!(text.contains(from), "{from}");
    let changed = text.replacen(from, to, 1);
    let line = 1 + changed
        .lines()
        .position(|line| line.contains(at))
        .unwrap_or_else(|| panic!("no line has `{at}`"));
    let problems = read(&changed).err().unwrap_or_else(|| panic!("this is taken: {to}"));
    assert_eq!(problems.len(), 1, "{problems:#?}");
    assert_eq!(problems[0].line, line, "{}", problems[0]);
    words.iter().for_each(|word| {
        assert!(problems[0].to_string().contains(word), "`{}` lacks `{word}`", problems[0])
    });
}

#[test]
fn rope_starts_round_the_drum_and_its_slack_end_is_pulled() {
    let spec = read(&drum()).unwrap_or_else(|problems| panic!("{problems:#?}"));
    let SolidShape::Cylinder { radius_m, half_length_m } = spec.obstacles[0].shape else {
        panic!("no cylinder")
    };
    assert_eq!((radius_m, half_length_m, spec.obstacles[0].friction), (0.495, 1.0, 0.3));
    assert_eq!(
        spec.joints[0].kind,
        JointKind::Pulled { force_n: DVec3::new(0.0, -50.0, 0.0), from_s: 0.0 }
    );
    let line = &spec.lines[0];
    let stretch: f64 =
        line.start_m.windows(2).map(|ends| (ends[1] - ends[0]).length()).sum::<f64>()
            / line.segments_m.iter().sum::<f64>();
    assert!((stretch - 1.0).abs() < 1e-4, "{stretch}");
    let touching =
        line.start_m.iter().filter(|node| (libm::hypot(node.x, node.y) - 0.5).abs() < 1e-9).count();
    assert_eq!(touching, 219, "of 500 segments, those between 2 m and 5.1416 m of 7.1416 m");
}

#[test]
fn mistakes_are_reported_with_their_places() {
    refused(
        "friction = 0.3",
        "friction = -0.3",
        "friction = -0.3",
        &["`friction` is -0.3", "between 0 and 10"],
    );
    refused("friction = 0.3\n", "", "[[obstacle]]", &["`friction` is missing"]);
    refused("shape = \"cylinder\"", "shape = \"cone\"", "cone", &["plane, sphere, cylinder"]);
    refused("length = \"2 m\"", "length = \"2 m\"\naxis = [0, 0, 0]", "axis", &["has no length"]);
    refused(
        DRUM,
        &BOX.replace("\"1 m\", \"1 m\"", "\"0 m\", \"1 m\""),
        "size",
        &["`size` is not above zero"],
    );
    refused(
        "around = \"drum\"",
        "around = \"drun\"",
        "drun",
        &["no obstacle `drun`", "did you mean `drum`"],
    );
    refused(
        "\"0.5 m\", \"-2 m\", \"-10.01 m\"",
        "\"0.3 m\", \"0 m\", \"-10.01 m\"",
        "around = \"drum\"",
        &["is inside `drum`"],
    );
    refused(
        "force = [",
        "velocity = [\"1 m/s\", \"0 m/s\", \"0 m/s\"]\nforce = [",
        "force = [",
        &["both a `velocity` and a `force`"],
    );
    refused("force = [", "until = \"1 s\"\nforce = [", "until", &["a `force` has no `until`"]);
}

#[test]
fn a_box_has_the_written_orientation() {
    let straight = "start = \"around\"\naround = \"drum\"\nturns = 1.0";
    let text = drum();
    assert!(text.contains(DRUM) && text.contains(straight));
    let spec = read(&text.replacen(DRUM, BOX, 1).replacen(straight, "", 1))
        .unwrap_or_else(|problems| panic!("{problems:#?}"));
    let front = spec.obstacles[0].orientation * DVec3::X;
    let pitch = 30.0_f64.to_radians();
    assert!(
        (front - DVec3::new(0.0, libm::cos(pitch), libm::sin(pitch))).length() < 1e-12,
        "{front}"
    );
}

//! Joint ranges of a whale's file.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::path::Path;

use endline_gear::{Confidence, Library, Sources};
use endline_sim::whale::{Angle, JointRanges};

const FILE: &str = "whales/right-whale.toml";

fn text() -> String {
    let sources = Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    sources.get(FILE).unwrap().to_owned()
}

/// Every range exists, includes the rest posture and has a source.
#[test]
fn the_right_whale_has_ranges_with_sources() {
    let sources = Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let whales = Library::read(&sources).0.whales;
    assert!(!whales.is_empty());
    for whale in whales {
        let joints = whale.joints;
        for angle in Angle::all() {
            let [least, most] = joints.ranges.of(angle);
            assert!(least <= 0.0 && most >= 0.0 && least < most, "{angle:?} of {}", whale.entry.id);
        }
        assert!(joints.ranges.spine_total.iter().all(|total| *total > 0.0));
        assert!(joints.figures.iter().all(
            |(_, figure)| figure.confidence == Confidence::Estimate && figure.source.len() > 10
        ));
        assert_eq!(joints.ranges.random(7), joints.ranges.random(7));
    }
}

/// The bounds of the published working ranges: the whole spine to the side, up and down; flippers; flukes.
#[test]
fn the_right_whale_bends_as_far_as_is_written_of_it() {
    let sources = Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let whales = Library::read(&sources).0.whales;
    let JointRanges { spine_total: [pitch, yaw, roll], .. } =
        whales.iter().find(|whale| whale.entry.id == "right-whale").unwrap().joints.ranges;
    assert!(
        (40.0..=60.0 + 1e-9).contains(&pitch.to_degrees())
            && (60.0..=90.0).contains(&yaw.to_degrees())
    );
    assert!((10.0..=20.0 + 1e-9).contains(&roll.to_degrees()));
    let ranges = whales[0].joints.ranges;
    assert!(ranges.of(Angle::SpineYaw(0))[1].to_degrees() <= 10.0, "the neck is fused");
    assert!((ranges.of(Angle::FlukePitch)[1].to_degrees() - 45.0).abs() < 1e-9);
}

/// The problems of a changed file with their places.
#[track_caller]
fn refused(from: &str, to: &str, message: &str, help: &str) {
    let good = text();
    assert!(good.contains(from), "`{from}` is no longer in {FILE}");
    let problems = Library::check_file(FILE, &good.replacen(from, to, 1));
    let reported: Vec<String> = problems
        .iter()
        .map(|problem| format!("{} | {} | {}", problem.line, problem.message, problem.help))
        .collect();
    let found = problems.iter().any(|problem| {
        problem.line > 0 && problem.message.contains(message) && problem.help.contains(help)
    });
    assert!(found, "wanted `{message}` and `{help}`, got {reported:#?}");
}

#[test]
fn invalid_ranges_are_reported_with_their_places() {
    assert!(Library::check_file(FILE, &text()).is_empty());
    refused("jaw = { least = \"0 deg\"", "jaw = { least = \"5 deg\"", "`least` is", "between");
    refused(
        "jaw = { least = \"0 deg\", most = \"30 deg\",",
        "jaw = { least = \"0 deg\",",
        "`most` is missing",
        "such as 10 deg",
    );
    refused("fluke_pitch = {", "fluke_pich = {", "unknown field `fluke_pich`", "fluke_pitch");
    refused("fluke_pitch = {", "fluke_pich = {", "`fluke_pitch` is missing", "least");
    refused("each = [\"5 deg\", ", "each = [", "`each` has 7 angles", "one for each spine joint");
    refused("each = [\"5 deg\", ", "each = [\"5 m\", ", "`m` is a unit of a length", "deg");
    refused("total = \"75 deg\"", "", "`total` is missing", "such as 10 deg");
}

//! Recordings as users have them: they replay bit for bit, and every damage is told by its place.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking, in its helpers too")]

mod common;

use std::fs;

use common::Place;

/// Records a run and gives the file.
fn record(place: &Place) -> String {
    let scenario = place.encounter();
    place.endline(&["run", &scenario, "--out", "."]).done();
    "recording.endline".into()
}

/// Where the inputs of a recording lie: after the tag, the length and the hash of their section.
fn inputs(bytes: &[u8]) -> std::ops::Range<usize> {
    let tag = bytes.windows(4).position(|window| window == b"INPT").unwrap();
    let length = u64::from_le_bytes(bytes[tag + 4..tag + 12].try_into().unwrap());
    let start = tag + 4 + 8 + 32;
    start..start + usize::try_from(length).unwrap()
}

#[test]
fn a_recording_verifies_and_gives_the_same_summary() {
    let place = Place::new("verify");
    let file = record(&place);
    let recorded: serde_json::Value = serde_json::from_str(&fs::read_to_string(place.path("summary.json")).unwrap()).unwrap();
    assert!(recorded["whale"]["first_contact_s"].is_number(), "the rope was never touched");
    let verified = place.endline(&["replay", &file, "--verify", "--json"]).done().json();
    assert_eq!(verified["verified"], true);
    assert_eq!(verified["steps"], recorded["steps"]);
    // What was measured is the same to the last digit; what it took in real time is not.
    for key in ["state_hash", "simulated_s", "audit", "lines", "links", "bodies", "probes", "whale", "events", "model_hash", "plugins"] {
        assert_eq!(verified["run"][key], recorded[key], "{key}");
    }
}

#[test]
fn one_changed_input_byte_is_found_at_its_step() {
    let place = Place::new("flip");
    let file = record(&place);
    let whole = fs::read(place.path(&file)).unwrap();
    let inputs = inputs(&whole);
    for (step, byte) in [(1, 0), (7, 63), (50, 13), (inputs.len() / 64, 42)] {
        let mut changed = whole.clone();
        changed[inputs.start + (step - 1) * 64 + byte] ^= 1;
        fs::write(place.path("changed.endline"), &changed).unwrap();
        let told = format!("step {step} ");
        place
            .endline(&["replay", "changed.endline", "--verify"])
            .fails(1, &[&told, "input differs", "changed after the recording was saved"]);
        place.endline(&["replay", "changed.endline"]).fails(1, &["--verify"]);
    }
}

#[test]
fn cut_short_changed_or_foreign_files_are_refused() {
    let place = Place::new("damage");
    let file = record(&place);
    let whole = fs::read(place.path(&file)).unwrap();
    for length in [0, 5, 11, 100, whole.len() / 2, whole.len() - 1] {
        fs::write(place.path("short.endline"), &whole[..length]).unwrap();
        let refused = place.endline(&["replay", "short.endline", "--verify"]);
        refused.fails(1, &["short.endline", "expected"]);
    }
    let mut changed = whole.clone();
    let hashes = inputs(&whole).end + 4 + 8 + 32;
    changed[hashes + 3] ^= 1;
    fs::write(place.path("changed.endline"), &changed).unwrap();
    place.endline(&["replay", "changed.endline", "--verify"]).fails(1, &["state hashes", "BLAKE3"]);
    fs::write(place.path("other.endline"), "a letter, not a recording, though long enough to be one").unwrap();
    place.endline(&["replay", "other.endline"]).fails(1, &["is no recording"]);
}

#[test]
fn a_time_outside_the_recording_is_refused() {
    let place = Place::new("render");
    let file = record(&place);
    let refused = place.endline(&["render", &file, "--at", "99", "--out", "late.png"]);
    assert!(matches!(refused.code, Some(1 | 2)) && !refused.stderr.contains("panicked"), "{refused}");
    assert!(!place.path("late.png").exists());
}

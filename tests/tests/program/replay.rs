//! Recordings as users have them: they replay bit for bit, and every damage is reported at its place.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::fs;

use crate::common::Place;

/// Bytes of the input of one step: ten numbers.
const INPUT_BYTES: usize = 80;

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
    let recorded: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(place.path("summary.json")).unwrap()).unwrap();
    assert!(recorded["whale"]["first_contact_s"].is_number(), "the rope was never touched");
    let verified = place.endline(&["replay", &file, "--verify", "--json"]).done().json();
    assert_eq!(verified["verified"], true);
    assert_eq!(verified["steps"], recorded["steps"]);
    // What was measured is the same to the last digit; what it took in real time is not.
    for key in [
        "state_hash",
        "simulated_s",
        "audit",
        "lines",
        "links",
        "bodies",
        "probes",
        "whale",
        "events",
        "model_hash",
        "plugins",
    ] {
        assert_eq!(verified["run"][key], recorded[key], "{key}");
    }
}

#[test]
fn one_changed_input_byte_is_found_at_its_step() {
    let place = Place::new("flip");
    let file = record(&place);
    let whole = fs::read(place.path(&file)).unwrap();
    let inputs = inputs(&whole);
    for (step, byte) in [(1, 0), (7, 63), (50, 13), (inputs.len() / INPUT_BYTES, 42)] {
        let mut changed = whole.clone();
        changed[inputs.start + (step - 1) * INPUT_BYTES + byte] ^= 1;
        fs::write(place.path("changed.endline"), &changed).unwrap();
        let place_of_step = format!("step {step} ");
        place
            .endline(&["replay", "changed.endline", "--verify"])
            .fails(1, &[&place_of_step, "input differs", "changed after the recording was saved"]);
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
    fs::write(
        place.path("other.endline"),
        "a letter, not a recording, though long enough to be one",
    )
    .unwrap();
    place.endline(&["replay", "other.endline"]).fails(1, &["is no recording"]);
}

#[test]
fn a_time_outside_the_recording_is_refused() {
    let place = Place::new("render");
    let file = record(&place);
    let refused = place.endline(&["render", &file, "--at", "99s", "--out", "late.png"]);
    assert!(
        matches!(refused.code, Some(1 | 2)) && !refused.stderr.contains("panicked"),
        "{refused}"
    );
    assert!(!place.path("late.png").exists());
    // A scenario is run to its end, which is said whether or not the machine can draw.
    let scenario = place.encounter();
    let late = place.endline(&["render", &scenario, "--at", "99s", "--out", "late.png"]);
    assert!(late.stderr.contains("the run ends at"), "{late}");
}

#[test]
fn a_stretch_of_a_recording_is_a_film_and_what_is_no_stretch_is_refused() {
    let place = Place::new("film");
    let file = record(&place);
    let film = ["--from", "0s", "--to", "0.2s", "--fps", "10", "--size", "160x90"];
    let call = |out: &str, options: &[&str]| {
        let mut words = vec!["render", &file, "--out", out];
        words.extend(options);
        place.endline(&words)
    };
    call("run.gif", &film).done();
    let bytes = fs::read(place.path("run.gif")).unwrap();
    assert!(bytes.starts_with(b"GIF89a"));
    assert_eq!(u16::from_le_bytes([bytes[6], bytes[7]]), 160, "its width");
    // Each picture has a graphic control extension of its own.
    let pictures = bytes.windows(3).filter(|bytes| *bytes == [0x21, 0xf9, 0x04]).count();
    assert_eq!(pictures, 3, "at 0, 0.1 and 0.2 s");
    call("run.png", &film).fails(2, &["run.png is no film", ".gif, .mp4, .webm or .glb"]);
    call("late.gif", &["--from", "0.1s", "--to", "99s"])
        .fails(2, &["--to 99s", "no stretch of a run"]);
    call("both.gif", &["--from", "0s", "--at", "1s"]).fails(2, &["--at"]);
}

/// A scenario of the encounter whose pilot turns, opens the mouth and works the flippers, by time and by what happens.
fn flown(place: &Place) -> String {
    let scenario = place.encounter();
    let text = fs::read_to_string(&scenario).unwrap();
    let pilot = "\n[[whale.pilot]]\nat = \"0.3 s\"\nramp = \"0.2 s\"\nyaw = 0.25\nflipper_sweep = -0.5\n\
        \n[[whale.pilot]]\nwithin = \"100 m\"\ndelay = \"0.105 s\"\nhold = \"0.4 s\"\nroll = -0.3\nmouth = 1.0\n";
    fs::write(&scenario, text + pilot).unwrap();
    scenario
}

fn summary(place: &Place, folder: &str) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(place.path(folder).join("summary.json")).unwrap())
        .unwrap()
}

#[test]
fn a_recording_written_as_a_pilot_program_gives_the_same_bits_and_an_edit_changes_what_follows_it()
{
    let place = Place::new("program");
    let scenario = flown(&place);
    place.endline(&["run", &scenario, "--out", "first", "--seed", "3"]).done();
    let recording = "first/recording.endline";
    let said = place
        .endline(&["pilot", recording, "--out", "gear-library/scenarios/flown.toml"])
        .done()
        .stdout;
    assert!(said.contains("endline run gear-library/scenarios/flown.toml --seed 3"), "{said}");
    place
        .endline(&["run", "gear-library/scenarios/flown.toml", "--seed", "3", "--out", "again"])
        .done();
    let (first, again) = (summary(&place, "first"), summary(&place, "again"));
    assert_eq!(first["state_hash"], again["state_hash"]);
    assert_eq!(first["steps"], again["steps"]);

    // The recorded ramp is 20 steps of its own; thinned by a tenth of the control, fewer are left.
    let entries = |file: &str| {
        fs::read_to_string(place.path(file)).unwrap().matches("[[whale.pilot]]").count()
    };
    place
        .endline(&[
            "pilot",
            recording,
            "--out",
            "gear-library/scenarios/thin.toml",
            "--thin",
            "0.1",
        ])
        .done();
    assert!(
        entries("gear-library/scenarios/thin.toml") + 10
            < entries("gear-library/scenarios/flown.toml"),
        "{} of {}",
        entries("gear-library/scenarios/thin.toml"),
        entries("gear-library/scenarios/flown.toml")
    );

    // An entry edited at half a second: the states before are the recorded ones, the end is another.
    let text = fs::read_to_string(place.path("gear-library/scenarios/flown.toml")).unwrap();
    let last = text.rfind("roll = 0.0").unwrap();
    fs::write(
        place.path("gear-library/scenarios/edited.toml"),
        format!("{}roll = 0.5{}", &text[..last], &text[last + "roll = 0.0".len()..]),
    )
    .unwrap();
    let at = edited_s(&text[..last]);
    let before = format!("{at:.3}s");
    place
        .endline(&[
            "run",
            "gear-library/scenarios/edited.toml",
            "--from",
            recording,
            "--at",
            &before,
            "--out",
            "edited",
        ])
        .done();
    assert_ne!(summary(&place, "edited")["state_hash"], first["state_hash"]);
    let verified = place.endline(&["replay", "edited/recording.endline", "--verify"]);
    assert_eq!(verified.code, Some(0), "{verified}");
}

/// Time of the last entry of a program [s].
fn edited_s(text: &str) -> f64 {
    let at = text.rfind("at = \"").unwrap() + "at = \"".len();
    text[at..].split(' ').next().unwrap().parse().unwrap()
}

#[test]
fn taking_over_with_the_program_that_flew_changes_nothing_and_with_other_gear_is_refused() {
    let place = Place::new("takeover");
    let scenario = flown(&place);
    place.endline(&["run", &scenario, "--out", "first"]).done();
    let recording = "first/recording.endline";
    place
        .endline(&["run", &scenario, "--from", recording, "--at", "0.45s", "--out", "again"])
        .done();
    assert_eq!(summary(&place, "first")["state_hash"], summary(&place, "again")["state_hash"]);

    let text = fs::read_to_string(&scenario).unwrap();
    fs::write(
        place.path("gear-library/scenarios/gear.toml"),
        text.replace("speed = \"1.3 m/s\"", "speed = \"1.2 m/s\""),
    )
    .unwrap();
    place
        .endline(&["run", "gear-library/scenarios/gear.toml", "--from", recording, "--at", "0.45s"])
        .fails(1, &["not the one recorded", "step 0", "whale"]);
    place
        .endline(&["run", &scenario, "--from", recording, "--at", "1e9s"])
        .fails(1, &["outside the recording"]);
    place.endline(&["run", &scenario, "--from", recording]).fails(2, &["--at"]);
}

//! Interrupted as terminals and batch systems do it: results so far are stored and printed, with the command that continues.
#![cfg(target_os = "linux")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Called, Place, edit, text};
use crate::studies::{blocks, small, table};

/// Waits until something is so.
fn wait(what: &str, mut so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !so() {
        assert!(start.elapsed() < Duration::from_secs(120), "never came: {what}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Whether a process has a handler of its own for a signal.
fn handles(child: &Child, signal: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
    u64::from_str_radix(caught.trim(), 16).unwrap() >> (signal - 1) & 1 == 1
}

fn send(child: &Child, signal: &str) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

fn ended(child: Child) -> Called {
    let output = child.wait_with_output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    Called { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

fn started(place: &Place, arguments: &[&str]) -> Child {
    place.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn an_interrupted_run_prints_its_summary_and_its_recording_continues() {
    let place = Place::new("interrupted-run");
    let scenario = place.encounter();
    edit(scenario.as_ref(), "duration", "duration = \"900 s\"");
    let out = place.path("out");
    let child = started(&place, &["run", &scenario, "--out", out.to_str().unwrap(), "--json"]);
    wait("a handler", || handles(&child, 15));
    std::thread::sleep(Duration::from_millis(300));
    send(&child, "-TERM");
    let called = ended(child);
    called.fails(143, &["interrupted at", "to continue from there", "--from", "recording.endline"]);
    let json = called.json();
    assert!(json["stopped"].as_str().unwrap().contains("it was interrupted"), "{called}");
    let recording = text(&out.join("recording.endline"));
    place.endline(&["replay", &recording, "--verify"]).done();

    edit(scenario.as_ref(), "duration", "duration = \"2.5 s\"");
    let simulated_s = json["simulated_s"].as_f64().unwrap();
    let at = format!("{}s", simulated_s.min(2.0));
    place.endline(&["run", &scenario, "--from", &recording, "--at", &at]).done();
}

#[test]
fn a_run_under_nohup_outlives_its_terminal() {
    let place = Place::new("nohup");
    let scenario = place.encounter();
    edit(scenario.as_ref(), "duration", "duration = \"900 s\"");
    let program = text(&endline_tests::program().unwrap());
    let mut command = Command::new("sh");
    command.args(["-c", "trap '' HUP; exec \"$@\"", "sh", &program, "run", &scenario]);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    wait("a handler", || handles(&child, 15));
    assert!(!handles(&child, 1), "SIGHUP stays ignored");
    send(&child, "-HUP");
    send(&child, "-TERM");
    ended(child).fails(143, &["interrupted at"]);
}

#[test]
fn an_interrupted_study_keeps_its_encounters_and_the_same_command_continues() {
    let place = Place::new("interrupted-study");
    let study = small(&place);
    edit(study.as_ref(), "encounters", "encounters = 10");
    let [cut, whole] = ["cut", "whole"].map(|name| place.path(name));
    let arguments = ["study", "run", &study, "--out", cut.to_str().unwrap(), "--threads", "1"];
    let child = started(&place, &arguments);
    wait("an encounter", || blocks(&cut) > 0);
    send(&child, "-INT");
    let called = ended(child);
    called.fails(130, &["interrupted:", "of 10 encounters are kept", "the same command continues"]);
    let kept = blocks(&cut);
    assert!((1..10).contains(&kept), "{kept} encounters were kept");
    place.endline(&arguments).done();
    let [cut, whole] = [cut, whole].map(|folder| {
        let to = folder.to_str().unwrap();
        place.endline(&["study", "run", &study, "--out", to]).done();
        place.endline(&["study", "merge", &study, "--out", to]).done();
        table(&folder)
    });
    assert_eq!(cut, whole);
}

#[test]
fn a_recording_that_cannot_be_kept_costs_no_summary() {
    let place = Place::new("full");
    let scenario = place.encounter();
    // A folder stands where the recording would be written, as a full disk would refuse it.
    fs::create_dir_all(place.path("out/recording.endline")).unwrap();
    let out = place.path("out");
    let called = place.endline(&["run", &scenario, "--out", out.to_str().unwrap(), "--json"]);
    called.fails(1, &["recording.endline", "cannot be written"]);
    assert!(called.json()["state_hash"].is_string(), "{called}");
}

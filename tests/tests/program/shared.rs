//! One folder, several processes: they share a study's encounters, and one that is killed costs those under way alone.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};

use crate::common::Place;
use crate::studies::{blocks, small, table};

/// Encounters of the study.
const ENCOUNTERS: usize = 60;

/// The small study with more encounters, each of them longer.
fn study(place: &Place) -> String {
    let study = small(place);
    let edit = |file: &Path, from: &str, to: &str| {
        let text = fs::read_to_string(file).unwrap();
        assert!(text.contains(from));
        fs::write(file, text.replace(from, to)).unwrap();
    };
    edit(Path::new(&study), "encounters = 10", &format!("encounters = {ENCOUNTERS}"));
    let scenario = Path::new(&study).with_file_name("small.toml");
    edit(&scenario, "duration = \"0.5 s\"", "duration = \"1 s\"");
    study
}

fn begin(place: &Place, study: &str, out: &str) -> Child {
    let arguments = ["study", "run", study, "--out", out, "--threads", "1"];
    let mut command = place.command(&arguments);
    command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap()
}

/// How many blocks a process has run, by its own words.
fn new_blocks(process: Child) -> usize {
    let output = process.wait_with_output().unwrap();
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let words: Vec<&str> = text.split_whitespace().collect();
    let at = words.windows(3).position(|words| words[1..] == ["of", "them"]).unwrap();
    words[at].parse().unwrap()
}

#[test]
fn processes_on_one_folder_share_the_work_and_continue_that_of_a_killed_one() {
    let place = Place::new("study-shared");
    let study = study(&place);
    let out = |name: &str| place.folder.join(name).display().to_string();
    place.endline(&["study", "run", &study, "--out", &out("alone")]).done();
    place.endline(&["study", "merge", &study, "--out", &out("alone")]).done();

    let shared = out("shared");
    place
        .endline(&["study", "status", &study, "--out", &shared])
        .done()
        .prints(&[&format!("0 of {ENCOUNTERS} encounters"), "no process"]);
    let mut processes: Vec<Child> = (0..3).map(|_| begin(&place, &study, &shared)).collect();
    let folder = Path::new(&shared);
    while blocks(folder) < 6 {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let status =
        place.endline(&["study", "status", &study, "--out", &shared, "--json"]).done().json();
    assert_eq!(status["schema"], "endline.study_status/1");
    let seen = status["processes"].as_array().unwrap();
    let pids: Vec<u64> = seen.iter().map(|process| process["pid"].as_u64().unwrap()).collect();
    for process in &processes {
        assert!(pids.contains(&process.id().into()), "{pids:?}");
    }
    let mut killed = processes.remove(0);
    killed.kill().unwrap();
    killed.wait().unwrap();
    let others: usize = processes.into_iter().map(new_blocks).sum();
    assert_eq!(blocks(folder), ENCOUNTERS, "who ends well leaves nothing to be done");
    assert!(others < ENCOUNTERS, "{others} of {ENCOUNTERS} were run by two of three");
    place.endline(&["study", "merge", &study, "--out", &shared]).done();
    assert_eq!(table(folder), table(Path::new(&out("alone"))));
    assert!(!folder.join("leases").exists());
}

/// `sbatch` is a script here that notes its arguments and runs the job's script at once.
#[cfg(unix)]
#[test]
fn jobs_for_slurm_run_the_study_and_report_it() {
    use std::os::unix::fs::PermissionsExt;

    let place = Place::new("study-slurm");
    let study = small(&place);
    let out = place.folder.join("it's results");
    let results = out.to_str().unwrap();
    let submit =
        ["study", "submit", &study, "--slurm", "--array", "3", "--cpus", "2", "--time", "01:00:00"];
    let submit: Vec<&str> = submit.into_iter().chain(["--out", results]).collect();
    let dry: Vec<&str> =
        submit.iter().copied().chain(["--account", "whales", "--dry-run"]).collect();
    place.endline(&dry).done().prints(&[
        "#SBATCH --array=1-3\n",
        "#SBATCH --cpus-per-task=2\n",
        "#SBATCH --time=01:00:00\n",
        "#SBATCH --account=whales\n",
        "#SBATCH --requeue\n",
        "it'\\''s results",
    ]);
    assert!(!out.exists(), "a dry run makes nothing");
    place
        .endline(&[&submit[..], &["--account", "a\nb"]].concat())
        .fails(2, &["--account", "letters"]);

    let empty = place.folder.join("empty");
    fs::create_dir_all(&empty).unwrap();
    let called = crate::common::called(place.command(&submit).env("PATH", &empty));
    called.fails(1, &["sbatch cannot be started", "--dry-run"]);

    let sbatch = empty.join("sbatch");
    let script = "#!/bin/sh\nPATH=/usr/bin:/bin\necho \"$@\" >> \"${0%/*}/calls\"\nfor last; do :; done\nsh \"$last\" >&2 && echo '41;cluster'\n";
    fs::write(&sbatch, script).unwrap();
    fs::set_permissions(&sbatch, fs::Permissions::from_mode(0o755)).unwrap();
    let called = crate::common::called(place.command(&submit).env("PATH", &empty));
    called.done().prints(&["job 41: 3 tasks run 10 encounters", "study status"]);
    let calls = fs::read_to_string(empty.join("calls")).unwrap();
    let calls: Vec<&str> = calls.lines().collect();
    assert_eq!(calls.len(), 2);
    assert!(calls[0].starts_with("--parsable /") && calls[0].ends_with("slurm-run.sh"));
    assert!(calls[1].starts_with("--parsable --dependency=afterany:41 "));
    assert!(out.join("report.html").is_file() && out.join("table.csv").is_file());
}

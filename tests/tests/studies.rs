//! Studies as their users run them: the same table for any threads, shards and kills, and clear errors that lose nothing.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking, in its helpers too")]

mod common;

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use common::{Place, library};

/// Ten short draws of a small rig without a whale: what is checked here is the running, not the physics.
const STUDY: &str = r#"
format = 1
kind = "study"
name = "Small"
scenario = "small.toml"
encounters = 10
baseline = "none"

[[option]]
id = "none"
set = { weak_links = false }

[[option]]
id = "same"
set = { weak_links = false }

[[option]]
id = "weak"
strength = "5 N"
set = { "link.0.rating" = "5 N" }

[[option]]
id = "strong"
strength = "600 lbf"
set = { "link.0.rating" = "600 lbf" }

[encounter."body.0.drag_area"]
uniform = ["0.1 m2", "0.3 m2"]
source = "assumed"

[encounter.tide]
choice = ["0.2 m/s", "0.5 m/s"]
source = "assumed"
"#;

/// The shipped study scenario, shorter, coarser, and with no whale; its study in a library of the test's own.
fn small(place: &Place) -> String {
    let folder = place.library().join("studies");
    let scenario = fs::read_to_string(library().join("scenarios/study-endline-held.toml")).unwrap();
    let (gear, _) = scenario.split_once("[whale]").unwrap();
    let gear = gear.replace("duration = \"75 s\"", "duration = \"0.5 s\"").replace("rope_nodes = 160", "rope_nodes = 12");
    let scenario = gear.replace("[resolution]\nnear = \"0.15 m\"\n", "");
    fs::write(folder.join("small.toml"), scenario).unwrap();
    let study = folder.join("study.toml");
    fs::write(&study, STUDY).unwrap();
    study.display().to_string()
}

fn table(folder: &Path) -> Vec<u8> {
    fs::read(folder.join("table.parquet")).unwrap()
}

#[test]
fn the_table_is_the_same_for_any_threads_shards_and_kills() {
    let place = Place::new("study-table");
    let study = small(&place);
    let out = |name: &str| place.folder.join(name).display().to_string();
    place.endline(&["study", "run", &study, "--out", &out("one"), "--threads", "1"]).done();
    place.endline(&["study", "merge", &study, "--out", &out("one")]).done();
    let whole = table(&place.folder.join("one"));

    place.endline(&["study", "run", &study, "--out", &out("two"), "--threads", "2"]).done();
    place.endline(&["study", "merge", &study, "--out", &out("two")]).done();
    assert_eq!(table(&place.folder.join("two")), whole, "two threads");

    for shards in [3, 7] {
        let folder = out(&format!("of-{shards}"));
        place.endline(&["study", "run", &study, "--out", &folder, "--shard", &format!("2/{shards}")]).done();
        place.endline(&["study", "merge", &study, "--out", &folder]).fails(1, &["lacks", "block"]);
        for shard in (1..=shards).rev() {
            place.endline(&["study", "run", &study, "--out", &folder, "--shard", &format!("{shard}/{shards}")]).done();
        }
        place.endline(&["study", "merge", &study, "--out", &folder]).done();
        assert_eq!(table(Path::new(&folder)), whole, "{shards} shards");
    }

    for kill in 1..=4 {
        let arguments = ["study", "run", &study, "--out", &out("killed"), "--threads", "1"];
        let mut child = place.command(&arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(60 * kill));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    place.endline(&["study", "run", &study, "--out", &out("killed")]).done();
    place.endline(&["study", "merge", &study, "--out", &out("killed")]).done();
    assert_eq!(table(&place.folder.join("killed")), whole, "after kills");

    findings(&place, &study, &out("one"));
}

/// What the table says of options that are the same, and of a link that parts at a touch.
fn findings(place: &Place, study: &str, out: &str) {
    let found = place.endline(&["study", "report", study, "--out", out, "--json"]).done().json();
    let option = |id: &str| found["options"].as_array().unwrap().iter().find(|option| option["id"] == id).unwrap().clone();
    for (event, paired) in option("same")["against"].as_array().unwrap().iter().map(|pair| (&pair[0], &pair[1])) {
        assert_eq!(paired["difference"].as_f64(), Some(0.0), "{event}");
        assert_eq!(paired["only_this"], 0, "{event}");
    }
    assert_eq!(option("same")["tensions"]["sorted_n"], option("none")["tensions"]["sorted_n"]);
    let rows = fs::read_to_string(Path::new(out).join("table.csv")).unwrap();
    let parted = |id: &str| rows.lines().filter(|row| row.split(',').nth(1) == Some(id) && row.contains(",buoy-link,")).count();
    assert!(parted("weak") > 0, "a link of 5 N bears no buoy in a running tide");
    assert_eq!([parted("strong"), parted("none")], [0, 0], "one of 600 lbf does");

    let page = fs::read_to_string(Path::new(out).join("report.html")).unwrap();
    assert!(page.matches("<svg").count() >= 5 && page.contains("given an encounter") && page.contains("lbf"), "the figures are inside");
    assert!(!page.contains("NaN") && !page.contains("<script"));

    let replayed = place.endline(&["study", "replay", study, "--out", out, "--row", "3", "--option", "weak"]).done();
    assert!(replayed.stderr.contains("ends in the state that the table has"), "{replayed}");
    let strong = place.endline(&["study", "replay", study, "--out", out, "--row", "3", "--option", "strong"]).done();
    assert!(strong.stderr.contains("ends in the state that the table has"), "a shared row is the run it stands for: {strong}");

    // The bundle is the same study: its hash fits the folder's.
    let bundle = Path::new(out).join("bundle");
    let bundled = bundle.join("study.toml").display().to_string();
    let library = bundle.join("gear-library").display().to_string();
    place.endline(&["study", "merge", &bundled, "--library", &library, "--out", out]).done();
}

#[test]
fn mistakes_are_told_at_their_place() {
    let place = Place::new("study-mistakes");
    let study = small(&place);
    let plan = |from: &str, to: &str| {
        assert!(STUDY.contains(from), "{from}");
        fs::write(&study, STUDY.replace(from, to)).unwrap();
        place.endline(&["study", "plan", &study])
    };
    plan("encounters = 10", "encountres = 10").fails(1, &["study.toml:6:1", "unknown field `encountres`", "did you mean `encounters`?"]);
    plan("\"link.0.rating\" = \"5 N\"", "\"link.0.rating\" = \"0 lbf\"").fails(1, &["study.toml", "option `weak`", "above zero"]);
    plan("baseline = \"none\"", "baseline = \"noen\"").fails(1, &["no option `noen`", "did you mean `none`?"]);
    plan("[encounter.tide]", "[encounter.tied]").fails(1, &["`tied`", "did you mean `tide`?"]);
    plan("\"link.0.rating\" = \"5 N\"", "\"link.0.ratign\" = \"5 N\"")
        .fails(1, &["unknown field `ratign`", "did you mean `rating`?", "study.toml"]);
    plan("source = \"assumed\"\n\n[encounter.tide]", "\n[encounter.tide]").fails(1, &["`source` is missing", "assumed"]);
    plan("scenario = \"small.toml\"", "scenario = \"hello-endlin\"").fails(1, &["did you mean `hello-endline`?"]);

    fs::write(&study, STUDY).unwrap();
    place.endline(&["study", "replay", &study, "--row", "3", "--option", "week"]).fails(1, &["no option `week`", "did you mean `weak`?"]);
    place.endline(&["study", "run", &study, "--shard", "8/7"]).fails(2, &["2/7"]);
    place.endline(&["study", "report", &study, "--out", &place.folder.join("no").display().to_string()]).fails(1, &["merge"]);
}

#[test]
fn a_folder_keeps_to_its_study_and_a_full_disk_loses_nothing() {
    let place = Place::new("study-folder");
    let study = small(&place);
    let out = place.folder.join("out");
    let arguments = ["study", "run", &study, "--out", &out.display().to_string(), "--shard", "1/3"];
    place.endline(&arguments).done();
    fs::write(&study, STUDY.replace("0.3 m2", "0.4 m2")).unwrap();
    place.endline(&arguments).fails(1, &["belongs to the study", "--out"]);
    // A study made longer is the same study, and so is one with its tables in another order.
    fs::write(&study, STUDY.replace("encounters = 10", "encounters = 14")).unwrap();
    let longer = place.endline(&arguments).done();
    assert!(longer.stdout.contains("1 of them new") || longer.stdout.contains("0 of them new"), "{longer}");

    // A name that cannot be written stands for a full disk: the block before it stays whole.
    fs::write(&study, STUDY).unwrap();
    let before = fs::read(out.join("block-00000.parquet")).unwrap();
    fs::create_dir(out.join("block-00001.parquet")).unwrap();
    fs::write(out.join("block-00001.parquet/in-the-way"), "").unwrap();
    let second = ["study", "run", &study, "--out", &out.display().to_string(), "--shard", "2/3"];
    place.endline(&second).fails(1, &["block-00001.parquet", "cannot be written", "goes on from them"]);
    assert_eq!(fs::read(out.join("block-00000.parquet")).unwrap(), before);
    fs::remove_dir_all(out.join("block-00001.parquet")).unwrap();
    place.endline(&second).done();
}

#[test]
fn every_shipped_study_assembles() {
    let place = Place::new("study-shipped");
    let folder = library().join("studies");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(!files.is_empty());
    for file in files {
        let plan = place.endline(&["study", "plan", &file.display().to_string(), "--json"]).done().json();
        assert_eq!(plan["study"], file.file_stem().unwrap().to_string_lossy().as_ref());
    }
}

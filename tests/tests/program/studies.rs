//! Studies as their users run them: the same table for any threads, shards and kills, and clear errors that lose nothing.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use crate::common;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Instant;

use endline_gear::{Study, StudyOption};

use crate::common::{Place, library};

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

/// Folders of the library that the small study looks at; every call of the program reads them all.
const NEEDED: [&str; 6] = ["friction", "knots", "ropes", "scenarios", "sites", "weak-links"];

/// The shipped study scenario, shorter, coarser, and with no whale; its study in a library of the test's own.
pub fn small(place: &Place) -> String {
    let library_here = place.library();
    for entry in fs::read_dir(&library_here).unwrap().map(|entry| entry.unwrap()) {
        if entry.path().is_dir() && !NEEDED.contains(&entry.file_name().to_str().unwrap()) {
            fs::remove_dir_all(entry.path()).unwrap();
        }
    }
    let folder = library_here.join("studies");
    fs::create_dir_all(&folder).unwrap();
    let scenario = fs::read_to_string(library().join("scenarios/study-endline-held.toml")).unwrap();
    let (gear, _) = scenario.split_once("[whale]").unwrap();
    let gear = gear
        .replace("duration = \"660 s\"", "duration = \"0.5 s\"")
        .replace("rope_nodes = 500", "rope_nodes = 12");
    let scenario = gear.replace("[resolution]\nnear = \"5 cm\"\nedges = \"1.25 cm\"\n", "");
    fs::write(folder.join("small.toml"), scenario).unwrap();
    let study = folder.join("study.toml");
    fs::write(&study, STUDY).unwrap();
    study.display().to_string()
}

pub fn table(folder: &Path) -> Vec<u8> {
    fs::read(folder.join("table.parquet")).unwrap()
}

#[test]
fn the_table_is_the_same_for_any_threads_and_shards() {
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
        for shard in (1..=shards).rev() {
            if shard == 1 {
                place
                    .endline(&["study", "merge", &study, "--out", &folder])
                    .fails(1, &["lacks", "block", "1/"]);
            }
            place
                .endline(&[
                    "study",
                    "run",
                    &study,
                    "--out",
                    &folder,
                    "--shard",
                    &format!("{shard}/{shards}"),
                ])
                .done();
        }
        place.endline(&["study", "merge", &study, "--out", &folder]).done();
        assert_eq!(table(Path::new(&folder)), whole, "{shards} shards");
    }

    findings(&place, &study, &out("one"));
    bundle(&place, &place.folder.join("one"), &whole);
}

/// Moments spread over 0 to 1 by the golden section, as good as random and the same each time.
fn moments(count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(|index| (f64::from(index) * 0.618_033_988_749_895).fract())
}

#[test]
fn killed_at_any_moment_it_continues_to_the_same_table() {
    let place = Place::new("study-kills");
    let study = small(&place);
    let whole_at = place.folder.join("whole");
    let start = Instant::now();
    place
        .endline(&["study", "run", &study, "--out", whole_at.to_str().unwrap(), "--threads", "1"])
        .done();
    let mut takes = start.elapsed();
    place.endline(&["study", "merge", &study, "--out", whole_at.to_str().unwrap()]).done();
    let whole = table(&whole_at);
    let all = blocks(&whole_at);

    // A folder that is full before its kills are used up makes room for another.
    let mut folders = vec![place.folder.join("killed-0")];
    let (mut killed, mut midway) = (0, 0);
    for moment in moments(100) {
        let folder = folders.last().unwrap().clone();
        let arguments =
            ["study", "run", &study, "--out", folder.to_str().unwrap(), "--threads", "1"];
        let mut child =
            place.command(&arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(takes.mul_f64(moment));
        if child.try_wait().unwrap().is_some() {
            // It was quicker this time: the machine does other things too.
            takes = takes.mul_f64(0.8);
            folders.push(place.folder.join(format!("killed-{}", folders.len())));
            continue;
        }
        child.kill().unwrap();
        child.wait().unwrap();
        killed += 1;
        midway += usize::from((1..all).contains(&blocks(&folder)));
        if killed == 20 {
            break;
        }
    }
    assert_eq!(killed, 20);
    assert!(midway > 0, "some kill came between blocks");
    for folder in folders.iter().filter(|folder| folder.exists()) {
        place.endline(&["study", "run", &study, "--out", folder.to_str().unwrap()]).done();
        place.endline(&["study", "merge", &study, "--out", folder.to_str().unwrap()]).done();
        assert_eq!(table(folder), whole, "{}", folder.display());
    }
}

/// Blocks that stand in a folder.
pub fn blocks(folder: &Path) -> usize {
    let names = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.file_name().into_string().unwrap());
    names.filter(|name| name.starts_with("block-") && name.ends_with(".parquet")).count()
}

#[test]
fn a_study_that_has_seen_enough_ends_there() {
    let place = Place::new("study-enough");
    let study = small(&place);
    // Of 4 encounters none has contact, of which the interval is 0 to 0.49; of 8 it is 0 to 0.32.
    let asks = |narrower: f64, least: u32| {
        let enough = format!(
            "[enough]\nevent = \"contact\"\nnarrower = {narrower}\nleast = {least}\n\n[[option]]\nid = \"none\""
        );
        fs::write(&study, STUDY.replacen("[[option]]\nid = \"none\"", &enough, 1)).unwrap();
    };
    let rows =
        |folder: &Path| fs::read_to_string(folder.join("table.csv")).unwrap().lines().count() - 1;
    for (name, narrower, least, threads, encounters) in [
        ("at-4", 0.5, 4, "1", 4),
        ("two", 0.5, 4, "2", 4),
        ("at-8", 0.4, 4, "1", 8),
        ("least", 0.5, 8, "1", 8),
    ] {
        asks(narrower, least);
        let folder = place.folder.join(name);
        place
            .endline(&[
                "study",
                "run",
                &study,
                "--out",
                folder.to_str().unwrap(),
                "--threads",
                threads,
            ])
            .done();
        place.endline(&["study", "merge", &study, "--out", folder.to_str().unwrap()]).done();
        assert_eq!(rows(&folder), 4 * encounters, "{name}: rows of four options");
    }
    assert_eq!(
        table(&place.folder.join("at-4")),
        table(&place.folder.join("two")),
        "whichever block a second thread had begun"
    );
}

/// Two observations of one row and one that nothing answers; a case that answers another row.
const SEEN: &str = r#"
[[observation]]
id = "B1-none"
says = "no rope without a whale"
source = "this test"
of = "contact"
observed = [0.0, 0.1]

[[observation]]
id = "B1-all"
says = "rope always"
source = "this test"
of = "contact"
observed = [0.9, 1.0]

[[observation]]
id = "B2"
says = "of those that rope touched"
source = "this test"
of = "entangled"
among = "contact"
observed = [0.0, 1.0]
"#;

#[test]
fn one_command_runs_studies_and_cases_and_reports_agreement() {
    let place = Place::new("study-hindcast");
    let study = small(&place);
    // Only studies of the library itself are found.
    let scenario = place.path("gear-library/studies/small.toml");
    fs::rename(&scenario, place.path("gear-library/scenarios/small.toml")).unwrap();
    let seen = STUDY.replace("small.toml", "small").replace("encounters = 10", "encounters = 60");
    fs::write(&study, seen + SEEN).unwrap();
    let cases = place.path("gear-library/cases");
    fs::create_dir_all(&cases).unwrap();
    let case = fs::read_to_string(library().join("cases/weak-link-600.toml")).unwrap();
    fs::write(Path::new(&cases).join("plain.toml"), &case).unwrap();
    let case = case.replace("quick = true", "quick = true\nhindcast = \"B9\"");
    fs::write(Path::new(&cases).join("seen.toml"), case).unwrap();
    let library_here = place.path("gear-library");
    let out = place.folder.join("out").display().to_string();
    let whole = ["study", "hindcast", "--out", &out, "--encounters", "12"];
    let call = |arguments: &[&str]| {
        place.endline(&[&["--library", library_here.to_str().unwrap()], arguments].concat()).done()
    };
    let page = call(&whole).stdout;
    let row = |id: &str| {
        let found: Vec<&str> =
            page.lines().filter(|line| line.starts_with(&format!("| {id} |"))).collect();
        found.join("\n")
    };
    assert!(page.starts_with("Rows compared with a simulated figure: 2 (B1, B9)."), "{page}");
    assert!(row("B1-none").contains("0.0 %") && row("B1-none").contains("| agrees |"), "{page}");
    assert!(row("B1-all").contains("| misses |"), "{page}");
    assert!(row("B2").contains("| not settled |"), "{page}");
    assert!(row("B9").contains("2295") && row("B9").contains("| agrees |"), "{page}");
    assert!(!page.contains("added after"), "all were there before the first run: {page}");

    // An observation added after the first run is marked.
    let text = fs::read_to_string(&study).unwrap();
    fs::write(&study, text.replace("[0.9, 1.0]", "[0.0, 1.0]")).unwrap();
    let again = call(&whole).stdout;
    assert!(again.contains("| agrees, added after the first run |"), "{again}");
    place.endline(&["study", "hindcast", &study, "--encounters", "3"]).fails(2, &["--encounters"]);
}

/// The row of a route of attachment in `docs/results.md`; `None` if no whale was held by it.
fn row_of_route(route: &serde_json::Value) -> Option<String> {
    let rates = route["parts"].as_array().unwrap();
    let held = rates[0]["runs"].as_u64().filter(|runs| *runs > 0)?;
    let percent = |value: &serde_json::Value| 100.0 * value.as_f64().unwrap();
    let cell = |rate: &serde_json::Value| {
        let ends = ["low", "high"].map(|end| percent(&rate["interval"][end]));
        format!(" {:.0} % [{:.0}, {:.0}] |", percent(&rate["rate"]), ends[0], ends[1])
    };
    let cells: String = rates.iter().map(cell).collect();
    Some(format!("| held by: {} | {held} |{cells}", route["name"].as_str().unwrap()))
}

/// The kept results of `docs/results`: one command prints the answer that the page states, and writes its figure again.
#[test]
fn kept_results_are_remade_by_one_command() {
    let docs = endline_tests::root().join("docs");
    let page = fs::read_to_string(docs.join("results.md")).unwrap();
    let kept: Vec<PathBuf> =
        fs::read_dir(docs.join("results")).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(!kept.is_empty());
    for folder in kept {
        let id = folder.file_name().unwrap().to_str().unwrap().to_owned();
        let place = Place::new(&format!("kept-{id}"));
        let again = place.folder.join(&id);
        fs::create_dir_all(&again).unwrap();
        for file in fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
            fs::copy(&file, again.join(file.file_name().unwrap())).unwrap();
        }
        let study = again.join(format!("{id}.toml")).display().to_string();
        let out = again.display().to_string();
        let mut command = vec!["study", "report", &study, "--kept", "--out", &out];
        let hauls = ["single", "trawl-10"].map(|gear| again.join(format!("haul-{gear}.json")));
        let hauls = hauls.map(|file| file.display().to_string());
        hauls.iter().for_each(|file| command.extend(["--haul", file]));
        let printed = place.endline(&command).done();
        let answer = printed.stdout.lines().filter(|line| !line.is_empty());
        for line in answer.take_while(|line| !line.starts_with("All tables")) {
            assert!(page.contains(line), "docs/results.md does not have: {line}");
        }
        let found: serde_json::Value =
            serde_json::from_str(&fs::read_to_string(again.join("findings.json")).unwrap())
                .unwrap();
        for route in found["strength_curves"][0]["by_route"].as_array().unwrap() {
            let row = row_of_route(route);
            assert!(row.is_none_or(|row| page.contains(&row)), "docs/results.md misses {route}");
        }
        let figures = [again.join("strength.svg"), docs.join(format!("pictures/{id}.svg"))];
        let [own, shown] = figures.map(|file| fs::read_to_string(file).unwrap());
        assert!(own == shown, "{id}: the figure is not that of the kept table");
    }
}

/// What the table says of options that are the same, and of a link that parts at a touch.
fn findings(place: &Place, study: &str, out: &str) {
    let found = place.endline(&["study", "report", study, "--out", out, "--json"]).done().json();
    let option = |id: &str| {
        found["options"]
            .as_array()
            .unwrap()
            .iter()
            .find(|option| option["id"] == id)
            .unwrap()
            .clone()
    };
    for (event, paired) in
        option("same")["against"].as_array().unwrap().iter().map(|pair| (&pair[0], &pair[1]))
    {
        assert_eq!(paired["difference"].as_f64(), Some(0.0), "{event}");
        assert_eq!(paired["only_this"], 0, "{event}");
    }
    assert_eq!(option("same")["tensions"]["sorted_n"], option("none")["tensions"]["sorted_n"]);
    let rows = fs::read_to_string(Path::new(out).join("table.csv")).unwrap();
    let parted = |id: &str| {
        rows.lines()
            .filter(|row| row.split(',').nth(1) == Some(id) && row.contains(",buoy-link,"))
            .count()
    };
    assert!(parted("weak") > 0, "a link of 5 N bears no buoy in a running tide");
    assert_eq!([parted("strong"), parted("none")], [0, 0], "one of 600 lbf does");

    let page = fs::read_to_string(Path::new(out).join("report.html")).unwrap();
    assert!(
        page.matches("<svg").count() >= 5
            && page.contains("given an encounter")
            && page.contains("lbf"),
        "the figures are inside"
    );
    assert!(page.contains("requests no length of segments near the whale"), "there is no whale");
    assert!(!page.contains("NaN") && !page.contains("<script"));

    let replayed = place
        .endline(&["study", "replay", study, "--out", out, "--row", "3", "--option", "weak"])
        .done();
    assert!(replayed.stderr.contains("ends in the state that the table has"), "{replayed}");
    let strong = place
        .endline(&["study", "replay", study, "--out", out, "--row", "3", "--option", "strong"])
        .done();
    assert!(
        strong.stderr.contains("ends in the state that the table has"),
        "a shared row is the run it stands for: {strong}"
    );
}

/// The bundle makes the same table by the two commands it names, without the library it came from.
fn bundle(place: &Place, folder: &Path, whole: &[u8]) {
    fs::remove_dir_all(place.path("gear-library")).unwrap();
    let readme = fs::read_to_string(folder.join("bundle/README.txt")).unwrap();
    let commands: Vec<&str> =
        readme.lines().filter_map(|line| line.strip_prefix("endline ")).collect();
    assert_eq!(commands.len(), 2, "{readme}");
    for command in commands {
        let arguments: Vec<&str> = command.split(' ').collect();
        let mut call = place.command(&arguments);
        common::called(call.current_dir(folder)).done();
    }
    assert_eq!(table(&folder.join("again")), whole, "rerun from the bundle");
}

#[test]
fn mistakes_are_reported_at_their_places() {
    let place = Place::new("study-mistakes");
    let study = small(&place);
    let plan = |from: &str, to: &str| {
        assert!(STUDY.contains(from), "{from}");
        fs::write(&study, STUDY.replace(from, to)).unwrap();
        place.endline(&["study", "plan", &study])
    };
    plan("encounters = 10", "encountres = 10")
        .fails(1, &["study.toml:6:1", "unknown field `encountres`", "did you mean `encounters`?"]);
    plan("\"link.0.rating\" = \"5 N\"", "\"link.0.rating\" = \"0 lbf\"")
        .fails(1, &["study.toml", "option `weak`", "above zero"]);
    plan("baseline = \"none\"", "baseline = \"noen\"")
        .fails(1, &["no option `noen`", "did you mean `none`?"]);
    plan("[encounter.tide]", "[encounter.tied]").fails(1, &["`tied`", "did you mean `tide`?"]);
    plan("\"link.0.rating\" = \"5 N\"", "\"link.0.ratign\" = \"5 N\"")
        .fails(1, &["unknown field `ratign`", "did you mean `rating`?", "study.toml"]);
    plan("source = \"assumed\"\n\n[encounter.tide]", "\n[encounter.tide]")
        .fails(1, &["`source` is missing", "assumed"]);
    plan("scenario = \"small.toml\"", "scenario = \"hello-endlin\"")
        .fails(1, &["did you mean `hello-endline`?"]);

    fs::write(&study, STUDY).unwrap();
    place
        .endline(&["study", "replay", &study, "--row", "3", "--option", "week"])
        .fails(1, &["no option `week`", "did you mean `weak`?"]);
    place.endline(&["study", "run", &study, "--shard", "8/7"]).fails(2, &["2/7"]);
    place
        .endline(&[
            "study",
            "report",
            &study,
            "--out",
            &place.folder.join("no").display().to_string(),
        ])
        .fails(1, &["merge"]);
}

#[test]
fn a_folder_keeps_to_its_study_and_what_cannot_be_written_loses_nothing() {
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
    assert!(
        longer.stdout.contains("1 of them new") || longer.stdout.contains("0 of them new"),
        "{longer}"
    );

    // A name that cannot be written: the block before it stays whole.
    fs::write(&study, STUDY).unwrap();
    let before = fs::read(out.join("block-00000.parquet")).unwrap();
    fs::create_dir(out.join("block-00001.parquet")).unwrap();
    fs::write(out.join("block-00001.parquet/in-the-way"), "").unwrap();
    let second = ["study", "run", &study, "--out", &out.display().to_string(), "--shard", "2/3"];
    place
        .endline(&second)
        .fails(1, &["block-00001.parquet", "cannot be written", "continues from them"]);
    assert_eq!(fs::read(out.join("block-00000.parquet")).unwrap(), before);
    fs::remove_dir_all(out.join("block-00001.parquet")).unwrap();
    place.endline(&second).done();

    // A disk that takes no more bytes in the midst of a block: a limit on the length of files does the same, without being root.
    #[cfg(unix)]
    {
        let before = blocks(&out);
        let third = place.command(&[
            "study",
            "run",
            &study,
            "--out",
            out.to_str().unwrap(),
            "--shard",
            "3/3",
        ]);
        let mut limited = std::process::Command::new("sh");
        limited
            .args(["-c", "trap '' XFSZ; ulimit -f 4; exec \"$0\" \"$@\""])
            .arg(third.get_program())
            .args(third.get_args());
        limited
            .current_dir(&place.folder)
            .envs(third.get_envs().filter_map(|(name, value)| Some((name, value?))));
        common::called(&mut limited)
            .fails(1, &["block-0000", ".parquet cannot be written", "continues from them"]);
        assert_eq!(blocks(&out), before, "nothing half written stands there as a block");
        place
            .endline(&["study", "run", &study, "--out", out.to_str().unwrap(), "--shard", "3/3"])
            .done();
        place.endline(&["study", "merge", &study, "--out", out.to_str().unwrap()]).done();
    }
}

/// Whether an observation of the library names a study's encounters as those to search.
fn is_searched(study: &str) -> bool {
    let named = format!("encounters = \"{study}\"");
    let files = fs::read_dir(library().join("observations")).unwrap();
    files
        .map(|file| fs::read_to_string(file.unwrap().path()).unwrap())
        .any(|text| text.contains(&named))
}

#[test]
fn the_study_of_species_changes_the_whale_alone() {
    let file = library().join("studies/species.toml");
    let study = Study::read("species", &fs::read_to_string(file).unwrap()).unwrap();
    let gear = |option: &StudyOption| -> Vec<(String, String)> {
        let others = option.settings.iter().filter(|one| !one.field.value.starts_with("whale."));
        others.map(|one| (one.field.value.clone(), format!("{:?}", one.value))).collect()
    };
    let [first, others @ ..] = &study.options[..] else { panic!("no options") };
    assert!(others.len() >= 3 && !gear(first).is_empty());
    for option in others {
        assert_eq!(gear(option), gear(first), "{}", option.id.value);
    }
}

#[test]
fn every_shipped_study_assembles() {
    let place = Place::new("study-shipped");
    let folder = library().join("studies");
    let mut files: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(!files.is_empty());
    for file in files {
        let plan =
            place.endline(&["study", "plan", &file.display().to_string(), "--json"]).done().json();
        // Only options that differ in strengths alone share runs: all of weak-links, and in threat the same sleeves that part and
        // that do not.
        let families = plan["families"].as_array().unwrap();
        let id = plan["study"].as_str().unwrap();
        let options: usize = families.iter().map(|family| family.as_array().unwrap().len()).sum();
        // The one option of rope-strength cannot part: its runs compare every strength of rope.
        let compares = options > 1 || is_searched(id) || id == "rope-strength";
        assert!(compares, "{id} compares nothing");
        for family in families {
            let ids: Vec<&str> =
                family.as_array().unwrap().iter().map(|id| id.as_str().unwrap()).collect();
            let shares = match (id, ids.as_slice()) {
                ("weak-links", ids) => ids.len() == options,
                ("threat", [none, sleeves]) => {
                    none.strip_prefix("none") == sleeves.strip_prefix("sleeves")
                }
                (_, ids) => id != "threat" && ids.len() == 1,
            };
            assert!(shares, "{plan}");
        }
        assert_eq!(plan["study"], file.file_stem().unwrap().to_string_lossy().as_ref());
    }
}

//! Rules as their users call them: verdicts, exit codes, a pack of one's own, mistakes at their lines.

use std::fs;

use crate::common::{Called, Place, library, text};

const PACK: &str = r#"format = 1
kind = "rules"
name = "My bay"
jurisdiction = "X"
[[area]]
id = "my-bay"
name = "My bay"
[[rule]]
id = "bay.sinking"
asks = "Half of the buoy line sinks."
cite = "a test"
source = "a test"
confidence = "measured"
standing = "proposed"
from = "2024-01-01"
areas = ["my-bay"]
subject = "every endline"
check = "sinking_share >= least"
remedy = "Use sinking rope."
[rule.parameters]
least = 0.5
"#;

fn check(place: &Place, arguments: &[&str]) -> Called {
    let library = text(&library());
    place.endline(&[&["--library", &library, "rules", "check"], arguments].concat())
}

#[test]
fn an_assembly_passes_fails_or_leaves_a_rule_open_and_the_exit_code_says_whether_one_fails() {
    let place = Place::new("rules");
    place.write("bay.toml", PACK);
    let bay = ["--on", "2024-06-01", "--area", "my-bay", "--pack", "bay.toml"];
    let passes = check(&place, &[&["single-bridle", "--json"], &bay[..]].concat()).done().json();
    let rule = passes["rules"].as_array().unwrap().iter().find(|one| one["rule"] == "bay.sinking");
    let rule = rule.unwrap();
    assert_eq!((&rule["verdict"], &rule["standing"]), (&"pass".into(), &"proposed".into()));
    // 21.5 of 31.5 m of the shipped assembly is sinking rope.
    let share = rule["measured"][0]["value"].as_f64().unwrap();
    assert!((share - 21.5 / 31.5).abs() < 1e-9, "{rule}");

    let assembly = fs::read_to_string(library().join("assemblies/single-bridle.toml")).unwrap();
    place.write("assemblies/floating.toml", &assembly.replace("\"sink-3-8\"", "\"pp-3-8\""));
    let fails = check(&place, &[&["assemblies/floating.toml"], &bay[..]].concat());
    // What is proposed or voluntary is advice: it fails, and the call does not.
    let printed =
        ["fail", "bay.sinking", "fix: Use sinking rope.", "0; at least 0.5 required", "(proposed)"];
    fails.fails(0, &[&printed[..], &["1 fail (1 of them advice that does not bind)"]].concat());
    for (standing, code) in [("law", 1), ("voluntary", 0)] {
        place.write("bay.toml", &PACK.replace("\"proposed\"", &format!("\"{standing}\"")));
        let fails = check(&place, &[&["assemblies/floating.toml"], &bay[..]].concat());
        fails.fails(code, &["fix: Use sinking rope.", "1 fail"]);
    }

    let maine = check(&place, &["single", "--area", "me-b", "--on", "2024-06-01"]);
    maine.fails(1, &["needs --distance", "us.weak", "86 FR 51970", "assembled for 25 m"]);
    check(&place, &["single", "--area", "me-x", "--on", "2024-06-01"])
        .fails(2, &["no area `me-x`"]);
    check(&place, &["single", "--area", "me-b", "--on", "June"]).fails(2, &["2024-06-01"]);
    check(&place, &["sngle", "--area", "me-b", "--on", "2024-06-01"]).fails(1, &["`single`"]);
}

#[test]
fn a_strength_names_the_rope_that_has_it_and_a_length_the_whole_endline() {
    let place = Place::new("rule-parts");
    let arguments = ["trawl-10", "--area", "lma-1", "--on", "2024-06-01", "--json"];
    let json = check(&place, &arguments).json();
    let rules = json["rules"].as_array().unwrap();
    let measured = |rule: &str| {
        let found = rules.iter().find(|one| one["rule"] == rule).unwrap();
        let one = &found["measured"][0];
        (one["part"].as_str().unwrap().to_owned(), one["says"].as_str().unwrap().to_owned())
    };
    // The upper rope is sink-7-16 of 3,500 lbf, the lower one pp-7-16 of 3,160 lbf.
    let (part, says) = measured("us.weak");
    assert_eq!((&*part, &*says), ("endline-bottom", "3,160 lbf; at most 1,700 lbf allowed"));
    place.write("bay.toml", PACK);
    let bay = ["--area", "my-bay", "--on", "2024-06-01", "--pack", "bay.toml"];
    check(&place, &[&["trawl-10"], &bay[..]].concat()).prints(&["endline-top to endline-bottom: "]);
}

#[test]
fn mistakes_in_a_pack_stand_at_their_lines_and_the_packs_that_ship_have_none() {
    let place = Place::new("rule-mistakes");
    let pack = PACK
        .replace("areas = [\"my-bay\"]", "areas = [\"my-bay\"]\nremmedy = 1")
        .replace("2024-01-01", "2024-13-01")
        .replace("least = 0.5", "least = \"1 m\"");
    place.write("bay.toml", &pack);
    let called = place.endline(&["--library", library().to_str().unwrap(), "check", "bay.toml"]);
    let printed = [
        "bay.toml:15:8",
        "unknown field `remmedy`",
        "bay.toml:19:9",
        "compares a plain number and a length",
    ];
    called.fails(1, &printed);
    place.write("bay.toml", &PACK.replace("areas = [\"my-bay\"]", "areas = [\"my-by\"]"));
    let called = place.endline(&["--library", library().to_str().unwrap(), "check", "bay.toml"]);
    called.fails(1, &["no pack declares the area `my-by`", "did you mean `my-bay`?"]);
    let rules = library().join("rules");
    place.endline(&["check", rules.to_str().unwrap()]).done();
    let listed = place.endline(&["--library", library().to_str().unwrap(), "rules", "list"]).done();
    for word in ["us.weak", "2022-05-01", "voluntary", "estimate", "Maine lobster zone G"] {
        assert!(listed.stdout.contains(word), "{listed}");
    }
}

#[test]
fn a_rule_with_a_season_does_not_apply_out_of_it_and_has_a_verdict_in_it() {
    let place = Place::new("rule-season");
    // From 1 November over the turn of the year to 30 April.
    let season = PACK.replace("subject =", "season = [305, 120]\nsubject =");
    place.write("bay.toml", &season);
    let on = |day: &str| {
        let arguments =
            ["single-bridle", "--area", "my-bay", "--on", day, "--pack", "bay.toml", "--json"];
        let json = check(&place, &arguments).done().json();
        json["rules"].as_array().unwrap().iter().find(|one| one["rule"] == "bay.sinking").cloned()
    };
    // 2025 has no leap day: its day 120 is 30 April, its day 305 is 1 November.
    for (day, verdict) in [
        ("2025-04-30", "pass"),
        ("2025-05-01", "not-applicable"),
        ("2025-10-31", "not-applicable"),
        ("2025-11-01", "pass"),
        ("2026-01-01", "pass"),
    ] {
        let rule = on(day).unwrap();
        assert_eq!(rule["verdict"], verdict, "{day}: {rule}");
        let why = rule["why"].as_str().unwrap();
        assert_eq!(why.contains("from day 305 to day 120"), verdict != "pass", "{day}: {rule}");
    }
}

#[test]
fn the_json_of_check_and_list_tells_all_that_a_script_needs() {
    let place = Place::new("rule-json");
    let call = ["single", "--area", "me-b", "--on", "2024-06-01", "--distance", "5 nmi", "--json"];
    let called = check(&place, &call);
    called.fails(1, &[]);
    let sheet = called.json();
    assert_eq!(sheet["schema"], "endline.rules.check/1");
    assert_eq!((&sheet["traps"], &sheet["distance_m"]), (&1.into(), &9260.0.into()));
    let rules = sheet["rules"].as_array().unwrap();
    let with = |verdict: &str| rules.iter().filter(|one| one["verdict"] == verdict).count();
    for (count, verdict) in [
        ("pass", "pass"),
        ("fail", "fail"),
        ("not_applicable", "not-applicable"),
        ("cannot_be_checked", "cannot-be-checked"),
    ] {
        assert_eq!(sheet["counts"][count], with(verdict), "{verdict}");
    }
    let weak = rules.iter().find(|one| one["rule"] == "us.weak").unwrap();
    assert_eq!((&weak["binding"], &weak["from"]), (&true.into(), &"2022-05-01".into()));
    assert!(weak["until"].is_null() && !weak["source"].as_str().unwrap().is_empty(), "{weak}");

    let library = text(&library());
    let listed = place.endline(&["--library", &library, "rules", "list", "--json"]).done().json();
    assert_eq!(listed["schema"], "endline.rules.list/1");
    let packs = listed["packs"].as_array().unwrap();
    let all: Vec<_> = packs.iter().flat_map(|pack| pack["rules"].as_array().unwrap()).collect();
    assert_eq!(all.len(), rules.len(), "the check tells every rule of the list");
    let weak = all.iter().find(|one| one["rule"] == "us.weak").unwrap();
    assert_eq!(weak["check"], "least_rated <= strength");
    assert_eq!(weak["parameters"][0]["text"], "1,700 lbf");
    assert!(
        (weak["parameters"][0]["value"].as_f64().unwrap() - 7_561.976_8).abs() < 1e-3,
        "{weak}"
    );
    let zones = packs.iter().flat_map(|pack| pack["areas"].as_array().unwrap());
    assert!(zones.into_iter().any(|area| area["area"] == "me-g" && area["within"] == "maine"));
}

#[test]
fn edits_that_meet_rules_are_proposed_and_written_to_a_new_assembly_that_complies() {
    let place = Place::new("rule-fix");
    let library = text(&place.library());
    let at = ["--area", "me-b", "--on", "2024-06-01", "--distance", "5 nmi"];
    let fix = |more: &[&str]| {
        place.endline(&[&["--library", &library, "rules", "fix", "single"], &at[..], more].concat())
    };
    let json = fix(&["--json"]).done().json();
    assert_eq!(json["schema"], "endline.rules.fix/1");
    let rules = json["rules"].as_array().unwrap();
    let of = |id: &str| rules.iter().find(|one| one["rule"] == id).unwrap();
    let two = of("me.inserts.3-12.two")["proposals"].as_array().unwrap();
    assert!(two.len() > 1, "{two:?}");
    for edit in two {
        let passes = edit["passes"].as_array().unwrap();
        assert!(passes.contains(&"me.inserts.3-12.two".into()), "{edit}");
        assert!(!edit["changes"].as_array().unwrap().is_empty(), "{edit}");
    }
    assert!(of("us.soak")["why_none"].as_str().unwrap().contains("does not say"));
    let printed =
        ["single in me-b", "25 % and 50 % of endline-top", "still fails", "no edit meets it"];
    fix(&[]).fails(0, &printed);

    // All edits together: the assembly written complies with every rule that binds.
    fix(&["--write", "single-fixed"]).done();
    let check = |assembly: &str| {
        place.endline(&[&["--library", &library, "rules", "check", assembly], &at[..]].concat())
    };
    check("single").fails(1, &["us.weak"]);
    check("single-fixed").fails(0, &["0 fail"]);
    let file = place.path("gear-library/assemblies/single-fixed.toml");
    let written = fs::read_to_string(&file).unwrap();
    assert!(
        written.contains("(fixed)") && written.contains("[lines.endline-top.inserts]"),
        "{written}"
    );
    // Never over a file that is there; a number that no proposal has is wrong use.
    fix(&["--write", "single-fixed"]).fails(1, &["is there already"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), written);
    fix(&["--write", "one.toml", "--take", "99"]).fails(2, &["--take 99", "numbers 1 to"]);
    fix(&["--write", "one.toml", "--take", "1"]).done();
    assert!(place.path("one.toml").is_file());
}

#[test]
fn a_study_of_two_rules_has_an_option_for_each_and_opens() {
    let place = Place::new("rule-study");
    let library = text(&place.library());
    let study = |options: &[&str], out: &str| {
        let options: Vec<&str> = options.iter().flat_map(|id| ["--option", id]).collect();
        let call = ["--library", &library, "rules", "study", "single", "--out", out];
        place.endline(&[&call[..], &options].concat())
    };
    let [one, two] = ["me.inserts.3-12.one", "me.inserts.3-12.two"];
    study(&[one, two], "second-insert").fails(0, &["at 33 % of", "at 25 % and 50 % of"]);
    let plan = ["--library", &library, "study", "plan", "second-insert", "--json"];
    let plan = place.endline(&plan).done().json();
    let options = plan["options"].as_array().unwrap();
    let ids: Vec<&str> = options.iter().map(|one| one.as_str().unwrap()).collect();
    assert_eq!(ids, [one, two]);
    let file = place.path("gear-library/studies/second-insert.toml");
    let written = fs::read_to_string(&file).unwrap();
    // The encounters are those of the study taken, and neither its options nor its claims.
    assert!(
        written.contains("[encounter.speed]") && written.contains(&format!("baseline = \"{one}\""))
    );
    assert!(!written.contains("trawl-45"), "{written}");
    study(&[one, two], "second-insert").fails(1, &["is there already"]);
    study(&[one], "x").fails(1, &["two rules or more"]);
    study(&[one, "me.markz"], "x").fails(1, &["no rule `me.markz`", "did you mean `me.marks`"]);
    study(&[one, "me.marks"], "x").fails(1, &["`me.marks` gives no option", "does not say"]);
}

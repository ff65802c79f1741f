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
mend = "Use sinking rope."
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
    fails.fails(1, &["fail", "bay.sinking", "mend: Use sinking rope.", "0 >= 0.5", "(proposed)"]);

    let maine = check(&place, &["single", "--area", "me-b", "--on", "2024-06-01"]);
    maine.fails(1, &["needs --distance", "us.weak", "86 FR 51970", "assembled for 25 m"]);
    check(&place, &["single", "--area", "me-x", "--on", "2024-06-01"])
        .fails(2, &["no area `me-x`"]);
    check(&place, &["single", "--area", "me-b", "--on", "June"]).fails(2, &["2024-06-01"]);
    check(&place, &["sngle", "--area", "me-b", "--on", "2024-06-01"]).fails(1, &["`single`"]);
}

#[test]
fn mistakes_in_a_pack_stand_at_their_lines_and_the_packs_that_ship_have_none() {
    let place = Place::new("rule-mistakes");
    let pack = PACK
        .replace("areas = [\"my-bay\"]", "areas = [\"my-bay\"]\nmened = 1")
        .replace("2024-01-01", "2024-13-01")
        .replace("least = 0.5", "least = \"1 m\"");
    place.write("bay.toml", &pack);
    let called = place.endline(&["--library", library().to_str().unwrap(), "check", "bay.toml"]);
    let told = [
        "bay.toml:15:8",
        "unknown field `mened`",
        "bay.toml:19:9",
        "compares a plain number and a length",
    ];
    called.fails(1, &told);
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

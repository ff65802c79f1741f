//! Mistakes in a scenario are reported with their place.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail the test")]

use crate::gear::refused;
use crate::linked::{report, scenario_text};

/// Each entry is a change to the scenario, the place of its diagnostic, and words of its message.
#[test]
fn mistakes_in_a_scenario_are_reported_with_their_place() {
    let text = scenario_text("hello-endline.toml");
    for (from, to, parts) in [
        (
            "rope_nodes = 1000",
            "rope_node = 1000",
            vec!["unknown field `rope_node`", "did you mean `rope_nodes`?"],
        ),
        (
            "rope_nodes = 1000",
            "rope_nodes = 3",
            vec!["`rope_nodes` is too small", "at least 4 nodes"],
        ),
        ("\"13.7 m\"", "\"13.7 furlong\"", vec!["unknown unit `furlong` in `length`"]),
        ("\"single\"", "\"singel\"", vec!["no `singel` in assemblies/", "did you mean `single`?"]),
        (
            "\"right-whale\"",
            "\"rihgt-whale\"",
            vec!["no `rihgt-whale` in whales/", "did you mean `right-whale`?"],
        ),
        ("\"cape-cod-bay\"", "\"cape-cod\"", vec!["no `cape-cod` in sites/"]),
        (
            "org.endline.motion.swim",
            "org.endline.motion.swin",
            vec![
                "no plugin with the whale motion `org.endline.motion.swin`",
                "did you mean `org.endline.motion.swim`?",
            ],
        ),
        (
            "org.endline.friction.coulomb",
            "org.endline.friction.colomb",
            vec!["no plugin with the friction model", "did you mean"],
        ),
        (
            "cruise_speed = \"1.3 m/s\"",
            "cruise_speed = \"1.3 m\"",
            vec!["`m` is a unit of a length, not of a speed"],
        ),
        (
            "cruise_speed = \"1.3 m/s\"",
            "cruise_sped = \"1.3 m/s\"",
            vec!["`org.endline.motion.swim` has no attribute `cruise_sped`"],
        ),
        (
            "cruise_speed = \"1.3 m/s\"",
            "cruise_speed = \"99 m/s\"",
            vec!["`cruise_speed` is 99 m/s", "between 0.1 m/s and 5 m/s"],
        ),
        (
            "part = \"buoy\"",
            "part = \"bouy\"",
            vec!["there is no body or joint `bouy`", "did you mean `buoy`?"],
        ),
        ("part = \"buoy\"", "part = \"whale:nose\"", vec!["the whale has no spot `nose`", "snout"]),
        ("speed = 1.0", "speed = 1.5", vec!["`speed` is 1.5", "between 0 and 1"]),
        ("duration = \"60 s\"", "duration = 60", vec!["`duration` is 60 without a unit"]),
    ] {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text, "{from}");
        let problems = refused(&changed);
        assert_eq!(problems.len(), 1, "{to}: {}", report(&problems));
        let line = 1 + changed.lines().position(|line| line.contains(to)).unwrap();
        assert_eq!(
            (problems[0].file.as_str(), problems[0].line),
            ("test.toml", line),
            "{}",
            problems[0]
        );
        for part in parts {
            assert!(problems[0].to_string().contains(part), "`{}` lacks `{part}`", problems[0]);
        }
    }
}

/// Each entry is tables put into a scenario, the line of the diagnostic in them, and words of its message.
#[test]
fn mistakes_in_segments_and_probes_are_reported_with_their_place() {
    let text = scenario_text("hello-endline.toml");
    let segments = |line: &str, longest: &str| {
        let table =
            format!("[[segments]]\nline = \"{line}\"\nlongest = \"{longest}\"\n\n[resolution]");
        let even = text.replacen("rope_nodes = 1000", "segment = \"1 m\"", 1);
        even.replacen("[resolution]", &table, 1)
    };
    let probe = "[[probe]]\nid = \"effort\"\nof = \"whale\"\nfigure = \"thrust\"\n\n[site]";
    let without_segment = segments("endline*", "10 cm").replacen("segment = \"1 m\"\n", "", 1);
    for (changed, line, parts) in [
        (segments("endlin", "10 cm"), "line = \"endlin\"", ["no line `endlin`", "endline"]),
        (segments("endline*", "0.1 mm"), "longest =", ["`longest` is 0.0001 m", "between"]),
        (without_segment, "line = \"endline*\"", ["needs a `segment` for the other lines", "1 m"]),
        (
            text.replacen("[site]", probe, 1),
            "figure = \"thrust\"",
            ["a kinematic whale has no thrust", "dynamics = \"kinetic\""],
        ),
    ] {
        let problems = refused(&changed);
        assert_eq!(problems.len(), 1, "{line}: {}", report(&problems));
        let at = 1 + changed.lines().position(|text| text.starts_with(line)).unwrap();
        assert_eq!(
            (problems[0].file.as_str(), problems[0].line),
            ("test.toml", at),
            "{}",
            problems[0]
        );
        for part in parts {
            assert!(problems[0].to_string().contains(part), "`{}` lacks `{part}`", problems[0]);
        }
    }
}

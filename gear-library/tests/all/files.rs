//! Files with mistakes, and edits of files.

use std::collections::BTreeMap;

use endline_gear::{Diagnostic, Document, Library, Scenario, Setting, Severity, Sources};

const ROPE: &str = r#"# A mill sheet.
format = 1
kind = "rope"
name = "Test rope"
source = "mill sheet 7"
confidence = "measured"
material = "pp"

diameter = "3/8 in"   # nominal
mass = "0.0417 kg/m"
density = { value = "910 kg/m3", source = "supplier", confidence = "estimate" }
wet_weight = "-0.052 N/m"
strength = "2,440 lbf"
stretch_at_break = 0.22
stiffness = "49 kN"
damping = "2.45 N s"
drag_normal = 1.2
drag_tangential = 0.015
added_mass = 1.0
"#;

fn problems_of(text: &str) -> Vec<Diagnostic> {
    Library::check_file("ropes/test.toml", text)
}

/// Line, column, field, and parts of the message and help of the only problem.
fn only(text: &str, line: usize, column: usize, field: &str, parts: &[&str]) {
    let problems = problems_of(text);
    assert_eq!(problems.len(), 1, "{problems:#?}");
    let problem = &problems[0];
    assert_eq!(
        (problem.line, problem.column, problem.field.as_str()),
        (line, column, field),
        "{problem}"
    );
    for part in parts {
        assert!(problem.to_string().contains(part), "`{problem}` lacks `{part}`");
    }
}

#[test]
fn a_good_file_has_no_problems() {
    assert_eq!(problems_of(ROPE), []);
}

#[test]
fn a_furlong_is_no_unit() {
    let text = ROPE.replace("3/8 in", "3/8 furlong");
    only(
        &text,
        9,
        12,
        "diameter",
        &[
            "ropes/test.toml:9:12: error: unknown unit `furlong` in `diameter`",
            "expected a length such as 3/8 in",
        ],
    );
}

#[test]
fn a_negative_diameter_is_out_of_range() {
    only(
        &ROPE.replace("3/8 in", "-3/8 in"),
        9,
        12,
        "diameter",
        &["`diameter` is -0.009525 m", "between 0.001 m and 0.2 m"],
    );
}

#[test]
fn a_misspelt_key_is_named_with_the_one_meant() {
    only(
        &ROPE.replace("drag_normal = 1.2", "drag_normal = 1.2\nknot_facter = 0.9"),
        18,
        1,
        "knot_facter",
        &["unknown field `knot_facter`", "did you mean `knot_factor`?"],
    );
}

#[test]
fn a_missing_figure_says_what_belongs_there() {
    let text = ROPE.replace("strength = \"2,440 lbf\"\n", "");
    only(&text, 1, 1, "strength", &["`strength` is missing", "1700 lbf"]);
}

#[test]
fn a_number_without_unit_is_refused() {
    only(
        &ROPE.replace("\"49 kN\"", "49000"),
        15,
        13,
        "stiffness",
        &["`stiffness` is 49000 without a unit", "expected a force"],
    );
}

#[test]
fn a_figure_needs_source_and_confidence() {
    let text =
        ROPE.replace("source = \"mill sheet 7\"\n", "").replace("3/8 in\"   # nominal", "3/8 in\"");
    let reported: Vec<String> = problems_of(&text).iter().map(ToString::to_string).collect();
    assert!(
        reported.iter().any(|reported| reported.contains("`diameter` has no source")),
        "{reported:?}"
    );
    assert!(
        !reported.iter().any(|reported| reported.contains("`density` has no source")),
        "{reported:?}"
    );
    only(
        &ROPE.replace("\"estimate\"", "\"hearsay\""),
        11,
        68,
        "density.confidence",
        &["expected one of measured, catalogue, derived, estimate"],
    );
}

/// Files of users, and recordings, with the former key of `confidence`.
#[test]
fn the_former_key_of_confidence_is_still_read_and_edited() {
    let former = ROPE.replace("confidence = ", "sureness = ");
    assert_ne!(former, ROPE);
    assert!(problems_of(&former).is_empty());
    let mut document = Document::parse(&former).expect("a TOML text");
    assert_eq!(document.get("confidence").as_deref(), Some("measured"));
    document.set("confidence", "derived").expect("a field of the file");
    assert_eq!(document.text(), former.replace("\"measured\"", "\"derived\""));
    let both = ROPE.replacen("confidence = ", "sureness = \"derived\"\nconfidence = ", 1);
    let problems = problems_of(&both);
    assert!(problems.iter().any(|problem| problem.message.contains("unknown field `sureness`")));
}

#[test]
fn a_key_given_twice_is_refused() {
    only(
        &ROPE.replace("added_mass = 1.0", "added_mass = 1.0\nadded_mass = 1.1"),
        20,
        1,
        "",
        &["duplicate key"],
    );
}

#[test]
fn wet_weight_must_agree_with_mass_and_density() {
    only(
        &ROPE.replace("-0.052 N/m", "0.052 N/m"),
        12,
        14,
        "wet_weight",
        &["mass and density give -0.0517 N/m"],
    );
}

/// A site has one law of its current by height, and its speed at a height within the water.
#[test]
fn a_site_has_one_law_of_its_current() {
    let shipped =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/sites/jonesport.toml"))
            .unwrap();
    assert_eq!(Library::check_file("sites/test.toml", &shipped), []);
    let line =
        |start: &str| shipped.lines().find(|line| line.starts_with(start)).unwrap().to_owned();
    let (law, height) = (line("current_roughness"), line("current_height"));
    for (from, to, words) in [
        (
            &law,
            String::new(),
            ["neither `current_exponent` nor `current_roughness`", "current_exponent = 0.142857"],
        ),
        (
            &law,
            format!("{law}\ncurrent_exponent = 0.1"),
            ["both `current_exponent` and `current_roughness`", "a power law"],
        ),
        (
            &height,
            height.replace("1.5 m", "31 m"),
            ["above the surface: the water is 30 m deep", "above the seabed"],
        ),
    ] {
        let problems = Library::check_file("sites/test.toml", &shipped.replace(from.as_str(), &to));
        assert_eq!(problems.len(), 1, "{problems:#?}");
        assert!(words.iter().all(|word| problems[0].to_string().contains(word)), "{}", problems[0]);
    }
}

#[test]
fn strength_should_agree_with_stiffness_and_stretch() {
    let problems = problems_of(&ROPE.replace("49 kN", "490 kN"));
    assert_eq!(problems.len(), 1);
    assert_eq!((problems[0].severity, problems[0].line), (Severity::Warning, 15));
    assert!(
        problems[0]
            .message
            .contains("stiffness × stretch_at_break is 107800 N, but the strength is 10854 N"),
        "{}",
        problems[0]
    );
}

#[test]
fn all_problems_of_a_file_are_reported_at_once() {
    let text = ROPE
        .replace("3/8 in", "3/8 furlong")
        .replace("2,440 lbf", "2,440 lb")
        .replace("drag_tangential = 0.015", "drag_tangental = 0.015");
    let lines: Vec<usize> = problems_of(&text).iter().map(|problem| problem.line).collect();
    assert_eq!(lines, [1, 9, 13, 18], "{:#?}", problems_of(&text));
}

#[test]
fn invalid_toml_is_reported_with_its_place() {
    let problems = problems_of(&ROPE.replace("\"2,440 lbf\"", "2,440 lbf"));
    assert_eq!((problems.len(), problems[0].line), (1, 13), "{problems:#?}");
}

#[test]
fn a_rope_of_an_unknown_material_is_refused() {
    let sources =
        Sources::from_map(BTreeMap::from([("ropes/test.toml".to_owned(), ROPE.to_owned())]));
    let (_, problems) = Library::read(&sources);
    assert_eq!(problems.len(), 1);
    assert_eq!((problems[0].line, problems[0].column), (7, 12));
    assert!(problems[0].message.contains("no `pp` in friction/"), "{}", problems[0]);
}

#[test]
fn a_newer_format_is_refused() {
    only(
        &ROPE.replace("format = 1", "format = 2"),
        2,
        10,
        "format",
        &["format 2 is newer than this program"],
    );
}

#[test]
fn a_missing_folder_is_reported() {
    let problems = Sources::from_folder(std::path::Path::new("/nowhere/at/all"))
        .expect_err("nothing is there");
    assert!(problems[0].to_string().contains("no gear library in this folder"), "{}", problems[0]);
}

#[test]
fn no_text_makes_the_reader_panic() {
    for cut in 0..ROPE.len() {
        problems_of(&ROPE[..cut]);
        let _ = Scenario::read("test.toml", &ROPE[..cut]);
    }
    for text in [
        "\u{feff}",
        "é = \"ü",
        "[[a]]\n[a]",
        "sections = 3\nkind = [1]\nformat = \"x\"\nname = 2020-01-01",
    ] {
        for kind in ["ropes", "whales", "assemblies", "buoys", "traps"] {
            assert!(!Library::check_file(&format!("{kind}/x.toml"), text).is_empty());
        }
        assert!(Scenario::read("x.toml", text).is_err());
    }
}

#[test]
fn an_edit_keeps_comments_order_and_source() {
    let mut document = Document::parse(ROPE).unwrap();
    document.set("diameter", "7/16 in").unwrap();
    document.set("density", "920 kg/m3").unwrap();
    document.set("drag_normal", "1.3").unwrap();
    let expected = ROPE
        .replace("3/8 in", "7/16 in")
        .replace("910 kg/m3", "920 kg/m3")
        .replace("drag_normal = 1.2", "drag_normal = 1.3");
    assert_eq!(document.text(), expected);
    assert_eq!(document.get("density").as_deref(), Some("920 kg/m3"));
    assert!(document.set("diameter.inner.value", "1 in").is_err());
}

#[test]
fn an_edit_reaches_into_tables_and_lists() {
    let text = "[whale]\nspeed = \"1 m/s\" # slow\n\n[[line]]\nid = \"a\"\n\n[[line]]\nid = \"b\"\nlength = \"3 m\"\nat = [\"1 m\", \"2 m\"]\n";
    let mut document = Document::parse(text).unwrap();
    document.set("whale.speed", "1.4 m/s").unwrap();
    document.set("line.1.length", "4 m").unwrap();
    document.set("line.1.at.0", "9 m").unwrap();
    document.set("line.0.rope", "pp-3-8").unwrap();
    let expected =
        text.replace("1 m/s", "1.4 m/s").replace("3 m", "4 m").replace("[\"1 m\"", "[\"9 m\"");
    assert_eq!(
        document.text(),
        expected.replace("id = \"a\"\n", "id = \"a\"\nrope = \"pp-3-8\"\n")
    );
    document.remove("line.0.rope").unwrap();
    assert_eq!(document.text(), expected);
}

#[test]
fn an_overlay_takes_the_place_of_the_shipped_file() {
    let of = |text: &str| {
        Sources::from_map(BTreeMap::from([("ropes/test.toml".to_owned(), text.to_owned())]))
    };
    let over = of("new").overlay(of("newer"));
    assert_eq!(over.get("ropes/test.toml"), Some("newer"));
    assert_eq!(over.only(&["ropes/other.toml".to_owned()]).iter().count(), 0);
}

#[test]
fn tables_are_made_pushed_and_taken_out_with_all_else_as_it_was() {
    let text =
        "# top\nname = \"x\"\n\n[[line]] # first\nid = \"a\"\n\n[[line]]\nid = \"b\" # keep\n";
    let mut document = Document::parse(text).unwrap();
    for (key, value) in [("rope", "weak"), ("within", "0.75")] {
        document.put(&format!("line.0.inserts.{key}"), &Setting::plain(value)).unwrap();
    }
    let with = document.text();
    let inserted = "[line.inserts]\nrope = \"weak\"\nwithin = 0.75\n";
    let (before, after) =
        (with.find("id = \"a\"").unwrap(), with.find("id = \"b\" # keep").unwrap());
    let at = with.find(inserted).unwrap();
    assert!(before < at && at < after, "the inserts stand under their line:\n{with}");
    assert_eq!(
        document.push_table("line", &[("id", "c"), ("position", "[\"1 m\", \"2 m\"]")]).unwrap(),
        2
    );
    assert_eq!(document.get("line.2.position.1").as_deref(), Some("2 m"));
    assert_eq!(
        document.push_table("joint", &[("id", "j")]).unwrap(),
        0,
        "a list that is not there is made"
    );
    document.remove_table("line", 2).unwrap();
    document.remove_table("joint", 0).unwrap();
    document.remove("line.0.inserts").unwrap();
    assert_eq!(document.text().trim_end(), text.trim_end());
    assert!(document.remove_table("line", 2).is_err());
}

#[test]
fn a_study_names_no_file_out_of_its_folder_and_options_have_ids_that_are_names() {
    let text = |scenario: &str, option: &str| {
        format!(
            "format = 1\nkind = \"study\"\nname = \"s\"\nscenario = '{scenario}'\nencounters = 4\nbaseline = \"a\"\n[[option]]\nid = \"a\"\n[[option]]\nid = '{option}'\n[encounter.speed]\nuniform = [\"0.8 m/s\", \"1.4 m/s\"]\nsource = \"assumed\"\n"
        )
    };
    for (scenario, option) in
        [("hello-endline", "b-600"), ("small.toml", "b"), ("below/s.toml", "b")]
    {
        endline_gear::Study::read("s.toml", &text(scenario, option)).unwrap();
    }
    let hostile = [
        ("../../../.cargo/config.toml", "b", "leads out of the study's folder", 4),
        ("/etc/x.toml", "b", "leads out of the study's folder", 4),
        ("../x", "b", "leads out of the study's folder", 4),
        ("hello-endline", "../../x", "is not a valid `id`", 10),
        ("hello-endline", "", "is not a valid `id`", 10),
        ("hello-endline", "=cmd|calc", "is not a valid `id`", 10),
    ];
    for (scenario, option, says, line) in hostile {
        let problems = endline_gear::Study::read("s.toml", &text(scenario, option)).unwrap_err();
        let found = problems.iter().find(|problem| problem.message.contains(says));
        assert!(found.is_some_and(|one| one.line == line && !one.help.is_empty()), "{problems:?}");
    }
}

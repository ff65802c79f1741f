//! Mistakes in packs are reported all at once, each at its line.

use super::super::packs::read_text;

const PACK: &str = r#"format = 1
kind = "rules"
name = "Test"
jurisdiction = "X"
[[area]]
id = "bay"
name = "The bay"
[[rule]]
id = "x.one"
asks = "Something."
cite = "a law"
source = "a page"
confidence = "measured"
standing = "law"
from = "2022-05-01"
until = "2023-05-01"
areas = ["bay"]
depth = ["0 m", "30 m"]
season = [300, 60]
subject = "every endline"
when = "traps >= 1"
check = "least_rated <= strength && longest_gap(weak_places(line, strength)) <= spacing"
remedy = "Change it."
[rule.parameters]
strength = "1,700 lbf"
spacing = { value = "60 ft", source = "another page", confidence = "estimate" }
"#;

#[test]
fn a_pack_is_read() {
    let pack = read_text("rules/x.toml", PACK).unwrap_or_else(|problems| panic!("{problems:?}"));
    let rule = &pack.rules[0];
    assert_eq!(
        (pack.id.as_str(), rule.season, rule.depth_m),
        ("x", Some([300, 60]), Some([0.0, 30.0]))
    );
    let spacing = &rule.parameters[1];
    assert!((spacing.value - 18.288).abs() < 1e-12);
    assert_eq!(spacing.unit.map(endline_gear::units::Unit::name), Some("ft"));
    assert_eq!((spacing.source.as_str(), spacing.confidence.word()), ("another page", "estimate"));
}

#[test]
fn each_mistake_stands_at_its_line() {
    for (from, to, message, line) in [
        ("standing = \"law\"", "standing = \"lax\"", "`lax` is not a value of `standing`", 14),
        ("from = \"2022-05-01\"", "from = \"2022-02-30\"", "`2022-02-30` is not a date", 15),
        ("until = \"2023-05-01\"", "until = \"2021-05-01\"", "before `from`", 16),
        ("\"30 m\"", "\"30 lbf\"", "`lbf` is a unit of a force", 18),
        ("[300, 60]", "[300, 400]", "does not consist of days of the year", 19),
        ("traps >= 1", "trap >= 1", "no fact or parameter `trap`", 21),
        ("traps >= 1", "traps", "is a plain number, not true or false", 21),
        ("traps >= 1", "traps >= 1 &&", "cannot be read", 21),
        ("traps >= 1", "traps >= 1 ; 2", "`;` has no place here", 21),
        ("<= spacing", "<= strength", "`<=` compares a length and a force", 22),
        (
            "longest_gap(weak_places(line, strength))",
            "longest_gap(line)",
            "`longest_gap` takes places",
            22,
        ),
        ("(line, strength)", "(line, spacing)", "`weak_places` takes an endline and a force", 22),
        ("remedy = ", "remmedy = ", "unknown field `remmedy`", 23),
        ("1,700 lbf", "1,700 lbs of force", "unknown unit `lbs of force`", 25),
        ("spacing = {", "weak_places_x = {", "begins with the name of the function", 26),
        ("spacing = {", "traps = {", "`traps` is the name of a fact", 26),
        ("subject = \"every endline\"", "", "no fact or parameter `least_rated`", 22),
    ] {
        let text = PACK.replacen(from, to, 1);
        let problems = read_text("x.toml", &text).unwrap_err();
        let found = problems.iter().find(|problem| problem.message.contains(message));
        let found = found.unwrap_or_else(|| panic!("{message}: {problems:?}"));
        assert_eq!(found.line, line, "{found:?}");
    }
}

#[test]
fn mistakes_are_reported_all_at_once_and_words_of_an_expression_at_their_column() {
    let many = PACK.replacen("2022-05-01", "May", 1).replacen("\"law\"", "\"lax\"", 1).replacen(
        "traps >= 1",
        "trap >= 1 && trips > 2",
        1,
    );
    let problems = read_text("x.toml", &many).unwrap_err();
    assert_eq!(problems.len(), 4, "{problems:?}");
    let columns: Vec<usize> =
        problems.iter().filter(|one| one.line == 21).map(|one| one.column).collect();
    assert_eq!(columns, [9, 22]);
    assert!(problems.iter().any(|one| one.help.contains("did you mean `traps`?")), "{problems:?}");
}

/// Any expression is read or refused; none panics.
#[test]
fn no_expression_panics() {
    for wrong in [
        "",
        "(",
        ")",
        "()",
        "{",
        "}",
        ",",
        "traps,",
        "(,)",
        "-",
        "--",
        "traps traps",
        "1 2",
        "µ",
        "traps ≤ 1",
        "!",
        "!traps",
        "longest_gap",
        "longest_gap()",
        "weak_places(",
        "weak_places(line)",
        "weak_places(,)",
        "weak_places(line, strength, strength)",
        "place_from(line, 1) <= 1",
        "1 && 2",
        "traps < 1 < 2",
        "1 / 0 <= 1 / 0 - ",
        "line",
        "line == line",
        "1..2 < 3",
        "traps >= 1 || (",
        "|| ||",
        "weak_placesline",
        "count_of(1, 2) < 3",
    ] {
        let text = PACK.replacen("traps >= 1", wrong, 1);
        let problems = read_text("x.toml", &text).expect_err(wrong);
        assert_eq!(problems[0].line, 21, "{wrong}: {problems:?}");
    }
}

//! Every rule of the shipped packs with gear that passes and gear that fails, and mistakes in packs.

mod gear;
mod mistakes;

use std::path::{Path, PathBuf};

use endline_gear::Date;
use endline_gear::units::{Quantity, parse};

use super::facts::FACTS;
use super::gear::Gear;
use super::measure::{Part, fits, value};
use super::{Fishing, Packs, RuleResult, Verdict, check};
use gear::{ONE_INSERT, STOWED, TWO_INSERTS, WEAK, assembled, flyer, inserts, line, link, rig};

fn library() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library")
}

fn packs() -> Packs {
    Packs::open(Some(&library()), &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// Fishing as `area, day, distance, traps`; what is empty is not given.
fn fishing(text: &str) -> Fishing {
    let words: Vec<&str> = text.split(',').map(str::trim).collect();
    let word = |at: usize| words.get(at).filter(|word| !word.is_empty());
    Fishing {
        area: words[0].to_owned(),
        on: Date::parse(words[1]).unwrap(),
        depth_m: Some(25.0),
        distance_m: word(2).map(|length| parse(length, Quantity::Length).unwrap()),
        traps: word(3).map(|traps| traps.parse().unwrap()),
    }
}

fn verdict(packs: &Packs, rule: &str, gear: &str, place: &str) -> RuleResult {
    let sheet = check(&assembled(gear), packs, &fishing(place)).unwrap();
    sheet.rules.into_iter().find(|result| result.rule == rule).unwrap()
}

/// A rule, where it is fished, gear that passes, gear that fails.
fn cases() -> Vec<(&'static str, &'static str, String, String)> {
    let strong = || line("sink-3-8", "40 m");
    let on = |lines: &[String]| rig(1, "sink-3-8", "20 m", lines);
    let traps = |count, lines: &[String]| rig(count, "sink-3-8", "20 m", lines);
    let with = |inserts: &str| on(&[strong() + inserts]);
    let weaker = "delivered_strength = \"1,200 lbf\"\n";
    vec![
        ("us.weak", "lma-1, 2024-06-01", on(&[line(WEAK, "40 m")]), on(&[strong()])),
        ("us.weak", "lma-1, 2024-06-01", with(ONE_INSERT), on(&[strong() + &link("wl-600")])),
        (
            "us.approve.within",
            "lma-1, 2024-06-01",
            on(&[line(WEAK, "40 m")]),
            with("[line.inserts]\nsleeve = \"wl-1500\"\nevery = \"20 m\"\n"),
        ),
        (
            "us.approve.most",
            "lma-1, 2024-06-01",
            on(&[line(WEAK, "40 m")]),
            on(&[line("pp-3-8", "40 m") + weaker]),
        ),
        (
            "us.insert.length",
            "lma-1, 2024-06-01",
            with(&inserts("3 ft", "12 ft", "60 ft")),
            with(&inserts("2 ft", "12 ft", "60 ft")),
        ),
        (
            "us.groundline",
            "lma-1, 2024-06-01",
            rig(2, "sink-103-3-8", "20 m", &[strong()]),
            rig(2, "pp-3-8", "20 m", &[strong()]),
        ),
        (
            "us.groundline.floats",
            "lma-1, 2024-06-01",
            traps(2, &[strong()]),
            traps(2, &[strong()])
                + "[[body]]\nid = \"float\"\nkind = \"buoy\"\nitem = \"bullet-5x11\"\nheight = 0.1\n"
                + "[[line]]\nid = \"tether\"\nrope = \"sink-3-8\"\nfrom = \"trap-1\"\nto = \"float\"\nlength = \"2 m\"\n",
        ),
        ("us.oneline", "lma-1, 2024-06-01", traps(3, &[strong()]), traps(3, &[strong(), strong()])),
        ("us.surface", "lma-1, 2024-06-01", on(&[strong()]), on(&[line("pp-3-8", "40 m")])),
        (
            "us.length",
            "lma-2, 2024-06-01, 5 nmi",
            traps(3, &[strong()]),
            rig(3, "sink-3-8", "1500 m", &[strong()]),
        ),
        (
            "us.length.lma-3",
            "lma-3, 2024-06-01",
            rig(3, "sink-3-8", "1500 m", &[strong()]),
            rig(3, "sink-3-8", "1700 m", &[strong()]),
        ),
        (
            "us.reflector",
            "lma-1, 2024-06-01, 5 nmi",
            traps(4, &[strong()]) + &flyer("high-flyer", "2 fathom"),
            traps(4, &[strong()]),
        ),
        (
            "us.topper.lma-3",
            "lma-3, 2024-06-01",
            traps(2, &[strong(), line(WEAK, "40 m")]),
            traps(2, &[strong(), strong()]),
        ),
        ("me.inserts.3-12.two", "me-b, 2024-06-01, 5 nmi", with(TWO_INSERTS), with(ONE_INSERT)),
        ("me.inserts.3-12.one", "me-f, 2024-06-01, 5 nmi", with(ONE_INSERT), on(&[strong()])),
        ("me.inserts.12plus", "me-b, 2024-06-01, 15 nmi", with(ONE_INSERT), with(TWO_INSERTS)),
        ("me.inserts.inside-3", "me-b, 2024-06-01, 1 nmi", with(TWO_INSERTS), with(ONE_INSERT)),
        ("me.singles", "me-b, 2024-06-01, 5 nmi", traps(2, &[strong()]), on(&[strong()])),
        ("ma.diameter", "ma-lma-1, 2024-06-01", on(&[strong()]), on(&[line("sink-1-2", "40 m")])),
        (
            "ma.strength",
            "ma-lma-1, 2024-06-01",
            with(&inserts("3 ft", "12 ft", "60 ft")),
            with(&inserts("3 ft", "12 ft", "90 ft")),
        ),
        (
            "ma.surface",
            "ma-lma-1, 2024-06-01",
            with(&inserts("3 ft", "12 ft", "60 ft")),
            with(&inserts("3 ft", "6 ft", "60 ft")),
        ),
        (
            "legacy.buoylink",
            "lma-1, 2020-06-01",
            on(&[strong() + &link("wl-600")]),
            on(&[strong()]),
        ),
        (
            "legacy.buoylink.lma-3",
            "lma-3, 2020-06-01",
            on(&[strong() + &link("wl-1500")]),
            on(&[strong() + &link("wl-2000")]),
        ),
        (
            "legacy.me.exempt",
            "me-c, 2020-06-01, 1 nmi",
            on(&[strong()]),
            on(&[line("pp-3-8", "40 m")]),
        ),
        ("ca.weak", "atlantic-canada, 2024-06-01", on(&[line(WEAK, "40 m")]), on(&[strong()])),
        (
            "ca.crab.buoy",
            "gulf-snow-crab, 2024-06-01",
            on(&[strong()]) + &flyer("polyball-a1", "3.6 m"),
            on(&[strong()]) + &flyer("polyball-a1", "5 m"),
        ),
    ]
}

/// Rules on numbers of traps: the least that passes, at a place.
const TRAPS: [(&str, &str, u16); 9] = [
    ("us.traps.3-6", "lma-1, 2024-06-01, 5 nmi", 8),
    ("us.traps.6-12", "lma-1, 2024-06-01, 6 nmi", 10),
    ("us.traps.12plus", "lma-1, 2024-06-01, 12 nmi", 25),
    ("us.traps.lma-3", "lma-3, 2024-06-01, 60 nmi", 35),
    ("legacy.traps.inside-3", "me-a-west, 2020-06-01, 1 nmi", 2),
    ("legacy.traps.3-6", "me-a-west, 2020-06-01, 3 nmi", 3),
    ("legacy.traps.6-12.a-c", "me-c, 2020-06-01, 8 nmi", 5),
    ("legacy.traps.6-12.d-g", "me-d, 2020-06-01, 8 nmi", 10),
    ("legacy.traps.12plus", "me-g, 2020-06-01, 20 nmi", 15),
];

/// Rules that no assembly can pass or fail, because it does not say what they ask about.
const UNSAID: [(&str, &str); 9] = [
    ("us.insert.join", "lma-1, 2024-06-01"),
    ("us.insert.colour", "lma-1, 2024-06-01"),
    ("us.braid", "lma-1, 2024-06-01"),
    ("us.soak", "lma-1, 2024-06-01"),
    ("me.marks", "me-b, 2024-06-01"),
    ("me.marks.shallow", "me-b, 2024-06-01"),
    ("ma.marks", "ma-lma-2, 2024-06-01"),
    ("ma.marks.surface", "ma-lma-2, 2024-06-01"),
    ("ca.marks", "gulf-snow-crab, 2024-06-01"),
];

#[test]
fn every_rule_that_ships_passes_gear_and_fails_gear_or_cannot_be_checked() {
    let packs = packs();
    for (rule, place, passes, fails) in cases() {
        for (gear, expected) in [(passes, Verdict::Pass), (fails, Verdict::Fail)] {
            let result = verdict(&packs, rule, &gear, place);
            assert_eq!(result.verdict, expected, "{rule} on\n{gear}\n{result:?}");
            assert!(!result.measured.is_empty(), "{result:?}");
            assert_eq!(result.mend.is_empty(), expected == Verdict::Pass, "{result:?}");
        }
    }
    let single = rig(1, "sink-3-8", "20 m", &[line("sink-3-8", "40 m") + TWO_INSERTS]);
    for (rule, place, least) in TRAPS {
        for (traps, expected) in [(least, Verdict::Pass), (least - 1, Verdict::Fail)] {
            let result = verdict(&packs, rule, &single, &format!("{place}, {traps}"));
            assert_eq!(result.verdict, expected, "{rule} with {traps} traps: {result:?}");
        }
    }
    for (rule, place) in UNSAID {
        let result = verdict(&packs, rule, &single, place);
        assert_eq!(result.verdict, Verdict::CannotBeChecked, "{result:?}");
        assert!(result.why.starts_with("an assembly does not say"), "{result:?}");
    }
    let cases = cases();
    let tested: Vec<&str> = cases
        .iter()
        .map(|case| case.0)
        .chain(TRAPS.iter().map(|case| case.0))
        .chain(UNSAID.iter().map(|case| case.0))
        .collect();
    for (_, rule) in packs.rules() {
        assert!(tested.contains(&rule.id.value.as_str()), "`{}` is not tested", rule.id.value);
    }
}

#[test]
fn a_rule_applies_in_its_time_its_area_and_its_distance_and_says_what_it_needs() {
    let packs = packs();
    let single = rig(1, "sink-3-8", "20 m", &[line("sink-3-8", "40 m")]);
    for (rule, place, expected, why) in [
        ("us.weak", "lma-1, 2022-04-30", Verdict::NotApplicable, "in force from 2022-05-01"),
        ("us.weak", "me-b, 2022-05-01", Verdict::Fail, ""),
        ("legacy.buoylink", "lma-1, 2022-05-01", Verdict::NotApplicable, "until 2022-04-30"),
        ("us.weak", "gulf-snow-crab, 2024-01-01", Verdict::NotApplicable, "applies in lma-1"),
        ("me.singles", "me-b, 2024-01-01", Verdict::CannotBeChecked, "needs --distance"),
        ("me.singles", "me-b, 2024-01-01, 2 nmi", Verdict::NotApplicable, "at a distance from"),
        ("us.oneline", "me-b, 2024-01-01,, 6", Verdict::NotApplicable, "applies to 1 to 5 traps"),
        ("us.groundline", "me-b, 2024-01-01", Verdict::NotApplicable, "has no groundline"),
        (
            "us.reflector",
            "me-b, 2024-01-01",
            Verdict::NotApplicable,
            "applies where traps > single",
        ),
    ] {
        let result = verdict(&packs, rule, &single, place);
        assert_eq!((result.verdict, result.why.contains(why)), (expected, true), "{result:?}");
    }
    let stowed = rig(2, "sink-3-8", "20 m", &[]) + STOWED;
    for (rule, place, expected, why) in [
        ("us.weak", "lma-1, 2024-01-01", Verdict::NotApplicable, "the gear has no endline"),
        ("us.groundline.floats", "lma-1, 2024-01-01", Verdict::NotApplicable, "!stowed"),
        ("us.groundline", "lma-1, 2024-01-01", Verdict::Pass, ""),
    ] {
        let result = verdict(&packs, rule, &stowed, place);
        assert_eq!((result.verdict, result.why.contains(why)), (expected, true), "{result:?}");
        // The stowed floating line is no groundline.
        assert!(result.measured.len() <= 1, "{result:?}");
    }
    let nowhere = check(&assembled(&single), &packs, &fishing("lma-11, 2024-01-01"));
    assert!(nowhere.unwrap_err().to_string().contains("did you mean `lma-1`?"));
}

#[test]
fn every_fact_has_a_value_of_its_kind() {
    let gear =
        assembled(&rig(2, "sink-3-8", "20 m", &[line("sink-3-8", "40 m") + TWO_INSERTS])).gear;
    let fishing = fishing("lma-1, 2024-06-01, 5 nmi");
    let Gear { endlines, groundlines, .. } = &gear;
    for fact in FACTS {
        let parts = [Part::Gear, Part::Endline(&endlines[0]), Part::Groundline(&groundlines[0])];
        let values = parts.map(|part| value(fact, &gear, part, &fishing));
        assert!(values.iter().all(|value| fits(fact, value)), "{}: {values:?}", fact.name);
        let known =
            values.iter().any(|value| !matches!(value, super::value::Value::Unknown { .. }));
        assert_eq!(known, fact.about != super::facts::About::Unsaid, "{}", fact.name);
    }
}

#[test]
fn the_weakest_place_of_a_line_is_told_with_its_limit() {
    let gear = rig(
        1,
        "sink-3-8",
        "20 m",
        &[line("sink-3-8", "40 m") + &inserts("3 ft", "12 ft", "60 ft")],
    );
    let result = verdict(&packs(), "ma.strength", &gear, "ma-lma-1, 2024-06-01");
    // Every 60 ft from near edge to near edge, 3 ft long: 57 ft between two.
    assert_eq!(result.measured.len(), 1, "{result:?}");
    assert_eq!(result.measured[0].says, "57 ft <= 60 ft");
    assert!((result.measured[0].value.unwrap() - 57.0 * 0.3048).abs() < 1e-6);
    assert_eq!(result.measured[0].part, "endline-1");
}

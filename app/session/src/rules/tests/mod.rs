//! Every rule of the shipped packs with gear that passes and gear that fails, and mistakes in packs.

mod cases;
pub mod gear;
mod mistakes;

use endline_gear::Date;
use endline_gear::units::{Quantity, parse};

use super::facts::{FACTS, Part, fits, value};
use super::gear::Gear;
use super::{Fishing, Packs, RuleResult, Verdict, check};
use cases::{TRAPS, UNSAID, federal, others};
use gear::{STOWED, TWO_INSERTS, assembled, inserts, library, line, rig};

pub fn packs() -> Packs {
    Packs::open(Some(&library()), &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// Fishing as `area, day, distance, traps`; an empty one is not stated.
pub fn fishing(text: &str) -> Fishing {
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

#[test]
fn every_rule_that_ships_passes_gear_and_fails_gear_or_cannot_be_checked() {
    let packs = packs();
    let cases: Vec<cases::Case> = federal().into_iter().chain(others()).collect();
    for (rule, place, passes, fails) in &cases {
        for (gear, expected) in [(passes, Verdict::Pass), (fails, Verdict::Fail)] {
            let result = verdict(&packs, rule, gear, place);
            assert_eq!(result.verdict, expected, "{rule} on\n{gear}\n{result:?}");
            assert!(!result.measured.is_empty(), "{result:?}");
            assert_eq!(result.remedy.is_empty(), expected == Verdict::Pass, "{result:?}");
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
fn a_sheet_says_what_is_missing_for_verdicts_that_bind() {
    let (packs, gear) = (packs(), rig(1, "sink-3-8", "20 m", &[line("sink-3-8", "40 m")]));
    let missing = |place: &str| {
        let sheet = check(&assembled(&gear), &packs, &fishing(place)).unwrap();
        sheet.missing().unwrap()
    };
    let far = missing("me-b, 2024-01-01");
    assert!(far.contains("need distance"), "{far}");
    let known = missing("me-b, 2024-01-01, 5 nmi");
    assert!(
        !known.contains("distance") && known.contains("the assembly does not state"),
        "{known}"
    );
    assert_eq!(packs.area_of_site("cape-cod-bay"), Some("ma-lma-1"));
    assert_eq!(packs.area_of_site("inner-sound"), None);
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
fn the_weakest_place_of_a_line_is_reported_with_its_limit() {
    let gear = rig(
        1,
        "sink-3-8",
        "20 m",
        &[line("sink-3-8", "40 m") + &inserts("3 ft", "12 ft", "60 ft")],
    );
    let result = verdict(&packs(), "ma.strength", &gear, "ma-lma-1, 2024-06-01");
    // Every 60 ft from near edge to near edge, 3 ft long: 57 ft between two.
    assert_eq!(result.measured.len(), 1, "{result:?}");
    assert_eq!(result.measured[0].says, "57 ft; at most 60 ft allowed");
    assert!((result.measured[0].value.unwrap() - 57.0 * 0.3048).abs() < 1e-6);
    assert_eq!(result.measured[0].part, "endline-1");
}

#[test]
fn a_gillnet_says_that_no_pack_has_a_rule_for_it_until_one_has() {
    let packs = packs();
    let single = rig(1, "sink-3-8", "20 m", &[line("sink-3-8", "40 m")]);
    let netting = "[[joint]]\nid = \"head\"\nposition = [\"30 m\", \"0 m\"]\nheight = 0.2\n\
        [[line]]\nid = \"mesh\"\nrope = \"gillnet-netting\"\nfrom = \"trap-1\"\nto = \"head\"\nlength = \"3 m\"\n";
    let place = fishing("lma-1, 2024-06-01");
    let of = |text: &str, packs: &Packs| check(&assembled(text), packs, &place).unwrap().uncovered;
    assert!(of(&single, &packs).is_empty());
    let net = single + netting;
    let said = of(&net, &packs);
    assert!(said.len() == 1 && said[0].starts_with("no gillnet rule is in any pack"), "{said:?}");
    let text = "format = 1\nkind = \"rules\"\nname = \"Nets\"\njurisdiction = \"X\"\n[[rule]]\nid = \"net.lines\"\nasks = \"Few.\"\n\
        cite = \"x\"\nsource = \"a test\"\nconfidence = \"estimate\"\nstanding = \"law\"\nfrom = \"unknown\"\n\
        when = \"netting_lines >= 1\"\ncheck = \"netting_lines <= most\"\nremedy = \"Fewer.\"\n[rule.parameters]\nmost = 1\n";
    let folder = std::env::temp_dir().join(format!("endline-net-rules-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("nets.toml");
    std::fs::write(&file, text).unwrap();
    let with_nets = Packs::open(Some(&library()), std::slice::from_ref(&file));
    let with_nets = with_nets.unwrap_or_else(|error| panic!("{error}"));
    std::fs::remove_dir_all(&folder).unwrap();
    let sheet = check(&assembled(&net), &with_nets, &place).unwrap();
    assert!(sheet.uncovered.is_empty());
    let found = sheet.rules.iter().find(|one| one.rule == "net.lines").unwrap();
    assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
}

/// Weak places of an endline, from its `from` end.
fn weak_places(strength: &str, every: &str) -> String {
    format!(
        "[line.weak_places]\nstrength = \"{strength}\"\nevery = \"{every}\"\nfirst = \"30 ft\"\n"
    )
}

#[test]
fn weak_places_comply_where_sleeves_of_the_same_strength_do() {
    let packs = packs();
    let with = |make: &str| rig(1, "sink-3-8", "20 m", &[line("sink-3-8", "40 m") + make]);
    let sleeves = |every: &str| {
        with(&format!(
            "[line.inserts]\nsleeve = \"south-shore-1700\"\nevery = \"{every}\"\nfirst = \"30 ft\"\ncounted_from = \"from\"\n"
        ))
    };
    let massachusetts = "ma-lma-1, 2024-06-01";
    let maine = "me-b, 2024-06-01, 5 nmi";
    for (rule, place) in [
        ("us.weak", massachusetts),
        ("us.approve.within", massachusetts),
        ("us.approve.most", massachusetts),
        ("us.insert.length", massachusetts),
        ("ma.strength", massachusetts),
        ("ma.surface", massachusetts),
        ("me.inserts.3-12.two", maine),
        ("me.inserts.12plus", "me-b, 2024-06-01, 15 nmi"),
        ("ca.weak", "atlantic-canada, 2024-06-01"),
    ] {
        for every in ["60 ft", "90 ft"] {
            let place_there = verdict(&packs, rule, &with(&weak_places("1,700 lbf", every)), place);
            let sleeve_there = verdict(&packs, rule, &sleeves(every), place);
            let both = format!("{rule}, {every}: {place_there:?}, {sleeve_there:?}");
            assert_eq!(place_there.verdict, sleeve_there.verdict, "{both}");
            let says = |result: &RuleResult| {
                result.measured.iter().map(|one| one.says.clone()).collect::<Vec<_>>()
            };
            // The mean of ten breaks is a figure of the product.
            if !rule.starts_with("us.approve") {
                assert_eq!(says(&place_there), says(&sleeve_there), "{both}");
            }
        }
    }
    // 40 m are 131.2 ft: places at 30 and 90 ft from the trap are 41.2 and 101.2 ft from the buoy,
    // and the top three quarters end at 98.4 ft.
    let found = |make: &str, rule| verdict(&packs, rule, &with(make), massachusetts);
    let passes = found(&weak_places("1,700 lbf", "60 ft"), "ma.strength");
    assert_eq!(passes.verdict, Verdict::Pass, "{passes:?}");
    assert_eq!(passes.measured.last().unwrap().says, "57.19 ft; at most 60 ft allowed");
    let far_apart = found(&weak_places("1,700 lbf", "90 ft"), "ma.strength");
    assert_eq!(far_apart.verdict, Verdict::Fail, "{far_apart:?}");
    let strong = weak_places("1,800 lbf", "60 ft");
    for rule in ["us.weak", "ma.strength"] {
        let too_strong = found(&strong, rule);
        assert_eq!(too_strong.verdict, Verdict::Fail, "{too_strong:?}");
    }
    // The weakest place is named.
    let least = found(&strong, "us.weak");
    assert_eq!(least.measured[0].says, "1,800 lbf; at most 1,700 lbf allowed");
    assert_eq!(least.measured[0].part, "endline-1.weak-places");
}

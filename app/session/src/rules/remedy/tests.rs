//! Remedies of gear: each proposal meets its rule on a copy assembled from its text alone, and names the rules that it breaks.

use endline_gear::Sources;

use super::super::tests::gear::{
    STOWED, TWO_INSERTS, WEAK, flyer, inserts, library, line, link, rig,
};
use super::super::tests::{fishing, packs};
use super::*;
use crate::json;

fn sources() -> Sources {
    Sources::from_folder(&library()).unwrap()
}

fn found(text: &str, place: &str) -> Remedies {
    let (packs, fishing) = (packs(), fishing(place));
    let asked = Asked { id: "test", text, sources: &sources() };
    remedies(asked, &packs, &fishing, &PluginHost::empty())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn of<'a>(all: &'a Remedies, rule: &str) -> &'a Remedy {
    all.rules.iter().find(|one| one.rule == rule).unwrap_or_else(|| panic!("{rule}: {all:?}"))
}

/// A rule, where gear that fails it is fished, that gear, and what an edit says.
type Case = (&'static str, &'static str, String, &'static str);

fn of_endlines_and_traps() -> Vec<Case> {
    let strong = || line("sink-3-8", "40 m");
    let on = |lines: &[String]| rig(1, "sink-3-8", "20 m", lines);
    vec![
        ("us.weak", "lma-1, 2024-06-01", on(&[strong()]), "at 50 % of endline-1 (20 m"),
        (
            "ma.diameter",
            "ma-lma-1, 2024-06-01",
            on(&[line("sink-1-2", "40 m")]),
            "endline-1 of `sink-3-8`",
        ),
        (
            "ma.strength",
            "ma-lma-1, 2024-06-01",
            on(&[strong()]),
            "every 60 ft into the top 75 % of endline-1",
        ),
        (
            "ma.surface",
            "ma-lma-1, 2024-06-01",
            on(&[strong() + &inserts("3 ft", "6 ft", "60 ft")]),
            "Move the first insert 12 ft down",
        ),
        (
            "me.inserts.3-12.two",
            "me-b, 2024-06-01, 5 nmi",
            on(&[strong()]),
            "at 25 % and 50 % of endline-1 (10, 20 m",
        ),
        (
            "me.singles",
            "me-b, 2024-06-01, 5 nmi",
            on(&[strong()]),
            "Add traps up to 2 behind `trap-1`",
        ),
        (
            "us.traps.3-6",
            "lma-1, 2024-06-01, 5 nmi",
            rig(3, "sink-3-8", "20 m", &[strong()]),
            "Add traps up to 8 behind `trap-3`, 20 m of `sink-3-8`",
        ),
        (
            "us.groundline",
            "lma-1, 2024-06-01",
            rig(2, "pp-3-8", "20 m", &[strong()]),
            "Make groundline-1 of `sink-",
        ),
        (
            "us.surface",
            "lma-1, 2024-06-01",
            on(&[line("pp-3-8", "40 m")]),
            "Make endline-1 of `sink-",
        ),
        (
            "us.oneline",
            "lma-1, 2024-06-01",
            rig(3, "sink-3-8", "20 m", &[strong(), strong()]),
            "Take endline-2 off, with its buoy.",
        ),
    ]
}

fn of_inserts_links_and_lengths() -> Vec<Case> {
    let strong = || line("sink-3-8", "40 m");
    let on = |lines: &[String]| rig(1, "sink-3-8", "20 m", lines);
    vec![
        (
            "us.insert.length",
            "lma-1, 2024-06-01",
            on(&[strong() + &inserts("2 ft", "12 ft", "60 ft")]),
            "Put in inserts of 3 ft",
        ),
        (
            "us.length",
            "lma-2, 2024-06-01, 5 nmi",
            rig(3, "sink-3-8", "1500 m", &[strong()]),
            "Shorten each groundline to 92.51 %",
        ),
        (
            "us.reflector",
            "lma-1, 2024-06-01, 5 nmi",
            rig(4, "sink-3-8", "20 m", &[strong()]),
            "Put the high-flyer `high-flyer`",
        ),
        (
            "us.groundline.floats",
            "lma-1, 2024-06-01",
            rig(2, "sink-3-8", "20 m", &[strong()])
                + "[[body]]\nid = \"float\"\nkind = \"buoy\"\nitem = \"bullet-5x11\"\nheight = 0.1\n\
                   [[line]]\nid = \"tether\"\nrope = \"sink-3-8\"\nfrom = \"trap-1\"\nto = \"float\"\nlength = \"2 m\"\n",
            "Take float off.",
        ),
        ("legacy.buoylink", "lma-1, 2020-06-01", on(&[strong()]), "Put the weak link `wl-600`"),
        (
            "legacy.buoylink",
            "lma-1, 2020-06-01",
            on(&[strong() + &link("wl-1500")]),
            "Put the weak link `wl-600`",
        ),
        (
            "ca.crab.buoy",
            "gulf-snow-crab, 2024-06-01",
            on(&[strong()]) + &flyer("polyball-a1", "5 m"),
            "Shorten the rope between the buoys to 3.7 m",
        ),
        (
            "us.topper.lma-3",
            "lma-3, 2024-06-01",
            rig(2, "sink-3-8", "20 m", &[strong(), strong()]),
            "Make endline-1 of `weak-1700-3-8`",
        ),
    ]
}

#[test]
fn each_kind_of_edit_is_proposed_for_the_rule_that_asks_for_it() {
    let cases = of_endlines_and_traps().into_iter().chain(of_inserts_links_and_lengths());
    for (rule, place, gear, says) in cases {
        let remedies = found(&gear, place);
        let remedy = of(&remedies, rule);
        let all: Vec<&str> = remedy.proposals.iter().map(|edit| edit.says.as_str()).collect();
        assert!(all.iter().any(|one| one.contains(says)), "{rule}: {all:?}, {}", remedy.why_none);
        assert!(
            remedy.why_none.is_empty() && remedy.binding == (rule != "ma.surface"),
            "{remedy:?}"
        );
        for edit in &remedy.proposals {
            // The same from the text alone, by another way: the check of a user.
            let again = super::super::tests::gear::assembled(&edit.text);
            let sheet = super::super::check(&again, &packs(), &fishing(place)).unwrap();
            let after = sheet.rules.iter().find(|one| one.rule == rule).unwrap();
            assert_eq!(after.verdict, Verdict::Pass, "{}", edit.text);
            assert!(!edit.changes.is_empty(), "{edit:?}");
        }
    }
}

#[test]
fn proposals_stand_by_how_little_they_change_and_tell_what_they_break() {
    let strong = line("sink-3-8", "40 m");
    let remedies = found(&rig(1, "sink-3-8", "20 m", &[strong]), "me-b, 2024-06-01, 5 nmi");
    let edits = &of(&remedies, "me.inserts.3-12.two").proposals;
    // Sleeves add no rope; two inserts of 3 ft are 4.6 % of 40 m; the whole line is all of it.
    let shares: Vec<f64> = edits.iter().map(|edit| edit.rope_share).collect();
    assert!(shares.is_sorted() && shares[0].abs() < 1e-12, "{shares:?}");
    let of_inserts = edits.iter().find(|edit| edit.says.contains("3 ft inserts")).unwrap();
    assert!((of_inserts.rope_share - 2.0 * 0.9144 / 40.0).abs() < 1e-9, "{of_inserts:?}");
    let of_weak_rope = edits.iter().find(|edit| edit.says.starts_with("Make endline-1")).unwrap();
    assert!((of_weak_rope.rope_share - 1.0).abs() < 1e-9, "{of_weak_rope:?}");
    assert!(edits.iter().all(|edit| edit.passes.contains(&"us.weak".to_owned())), "{edits:?}");
    assert!(edits.iter().all(|edit| edit.still_fails.contains(&"me.singles".to_owned())));

    // Massachusetts' inserts every 60 ft, moved to Maine's places, leave gaps that Massachusetts does not allow.
    let inserted = line("sink-3-8", "100 m") + &inserts("3 ft", "12 ft", "60 ft");
    let text = rig(1, "sink-3-8", "20 m", &[inserted]);
    let place = "ma-lma-1, 2024-06-01";
    let sheet = |text: &str| {
        super::super::check(&super::super::tests::gear::assembled(text), &packs(), &fishing(place))
    };
    let passes = |text: &str| {
        let rules = sheet(text).unwrap().rules;
        rules.iter().find(|one| one.rule == "ma.strength").unwrap().verdict == Verdict::Pass
    };
    assert!(passes(&text));
    let maine = found(&text, "me-f, 2024-06-01, 5 nmi");
    let edits = &of(&maine, "me.inserts.3-12.one").proposals;
    let one = edits.iter().find(|edit| edit.says.contains("at 33 %")).unwrap();
    assert!(!passes(&one.text), "{}", one.text);
}

#[test]
fn the_usual_inserts_lie_every_sixty_feet_through_all_lines_of_an_endline() {
    // 30 m of one rope over 70 m of another: seen from the buoy, the first line ends between two inserts.
    let lower = line("pp-3-8", "70 m");
    let top = "[[joint]]\nid = \"splice\"\nposition = [\"20 m\", \"0 m\"]\nheight = 0.7\n\
               [[line]]\nid = \"top\"\nfrom = \"splice\"\nto = \"buoy-1\"\nrope = \"sink-3-8\"\nlength = \"30 m\"\n";
    let text =
        rig(1, "sink-3-8", "20 m", &[lower]).replace("\"buoy-1\"\nrope", "\"splice\"\nrope") + top;
    let asked = Asked { id: "test", text: &text, sources: &sources() };
    let made = usual_inserts(asked, None, &PluginHost::empty()).unwrap();
    let gear = super::super::tests::gear::assembled(&made.text).gear;
    let mut at_m = 0.0;
    let mut starts = Vec::new();
    for piece in &gear.endlines[0].pieces {
        starts.extend(piece.id.contains(".insert-").then_some(at_m));
        at_m += piece.length_m;
    }
    assert!((at_m - 100.0).abs() < 1e-9);
    // 12 ft, then every 60 ft while an insert of 3 ft ends within 75 m.
    let feet = [12.0, 72.0, 132.0, 192.0];
    assert_eq!(starts.len(), feet.len(), "{starts:?}");
    for (start_m, feet) in starts.iter().zip(feet) {
        assert!((start_m - 0.3048 * feet).abs() < 0.006, "{starts:?}: {}", made.text);
    }
    let bare = rig(2, "sink-3-8", "20 m", &[]);
    let asked = Asked { id: "test", text: &bare, sources: &sources() };
    let none = usual_inserts(asked, None, &PluginHost::empty()).unwrap_err().to_string();
    assert!(none.contains("no endline"), "{none}");
}

#[test]
fn a_rule_that_no_edit_meets_says_why() {
    let single = rig(1, "sink-3-8", "20 m", &[line("sink-3-8", "40 m") + TWO_INSERTS]);
    let by_call = found(&single, "me-b, 2024-06-01, 5 nmi, 1");
    let singles = of(&by_call, "me.singles");
    assert!(
        singles.proposals.is_empty() && singles.why_none.contains("given by the call"),
        "{singles:?}"
    );
    let marks = of(&by_call, "me.marks");
    assert_eq!(marks.verdict, Verdict::CannotBeChecked);
    assert!(marks.proposals.is_empty() && marks.why_none.contains("does not say"), "{marks:?}");
    let needs = of(&found(&single, "me-b, 2024-06-01"), "me.singles").why_none.clone();
    assert!(needs.contains("--distance"), "{needs}");
    // Nothing fails on gear without an endline.
    let stowed = found(&(rig(2, "sink-3-8", "20 m", &[]) + STOWED), "lma-1, 2024-06-01");
    assert!(stowed.all.is_none() && stowed.rules.iter().all(|one| one.verdict != Verdict::Fail));
}

#[test]
fn all_edits_together_meet_every_rule_that_binds() {
    let text = rig(1, "sink-3-8", "20 m", &[line("sink-1-2", "40 m")]);
    let remedies = found(&text, "me-b, 2024-06-01, 5 nmi");
    let all = remedies.all.as_ref().unwrap();
    assert!(all.still_fails.is_empty() && all.breaks.is_empty(), "{all:?}");
    let again = super::super::tests::gear::assembled(&all.text);
    let sheet = super::super::check(&again, &packs(), &fishing("me-b, 2024-06-01, 5 nmi")).unwrap();
    assert!(!sheet.fails_binding(), "{}\n{}", all.text, json::indented(&sheet));
    // Eight traps in the place of one.
    assert_eq!(sheet.traps, 8);
    let weak = found(&rig(2, "sink-3-8", "20 m", &[line(WEAK, "40 m")]), "lma-1, 2024-06-01");
    assert!(weak.all.is_none(), "gear that passes needs no edit: {:?}", weak.all);
}

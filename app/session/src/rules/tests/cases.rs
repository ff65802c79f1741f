//! Rules with gear that passes and gear that fails.

use super::gear::{ONE_INSERT, TWO_INSERTS, WEAK, flyer, inserts, line, link, rig};

/// A rule, where it is fished, gear that passes, gear that fails.
pub type Case = (&'static str, &'static str, String, String);

/// Federal rules of the Northeast United States.
pub fn federal() -> Vec<Case> {
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
    ]
}

/// Rules of states, rules that were replaced, and Canada's.
pub fn others() -> Vec<Case> {
    let strong = || line("sink-3-8", "40 m");
    let on = |lines: &[String]| rig(1, "sink-3-8", "20 m", lines);
    let traps = |count, lines: &[String]| rig(count, "sink-3-8", "20 m", lines);
    let with = |inserts: &str| on(&[strong() + inserts]);
    vec![
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
pub const TRAPS: [(&str, &str, u16); 9] = [
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

/// Rules that no assembly can pass or fail, because it does not describe their facts.
pub const UNSAID: [(&str, &str); 9] = [
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

//! The sections of runs whose cost is measured.

/// A section of a scenario's run.
pub struct Section<'a> {
    pub name: &'a str,
    pub scenario: &'a str,
    /// Replacements in its text.
    pub changes: &'static [(&'static str, &'static str)],
    /// Times at which it begins and ends [s].
    pub time_s: [f64; 2],
    /// Time after its begin in which instructions are counted [s].
    pub counted_s: f64,
}

/// All sections, from free rope to rope that touches skin and rope everywhere.
pub const SECTIONS: [Section<'_>; 13] = [
    section("far", "hello-endline", &[NODES], [1.0, 9.0], 4.0),
    section("near", "hello-endline", &[NODES], [10.5, 12.0], 1.5),
    section("sliding", "hello-endline", UNIFORM, [15.0, 33.0], 1.0),
    section("fine", "hello-endline", &[NODES], [15.0, 33.0], 1.0),
    section("roll", "case-e25-05-roll", &[], [9.0, 13.0], 1.0),
    section("wound", "dead-whale-wraps", &[], [1.0, 4.0], 0.1),
    section("wound-tight", "dead-whale-wraps", TIGHT, [1.0, 2.0], 0.05),
    section("hitches", "hitches", &[], [0.5, 1.5], 0.2),
    section("twisted-bight", "twisted-bight", &[], [4.0, 6.0], 0.5),
    section("held", "../benches/encounter/held", &[], [14.0, 16.0], 0.5),
    section("trawl-20", "trawl-10", &[TRAWL], [1.0, 5.0], 2.0),
    section("far-tide", "hello-endline", &[NODES, TIDE], [1.0, 9.0], 4.0),
    section("trawl-20-tide", "trawl-10", &[TRAWL, TIDE], [1.0, 5.0], 2.0),
];

const fn section<'a>(
    name: &'a str,
    scenario: &'a str,
    changes: &'static [(&'static str, &'static str)],
    time_s: [f64; 2],
    counted_s: f64,
) -> Section<'a> {
    Section { name, scenario, changes, time_s, counted_s }
}

/// Half of the nodes of the shipped scenario.
const NODES: (&str, &str) = ("rope_nodes = 1000", "rope_nodes = 500");

/// Segments of constant length.
const UNIFORM: &[(&str, &str)] =
    &[NODES, ("[resolution]\nnear = \"5 cm\"\nedges = \"1.25 cm\"\n", "")];

/// More turns, laid taut: more of the rope presses on skin.
const TIGHT: &[(&str, &str)] = &[
    ("turns = 2\n", "turns = 3\n"),
    ("turns = 2.5", "turns = 6"),
    ("pretension = \"20 N\"", "pretension = \"300 N\""),
    ("length = \"38 m\"", "length = \"60 m\""),
];

/// Twice the traps.
const TRAWL: (&str, &str) = ("assembly = \"trawl-10\"", "assembly = \"trawl-20\"");

/// A tide that turns, so that the gear moves.
const TIDE: (&str, &str) = (
    "toward = \"90 deg\"\n",
    "toward = \"90 deg\"\n\n[current.tide]\nperiod = \"12.42 h\"\npeak = \"2 h\"\n",
);

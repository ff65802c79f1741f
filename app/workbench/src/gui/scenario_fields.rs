//! The fields of a scenario: what each is called, where it stands, what it means.

/// A field of the scenario's file that is typed.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// Its name on screen.
    pub label: &'a str,
    /// Where it stands in the file.
    pub field: &'a str,
    /// What holds where it is empty.
    pub usual: &'a str,
    /// What it means, with an example.
    pub help: &'a str,
}

/// A field that is on or off.
#[derive(Clone, Copy, Debug)]
pub struct Flag {
    /// Its name on screen.
    pub label: &'static str,
    /// Where it stands in the file.
    pub field: &'static str,
    /// What holds where it is not there.
    pub usual: bool,
    /// What it means.
    pub help: &'static str,
}

const fn row(
    label: &'static str,
    field: &'static str,
    usual: &'static str,
    help: &'static str,
) -> Row<'static> {
    Row { label, field, usual, help }
}

const fn flag(label: &'static str, field: &'static str, usual: bool, help: &'static str) -> Flag {
    Flag { label, field, usual, help }
}

/// Of the sea.
pub const SEA: &[Row<'static>] = &[
    row("Depth", "site.depth", "", "Water depth, over the site's, such as 40 fathom"),
    row("Current", "current.speed", "", "Surface speed of the current, such as 0.5 m/s or 1 kn"),
    row(
        "Towards",
        "current.toward",
        "90 deg",
        "Compass bearing the current runs towards, such as 90 deg",
    ),
];

/// Of a tide that turns.
pub const TIDE: &[Row<'static>] = &[
    row(
        "Period",
        "current.tide.period",
        "steady",
        "Period of the tide, such as 12.42 h; the current above is that at its peak. Empty: a steady current",
    ),
    row(
        "Peak at",
        "current.tide.peak",
        "0 s",
        "Time of the run at which the current is at its peak",
    ),
    row(
        "Residual",
        "current.tide.residual",
        "none",
        "Steady current that is left without the tide, such as 0.05 m/s",
    ),
];

/// Of waves.
pub const WAVES: &[Row<'static>] = &[
    row(
        "Height",
        "waves.height",
        "no waves",
        "Height from trough to crest, such as 1.2 m; empty for a flat sea",
    ),
    row("Period", "waves.period", "", "Period of the waves, such as 6 s"),
    row("Towards", "waves.toward", "90 deg", "Compass bearing towards which they run"),
    row(
        "Spectrum",
        "waves.spectrum",
        "regular",
        "jonswap for irregular waves, drawn from the seed; height is then the significant one",
    ),
];

/// Of a whale.
pub const WHALE: &[Row<'static>] = &[
    row(
        "Length",
        "whale.length",
        "of its file",
        "Body length, snout to fluke notch, such as 13 m; or an age",
    ),
    row(
        "Age",
        "whale.age",
        "by length",
        "Age, such as 2 yr: the length follows by the law of the whale's file",
    ),
    row(
        "Condition",
        "whale.condition",
        "1",
        "Volume over that of middling condition, 0.65 to 1.5; below 1 is thin",
    ),
    row("Start east", "whale.position.0", "", "Where mid-body starts, east of the origin"),
    row("Start north", "whale.position.1", "", "Where mid-body starts, north of the origin"),
    row("Depth", "whale.depth", "", "Depth of mid-body at the start, such as 12 m"),
    row("Heading", "whale.heading", "90 deg", "Compass bearing of the snout, such as 90 deg"),
    row("Pitch", "whale.pitch", "0 deg", "Nose up at the start"),
    row("Roll", "whale.roll", "0 deg", "Roll to starboard at the start"),
];

/// Of a living whale.
pub const SWIMS: &[Row<'static>] =
    &[row("Speed", "whale.speed", "", "Speed through the water at the start, such as 1 m/s")];

/// Of the run as a whole.
pub const RUN: &[Row<'static>] = &[
    row("Duration", "duration", "", "Length of the run, such as 60 s"),
    row("Seed", "seed", "0", "Seed of everything drawn at random"),
    row(
        "Rope nodes",
        "rope_nodes",
        "",
        "Nodes of all ropes, shared out by length; more is finer and slower",
    ),
];

/// Whether weak links part.
pub const LINKS_PART: Flag = flag(
    "Weak links part",
    "weak_links",
    true,
    "Off: links hold whatever they are rated (K when flying)",
);

/// What is on or off.
pub const FLAGS: &[Flag] = &[
    flag(
        "Strengths are drawn at random",
        "strength_scatter",
        false,
        "Strengths of ropes and links scatter as their files say, by the seed",
    ),
    flag(
        "Ropes touch each other",
        "rope_on_rope",
        true,
        "Twists and hitches hold; off: ropes pass through each other",
    ),
    flag(
        "Traps and buoys touch the whale",
        "bodies_on_whale",
        true,
        "A buoy jams against a flipper; off: traps, buoys and anchors pass through the whale",
    ),
    flag(
        "Traps and buoys touch each other",
        "bodies_on_bodies",
        true,
        "Traps lie on traps; off: they pass through each other",
    ),
    flag(
        "Ropes touch traps and buoys",
        "rope_on_bodies",
        true,
        "Rope lies on traps, buoys and anchors; off: it passes through them",
    ),
];

/// What an option of a study may set besides, where no row or flag stands for it.
const BESIDE: &[Row<'static>] = &[
    row("Assembly", "gear.0.assembly", "", "The gear, by its id in the library"),
    row("Site", "site.item", "", "The place at sea, by its id in the library"),
    row("Animal", "whale.item", "", "The species or animal, by its id in the library"),
    row(
        "Feels gear",
        "whale.dynamics",
        "",
        "kinetic: gear holds the whale; kinematic: it goes as it is steered",
    ),
    row("Friction", "friction.model", "", "The law of friction, by its plugin's id"),
];

/// Every field by the heading it stands under.
pub fn all() -> impl Iterator<Item = (&'static str, Row<'static>)> {
    let headed = [
        ("Gear, place and animal", BESIDE),
        ("Sea", SEA),
        ("Tide", TIDE),
        ("Waves", WAVES),
        ("Whale", WHALE),
        ("Whale", SWIMS),
        ("Run", RUN),
    ];
    let rows =
        headed.into_iter().flat_map(|(heading, rows)| rows.iter().map(move |row| (heading, *row)));
    let flags = std::iter::once(&LINKS_PART).chain(FLAGS);
    let usual = |flag: &Flag| if flag.usual { "true" } else { "false" };
    rows.chain(flags.map(move |flag| ("Run", row(flag.label, flag.field, usual(flag), flag.help))))
}

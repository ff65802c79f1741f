//! The fields of a scenario: label, path in the file, default and help of each.

/// A field with a value that is typed.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// Label on screen.
    pub label: &'a str,
    /// Dotted path in the file.
    pub field: &'a str,
    /// Default value, shown while the field is empty.
    pub usual: &'a str,
    /// Help, with an example.
    pub help: &'a str,
}

/// A field that is on or off.
#[derive(Clone, Copy, Debug)]
pub struct Flag {
    /// Label on screen.
    pub label: &'static str,
    /// Dotted path in the file.
    pub field: &'static str,
    /// Default value.
    pub usual: bool,
    /// Help.
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

/// Fields of the sea.
pub const SEA: &[Row<'static>] = &[
    row("Depth", "site.depth", "", "Water depth, instead of that of the site, such as 40 fathom"),
    row("Current", "current.speed", "", "Surface speed of the current, such as 0.5 m/s or 1 kn"),
    row(
        "Towards",
        "current.toward",
        "90 deg",
        "Compass bearing the current runs towards, such as 90 deg",
    ),
];

/// Fields of a tide that turns.
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
        "Steady current besides the tide, such as 0.05 m/s",
    ),
];

/// Fields of waves.
pub const WAVES: &[Row<'static>] = &[
    row(
        "Height",
        "waves.height",
        "no waves",
        "Height from trough to crest, such as 1.2 m; empty for a flat sea",
    ),
    row("Period", "waves.period", "", "Period of the waves, such as 6 s"),
    row(
        "Towards",
        "waves.toward",
        "90 deg",
        "Compass bearing the waves run towards, such as 90 deg",
    ),
    row(
        "Spectrum",
        "waves.spectrum",
        "regular",
        "regular, or jonswap for irregular waves drawn from the seed; the height is then the significant height",
    ),
];

/// Fields of a whale.
pub const WHALE: &[Row<'static>] = &[
    row(
        "Length",
        "whale.length",
        "from the whale's file",
        "Body length, snout to fluke notch, such as 13 m; or an age",
    ),
    row(
        "Age",
        "whale.age",
        "by length",
        "Age, such as 2 yr; sets the length by the growth law in the whale's file",
    ),
    row(
        "Condition",
        "whale.condition",
        "1",
        "Body volume relative to average condition, 0.65 to 1.5; below 1 is thin",
    ),
    row("Start east", "whale.position.0", "", "Where mid-body starts, east of the origin"),
    row("Start north", "whale.position.1", "", "Where mid-body starts, north of the origin"),
    row("Depth", "whale.depth", "", "Depth of mid-body at the start, such as 12 m"),
    row("Heading", "whale.heading", "90 deg", "Compass bearing of the snout, such as 90 deg"),
    row("Pitch", "whale.pitch", "0 deg", "Nose up at the start"),
    row("Roll", "whale.roll", "0 deg", "Roll to starboard at the start"),
];

/// Fields of a whale that swims.
pub const SWIMS: &[Row<'static>] =
    &[row("Speed", "whale.speed", "", "Speed through the water at the start, such as 1 m/s")];

/// Fields of the run as a whole.
pub const RUN: &[Row<'static>] = &[
    row("Duration", "duration", "", "Simulated time, such as 60 s"),
    row("Seed", "seed", "0", "Seed of all random numbers"),
    row(
        "Rope nodes",
        "rope_nodes",
        "",
        "Nodes of all ropes together, distributed by length; more nodes are finer and slower",
    ),
];

/// Whether weak links can part.
pub const LINKS_PART: Flag = flag(
    "Weak links part",
    "weak_links",
    true,
    "Off: links hold any load, whatever their rating (key K while steering)",
);

/// Flags of the run.
pub const FLAGS: &[Flag] = &[
    flag(
        "Nothing parts",
        "unbreakable",
        false,
        "Neither rope nor weak link parts, whatever its tension",
    ),
    flag(
        "Strengths are drawn at random",
        "strength_scatter",
        true,
        "Draws strengths of ropes and links from the distributions in their files, by the seed",
    ),
    flag(
        "Ropes touch each other",
        "rope_on_rope",
        true,
        "On: twists and hitches hold. Off: ropes pass through each other",
    ),
    flag(
        "Traps and buoys touch the whale",
        "bodies_on_whale",
        true,
        "On: a buoy can jam against a flipper. Off: traps, buoys and anchors pass through the whale",
    ),
    flag(
        "Traps and buoys touch each other",
        "bodies_on_bodies",
        true,
        "On: traps can lie on traps. Off: they pass through each other",
    ),
    flag(
        "Ropes touch traps and buoys",
        "rope_on_bodies",
        true,
        "On: rope can lie on traps, buoys and anchors. Off: it passes through them",
    ),
];

/// Further fields that an option of a study can set.
const FURTHER: &[Row<'static>] = &[
    row("Assembly", "gear.0.assembly", "", "Id of the gear in the library"),
    row("Site", "site.item", "", "Id of the site in the library"),
    row("Animal", "whale.item", "", "Id of the species or animal in the library"),
    row(
        "Feels gear",
        "whale.dynamics",
        "",
        "kinetic: forces of the gear act on the whale; kinematic: the whale moves as steered, whatever pulls",
    ),
    row("Friction", "friction.model", "", "Id of the plugin with the friction law"),
];

/// Every field with its heading.
pub fn all() -> impl Iterator<Item = (&'static str, Row<'static>)> {
    let headed = [
        ("Gear, place and animal", FURTHER),
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

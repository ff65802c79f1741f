//! What each kind of library file holds: its figures with quantity, range and help.
//!
//! One table per kind serves the reader, the checks and the help shown beside a field.

use crate::fields::Range;
use crate::units::Quantity;

/// The kinds of library files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Rope, in `ropes/`.
    Rope,
    /// Trap, in `traps/`.
    Trap,
    /// Buoy, in `buoys/`.
    Buoy,
    /// Weak link, in `weak-links/`.
    WeakLink,
    /// Anchor, in `anchors/`.
    Anchor,
    /// Knot or splice, in `knots/`.
    Knot,
    /// Place at sea, in `sites/`.
    Site,
    /// Friction of a rope material on a whale, in `friction/`.
    Friction,
    /// Whale, in `whales/`.
    Whale,
    /// Act of a whale, in `acts/`.
    Act,
    /// Assembly of gear, in `assemblies/`.
    Assembly,
}

/// A figure of a kind of file.
#[derive(Debug, PartialEq)]
pub struct Field {
    /// Key; `head.mouth` is the key `mouth` in the table `head`.
    pub key: &'static str,
    /// What it measures.
    pub quantity: Quantity,
    /// Values it may take.
    pub range: Range,
    /// Whether it must be there.
    pub needed: bool,
    /// Help shown beside it.
    pub help: &'static str,
}

/// A text of a kind of file.
#[derive(Debug, PartialEq)]
pub struct Word {
    /// Key.
    pub key: &'static str,
    /// Words it may be; empty where any will do.
    pub allowed: &'static [&'static str],
    /// Help shown beside it.
    pub help: &'static str,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 11] = [
        Self::Rope,
        Self::Trap,
        Self::Buoy,
        Self::WeakLink,
        Self::Knot,
        Self::Anchor,
        Self::Site,
        Self::Friction,
        Self::Whale,
        Self::Act,
        Self::Assembly,
    ];

    /// Its folder of the library.
    #[must_use]
    pub fn folder(self) -> &'static str {
        self.names().0
    }

    /// The word of a file's `kind` field.
    #[must_use]
    pub fn word(self) -> &'static str {
        self.names().1
    }

    /// The kind whose files lie in a folder.
    #[must_use]
    pub fn in_folder(folder: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.folder() == folder)
    }

    /// Its figures, in the order shown.
    #[must_use]
    pub fn fields(self) -> &'static [Field] {
        match self {
            Self::Rope => ROPE,
            Self::Trap | Self::Anchor => BOX,
            Self::Buoy => BUOY,
            Self::WeakLink => WEAK_LINK,
            Self::Knot => KNOT,
            Self::Site => SITE,
            Self::Friction => FRICTION,
            Self::Whale => WHALE,
            Self::Act => ACT,
            Self::Assembly => &[],
        }
    }

    /// Its texts that must be there, besides the name.
    #[must_use]
    pub fn words(self) -> &'static [Word] {
        match self {
            Self::Rope => &[Word {
                key: "material",
                allowed: &[],
                help: "rope material: an item of friction/, such as pp or sink",
            }],
            Self::Buoy => &[Word {
                key: "shape",
                allowed: &["sphere", "bullet", "low-drag", "cylinder"],
                help: "sphere, bullet (rounded ends), low-drag (spheroid) or cylinder",
            }],
            _ => &[],
        }
    }

    fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Rope => ("ropes", "rope"),
            Self::Trap => ("traps", "trap"),
            Self::Buoy => ("buoys", "buoy"),
            Self::WeakLink => ("weak-links", "weak-link"),
            Self::Knot => ("knots", "knot"),
            Self::Anchor => ("anchors", "anchor"),
            Self::Site => ("sites", "site"),
            Self::Friction => ("friction", "friction"),
            Self::Whale => ("whales", "whale"),
            Self::Act => ("acts", "act"),
            Self::Assembly => ("assemblies", "assembly"),
        }
    }
}

const fn need(key: &'static str, quantity: Quantity, range: Range, help: &'static str) -> Field {
    Field { key, quantity, range, needed: true, help }
}

const fn may(key: &'static str, quantity: Quantity, range: Range, help: &'static str) -> Field {
    Field { key, quantity, range, needed: false, help }
}

use Quantity as Q;
use Range::{Any, Between, NotNegative, Positive};

/// A share of a whole.
const SHARE: Range = Between(0.0, 1.0);
/// A coefficient of drag or added mass.
const COEFFICIENT: Range = Between(0.0, 10.0);

const ROPE: &[Field] = &[
    need("diameter", Q::Length, Between(0.001, 0.2), "nominal diameter, for drag and contact"),
    need("mass", Q::MassByLength, Between(1e-4, 50.0), "mass in air by length"),
    need(
        "density",
        Q::Density,
        Between(100.0, 12_000.0),
        "density of the fibre, without the water between; buoyancy is mass over density",
    ),
    may(
        "wet_weight",
        Q::ForceByLength,
        Any,
        "weight in sea water by length, below zero for a floating rope; checked against mass and density",
    ),
    need("strength", Q::Force, Positive, "breaking strength when new and unknotted"),
    may(
        "stretch_at_break",
        Q::Ratio,
        Between(0.005, 1.0),
        "strain at which it breaks; checked against stiffness and strength",
    ),
    need(
        "stiffness",
        Q::Force,
        Positive,
        "axial stiffness EA from slack to break: force for a strain of 1",
    ),
    may(
        "worked_stiffness",
        Q::Force,
        Positive,
        "axial stiffness of the rope once worked in; for condition = \"worked\"",
    ),
    may(
        "toe",
        Q::Ratio,
        Between(0.01, 1.0),
        "share of its stiffness that a new rope begins with; for condition = \"new\"",
    ),
    may(
        "damping",
        Q::Damping,
        NotNegative,
        "axial damping BA: tension by strain rate; or give damping_ratio",
    ),
    may(
        "damping_ratio",
        Q::Ratio,
        Between(0.0, 10.0),
        "axial damping as a share of a segment's critical damping; or give damping",
    ),
    may(
        "bending_stiffness",
        Q::BendingStiffness,
        NotNegative,
        "bending stiffness EI; a scenario turns it on with rope_bending = true",
    ),
    may(
        "wear_factor",
        Q::Ratio,
        Between(0.05, 1.0),
        "strength left in used rope, as a share of new",
    ),
    may(
        "knot_factor",
        Q::Ratio,
        Between(0.05, 1.0),
        "strength left at its ends where no knot or splice is named, as a share",
    ),
    may(
        "strength_cv",
        Q::Ratio,
        Between(0.0, 0.5),
        "coefficient of variation of the strength between pieces; drawn for each line",
    ),
    need(
        "drag_normal",
        Q::Ratio,
        COEFFICIENT,
        "drag coefficient across the rope, on diameter times length",
    ),
    need(
        "drag_tangential",
        Q::Ratio,
        COEFFICIENT,
        "drag coefficient along the rope, on wetted surface",
    ),
    need("added_mass", Q::Ratio, COEFFICIENT, "added-mass coefficient across the rope"),
    may(
        "added_mass_along",
        Q::Ratio,
        COEFFICIENT,
        "added-mass coefficient along the rope; zero where not given",
    ),
];

const BOX: &[Field] = &[
    need(
        "length",
        Q::Length,
        Between(0.01, 20.0),
        "length; the line leaves from the middle of the top edge at this end",
    ),
    need("width", Q::Length, Between(0.01, 20.0), "width"),
    need("height", Q::Length, Between(0.01, 20.0), "height"),
    need("mass", Q::Mass, Positive, "mass in air, ballast included"),
    need(
        "wet_weight",
        Q::Force,
        Positive,
        "weight in sea water; the displaced volume follows from it",
    ),
    need(
        "drag_coefficient",
        Q::Ratio,
        COEFFICIENT,
        "drag coefficient on the solid part of the faces",
    ),
    need("solidity", Q::Ratio, SHARE, "solid share of a face; 1 less its porosity"),
    may(
        "solidity_ends",
        Q::Ratio,
        SHARE,
        "the same of the two ends; as `solidity` where not given",
    ),
    may(
        "solidity_sides",
        Q::Ratio,
        SHARE,
        "the same of the two long sides; as `solidity` where not given",
    ),
    may(
        "solidity_top",
        Q::Ratio,
        SHARE,
        "the same of top and floor; as `solidity` where not given",
    ),
    may(
        "ballast",
        Q::Mass,
        Positive,
        "mass of bricks and runners flat over the floor, a part of the mass; none where not given",
    ),
    may(
        "ballast_height",
        Q::Length,
        Between(0.0, 20.0),
        "height of the ballast above the underside; zero where not given",
    ),
    may(
        "ballast_density",
        Q::Density,
        Between(500.0, 12_000.0),
        "density of the ballast; brick, 2000 kg/m3, where not given",
    ),
    may(
        "foam",
        Q::Volume,
        Positive,
        "volume of foam or wood that floats inside; none where not given",
    ),
    may(
        "foam_height",
        Q::Length,
        Between(0.0, 20.0),
        "height of the foam above the underside; at the top where not given",
    ),
    need(
        "added_mass_horizontal",
        Q::Ratio,
        COEFFICIENT,
        "added mass along and across, as a share of the water it encloses",
    ),
    need(
        "added_mass_vertical",
        Q::Ratio,
        COEFFICIENT,
        "added mass up and down, as a share of the water it encloses",
    ),
    need(
        "start_friction",
        Q::Ratio,
        Between(0.0, 50.0),
        "friction on the seabed before it moves; for an anchor, holding power over wet weight",
    ),
    need("slide_friction", Q::Ratio, Between(0.0, 50.0), "friction on the seabed once it slides"),
    may(
        "break_out",
        Q::Force,
        Positive,
        "force that holds it back when it is lifted off the seabed; none where not given",
    ),
];

const BUOY: &[Field] = &[
    need("diameter", Q::Length, Between(0.01, 5.0), "diameter of the float"),
    may(
        "length",
        Q::Length,
        Between(0.01, 10.0),
        "length of the float along its axis; a sphere has none",
    ),
    need("volume", Q::Volume, Positive, "volume of the float"),
    need(
        "mass",
        Q::Mass,
        Positive,
        "mass in air of the float; each `[[piece]]` fixed to it has its own",
    ),
    may(
        "centre_of_mass",
        Q::Length,
        Between(-10.0, 10.0),
        "height of the float's centre of mass above its middle; zero where not given",
    ),
    may(
        "attachment",
        Q::Length,
        Between(0.0, 10.0),
        "how far below the middle of the float the line leaves; its lower end where not given",
    ),
    need(
        "drag_across",
        Q::Ratio,
        COEFFICIENT,
        "drag coefficient across the axis, on the float's side area",
    ),
    need(
        "drag_along",
        Q::Ratio,
        COEFFICIENT,
        "drag coefficient along the axis, on the float's end area",
    ),
    need(
        "added_mass_across",
        Q::Ratio,
        COEFFICIENT,
        "added mass across the axis, as a share of the displaced water",
    ),
    need(
        "added_mass_along",
        Q::Ratio,
        COEFFICIENT,
        "added mass along the axis, as a share of the displaced water",
    ),
];

const WEAK_LINK: &[Field] = &[
    need("rating", Q::Force, Positive, "tension above which it parts"),
    may(
        "spread",
        Q::Ratio,
        Between(0.0, 0.5),
        "coefficient of variation of that tension between links; drawn for each link",
    ),
];

const KNOT: &[Field] = &[need(
    "strength_left",
    Q::Ratio,
    Between(0.05, 1.0),
    "strength of the rope at this knot or splice, as a share",
)];

const SITE: &[Field] = &[
    need("depth", Q::Length, Between(0.5, 6000.0), "water depth"),
    need("density", Q::Density, Between(0.0, 2000.0), "density of the water"),
    may("gravity", Q::Acceleration, Between(0.0, 20.0), "gravity; 9.81 m/s2 where not given"),
    need(
        "current",
        Q::Speed,
        Between(0.0, 10.0),
        "speed of a running tide, at the surface where current_height does not say otherwise",
    ),
    may(
        "current_height",
        Q::Length,
        Between(0.01, 6000.0),
        "height above the seabed at which the tide runs at that speed",
    ),
    may(
        "current_exponent",
        Q::Ratio,
        SHARE,
        "exponent of the current's power law, 1/7 in a tidal stream, 0 for a uniform current; or current_roughness",
    ),
    may(
        "current_roughness",
        Q::Length,
        Between(1e-6, 1.0),
        "roughness length of the bed, for a logarithmic law; or current_exponent",
    ),
    may("slope", Q::Angle, Between(0.0, 1.0), "slope of the seabed; flat where not given"),
    may("slope_toward", Q::Angle, Any, "compass bearing towards which the seabed falls"),
    need("rope_friction", Q::Ratio, COEFFICIENT, "friction of rope on the seabed"),
    need(
        "rope_stiffness",
        Q::Pressure,
        Positive,
        "stiffness of the seabed under rope, by length of rope",
    ),
    need(
        "foot_stiffness",
        Q::ForceByLength,
        Positive,
        "stiffness of the seabed under one corner of a trap",
    ),
];

const FRICTION: &[Field] = &[
    need("rostrum", Q::Ratio, COEFFICIENT, "on the rostrum with its callosities"),
    need("baleen", Q::Ratio, COEFFICIENT, "on the baleen plates"),
    need("lips", Q::Ratio, COEFFICIENT, "on the lower lips"),
    need("head", Q::Ratio, COEFFICIENT, "on the rest of the head"),
    need("skin", Q::Ratio, COEFFICIENT, "on body, peduncle, flippers and flukes"),
];

const WHALE: &[Field] = &[
    need(
        "length",
        Q::Length,
        Between(1.0, 35.0),
        "body length, snout to fluke notch; a scenario may choose another",
    ),
    need("burst_speed", Q::Speed, Between(0.1, 15.0), "greatest speed it can swim"),
    need(
        "contact_stiffness",
        Q::Pressure,
        Positive,
        "stiffness of skin and blubber under rope, by length of rope",
    ),
    may(
        "breadth_scale",
        Q::Ratio,
        Between(0.3, 2.0),
        "factor on widths and heights of the sections; found from the mass where [mass] is given",
    ),
    need("mass.length", Q::Length, Between(1.0, 35.0), "length at which the mass is given"),
    need(
        "mass.mass",
        Q::Mass,
        Between(10.0, 300_000.0),
        "mass of a whale of that length in middling condition",
    ),
    need("mass.exponent", Q::Ratio, Between(2.0, 4.0), "exponent of length in the law of mass"),
    need("age.birth", Q::Length, Between(0.5, 15.0), "length at birth"),
    need("age.one_year", Q::Length, Between(0.5, 35.0), "length at one year"),
    need("age.tenfold", Q::Length, Between(0.0, 20.0), "growth for each tenfold age after that"),
    may(
        "density",
        Q::Density,
        Between(500.0, 1500.0),
        "mass over displaced volume; that of sea water, 1025 kg/m3, where not given",
    ),
    need("peduncle_start", Q::Ratio, SHARE, "where the tail stock begins, as a share of length"),
    need("head.share", Q::Ratio, SHARE, "length of the head, as a share of length"),
    need("head.mouth", Q::Ratio, SHARE, "snout to the corner of the mouth, as a share of length"),
    may(
        "head.mouth_offset",
        Q::Length,
        Between(-5.0, 5.0),
        "length added to the mouth's share of length",
    ),
    may(
        "head.width",
        Q::Ratio,
        SHARE,
        "width of the head at a tenth of length, as a share of length; the sections' own where not given",
    ),
    may("head.width_offset", Q::Length, Between(-5.0, 5.0), "length added to that width"),
    need(
        "head.rostrum_width",
        Q::Ratio,
        SHARE,
        "width of the rostrum, as a share of the head's width",
    ),
    need(
        "head.lip_arch",
        Q::Ratio,
        SHARE,
        "how far the lower lips stand off from the baleen at their foot, as a share of the baleen's length there",
    ),
    need(
        "head.baleen",
        Q::Ratio,
        SHARE,
        "length of the longest baleen plate, as a share of length",
    ),
    may(
        "head.baleen_offset",
        Q::Length,
        Between(-5.0, 5.0),
        "length added to the baleen's share of length",
    ),
    may(
        "head.callosities",
        Q::Length,
        Between(0.0, 0.5),
        "relief of the highest callosity, the bonnet; no callosities where not given",
    ),
    need(
        "flippers.insertion",
        Q::Ratio,
        SHARE,
        "middle of the insertion, as a share of length from the snout",
    ),
    need(
        "flippers.insertion_height",
        Q::Ratio,
        Between(-0.5, 0.5),
        "height of the insertion above the snout, as a share of length",
    ),
    need("flippers.span", Q::Ratio, SHARE, "insertion to tip, as a share of length"),
    need("flippers.root_chord", Q::Ratio, SHARE, "chord at the insertion, as a share of length"),
    need("flippers.max_chord", Q::Ratio, SHARE, "greatest chord, as a share of length"),
    need("flippers.max_chord_at", Q::Ratio, SHARE, "where along the span the chord is greatest"),
    need("flippers.tip_chord", Q::Ratio, SHARE, "chord near the tip, as a share of length"),
    need("flippers.thickness", Q::Ratio, SHARE, "thickness over chord at the insertion"),
    need("flippers.tip_thickness", Q::Ratio, SHARE, "thickness over chord near the tip"),
    need("flippers.sweep", Q::Angle, Between(-1.6, 1.6), "sweep aft at rest"),
    need(
        "flippers.droop",
        Q::Angle,
        Between(-1.6, 1.6),
        "droop of the tip below the horizontal at rest",
    ),
    need("flippers.edge_radius", Q::Length, Between(0.0, 0.5), "radius of the edges"),
    need("flukes.span", Q::Ratio, SHARE, "tip to tip, as a share of length"),
    need("flukes.root_chord", Q::Ratio, SHARE, "insertion to notch, as a share of length"),
    need("flukes.tip_chord", Q::Ratio, SHARE, "chord near the tips, as a share of length"),
    need("flukes.sweep", Q::Angle, Between(-1.6, 1.6), "sweep of the leading edge aft"),
    need("flukes.thickness", Q::Ratio, SHARE, "thickness over chord at the midline"),
    need("flukes.tip_thickness", Q::Ratio, SHARE, "thickness over chord near the tips"),
    need("flukes.notch", Q::Ratio, SHARE, "depth of the notch, as a share of length"),
    need(
        "flukes.height",
        Q::Ratio,
        Between(-0.5, 0.5),
        "height of the flukes above the snout, as a share of length",
    ),
    need("flukes.edge_radius", Q::Length, Between(0.0, 0.5), "radius of the edges"),
    need(
        "strength.sustained",
        Q::Force,
        Positive,
        "thrust it sustains, of a whale 1 m long; it grows with length by `exponent`",
    ),
    need("strength.burst", Q::Force, Positive, "greatest thrust in a burst, of a whale 1 m long"),
    need("strength.exponent", Q::Ratio, Between(0.0, 4.0), "power of length by which thrust grows"),
    need("strength.efficiency", Q::Ratio, Between(0.01, 1.0), "useful power over the power put in"),
    need(
        "strength.stroke",
        Q::Ratio,
        Between(0.01, 1.0),
        "peak-to-peak stroke of the flukes, as a share of length",
    ),
    need(
        "strength.steering_arm",
        Q::Ratio,
        SHARE,
        "arm of the tail as it holds course, as a share of length; the force is the thrust it sustains",
    ),
    need(
        "strength.rolling_arm",
        Q::Ratio,
        SHARE,
        "the same of the flippers as they hold it upright",
    ),
    need(
        "strength.steering_time",
        Q::Time,
        Positive,
        "time in which it takes back what rope turned",
    ),
    need("drag.diameter", Q::Ratio, Between(0.01, 1.0), "greatest diameter by length"),
    need(
        "drag.diameter_offset",
        Q::Length,
        Between(-2.0, 5.0),
        "greatest diameter besides that, for a whale of no length",
    ),
    need(
        "drag.wetted_area",
        Q::Ratio,
        Between(1e-3, 10.0),
        "wetted area in m2 of a whale of 1 kg; it grows with mass by `wetted_area_exponent`",
    ),
    need("drag.wetted_area_exponent", Q::Ratio, SHARE, "power of mass by which wetted area grows"),
    need(
        "drag.appendages",
        Q::Ratio,
        Between(1.0, 3.0),
        "factor of flippers and flukes on the body's drag",
    ),
    need("drag.oscillation", Q::Ratio, Between(1.0, 5.0), "factor of its beating as it swims"),
    need("drag.open_mouth", Q::Ratio, Between(1.0, 20.0), "factor of a mouth wide open"),
    need(
        "drag.wide_mouth",
        Q::Angle,
        Between(0.01, 1.6),
        "jaw drop at which its mouth is wide open",
    ),
    need("drag.cross", Q::Ratio, COEFFICIENT, "drag coefficient crossways"),
    need("drag.side_area", Q::Ratio, SHARE, "area seen from the side, over length squared"),
    need("drag.plan_area", Q::Ratio, SHARE, "area seen from above, over length squared"),
    need(
        "dead.afloat",
        Q::Ratio,
        Between(-0.5, 0.5),
        "share of a dead whale's volume that floats above calm water; below zero it sinks",
    ),
    need(
        "dead.weight_above",
        Q::Ratio,
        Between(-0.1, 0.1),
        "how far its centre of mass lies toward the back from that of its volume, as a share of length",
    ),
    need("dead.jaw", Q::Angle, Between(0.0, 1.0), "jaw drop of a dead whale"),
    need(
        "dynamics.buoyancy",
        Q::Ratio,
        Between(-0.2, 0.2),
        "net buoyancy alive and under water, as a share of its weight",
    ),
];

const ACT: &[Field] = &[
    need(
        "fade",
        Q::Time,
        Between(0.1, 30.0),
        "time to get from what the whale did into the act, and out of it again",
    ),
    may(
        "turn_rate",
        Q::TurnRate,
        Between(0.01, 1.0),
        "greatest rate of turn to a bank or climb; 15 deg/s where not given",
    ),
];

//! Figures of gear and sites, each table in the order shown.

use crate::fields::Range::{Any, Between, NotNegative, Positive};
use crate::units::Quantity as Q;

use super::{COEFFICIENT, Field, SHARE, may, need};

/// Figures of an assembly.
pub(super) const ASSEMBLY: &[Field] = &[may(
    "fleet_cv",
    Q::Ratio,
    Between(0.0, 0.5),
    "coefficient of variation of the strength of rope between gears of a fleet; drawn once for each gear",
)];

/// Figures of a rope.
pub(super) const ROPE: &[Field] = &[
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
    need(
        "strength",
        Q::Force,
        Positive,
        "breaking strength when new and unknotted, as stated by its source",
    ),
    may(
        "mean_factor",
        Q::Ratio,
        Between(0.5, 1.5),
        "mean strength of new pieces over the stated one: above 1 where a table prints a minimum, below 1 where a rule prints a maximum",
    ),
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
        "axial stiffness of worked-in rope; for condition = \"worked\"",
    ),
    may(
        "toe",
        Q::Ratio,
        Between(0.01, 1.0),
        "stiffness of new rope at zero strain, as a share; for condition = \"new\"",
    ),
    may(
        "damping",
        Q::Damping,
        NotNegative,
        "axial damping BA: tension by strain rate; or write damping_ratio",
    ),
    may(
        "damping_ratio",
        Q::Ratio,
        Between(0.0, 10.0),
        "axial damping as a share of a segment's critical damping; or write damping",
    ),
    may(
        "bending_stiffness",
        Q::BendingStiffness,
        NotNegative,
        "bending stiffness EI; a scenario turns it on with rope_bending = true",
    ),
    may("wear_factor", Q::Ratio, Between(0.05, 1.0), "strength of used rope, as a share of new"),
    may(
        "knot_factor",
        Q::Ratio,
        Between(0.05, 1.0),
        "strength at its ends without a named knot or splice, as a share",
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
    may(
        "drag_tangential_viscous",
        Q::Ratio,
        Between(0.0, 1.0),
        "share of drag_tangential that is proportional to the inverse root of the speed; default 0",
    ),
    may(
        "drag_tangential_speed",
        Q::Speed,
        Positive,
        "speed along the rope at which drag_tangential holds; default 2 m/s",
    ),
    need("added_mass", Q::Ratio, COEFFICIENT, "added-mass coefficient across the rope"),
    may(
        "added_mass_along",
        Q::Ratio,
        COEFFICIENT,
        "added-mass coefficient along the rope; default 0",
    ),
];

/// Figures of a knot or splice.
pub(super) const KNOT: &[Field] = &[
    need(
        "strength_left",
        Q::Ratio,
        Between(0.05, 1.0),
        "strength of the rope at this knot or splice, as a share",
    ),
    may("bulk", Q::Ratio, Between(1.0, 8.0), "breadth over the rope's diameter"),
];

/// Figures of a weak link.
pub(super) const WEAK_LINK: &[Field] = &[
    need("rating", Q::Force, Positive, "tension above which it parts, as stated by its source"),
    may(
        "mean_factor",
        Q::Ratio,
        Between(0.5, 1.5),
        "mean strength of links over the stated rating: below 1 where the rating is a legal maximum",
    ),
    may(
        "spread",
        Q::Ratio,
        Between(0.0, 0.5),
        "coefficient of variation between links; drawn for each link",
    ),
    may(
        "breadth",
        Q::Length,
        Between(0.001, 0.5),
        "breadth: it jams at a narrower gap; default: the breadth of the rope",
    ),
];

/// Figures of a buoy.
pub(super) const BUOY: &[Field] = &[
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
        "height of the float's centre of mass above its middle; default 0",
    ),
    may(
        "attachment",
        Q::Length,
        Between(0.0, 10.0),
        "distance from the middle of the float down to the point where the line leaves; default: its lower end",
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

/// Figures of a trap or an anchor.
pub(super) const BOX_GEAR: &[Field] = &[
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
    may("solidity_ends", Q::Ratio, SHARE, "solidity of the two ends; default `solidity`"),
    may("solidity_sides", Q::Ratio, SHARE, "solidity of the two long sides; default `solidity`"),
    may("solidity_top", Q::Ratio, SHARE, "solidity of top and floor; default `solidity`"),
    may(
        "ballast",
        Q::Mass,
        Positive,
        "mass of bricks and runners flat over the floor, included in the mass; default 0",
    ),
    may(
        "ballast_height",
        Q::Length,
        Between(0.0, 20.0),
        "height of the ballast above the underside; default 0",
    ),
    may(
        "ballast_density",
        Q::Density,
        Between(500.0, 12_000.0),
        "density of the ballast; default: brick, 2000 kg/m3",
    ),
    may("foam", Q::Volume, Positive, "volume of buoyant foam or wood inside; default 0"),
    may(
        "foam_height",
        Q::Length,
        Between(0.0, 20.0),
        "height of the foam above the underside; default: the top",
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
        "static friction on the seabed; for an anchor, holding power over wet weight",
    ),
    need("slide_friction", Q::Ratio, Between(0.0, 50.0), "sliding friction on the seabed"),
    may(
        "break_out",
        Q::Force,
        Positive,
        "breakout force when it is lifted off the seabed; default 0",
    ),
];

/// Figures of a site.
pub(super) const SITE: &[Field] = &[
    need("depth", Q::Length, Between(0.5, 6000.0), "water depth"),
    need("density", Q::Density, Between(0.0, 2000.0), "density of the water"),
    may("gravity", Q::Acceleration, Between(0.0, 20.0), "gravity; default 9.81 m/s2"),
    need(
        "current",
        Q::Speed,
        Between(0.0, 10.0),
        "speed of a running tide at current_height; default height: the surface",
    ),
    may(
        "current_height",
        Q::Length,
        Between(0.01, 6000.0),
        "height above the seabed at which `current` applies",
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
    may("slope", Q::Angle, Between(0.0, 1.0), "slope of the seabed; default: flat"),
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

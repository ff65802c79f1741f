//! The figures of a trap or an anchor.

use super::{COEFFICIENT, Field, SHARE, may, need};
use crate::fields::Range::{Between, Positive};
use crate::units::Quantity as Q;

/// Every figure, in the order shown.
pub(super) const FIELDS: &[Field] = &[
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

//! The figures of a buoy.

use super::{COEFFICIENT, Field, may, need};
use crate::fields::Range::{Between, Positive};
use crate::units::Quantity as Q;

/// Every figure, in the order shown.
pub(super) const FIELDS: &[Field] = &[
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

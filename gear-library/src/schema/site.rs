//! The figures of a place at sea.

use super::{COEFFICIENT, Field, SHARE, may, need};
use crate::fields::Range::{Any, Between, Positive};
use crate::units::Quantity as Q;

/// Every figure, in the order shown.
pub(super) const FIELDS: &[Field] = &[
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

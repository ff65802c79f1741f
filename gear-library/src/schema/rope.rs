//! The figures of a rope.

use super::{COEFFICIENT, Field, may, need};
use crate::fields::Range::{Any, Between, NotNegative, Positive};
use crate::units::Quantity as Q;

/// Every figure, in the order shown.
pub(super) const FIELDS: &[Field] = &[
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
        "breaking strength when new and unknotted, as its source states it",
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
    may(
        "drag_tangential_viscous",
        Q::Ratio,
        Between(0.0, 1.0),
        "share of drag_tangential that falls with the inverse root of the speed; zero where not given",
    ),
    may(
        "drag_tangential_speed",
        Q::Speed,
        Positive,
        "speed along the rope at which drag_tangential holds; 2 m/s where not given",
    ),
    need("added_mass", Q::Ratio, COEFFICIENT, "added-mass coefficient across the rope"),
    may(
        "added_mass_along",
        Q::Ratio,
        COEFFICIENT,
        "added-mass coefficient along the rope; zero where not given",
    ),
];

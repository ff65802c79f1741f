//! Figures of whales, of their acts and of friction on their skin, each table in the order shown.

use crate::fields::Range::{Between, Positive};
use crate::units::Quantity as Q;

use super::{COEFFICIENT, Field, SHARE, may, need};

/// Figures of a whale.
pub(super) const WHALE: &[Field] = &[
    need(
        "length",
        Q::Length,
        Between(1.0, 35.0),
        "body length, snout to fluke notch; a scenario may choose another",
    ),
    need("burst_speed", Q::Speed, Between(0.1, 15.0), "greatest swimming speed"),
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
        "factor on widths and heights of the sections; computed from [mass] if that is present",
    ),
    need("mass.length", Q::Length, Between(1.0, 35.0), "length at which the mass applies"),
    need(
        "mass.mass",
        Q::Mass,
        Between(10.0, 300_000.0),
        "mass of a whale of that length in average condition",
    ),
    need("mass.exponent", Q::Ratio, Between(2.0, 4.0), "exponent of length in the mass law"),
    need("age.birth", Q::Length, Between(0.5, 15.0), "length at birth"),
    need("age.one_year", Q::Length, Between(0.5, 35.0), "length at one year"),
    need("age.tenfold", Q::Length, Between(0.0, 20.0), "growth per tenfold age after that"),
    may(
        "density",
        Q::Density,
        Between(500.0, 1500.0),
        "mass over displaced volume; default: sea water, 1025 kg/m3",
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
        "width of the head at a tenth of length, as a share of length; default: from the sections",
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
        "distance of the lower lips from the baleen at their foot, as a share of the length of the baleen there",
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
        "relief of the highest callosity, the bonnet; default: no callosities",
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
        "sustained thrust of a whale 1 m long; it grows with length by `exponent`",
    ),
    need("strength.burst", Q::Force, Positive, "greatest thrust in a burst, of a whale 1 m long"),
    may(
        "strength.jaw",
        Q::Ratio,
        Between(0.001, 1.0),
        "greatest force with which the jaws close at their tip, as a share of the thrust in a burst; without it and `lip` they close with unlimited force",
    ),
    may(
        "strength.lip",
        Q::Ratio,
        Between(0.001, 1.0),
        "greatest force with which a lower lip closes at its rim, as a share of the thrust in a burst",
    ),
    need(
        "strength.exponent",
        Q::Ratio,
        Between(0.0, 4.0),
        "exponent of length in the law of thrust",
    ),
    need("strength.efficiency", Q::Ratio, Between(0.01, 1.0), "useful power over input power"),
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
        "lever arm of the tail that holds course, as a share of length; the force is the sustained thrust",
    ),
    need(
        "strength.rolling_arm",
        Q::Ratio,
        SHARE,
        "lever arm of the flippers that hold it upright, as a share of length",
    ),
    need(
        "strength.steering_time",
        Q::Time,
        Positive,
        "time constant with which it corrects a turn caused by rope",
    ),
    need("drag.diameter", Q::Ratio, Between(0.01, 1.0), "greatest diameter by length"),
    need(
        "drag.diameter_offset",
        Q::Length,
        Between(-2.0, 5.0),
        "length added to the greatest diameter",
    ),
    need(
        "drag.wetted_area",
        Q::Ratio,
        Between(1e-3, 10.0),
        "wetted area in m2 of a whale of 1 kg; it grows with mass by `wetted_area_exponent`",
    ),
    need(
        "drag.wetted_area_exponent",
        Q::Ratio,
        SHARE,
        "exponent of mass in the law of wetted area",
    ),
    need("drag.appendages", Q::Ratio, Between(1.0, 3.0), "drag factor of flippers and flukes"),
    need("drag.oscillation", Q::Ratio, Between(1.0, 5.0), "drag factor of the swimming motion"),
    need("drag.open_mouth", Q::Ratio, Between(1.0, 20.0), "drag factor of a wide-open mouth"),
    need("drag.wide_mouth", Q::Angle, Between(0.01, 1.6), "jaw drop of a wide-open mouth"),
    need("drag.cross", Q::Ratio, COEFFICIENT, "drag coefficient across the body"),
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
        "distance of the centre of mass from the centre of volume towards the back, as a share of length",
    ),
    need("dead.jaw", Q::Angle, Between(0.0, 1.0), "jaw drop of a dead whale"),
    need(
        "dynamics.buoyancy",
        Q::Ratio,
        Between(-0.2, 0.2),
        "net buoyancy alive and under water, as a share of its weight",
    ),
];

/// Figures of an act.
pub(super) const ACT: &[Field] = &[
    need("fade", Q::Time, Between(0.1, 30.0), "time of the transition into the act and out of it"),
    may(
        "turn_rate",
        Q::TurnRate,
        Between(0.01, 1.0),
        "greatest rate of turn to a bank or climb; default 15 deg/s",
    ),
];

/// Figures of the friction of a rope material on a whale.
pub(super) const FRICTION: &[Field] = &[
    need("rostrum", Q::Ratio, COEFFICIENT, "on the rostrum with its callosities"),
    need("baleen", Q::Ratio, COEFFICIENT, "on the baleen plates"),
    need("lips", Q::Ratio, COEFFICIENT, "on the lower lips"),
    need("head", Q::Ratio, COEFFICIENT, "on the rest of the head"),
    need("skin", Q::Ratio, COEFFICIENT, "on body, peduncle, flippers and flukes"),
];

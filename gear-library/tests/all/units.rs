//! Values with units: valid and invalid texts.

use endline_gear::units::{self, Quantity as Q, Unit};

/// Text, quantity, SI value by exact definition of its unit.
const READS: &[(&str, Q, f64)] = &[
    ("3/8 in", Q::Length, 0.009525),
    ("3/8in", Q::Length, 0.009525),
    ("1 1/2 in", Q::Length, 0.0381),
    ("-1 1/2 in", Q::Length, -0.0381),
    ("5\"", Q::Length, 0.127),
    ("40 fathom", Q::Length, 73.152),
    ("40 fathoms", Q::Length, 73.152),
    ("10 fm", Q::Length, 18.288),
    ("600 ft", Q::Length, 182.88),
    ("1.5 nmi", Q::Length, 2778.0),
    ("9.5 mm", Q::Length, 0.0095),
    ("1700 lbf", Q::Force, 1700.0 * 4.448_221_615_260_5),
    ("1,700 lbf", Q::Force, 1700.0 * 4.448_221_615_260_5),
    ("1,234,567.5 N", Q::Force, 1_234_567.5),
    ("49 kN", Q::Force, 49_000.0),
    ("-3e-2 N", Q::Force, -0.03),
    ("2.5E3 N", Q::Force, 2500.0),
    ("0.5 m/s", Q::Speed, 0.5),
    ("1 kn", Q::Speed, 1852.0 / 3600.0),
    ("2 Knots", Q::Speed, 2.0 * 1852.0 / 3600.0),
    ("58 deg", Q::Angle, 1.012_290_966_156_711),
    ("90°", Q::Angle, std::f64::consts::FRAC_PI_2),
    ("0.065 N/m", Q::ForceByLength, 0.065),
    ("4.5 lb/100ft", Q::MassByLength, 4.5 * 0.453_592_37 / 30.48),
    ("4.5 lb/100 ft", Q::MassByLength, 4.5 * 0.453_592_37 / 30.48),
    ("1025 kg/m3", Q::Density, 1025.0),
    ("1025 kg/m³", Q::Density, 1025.0),
    ("0.94 g/cm3", Q::Density, 940.0),
    ("1.03 SG", Q::Density, 1030.0),
    ("5 L", Q::Volume, 0.005),
    ("40 lb", Q::Mass, 18.143_694_8),
    ("2.5 N s", Q::Damping, 2.5),
    ("2.5 N·s", Q::Damping, 2.5),
    ("400 kN/m^2", Q::Pressure, 400_000.0),
    ("10 ms", Q::Time, 0.01),
    ("0.3", Q::Ratio, 0.3),
    ("1/7", Q::Ratio, 1.0 / 7.0),
    ("75 %", Q::Ratio, 0.75),
    ("2.5%", Q::Ratio, 0.025),
];

#[test]
fn values_read_as_their_definitions_say() {
    for (text, quantity, expected) in READS {
        let read = units::parse(text, *quantity).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert!(
            (read - expected).abs() <= 1e-12 * expected.abs(),
            "{text}: {read} against {expected}"
        );
    }
}

/// Text, quantity, parts of the message.
const REFUSED: &[(&str, Q, &[&str])] = &[
    (
        "3/8 furlong",
        Q::Length,
        &["unknown unit `furlong`", "expected a length such as 3/8 in", "known units are m, mm"],
    ),
    ("40 fathm", Q::Length, &["unknown unit `fathm`", "did you mean `40 fathom`?"]),
    ("12", Q::Length, &["`12` has no unit", "expected a length"]),
    ("", Q::Length, &["has no number", "expected a length"]),
    ("in", Q::Length, &["has no number"]),
    ("10 kg", Q::Length, &["`kg` is a unit of a mass, not of a length"]),
    (
        "1700 lb",
        Q::Force,
        &["`lb` is a unit of a mass, not of a force", "did you mean `1700 lbf`?"],
    ),
    ("1,5 m", Q::Length, &["`1,5` is not a number", "decimals with a point"]),
    ("3/0 in", Q::Length, &["`3/0` is not a number"]),
    ("1 2 3 m", Q::Length, &["`1 2 3` is not a number"]),
    ("0.3 m", Q::Ratio, &["pure number"]),
    ("1e999 m", Q::Length, &["is not a number"]),
];

#[test]
fn what_does_not_read_says_what_was_expected() {
    for (text, quantity, parts) in REFUSED {
        let reported = units::parse(text, *quantity).expect_err(text).to_string();
        for part in *parts {
            assert!(reported.contains(part), "{text}: `{reported}` lacks `{part}`");
        }
    }
}

fn every_unit() -> impl Iterator<Item = (Q, &'static Unit)> {
    Q::ALL
        .iter()
        .copied()
        .flat_map(|quantity| quantity.units().iter().map(move |unit| (quantity, unit)))
}

#[test]
fn every_unit_survives_a_round_trip() {
    for (quantity, unit) in every_unit() {
        for number in [1.0, 0.375, -2.5, 1234.5678, 3e-7, 4.25e9] {
            let value = number * unit.factor();
            let text = units::format(value, unit);
            let back =
                units::parse(&text, quantity).unwrap_or_else(|error| panic!("{text}: {error}"));
            assert!((back - value).abs() <= 1e-9 * value.abs(), "{text}: {back} against {value}");
        }
        for name in unit.names() {
            let read = units::parse(&format!("2 {name}"), quantity).unwrap();
            assert!((read - 2.0 * unit.factor()).abs() <= 1e-15 * read.abs(), "{name}");
        }
    }
}

/// Names of the units of a quantity are unique, and its first unit is SI with the factor 1.
#[test]
fn names_are_not_shared_within_a_quantity() {
    for quantity in Q::ALL {
        let mut names: Vec<&str> = quantity.units().iter().flat_map(Unit::names).copied().collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "{quantity:?}");
        assert!(
            quantity.units().first().is_none_or(|unit| (unit.factor() - 1.0).abs() < 1e-15),
            "{quantity:?}"
        );
    }
}

#[test]
fn rope_sizes_are_written_as_fractions() {
    let inch = units::find("in", Q::Length).unwrap();
    for (value, text) in [
        (0.009525, "3/8 in"),
        (0.0381, "1 1/2 in"),
        (0.0254, "1 in"),
        (0.0111125, "7/16 in"),
        (0.01, "0.3937007874 in"),
    ] {
        assert_eq!(units::format(value, inch), text);
    }
}

/// Units of attributes of plugins.
#[test]
fn plugin_units_are_known() {
    for (unit, quantity) in [
        ("1", Q::Ratio),
        ("m/s", Q::Speed),
        ("rad", Q::Angle),
        ("N/m^2", Q::Pressure),
        ("m/s^2", Q::Acceleration),
    ] {
        assert_eq!(Q::from_si_unit(unit), Some(quantity));
    }
    assert_eq!(Q::from_si_unit("furlong"), None);
}

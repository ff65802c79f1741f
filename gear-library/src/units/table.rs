//! Names and exact factors of the units.

use super::Quantity;

/// A unit: its names and its factor to SI.
#[derive(Debug)]
pub struct Unit {
    names: &'static [&'static str],
    factor: f64,
}

impl Unit {
    const fn new(names: &'static [&'static str], factor: f64) -> Self {
        Self { names, factor }
    }

    /// Its first name.
    pub fn name(&self) -> &'static str {
        self.names[0]
    }

    /// All its names.
    pub fn names(&self) -> &'static [&'static str] {
        self.names
    }

    /// Its factor to SI.
    pub fn factor(&self) -> f64 {
        self.factor
    }
}

/// International inch, foot, fathom, pound and pound-force; all exact by definition.
const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;
const FATHOM: f64 = 1.8288;
const NAUTICAL_MILE: f64 = 1852.0;
const POUND: f64 = 0.453_592_37;
const STANDARD_GRAVITY: f64 = 9.806_65;
const POUND_FORCE: f64 = POUND * STANDARD_GRAVITY;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

static LENGTH: [Unit; 8] = [
    Unit::new(&["m", "metre", "metres", "meter", "meters"], 1.0),
    Unit::new(&["mm", "millimetre", "millimetres"], 1e-3),
    Unit::new(&["cm"], 1e-2),
    Unit::new(&["km"], 1e3),
    Unit::new(&["in", "inch", "inches", "\""], INCH),
    Unit::new(&["ft", "foot", "feet"], FOOT),
    Unit::new(&["fathom", "fathoms", "fm"], FATHOM),
    Unit::new(&["nmi", "NM"], NAUTICAL_MILE),
];
static AREA: [Unit; 4] = [
    Unit::new(&["m2"], 1.0),
    Unit::new(&["cm2"], 1e-4),
    Unit::new(&["ft2"], FOOT * FOOT),
    Unit::new(&["in2"], INCH * INCH),
];
static VOLUME: [Unit; 5] = [
    Unit::new(&["m3"], 1.0),
    Unit::new(&["L", "l", "litre", "litres", "liter", "liters"], 1e-3),
    Unit::new(&["cm3", "mL"], 1e-6),
    Unit::new(&["ft3"], FOOT * FOOT * FOOT),
    Unit::new(&["in3"], INCH * INCH * INCH),
];
static MASS: [Unit; 4] = [
    Unit::new(&["kg"], 1.0),
    Unit::new(&["g"], 1e-3),
    Unit::new(&["t", "tonne", "tonnes"], 1e3),
    Unit::new(&["lb", "lbs", "pound", "pounds"], POUND),
];
static TIME: [Unit; 6] = [
    Unit::new(&["s", "sec", "second", "seconds"], 1.0),
    Unit::new(&["ms"], 1e-3),
    Unit::new(&["min", "minute", "minutes"], 60.0),
    Unit::new(&["h", "hour", "hours"], 3600.0),
    Unit::new(&["d", "day", "days"], 86_400.0),
    Unit::new(&["yr", "year", "years"], 365.25 * 86_400.0),
];
static SPEED: [Unit; 5] = [
    Unit::new(&["m/s"], 1.0),
    Unit::new(&["cm/s"], 1e-2),
    Unit::new(&["km/h"], 1.0 / 3.6),
    Unit::new(&["kn", "knot", "knots", "kt", "kts"], NAUTICAL_MILE / 3600.0),
    Unit::new(&["ft/s"], FOOT),
];
static ACCELERATION: [Unit; 1] = [Unit::new(&["m/s2"], 1.0)];
static FORCE: [Unit; 5] = [
    Unit::new(&["N"], 1.0),
    Unit::new(&["kN"], 1e3),
    Unit::new(&["MN"], 1e6),
    Unit::new(&["lbf"], POUND_FORCE),
    Unit::new(&["kgf"], STANDARD_GRAVITY),
];
static FORCE_BY_LENGTH: [Unit; 4] = [
    Unit::new(&["N/m"], 1.0),
    Unit::new(&["kN/m"], 1e3),
    Unit::new(&["lbf/ft"], POUND_FORCE / FOOT),
    Unit::new(&["lbf/100ft"], POUND_FORCE / (100.0 * FOOT)),
];
static PRESSURE: [Unit; 6] = [
    Unit::new(&["N/m2", "Pa"], 1.0),
    Unit::new(&["kN/m2", "kPa"], 1e3),
    Unit::new(&["MN/m2", "MPa"], 1e6),
    Unit::new(&["GN/m2", "GPa"], 1e9),
    Unit::new(&["N/mm2"], 1e6),
    Unit::new(&["psi", "lbf/in2"], POUND_FORCE / (INCH * INCH)),
];
static MASS_BY_LENGTH: [Unit; 6] = [
    Unit::new(&["kg/m"], 1.0),
    Unit::new(&["g/m"], 1e-3),
    Unit::new(&["kg/100m"], 1e-2),
    Unit::new(&["lb/ft"], POUND / FOOT),
    Unit::new(&["lb/100ft"], POUND / (100.0 * FOOT)),
    Unit::new(&["lb/fathom"], POUND / FATHOM),
];
static DENSITY: [Unit; 4] = [
    Unit::new(&["kg/m3"], 1.0),
    Unit::new(&["g/cm3", "g/mL", "kg/L", "t/m3"], 1e3),
    Unit::new(&["SG"], 1e3),
    Unit::new(&["lb/ft3"], POUND / (FOOT * FOOT * FOOT)),
];
static DAMPING: [Unit; 2] = [Unit::new(&["N s", "Ns"], 1.0), Unit::new(&["kN s", "kNs"], 1e3)];
static BENDING_STIFFNESS: [Unit; 2] =
    [Unit::new(&["N m2", "Nm2"], 1.0), Unit::new(&["N mm2", "Nmm2"], 1e-6)];
static INERTIA: [Unit; 1] = [Unit::new(&["kg m2", "kgm2"], 1.0)];
static ANGLE: [Unit; 3] = [
    Unit::new(&["rad"], 1.0),
    Unit::new(&["deg", "degree", "degrees", "°"], DEGREE),
    Unit::new(&["turn", "turns"], 360.0 * DEGREE),
];
static TURN_RATE: [Unit; 3] = [
    Unit::new(&["rad/s"], 1.0),
    Unit::new(&["deg/s", "°/s"], DEGREE),
    Unit::new(&["rpm"], 2.0 * std::f64::consts::PI / 60.0),
];
static FREQUENCY: [Unit; 2] = [Unit::new(&["Hz"], 1.0), Unit::new(&["beats/min"], 1.0 / 60.0)];

/// The units of a quantity, the SI unit first.
pub(super) fn units(quantity: Quantity) -> &'static [Unit] {
    match quantity {
        Quantity::Ratio => &[],
        Quantity::Length => &LENGTH,
        Quantity::Area => &AREA,
        Quantity::Volume => &VOLUME,
        Quantity::Mass => &MASS,
        Quantity::Time => &TIME,
        Quantity::Speed => &SPEED,
        Quantity::Acceleration => &ACCELERATION,
        Quantity::Force => &FORCE,
        Quantity::ForceByLength => &FORCE_BY_LENGTH,
        Quantity::Pressure => &PRESSURE,
        Quantity::MassByLength => &MASS_BY_LENGTH,
        Quantity::Density => &DENSITY,
        Quantity::Damping => &DAMPING,
        Quantity::BendingStiffness => &BENDING_STIFFNESS,
        Quantity::Inertia => &INERTIA,
        Quantity::Angle => &ANGLE,
        Quantity::TurnRate => &TURN_RATE,
        Quantity::Frequency => &FREQUENCY,
    }
}

/// The unit of a quantity by any of its names, written with or without spaces, dots and superscripts.
pub(super) fn find(name: &str, quantity: Quantity) -> Option<&'static Unit> {
    let plain = plain(name);
    let named = |same: fn(&str, &str) -> bool| {
        units(quantity)
            .iter()
            .find(|unit| unit.names.iter().any(|known| same(&self::plain(known), &plain)))
    };
    named(|a, b| a == b).or_else(|| named(|a, b| a.eq_ignore_ascii_case(b)))
}

/// A unit's name without spaces, dots and superscripts: `N·m²` and `N m2` are equal.
pub(super) fn plain(name: &str) -> String {
    name.chars()
        .filter(|c| !matches!(c, ' ' | '·' | '*' | '^'))
        .map(|c| match c {
            '²' => '2',
            '³' => '3',
            other => other,
        })
        .collect()
}

//! Units that values are displayed in, numbers formatted with them, and compass bearings.

use endline_gear::units::{Quantity, find, parse};
use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

/// Newtons in a pound-force, exact by definition.
pub const N_PER_LBF: f64 = 4.448_221_615_260_5;

/// A force in newtons and pounds-force, such as `1512 N (340 lbf)`; `none` for an infinite one.
pub fn newtons_and_lbf(newtons: f64, decimals: usize) -> String {
    if !newtons.is_finite() {
        return "none".to_owned();
    }
    let [si, pounds] = [newtons, newtons / N_PER_LBF].map(|force| rounded(force, decimals));
    format!("{si} N ({pounds} lbf)")
}

/// Unit that forces are shown in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
pub enum ForceUnit {
    /// Pounds-force, as breaking strengths are given in the trade.
    #[strum(serialize = "lbf")]
    #[default]
    Lbf,
    /// Newtons.
    #[strum(serialize = "N")]
    Newton,
}

impl ForceUnit {
    /// Its symbol.
    pub fn symbol(self) -> &'static str {
        self.into()
    }

    /// A force given in newtons, in this unit.
    pub fn of_newtons(self, force_n: f64) -> f64 {
        match self {
            Self::Lbf => force_n / N_PER_LBF,
            Self::Newton => force_n,
        }
    }

    /// A pressure given in pascals, as text with the unit that belongs to this unit of forces.
    pub fn pressure(self, pressure_pa: f64) -> String {
        match self {
            Self::Lbf => format!("{:.1} psi", pressure_pa / PASCALS_PER_PSI),
            Self::Newton => format!("{:.0} kPa", pressure_pa / 1000.0),
        }
    }

    /// A force given in newtons, as text with its unit.
    pub fn text(self, force_n: f64) -> String {
        let value = self.of_newtons(force_n);
        let digits = usize::from(value.abs() < 100.0);
        format!("{} {}", rounded(value, digits), self.symbol())
    }
}

/// Metres in a foot.
pub(crate) const METRES_PER_FOOT: f64 = 0.3048;
/// Metres in a fathom.
pub(crate) const METRES_PER_FATHOM: f64 = 6.0 * METRES_PER_FOOT;
/// Metres in a nautical mile.
pub(crate) const METRES_PER_NAUTICAL_MILE: f64 = 1852.0;
/// Metres in an inch.
pub(crate) const METRES_PER_INCH: f64 = METRES_PER_FOOT / 12.0;
/// Pascals in a pound-force on a square inch.
const PASCALS_PER_PSI: f64 = 6_894.757;
/// Kilograms in a pound, exact by definition.
const KG_PER_POUND: f64 = 0.453_592_37;
/// Lengths below this are shown as diameters are [m].
const THIN_M: f64 = 0.06;
/// Metric units of length, speed, force and mass, as files have them.
const METRIC: [&str; 9] = ["m", "cm", "mm", "km", "m/s", "N", "kN", "kg", "g"];
/// A nautical mile an hour [m/s].
const M_S_PER_KNOT: f64 = METRES_PER_NAUTICAL_MILE / 3600.0;

/// The units that values are displayed in. Files keep their own units, and any unit may be typed.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantArray,
)]
pub enum Units {
    /// As in rules and in the trade: lbf, feet, fathoms, knots, fractions of an inch.
    #[strum(serialize = "NOAA")]
    Noaa,
    /// Forces in lbf, all else metric.
    #[default]
    Mixed,
    /// SI.
    #[strum(serialize = "SI")]
    Si,
}

impl Units {
    /// Every profile, in the order shown.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Its name.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Its description, in a few words.
    pub fn help(self) -> &'static str {
        match self {
            Self::Noaa => "lbf, feet, fathoms, knots, fractions of an inch",
            Self::Mixed => "lbf, and metric besides",
            Self::Si => "newtons, metres, metres a second",
        }
    }

    /// Unit of forces.
    pub fn force(self) -> ForceUnit {
        if self == Self::Si { ForceUnit::Newton } else { ForceUnit::Lbf }
    }

    fn trade(self) -> bool {
        self == Self::Noaa
    }

    /// Symbol of lengths.
    pub fn length_symbol(self) -> &'static str {
        if self.trade() { "ft" } else { "m" }
    }

    /// A length given in metres, in this profile's unit.
    pub fn of_metres(self, length_m: f64) -> f64 {
        if self.trade() { length_m / METRES_PER_FOOT } else { length_m }
    }

    /// A length with its unit.
    pub fn length(self, length_m: f64) -> String {
        let value = self.of_metres(length_m);
        let digits = if value.abs() < 10.0 { 2 } else { usize::from(value.abs() < 100.0) };
        format!("{} {}", rounded(value, digits), self.length_symbol())
    }

    /// A depth of water with its unit.
    pub fn depth(self, depth_m: f64) -> String {
        if self.trade() {
            format!("{:.1} fathom", depth_m / METRES_PER_FATHOM)
        } else {
            format!("{depth_m:.1} m")
        }
    }

    /// Symbol of speeds.
    pub fn speed_symbol(self) -> &'static str {
        if self.trade() { "kn" } else { "m/s" }
    }

    /// A speed given in metres a second, in this profile's unit.
    pub fn of_m_s(self, speed_m_s: f64) -> f64 {
        if self.trade() { speed_m_s / M_S_PER_KNOT } else { speed_m_s }
    }

    /// A speed of this profile's unit in metres a second.
    pub fn to_m_s(self, speed: f64) -> f64 {
        if self.trade() { speed * M_S_PER_KNOT } else { speed }
    }

    /// A speed with its unit.
    pub fn speed(self, speed_m_s: f64) -> String {
        format!("{} {}", rounded(self.of_m_s(speed_m_s), 2), self.speed_symbol())
    }

    /// A rope's diameter: to the nearest sixteenth of an inch, or in millimetres.
    pub fn diameter(self, diameter_m: f64) -> String {
        if !self.trade() {
            return format!("{:.1} mm", diameter_m * 1000.0);
        }
        let (mut top, mut bottom) =
            ((diameter_m / METRES_PER_INCH * 16.0).round().max(1.0) as u32, 16);
        while top % 2 == 0 && bottom > 1 {
            (top, bottom) = (top / 2, bottom / 2);
        }
        if bottom == 1 { format!("{top} in") } else { format!("{top}/{bottom} in") }
    }
}

impl Units {
    /// A value as a file has it, such as `25 m`, in the unit that this profile shows it in; `None` where it has that kind of unit
    /// already, or none that is known.
    pub fn instead_of(self, text: &str) -> Option<String> {
        if !text.starts_with(|first: char| first.is_ascii_digit() || first == '-') {
            return None;
        }
        let unit = text.trim().trim_start_matches(|letter: char| !letter.is_alphabetic());
        let known = [Quantity::Length, Quantity::Speed, Quantity::Force, Quantity::Mass];
        let quantity = known.into_iter().find(|quantity| find(unit, *quantity).is_some())?;
        let is_metric = METRIC.contains(&unit);
        let wants_metric =
            if quantity == Quantity::Force { self == Self::Si } else { !self.trade() };
        if is_metric == wants_metric {
            return None;
        }
        let value = parse(text, quantity).ok()?;
        Some(match quantity {
            Quantity::Length if value.abs() < THIN_M => self.diameter(value),
            Quantity::Length => self.length(value),
            Quantity::Speed => self.speed(value),
            Quantity::Force => self.force().text(value),
            _ if wants_metric => format!("{} kg", rounded(value, 1)),
            _ => format!("{} lb", rounded(value / KG_PER_POUND, 1)),
        })
    }
}

/// A number with this many decimals; zero has no sign.
pub fn rounded(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let nothing = text.trim_start_matches(['-', '0', '.']).is_empty();
    if nothing { text.trim_start_matches('-').to_owned() } else { text }
}

/// A text with commas between the thousands of its leading number, such as `1,700 lbf`.
pub fn grouped(text: &str) -> String {
    let start = usize::from(text.starts_with('-'));
    let digits = text[start..].bytes().take_while(u8::is_ascii_digit).count();
    let mut grouped = text[..start].to_owned();
    for (index, digit) in text[start..start + digits].chars().enumerate() {
        if index > 0 && (digits - index).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped + &text[start + digits..]
}

/// Compass bearing of a heading in the world: 0 north, 90 east [degrees, 0 to 360).
pub fn bearing_degrees(east: f64, north: f64) -> f64 {
    east.atan2(north).to_degrees().rem_euclid(360.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_has_both_units() {
        assert_eq!(newtons_and_lbf(7_561.976_745_942_85, 1), "7562.0 N (1700.0 lbf)");
        assert_eq!(newtons_and_lbf(f64::INFINITY, 0), "none");
    }

    #[test]
    fn thousands_have_commas() {
        for (text, expected) in [
            ("1700 lbf", "1,700 lbf"),
            ("170 lbf", "170 lbf"),
            ("-1234567.5 N", "-1,234,567.5 N"),
            ("0.12345", "0.12345"),
            ("none", "none"),
        ] {
            assert_eq!(grouped(text), expected);
        }
    }

    #[test]
    fn a_value_of_a_file_is_shown_in_the_unit_of_the_profile() {
        for (units, text, shown) in [
            (Units::Noaa, "25 m", Some("82.0 ft")),
            (Units::Noaa, "0.25 m/s", Some("0.49 kn")),
            (Units::Noaa, "9.5 mm", Some("3/8 in")),
            (Units::Noaa, "130 N", Some("29.2 lbf")),
            (Units::Noaa, "6.6 kg", Some("14.6 lb")),
            (Units::Noaa, "40 fathom", None),
            (Units::Noaa, "1,700 lbf", None),
            (Units::Mixed, "25 m", None),
            (Units::Mixed, "130 N", Some("29.2 lbf")),
            (Units::Mixed, "3/8 in", Some("9.5 mm")),
            (Units::Si, "1700 lbf", Some("7562 N")),
            (Units::Si, "40 lb", Some("18.1 kg")),
            (Units::Si, "0.5", None),
            (Units::Noaa, "90 deg", None),
            (Units::Noaa, "pp", None),
            (Units::Noaa, "", None),
        ] {
            assert_eq!(units.instead_of(text).as_deref(), shown, "{units:?} {text}");
        }
    }

    #[test]
    fn seventeen_hundred_pounds_are_the_newtons_of_the_weak_rope_rule() {
        assert_eq!(ForceUnit::Lbf.text(7_561.976_746), "1700 lbf");
        assert_eq!(ForceUnit::Newton.text(7_561.976_746), "7562 N");
        assert_eq!(ForceUnit::Newton.text(12.34), "12.3 N");
        assert_eq!(ForceUnit::Lbf.text(-0.001), "0.0 lbf", "nothing has no sign");
        assert_eq!(Units::Si.length(-0.001), "0.00 m");
        assert_eq!(Units::Si.speed(-0.52), "-0.52 m/s");
    }

    #[test]
    fn a_pressure_is_shown_in_the_unit_of_forces() {
        assert_eq!(ForceUnit::Lbf.pressure(6_894.757), "1.0 psi");
        assert_eq!(ForceUnit::Newton.pressure(12_000.0), "12 kPa");
    }

    #[test]
    fn the_trade_reads_its_own_units() {
        let units = Units::Noaa;
        assert_eq!(units.diameter(0.009_525), "3/8 in");
        assert_eq!(units.diameter(0.0254), "1 in");
        assert_eq!(units.depth(73.152), "40.0 fathom");
        assert_eq!(units.speed(1.0), "1.94 kn");
        assert_eq!(units.length(18.288), "60.0 ft");
        assert!((units.to_m_s(units.of_m_s(0.7)) - 0.7).abs() < 1e-12);
        assert_eq!(
            [Units::Si.length(18.288), Units::Si.speed(0.5), Units::Mixed.diameter(0.009_525)],
            ["18.3 m", "0.50 m/s", "9.5 mm"]
        );
    }

    #[test]
    fn a_pressure_follows_the_unit_of_forces() {
        assert_eq!(ForceUnit::Lbf.pressure(6_894.757), "1.0 psi");
        assert_eq!(ForceUnit::Newton.pressure(12_000.0), "12 kPa");
    }

    #[test]
    fn bearings_run_clockwise_from_north() {
        for (east, north, bearing) in
            [(0.0, 1.0, 0.0), (1.0, 0.0, 90.0), (0.0, -1.0, 180.0), (-1.0, 0.0, 270.0)]
        {
            assert!((bearing_degrees(east, north) - bearing).abs() < 1e-9);
        }
    }
}

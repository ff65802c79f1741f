//! A value drawn for an encounter, as its scenario or library file holds it.

use endline_gear::Setting;

/// A year of 365.25 days [s].
const YEAR_S: f64 = 31_557_600.0;

/// From this on, a time is told in years [s].
const LONG_S: f64 = 86_400.0;

/// A drawn value for people: three figures; angles in degrees, long times in years. Words stay as they are.
#[must_use]
pub fn in_words(text: &str) -> String {
    let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
    let Ok(value) = number.parse::<f64>() else { return text.to_owned() };
    let (value, unit) = match unit {
        "rad" => (value.to_degrees(), "deg"),
        "s" if value.abs() >= LONG_S => (value / YEAR_S, "yr"),
        _ => (value, unit),
    };
    let three_figures = format!("{value:.2e}").parse().unwrap_or(value);
    format!("{three_figures} {unit}").trim_end().to_owned()
}

/// A drawn value.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Name of the prior.
    pub name: String,
    /// As it stands in a file: a number in SI with its unit, or a word.
    pub text: String,
    /// Its number [SI]; none for a word.
    pub number: Option<f64>,
    /// Whether it stands in a file without quotes.
    pub plain: bool,
}

impl Drawn {
    /// The value as a file holds it.
    #[must_use]
    pub fn setting(&self) -> Setting {
        if self.plain { Setting::plain(&self.text) } else { Setting::text(&self.text) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawn_value_is_told_in_the_units_of_people() {
        let told = |text| in_words(text);
        assert_eq!(told("-2.7802695834678914 rad"), "-159 deg");
        assert_eq!(told("568036800 s"), "18 yr");
        assert_eq!(told("12.5 s"), "12.5 s");
        assert_eq!(told("0.5119571566581724 m"), "0.512 m");
        assert_eq!(told("2"), "2");
        assert_eq!(told("roll-away"), "roll-away");
        assert_eq!(told("barrel roll"), "barrel roll");
    }
}

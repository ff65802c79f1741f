//! A value drawn for an encounter, as its scenario or library file holds it.

use endline_gear::Setting;

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

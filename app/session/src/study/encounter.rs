//! An encounter: what was drawn for it.

use super::draw::{self, Draw, Drawn};
use super::open::Opened;

/// An encounter drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Encounter {
    /// Its index.
    pub index: u32,
    /// What was drawn, by name.
    pub drawn: Vec<Drawn>,
    /// What it counts for; weights have mean 1.
    pub weight: f64,
}

impl Encounter {
    /// Draws encounter `index` of a study.
    #[must_use]
    pub fn of(opened: &Opened, index: u32) -> Self {
        let Draw { values: drawn, weight } = draw::draw(&opened.study, index);
        Self { index, drawn, weight }
    }

    /// The encounter at a point of the unit cube ([`draw::dimensions`]); it has index 0, whatever the point.
    #[must_use]
    pub fn at_point(opened: &Opened, point: &[f64]) -> Self {
        Self { index: 0, drawn: draw::at_point(&opened.study, point), weight: 1.0 }
    }

    /// A number that was drawn, by name [SI].
    #[must_use]
    pub fn number(&self, name: &str) -> Option<f64> {
        self.drawn.iter().find(|drawn| drawn.name == name).and_then(|drawn| drawn.number)
    }
}

//! Encounters of whales with gear: the values drawn for each, and the gear at rest before the whale arrives.
//!
//! | file | content |
//! |---|---|
//! | `draw` | values drawn from the priors of a study |
//! | `fitted` | proposals fitted to the held encounters of earlier stages, the mixture from which encounters are drawn, and their weights |
//! | `priors` | the fields that a prior sets in scenario and library |
//! | `equilibria` | gear at rest in the sea of an encounter |
//! | `aim` | the lines at which the whales of a study are aimed, and their starts |
//! | `tracks` | tracks of whales through an area with gear, and the rope that they meet |
//! | `meet` | the start from which a whale meets a line at a depth with a part of its body |

pub(crate) mod aim;
pub mod draw;
pub(crate) mod equilibria;
pub(crate) mod fitted;
pub mod meet;
pub(crate) mod priors;
pub(crate) mod tracks;

use endline_gear::Study;

use draw::Draw;
use fitted::Fitted;

pub use draw::{Drawn, in_words};

/// An encounter with its drawn values.
#[derive(Clone, Debug, PartialEq)]
pub struct Encounter {
    /// Its index.
    pub index: u32,
    /// Drawn values, by name.
    pub drawn: Vec<Drawn>,
    /// Its weight; weights have mean 1.
    pub weight: f64,
}

impl Encounter {
    /// Draws encounter `index` of the first stage of a study, which is all of it unless the study adapts.
    pub fn of(study: &Study, index: u32) -> Self {
        Self::with(study, index, &Fitted::default())
    }

    /// Draws encounter `index` of a study, in a stage with these fitted proposals.
    pub(crate) fn with(study: &Study, index: u32, fitted: &Fitted) -> Self {
        let Draw { values: drawn, weight } = draw::draw(study, index, fitted);
        Self { index, drawn, weight }
    }

    /// The encounter at a point of the unit cube ([`draw::dimensions`]); it has index 0, whatever the point.
    pub fn at_point(study: &Study, point: &[f64]) -> Self {
        Self { index: 0, drawn: draw::at_point(study, point), weight: 1.0 }
    }

    /// The encounter with another number of a prior [SI], if it has this prior.
    pub(crate) fn with_number(&self, name: &str, number: f64) -> Self {
        let mut changed = self.clone();
        for drawn in changed.drawn.iter_mut().filter(|drawn| drawn.name == name) {
            drawn.number = Some(number);
        }
        changed
    }

    /// A drawn number, by name [SI].
    pub fn number(&self, name: &str) -> Option<f64> {
        self.drawn.iter().find(|drawn| drawn.name == name).and_then(|drawn| drawn.number)
    }
}

//! How a whale's body changes with its length: proportions of the head, mass, and length by age.

use crate::entry::Entry;
use crate::whale::{Station, WhaleForm};

/// Laws of growth of a whale of the library.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Length of the mouth over its share of body length [m].
    pub mouth_offset_m: f64,
    /// Length of the baleen over its share of body length [m].
    pub baleen_offset_m: f64,
    /// Width of the head at a tenth of length: share of length, and what is added [m].
    pub head_width: Option<[f64; 2]>,
    /// Mass by length; without it the file's `breadth_scale` holds.
    pub mass: Option<MassLaw>,
    /// Length by age.
    pub age: Option<AgeLaw>,
}

/// `M = mass (L / length)^exponent` of a whale in middling condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassLaw {
    /// Length at which the mass is given [m].
    pub length_m: f64,
    /// Mass at that length [kg].
    pub mass_kg: f64,
    /// Exponent of length [1].
    pub exponent: f64,
}

/// `L = at_one + per_tenfold log10(age)` from one year on; before that evenly from the length at birth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgeLaw {
    /// Length at birth [m].
    pub birth_m: f64,
    /// Length at one year [m].
    pub at_one_m: f64,
    /// Growth for each tenfold age [m].
    pub per_tenfold_m: f64,
}

/// Shortest baleen: that of a calf at birth, where the law of growth gives none [share of length].
const LEAST_BALEEN: f64 = 0.03;
/// Where the head's own width ends and the table's begins [share of length].
const HEAD_WIDTH: [f64; 2] = [0.1, 0.3];
/// A year [s].
pub(crate) const YEAR_S: f64 = 365.25 * 86_400.0;

impl Growth {
    /// Reads the laws of a file that has been checked.
    pub(crate) fn of(entry: &Entry) -> Self {
        let value = |key: &str| entry.value(key);
        let all =
            |[one, two, three]: [&'static str; 3]| Some([value(one)?, value(two)?, value(three)?]);
        Self {
            mouth_offset_m: value("head.mouth_offset").unwrap_or(0.0),
            baleen_offset_m: value("head.baleen_offset").unwrap_or(0.0),
            head_width: value("head.width")
                .map(|share| [share, value("head.width_offset").unwrap_or(0.0)]),
            mass: all(["mass.length", "mass.mass", "mass.exponent"])
                .map(|[length_m, mass_kg, exponent]| MassLaw { length_m, mass_kg, exponent }),
            age: all(["age.birth", "age.one_year", "age.tenfold"]).map(
                |[birth_m, at_one_m, per_tenfold_m]| AgeLaw { birth_m, at_one_m, per_tenfold_m },
            ),
        }
    }

    /// The proportions of a form, given as shares, at its length.
    pub(crate) fn proportion(&self, form: &mut WhaleForm) {
        let length_m = form.length_m;
        form.head.mouth = (form.head.mouth + self.mouth_offset_m / length_m).clamp(0.08, 0.4);
        form.head.baleen = (form.head.baleen + self.baleen_offset_m / length_m)
            .max(LEAST_BALEEN.min(form.head.baleen));
        if let Some([share, offset_m]) = self.head_width {
            let wide = share + offset_m / length_m;
            let table = width_at(&form.stations, HEAD_WIDTH[0]);
            let factor = (wide / table.max(1e-6)).clamp(0.5, 1.5);
            for station in &mut form.stations {
                let [from, to] = HEAD_WIDTH;
                let left = ((to - station.at) / (to - from)).clamp(0.0, 1.0);
                station.width *= 1.0 + (factor - 1.0) * left;
            }
        }
    }
}

impl MassLaw {
    /// Mass of a whale in middling condition [kg].
    #[must_use]
    pub fn mass_kg(&self, length_m: f64) -> f64 {
        self.mass_kg * libm::pow(length_m / self.length_m, self.exponent)
    }
}

impl AgeLaw {
    /// Length at an age [m].
    #[must_use]
    pub fn length_m(&self, age_s: f64) -> f64 {
        let years = age_s / YEAR_S;
        if years < 1.0 {
            self.birth_m + (self.at_one_m - self.birth_m) * years.max(0.0)
        } else {
            self.at_one_m + self.per_tenfold_m * libm::log10(years)
        }
    }
}

/// Width of the table at a place, straight between its stations [share of length].
fn width_at(stations: &[Station], at: f64) -> f64 {
    let between = stations.windows(2).find(|pair| pair[0].at <= at && at <= pair[1].at);
    between.map_or(0.0, |pair| {
        pair[0].width
            + (pair[1].width - pair[0].width) * (at - pair[0].at) / (pair[1].at - pair[0].at)
    })
}

//! Box-shaped gear of the library: traps and anchors.

use crate::entry::Entry;
use crate::fields::Problems;

use super::point::{Point, with_own};
use super::rope::{GRAVITY_M_S2, SEA_WATER_KG_M3};

/// A trap, or an anchor reckoned as a box.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxGear {
    /// Its file.
    pub entry: Entry,
    /// Length, width, height [m].
    pub size_m: [f64; 3],
    /// Mass in air [kg].
    pub mass_kg: f64,
    /// Weight in sea water [N].
    pub wet_weight_n: f64,
    /// Drag coefficient on the solid part of the faces.
    pub drag_coefficient: f64,
    /// Solid share of a face.
    pub solidity: f64,
    /// Added mass along and across, as a share of the water it encloses.
    pub added_mass_horizontal: f64,
    /// Added mass up and down, as a share of the water it encloses.
    pub added_mass_vertical: f64,
    /// Friction on the seabed before it moves.
    pub start_friction: f64,
    /// Friction on the seabed once it slides.
    pub slide_friction: f64,
}

impl BoxGear {
    /// From a file's figures; `None` where one is missing, which is a problem already told.
    pub(crate) fn from_entry(entry: Entry, problems: &Problems) -> Option<Self> {
        let (mass_kg, wet_weight) = (entry.value("mass")?, entry.figure("wet_weight")?);
        if wet_weight.value >= mass_kg * GRAVITY_M_S2 {
            let message = format!("`wet_weight` {} is not below the weight in air, {:.0} N", wet_weight.text, mass_kg * GRAVITY_M_S2);
            problems.push(wet_weight.place.error(message, "what is in the water weighs less there; mend the wet weight or the mass"));
        }
        let (start, slide) = (entry.value("start_friction")?, entry.figure("slide_friction")?);
        if slide.value > start {
            let message = format!("`slide_friction` {} is above `start_friction` {start}", slide.value);
            problems.push(slide.place.error(message, "a thing that slides grips no better than one at rest"));
        }
        Some(Self {
            size_m: [entry.value("length")?, entry.value("width")?, entry.value("height")?],
            mass_kg,
            wet_weight_n: wet_weight.value,
            drag_coefficient: entry.value("drag_coefficient")?,
            solidity: entry.value("solidity")?,
            added_mass_horizontal: entry.value("added_mass_horizontal")?,
            added_mass_vertical: entry.value("added_mass_vertical")?,
            start_friction: start,
            slide_friction: slide.value,
            entry,
        })
    }

    /// Where a line can be made fast, the usual point first: the middle of the top edge at the end of its length.
    #[must_use]
    pub fn points(&self) -> Vec<Point> {
        let [x, y, z] = self.size_m.map(|size| size / 2.0);
        let usual = [
            ("end", [x, 0.0, z]),
            ("bridle-port", [x, y, z]),
            ("bridle-starboard", [x, -y, z]),
            ("far-end", [-x, 0.0, z]),
            ("far-port", [-x, y, z]),
            ("far-starboard", [-x, -y, z]),
            ("port", [0.0, y, z]),
            ("starboard", [0.0, -y, z]),
            ("top", [0.0, 0.0, z]),
        ];
        with_own(usual.map(|(name, at_m)| Point { name: name.to_owned(), at_m }).to_vec(), &self.entry.points)
    }

    /// Volume of wire, wood and ballast: `(m g - W) / (ρ g)` in sea water [m³].
    #[must_use]
    pub fn displaced_m3(&self) -> f64 {
        (self.mass_kg * GRAVITY_M_S2 - self.wet_weight_n) / (SEA_WATER_KG_M3 * GRAVITY_M_S2)
    }
}

//! Box-shaped gear of the library: traps and anchors.

use crate::entry::Entry;
use crate::fields::Problems;

use super::point::{Point, with_own};
use super::rope::{GRAVITY_M_S2, SEA_WATER_KG_M3};

/// Density of ballast where a file has none: brick [kg/m³].
const BRICK_KG_M3: f64 = 2000.0;

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
    /// Solid share of a face across x (the ends), y (the sides) and z (top and floor).
    pub solidity: [f64; 3],
    /// Mass of ballast and runners, flat over the floor [kg].
    pub ballast_kg: f64,
    /// Height of that above the underside [m].
    pub ballast_height_m: f64,
    /// Density of that [kg/m³].
    pub ballast_density_kg_m3: f64,
    /// Volume of foam or wood that floats [m³].
    pub foam_m3: f64,
    /// Height of that above the underside [m].
    pub foam_height_m: f64,
    /// Added mass along and across, as a share of the water it encloses.
    pub added_mass_horizontal: f64,
    /// Added mass up and down, as a share of the water it encloses.
    pub added_mass_vertical: f64,
    /// Friction on the seabed before it moves.
    pub start_friction: f64,
    /// Friction on the seabed once it slides.
    pub slide_friction: f64,
    /// Force that holds it back when it is lifted off the seabed it has rested on [N].
    pub break_out_n: f64,
}

impl BoxGear {
    /// From a file's figures; `None` where one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry, problems: &Problems) -> Option<Self> {
        let (mass_kg, wet_weight) = (entry.value("mass")?, entry.figure("wet_weight")?);
        if wet_weight.value >= mass_kg * GRAVITY_M_S2 {
            let message = format!(
                "`wet_weight` {} is not below the weight in air, {:.0} N",
                wet_weight.text,
                mass_kg * GRAVITY_M_S2
            );
            problems.push(wet_weight.place.error(
                message,
                "what is in the water weighs less there; fix the wet weight or the mass",
            ));
        }
        let (start, slide) = (entry.value("start_friction")?, entry.figure("slide_friction")?);
        if slide.value > start {
            let message =
                format!("`slide_friction` {} is above `start_friction` {start}", slide.value);
            problems.push(
                slide.place.error(message, "a thing that slides grips no better than one at rest"),
            );
        }
        let (ballast_kg, solidity) =
            (entry.value("ballast").unwrap_or(0.0), entry.value("solidity")?);
        let (size_m, or) = (
            [entry.value("length")?, entry.value("width")?, entry.value("height")?],
            |key, usual| entry.value(key).unwrap_or(usual),
        );
        let item = Self {
            size_m,
            mass_kg,
            wet_weight_n: wet_weight.value,
            drag_coefficient: entry.value("drag_coefficient")?,
            solidity: ["solidity_ends", "solidity_sides", "solidity_top"]
                .map(|key| or(key, solidity)),
            ballast_kg,
            ballast_height_m: or("ballast_height", 0.0),
            ballast_density_kg_m3: or("ballast_density", BRICK_KG_M3),
            foam_m3: or("foam", 0.0),
            foam_height_m: or("foam_height", size_m[2]),
            added_mass_horizontal: entry.value("added_mass_horizontal")?,
            added_mass_vertical: entry.value("added_mass_vertical")?,
            start_friction: start,
            slide_friction: slide.value,
            break_out_n: or("break_out", 0.0),
            entry,
        };
        item.check(problems);
        Some(item)
    }

    /// What weighs and floats inside must fit into what the whole weighs in air and in water, and lie in the box.
    fn check(&self, problems: &Problems) {
        let report = |key: &str, message: String, help: &str| {
            let place = self.entry.figure(key).map_or(&self.entry.place, |figure| &figure.place);
            problems.push(place.error(message, help));
        };
        if self.ballast_kg >= self.mass_kg {
            report(
                "ballast",
                format!("`ballast` {} kg is not below the `mass`", self.ballast_kg),
                "the mass has the ballast in it",
            );
        } else if self.wire_m3() < 0.0 {
            let litres = 1e3 * (self.ballast_m3() + self.foam_m3);
            let message = format!(
                "ballast and foam displace {litres:.2} L, more than the {:.2} L of the whole",
                1e3 * self.displaced_m3()
            );
            let key = if self.foam_m3 > 0.0 { "foam" } else { "ballast" };
            report(
                key,
                message,
                "the whole displaces what it weighs less in water; fix the ballast, its density, the foam or `wet_weight`",
            );
        }
        for (key, height) in
            [("ballast_height", self.ballast_height_m), ("foam_height", self.foam_height_m)]
        {
            if height > self.size_m[2] {
                report(
                    key,
                    format!("`{key}` {height} m is above the box"),
                    "it is measured from the underside up to the `height`",
                );
            }
        }
    }

    /// Volume of the ballast [m³].
    #[must_use]
    pub fn ballast_m3(&self) -> f64 {
        self.ballast_kg / self.ballast_density_kg_m3
    }

    /// Volume of what is left, spread over the faces: wire and wood [m³].
    #[must_use]
    pub fn wire_m3(&self) -> f64 {
        self.displaced_m3() - self.ballast_m3() - self.foam_m3
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
        with_own(
            usual.map(|(name, at_m)| Point { name: name.to_owned(), at_m }).to_vec(),
            &self.entry.points,
        )
    }

    /// Volume of wire, wood and ballast: `(m g - W) / (ρ g)` in sea water [m³].
    #[must_use]
    pub fn displaced_m3(&self) -> f64 {
        (self.mass_kg * GRAVITY_M_S2 - self.wet_weight_n) / (SEA_WATER_KG_M3 * GRAVITY_M_S2)
    }
}

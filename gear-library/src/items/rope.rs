//! A rope of the library, and the checks between its figures.

use crate::entry::Entry;
use crate::fields::Problems;
use crate::units::{Quantity, format_si};

/// Density of sea water and gravity behind a wet weight of the library.
pub(crate) const SEA_WATER_KG_M3: f64 = 1025.0;
/// Gravity behind a wet weight of the library [m/s²].
pub(crate) const GRAVITY_M_S2: f64 = 9.81;

/// A rope.
#[derive(Clone, Debug, PartialEq)]
pub struct Rope {
    /// Its file.
    pub entry: Entry,
    /// Material: the item of `friction/` that says how it rubs.
    pub material: String,
    /// Nominal diameter [m].
    pub diameter_m: f64,
    /// Mass in air [kg/m].
    pub mass_kg_m: f64,
    /// Density of the fibre [kg/m³].
    pub density_kg_m3: f64,
    /// Breaking strength when new and unknotted [N].
    pub strength_n: f64,
    /// Share of that strength that wear and knots leave [1].
    pub strength_left: f64,
    /// Axial stiffness EA [N].
    pub stiffness_n: f64,
    /// Axial damping BA [N s].
    pub damping_n_s: f64,
    /// Drag coefficient across, on `d·l`.
    pub drag_normal: f64,
    /// Drag coefficient along, on `π·d·l`.
    pub drag_tangential: f64,
    /// Added-mass coefficient across.
    pub added_mass: f64,
}

impl Rope {
    /// From a file's figures; `None` where one is missing, which is a problem already told.
    pub(crate) fn from_entry(entry: Entry, problems: &Problems) -> Option<Self> {
        check_wet_weight(&entry, problems);
        check_stretch(&entry, problems);
        let share = |key| entry.value(key).unwrap_or(1.0);
        Some(Self {
            material: entry.word("material")?.value.clone(),
            diameter_m: entry.value("diameter")?,
            mass_kg_m: entry.value("mass")?,
            density_kg_m3: entry.value("density")?,
            strength_n: entry.value("strength")?,
            strength_left: share("wear_factor") * share("knot_factor"),
            stiffness_n: entry.value("stiffness")?,
            damping_n_s: entry.value("damping")?,
            drag_normal: entry.value("drag_normal")?,
            drag_tangential: entry.value("drag_tangential")?,
            added_mass: entry.value("added_mass")?,
            entry,
        })
    }

    /// Volume of fibre by length, which is what buoys it up: mass over density [m³/m].
    #[must_use]
    pub fn displaced_m3_m(&self) -> f64 {
        self.mass_kg_m / self.density_kg_m3
    }

    /// Weight in sea water by length, below zero where it floats [N/m].
    #[must_use]
    pub fn wet_weight_n_m(&self) -> f64 {
        wet_weight(self.mass_kg_m, self.density_kg_m3)
    }

    /// The rope as the simulation takes it.
    #[must_use]
    pub fn to_model(&self) -> endline_sim::model::Rope {
        endline_sim::model::Rope {
            id: self.entry.id.clone(),
            diameter_m: self.diameter_m,
            mass_kg_m: self.mass_kg_m,
            displaced_m3_m: self.displaced_m3_m(),
            axial_stiffness_n: self.stiffness_n,
            axial_stiffening_n: 0.0,
            axial_damping_n_s: self.damping_n_s,
            axial_damping_ratio: 0.0,
            bending_stiffness_n_m2: 0.0,
            drag_normal: self.drag_normal,
            drag_tangential: self.drag_tangential,
            added_mass_normal: self.added_mass,
            added_mass_tangential: 0.0,
            strength_n: self.strength_n * self.strength_left,
        }
    }
}

/// `m g (1 - ρ_water / ρ_fibre)`.
fn wet_weight(mass_kg_m: f64, density_kg_m3: f64) -> f64 {
    mass_kg_m * GRAVITY_M_S2 * (1.0 - SEA_WATER_KG_M3 / density_kg_m3)
}

/// A stated wet weight must agree with mass and density to 2 % of the weight in air.
fn check_wet_weight(entry: &Entry, problems: &Problems) {
    let (Some(stated), Some(mass), Some(density)) = (entry.figure("wet_weight"), entry.value("mass"), entry.value("density")) else {
        return;
    };
    let derived = wet_weight(mass, density);
    if (stated.value - derived).abs() <= 0.02 * mass * GRAVITY_M_S2 {
        return;
    }
    let shown = format_si((derived * 1e4).round() / 1e4, Quantity::ForceByLength);
    let message = format!("`wet_weight` is {}, but mass and density give {shown}", stated.text);
    problems.push(stated.place.error(message, "mend the wet weight, the mass or the density of the fibre; or leave the wet weight out"));
}

/// Stiffness times stretch at break should be the strength within 25 %.
fn check_stretch(entry: &Entry, problems: &Problems) {
    let (Some(stiffness), Some(stretch), Some(strength)) =
        (entry.figure("stiffness"), entry.value("stretch_at_break"), entry.value("strength"))
    else {
        return;
    };
    let at_break = stiffness.value * stretch;
    if (at_break / strength - 1.0).abs() <= 0.25 {
        return;
    }
    let message = format!(
        "stiffness × stretch_at_break is {}, but the strength is {}",
        format_si(at_break.round(), Quantity::Force),
        format_si(strength.round(), Quantity::Force)
    );
    let help = "the three belong together: strength ≈ stiffness × stretch; mend the one that is wrong";
    problems.push(stiffness.place.warning(message, help));
}

//! Ropes of the library with the checks between their figures, knots and weak links.

use crate::entry::Entry;
use crate::fields::Problems;
use crate::units::{Quantity, format_si};

/// Density of sea water of wet weights of the library [kg/m³].
pub(crate) const SEA_WATER_KG_M3: f64 = 1025.0;
/// Gravity of wet weights of the library [m/s²].
pub(crate) const GRAVITY_M_S2: f64 = 9.81;

/// Towing speed at which the library's tangential drag coefficients were measured [m/s].
const TOWED_M_S: f64 = 2.0;

/// Working history of a rope, which determines its tension law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Condition {
    /// Linear from slack to break, with wear: between the other two.
    #[default]
    Secant,
    /// First loading: a soft toe, no wear.
    New,
    /// Worked in: stiff, with wear.
    Worked,
}

impl Condition {
    /// Words in files, in the order of the variants.
    pub const WORDS: [(&'static str, Self); 3] =
        [("secant", Self::Secant), ("new", Self::New), ("worked", Self::Worked)];

    /// Its word.
    pub fn word(self) -> &'static str {
        Self::WORDS[self as usize].0
    }
}

/// A rope.
#[derive(Clone, Debug, PartialEq)]
pub struct Rope {
    /// Its file.
    pub entry: Entry,
    /// Material: the item of `friction/` that gives its friction.
    pub material: String,
    /// Nominal diameter [m].
    pub diameter_m: f64,
    /// Mass in air [kg/m].
    pub mass_kg_m: f64,
    /// Density of the fibre [kg/m³].
    pub density_kg_m3: f64,
    /// Breaking strength when new and unknotted, as its source states it [N].
    pub strength_n: f64,
    /// Mean of new pieces over that strength [1].
    pub mean_factor: f64,
    /// Strength after wear, as a share of new [1].
    pub wear_factor: f64,
    /// Strength at an end without a named knot or splice, as a share [1].
    pub knot_factor: f64,
    /// Coefficient of variation of the strength between pieces [1].
    pub strength_cv: f64,
    /// Axial stiffness EA, from slack to break [N].
    pub stiffness_n: f64,
    /// Stretch at break [1].
    pub stretch_at_break: Option<f64>,
    /// Stiffness of new rope at zero strain, as a share [1].
    pub toe: Option<f64>,
    /// Axial stiffness EA when worked in [N].
    pub worked_stiffness_n: Option<f64>,
    /// Axial damping BA [N s].
    pub damping_n_s: f64,
    /// Additional axial damping, as a share of a segment's critical damping [1].
    pub damping_ratio: f64,
    /// Bending stiffness EI [N m²].
    pub bending_stiffness_n_m2: f64,
    /// Drag coefficient across, on `d·l`.
    pub drag_normal: f64,
    /// Drag coefficient along, on `π·d·l`.
    pub drag_tangential: f64,
    /// Share of `drag_tangential` that is proportional to the inverse root of the speed.
    pub drag_tangential_viscous: f64,
    /// Speed along the rope at which `drag_tangential` holds [m/s].
    pub drag_tangential_speed_m_s: f64,
    /// Added-mass coefficient across.
    pub added_mass: f64,
    /// Added-mass coefficient along.
    pub added_mass_along: f64,
}

impl Rope {
    /// Builds it from a file's figures; `None` if one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry, problems: &Problems) -> Option<Self> {
        check_wet_weight(&entry, problems);
        check_stretch(&entry, problems);
        check_damping(&entry, problems);
        let or = |key, usual: f64| entry.value(key).unwrap_or(usual);
        Some(Self {
            material: entry.word("material")?.value.clone(),
            diameter_m: entry.value("diameter")?,
            mass_kg_m: entry.value("mass")?,
            density_kg_m3: entry.value("density")?,
            strength_n: entry.value("strength")?,
            mean_factor: or("mean_factor", 1.0),
            wear_factor: or("wear_factor", 1.0),
            knot_factor: or("knot_factor", 1.0),
            strength_cv: or("strength_cv", 0.0),
            stiffness_n: entry.value("stiffness")?,
            stretch_at_break: entry.value("stretch_at_break"),
            toe: entry.value("toe"),
            worked_stiffness_n: entry.value("worked_stiffness"),
            damping_n_s: or("damping", 0.0),
            damping_ratio: or("damping_ratio", 0.0),
            bending_stiffness_n_m2: or("bending_stiffness", 0.0),
            drag_normal: entry.value("drag_normal")?,
            drag_tangential: entry.value("drag_tangential")?,
            drag_tangential_viscous: or("drag_tangential_viscous", 0.0),
            drag_tangential_speed_m_s: or("drag_tangential_speed", TOWED_M_S),
            added_mass: entry.value("added_mass")?,
            added_mass_along: or("added_mass_along", 0.0),
            entry,
        })
    }

    /// Displaced volume by length: mass over density of the fibre [m³/m].
    pub fn displaced_m3_m(&self) -> f64 {
        self.mass_kg_m / self.density_kg_m3
    }

    /// Weight in sea water by length, negative for floating rope [N/m].
    pub fn wet_weight_n_m(&self) -> f64 {
        wet_weight(self.mass_kg_m, self.density_kg_m3)
    }

    /// The rope of the model: linear, with the mean strength of new pieces, without bending stiffness.
    pub fn to_model(&self) -> endline_sim::model::Rope {
        endline_sim::model::Rope {
            id: self.entry.id.clone(),
            diameter_m: self.diameter_m,
            mass_kg_m: self.mass_kg_m,
            displaced_m3_m: self.displaced_m3_m(),
            axial_stiffness_n: self.stiffness_n,
            axial_stiffening_n: 0.0,
            axial_damping_n_s: self.damping_n_s,
            axial_damping_ratio: self.damping_ratio,
            bending_stiffness_n_m2: 0.0,
            drag_normal: self.drag_normal,
            drag_tangential: self.drag_tangential,
            drag_tangential_viscous: self.drag_tangential_viscous,
            drag_tangential_speed_m_s: self.drag_tangential_speed_m_s,
            added_mass_normal: self.added_mass,
            added_mass_tangential: self.added_mass_along,
            strength_n: self.strength_n * self.mean_factor,
        }
    }

    /// The rope of the model in a condition, which is part of its id: `pp-3-8 (worked)`. `Err` is the key of a missing figure.
    ///
    /// New rope: `T = E ε (toe + (1 - toe) ε/ε_b)` with stiffness `E` and stretch at break `ε_b`.
    pub fn in_condition(
        &self,
        condition: Condition,
    ) -> Result<endline_sim::model::Rope, &'static str> {
        let mut rope = self.to_model();
        match condition {
            Condition::Secant => return Ok(rope),
            Condition::Worked => {
                rope.axial_stiffness_n = self.worked_stiffness_n.ok_or("worked_stiffness")?
            }
            Condition::New => {
                let (toe, stretch) =
                    (self.toe.ok_or("toe")?, self.stretch_at_break.ok_or("stretch_at_break")?);
                rope.axial_stiffness_n = toe * self.stiffness_n;
                rope.axial_stiffening_n = (1.0 - toe) * self.stiffness_n / stretch;
            }
        }
        rope.id = format!("{} ({})", rope.id, condition.word());
        Ok(rope)
    }
}

/// Checks that exactly one of the two damping figures is present.
fn check_damping(entry: &Entry, problems: &Problems) {
    let help = "write damping = \"2 N s\" or damping_ratio = 0.03: a number of its own, or a share of a segment's critical damping";
    match (entry.figure("damping"), entry.figure("damping_ratio")) {
        (None, None) => {
            let mut place = entry.place.clone();
            place.field = if place.field.is_empty() {
                "damping".to_owned()
            } else {
                format!("{}.damping", place.field)
            };
            problems.push(place.error("`damping` is missing", help));
        }
        (Some(_), Some(ratio)) => {
            problems.push(ratio.place.error("both `damping` and `damping_ratio` are present", help))
        }
        _ => {}
    }
}

/// `m g (1 - ρ_water / ρ_fibre)`.
fn wet_weight(mass_kg_m: f64, density_kg_m3: f64) -> f64 {
    mass_kg_m * GRAVITY_M_S2 * (1.0 - SEA_WATER_KG_M3 / density_kg_m3)
}

/// Checks that a stated wet weight agrees with mass and density within 2 % of the weight in air.
fn check_wet_weight(entry: &Entry, problems: &Problems) {
    let (Some(stated), Some(mass), Some(density)) =
        (entry.figure("wet_weight"), entry.value("mass"), entry.value("density"))
    else {
        return;
    };
    let derived = wet_weight(mass, density);
    if (stated.value - derived).abs() <= 0.02 * mass * GRAVITY_M_S2 {
        return;
    }
    let shown = format_si((derived * 1e4).round() / 1e4, Quantity::ForceByLength);
    let message = format!("`wet_weight` is {}, but mass and density give {shown}", stated.text);
    problems.push(stated.place.error(
        message,
        "fix the wet weight, the mass or the density of the fibre; or leave the wet weight out",
    ));
}

/// Warns if stiffness times stretch at break differs from the strength by more than 25 %.
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
    let help = "strength ≈ stiffness × stretch_at_break; fix the wrong one of the three";
    problems.push(stiffness.place.warning(message, help));
}

/// A knot or splice.
#[derive(Clone, Debug, PartialEq)]
pub struct Knot {
    /// Its file.
    pub entry: Entry,
    /// Strength of the rope at the knot, as a share [1].
    pub strength_left: f64,
    /// Breadth over the rope's diameter [1].
    pub bulk: f64,
}

/// Default breadth of an end connection over the rope's diameter: that of a splice, the smallest (estimate).
pub(crate) const USUAL_BULK: f64 = 1.5;

impl Knot {
    /// Builds it from a file's figures; `None` if one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry) -> Option<Self> {
        Some(Self {
            strength_left: entry.value("strength_left")?,
            bulk: entry.value("bulk").unwrap_or(USUAL_BULK),
            entry,
        })
    }
}

/// A weak link.
#[derive(Clone, Debug, PartialEq)]
pub struct WeakLink {
    /// Its file.
    pub entry: Entry,
    /// Tension above which it parts, as stated by its source [N].
    pub rating_n: f64,
    /// Mean strength over the rating [1].
    pub mean_factor: f64,
    /// Coefficient of variation between links [1].
    pub spread: f64,
    /// Breadth; zero if it is not broader than the rope [m].
    pub breadth_m: f64,
}

impl WeakLink {
    /// Builds it from a file's figures; `None` if one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry) -> Option<Self> {
        Some(Self {
            rating_n: entry.value("rating")?,
            mean_factor: entry.value("mean_factor").unwrap_or(1.0),
            spread: entry.value("spread").unwrap_or(0.0),
            breadth_m: entry.value("breadth").unwrap_or(0.0),
            entry,
        })
    }
}

//! What makes a whale of the library kinetic: drag by its mass and length, added mass of its shape, strength.
//!
//! Mass, centre and inertia are those of the skin. For added mass the body counts as a spheroid as long as the whale with its greatest
//! diameter. Drag crossways of a body of elliptic outline, side area `A` and length `L`, turning
//! about its middle: `½ρ C ω|ω| · 4/(60π) A L³`; of fins of half span `s` and chord `c`, rolling: `½ρ C ω|ω| · ½ c s⁴`.

use std::f64::consts::PI;
use std::sync::Arc;

use endline_sdk::Posture;
use endline_sim::DVec3;
use endline_sim::whale::kinetic::hull::{fins, spheroid};
use endline_sim::whale::kinetic::{AxialDrag, Dead, Effort, Hull, Kinetic, Muscle};
use endline_sim::whale::{JawStrength, Measures, Skin};

use crate::items::WhaleItem;
use crate::whale::WhaleForm;

/// Drag crossways of an outline like an ellipse as it turns, over its area and the cube of its length.
const TURNING: f64 = 4.0 / (60.0 * PI);

impl WhaleItem {
    /// A whale of this length that feels the gear, in water of a density; `None` where a figure is missing, which is
    /// reported.
    #[must_use]
    pub fn kinetic(
        &self,
        length_m: f64,
        skin: &Skin,
        density_kg_m3: f64,
        effort: Effort,
    ) -> Option<Kinetic> {
        let measures = Measures::of(skin, self.density_kg_m3);
        let value = |key| self.entry.value(key);
        let form = self.form_at(length_m);
        let (mass_kg, inertia) = (measures.mass_kg, measures.inertia_kg_m2);
        let inertia_kg_m2 = DVec3::new(inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z);
        let drag = self.axial_drag(length_m, mass_kg)?;
        let shares = spheroid(length_m / drag.diameter_m);
        let fins = [flukes(&form), flippers(&form)];
        let muscle = self.muscle(&form, effort)?;
        let arm = DVec3::new(
            value("strength.rolling_arm")?,
            value("strength.steering_arm")?,
            value("strength.steering_arm")?,
        );
        let (side_drag_m2, turn_drag_m5) = self.cross_drag(length_m, &fins)?;
        Some(Kinetic {
            mass_kg,
            centre_m: measures.centre_m,
            inertia_kg_m2,
            added_mass_kg: DVec3::new(shares.along, shares.across, shares.across) * mass_kg,
            added_inertia_kg_m2: DVec3::new(
                fins.iter().map(|[span, chord]| self::fins(density_kg_m3, *span, *chord)).sum(),
                shares.turning * inertia_kg_m2.y,
                shares.turning * inertia_kg_m2.z,
            ),
            drag,
            side_drag_m2,
            turn_drag_m5,
            steering_n_m: arm * (length_m * muscle.sustained_n),
            muscle,
            steering_time_s: value("strength.steering_time")?,
            buoyancy: value("dynamics.buoyancy")?,
            hull: Arc::new(Hull::of(skin, &Posture::default())),
            dead: None,
        })
    }

    /// Drag along the axis of a whale of this length and mass.
    fn axial_drag(&self, length_m: f64, mass_kg: f64) -> Option<AxialDrag> {
        let value = |key| self.entry.value(key);
        Some(AxialDrag {
            length_m,
            diameter_m: value("drag.diameter_offset")? + value("drag.diameter")? * length_m,
            wetted_area_m2: value("drag.wetted_area")?
                * libm::pow(mass_kg, value("drag.wetted_area_exponent")?),
            appendages: value("drag.appendages")?,
            oscillation: value("drag.oscillation")?,
            open_mouth: value("drag.open_mouth")?,
            wide_rad: value("drag.wide_mouth")?,
        })
    }

    /// Drag crossways, from the side and from above [m²], and of turning about each axis [m⁵], for
    /// fins of half span and mean chord [m].
    fn cross_drag(&self, length_m: f64, fins: &[[f64; 2]; 2]) -> Option<([f64; 2], DVec3)> {
        let value = |key| self.entry.value(key);
        let (area, cross) = (length_m * length_m, value("drag.cross")?);
        let [side, plan] = [value("drag.side_area")? * area, value("drag.plan_area")? * area];
        let rolling =
            fins.map(|[span, chord]| 0.5 * chord * span * span * span * span).iter().sum::<f64>();
        let turning = DVec3::new(
            cross * rolling,
            TURNING * cross * plan * area * length_m,
            TURNING * cross * side * area * length_m,
        );
        Some(([cross * side, cross * plan], turning))
    }

    /// A dead whale afloat, made from the living one: as heavy as what it displaces at rest, with gas
    /// in the belly. `None` where a figure is missing, which is reported.
    #[must_use]
    pub fn dead(&self, skin: &Skin, alive: Kinetic, density_kg_m3: f64) -> Option<Kinetic> {
        let measures = Measures::of(skin, self.density_kg_m3);
        let value = |key| self.entry.value(key);
        let mass_kg = density_kg_m3 * measures.volume_m3 * (1.0 - value("dead.afloat")?);
        let posture = Posture { jaw: value("dead.jaw")?, ..Posture::default() };
        Some(Kinetic {
            mass_kg,
            centre_m: alive.centre_m
                + DVec3::Z * (value("dead.weight_above")? * alive.drag.length_m),
            inertia_kg_m2: alive.inertia_kg_m2 * (mass_kg / alive.mass_kg),
            hull: Arc::new(Hull::of(skin, &posture)),
            dead: Some(Dead { posture }),
            ..alive
        })
    }

    /// How strongly jaws and lips close at a length, from its thrust in a burst; `None` where its file does not say.
    #[must_use]
    pub fn jaws(&self, length_m: f64, skin: &Skin) -> Option<JawStrength> {
        let value = |key| self.entry.value(key);
        let burst_n = value("strength.burst")? * libm::pow(length_m, value("strength.exponent")?);
        let forces_n = [value("strength.jaw")? * burst_n, value("strength.lip")? * burst_n];
        Some(JawStrength::of_forces(skin, forces_n))
    }

    fn muscle(&self, form: &WhaleForm, effort: Effort) -> Option<Muscle> {
        let value = |key| self.entry.value(key);
        let length = form.length_m;
        let grown = libm::pow(length, value("strength.exponent")?);
        Some(Muscle {
            sustained_n: value("strength.sustained")? * grown,
            burst_n: value("strength.burst")? * grown,
            efficiency: value("strength.efficiency")?,
            swept_area_m2: form.flukes.span * value("strength.stroke")? * length * length,
            effort,
        })
    }
}

/// Half span and mean chord of the flukes [m].
fn flukes(form: &WhaleForm) -> [f64; 2] {
    [
        0.5 * form.flukes.span * form.length_m,
        0.5 * (form.flukes.root_chord + form.flukes.tip_chord) * form.length_m,
    ]
}

/// Reach from the axis and mean chord of the flippers [m].
fn flippers(form: &WhaleForm) -> [f64; 2] {
    let at = form.flippers.insertion;
    let nearest = form
        .stations
        .iter()
        .min_by(|one, other| (one.at - at).abs().total_cmp(&(other.at - at).abs()));
    let half_width = 0.5 * form.breadth_scale * nearest.map_or(0.0, |station| station.width);
    let reach = half_width + form.flippers.span * libm::cos(form.flippers.droop);
    [
        reach * form.length_m,
        0.5 * (form.flippers.root_chord + form.flippers.max_chord) * form.length_m,
    ]
}

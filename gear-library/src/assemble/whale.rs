//! The whale.

use std::sync::Arc;

use endline_sdk::WhaleMotion;
use endline_sim::DQuat;
use endline_sim::model::{PilotProgram, Whale};
use endline_sim::whale::kinetic::Kinetic;
use endline_sim::whale::{Measures, Skin};

use crate::diagnostic::At;
use crate::items::WhaleItem;
use crate::nearest::hint;
use crate::scenario::PlacedWhale;
use crate::schema::Kind;

use super::attributes::numbers;
use super::builder::Builder;

impl Builder<'_> {
    /// The scenario's whale with its motion; `kinetic` over the scenario's own choice.
    pub fn add_whale(&mut self, kinetic: Option<bool>) {
        let Some(placed) = &self.scenario.whale else {
            return;
        };
        let Some(item) =
            self.library.whales.iter().find(|whale| whale.entry.id == placed.item.value)
        else {
            self.no_item(Kind::Whale, &placed.item.value, &placed.item.place);
            return;
        };
        self.uses(&item.entry.path);
        item.mesh.iter().for_each(|mesh| self.uses(&mesh.file.value));
        let Some(motion) = self.motion(&placed.motion) else { return };
        let motion = self.with_acts(motion, placed, item);
        let attributes = placed.attributes.resolve(
            motion.descriptor(),
            self.library,
            &mut self.used,
            &self.problems,
        );
        let Some(length_m) = self.length(placed, item) else { return };
        let skin = item.skin_for(length_m, placed.condition, placed.pregnant);
        let measures = Measures::of(&skin, item.density_kg_m3);
        let kinetic = if placed.dead || kinetic.unwrap_or(placed.kinetic) {
            kinetic_whale(placed, item, &skin, [length_m, self.spec.water.density_kg_m3])
        } else {
            None
        };
        let jaws = item.jaws(length_m, &skin);
        self.spec.whale = Some(Whale {
            measures,
            skin,
            joints: item.joints.ranges,
            length_m,
            burst_speed_m_s: item.burst_speed_m_s,
            position_m: placed.position_m,
            orientation: orientation(placed),
            speed_m_s: placed.speed_m_s,
            motion,
            motion_attributes: numbers(&attributes),
            pilot: PilotProgram::default(),
            contact_stiffness_n_m2: placed
                .contact_stiffness_n_m2
                .unwrap_or(item.contact_stiffness_n_m2),
            jaws,
            kinetic,
        });
    }

    /// The motion plugin of an id; one that is not there is reported.
    fn motion(&self, id: &At<String>) -> Option<Arc<dyn WhaleMotion>> {
        let motion = self.hooks.motion(&id.value);
        if motion.is_none() {
            let ids = self.hooks.ids();
            let message = format!("no whale motion `{}` among the plugins", id.value);
            let help = hint(&id.value, ids.iter().map(String::as_str));
            self.problems.push(id.place.error(message, help));
        }
        motion
    }

    /// The whale's length: its own, by its age, or that of the file.
    fn length(&self, placed: &PlacedWhale, item: &WhaleItem) -> Option<f64> {
        if item.mesh.is_some() && (placed.pregnant || (placed.condition - 1.0).abs() > 0.0) {
            let help =
                "leave out `condition` and `pregnant`, or take the mesh out of the whale's file";
            self.problems.push(placed.item.place.error(
                format!("{} brings its own mesh, whose girth does not change", item.entry.path),
                help,
            ));
        }
        let Some(age) = &placed.age_s else {
            return Some(placed.length_m.unwrap_or(item.form.length_m));
        };
        let law = item.growth.age;
        if law.is_none() {
            let help = "write `length` instead, or the table [age] with `birth`, `one_year` and `tenfold` in the whale's file";
            self.problems.push(age.place.error(
                format!("{} does not say how long a whale of some age is", item.entry.path),
                help,
            ));
        }
        law.map(|law| law.length_m(age.value))
    }
}

/// Heading by compass, then nose up, then roll to starboard.
fn orientation(placed: &PlacedWhale) -> DQuat {
    DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2 - placed.heading_rad)
        * DQuat::from_rotation_y(-placed.pitch_rad)
        * DQuat::from_rotation_x(placed.roll_rad)
}

/// What makes the whale kinetic, at its length [m] in water of a density [kg/m³], alive or dead.
fn kinetic_whale(
    placed: &PlacedWhale,
    item: &WhaleItem,
    skin: &Skin,
    [length_m, density_kg_m3]: [f64; 2],
) -> Option<Kinetic> {
    let alive = item.kinetic(length_m, skin, density_kg_m3, placed.effort)?;
    if placed.dead { item.dead(skin, alive, density_kg_m3) } else { Some(alive) }
}

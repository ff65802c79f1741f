//! The laws of friction on the whale, by rope and region.
//!
//! The model of a rope and region is that of the last `[[friction.on]]` that includes the region, else that of `[friction]`.
//! Attributes of the scenario override those of the rope's material, which override the defaults of the model.

use endline_sdk::Region;
use endline_sim::model::{BODY_ON_SKIN_FRICTION, Friction, FrictionLaw};

use crate::assembly::Attributes;
use crate::diagnostic::{At, hint};
use crate::items::{RopeFriction, any_holds};
use crate::scenario::FrictionChoice;
use crate::schema::Kind;

use super::attributes::numbers;
use super::builder::Builder;

/// Id of the friction file of traps, buoys and anchors.
const BODIES: &str = "bodies";

impl Builder<'_> {
    /// Adds friction on the whale: laws and coefficients by rope and region.
    pub fn add_friction(&mut self) {
        if self.scenario.whale.is_none() {
            return;
        }
        let Some(choice) = &self.scenario.friction else {
            let message = "the scenario has a whale, but no `friction`";
            let help = "write [friction] with model = \"org.endline.friction.coulomb\"";
            self.problems.push(self.scenario.place.error(message, help));
            return;
        };
        if !self.all_models_are_there(choice) {
            return;
        }
        let mut friction = Friction {
            laws: Vec::new(),
            law_of: Vec::new(),
            coefficients: Vec::new(),
            law_of_bodies: [0; Region::ALL.len()],
            coefficients_of_bodies: [BODY_ON_SKIN_FRICTION; Region::ALL.len()],
        };
        for material in self.materials.clone() {
            match self.library.frictions.iter().find(|friction| friction.entry.id == material.value)
            {
                Some(file) => {
                    self.uses(&file.entry.path);
                    friction.coefficients.push(file.coefficients);
                    let laws = Region::ALL
                        .map(|region| self.law(choice, file, region, &mut friction.laws));
                    friction.law_of.push(laws);
                }
                None => self.no_item(Kind::Friction, &material.value, &material.place),
            }
        }
        self.add_friction_of_bodies(choice, &mut friction);
        if friction.laws.is_empty() {
            // Without rope or bodies the model still needs its plugin.
            let attributes = Attributes::default().over(&choice.attributes);
            friction.laws.extend(self.resolved(&choice.model.value, &attributes));
        }
        self.spec.friction = Some(friction);
    }

    /// Adds friction of bodies on the whale if the library has their figures.
    fn add_friction_of_bodies(&mut self, choice: &FrictionChoice, friction: &mut Friction) {
        let files = &self.library.frictions;
        let Some(file) = files.iter().find(|file| file.entry.id == BODIES) else { return };
        if self.spec.bodies.is_empty() {
            return;
        }
        self.uses(&file.entry.path);
        friction.coefficients_of_bodies = file.coefficients;
        friction.law_of_bodies =
            Region::ALL.map(|region| self.law(choice, file, region, &mut friction.laws));
    }

    fn all_models_are_there(&self, choice: &FrictionChoice) -> bool {
        let mut all = true;
        for model in std::iter::once(&choice.model).chain(choice.on.iter().map(|on| &on.model)) {
            if self.hooks.friction(&model.value).is_none() {
                let mut ids = self.hooks.ids();
                ids.retain(|id| self.hooks.friction(id).is_some());
                let message =
                    format!("there is no plugin with the friction model `{}`", model.value);
                self.problems.push(
                    model.place.error(message, hint(&model.value, ids.iter().map(String::as_str))),
                );
                all = false;
            }
        }
        all
    }

    /// Index of the law of a material on a region; a new law is added.
    fn law(
        &mut self,
        choice: &FrictionChoice,
        file: &RopeFriction,
        region: Region,
        laws: &mut Vec<FrictionLaw>,
    ) -> usize {
        let on = choice.on.iter().rev().find(|on| any_holds(&on.surfaces, region));
        let (model, over): (&At<String>, &Attributes) =
            on.map_or((&choice.model, &choice.attributes), |on| (&on.model, &on.attributes));
        let attributes = over.over(&file.attributes(&model.value, region));
        let Some(law) = self.resolved(&model.value, &attributes) else { return 0 };
        let is_equal = |known: &FrictionLaw| {
            known.model.descriptor().id == law.model.descriptor().id
                && known.attributes == law.attributes
        };
        laws.iter().position(is_equal).unwrap_or_else(|| {
            laws.push(law);
            laws.len() - 1
        })
    }

    fn resolved(&mut self, model: &str, attributes: &Attributes) -> Option<FrictionLaw> {
        let model = self.hooks.friction(model)?;
        let values =
            attributes.resolve(model.descriptor(), self.library, &mut self.used, &self.problems);
        Some(FrictionLaw { attributes: numbers(&values), model })
    }
}

//! Friction of a rope material on a whale: a coefficient for each surface, and figures for the models of friction.

use endline_sdk::Region;

use crate::attributes::Attributes;
use crate::diagnostic::At;
use crate::entry::{self, Entry};
use crate::fields::{Fields, Problems, Provenance, sourced};
use crate::items::surface::{self, surface_of};
use crate::schema::Kind;
use crate::tree::Node;

/// Coefficients of friction of one rope material on the whale's surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct RopeFriction {
    /// Its file; the id is the material.
    pub entry: Entry,
    /// Coefficient by region number.
    pub coefficients: [f64; Region::ALL.len()],
    /// Attributes of models of friction for this material, in the order of the file.
    pub models: Vec<ModelFigures>,
}

/// Attributes of a model of friction for a rope material on some surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelFigures {
    /// Id of the model.
    pub model: At<String>,
    /// Surfaces it holds for; every one where empty.
    pub surfaces: Vec<At<String>>,
    /// Values; each has a source and a confidence in its file.
    pub(crate) attributes: Attributes,
}

impl RopeFriction {
    /// From a file; `None` where a figure is missing, which is reported.
    pub(crate) fn read(node: &Node, id: &str, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let head = entry::header(&fields, Kind::Friction.word(), problems);
        let file = head.2.clone();
        let entry = entry::body(&fields, Kind::Friction, head, id);
        let models = fields
            .tables("model")
            .iter()
            .filter_map(|node| model_figures(node, &file, problems))
            .collect();
        fields.finish();
        let mut coefficients = [0.0; Region::ALL.len()];
        for (place, region) in coefficients.iter_mut().zip(Region::ALL) {
            *place = entry.value(surface_of(region))?;
        }
        Some(Self { entry, coefficients, models })
    }

    /// What the file says of a model's attributes on a region; of two entries the later counts.
    pub(crate) fn attributes(&self, model: &str, region: Region) -> Attributes {
        let holds = |figures: &&ModelFigures| {
            figures.model.value == model && surface::any_holds(&figures.surfaces, region)
        };
        self.models
            .iter()
            .filter(holds)
            .fold(Attributes::default(), |earlier, later| later.attributes.over(&earlier))
    }
}

/// A table of `[[model]]`.
fn model_figures(node: &Node, file: &Provenance, problems: &Problems) -> Option<ModelFigures> {
    let fields = Fields::of(node, problems);
    let model = fields.need_text(
        "id",
        "write the id of a friction model, such as \"org.endline.friction.baleen\"",
    );
    let surfaces = surface::read(&fields, "surfaces");
    let attributes = fields.rest().into_iter().filter_map(|(key, place, node)| {
        Some((key.clone(), place.clone(), sourced(node, file, problems)?))
    });
    let attributes = Attributes(attributes.collect());
    fields.finish();
    Some(ModelFigures { model: model?, surfaces, attributes })
}

//! Friction of a rope material on a whale: coefficients by surface, attributes of friction models, names of surfaces.

use endline_sdk::{Limb, Region};

use crate::assembly::Attributes;
use crate::diagnostic::{At, hint};
use crate::entry::{self, Entry};
use crate::fields::{Fields, Problems, Provenance, sourced};
use crate::schema::Kind;
use crate::tree::{Content, Node};

/// Friction coefficients of a rope material on the surfaces of a whale.
#[derive(Clone, Debug, PartialEq)]
pub struct RopeFriction {
    /// Its file; the id is the material.
    pub entry: Entry,
    /// Coefficient by region number.
    pub coefficients: [f64; Region::ALL.len()],
    /// Attributes of friction models for this material, in the order of the file.
    pub models: Vec<ModelFigures>,
}

/// Attributes of a friction model for a rope material on some surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelFigures {
    /// Id of the model.
    pub model: At<String>,
    /// Surfaces to which they apply; empty for all.
    pub surfaces: Vec<At<String>>,
    /// Values; each has a source and a confidence in its file.
    pub(crate) attributes: Attributes,
}

impl RopeFriction {
    /// Reads a file; `None` if a figure is missing, which is reported.
    pub(crate) fn read(node: &Node, id: &str, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let head = entry::header(&fields, Kind::Friction.word(), problems);
        let file = head.2.clone();
        let entry = entry::body(&fields, Kind::Friction, head, id);
        let models = fields.each("model", |table| model_figures(table, &file));
        fields.finish();
        let mut coefficients = [0.0; Region::ALL.len()];
        for (place, region) in coefficients.iter_mut().zip(Region::ALL) {
            *place = entry.value(surface_of(region))?;
        }
        Some(Self { entry, coefficients, models })
    }

    /// Attributes of a model on a region; a later entry overrides an earlier one.
    pub(crate) fn attributes(&self, model: &str, region: Region) -> Attributes {
        let holds = |figures: &&ModelFigures| {
            figures.model.value == model && any_holds(&figures.surfaces, region)
        };
        self.models
            .iter()
            .filter(holds)
            .fold(Attributes::default(), |earlier, later| later.attributes.over(&earlier))
    }
}

/// A table of `[[model]]`.
fn model_figures(fields: &Fields<'_>, file: &Provenance) -> Option<ModelFigures> {
    let model = fields.need_text(
        "id",
        "write the id of a friction model, such as \"org.endline.friction.baleen\"",
    );
    let surfaces = read_surfaces(fields, "surfaces");
    let attributes = fields.rest().into_iter().filter_map(|(key, place, node)| {
        Some((key.clone(), place.clone(), sourced(node, file, fields.problems())?))
    });
    let attributes = Attributes(attributes.collect());
    Some(ModelFigures { model: model?, surfaces, attributes })
}

/// Names of surfaces in files: single surfaces from the head aft, then groups.
pub const SURFACES: [&str; 10] = [
    "rostrum", "baleen", "lips", "head", "body", "peduncle", "flippers", "flukes", "edges", "skin",
];

/// The surface whose coefficient applies to a region.
pub(crate) fn surface_of(region: Region) -> &'static str {
    match region {
        Region::Rostrum => "rostrum",
        Region::Baleen => "baleen",
        Region::Lips => "lips",
        Region::Head => "head",
        _ => "skin",
    }
}

/// Whether one of the words includes a region; an empty list includes all.
pub(crate) fn any_holds(words: &[At<String>], region: Region) -> bool {
    words.is_empty() || words.iter().any(|word| holds(&word.value, region))
}

/// Whether a word includes a region.
fn holds(word: &str, region: Region) -> bool {
    match word {
        "body" => region == Region::Body,
        "peduncle" => region == Region::Peduncle,
        "flippers" => region.part().limb() == Limb::Flipper,
        "flukes" => region.part().limb() == Limb::Fluke,
        "edges" => region.is_edge(),
        of => surface_of(region) == of,
    }
}

/// Reads a list of surfaces; unknown ones are reported.
pub(crate) fn read_surfaces<'a>(fields: &Fields<'a>, key: &'a str) -> Vec<At<String>> {
    let Some(node) = fields.get(key) else { return Vec::new() };
    let Content::List(items) = &node.content else {
        let message = format!("`{key}` is {}, not a list of surfaces", node.content.noun());
        fields
            .problems()
            .push(node.place.error(message, "write a list such as [\"baleen\", \"lips\"]"));
        return Vec::new();
    };
    if items.is_empty() {
        fields.problems().push(node.place.error(
            format!("`{key}` is empty"),
            "write a surface such as \"baleen\", or leave it out",
        ));
    }
    let mut words = Vec::new();
    for item in items {
        match &item.content {
            Content::Text(word) if SURFACES.contains(&word.as_str()) => {
                words.push(At { value: word.clone(), place: item.place.clone() })
            }
            Content::Text(word) => fields.problems().push(
                item.place
                    .error(format!("`{word}` is not a surface of a whale"), hint(word, SURFACES)),
            ),
            other => {
                let message = format!("a surface is {}, not a text", other.noun());
                fields.problems().push(item.place.error(message, hint("", SURFACES)));
            }
        }
    }
    words
}

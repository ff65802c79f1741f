//! `[friction]`: which law holds between rope and whale, and where another does.

use crate::attributes::Attributes;
use crate::diagnostic::At;
use crate::fields::{Fields, Problems};
use crate::items::read_surfaces;
use crate::tree::Node;

/// A friction model with its attributes, and others for some surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionChoice {
    /// Id of the plugin.
    pub model: At<String>,
    /// Its attributes, over what the files of rope materials say of them.
    pub attributes: Attributes,
    /// Models of their own for some surfaces; where two name a surface, the later counts.
    pub on: Vec<FrictionOn>,
}

/// A friction model for some surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionOn {
    /// Its surfaces, such as `baleen`; at least one.
    pub surfaces: Vec<At<String>>,
    /// Id of the plugin.
    pub model: At<String>,
    /// Its attributes.
    pub attributes: Attributes,
}

/// Reads the table `[friction]`.
pub(super) fn read(fields: &Fields<'_>) -> Option<FrictionChoice> {
    let model = fields.need_text(
        "model",
        "write the id of a friction model, such as \"org.endline.friction.coulomb\"",
    );
    let attributes = Attributes::read(fields, "attributes");
    let on = fields
        .tables("on")
        .iter()
        .filter_map(|node| friction_on(node, fields.problems()))
        .collect();
    fields.finish();
    Some(FrictionChoice { model: model?, attributes, on })
}

/// `[[friction.on]]`: a model for some surfaces.
fn friction_on(node: &Node, problems: &Problems) -> Option<FrictionOn> {
    let fields = Fields::of(node, problems);
    if fields.get("surfaces").is_none() {
        fields.missing("surfaces", "write the surfaces this model is for, such as [\"baleen\"]");
    }
    let surfaces = read_surfaces(&fields, "surfaces");
    let model = fields.need_text(
        "model",
        "write the id of a friction model, such as \"org.endline.friction.baleen\"",
    );
    let attributes = Attributes::read(&fields, "attributes");
    fields.finish();
    (!surfaces.is_empty()).then_some(FrictionOn { surfaces, model: model?, attributes })
}

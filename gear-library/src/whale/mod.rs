//! The parametric whale: a table of body sections and a few fin measures in, a skinned mesh out.

pub mod body;
pub mod bones;
pub mod curve;
pub mod fins;
pub mod form;
pub mod gltf;
pub mod part;
pub mod section;

use endline_sim::whale::Skin;

pub use form::{FlipperForm, FlukesForm, HeadForm, Station, WhaleForm};

/// The skinned mesh of a whale: body, two flippers and the flukes, closed pieces that overlap where they join.
///
/// The whale's frame has its origin in mid-body at the height of the snout's tip, x to the snout, y to
/// port, z to the back. The same form gives the same skin, bit for bit.
#[must_use]
pub fn build_skin(form: &WhaleForm) -> Skin {
    let sections = section::Sections::of(form);
    let skeleton = bones::Skeleton::of(form, &sections);
    let left = fins::left_flipper(form, &sections, &skeleton);
    let right = left.mirrored(|bone| skeleton.other_side(bone), fins::other_side);
    let parts = [body::body(form, &sections, &skeleton), left, right, fins::flukes(form, &sections, &skeleton)];
    part::join(&parts, skeleton.bones)
}

/// A skin made larger or smaller about the whale's origin, bones and all.
#[must_use]
pub fn scaled(skin: &Skin, factor: f64) -> Skin {
    let mut skin = skin.clone();
    skin.vertices.iter_mut().for_each(|place| *place *= factor);
    skin.bones.iter_mut().for_each(|bone| bone.origin *= factor);
    skin
}

#[cfg(test)]
mod tests;

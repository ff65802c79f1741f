//! The parametric whale: a table of body sections and a few fin measures in, one closed skinned mesh out.

pub mod bones;
pub mod curve;
pub mod edges;
pub mod fin;
pub mod fit;
pub mod flipper;
pub mod flukes;
pub mod form;
pub mod gltf;
pub mod head;
pub mod jaws;
pub mod kept;
pub mod layout;
pub mod marks;
pub mod mesh;
mod right_whale;
pub mod section;
pub mod trunk;
pub mod weights;

use endline_sim::whale::Skin;

pub use form::{FlipperForm, FlukesForm, HeadForm, Station, WhaleForm};
pub use kept::skin_of;

/// What the parts of a skin are built with and into.
pub struct Builder<'a> {
    /// The measures.
    pub form: &'a WhaleForm,
    /// The body's sections.
    pub sections: section::Sections,
    /// The bones.
    pub skeleton: bones::Skeleton,
    /// Rows and columns of the trunk.
    pub layout: layout::Layout,
    /// Callosities and colour.
    pub marks: marks::Marks,
    /// The port half so far.
    pub half: mesh::Half,
}

/// The skin of a whale: one closed surface, in which flippers and flukes grow out of the body and the mouth is a pocket.
///
/// The whale's frame has its origin in mid-body at the height of the snout's tip, x to the snout, y to
/// port, z to the back. Equal forms give equal skins, bit for bit.
#[must_use]
pub fn build_skin(form: &WhaleForm) -> Skin {
    let sections = section::Sections::of(form);
    let skeleton = bones::Skeleton::of(form, &sections);
    let layout = layout::Layout::of(form, &sections);
    let mut build = Builder {
        form,
        sections,
        skeleton,
        layout,
        marks: marks::Marks::of(form),
        half: mesh::Half::default(),
    };
    let trunk = trunk::add(&mut build);
    head::add(&mut build, &trunk.front);
    flipper::add(&mut build, &trunk.hole);
    flukes::add(&mut build, &trunk.back);
    build.half.whole(build.skeleton)
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

//! The parametric whale: builds one closed skinned mesh from a table of body sections and fin measures.
//!
//! Skins and volumes are cached by form: a fit to a mass builds five skins, and options of a study, scenarios of a check
//! and files of a library use the same few whales. A skin is a function of its form, so a cached result is bit-equal to a
//! new one. A full cache drops its oldest entry.

pub mod bones;
pub mod fin;
pub mod flipper;
pub mod flukes;
pub mod form;
pub mod gltf;
pub mod head;
pub mod mesh;
#[cfg(test)]
mod tests;
pub mod trunk;

use std::sync::{Arc, Mutex, PoisonError};

use endline_sim::whale::{Measures, Skin};

pub use form::{FlipperForm, FlukesForm, HeadForm, Station, WhaleForm};

/// The inputs and the result of building a skin.
pub struct Builder<'a> {
    /// The measures.
    pub form: &'a WhaleForm,
    /// The body's sections.
    pub sections: trunk::Sections,
    /// The bones.
    pub skeleton: bones::Skeleton,
    /// Rows and columns of the trunk.
    pub layout: trunk::Layout,
    /// Callosities and colour.
    pub marks: mesh::Marks,
    /// The port half so far.
    pub half: mesh::Half,
}

/// The skin of a whale: one closed surface, in which flippers and flukes grow out of the body and the mouth is a pocket.
///
/// The whale's frame has its origin in mid-body at the height of the snout's tip, x to the snout, y to
/// port, z to the back. Equal forms give equal skins, bit for bit.
pub fn build_skin(form: &WhaleForm) -> Skin {
    let sections = trunk::Sections::of(form);
    let skeleton = bones::Skeleton::of(form, &sections);
    let layout = trunk::Layout::of(form, &sections);
    let mut build = Builder {
        form,
        sections,
        skeleton,
        layout,
        marks: mesh::Marks::of(form),
        half: mesh::Half::default(),
    };
    let trunk = trunk::add(&mut build);
    head::add(&mut build, &trunk.front);
    flipper::add(&mut build, &trunk.hole);
    flukes::add(&mut build, &trunk.back);
    build.half.whole(build.skeleton)
}

/// A skin and its bones, scaled about the whale's origin.
pub fn scaled(skin: &Skin, factor: f64) -> Skin {
    let mut skin = skin.clone();
    skin.vertices.iter_mut().for_each(|place| *place *= factor);
    skin.bones.iter_mut().for_each(|bone| bone.origin *= factor);
    skin
}

/// Number of cached skins: the whales of some ten threads, about a megabyte each.
const SKINS: usize = 16;
/// Number of cached volumes: a fit to a mass uses five, and five more in another than average condition.
const VOLUMES: usize = 256;

static SKIN_CACHE: Cache<Arc<Skin>> = Cache::new();
static VOLUME_CACHE: Cache<f64> = Cache::new();

/// The cached skin of a form.
pub fn skin_of(form: &WhaleForm) -> Arc<Skin> {
    SKIN_CACHE.get(form, SKINS, || Arc::new(build_skin(form)))
}

/// Cached volume of a form's closed skin [m³].
pub fn volume_of(form: &WhaleForm) -> f64 {
    VOLUME_CACHE.get(form, VOLUMES, || Measures::of(&build_skin(form), 1.0).volume_m3)
}

/// Results by form, the latest last.
struct Cache<T>(Mutex<Vec<(WhaleForm, T)>>);

impl<T: Clone> Cache<T> {
    const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// The result of a form, computed without the lock if it is not cached.
    fn get(&self, form: &WhaleForm, most: usize, compute: impl FnOnce() -> T) -> T {
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, cached)) = lock().iter().find(|(known, _)| known == form) {
            return cached.clone();
        }
        let fresh = compute();
        let mut cached = lock();
        if cached.len() >= most {
            cached.remove(0);
        }
        cached.push((form.clone(), fresh.clone()));
        fresh
    }
}

//! An act as a glTF animation: `animation = "my-act.glb"` in its file, beside it in `acts/`.

use crate::confidence::Confidence;
use crate::diagnostic::At;
use crate::fields::{Fields, Provenance};
use crate::whale::gltf;

/// Where an act's keys are, in the place of `[[key]]`.
#[derive(Clone, Debug, PartialEq)]
pub struct ActAnimation {
    /// Path of the file, relative to the library's folder.
    pub file: At<String>,
    /// Name of the animation in it; the only one where none is given.
    pub clip: Option<At<String>>,
    /// Where its angles come from.
    pub(super) source: Option<String>,
    /// How well its angles are known.
    pub(super) confidence: Option<Confidence>,
}

impl ActAnimation {
    /// Reads the keys `animation` and `clip`.
    pub(super) fn read(fields: &Fields<'_>, file: &Provenance) -> Option<Self> {
        let clip = fields.text("clip");
        let name = fields.text("animation")?;
        if name.value.contains(['/', '\\']) || gltf::Form::of_file(&name.value).is_none() {
            let message = format!("`{}` is no name of an animation", name.value);
            fields.problems().push(name.place.error(
                message,
                "write the name of a .glb or .gltf file that lies beside this one",
            ));
            return None;
        }
        if let Some(key) = fields.get("key") {
            fields.problems().push(
                key.place.error("both `animation` and [[key]] are given", "leave one of them out"),
            );
        }
        let folder = name.place.source.path.rsplit_once('/').map_or("acts", |(folder, _)| folder);
        Some(Self {
            file: At { value: format!("{folder}/{}", name.value), place: name.place.clone() },
            clip,
            source: file.source.clone(),
            confidence: file.confidence,
        })
    }
}

//! A whale's own mesh: `mesh = "my-whale.glb"` in its file, beside it in `whales/`.

use std::sync::Arc;

use endline_sim::whale::Skin;

use crate::diagnostic::At;
use crate::fields::Fields;
use crate::whale::gltf;

/// A whale's own mesh, in place of the one made from its measures.
#[derive(Clone, Debug, PartialEq)]
pub struct WhaleMesh {
    /// Path of its file, relative to the library's folder.
    pub file: At<String>,
    /// Its skin at the whale's own length; none until the library has read the file.
    pub skin: Option<Arc<Skin>>,
}

impl WhaleMesh {
    /// Reads the key `mesh`.
    pub(super) fn read(fields: &Fields<'_>) -> Option<Self> {
        let name = fields.text("mesh")?;
        if name.value.contains(['/', '\\']) || gltf::Form::of_file(&name.value).is_none() {
            let message = format!("`{}` is no name of a mesh", name.value);
            fields.problems().push(name.place.error(
                message,
                "write the name of a .glb or .gltf file that lies beside this one",
            ));
            return None;
        }
        let folder = name.place.source.path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let folder = folder.rsplit('/').next().unwrap_or_default();
        Some(Self {
            file: At { value: format!("{folder}/{}", name.value), place: name.place },
            skin: None,
        })
    }
}

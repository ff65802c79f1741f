//! The skin of a whale of the library: its own mesh, or one made from its measures.

use std::sync::Arc;

use endline_sim::whale::Skin;

use crate::fields::Problems;
use crate::nearest::hint;
use crate::sources::Sources;
use crate::whale::{gltf, scaled, skin_of};

use super::WhaleItem;

impl WhaleItem {
    /// Its skin at a length [m]: its own mesh where its file names one, else made from its measures.
    #[must_use]
    pub fn skin_at(&self, length_m: f64) -> Skin {
        Arc::unwrap_or_clone(self.skin_for(length_m, 1.0, false))
    }

    /// Its skin at a length [m], in a condition (volume over that of middling condition) and late in pregnancy;
    /// a mesh of its own takes its length alone.
    #[must_use]
    pub fn skin_for(&self, length_m: f64, condition: f64, pregnant: bool) -> Arc<Skin> {
        if let Some(skin) = self.mesh.as_ref().and_then(|mesh| mesh.skin.as_deref()) {
            return Arc::new(scaled(skin, length_m / self.form.length_m));
        }
        let form = self.form_at(length_m).in_condition(condition);
        skin_of(&if pregnant { form.pregnant() } else { form })
    }

    /// Reads its mesh, where it has one; false where that fails, with every problem reported.
    pub(crate) fn load_mesh(&mut self, sources: &Sources, problems: &Problems) -> bool {
        let Some(mesh) = &mut self.mesh else { return true };
        let (path, place) = (&mesh.file.value, &mesh.file.place);
        let Some(bytes) = sources.mesh(path) else {
            problems.push(place.error(
                format!("there is no file `{path}`"),
                hint(path, sources.meshes().map(|(path, _)| path)),
            ));
            return false;
        };
        match gltf::read(bytes, &skin_of(&self.form)) {
            Ok(skin) => mesh.skin = Some(Arc::new(skin)),
            Err(faults) => problems.extend(
                faults
                    .into_iter()
                    .map(|fault| place.error(format!("`{path}` {}", fault.message), fault.help)),
            ),
        }
        mesh.skin.is_some()
    }
}

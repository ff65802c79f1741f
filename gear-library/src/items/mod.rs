//! Items of the library.

mod act;
mod body;
mod channel;
mod friction;
mod joints;
mod rope;
mod site;
mod whale;

use crate::diagnostic::At;
use crate::fields::Fields;
use crate::whale::gltf::Form;

pub use act::{ActAnimation, ActItem};
pub use body::{BoxGear, Buoy, BuoyPiece, BuoyShape, Point};
pub(crate) use body::{pieces, points};
pub use channel::{CHANNELS, Channel};
pub use friction::{ModelFigures, RopeFriction, SURFACES};
pub(crate) use friction::{any_holds, read_surfaces};
pub use joints::Joints;
pub(crate) use rope::USUAL_BULK;
pub use rope::{Condition, Knot, Rope, WeakLink};
pub use site::SeaSite;
pub(crate) use whale::YEAR_S;
pub use whale::{AgeLaw, Growth, MassLaw, WhaleItem, WhaleMesh};

/// Path of a glTF file that a key names, beside the file itself; another name is reported.
fn gltf_beside(fields: &Fields<'_>, key: &'static str) -> Option<At<String>> {
    let name = fields.text(key)?;
    if name.value.contains(['/', '\\']) || Form::of_file(&name.value).is_none() {
        let message = format!("`{}` is not the name of a glTF file", name.value);
        let help = "write the name of a .glb or .gltf file beside this one";
        return fields.refuse(name.place.error(message, help));
    }
    let folder = name.place.source.path.rsplit('/').nth(1).unwrap_or_default();
    Some(At { value: format!("{folder}/{}", name.value), place: name.place })
}

//! Whether a skin read from a file can stand in a whale's place: closed, right way out, of the whale's size and place.

use std::collections::BTreeMap;

use endline_sim::whale::{Bounds, Skin};

use super::Fault;
use super::corners::shown;

/// How far a skin's length and place may differ from those of the whale's own measures, as a share of length.
const ROOM: f64 = 0.1;

/// Every fault of the whole skin.
pub(super) fn whole(skin: &Skin, like: &Skin) -> Result<(), Vec<Fault>> {
    let faults: Vec<Fault> =
        [scale(skin, like), closed(skin), outside_out(skin)].into_iter().flatten().collect();
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

/// The skin is as long as the whale, and lies where it should.
fn scale(skin: &Skin, like: &Skin) -> Option<Fault> {
    let [own, wanted] = [skin, like].map(|skin| Bounds::around(&skin.vertices));
    let [long, want] = [own, wanted].map(|bounds| bounds.high.x - bounds.low.x);
    let ratio = long / want;
    if !(ratio - 1.0).abs().is_finite() || (ratio - 1.0).abs() > ROOM {
        let help = "a file is in metres with the whale at its own `length`; in Blender, apply the scale (Ctrl+A) of mesh and armature";
        return Some(Fault::new(
            format!("is {long:.3} m long from snout to fluke tips, {want:.2} m was expected"),
            help,
        ));
    }
    let off = (own.low + own.high - wanted.low - wanted.high) / 2.0;
    (off.length() > ROOM * want).then(|| {
        let help = "the snout lies ahead along +x and the back is up; the origin is in mid-body at the height of the snout's tip";
        Fault::new(format!("lies {:.2} m from where the whale lies, or is turned", off.length()), help)
    })
}

/// Every edge has two triangles, which run along it in opposite directions.
pub(super) fn closed(skin: &Skin) -> Option<Fault> {
    let mut edges: BTreeMap<(u32, u32), (u32, usize)> = BTreeMap::new();
    for (triangle, &[a, b, c]) in skin.triangles.iter().enumerate() {
        for edge in [(a, b), (b, c), (c, a)] {
            edges.entry(edge).or_insert((0, triangle)).0 += 1;
        }
    }
    let bad = |&(&(from, to), &(count, _)): &(&(u32, u32), &(u32, usize))| {
        count > 1 || !edges.contains_key(&(to, from))
    };
    let open: Vec<_> = edges.iter().filter(bad).collect();
    let &(&(from, _), &(_, triangle)) = open.first()?;
    let message = format!(
        "is not closed: {} edges have no triangle or too many beside them, one at {} in the region `{}`",
        open.len(),
        shown(skin.vertices[from as usize]),
        skin.regions[triangle].name(),
    );
    Some(Fault::new(
        message,
        "in Blender, Mesh > Merge > By Distance, then Clean Up > Fill Holes; Select > All by Trait > Non Manifold shows where",
    ))
}

/// The volume inside is above zero.
fn outside_out(skin: &Skin) -> Option<Fault> {
    let corner = |index: u32| skin.vertices[index as usize];
    let volume: f64 = skin
        .triangles
        .iter()
        .map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0)
        .sum();
    let help = "in Blender, Mesh > Normals > Recalculate Outside";
    (volume <= 0.0).then(|| Fault::new("has no skin, or its skin faces inward", help))
}

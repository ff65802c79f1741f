//! Whether a skin read from a file can stand in a whale's place: closed, right way out, of the whale's size and place.

use std::collections::BTreeMap;

use endline_sdk::Region;
use endline_sim::whale::{Bounds, Skin};
use glam::DVec3;

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
    if off.length() > ROOM * want {
        return Some(Fault::new(
            format!("lies {:.2} m from where the whale lies, or is turned", off.length()),
            LIES,
        ));
    }
    let (part, off) = farthest(skin, like)?;
    (off > ROOM * want).then(|| {
        Fault::new(format!("is turned: {part} lies {off:.2} m from where the whale has it"), LIES)
    })
}

/// How a whale lies in a file.
const LIES: &str = "the snout lies ahead along +x and the back is up; the origin is in mid-body at the height of the snout's tip; in Blender, see that the whale lies so, then apply the rotation (Ctrl+A) of mesh and armature";

/// The region or bone that lies farthest from where the whale has it, and how far [m].
fn farthest(skin: &Skin, like: &Skin) -> Option<(String, f64)> {
    let region = |region: Region| {
        let off = centre(skin, region)?.distance(centre(like, region)?);
        Some((format!("the region `{}`", region.name()), off))
    };
    let bones = skin.bones.iter().zip(&like.bones);
    let bones = bones
        .map(|(own, like)| (format!("the bone `{}`", own.name), own.origin.distance(like.origin)));
    let all = Region::ALL.into_iter().filter_map(region).chain(bones);
    all.max_by(|one, other| one.1.total_cmp(&other.1))
}

/// Centre of a region's skin [m]; `None` where it has none.
fn centre(skin: &Skin, region: Region) -> Option<DVec3> {
    let own = skin.triangles.iter().zip(&skin.regions).filter(|(_, own)| **own == region);
    let (moment, area) = own.fold((DVec3::ZERO, 0.0), |(moment, area), (triangle, _)| {
        let [a, b, c] = triangle.map(|corner| skin.vertices[corner as usize]);
        let own = (b - a).cross(c - a).length();
        (moment + own * (a + b + c) / 3.0, area + own)
    });
    (area > 0.0).then(|| moment / area)
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

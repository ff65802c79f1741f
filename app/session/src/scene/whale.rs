//! The whale's skin in a frame: the same vertices that collide.

use endline_sim::whale::{Mark, Skin, pose, skin_all};
use endline_sim::{Frame, Model};
use glam::Vec3;

use super::colour::{BALEEN, CALLOSITY, EYE, MOUTH, SKIN, WHITE, faded};
use super::mesh::{Colour, Mesh, single};

/// The skin in its pose, smooth-shaded and tinted as it is marked.
pub fn skin(model: &Model, frame: &Frame) -> Mesh {
    let (Some(whale), Some(at)) = (&model.spec.whale, &frame.whale) else { return Mesh::default() };
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(&whale.skin, at.position, at.orientation, &at.posture, &mut bones);
    skin_all(&whale.skin, &bones, &mut places);
    let place: Vec<Vec3> = places.into_iter().map(single).collect();
    let normal = smooth_normals(&place, &whale.skin.triangles);
    let grain = whale.skin.vertices.iter().copied().map(single).collect();
    Mesh {
        radius_m: vec![0.0; place.len()],
        colour: tints(&whale.skin),
        triangles: whale.skin.triangles.clone(),
        place,
        normal,
        grain,
    }
}

/// Normals at vertices: the mean of the triangles round each, weighted by area.
fn smooth_normals(place: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut normal = vec![Vec3::ZERO; place.len()];
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| corner as usize);
        let area = (place[b] - place[a]).cross(place[c] - place[a]);
        for corner in [a, b, c] {
            normal[corner] += area;
        }
    }
    normal.into_iter().map(Vec3::normalize_or_zero).collect()
}

/// A tint for each vertex from what the skin looks like there; its opacity stands for smoothness (see `part.frag`).
fn tints(skin: &Skin) -> Vec<Colour> {
    let marked = skin.marks.iter().copied().chain(std::iter::repeat(Mark::Skin));
    marked.take(skin.vertices.len()).map(tint).collect()
}

fn tint(mark: Mark) -> Colour {
    match mark {
        Mark::Skin => SKIN,
        Mark::Callosity => faded(CALLOSITY, 0.0),
        Mark::Baleen => faded(BALEEN, 0.5),
        Mark::Mouth => faded(MOUTH, 0.8),
        Mark::White => WHITE,
        Mark::Eye => EYE,
    }
}

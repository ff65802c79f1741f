//! The whale's skin in a frame: the same vertices that collide.

use endline_sim::whale::{Mark, Skin, pose, skin_all};
use endline_sim::{Frame, Model};
use glam::Vec3;

use super::colour::{BALEEN, CALLOSITY, EYE, LID, MOUTH, SKIN, WHITE, faded};
use super::mesh::{Colour, Mesh, single};

/// Radius of an eye and how far its lid stands round it, in lengths of the whale.
const EYE_RADIUS: f32 = 0.0035;
const LID_RADIUS: f32 = 0.0055;

/// The skin in its pose, smooth-shaded and tinted as it is marked; and the eyes, which have no contact.
pub fn skin_and_eyes(model: &Model, frame: &Frame) -> [Mesh; 2] {
    let (Some(whale), Some(at)) = (&model.spec.whale, &frame.whale) else {
        return [Mesh::default(), Mesh::default()];
    };
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(&whale.skin, at.position, at.orientation, &at.posture, &mut bones);
    skin_all(&whale.skin, &bones, &mut places);
    let place: Vec<Vec3> = places.into_iter().map(single).collect();
    let normal = smooth_normals(&place, &whale.skin.triangles);
    let grain = whale.skin.vertices.iter().copied().map(single).collect();
    let eyes = eyes(&whale.skin, &place, &normal, whale.length_m as f32);
    let skin = Mesh {
        radius_m: vec![0.0; place.len()],
        colour: tints(&whale.skin),
        triangles: whale.skin.triangles.clone(),
        place,
        normal,
        grain,
    };
    [skin, eyes]
}

/// A dark ball in a paler lid in the middle of each side's skin that is marked as an eye.
fn eyes(skin: &Skin, place: &[Vec3], normal: &[Vec3], length_m: f32) -> Mesh {
    let mut mesh = Mesh::default();
    let marked = skin.marks.iter().take(place.len()).enumerate();
    let marked = marked.filter(|(_, mark)| **mark == Mark::Eye).map(|(vertex, _)| vertex);
    let sides: (Vec<usize>, Vec<usize>) = marked.partition(|vertex| skin.vertices[*vertex].y > 0.0);
    for own in [sides.0, sides.1].into_iter().filter(|own| !own.is_empty()) {
        let middle = own.iter().map(|vertex| place[*vertex]).sum::<Vec3>() / own.len() as f32;
        let out = own.iter().map(|vertex| normal[*vertex]).sum::<Vec3>().normalize_or_zero();
        // Of each ball, less than half stands out of the skin.
        for (radius, colour, sunk) in [(LID_RADIUS, LID, 0.75), (EYE_RADIUS, EYE, 0.15)] {
            let radius = radius * length_m;
            mesh.ball(middle - out * (sunk * radius), radius, colour, 8);
        }
    }
    mesh
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

/// A tint for each vertex from the skin's colour there; its opacity is the smoothness (see `part.frag`).
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
        Mark::Eye => SKIN,
    }
}

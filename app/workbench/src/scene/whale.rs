//! The whale's skin in a frame: the same vertices that collide.

use endline_sdk::Region;
use endline_sim::whale::{Skin, pose, skin_all};
use endline_sim::{Frame, Model};
use glam::Vec3;

use super::build::single;
use super::colour::{BALEEN, CALLOSITY, SKIN};
use super::mesh::{Colour, Mesh};

/// The skin in its pose, smooth-shaded and tinted by region.
pub fn skin(model: &Model, frame: &Frame) -> Mesh {
    let (Some(whale), Some(at)) = (&model.spec.whale, &frame.whale) else { return Mesh::default() };
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(&whale.skin, at.position, at.orientation, &at.posture, &mut bones);
    skin_all(&whale.skin, &bones, &mut places);
    let place: Vec<Vec3> = places.into_iter().map(single).collect();
    let normal = smooth_normals(&place, &whale.skin.triangles);
    Mesh { radius_m: vec![0.0; place.len()], colour: tints(&whale.skin), triangles: whale.skin.triangles.clone(), place, normal }
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

/// A tint for each vertex, from the regions of the triangles round it.
fn tints(skin: &Skin) -> Vec<Colour> {
    let mut colour = vec![SKIN; skin.vertices.len()];
    for (corners, region) in skin.triangles.iter().zip(&skin.regions) {
        for corner in corners {
            colour[*corner as usize] = tint(*region);
        }
    }
    colour
}

fn tint(region: Region) -> Colour {
    match region {
        Region::Rostrum => CALLOSITY,
        Region::Baleen => BALEEN,
        _ => SKIN,
    }
}

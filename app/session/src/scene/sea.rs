//! Sea surface, seabed and the arrows of the current.

use endline_sim::Model;
use glam::{DVec3, Vec3};

use super::Bounds;
use super::colour::{CURRENT, SEABED, SURFACE, faded};
use super::mesh::{Colour, Mesh, single};

/// How far sea and seabed reach past the gear, against the gear's own size.
const REACH: f64 = 12.0;
/// Least reach [m].
const LEAST_REACH_M: f64 = 400.0;
/// Arrows from seabed to surface.
const ARROWS: usize = 7;
/// Length of an arrow for each m/s of current [m].
const ARROW_M_PER_M_S: f64 = 6.0;

/// The sea surface, at z = 0.
pub fn surface(model: &Model, bounds: &Bounds) -> Mesh {
    if model.spec.water.density_kg_m3 <= 0.0 {
        return Mesh::default();
    }
    sheet(bounds, faded(SURFACE, 0.22), |x, y| DVec3::new(x, y, 0.0))
}

/// The seabed's plane.
pub fn seabed(model: &Model, bounds: &Bounds) -> Mesh {
    let Some(seabed) = &model.spec.seabed else { return Mesh::default() };
    let normal = seabed.normal;
    if normal.z < 0.1 {
        return Mesh::default();
    }
    sheet(bounds, SEABED, |x, y| {
        DVec3::new(x, y, -seabed.depth_m - (normal.x * x + normal.y * y) / normal.z)
    })
}

/// A wide sheet under or over the gear, in patches, so that far triangles keep their precision.
fn sheet(bounds: &Bounds, colour: Colour, place: impl Fn(f64, f64) -> DVec3) -> Mesh {
    const PATCHES: i32 = 12;
    let centre = bounds.centre();
    let reach = (bounds.half_size().max_element() * REACH).max(LEAST_REACH_M);
    let at = |step: i32| reach * f64::from(2 * step - PATCHES) / f64::from(PATCHES);
    let corner = |i: i32, j: i32| single(place(centre.x + at(i), centre.y + at(j)));
    let mut mesh = Mesh::default();
    for i in 0..PATCHES {
        for j in 0..PATCHES {
            mesh.quad(
                [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)],
                colour,
            );
        }
    }
    mesh
}

/// A column of arrows beside the gear, each as long as the current is fast at its height: shafts, and heads.
pub fn current(model: &Model) -> [Mesh; 2] {
    let water = &model.spec.water;
    let [mut mesh, mut heads] = <[Mesh; 2]>::default();
    let bottom = -model.spec.seabed.as_ref().map_or(water.depth_m, |seabed| seabed.depth_m);
    let along = water.current.surface_m_s.normalize_or_zero();
    if water.density_kg_m3 <= 0.0 || along == DVec3::ZERO || bottom >= 0.0 {
        return [mesh, heads];
    }
    let across = DVec3::new(-along.y, along.x, 0.0);
    // Beside the gear as it was placed, so that the column stands still while the gear moves.
    let placed = Bounds::of(
        model
            .spec
            .bodies
            .iter()
            .map(|body| body.position_m)
            .chain(model.spec.joints.iter().map(|joint| joint.position_m)),
    );
    let half = placed.half_size();
    let foot = placed.centre() + across * (half.dot(across.abs()) + 4.0);
    let column = |height: f64| single(DVec3::new(foot.x, foot.y, bottom * (1.0 - height)));
    let radius = (-0.004 * bottom).clamp(0.02, 0.5) as f32;
    mesh.bar(column(0.0), column(1.0), 0.2 * radius, CURRENT);
    for arrow in 0..ARROWS {
        let from = column((arrow as f64 + 0.5) / ARROWS as f64);
        let velocity = water.velocity(from.as_dvec3());
        let shaft: Vec3 = single(velocity * ARROW_M_PER_M_S);
        if shaft.length() > 0.05 {
            mesh.bar(from, from + shaft, 0.5 * radius, CURRENT);
            let head_m = (5.0 * radius).min(0.5 * shaft.length());
            heads.head(from + shaft, shaft.normalize_or_zero(), head_m, CURRENT);
        }
    }
    [mesh, heads]
}

//! Bodies from their library figures: mass, inertia, added mass, drag, floats, feet.
//!
//! Signs and axes: the body's frame has its origin at the centre of mass, x along a trap's length,
//! z up (a buoy's axis). Formulas, with `ρ` the density of the water, `m` mass, `V` displaced volume:
//!
//! | quantity | box (trap, anchor) `a × b × c` | buoy, diameter `D`, length `L` |
//! |---|---|---|
//! | inertia | shell, mass spread evenly over the six faces | solid cylinder; sphere `m D²/10`; spar: rod twice as long as its line hangs deep |
//! | displaced volume | `(m g - W) / (ρ g)` from the wet weight `W` | as given |
//! | added mass | share × `ρ a b c` | share × `ρ V` |
//! | added inertia | share × `ρ a b c (b² + c²)/12` and so on | share × `ρ V L²/12` |
//! | drag area | `2 C_d · solidity · face`: the water meets both faces of a cage | `C_d D L` across, `C_d π D²/4` along |
//! | turning drag | plate strips: `∫|r|³` gives `A_j L_k³/32` | the same across; skin drag `0.02` about the axis |
//! | floats | one, as high as the box | a sphere: one; else seven slices along the axis |
//!
//! A float goes under over the height at which its law `V (1/2 - z/h)` has the right slope when the
//! buoy lies at half depth: `h` = volume over waterplane area, `2D/3` for a sphere and `π D/4` for a
//! cylinder.

use endline_sim::model::{Body, BodyRole, Float, Shape};
use endline_sim::{DQuat, DVec3};

use crate::items::{BoxGear, Buoy, BuoyShape};
use crate::scenario::FreeBody;

/// Slices of a buoy's float.
const SLICES: usize = 7;
/// Skin-drag coefficient of a smooth body turning about its axis (flat plate, turbulent).
const SKIN_DRAG: f64 = 0.02;
/// Friction of a buoy or weight that has come to lie on the seabed.
const SMOOTH_FRICTION: f64 = 0.5;

/// A trap or anchor with its underside at `foot_m`.
pub(super) fn of_box(id: String, role: BodyRole, item: &BoxGear, density: f64, foot_m: DVec3, orientation: DQuat) -> Body {
    let size = DVec3::from_array(item.size_m);
    let water_kg = density * size.element_product();
    let share = DVec3::new(item.added_mass_horizontal, item.added_mass_horizontal, item.added_mass_vertical);
    let faces = DVec3::new(size.y * size.z, size.x * size.z, size.x * size.y);
    let drag_area_m2 = faces * (2.0 * item.drag_coefficient * item.solidity);
    Body {
        id,
        role,
        shape: Shape::Box(size / 2.0),
        mass_kg: item.mass_kg,
        inertia_kg_m2: shell_inertia(item.mass_kg, size),
        added_mass_kg: share * water_kg,
        added_inertia_kg_m2: squares(size) * (share.element_sum() / 3.0 * water_kg / 12.0),
        drag_area_m2,
        turn_drag_m5: strip_drag(drag_area_m2, size),
        floats: vec![Float { offset_m: DVec3::ZERO, volume_m3: item.displaced_m3(), height_m: size.z }],
        wetted_drag: true,
        feet_m: corners(size / 2.0),
        start_friction: item.start_friction,
        slide_friction: item.slide_friction,
        position_m: foot_m + DVec3::Z * (size.z / 2.0),
        orientation,
        held_until_s: None,
    }
}

/// Points of a trap or anchor where a line can be made fast, in the body's frame.
pub(super) fn box_points(item: &BoxGear) -> Vec<(String, DVec3)> {
    item.points().into_iter().map(|point| (point.name, DVec3::from_array(point.at_m))).collect()
}

/// A buoy with the middle of its float at `middle_m`.
pub(super) fn of_buoy(id: String, item: &Buoy, density: f64, middle_m: DVec3, orientation: DQuat) -> Body {
    let (diameter, length) = (item.diameter_m, item.length_m);
    let end = std::f64::consts::PI / 4.0 * diameter * diameter;
    let side = if item.shape == BuoyShape::Sphere { end } else { diameter * length };
    let (across, along) = (item.drag_across * side, item.drag_along * end);
    let drag_area_m2 = DVec3::new(across, across, along);
    let water_kg = density * item.volume_m3;
    let added_turn = if item.shape == BuoyShape::Sphere { 0.0 } else { item.added_mass_across * water_kg * length * length / 12.0 };
    let skin = skin_turn_drag(diameter, length);
    let strips = if item.shape == BuoyShape::Sphere { 0.0 } else { across * length * length * length / 32.0 };
    let middle = DVec3::new(0.0, 0.0, -item.centre_of_mass_m);
    Body {
        id,
        role: BodyRole::Buoy,
        shape: match item.shape {
            BuoyShape::Sphere => Shape::Sphere(diameter / 2.0),
            _ => Shape::Capsule { radius_m: diameter / 2.0, half_length_m: length / 2.0 },
        },
        mass_kg: item.mass_kg,
        inertia_kg_m2: buoy_inertia(item),
        added_mass_kg: DVec3::new(item.added_mass_across, item.added_mass_across, item.added_mass_along) * water_kg,
        added_inertia_kg_m2: DVec3::new(added_turn, added_turn, 0.0),
        drag_area_m2,
        turn_drag_m5: DVec3::new(skin + strips, skin + strips, skin),
        floats: buoy_floats(item),
        wetted_drag: true,
        feet_m: vec![middle - DVec3::Z * (length / 2.0), middle + DVec3::Z * (length / 2.0)],
        start_friction: SMOOTH_FRICTION,
        slide_friction: SMOOTH_FRICTION,
        position_m: middle_m - orientation * middle,
        orientation,
        held_until_s: None,
    }
}

/// Points of a buoy where a line can be made fast, in the body's frame.
pub(super) fn buoy_points(item: &Buoy) -> Vec<(String, DVec3)> {
    let middle = DVec3::new(0.0, 0.0, -item.centre_of_mass_m);
    item.points().into_iter().map(|point| (point.name, middle + DVec3::from_array(point.at_m))).collect()
}

/// A body written into a scenario: a sphere with the line at its middle.
pub(super) fn of_free(body: &FreeBody, density: f64) -> Body {
    let radius = body.radius_m;
    let float = Float { offset_m: DVec3::ZERO, volume_m3: body.volume_m3, height_m: body.float_height_m };
    Body {
        id: body.id.value.clone(),
        role: if body.buoy { BodyRole::Buoy } else { BodyRole::Weight },
        shape: Shape::Sphere(radius),
        mass_kg: body.mass_kg,
        inertia_kg_m2: DVec3::splat(0.4 * body.mass_kg * radius * radius),
        added_mass_kg: DVec3::splat(body.added_mass * density * body.volume_m3),
        added_inertia_kg_m2: DVec3::ZERO,
        drag_area_m2: DVec3::splat(body.drag_area_m2),
        turn_drag_m5: DVec3::splat(skin_turn_drag(2.0 * radius, 2.0 * radius)),
        floats: if body.volume_m3 > 0.0 { vec![float] } else { Vec::new() },
        wetted_drag: body.wetted_drag,
        feet_m: vec![DVec3::new(0.0, 0.0, -radius)],
        start_friction: SMOOTH_FRICTION,
        slide_friction: SMOOTH_FRICTION,
        position_m: body.position_m,
        orientation: DQuat::IDENTITY,
        held_until_s: body.held_until_s,
    }
}

/// Principal moments of inertia of a hollow box, its mass spread evenly over the six faces [kg m²].
///
/// `I_x = 2 [m_x (b² + c²)/12 + m_y (c²/12 + b²/4) + m_z (b²/12 + c²/4)]` with `m_x` the mass of a
/// face across x, and so on round.
#[must_use]
pub fn shell_inertia(mass_kg: f64, size_m: DVec3) -> DVec3 {
    let [a, b, c] = size_m.to_array();
    let by_area = mass_kg / (2.0 * (a * b + b * c + c * a));
    let (mx, my, mz) = (by_area * b * c, by_area * c * a, by_area * a * b);
    let about = |along: f64, p: (f64, f64), q: (f64, f64)| {
        // p and q: (size, mass of one face across it) of the two other axes.
        let (ps, qs) = (p.0 * p.0, q.0 * q.0);
        2.0 * (along * (ps + qs) / 12.0 + p.1 * (qs / 12.0 + ps / 4.0) + q.1 * (ps / 12.0 + qs / 4.0))
    };
    DVec3::new(about(mx, (b, my), (c, mz)), about(my, (c, mz), (a, mx)), about(mz, (a, mx), (b, my)))
}

/// The floats of a buoy, in the body's frame; their volumes sum to the buoy's.
#[must_use]
pub fn buoy_floats(item: &Buoy) -> Vec<Float> {
    let radius = item.diameter_m / 2.0;
    if item.shape == BuoyShape::Sphere {
        let offset_m = DVec3::new(0.0, 0.0, -item.centre_of_mass_m);
        return vec![Float { offset_m, volume_m3: item.volume_m3, height_m: 4.0 * radius / 3.0 }];
    }
    let thickness = item.length_m / SLICES as f64;
    let edge = |slice: usize| -item.length_m / 2.0 + thickness * slice as f64;
    let whole = capsule_below(radius, item.length_m, item.length_m / 2.0);
    let slice = |index: usize| {
        let (low, high) = (edge(index), edge(index + 1));
        let share = (capsule_below(radius, item.length_m, high) - capsule_below(radius, item.length_m, low)) / whole;
        let offset_m = DVec3::new(0.0, 0.0, (low + high) / 2.0 - item.centre_of_mass_m);
        Float { offset_m, volume_m3: share * item.volume_m3, height_m: std::f64::consts::FRAC_PI_4 * item.diameter_m }
    };
    (0..SLICES).map(slice).collect()
}

/// Volume of a capsule of a whole length below a height, the middle being zero [m³].
fn capsule_below(radius: f64, length: f64, height: f64) -> f64 {
    let half = (length / 2.0 - radius).max(0.0);
    let area = std::f64::consts::PI * radius * radius;
    let cap = |h: f64| {
        let h = h.clamp(0.0, radius);
        area * h - std::f64::consts::PI * h * h * h / 3.0
    };
    let upper = |z: f64| area * z.clamp(0.0, half) + cap(z - half);
    upper(length / 2.0) + if height >= 0.0 { upper(height) } else { -upper(-height) }
}

fn buoy_inertia(item: &Buoy) -> DVec3 {
    let (mass, radius, length) = (item.mass_kg, item.diameter_m / 2.0, item.length_m);
    match item.shape {
        BuoyShape::Sphere => DVec3::splat(0.4 * mass * radius * radius),
        BuoyShape::Bullet => {
            let across = mass * (3.0 * radius * radius + length * length) / 12.0;
            DVec3::new(across, across, 0.5 * mass * radius * radius)
        }
        BuoyShape::Spar => {
            let across = mass * item.attachment_m * item.attachment_m / 3.0;
            DVec3::new(across, across, 0.5 * mass * radius * radius)
        }
    }
}

/// `(b² + c², a² + c², a² + b²)`.
fn squares(size: DVec3) -> DVec3 {
    let square = size * size;
    DVec3::splat(square.element_sum()) - square
}

/// Turning drag of the faces as plates cut into strips: `A_j L_k³/32 + A_k L_j³/32`.
fn strip_drag(area: DVec3, size: DVec3) -> DVec3 {
    let cubed = size * size * size / 32.0;
    DVec3::new(area.y * cubed.z + area.z * cubed.y, area.z * cubed.x + area.x * cubed.z, area.x * cubed.y + area.y * cubed.x)
}

fn skin_turn_drag(diameter: f64, length: f64) -> f64 {
    SKIN_DRAG * std::f64::consts::PI * diameter * length * (diameter / 2.0).powi(3)
}

/// The eight corners of a box, the lower four first.
fn corners(half: DVec3) -> Vec<DVec3> {
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let layer = |z: f64| signs.map(|(x, y)| DVec3::new(x * half.x, y * half.y, z));
    layer(-half.z).into_iter().chain(layer(half.z)).collect()
}

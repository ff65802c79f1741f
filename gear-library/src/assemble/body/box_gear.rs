//! Traps and anchors: a hollow box `a × b × c`, ballast flat over its floor, foam or wood inside.
//!
//! With `ρ` the density of the water, `m` the mass, `m_b` ballast, `z` heights above the middle of the box:
//!
//! | quantity | formula |
//! |---|---|
//! | centre of mass | `z_m = m_b z_b / m` |
//! | inertia | shell of mass `m - m_b`, spread evenly over the six faces; ballast `m_b/12 (b², a², a² + b²)`; each with its `m z²` |
//! | displaced volume | `(m g - W)/(ρ g)` from the wet weight `W`: ballast by its density, foam as given, the rest the shell |
//! | added mass | share × `ρ a b c`; added inertia share × `ρ a b c (b² + c²)/12` and so on |
//! | drag area | `2 C_d · solidity · face`: the water meets both faces of a cage; a quarter each at `±a/√12, ±b/√12` |
//! | turning drag | of those four by what they do; by height plate strips, `∫|r|³` gives `A c³/32` |
//!
//! Drag spread over the box damps a trap that falls: with all of it at the middle it swings ever wider on the way down.

use endline_sim::model::{Body, BodyRole, Float, Form, PlacedShape, Shape};
use endline_sim::{DQuat, DVec3};

use crate::items::BoxGear;

/// Height over which ballast goes under [m].
const BALLAST_HEIGHT_M: f64 = 0.1;

/// A trap or anchor with its underside at `foot_m`.
pub fn of_box(
    id: String,
    role: BodyRole,
    item: &BoxGear,
    density: f64,
    foot_m: DVec3,
    orientation: DQuat,
) -> Body {
    let size = DVec3::from_array(item.size_m);
    let water_kg = density * size.element_product();
    let share = DVec3::new(
        item.added_mass_horizontal,
        item.added_mass_horizontal,
        item.added_mass_vertical,
    );
    let middle = middle(item);
    let drag_area_m2 = drag_area(item);
    Body {
        id,
        item: item.entry.name.clone(),
        role,
        parts: vec![PlacedShape { shape: Shape::Box(size / 2.0), middle_m: middle }],
        mass_kg: item.mass_kg,
        inertia_kg_m2: box_inertia(item),
        added_mass_kg: share * water_kg,
        added_inertia_kg_m2: squares(size) * (share.element_sum() / 3.0 * water_kg / 12.0),
        drag_area_m2: DVec3::ZERO,
        turn_drag_m5: strip_drag(drag_area_m2, size),
        floats: floats(item, middle, drag_area_m2),
        wetted_drag: true,
        feet_m: corners(size / 2.0).into_iter().map(|corner| middle + corner).collect(),
        foot_radius_m: Vec::new(),
        start_friction: item.start_friction,
        slide_friction: item.slide_friction,
        foot_break_out_n: item.break_out_n / 4.0,
        position_m: foot_m + orientation * (DVec3::Z * (size.z / 2.0) - middle),
        orientation,
        spin_rad_s: DVec3::ZERO,
        held_until_s: None,
    }
}

/// Points of a trap or anchor where a line can be made fast, in the body's frame.
pub fn box_points(item: &BoxGear) -> Vec<(String, DVec3)> {
    let middle = middle(item);
    item.points()
        .into_iter()
        .map(|point| (point.name, middle + DVec3::from_array(point.at_m)))
        .collect()
}

/// Principal moments of inertia about the centre of mass [kg m²].
#[must_use]
pub fn box_inertia(item: &BoxGear) -> DVec3 {
    let (size, ballast) = (DVec3::from_array(item.size_m), item.ballast_kg);
    let (shell_kg, middle) = (item.mass_kg - ballast, middle(item).z);
    let flat = DVec3::new(size.x, size.y, 0.0);
    let low = middle + ballast_height(item);
    let moved = DVec3::new(1.0, 1.0, 0.0) * (shell_kg * middle * middle + ballast * low * low);
    shell_inertia(shell_kg, size) + squares(flat) * (ballast / 12.0) + moved
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
        2.0 * (along * (ps + qs) / 12.0
            + p.1 * (qs / 12.0 + ps / 4.0)
            + q.1 * (ps / 12.0 + qs / 4.0))
    };
    DVec3::new(
        about(mx, (b, my), (c, mz)),
        about(my, (c, mz), (a, mx)),
        about(mz, (a, mx), (b, my)),
    )
}

/// Middle of the box in the body's frame: the centre of mass lies below it by what the ballast weighs.
fn middle(item: &BoxGear) -> DVec3 {
    DVec3::new(0.0, 0.0, -item.ballast_kg * ballast_height(item) / item.mass_kg)
}

/// Height of the ballast above the middle of the box [m].
fn ballast_height(item: &BoxGear) -> f64 {
    item.ballast_height_m - item.size_m[2] / 2.0
}

/// Drag coefficient times area by axis: both faces across it [m²].
fn drag_area(item: &BoxGear) -> DVec3 {
    let [a, b, c] = item.size_m;
    DVec3::new(b * c, a * c, a * b)
        * DVec3::from_array(item.solidity)
        * (2.0 * item.drag_coefficient)
}

/// Wire, ballast and foam, each where it is. The wire has the drag and stands for the whole box in four parts at
/// `±a/√12, ±b/√12`, which have its second moments.
fn floats(item: &BoxGear, middle: DVec3, drag_area_m2: DVec3) -> Vec<Float> {
    let [a, b, _] = item.size_m.map(|size| size / 12.0_f64.sqrt());
    let (volume_m3, drag_area_m2, form) =
        (item.wire_m3() / 4.0, drag_area_m2 / 4.0, Form::Level { height_m: item.size_m[2] });
    let wire = |(x, y): (f64, f64)| Float {
        offset_m: middle + DVec3::new(x, y, 0.0),
        volume_m3,
        form,
        drag_area_m2,
    };
    let at = |height: f64| middle + DVec3::Z * height;
    let ballast = Float::level(at(ballast_height(item)), item.ballast_m3(), BALLAST_HEIGHT_M);
    let foam =
        Float::level(at(item.foam_height_m - item.size_m[2] / 2.0), item.foam_m3, BALLAST_HEIGHT_M);
    let inside = [ballast, foam].into_iter().filter(|float| float.volume_m3 > 0.0);
    [(a, b), (-a, b), (a, -b), (-a, -b)].map(wire).into_iter().chain(inside).collect()
}

/// `(b² + c², a² + c², a² + b²)`.
pub(super) fn squares(size: DVec3) -> DVec3 {
    let square = size * size;
    DVec3::splat(square.element_sum()) - square
}

/// Turning drag of the upright faces as plates cut into strips by height: `A c³/32`. What length and width add comes of
/// the wire's four parts.
fn strip_drag(area: DVec3, size: DVec3) -> DVec3 {
    DVec3::new(area.y, area.x, 0.0) * (size.z * size.z * size.z / 32.0)
}

/// The eight corners of a box, the lower four first.
pub(super) fn corners(half: DVec3) -> Vec<DVec3> {
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let layer = |z: f64| signs.map(|(x, y)| DVec3::new(x * half.x, y * half.y, z));
    layer(-half.z).into_iter().chain(layer(half.z)).collect()
}

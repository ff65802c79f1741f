//! Bodies of the model from library figures: mass, inertia, added mass, drag, floats, feet.
//!
//! The body's frame has its origin at the centre of mass, x along a trap's length, z up (the axis of a buoy).
//! `ρ` is the density of the water.
//!
//! # Traps and anchors
//!
//! A hollow box `a × b × c` with ballast flat over its floor, and foam or wood inside.
//! `m` is the mass, `m_b` the ballast, `z` a height above the middle of the box.
//!
//! | quantity | formula |
//! |---|---|
//! | centre of mass | `z_m = m_b z_b / m` |
//! | inertia | shell of mass `m - m_b`, distributed evenly over the six faces; ballast `m_b/12 (b², a², a² + b²)`; each with its `m z²` |
//! | displaced volume | `(m g - W)/(ρ g)` from the wet weight `W`: ballast by its density, foam as stated, the shell is the rest |
//! | added mass | share × `ρ a b c`; added inertia share × `ρ a b c (b² + c²)/12` and so on |
//! | drag area | `2 C_d · solidity · face`: both faces of a cage are exposed; a quarter each at `±a/√12, ±b/√12` |
//! | turning drag | from those four parts; by height from plate strips: `∫|r|³` is `A c³/32` |
//!
//! The distributed drag damps a falling trap; with all drag at the middle its oscillation would grow.
//!
//! # Buoys
//!
//! A float of diameter `D` and length `L` along the axis with pieces (staff, counterweight, reflector).
//! `V` and `m` are volume and mass of a part, `z` its height above the centre of mass.
//!
//! | quantity | formula |
//! |---|---|
//! | centre of mass | `Σ m z = 0` over float and pieces |
//! | inertia | sphere `m D²/10`; spheroid `m (L² + D²)/20` across; bullet and cylinder `m (3D²/4 + L²)/12` across, `m D²/8` along; with `m z²` |
//! | floats | sphere and low-drag shape: one spheroid; cylinder and pieces: one cylinder each; bullet: twelve slices of a capsule |
//! | drag area | `C_d D L` across, `C_d π D²/4` along, at each part |
//! | turning drag | from the slices; of a spheroid from plate strips; skin drag `0.02` about the axis |
//! | added mass | share × `ρ V` across and along; added inertia share × `ρ V (L²/12 + z²)` |
//!
//! For contact and pictures a buoy is its float and one flat-ended cylinder per piece.
//! The slices of a bullet are cylinders with the volume of the capsule between their ends; the error of its draft is below
//! 1 % of its diameter.

use std::f64::consts::{FRAC_PI_4, PI};

use endline_sim::model::{Body, BodyRole, Float, Form, PlacedShape, Shape};
use endline_sim::{DQuat, DVec3};

use crate::items::{BoxGear, Buoy, BuoyPiece, BuoyShape, Point};
use crate::scenario::FreeBody;

/// Skin-drag coefficient of a smooth body turning about its axis (flat plate, turbulent).
const SKIN_DRAG: f64 = 0.02;
/// Friction of a buoy or weight on the seabed.
const SMOOTH_FRICTION: f64 = 0.5;

/// A body written into a scenario: a sphere or a box; lines are made fast at its middle.
pub(super) fn of_free(body: &FreeBody, density: f64) -> Body {
    let radius = body.radius_m;
    let (shape, inertia, feet_m, foot_radius_m) = match body.half_m {
        Some(half) => (
            Shape::Box(half),
            squares(2.0 * half) * (body.mass_kg / 12.0),
            corners(half),
            Vec::new(),
        ),
        None => (
            Shape::Sphere(radius),
            DVec3::splat(0.4 * body.mass_kg * radius * radius),
            vec![DVec3::ZERO],
            vec![radius],
        ),
    };
    let float = Float { form: form(body), ..Float::level(DVec3::ZERO, body.volume_m3, 1.0) };
    Body {
        id: body.id.value.clone(),
        item: String::new(),
        role: if body.buoy { BodyRole::Buoy } else { BodyRole::Weight },
        parts: vec![PlacedShape::about_origin(shape)],
        mass_kg: body.mass_kg,
        inertia_kg_m2: body.inertia_kg_m2.unwrap_or(inertia),
        added_mass_kg: DVec3::splat(body.added_mass * density * body.volume_m3),
        added_inertia_kg_m2: DVec3::ZERO,
        drag_area_m2: DVec3::splat(body.drag_area_m2),
        turn_drag_m5: DVec3::splat(skin_turn_drag(2.0 * radius, 2.0 * radius)),
        floats: if body.volume_m3 > 0.0 { vec![float] } else { Vec::new() },
        wetted_drag: body.wetted_drag,
        feet_m,
        foot_radius_m,
        start_friction: SMOOTH_FRICTION,
        slide_friction: SMOOTH_FRICTION,
        foot_break_out_n: 0.0,
        position_m: body.position_m,
        orientation: DQuat::IDENTITY,
        spin_rad_s: body.spin_rad_s,
        held_until_s: body.held_until_s,
    }
}

/// Immersion of a free body: linear over a stated height or the height of a box, else as a sphere.
fn form(body: &FreeBody) -> Form {
    match (body.float_height_m, body.half_m) {
        (Some(height_m), _) => Form::Level { height_m },
        (None, Some(half_m)) => Form::Level { height_m: 2.0 * half_m.z },
        (None, None) => Form::Spheroid { across_m: body.radius_m, along_m: body.radius_m },
    }
}

fn skin_turn_drag(diameter: f64, length: f64) -> f64 {
    let radius = diameter / 2.0;
    SKIN_DRAG * PI * diameter * length * (radius * radius * radius)
}

/// Height over which ballast is immersed [m].
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
    let drag_area_m2 = box_drag_area(item);
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

/// Points of a trap or anchor for lines, in the body's frame.
pub fn box_points(item: &BoxGear) -> Vec<(String, DVec3)> {
    in_frame(item.points(), middle(item))
}

/// Principal moments of inertia about the centre of mass [kg m²].
pub fn box_inertia(item: &BoxGear) -> DVec3 {
    let (size, ballast) = (DVec3::from_array(item.size_m), item.ballast_kg);
    let (shell_kg, middle) = (item.mass_kg - ballast, middle(item).z);
    let flat = DVec3::new(size.x, size.y, 0.0);
    let low = middle + ballast_height(item);
    let moved = DVec3::new(1.0, 1.0, 0.0) * (shell_kg * middle * middle + ballast * low * low);
    shell_inertia(shell_kg, size) + squares(flat) * (ballast / 12.0) + moved
}

/// Principal moments of inertia of a hollow box with mass distributed evenly over its faces [kg m²].
///
/// `I_x = 2 [m_x (b² + c²)/12 + m_y (c²/12 + b²/4) + m_z (b²/12 + c²/4)]` with `m_x` the mass of a
/// face across x; the other two by cyclic permutation.
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

/// Middle of the box in the body's frame, above the centre of mass because of the ballast.
fn middle(item: &BoxGear) -> DVec3 {
    DVec3::new(0.0, 0.0, -item.ballast_kg * ballast_height(item) / item.mass_kg)
}

/// Height of the ballast above the middle of the box [m].
fn ballast_height(item: &BoxGear) -> f64 {
    item.ballast_height_m - item.size_m[2] / 2.0
}

/// Drag coefficient times area by axis: both faces across it [m²].
fn box_drag_area(item: &BoxGear) -> DVec3 {
    let [a, b, c] = item.size_m;
    DVec3::new(b * c, a * c, a * b)
        * DVec3::from_array(item.solidity)
        * (2.0 * item.drag_coefficient)
}

/// Floats of wire, ballast and foam. The wire and the drag are divided into four parts at `±a/√12, ±b/√12`, which have
/// the second moments of the box.
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
fn squares(size: DVec3) -> DVec3 {
    let square = size * size;
    DVec3::splat(square.element_sum()) - square
}

/// Turning drag of the upright faces as plates in strips by height: `A c³/32`. The four parts of the wire contribute the
/// drag by length and width.
fn strip_drag(area: DVec3, size: DVec3) -> DVec3 {
    DVec3::new(area.y, area.x, 0.0) * (size.z * size.z * size.z / 32.0)
}

/// The eight corners of a box, the lower four first.
fn corners(half: DVec3) -> Vec<DVec3> {
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let layer = |z: f64| signs.map(|(x, y)| DVec3::new(x * half.x, y * half.y, z));
    layer(-half.z).into_iter().chain(layer(half.z)).collect()
}

/// Slices of a bullet.
const SLICES: usize = 12;

/// A buoy with the middle of its float at `middle_m`.
pub fn of_buoy(id: String, item: &Buoy, density: f64, middle_m: DVec3, orientation: DQuat) -> Body {
    let (diameter, length) = (item.diameter_m, item.length_m);
    let middle = DVec3::Z * -centre_of_mass(item);
    let water_kg = density * item.volume_m3;
    let skin = skin_turn_drag(diameter, length);
    let strips = if item.shape == BuoyShape::LowDrag {
        buoy_drag_area(item).x * length * length * length / 32.0
    } else {
        0.0
    };
    let feet = feet(item);
    Body {
        id,
        item: item.entry.name.clone(),
        role: BodyRole::Buoy,
        parts: parts(item, middle),
        mass_kg: item.whole_mass_kg(),
        inertia_kg_m2: buoy_inertia(item),
        added_mass_kg: DVec3::new(
            item.added_mass_across,
            item.added_mass_across,
            item.added_mass_along,
        ) * water_kg
            + DVec3::new(1.0, 1.0, 0.0)
                * item.pieces.iter().map(|piece| density * piece.volume_m3).sum::<f64>(),
        added_inertia_kg_m2: added_inertia(item, density),
        drag_area_m2: DVec3::ZERO,
        turn_drag_m5: DVec3::new(skin + strips, skin + strips, skin),
        floats: buoy_floats(item),
        wetted_drag: true,
        feet_m: feet.iter().map(|(height, _)| middle + DVec3::Z * *height).collect(),
        foot_radius_m: feet.iter().map(|(_, radius)| *radius).collect(),
        start_friction: SMOOTH_FRICTION,
        slide_friction: SMOOTH_FRICTION,
        foot_break_out_n: 0.0,
        position_m: middle_m - orientation * middle,
        orientation,
        spin_rad_s: DVec3::ZERO,
        held_until_s: None,
    }
}

/// Shapes of the float and of each piece.
fn parts(item: &Buoy, middle_m: DVec3) -> Vec<PlacedShape> {
    let (radius_m, half_length_m) = (item.diameter_m / 2.0, item.length_m / 2.0);
    let shape = match item.shape {
        BuoyShape::Sphere => Shape::Sphere(radius_m),
        BuoyShape::Bullet => Shape::Capsule { radius_m, half_length_m },
        BuoyShape::LowDrag => Shape::Spheroid { across_m: radius_m, along_m: half_length_m },
        BuoyShape::Cylinder => Shape::Cylinder { radius_m, half_length_m },
    };
    let piece = |piece: &BuoyPiece| PlacedShape {
        shape: Shape::Cylinder {
            radius_m: piece.diameter_m / 2.0,
            half_length_m: piece.length_m / 2.0,
        },
        middle_m: middle_m + DVec3::Z * piece.at_m,
    };
    let float = PlacedShape { shape, middle_m };
    std::iter::once(float).chain(item.pieces.iter().map(piece)).collect()
}

/// Points of a buoy for lines, in the body's frame.
pub fn buoy_points(item: &Buoy) -> Vec<(String, DVec3)> {
    in_frame(item.points(), DVec3::Z * -centre_of_mass(item))
}

/// Points in the body's frame, in which the middle of the box or float lies at `middle`.
fn in_frame(points: Vec<Point>, middle: DVec3) -> Vec<(String, DVec3)> {
    points.into_iter().map(|point| (point.name, middle + DVec3::from_array(point.at_m))).collect()
}

/// Principal moments of inertia of float and pieces about the common centre of mass [kg m²].
pub fn buoy_inertia(item: &Buoy) -> DVec3 {
    let centre = centre_of_mass(item);
    let (mass, diameter, length) = (item.mass_kg, item.diameter_m, item.length_m);
    let own = match item.shape {
        BuoyShape::Sphere => DVec3::splat(0.1 * mass * diameter * diameter),
        BuoyShape::LowDrag => {
            let across = mass * (length * length + diameter * diameter) / 20.0;
            DVec3::new(across, across, 0.1 * mass * diameter * diameter)
        }
        BuoyShape::Bullet | BuoyShape::Cylinder => rod_inertia(mass, diameter, length),
    };
    let moved = |mass: f64, height: f64| {
        DVec3::new(1.0, 1.0, 0.0) * (mass * (height - centre) * (height - centre))
    };
    let piece = |piece: &BuoyPiece| {
        rod_inertia(piece.mass_kg, piece.diameter_m, piece.length_m)
            + moved(piece.mass_kg, piece.at_m)
    };
    own + moved(mass, item.centre_of_mass_m) + item.pieces.iter().map(piece).sum::<DVec3>()
}

/// Floats of a buoy in the body's frame; they add up to its volume and drag.
pub fn buoy_floats(item: &Buoy) -> Vec<Float> {
    let middle = DVec3::Z * -centre_of_mass(item);
    let one = |form: Form| {
        vec![Float {
            offset_m: middle,
            volume_m3: item.volume_m3,
            form,
            drag_area_m2: buoy_drag_area(item),
        }]
    };
    let (radius_m, length_m) = (item.diameter_m / 2.0, item.length_m);
    let mut floats = match item.shape {
        BuoyShape::Sphere | BuoyShape::LowDrag => {
            one(Form::Spheroid { across_m: radius_m, along_m: length_m / 2.0 })
        }
        BuoyShape::Cylinder => one(Form::Cylinder { radius_m, length_m }),
        BuoyShape::Bullet => bullet(item, middle),
    };
    floats.extend(item.pieces.iter().map(|piece| piece_float(piece, middle)));
    floats
}

/// Slices of a capsule, each a cylinder of equal volume.
fn bullet(item: &Buoy, middle: DVec3) -> Vec<Float> {
    let (radius, thickness) = (item.diameter_m / 2.0, item.length_m / SLICES as f64);
    let edge = |slice: usize| -item.length_m / 2.0 + thickness * slice as f64;
    let below = |height: f64| capsule_below(radius, item.length_m, height);
    let whole = below(item.length_m / 2.0);
    let radius_of = |volume: f64| (volume / (PI * thickness)).sqrt();
    let volumes: Vec<f64> =
        (0..SLICES).map(|slice| below(edge(slice + 1)) - below(edge(slice))).collect();
    let side: f64 = volumes.iter().map(|volume| radius_of(*volume)).sum();
    let drag = buoy_drag_area(item);
    let slice = |(slice, volume): (usize, &f64)| {
        let (radius_m, share) = (radius_of(*volume), volume / whole);
        let across = drag.x * radius_m / side;
        Float {
            offset_m: middle + DVec3::Z * (edge(slice) + thickness / 2.0),
            volume_m3: share * item.volume_m3,
            form: Form::Cylinder { radius_m, length_m: thickness },
            drag_area_m2: DVec3::new(across, across, drag.z * share),
        }
    };
    volumes.iter().enumerate().map(slice).collect()
}

fn piece_float(piece: &BuoyPiece, middle: DVec3) -> Float {
    let across = piece.drag_across * piece.diameter_m * piece.length_m;
    Float {
        offset_m: middle + DVec3::Z * piece.at_m,
        volume_m3: piece.volume_m3,
        form: Form::Cylinder { radius_m: piece.diameter_m / 2.0, length_m: piece.length_m },
        drag_area_m2: DVec3::new(
            across,
            across,
            piece.drag_along * FRAC_PI_4 * piece.diameter_m * piece.diameter_m,
        ),
    }
}

/// Drag coefficient times area of the float by axis [m²].
fn buoy_drag_area(item: &Buoy) -> DVec3 {
    let end = FRAC_PI_4 * item.diameter_m * item.diameter_m;
    let side = if item.shape == BuoyShape::Sphere { end } else { item.diameter_m * item.length_m };
    let across = item.drag_across * side;
    DVec3::new(across, across, item.drag_along * end)
}

fn added_inertia(item: &Buoy, density: f64) -> DVec3 {
    let centre = centre_of_mass(item);
    let rod =
        |length: f64, height: f64| length * length / 12.0 + (height - centre) * (height - centre);
    let own_length = if item.shape == BuoyShape::Sphere { 0.0 } else { item.length_m };
    let own = item.added_mass_across * item.volume_m3 * rod(own_length, 0.0);
    let pieces: f64 =
        item.pieces.iter().map(|piece| piece.volume_m3 * rod(piece.length_m, piece.at_m)).sum();
    DVec3::new(1.0, 1.0, 0.0) * (density * (own + pieces))
}

/// Height of the common centre of mass above the middle of the float [m].
fn centre_of_mass(item: &Buoy) -> f64 {
    let pieces: f64 = item.pieces.iter().map(|piece| piece.mass_kg * piece.at_m).sum();
    (item.mass_kg * item.centre_of_mass_m + pieces) / item.whole_mass_kg()
}

/// Balls that represent a buoy on the seabed: height above the middle of the float, and radius [m].
///
/// - Sphere: the sphere. Bullet: its rounded ends.
/// - Flat-ended cylinder (float or piece): an inscribed ball at each end, so that it lies on its side. Its rims are thereby
///   rounded, and it does not stand on its end. A cylinder shorter than wide is one ball of its diameter.
/// - Spheroid: a ball of its width at its middle, and balls with the curvature of its poles.
fn feet(item: &Buoy) -> Vec<(f64, f64)> {
    let (half, radius) = (item.length_m / 2.0, item.diameter_m / 2.0);
    let mut feet = match item.shape {
        BuoyShape::Sphere => vec![(0.0, radius)],
        BuoyShape::LowDrag if half > radius => {
            let pole = radius * radius / half;
            vec![(pole - half, pole), (0.0, radius), (half - pole, pole)]
        }
        _ => balls_within(half, radius, 0.0),
    };
    for piece in &item.pieces {
        feet.extend(balls_within(piece.length_m / 2.0, piece.diameter_m / 2.0, piece.at_m));
    }
    feet
}

/// Balls inscribed at both ends of a cylinder about a height; a single ball if it is not longer than wide.
fn balls_within(half: f64, radius: f64, height: f64) -> Vec<(f64, f64)> {
    let straight = half - radius;
    if straight > 0.0 {
        vec![(height - straight, radius), (height + straight, radius)]
    } else {
        vec![(height, radius)]
    }
}

fn rod_inertia(mass: f64, diameter: f64, length: f64) -> DVec3 {
    let across = mass * (0.75 * diameter * diameter + length * length) / 12.0;
    DVec3::new(across, across, mass * diameter * diameter / 8.0)
}

/// Volume of a capsule below a height above its middle [m³].
fn capsule_below(radius: f64, length: f64, height: f64) -> f64 {
    let half = (length / 2.0 - radius).max(0.0);
    let area = PI * radius * radius;
    let cap = |h: f64| {
        let h = h.clamp(0.0, radius);
        area * h - PI * h * h * h / 3.0
    };
    let upper = |z: f64| area * z.clamp(0.0, half) + cap(z - half);
    upper(length / 2.0) + if height >= 0.0 { upper(height) } else { -upper(-height) }
}

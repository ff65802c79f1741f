//! Buoys: a float of diameter `D` and length `L` along the axis, and what is fixed to it (staff, counterweight, reflector).
//!
//! With `ρ` the density of the water, `V` and `m` a part's volume and mass, `z` its height above the centre of mass:
//!
//! | quantity | formula |
//! |---|---|
//! | centre of mass | `Σ m z = 0` over float and pieces |
//! | inertia | sphere `m D²/10`; spheroid `m (L² + D²)/20` across; bullet and cylinder `m (3D²/4 + L²)/12` across, `m D²/8` along; with `m z²` |
//! | floats | sphere and low-drag shape one spheroid; cylinder and pieces a cylinder each; bullet twelve slices of a capsule |
//! | drag area | `C_d D L` across, `C_d π D²/4` along, where each part is |
//! | turning drag | of slices by what they do; of one spheroid plate strips; skin drag `0.02` about the axis |
//! | added mass | share × `ρ V` across and along; added inertia share × `ρ V (L²/12 + z²)` |
//!
//! For contact and for the picture a buoy is its float, shaped as it is, and one flat-ended cylinder for each piece.
//!
//! A bullet's slices are cylinders of the capsule's volume between their ends; its draft then is within 1 % of its diameter.

use endline_sim::model::{Body, BodyRole, Float, Form, PlacedShape, Shape};
use endline_sim::{DQuat, DVec3};

use crate::items::{Buoy, BuoyPiece, BuoyShape};

use super::{SMOOTH_FRICTION, skin_turn_drag};

use std::f64::consts::{FRAC_PI_4, PI};

/// Slices of a bullet.
const SLICES: usize = 12;

/// A buoy with the middle of its float at `middle_m`.
pub fn of_buoy(id: String, item: &Buoy, density: f64, middle_m: DVec3, orientation: DQuat) -> Body {
    let (diameter, length) = (item.diameter_m, item.length_m);
    let middle = DVec3::Z * -centre_of_mass(item);
    let water_kg = density * item.volume_m3;
    let skin = skin_turn_drag(diameter, length);
    let strips = if item.shape == BuoyShape::LowDrag {
        drag_area(item).x * length * length * length / 32.0
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

/// The float as it is shaped, and every piece as a cylinder at its height.
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

/// Points of a buoy where a line can be made fast, in the body's frame.
pub fn buoy_points(item: &Buoy) -> Vec<(String, DVec3)> {
    let middle = DVec3::Z * -centre_of_mass(item);
    item.points()
        .into_iter()
        .map(|point| (point.name, middle + DVec3::from_array(point.at_m)))
        .collect()
}

/// Principal moments of inertia of float and pieces about the common centre of mass [kg m²].
#[must_use]
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

/// The floats of a buoy, in the body's frame; their volumes sum to the buoy's, their drag to its own.
#[must_use]
pub fn buoy_floats(item: &Buoy) -> Vec<Float> {
    let middle = DVec3::Z * -centre_of_mass(item);
    let one = |form: Form| {
        vec![Float {
            offset_m: middle,
            volume_m3: item.volume_m3,
            form,
            drag_area_m2: drag_area(item),
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

/// Slices of a capsule, each a cylinder as thick as holds its volume.
fn bullet(item: &Buoy, middle: DVec3) -> Vec<Float> {
    let (radius, thickness) = (item.diameter_m / 2.0, item.length_m / SLICES as f64);
    let edge = |slice: usize| -item.length_m / 2.0 + thickness * slice as f64;
    let below = |height: f64| capsule_below(radius, item.length_m, height);
    let whole = below(item.length_m / 2.0);
    let radius_of = |volume: f64| (volume / (PI * thickness)).sqrt();
    let volumes: Vec<f64> =
        (0..SLICES).map(|slice| below(edge(slice + 1)) - below(edge(slice))).collect();
    let side: f64 = volumes.iter().map(|volume| radius_of(*volume)).sum();
    let drag = drag_area(item);
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
fn drag_area(item: &Buoy) -> DVec3 {
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

/// What of a buoy touches the seabed, as height above the middle of the float and radius of a ball [m]:
///
/// - a sphere: itself; a bullet: its rounded ends;
/// - a flat-ended cylinder, float or piece: a ball within each end, as wide as it is, so that it lies on its side and stands at its height. Its rims are
///   rounded off by that, and it does not stand on its end by itself. One that is shorter than wide is a ball as wide as it is;
/// - a spheroid: the ball about its middle that is as wide as it is, and the balls that lie within its poles and have their curvature.
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

/// Balls within both ends of a cylinder about a height; one where they would be one and the same, or it is shorter than wide.
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

/// Volume of a capsule of a whole length below a height, the middle being zero [m³].
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

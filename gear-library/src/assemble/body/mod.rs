//! Bodies from their library figures: mass, inertia, added mass, drag, floats, feet.
//!
//! Signs and axes: the body's frame has its origin at the centre of mass, x along a trap's length, z up (a buoy's axis).
//! The formulas stand at the head of `box_gear.rs` and `buoy.rs`.

mod box_gear;
mod buoy;

use endline_sim::model::{Body, BodyRole, Float, Form, PlacedShape, Shape};
use endline_sim::{DQuat, DVec3};

use crate::scenario::FreeBody;

pub use box_gear::{box_inertia, shell_inertia};
pub(super) use box_gear::{box_points, of_box};
pub use buoy::{buoy_floats, buoy_inertia};
pub(super) use buoy::{buoy_points, of_buoy};

/// Skin-drag coefficient of a smooth body turning about its axis (flat plate, turbulent).
const SKIN_DRAG: f64 = 0.02;
/// Friction of a buoy or weight that has come to lie on the seabed.
const SMOOTH_FRICTION: f64 = 0.5;

/// A body written into a scenario: a sphere or a box with the line at its middle.
pub(super) fn of_free(body: &FreeBody, density: f64) -> Body {
    let radius = body.radius_m;
    let (shape, inertia, feet_m, foot_radius_m) = match body.half_m {
        Some(half) => (
            Shape::Box(half),
            box_gear::squares(2.0 * half) * (body.mass_kg / 12.0),
            box_gear::corners(half),
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

/// How a free body goes under: evenly over a height if that is given, a ball as a ball, a box over its own height.
fn form(body: &FreeBody) -> Form {
    match (body.float_height_m, body.half_m) {
        (Some(height_m), _) => Form::Level { height_m },
        (None, Some(half_m)) => Form::Level { height_m: 2.0 * half_m.z },
        (None, None) => Form::Spheroid { across_m: body.radius_m, along_m: body.radius_m },
    }
}

fn skin_turn_drag(diameter: f64, length: f64) -> f64 {
    let radius = diameter / 2.0;
    SKIN_DRAG * std::f64::consts::PI * diameter * length * (radius * radius * radius)
}

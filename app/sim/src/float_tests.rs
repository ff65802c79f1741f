//! Floats against sums over their points, closed formulas of naval architecture, and their own potential.

use super::*;
use glam::DQuat;

const SPHERE: Form = Form::Spheroid { across_m: 0.2, along_m: 0.2 };
const EGG: Form = Form::Spheroid { across_m: 0.16, along_m: 0.29 };
const STAFF: Form = Form::Cylinder { radius_m: 0.02, length_m: 3.4 };
const DRUM: Form = Form::Cylinder { radius_m: 0.15, length_m: 0.4 };

fn tilted(angle: f64) -> DVec3 {
    DQuat::from_rotation_x(angle) * DVec3::Z
}

/// Wet share and mean place times share, summed over points spread evenly over the volume.
fn summed(form: Form, height: f64, axis: DVec3) -> (f64, DVec3) {
    let turn = DQuat::from_rotation_arc(DVec3::Z, axis);
    let (slices, rings, spokes) = (160, 40, 48);
    let (mut share, mut moment, mut all) = (0.0, DVec3::ZERO, 0.0);
    for slice in 0..slices {
        let t = (f64::from(slice) + 0.5) / f64::from(slices) * 2.0 - 1.0;
        let (z, radius) = match form {
            Form::Spheroid { across_m, along_m } => (t * along_m, across_m * (1.0 - t * t).sqrt()),
            Form::Cylinder { radius_m, length_m } => (0.5 * t * length_m, radius_m),
            Form::Level { height_m } => (0.5 * t * height_m, 1.0),
        };
        for cell in 0..rings * spokes {
            let r = radius * ((f64::from(cell / spokes) + 0.5) / f64::from(rings)).sqrt();
            let around = 2.0 * PI * (f64::from(cell % spokes) + 0.5) / f64::from(spokes);
            let place = turn * DVec3::new(r * libm::cos(around), r * libm::sin(around), z);
            let weight = radius * radius;
            all += weight;
            if height + place.z < 0.0 {
                share += weight;
                moment += place * weight;
            }
        }
    }
    (share / all, moment / all)
}

#[test]
fn share_and_moment_are_those_of_the_points_under_water() {
    for form in [SPHERE, EGG, STAFF, DRUM] {
        for angle in [0.0, 0.02, 0.4, 1.1, 1.5, 0.5 * PI, 2.6] {
            let axis = tilted(angle);
            for part in [-0.8, -0.3, 0.05, 0.6] {
                let height = part * form.reach_m(axis);
                let (wet, (share, moment)) = (form.wet(height, axis), summed(form, height, axis));
                assert!(
                    (wet.share - share).abs() < 0.008,
                    "{form:?} {angle} {part}: {} for {share}",
                    wet.share
                );
                let off = (wet.moment - moment).length();
                assert!(
                    off < 0.008 * form.reach_m(axis).max(0.02),
                    "{form:?} {angle} {part}: {} for {moment}",
                    wet.moment
                );
            }
        }
    }
}

/// Share and moment are derivatives of one potential: `dW/dz = -share`, and along a tilt the moment crossed with up.
#[test]
fn a_float_gains_nothing_by_rolling() {
    for form in [SPHERE, EGG, STAFF, DRUM] {
        for angle in [0.01, 0.3, 0.9, 1.3, 1.5, 1.565, 1.5703] {
            let axis = tilted(angle);
            for part in [-0.7, 0.0, 0.4] {
                let height = part * form.reach_m(axis);
                let (d, at) = (1e-6, |height: f64, angle: f64| form.wet(height, tilted(angle)));
                // Mixed derivatives agree: how the share changes with tilt, and the turning moment with height.
                let by_tilt =
                    (at(height, angle + d).share - at(height, angle - d).share) / (2.0 * d);
                let turning = |height: f64| at(height, angle).moment.cross(DVec3::Z).x;
                let by_height = (turning(height + d) - turning(height - d)) / (2.0 * d);
                assert!(
                    (by_tilt - by_height).abs() < 2e-4 * (1.0 + by_tilt.abs()),
                    "{form:?} {angle} {part}: {by_tilt} {by_height}"
                );
                let slope = (at(height - d, angle).share - at(height + d, angle).share) / (2.0 * d);
                let expected = at(height, angle).slope;
                assert!(
                    (slope - expected).abs() < 1e-4 * expected,
                    "{form:?} {angle} {part}: {slope} {expected}"
                );
            }
        }
    }
}

/// `V_wet = π d² (3R - d)/3` at draft `d`.
#[test]
fn a_sphere_displaces_its_cap() {
    for draft in [0.01, 0.1, 0.2, 0.37] {
        let cap = draft * draft * (0.6 - draft) / 3.0 / (4.0 / 3.0 * 0.2 * 0.2 * 0.2);
        assert!((SPHERE.wet(0.2 - draft, DVec3::Z).share - cap).abs() < 1e-14);
    }
}

/// Share under water of a float's outline across a level flow, summed over a grid of lines along the flow that meet it.
fn outline_under_water(form: Form, height: f64, axis: DVec3, along_flow: DVec3) -> f64 {
    let Form::Spheroid { across_m, along_m } = form else { panic!("{form:?}") };
    let stretch = DVec3::new(1.0 / across_m, 1.0 / across_m, 1.0 / along_m);
    let to_ball = |v: DVec3| stretch * (DQuat::from_rotation_arc(axis, DVec3::Z) * v);
    let (side, reach) = (along_flow.cross(DVec3::Z), across_m.max(along_m));
    let (mut under, mut all, cells) = (0.0, 0.0, 600);
    let at = |cell: i32| (f64::from(cell) + 0.5) / f64::from(cells) * 2.0 * reach - reach;
    for (row, column) in (0..cells).flat_map(|row| (0..cells).map(move |column| (row, column))) {
        let place = to_ball(DVec3::Z * at(row) + side * at(column));
        let ray = to_ball(along_flow).normalize();
        if (place - place.dot(ray) * ray).length() < 1.0 {
            all += 1.0;
            under += f64::from(u8::from(height + at(row) < 0.0));
        }
    }
    under / all
}

#[test]
fn what_faces_the_flow_is_the_outline_under_water() {
    for (form, angle) in [(SPHERE, 0.0), (EGG, 0.0), (EGG, 0.7), (EGG, 0.5 * PI)] {
        for part in [-0.7, 0.1, 0.8] {
            let axis = tilted(angle);
            let height = part * form.reach_m(axis);
            let facing = form.wet(height, axis).facing;
            for along in [DVec3::X, DVec3::Y, DVec3::new(0.6, 0.8, 0.0)] {
                let sum = outline_under_water(form, height, axis, along);
                assert!((facing - sum).abs() < 0.004, "{form:?} {angle} {part}: {facing}, {sum}");
            }
        }
    }
}

/// An upright cylinder heeled by a little is turned back by its waterplane: `ρ g π r⁴/4` a radian about its middle,
/// and its buoyancy from below adds its own part (the wall-sided formula).
#[test]
fn an_upright_cylinder_rights_itself_by_its_waterplane() {
    let (radius, length, angle) = (0.15, 0.4, 1e-4);
    let wet = DRUM.wet(0.05, tilted(angle));
    let (share, area) = (0.5 - 0.05 / length, PI * radius * radius);
    let volume = area * length;
    assert!((wet.share - share).abs() < 1e-9);
    // From the middle, the wet part's own middle lies below by half of what is dry.
    let below = 0.5 * (1.0 - share) * length;
    let expected = (-PI * radius * radius * radius * radius / 4.0 / volume + share * below) * angle;
    let turning = wet.moment.cross(DVec3::Z).x;
    assert!((turning / expected - 1.0).abs() < 1e-6, "{turning} for {expected}");
}

#[test]
fn a_level_float_goes_under_evenly() {
    let wet = Form::Level { height_m: 0.25 }.wet(0.05, tilted(0.7));
    assert!(
        (wet.share - 0.3).abs() < 1e-15
            && (wet.slope - 4.0).abs() < 1e-15
            && wet.moment == DVec3::ZERO
    );
}

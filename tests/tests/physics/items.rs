//! Items of the gear library, against tables and measurements: weight, strength, inertia, buoyancy, drag.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{library, report, root, spec};
use endline_gear::{BuoyShape, Library, Sources, box_inertia, buoy_floats, shell_inertia};

use endline_sim::DVec3;

use std::f64::consts::FRAC_PI_4;

/// Wet weight in sea water [N/m] and strength [kN] of the size tables the ropes were taken from.
#[test]
fn ropes_weigh_and_hold_what_the_tables_say() {
    let library = library();
    for (id, wet, strength) in [
        ("pp-5-16", -0.033, 7.61),
        ("pp-3-8", -0.052, 10.85),
        ("pp-7-16", -0.070, 14.06),
        ("pp-1-2", -0.087, 16.81),
        ("pp-9-16", -0.113, 20.46),
        ("pp-5-8", -0.138, 24.91),
        ("polysteel-3-8", -0.044, 14.1),
        ("sink-5-16", 0.069, 8.32),
        ("sink-3-8", 0.065, 12.01),
        ("sink-7-16", 0.076, 15.57),
        ("sink-1-2", 0.132, 19.57),
        ("sink-9-16", 0.150, 23.13),
        ("sink-5-8", 0.154, 27.13),
        ("nylon-3-8", 0.052, 14.86),
        ("sink-103-3-8", 0.002, 12.01),
    ] {
        let rope = library.ropes.iter().find(|rope| rope.entry.id == id).unwrap();
        assert!((rope.wet_weight_n_m() - wet).abs() < 1e-3, "{id}: {}", rope.wet_weight_n_m());
        assert!((rope.strength_n / 1e3 - strength).abs() < 0.02, "{id}: {}", rope.strength_n);
    }
}

/// Against the sum over a fine grid of points on the six faces, each of the same mass by area.
#[test]
fn a_hollow_box_turns_as_its_faces_do() {
    let (mass, size) = (18.0, DVec3::new(0.91, 0.53, 0.36));
    let area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
    let mut inertia = DVec3::ZERO;
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let (cells, point_area) = (200, size[u] * size[v] / 40_000.0);
        for cell in 0..cells * cells {
            let mut place = DVec3::ZERO;
            place[axis] = size[axis] / 2.0;
            place[u] = ((f64::from(cell % cells) + 0.5) / f64::from(cells) - 0.5) * size[u];
            place[v] = ((f64::from(cell / cells) + 0.5) / f64::from(cells) - 0.5) * size[v];
            let square = place * place;
            inertia +=
                (DVec3::splat(square.element_sum()) - square) * (2.0 * mass * point_area / area);
        }
    }
    let formula = shell_inertia(mass, size);
    assert!(
        ((formula - inertia) / inertia).abs().max_element() < 1e-4,
        "{formula} against {inertia}"
    );
    let cube = shell_inertia(6.0, DVec3::splat(2.0));
    assert!(
        (cube - DVec3::splat(6.0 * 4.0 * 5.0 / 18.0)).abs().max_element() < 1e-12,
        "hollow cube: 5/18 m a²"
    );
}

#[test]
fn a_buoys_slices_hold_its_volume_about_its_middle() {
    for buoy in &library().buoys {
        let floats = buoy_floats(buoy);
        let own = &floats[..floats.len() - buoy.pieces.len()];
        let sum: f64 = own.iter().map(|float| float.volume_m3).sum();
        assert!((sum / buoy.volume_m3 - 1.0).abs() < 1e-12, "{}: {sum}", buoy.entry.id);
        let middle = own.iter().map(|float| float.volume_m3 * float.offset_m.z).sum::<f64>() / sum;
        let weights = buoy.pieces.iter().map(|piece| piece.mass_kg * (piece.at_m + middle));
        let moment = weights.sum::<f64>() + buoy.mass_kg * (buoy.centre_of_mass_m + middle);
        assert!(moment.abs() < 1e-12 * buoy.whole_mass_kg(), "{}: {moment}", buoy.entry.id);
        let drag = own.iter().map(|float| float.drag_area_m2.x).sum::<f64>();
        let side = if buoy.shape == BuoyShape::Sphere {
            FRAC_PI_4 * buoy.diameter_m
        } else {
            buoy.length_m
        };
        assert!(
            (drag / (buoy.drag_across * buoy.diameter_m * side) - 1.0).abs() < 1e-12,
            "{}: {drag}",
            buoy.entry.id
        );
    }
}

/// A towed lobster trap's drag was measured: 158 N at 1 m/s. Broadside, within the 30 % of that test.
#[test]
fn a_trap_drags_as_the_towed_one_did() {
    let spec = spec("hello-endline", &[]);
    let trap = spec.bodies.iter().find(|body| body.id == "trap").unwrap();
    let drag = 0.5 * 1025.0 * trap.whole_drag_area_m2().y;
    assert!((drag / 158.0 - 1.0).abs() < 0.3, "{drag}");
}

#[test]
fn a_trap_in_sea_water_weighs_its_wet_weight_and_stands_on_the_seabed() {
    let spec = spec("hello-endline", &[]);
    let trap = spec.bodies.iter().find(|body| body.id == "trap").unwrap();
    let displaced: f64 = trap.floats.iter().map(|float| float.volume_m3).sum();
    assert!(((trap.mass_kg - 1025.0 * displaced) * 9.81 - 130.0).abs() < 1e-9);
    let lowest = trap
        .feet_m
        .iter()
        .map(|foot| (trap.position_m + trap.orientation * *foot).z)
        .fold(f64::INFINITY, f64::min);
    assert!((lowest + 25.0).abs() < 1e-12, "{lowest}");
    assert_eq!(trap.feet_m.len(), 8);
}

/// Ballast lowers the centre of mass and turns with the shell as two bodies do (parallel axes); wire, ballast and foam
/// displace what the whole does.
#[test]
fn a_trap_is_a_shell_with_ballast_on_its_floor() {
    for trap in library().traps.iter() {
        let size = DVec3::from_array(trap.size_m);
        let (shell, low) = (trap.mass_kg - trap.ballast_kg, trap.ballast_height_m - size.z / 2.0);
        let centre = trap.ballast_kg * low / trap.mass_kg;
        assert!(centre < -0.02, "{}: centre of mass {centre} m above the middle", trap.entry.id);
        let reduced = shell * trap.ballast_kg / trap.mass_kg * low * low;
        let plate = DVec3::new(size.y * size.y, size.x * size.x, size.x * size.x + size.y * size.y)
            * (trap.ballast_kg / 12.0);
        let expected = shell_inertia(shell, size) + plate + DVec3::new(reduced, reduced, 0.0);
        assert!(
            ((box_inertia(trap) - expected) / expected).abs().max_element() < 1e-12,
            "{}",
            trap.entry.id
        );
        let parts = trap.wire_m3() + trap.ballast_m3() + trap.foam_m3;
        assert!(
            (parts / trap.displaced_m3() - 1.0).abs() < 1e-12 && trap.wire_m3() > 0.0,
            "{}",
            trap.entry.id
        );
        // What is left to the wire is no lighter than wet wood and no heavier than steel.
        let wire = shell / trap.wire_m3();
        assert!((1000.0..8000.0).contains(&wire), "{}: {wire} kg/m3", trap.entry.id);
    }
}

#[test]
fn ballast_and_pieces_that_are_impossible_are_reported() {
    let message_of = |path: &str, from: &str, to: &str| {
        let mut sources = Sources::from_folder(&root()).unwrap();
        let text = sources.get(path).unwrap().to_owned();
        assert!(text.contains(from), "{path}: {from}");
        sources.set(path, text.replacen(from, to, 1));
        let problems = Library::read(&sources).1;
        assert!(
            problems.len() == 1 && problems[0].file == path && problems[0].line > 1,
            "{to}: {}",
            report(&problems)
        );
        problems[0].to_string()
    };
    let (trap, flyer) = ("traps/wire-lobster-3ft.toml", "buoys/high-flyer.toml");
    for (path, from, to, part) in [
        (trap, "\"6.6 kg\"", "\"30 kg\"", "`ballast` 30 kg is not below the `mass`"),
        (
            trap,
            "\"6.6 kg\"",
            "\"11 kg\"",
            "ballast and foam displace 5.50 L, more than the 4.77 L of the body",
        ),
        (trap, "\"0.03 m\"", "\"0.4 m\"", "`ballast_height` 0.4 m is above the box"),
        (
            flyer,
            "\"0.1 m\"\nlength",
            "\"0.1 kg\"\nlength",
            "`kg` is a unit of a mass, not of a length",
        ),
        (flyer, "\"0.9 L\"", "\"9 L\"", "`volume` 9 L exceeds the 1.18 L of the cylinder"),
        (flyer, "\"7 kg\"", "\"70 kg\"", "does not carry the mass"),
    ] {
        let message = message_of(path, from, to);
        assert!(message.contains(part), "{message}");
    }
}

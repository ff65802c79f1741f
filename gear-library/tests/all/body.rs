//! The whale's mesh compared with its tables and with the built-in form, and its fins with their published ranges.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::f64::consts::PI;
use std::path::Path;

use endline_gear::whale::fin::smallest_radius;
use endline_gear::whale::{Station, WhaleForm, build_skin};
use endline_gear::{Library, Sources, WhaleItem};
use endline_sdk::{BodyPart, Region};
use endline_sim::DVec3;
use endline_sim::whale::{Mark, Measures, Skin};

const LENGTHS_M: [f64; 3] = [4.2, 10.0, 13.7];

fn whale(id: &str) -> WhaleItem {
    let sources = Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    Library::read(&sources).0.whales.into_iter().find(|whale| whale.entry.id == id).unwrap()
}

/// The cut through a skin at a share of length from the snout, to port and up [m]; without fins, except the midline between the flukes.
fn cut(skin: &Skin, length_m: f64, at: f64) -> Vec<[f64; 2]> {
    let x = (0.5 - at) * length_m;
    let fin = |region: Region| {
        !matches!(region.part(), BodyPart::Head | BodyPart::Body | BodyPart::Peduncle)
    };
    let mut points = Vec::new();
    for (triangle, region) in skin.triangles.iter().zip(&skin.regions) {
        for edge in 0..3 {
            let [a, b] = [triangle[edge], triangle[(edge + 1) % 3]]
                .map(|corner| skin.vertices[corner as usize]);
            let left_out = fin(*region) && (a.y != 0.0 || b.y != 0.0);
            if !left_out && (a.x - x) * (b.x - x) <= 0.0 && (a.x - b.x).abs() > 1e-12 {
                let place = a.lerp(b, (x - a.x) / (b.x - a.x));
                points.push([place.y, place.z]);
            }
        }
    }
    points
}

/// Width, height and girth (length of a taut tape) of a cut [m].
fn measured(points: &[[f64; 2]]) -> [f64; 3] {
    let reach = |axis: usize| {
        points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
            [low.min(p[axis]), high.max(p[axis])]
        })
    };
    let [[left, right], [low, high]] = [reach(0), reach(1)];
    // The tape's length is the mean over all directions of the cut's width, times π (Cauchy).
    let directions = 720;
    let width = |turn: f64| {
        let along = points.iter().map(|p| p[0] * turn.cos() + p[1] * turn.sin());
        let [least, most] = along
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], a| [low.min(a), high.max(a)]);
        most - least
    };
    let girth = (0..directions)
        .map(|step| width(PI * f64::from(step) / f64::from(directions)))
        .sum::<f64>()
        * PI
        / f64::from(directions);
    [right - left, high - low, girth]
}

/// Width, height and girth of an ellipse (Ramanujan) [m].
fn ellipse(form: &WhaleForm, station: &Station) -> [f64; 3] {
    let scale = form.breadth_scale * form.length_m;
    let (width, height) = (station.width * scale, (station.dorsal - station.ventral) * scale);
    let (a, b) = (width / 2.0, height / 2.0);
    let h = ((a - b) / (a + b)).powi(2);
    [width, height, PI * (a + b) * (1.0 + 3.0 * h / (10.0 + (4.0 - 3.0 * h).sqrt()))]
}

/// Width, height and girth of the table (facts 4.2) at every 5 % of length, at three lengths, within 2 %.
///
/// Aft of 0.87 the flukes begin: only the height is compared there. The ends are rounded.
#[test]
fn every_section_is_that_of_the_table() {
    for length_m in LENGTHS_M {
        let form = whale("right-whale").form_at(length_m);
        let skin = build_skin(&form);
        for station in form.stations.iter().filter(|station| (0.04..0.97).contains(&station.at)) {
            let found = measured(&cut(&skin, length_m, station.at));
            for (measure, (found, table)) in found.iter().zip(ellipse(&form, station)).enumerate() {
                let asked = station.at < 0.87 || measure == 1;
                let name = ["width", "height", "girth"][measure];
                assert!(
                    !asked || (found / table - 1.0).abs() < 0.02,
                    "{length_m} m, {} at {}: {found} against {table}",
                    name,
                    station.at
                );
            }
        }
    }
}

/// Published values of the table: stacked ellipses have a volume of 0.01877 L³ and a skin of 0.445 L², without fins and mouth.
#[test]
fn the_body_holds_and_wets_what_its_table_does() {
    let form = WhaleForm { breadth_scale: 1.0, ..whale("right-whale").form_at(10.0) };
    let skin = build_skin(&form);
    let inside = |corner: &u32| matches!(skin.marks[*corner as usize], Mark::Mouth | Mark::Baleen);
    let body = |region: Region| {
        matches!(region.part(), BodyPart::Head | BodyPart::Body | BodyPart::Peduncle)
    };
    let area: f64 = (skin.triangles.iter().zip(&skin.regions))
        .filter(|(corners, region)| body(**region) && !corners.iter().all(inside))
        .map(|(corners, _)| {
            let [a, b, c] = corners.map(|corner| skin.vertices[corner as usize]);
            (b - a).cross(c - a).length() / 2.0
        })
        .sum();
    // The flukes replace the last 13 % of the body, a fortieth of its skin, and cover the roots of the fins.
    assert!((area / 44.5 - 1.0).abs() < 0.05, "{area} m² against 44.5");
}

fn reach(skin: &Skin, part: BodyPart, along: DVec3) -> [f64; 2] {
    let own = skin.triangles.iter().zip(&skin.regions).filter(|(_, region)| region.part() == part);
    let places = own
        .flat_map(|(triangle, _)| triangle.map(|corner| skin.vertices[corner as usize].dot(along)));
    places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], place| {
        [low.min(place), high.max(place)]
    })
}

/// Flipper length 0.15 to 0.18 L, greatest chord 0.08 to 0.10 L; fluke span 0.36 to 0.42 L, root chord 0.09 to 0.11 L (facts 4.5).
#[test]
fn fins_are_as_long_and_wide_as_written() {
    for length_m in LENGTHS_M {
        let form = whale("right-whale").form_at(length_m);
        let skin = build_skin(&form);
        let (sweep, droop) = (form.flippers.sweep, form.flippers.droop);
        let along = DVec3::new(-sweep.sin() * droop.cos(), sweep.cos() * droop.cos(), -droop.sin());
        let chord = DVec3::new(sweep.cos(), sweep.sin(), 0.0);
        let tip = reach(&skin, BodyPart::LeftFlipper, along)[1];
        let own = skin
            .triangles
            .iter()
            .zip(&skin.regions)
            .filter(|(_, region)| region.part() == BodyPart::LeftFlipper);
        let outer =
            own.flat_map(|(corners, _)| corners.map(|corner| skin.vertices[corner as usize]));
        let outer =
            outer.filter(|place| tip - place.dot(along) < 0.6 * form.flippers.span * length_m);
        let [aft, fore] = outer.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], place| {
            [low.min(place.dot(chord)), high.max(place.dot(chord))]
        });
        let root = form.flippers.insertion;
        let [insertion, blade] = [flank(&skin, length_m, root).dot(along), (fore - aft) / length_m];
        let flipper = (tip - insertion) / length_m;
        assert!((0.15..=0.18).contains(&flipper), "flipper of {flipper} L");
        assert!((0.08..=0.10).contains(&blade), "flipper chord of {blade} L");
        let span = 2.0 * reach(&skin, BodyPart::LeftFluke, DVec3::Y)[1] / length_m;
        assert!((0.36..=0.42).contains(&span), "fluke span of {span} L");
        assert!((0.09..=0.11).contains(&form.flukes.root_chord));
        // The notch is where the midline ends.
        let notch = skin
            .vertices
            .iter()
            .filter(|place| place.y == 0.0)
            .map(|place| place.x)
            .fold(f64::INFINITY, f64::min);
        assert!(
            (notch + length_m / 2.0).abs() < 0.01 * length_m,
            "notch at {notch} m, {} m behind mid-body",
            length_m / 2.0
        );
    }
}

/// The place of the body's port side at the flipper's insertion [m].
fn flank(skin: &Skin, length_m: f64, at: f64) -> DVec3 {
    let points = cut(skin, length_m, at);
    let outer = points
        .iter()
        .filter(|p| (p[1] / length_m + 0.047).abs() < 0.01)
        .map(|p| p[0])
        .fold(f64::NEG_INFINITY, f64::max);
    DVec3::new((0.5 - at) * length_m, outer, -0.047 * length_m)
}

/// The skin displaces the mass of the law and the condition within 2 %: 36.4 t at 13.7 m (Christiansen et al. 2019 give 36 t).
#[test]
fn the_skin_displaces_the_mass_it_should() {
    let right_whales = LENGTHS_M.into_iter().flat_map(|length_m| {
        [1.0, 0.72, 1.3].map(|condition| ("right-whale", condition, length_m))
    });
    for (id, condition, length_m) in
        right_whales.chain([("humpback", 1.0, 11.6), ("humpback", 1.0, 8.5)])
    {
        let item = whale(id);
        let wanted = item.growth.mass.unwrap().mass_kg(length_m) * condition;
        let found =
            Measures::of(&item.skin_for(length_m, condition, false), item.density_kg_m3).mass_kg;
        assert!(
            (found / wanted - 1.0).abs() < 0.02,
            "{id} of {length_m} m in condition {condition}: {found} kg against {wanted}"
        );
    }
    let grown = whale("right-whale").growth.mass.unwrap().mass_kg(13.7);
    assert!((grown / 36_400.0 - 1.0).abs() < 0.01, "{grown}");
}

/// Late pregnancy adds 5 to 10 % to the widths from 0.5 to 0.7 of length, and nothing to head and flukes (facts 4.3).
#[test]
fn a_pregnant_whale_is_wider_amidships() {
    let item = whale("right-whale");
    let [lean, full] = [false, true].map(|pregnant| item.skin_for(13.7, 1.0, pregnant));
    let wider =
        |at: f64| measured(&cut(&full, 13.7, at))[0] / measured(&cut(&lean, 13.7, at))[0] - 1.0;
    assert!(
        (0.04..0.11).contains(&wider(0.55)) && (0.04..0.11).contains(&wider(0.65)),
        "{} {}",
        wider(0.55),
        wider(0.65)
    );
    assert!(wider(0.1).abs() < 1e-9 && wider(0.85).abs() < 1e-9);
}

/// Head of a calf: mouth 0.2345 L - 0.184 m, width at a tenth of length 0.157 L - 0.106 m, both over its breadth.
#[test]
fn a_calf_has_the_head_of_a_calf() {
    let form = whale("right-whale").form_at(4.2);
    assert!((form.head.mouth * 4.2 - (0.2345 * 4.2 - 0.184)).abs() < 1e-9);
    let width =
        form.stations.iter().find(|station| (station.at - 0.1).abs() < 1e-9).unwrap().width * 4.2;
    assert!((width - (0.157 * 4.2 - 0.106)).abs() < 1e-9, "{width}");
}

/// Moore et al. 2005 as tabulated in facts 4.1.
#[test]
fn length_follows_age() {
    let law = whale("right-whale").growth.age.unwrap();
    for (years, length_m) in
        [(1.0, 10.11), (2.0, 11.08), (5.0, 12.35), (10.0, 13.32), (20.0, 14.28)]
    {
        assert!((law.length_m(years * 365.25 * 86_400.0) - length_m).abs() < 0.01, "{years} years");
    }
}

/// Edges of flippers and flukes as sharp as 1 to 3 cm on a grown whale, measured on the mesh, and in proportion on others.
#[test]
fn the_fins_edges_are_as_round_as_written() {
    for (id, grown_m, lengths_m) in
        [("right-whale", 13.7, &LENGTHS_M[..]), ("humpback", 11.6, &[8.5, 11.6])]
    {
        for length_m in lengths_m {
            let skin = whale(id).skin_at(*length_m);
            for part in [
                BodyPart::LeftFlipper,
                BodyPart::RightFlipper,
                BodyPart::LeftFluke,
                BodyPart::RightFluke,
            ] {
                let (radius, place) =
                    smallest_radius(&skin, |region| region.part() == part).unwrap();
                let grown = radius * grown_m / length_m;
                println!(
                    "{id} of {length_m} m, {}: {:.1} mm at {place:.2}",
                    part.name(),
                    1000.0 * radius
                );
                assert!(
                    (0.010..=0.030).contains(&grown),
                    "{id} of {length_m} m: {radius} m on the {} at {place}",
                    part.name()
                );
            }
        }
    }
}

#[test]
fn the_file_and_the_built_in_form_give_the_same_skin() {
    let whale = whale("right-whale");
    let from_file = build_skin(&whale.form);
    let built_in = build_skin(&WhaleForm::right_whale(whale.form.length_m));
    assert_eq!(from_file.triangles, built_in.triangles);
    for (filed, built) in from_file.vertices.iter().zip(&built_in.vertices) {
        assert!(filed.distance(*built) < 0.001, "{filed} in the file, {built} built in");
    }
}

//! `endline render --out FILE.glb`: a run in motion, read back by a reader of glTF and held against the run's own summary.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use glam::{DQuat, DVec3};

use crate::common::{Place, text};

/// Rows of an accessor.
fn rows(gltf: &gltf::Gltf, accessor: &gltf::Accessor<'_>) -> Vec<Vec<f64>> {
    let blob = gltf.blob.as_ref().unwrap();
    let view = accessor.view().unwrap();
    let columns = accessor.dimensions().multiplicity();
    let start = view.offset() + accessor.offset();
    let number = |at: usize| f64::from(f32::from_le_bytes(blob[at..at + 4].try_into().unwrap()));
    let cell = |row: usize, column: usize| number(start + 4 * (row * columns + column));
    (0..accessor.count())
        .map(|row| (0..columns).map(|column| cell(row, column)).collect())
        .collect()
}

/// From y up to z up.
fn back(place: &[f64]) -> DVec3 {
    DVec3::new(place[0], -place[2], place[1])
}

/// What a node's channel of one kind holds at the last frame.
fn last(gltf: &gltf::Gltf, name: &str, kind: gltf::animation::Property) -> Vec<f64> {
    let animation = gltf.animations().next().unwrap();
    let channel = animation
        .channels()
        .find(|channel| {
            channel.target().node().name() == Some(name) && channel.target().property() == kind
        })
        .unwrap_or_else(|| panic!("{name} has no {kind:?}"));
    rows(gltf, &channel.sampler().output()).pop().unwrap()
}

/// Places of a mesh's vertices at the last frame, as its node stands.
fn bent(gltf: &gltf::Gltf, name: &str) -> Vec<DVec3> {
    let node = gltf.nodes().find(|node| node.name() == Some(name)).unwrap();
    let primitive = node.mesh().unwrap().primitives().next().unwrap();
    let base = rows(gltf, &primitive.get(&gltf::Semantic::Positions).unwrap());
    let target = primitive.morph_targets().last().unwrap().positions().unwrap();
    let by = rows(gltf, &target);
    base.iter().zip(by).map(|(base, by)| back(base) + back(&by)).collect()
}

#[test]
fn an_animated_model_has_bodies_lines_and_whale_where_the_run_has_them() {
    use gltf::animation::Property::{Rotation, Translation};
    let place = Place::new("animation");
    let scenario = place.encounter();
    let out = place.path("run.glb");
    place.endline(&["render", &scenario, "--out", &text(&out), "--fps", "4"]).done();
    let run = place.endline(&["run", &scenario, "--json"]).done().json();
    let gltf = gltf::Gltf::from_slice(&std::fs::read(&out).unwrap()).unwrap();

    // Ten spans of a quarter of a second.
    let times = gltf.animations().next().unwrap().samplers().next().unwrap().input();
    let times = rows(&gltf, &times);
    assert_eq!((times.len(), times[10][0].to_bits()), (11, 2.5_f64.to_bits()));

    let mut ends = Vec::new();
    for body in run["bodies"].as_array().unwrap() {
        let name = body["id"].as_str().unwrap();
        let simulated: Vec<f64> = body["position_m"]
            .as_array()
            .unwrap()
            .iter()
            .map(|part| part.as_f64().unwrap())
            .collect();
        let there = back(&last(&gltf, name, Translation));
        assert!(
            there.distance(DVec3::from_slice(&simulated)) < 1e-5,
            "{name}: {there} and {simulated:?}"
        );
        ends.push(there);
    }

    // Each line begins and ends at a body or at the other line: its last places are not those of its first frame.
    let ring = |places: &[DVec3]| places.iter().sum::<DVec3>() / places.len() as f64;
    for name in ["endline-bottom", "endline-top"] {
        let places = bent(&gltf, name);
        let (first, end) = (ring(&places[..6]), ring(&places[places.len() - 6..]));
        let near =
            |place: DVec3| ends.iter().map(|end| end.distance(place)).fold(f64::MAX, f64::min);
        assert!(near(first).min(near(end)) < 0.8, "{name}: {first}, {end}; bodies {ends:?}");
    }

    // The whale is 13.7 m long along its own turned axis.
    let turn = last(&gltf, "whale", Rotation);
    let turn = DQuat::from_xyzw(turn[0], -turn[2], turn[1], turn[3]);
    assert!((turn.length() - 1.0).abs() < 1e-5);
    let along: Vec<f64> = bent(&gltf, "whale").iter().map(|place| place.x).collect();
    let least = along.iter().copied().fold(f64::MAX, f64::min);
    let most = along.iter().copied().fold(f64::MIN, f64::max);
    assert!((13.0..15.5).contains(&(most - least)), "{}", most - least);
}

#[test]
fn an_empty_stretch_and_an_unknown_ending_are_reported() {
    let place = Place::new("animation-wrong");
    let scenario = place.short_scenario("hello-endline", "1 s");
    place
        .endline(&["render", &scenario, "--out", "x.glb", "--from", "0.9s", "--to", "3s"])
        .fails(2, &["no stretch of a run from 0 to 1.00 s"]);
    place
        .endline(&["render", &scenario, "--out", "x.stl", "--from", "0s", "--to", "1s"])
        .fails(2, &[".webm or .glb"]);
}

//! Cost of posing and skinning a right whale: `cargo bench -p endline-gear --bench skin`.
//!
//! Every step of a run poses the whale twice; only the view places the whole skin: contact places the vertices
//! near rope (`docs/whale.md`).

#![allow(clippy::expect_used, reason = "a benchmark says what it needs")]

use std::path::Path;
use std::sync::Arc;

use divan::Bencher;
use divan::counter::ItemsCount;
use endline_gear::whale::build_skin;
use endline_gear::whale::gltf::{About, Form, read, write};
use endline_gear::{Library, Sources, WhaleItem};
use endline_sim::whale::{SkinTree, pose, skin_all};
use glam::{DQuat, DVec3};

fn main() {
    divan::main();
}

fn whale() -> WhaleItem {
    let sources =
        Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the gear library");
    let (library, _) = Library::read(&sources);
    library
        .whales
        .into_iter()
        .find(|whale| whale.entry.id == "right-whale")
        .expect("the right whale")
}

/// Transforms of all bones from a posture.
#[divan::bench]
fn posing(bencher: Bencher) {
    let whale = whale();
    let (skin, posture) = (whale.skin_at(13.7), whale.joints.ranges.random(1));
    let mut bones = Vec::new();
    let bencher = bencher.counter(ItemsCount::new(skin.bones.len()));
    bencher.bench_local(|| {
        pose(
            &skin,
            DVec3::Z,
            DQuat::IDENTITY,
            divan::black_box(&posture),
            divan::black_box(&mut bones),
        )
    });
}

/// Limits a posture to the joints' ranges, once a step.
#[divan::bench]
fn holding(bencher: Bencher) {
    let ranges = whale().joints.ranges;
    let posture = ranges.random(1);
    bencher.bench_local(|| {
        let mut held = divan::black_box(posture);
        ranges.hold(&mut held)
    });
}

/// Places of all vertices from the bones.
#[divan::bench]
fn skinning(bencher: Bencher) {
    let whale = whale();
    let (skin, posture) = (whale.skin_at(13.7), whale.joints.ranges.random(1));
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(&skin, DVec3::Z, DQuat::IDENTITY, &posture, &mut bones);
    let bencher = bencher.counter(ItemsCount::new(skin.vertices.len()));
    bencher
        .bench_local(|| skin_all(&skin, divan::black_box(&bones), divan::black_box(&mut places)));
}

/// The skin from the whale's measures.
#[divan::bench(sample_count = 20)]
fn building(bencher: Bencher) {
    let form = whale().form_at(13.7);
    bencher.bench_local(|| build_skin(divan::black_box(&form)));
}

/// The tree over the skin for the search of near rope.
#[divan::bench(sample_count = 20)]
fn growing_the_tree(bencher: Bencher) {
    let skin = Arc::new(whale().skin_at(13.7));
    bencher.bench_local(|| SkinTree::new(Arc::clone(divan::black_box(&skin))));
}

/// The skin from a glTF file.
#[divan::bench(sample_count = 20)]
fn reading(bencher: Bencher) {
    let whale = whale();
    let skin = whale.skin_at(13.7);
    let about = About {
        id: "right-whale",
        name: "Right whale",
        length_m: 13.7,
        joints: &whale.joints.ranges,
    };
    let bytes = write(&skin, &about, Form::Binary);
    bencher.bench_local(|| read(divan::black_box(&bytes), &skin));
}

//! What finding contacts costs for 500 segments against the right whale: far, near and wrapped.
//!
//! `cargo run --release -p endline-gear --example detection_cost`

use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Instant;

use endline_gear::whale::bones::Skeleton;
use endline_gear::whale::trunk::Sections;
use endline_gear::whale::{WhaleForm, build_skin};
use endline_sdk::Posture;
use endline_sim::geometry::distance::segment_triangle;
use endline_sim::geometry::sweep::{SweptSegment, safe_fraction};
use endline_sim::whale::{Skin, SkinTree, Surface, pose};
use endline_sim::{DAffine3, DQuat, DVec3};

const SEGMENTS: usize = 500;
const STEPS: usize = 1000;
const DT_S: f64 = 0.001;
const MARGIN_M: f64 = 0.016;
const SEPARATION_M: f64 = 0.000_5;

fn main() {
    let skin = Arc::new(build_skin(&WhaleForm::right_whale(13.7)));
    println!(
        "{} triangles, {} vertices, {} bones",
        skin.triangles.len(),
        skin.vertices.len(),
        skin.bones.len()
    );
    let mut surface = Surface::new(Arc::new(SkinTree::new(skin.clone())));
    let frames: Vec<Vec<DAffine3>> =
        (0..=STEPS).map(|step| bones_at(&skin, step as f64 * DT_S)).collect();
    for (name, rope) in [("far", straight(60.0)), ("near", straight(2.95)), ("wrapped", wrapped())]
    {
        measure(name, &mut surface, &frames, &rope);
    }
}

/// A whale that swims at 2 m/s and beats flukes and flippers.
fn bones_at(skin: &Skin, time: f64) -> Vec<DAffine3> {
    let beat = libm::sin(6.0 * time);
    let posture = Posture {
        spine_pitch: [0.05 * beat; 8],
        fluke_pitch: 0.3 * beat,
        flipper_raise: [0.4 * beat; 2],
        ..Posture::default()
    };
    let mut bones = Vec::new();
    pose(skin, DVec3::new(2.0 * time, 0.0, 0.0), DQuat::IDENTITY, &posture, &mut bones);
    bones
}

/// A node of the rope: rest place in the whale's frame, and the bones it goes with.
type Node = (DVec3, [(u16, f64); 4]);

const RIGID: [(u16, f64); 4] = [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)];

/// An endline that hangs at some distance abreast of the flippers.
fn straight(aside: f64) -> Vec<Node> {
    (0..=SEGMENTS).map(|node| (DVec3::new(1.9, aside, -25.0 + 0.1 * node as f64), RIGID)).collect()
}

/// Five turns of 150 segments about the peduncle just off the skin, the rest away aft.
fn wrapped() -> Vec<Node> {
    let form = WhaleForm::right_whale(13.7);
    let sections = Sections::of(&form);
    let skeleton = Skeleton::of(&form, &sections);
    let coil = |node: usize| {
        let (at, angle) = (0.74 + 0.000_5 * node as f64, 0.21 * node as f64);
        let skin = sections.surface(at, angle % TAU);
        let out = (skin - sections.axis(at)).normalize();
        (skin + out * 0.010, skeleton.along_body(at))
    };
    let (end, carried) = coil(150);
    let tail = |node: usize| (end + DVec3::new(-0.06, 0.0, 0.08) * node as f64, carried);
    (0..=150).map(coil).chain((1..=SEGMENTS - 150).map(tail)).collect()
}

/// The segments over one step.
fn segments(rope: &[Node], start: &[DAffine3], end: &[DAffine3]) -> Vec<SweptSegment> {
    let place = |(rest, weights): &Node, bones: &[DAffine3]| -> DVec3 {
        weights
            .iter()
            .map(|&(bone, weight)| weight * bones[usize::from(bone)].transform_point3(*rest))
            .sum()
    };
    let swept = |pair: &[Node]| SweptSegment {
        a0: place(&pair[0], start),
        b0: place(&pair[1], start),
        a1: place(&pair[0], end),
        b1: place(&pair[1], end),
    };
    rope.windows(2).map(swept).collect()
}

fn measure(name: &str, surface: &mut Surface, frames: &[Vec<DAffine3>], rope: &[Node]) {
    let (mut found, mut gather, mut narrow, mut whole) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut pairs, mut cut) = (0, 0);
    for step in frames.windows(2) {
        let segments = segments(rope, &step[0], &step[1]);
        let from = Instant::now();
        surface.begin(&step[0], &step[1]);
        surface.gather(&segments, MARGIN_M, &mut found);
        gather.push(from.elapsed().as_secs_f64() * 1e6);
        let mut least = f64::INFINITY;
        for candidate in &found {
            let triangle = surface.triangle_at(candidate.triangle, 0.0);
            least = least.min(
                segment_triangle(segments[candidate.segment as usize].at(0.0), triangle).distance,
            );
        }
        narrow.push(from.elapsed().as_secs_f64() * 1e6);
        let mut safe = 1.0_f64;
        for candidate in &found {
            let triangle = surface.triangle_sweep(candidate.triangle);
            safe = safe.min(safe_fraction(
                &segments[candidate.segment as usize],
                &triangle,
                SEPARATION_M,
            ));
        }
        whole.push(from.elapsed().as_secs_f64() * 1e6);
        pairs += found.len();
        cut += usize::from(safe < 1.0);
    }
    let [gather, narrow, whole] = [gather, narrow, whole].map(median);
    println!(
        "{name:8} gather {gather:6.1} us, with distances {narrow:6.1} us, with sweeps {whole:6.1} us, {} pairs a step, {cut} of {STEPS} steps cut",
        pairs / STEPS
    );
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

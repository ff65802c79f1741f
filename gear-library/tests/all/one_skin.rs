//! The whale's skin never passes through itself: at rest, and in postures drawn from the whole range of its joints.
//!
//! Two triangles intersect if an edge of one passes through the other. Broad phase: boxes sorted along the body.
//! Triangles with a common edge can only fold; for those with one common corner the opposite edges are tested.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::path::Path;

use endline_gear::whale::build_skin;
use endline_gear::{Library, Sources, WhaleItem};
use endline_sdk::Posture;
use endline_sim::whale::{Bounds, JointRanges, Skin, pose, skin_all};
use endline_sim::{DQuat, DVec3};

/// Postures drawn for each length.
const POSTURES: u64 = 150;

fn whales() -> Vec<WhaleItem> {
    let sources = Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    Library::read(&sources).0.whales
}

fn posed(skin: &Skin, posture: &Posture) -> Vec<DVec3> {
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(skin, DVec3::ZERO, DQuat::IDENTITY, posture, &mut bones);
    skin_all(skin, &bones, &mut places);
    places
}

#[test]
fn no_skin_passes_through_itself_at_rest() {
    for whale in whales() {
        for length_m in [4.2, 7.0, 10.0, 13.7, 15.0] {
            let skin = build_skin(&whale.form_at(length_m));
            let found = meetings(&skin.vertices, &skin.triangles);
            assert!(
                found.is_empty(),
                "{} of {length_m} m: {}",
                whale.entry.id,
                describe(&skin, &found)
            );
        }
    }
}

#[test]
fn nor_in_any_posture_its_joints_allow() {
    for whale in whales() {
        for length_m in [4.2, 13.7] {
            let skin = build_skin(&whale.form_at(length_m));
            let (mut bad, mut reported) = (0, String::new());
            for seed in 0..POSTURES {
                let posture = drawn(&whale.joints.ranges, seed);
                let found = meetings(&posed(&skin, &posture), &skin.triangles);
                if !found.is_empty() {
                    bad += 1;
                    let limbs = [
                        posture.flipper_sweep,
                        posture.flipper_raise,
                        posture.flipper_twist,
                        posture.lips,
                        [posture.jaw; 2],
                    ];
                    reported = format!(
                        "{reported}seed {seed}: {limbs:.2?}: {}\n",
                        describe(&skin, &found)
                    );
                }
            }
            assert_eq!(
                bad, 0,
                "{} of {length_m} m in {bad} of {POSTURES} postures:\n{reported}",
                whale.entry.id
            );
        }
    }
}

/// Every second posture has its limbs and jaw at an end of their range, where skin is most likely to intersect.
fn drawn(ranges: &JointRanges, seed: u64) -> Posture {
    let mut posture = ranges.random(seed);
    if seed % 2 == 1 {
        let end = |value: f64, least: f64, most: f64| {
            if value - least < most - value { least } else { most }
        };
        for side in 0..2 {
            posture.flipper_sweep[side] = end(
                posture.flipper_sweep[side],
                ranges.least.flipper_sweep[side],
                ranges.most.flipper_sweep[side],
            );
            posture.flipper_raise[side] = end(
                posture.flipper_raise[side],
                ranges.least.flipper_raise[side],
                ranges.most.flipper_raise[side],
            );
            posture.flipper_twist[side] = end(
                posture.flipper_twist[side],
                ranges.least.flipper_twist[side],
                ranges.most.flipper_twist[side],
            );
            posture.lips[side] =
                end(posture.lips[side], ranges.least.lips[side], ranges.most.lips[side]);
        }
        posture.jaw = end(posture.jaw, ranges.least.jaw, ranges.most.jaw);
    }
    posture
}

/// The test detects a fin moved into the body.
#[test]
fn a_fin_in_the_body_is_found() {
    let skin = build_skin(&whales()[0].form_at(13.7));
    let posture = Posture { flipper_sweep: [2.5, 0.0], ..Posture::default() };
    assert!(meetings(&posed(&skin, &posture), &skin.triangles).len() > 20);
}

fn describe(skin: &Skin, found: &[[usize; 2]]) -> String {
    let mut pairs: Vec<String> = found
        .iter()
        .map(|pair| format!("{:?}", pair.map(|triangle| skin.regions[triangle])))
        .collect();
    pairs.sort();
    pairs.dedup();
    format!("{} crossings, of {}", found.len(), pairs.join(" "))
}

/// Pairs of triangles that pass through one another.
fn meetings(places: &[DVec3], triangles: &[[u32; 3]]) -> Vec<[usize; 2]> {
    let boxes: Vec<Bounds> = triangles
        .iter()
        .map(|corners| Bounds::around(&corners.map(|corner| places[corner as usize])))
        .collect();
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    order.sort_by(|&left, &right| boxes[left].low.x.total_cmp(&boxes[right].low.x));
    let mut found = Vec::new();
    for (rank, &one) in order.iter().enumerate() {
        for &other in
            order[rank + 1..].iter().take_while(|&&other| boxes[other].low.x <= boxes[one].high.x)
        {
            if boxes[one].meets(&boxes[other]) && meet(places, [triangles[one], triangles[other]]) {
                found.push([one, other]);
            }
        }
    }
    found
}

fn meet(places: &[DVec3], pair: [[u32; 3]; 2]) -> bool {
    if pair[0].iter().filter(|corner| pair[1].contains(corner)).count() >= 2 {
        return false;
    }
    [[0, 1], [1, 0]].into_iter().any(|[one, other]| {
        (0..3).any(|edge| {
            let ends = [pair[one][edge], pair[one][(edge + 1) % 3]];
            let common = ends.iter().any(|end| pair[other].contains(end));
            !common
                && runs_through(
                    ends.map(|end| places[end as usize]),
                    pair[other].map(|corner| places[corner as usize]),
                )
        })
    })
}

/// Whether a segment passes through a triangle; a coplanar one within rounding does not.
fn runs_through([from, to]: [DVec3; 2], corners: [DVec3; 3]) -> bool {
    let volume = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| (b - a).cross(c - a).dot(d - a);
    let [a, b, c] = corners;
    let (before, after) = (volume(a, b, c, from), volume(a, b, c, to));
    if before.abs() < 1e-12 || after.abs() < 1e-12 || before * after > 0.0 {
        return false;
    }
    let sides = [volume(from, to, a, b), volume(from, to, b, c), volume(from, to, c, a)];
    sides.iter().all(|side| *side > 0.0) || sides.iter().all(|side| *side < 0.0)
}

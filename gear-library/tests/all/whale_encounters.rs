//! Rope against the edges of a thrashing whale's fins: the sweep must stop every crossing that the
//! independent cubic audit finds, with the mesh, the bones and the postures of the program.

use std::sync::Arc;

use endline_gear::whale::{WhaleForm, build_skin};
use endline_sdk::{Posture, Region};
use endline_sim::geometry::crossing::first_meeting;
use endline_sim::geometry::sweep::{SweptSegment, safe_fraction};
use endline_sim::whale::{Candidate, Skin, SkinTree, Surface, pose, skin_vertex};
use endline_sim::{DAffine3, DQuat, DVec3};

/// Encounters that start apart.
const ENCOUNTERS: usize = 20_000;
const SEPARATION_M: f64 = 0.000_5;

/// Repeatable numbers for tests.
struct Dice(u64);

impl Dice {
    /// -1..1.
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() + 1.0) / 2.0
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let point = self.point();
            if (0.01..1.0).contains(&point.length_squared()) {
                return point.normalize();
            }
        }
    }
}

fn posture(dice: &mut Dice) -> Posture {
    let mut some = |scale: f64| scale * dice.next();
    Posture {
        spine_pitch: std::array::from_fn(|_| some(0.15)),
        spine_yaw: std::array::from_fn(|_| some(0.15)),
        fluke_pitch: some(0.7),
        fluke_flex: [some(0.4), some(0.4)],
        flipper_sweep: [some(0.7), some(0.7)],
        flipper_raise: [some(0.7), some(0.7)],
        flipper_twist: [some(0.6), some(0.6)],
        jaw: 0.1 + some(0.1),
        ..Posture::default()
    }
}

/// The posture interpolated between two postures.
fn towards(from: &Posture, to: &Posture, share: f64) -> Posture {
    let go = |from: f64, to: f64| from + share * (to - from);
    let pair = |from: [f64; 2], to: [f64; 2]| [go(from[0], to[0]), go(from[1], to[1])];
    let spine =
        |from: [f64; 8], to: [f64; 8]| std::array::from_fn(|joint| go(from[joint], to[joint]));
    Posture {
        spine_pitch: spine(from.spine_pitch, to.spine_pitch),
        spine_yaw: spine(from.spine_yaw, to.spine_yaw),
        spine_roll: spine(from.spine_roll, to.spine_roll),
        fluke_pitch: go(from.fluke_pitch, to.fluke_pitch),
        fluke_flex: pair(from.fluke_flex, to.fluke_flex),
        flipper_sweep: pair(from.flipper_sweep, to.flipper_sweep),
        flipper_raise: pair(from.flipper_raise, to.flipper_raise),
        flipper_twist: pair(from.flipper_twist, to.flipper_twist),
        flipper_flex: pair(from.flipper_flex, to.flipper_flex),
        jaw: go(from.jaw, to.jaw),
        lips: pair(from.lips, to.lips),
    }
}

/// Bones at the start and at the end of a step of a thrashing, swimming, turning whale.
fn thrash(skin: &Skin, dice: &mut Dice) -> [Vec<DAffine3>; 2] {
    let (from, aim) = (posture(dice), posture(dice));
    let (place, turned) =
        (dice.point() * 20.0, DQuat::from_scaled_axis(dice.direction() * dice.between(0.0, 3.0)));
    let share = dice.between(0.003, 0.02);
    let (moved, turn) = (dice.point() * 0.02, DQuat::from_scaled_axis(dice.point() * 0.01));
    let mut bones = [Vec::new(), Vec::new()];
    pose(skin, place, turned, &from, &mut bones[0]);
    pose(skin, place + moved, turn * turned, &towards(&from, &aim, share), &mut bones[1]);
    bones
}

/// A segment of 5 to 20 cm that at some moment of the step lies within centimetres of a place on the skin.
fn meet(dice: &mut Dice, path: [DVec3; 2]) -> SweptSegment {
    let half = dice.direction() * dice.between(0.025, 0.1);
    let when = dice.between(0.1, 0.9);
    let spot = path[0].lerp(path[1], when) + dice.point() * 0.02 + half * dice.next();
    let across = dice.direction().cross(half).normalize_or(DVec3::Z);
    let own = path[1] - path[0] + across * dice.between(0.01, 0.15);
    let spin = dice.point() * 0.01;
    let (from, to) = (spot - own * when, spot + own * (1.0 - when));
    SweptSegment {
        a0: from - half - spin,
        b0: from + half + spin,
        a1: to - half + spin,
        b1: to + half - spin,
    }
}

/// Vertices on the edges and tips of flippers and flukes.
fn edge_vertices(skin: &Skin) -> Vec<usize> {
    const PLAIN: [Region; 10] = [
        Region::Rostrum,
        Region::Baleen,
        Region::Lips,
        Region::Head,
        Region::Body,
        Region::Peduncle,
        Region::LeftFlipper,
        Region::RightFlipper,
        Region::LeftFluke,
        Region::RightFluke,
    ];
    let on_edges =
        skin.triangles.iter().zip(&skin.regions).filter(|(_, region)| !PLAIN.contains(region));
    on_edges.flat_map(|(corners, _)| corners.map(|corner| corner as usize)).collect()
}

/// Counts of all encounters.
#[derive(Default, Debug)]
struct Seen {
    encounters: usize,
    crossings: usize,
    stopped: usize,
}

#[test]
fn the_sweep_stops_every_crossing_the_audit_finds() {
    let skin = Arc::new(build_skin(&WhaleForm::right_whale(13.7)));
    let edges = edge_vertices(&skin);
    let mut surface = Surface::new(Arc::new(SkinTree::new(skin.clone())));
    let (mut dice, mut found, mut seen) = (Dice(2012), Vec::new(), Seen::default());
    let mut round = 0;
    while seen.encounters < ENCOUNTERS {
        round += 1;
        let [starts, ends] = thrash(&skin, &mut dice);
        let vertex = edges[(dice.between(0.0, 1.0) * edges.len() as f64) as usize % edges.len()];
        let path = [&starts, &ends].map(|bones| skin_vertex(&skin, bones, vertex));
        let segment = meet(&mut dice, path);
        surface.begin(&starts, &ends);
        surface.gather(&[segment], SEPARATION_M, &mut found);
        if round % 100 == 0 {
            nothing_is_left_out(&skin, &mut surface, &segment, &found);
        }
        encounter(&mut surface, &segment, &found, &mut seen);
    }
    assert!(seen.crossings > 10_000, "too few crossings to prove anything: {seen:?}");
    assert!(seen.stopped >= seen.crossings, "{seen:?}");
}

/// The motion limited to its safe fraction meets no triangle, and any crossing is beyond it.
fn encounter(surface: &mut Surface, segment: &SweptSegment, found: &[Candidate], seen: &mut Seen) {
    let (mut safe, mut crossing) = (1.0_f64, f64::INFINITY);
    for candidate in found {
        let triangle = surface.triangle_sweep(candidate.triangle);
        crossing = crossing.min(first_meeting(segment, &triangle).unwrap_or(f64::INFINITY));
        safe = safe.min(safe_fraction(segment, &triangle, SEPARATION_M));
    }
    if crossing <= 0.0 {
        assert!(safe <= 0.0, "a segment that starts crossed may move by {safe}");
        return;
    }
    seen.encounters += 1;
    seen.crossings += usize::from(crossing <= 1.0);
    seen.stopped += usize::from(safe < 1.0);
    assert!(safe < crossing, "safe to {safe}, but it crosses at {crossing}");
    if safe >= 1.0 {
        return;
    }
    let cut = SweptSegment { a1: segment.at(safe)[0], b1: segment.at(safe)[1], ..*segment };
    for candidate in found {
        let [start, _] = surface.triangle_sweep(candidate.triangle);
        let end = surface.triangle_at(candidate.triangle, safe);
        assert_eq!(
            first_meeting(&cut, &[start, end]),
            None,
            "the move cut to {safe} still crosses"
        );
    }
}

/// No triangle outside the candidates is met.
fn nothing_is_left_out(
    skin: &Skin,
    surface: &mut Surface,
    segment: &SweptSegment,
    found: &[Candidate],
) {
    for (triangle, _) in (0_u32..).zip(&skin.triangles) {
        let listed = found.iter().any(|candidate| candidate.triangle == triangle);
        let sweep = surface.triangle_sweep(triangle);
        assert!(
            listed || first_meeting(segment, &sweep).is_none(),
            "triangle {triangle} is met but not listed"
        );
    }
}

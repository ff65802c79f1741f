use endline_sdk::{Posture, Region};
use glam::DQuat;

use super::*;
use crate::geometry::distance::segment_triangle;
use crate::geometry::sweep::triangle_at;
use crate::whale::{Angle, Bone, Channel, Skin, pose, skin_all};

/// Repeatable numbers in -1..1 for tests.
pub(crate) struct Dice(pub u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn point(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

/// A tube 8 m long on eight bones, each vertex moved by up to four of them with uneven weights.
pub(crate) fn tube() -> Skin {
    let (rings, sides) = (60_u32, 12_u32);
    let mut dice = Dice(3);
    let mut skin = Skin::default();
    for ring in 0..rings {
        for side in 0..sides {
            let turn = f64::from(side) * std::f64::consts::TAU / f64::from(sides);
            let along = f64::from(ring) * 8.0 / f64::from(rings);
            skin.vertices.push(DVec3::new(-along, libm::cos(turn), libm::sin(turn)));
            let first = (along as u16).min(7);
            let shares: [f64; 4] = std::array::from_fn(|_| dice.next() + 1.0);
            let sum: f64 = shares.iter().sum();
            skin.weights.push(std::array::from_fn(|place| {
                ((first + place as u16).min(7), shares[place] / sum)
            }));
            if ring > 0 {
                let (here, next) = (ring * sides + side, ring * sides + (side + 1) % sides);
                skin.triangles
                    .extend([[here, next, next - sides], [here, next - sides, here - sides]]);
                skin.regions.extend([Region::Body; 2]);
            }
        }
    }
    skin.bones = (0..8).map(joint).collect();
    skin
}

fn joint(index: usize) -> Bone {
    let turns = vec![
        (Channel { angle: Angle::SpinePitch(index), share: 1.0 }, DVec3::NEG_Y),
        (Channel { angle: Angle::SpineYaw(index), share: 1.0 }, DVec3::Z),
    ];
    Bone {
        name: format!("bone_{index}"),
        parent: index.checked_sub(1),
        origin: DVec3::NEG_X * index as f64,
        turns,
    }
}

pub(crate) fn random_bones(skin: &Skin, dice: &mut Dice) -> Vec<DAffine3> {
    let mut posture = Posture::default();
    for angle in posture.spine_pitch.iter_mut().chain(&mut posture.spine_yaw) {
        *angle = 0.5 * dice.next();
    }
    let mut bones = Vec::new();
    let orientation = DQuat::from_scaled_axis(dice.point() * 2.0);
    pose(skin, dice.point() * 3.0, orientation, &posture, &mut bones);
    bones
}

fn random_rope(dice: &mut Dice) -> Vec<SweptSegment> {
    let mut at = dice.point() * 6.0;
    let mut next = at;
    let mut nodes = Vec::new();
    for _ in 0..101 {
        nodes.push([at, next]);
        at += dice.point() * 0.3;
        next = at + dice.point() * 0.2;
    }
    nodes
        .windows(2)
        .map(|pair| SweptSegment { a0: pair[0][0], b0: pair[1][0], a1: pair[0][1], b1: pair[1][1] })
        .collect()
}

/// In random postures the candidates are those of a search through all pairs, and no pair that comes
/// within the margin is missing.
#[test]
fn candidates_are_those_of_a_full_search() {
    let skin = Arc::new(tube());
    let mut surface = Surface::new(Arc::new(SkinTree::new(skin.clone())));
    let (mut dice, mut found, mut all) = (Dice(5), Vec::new(), 0);
    for round in 0..60 {
        let (starts, ends) = (random_bones(&skin, &mut dice), random_bones(&skin, &mut dice));
        let rope = random_rope(&mut dice);
        let margin = 0.05 * f64::from(round % 4);
        surface.begin(&starts, &ends);
        surface.gather(&rope, margin, &mut found);
        let expected = full_search(&skin, &starts, &ends, &rope, margin);
        assert_eq!(found, expected);
        all += found.len();
        let whole =
            Bounds::around(&rope.iter().flat_map(|s| [s.a0, s.b0, s.a1, s.b1]).collect::<Vec<_>>());
        assert!(found.is_empty() || surface.is_near(&whole, margin));
    }
    assert!(all > 10_000, "{all} candidates are too few to prove anything");
}

fn full_search(
    skin: &Skin,
    starts: &[DAffine3],
    ends: &[DAffine3],
    rope: &[SweptSegment],
    margin: f64,
) -> Vec<Candidate> {
    let (mut from, mut to) = (Vec::new(), Vec::new());
    skin_all(skin, starts, &mut from);
    skin_all(skin, ends, &mut to);
    let mut out = Vec::new();
    for (segment, swept) in (0..).zip(rope) {
        let rope_box = Bounds::around(&[swept.a0, swept.b0, swept.a1, swept.b1]).grown(margin);
        for (triangle, corners) in (0..).zip(&skin.triangles) {
            let [start, end] =
                [&from, &to].map(|places| corners.map(|corner| places[corner as usize]));
            let listed = Bounds::around(&start).join(Bounds::around(&end)).meets(&rope_box);
            if listed {
                out.push(Candidate { segment, triangle });
            }
            let middle = segment_triangle(swept.at(0.5), triangle_at(&[start, end], 0.5)).distance;
            assert!(listed || middle > margin, "a pair at {middle} m is not in the boxes");
        }
    }
    out
}

/// Every vertex stays in the boxes of all nodes above it, at the start, at the end and between.
#[test]
fn bounds_hold_every_vertex() {
    let skin = Arc::new(tube());
    let tree = SkinTree::new(skin.clone());
    let mut dice = Dice(17);
    for _ in 0..50 {
        let (starts, ends) = (random_bones(&skin, &mut dice), random_bones(&skin, &mut dice));
        for (index, node) in tree.nodes().iter().enumerate() {
            let bounds = tree.bound(index, &starts, &ends);
            for &triangle in &tree.order()[node.triangles.clone()] {
                for vertex in skin.triangles[triangle as usize] {
                    let [start, end] =
                        [&starts, &ends].map(|bones| skin_vertex(&skin, bones, vertex as usize));
                    for place in [start, start.lerp(end, 0.3), end] {
                        assert!(place.cmpge(bounds.low).all() && place.cmple(bounds.high).all());
                    }
                }
            }
        }
    }
}

/// What the step tells of a triangle is what skinning tells.
#[test]
fn triangles_move_as_the_skin_does() {
    let skin = Arc::new(tube());
    let mut surface = Surface::new(Arc::new(SkinTree::new(skin.clone())));
    let mut dice = Dice(23);
    for _ in 0..5 {
        let (starts, ends) = (random_bones(&skin, &mut dice), random_bones(&skin, &mut dice));
        surface.begin(&starts, &ends);
        for (triangle, corners) in (0..).zip(&skin.triangles) {
            let start = corners.map(|corner| skin_vertex(&skin, &starts, corner as usize));
            let end = corners.map(|corner| skin_vertex(&skin, &ends, corner as usize));
            assert_eq!(surface.triangle_sweep(triangle), [start, end]);
            assert!(
                surface.triangle_at(triangle, 0.25)[1].distance(start[1].lerp(end[1], 0.25))
                    < 1e-12
            );
        }
    }
}

#[test]
fn a_whale_without_skin_is_near_nothing() {
    let mut surface = Surface::new(Arc::new(SkinTree::new(Arc::new(Skin::default()))));
    let mut out = vec![Candidate { segment: 0, triangle: 0 }];
    surface.begin(&[], &[]);
    surface.gather(&[SweptSegment::default()], 1.0, &mut out);
    assert!(out.is_empty() && !surface.is_near(&Bounds::around(&[DVec3::ZERO]), 1.0));
}

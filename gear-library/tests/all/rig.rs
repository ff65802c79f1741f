//! The skin and the bones: weights, the volume during a swim, joint angles of the swim within their ranges.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::path::Path;

use endline_gear::{Library, Sources, WhaleItem};
use endline_sdk::{BodyPart, Controls, MotionInput, Posture, WhaleMotion};
use endline_sim::whale::{Skin, pose, skin_all};
use endline_whale_motions::Swim;
use glam::{DQuat, DVec3};

fn whales() -> Vec<WhaleItem> {
    let sources = Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    Library::read(&sources).0.whales
}

/// Postures of every 0.1 s of a swim, from rest to well past its first beats.
fn swim(length_m: f64, controls: Controls) -> Vec<Posture> {
    let motion = Swim::new();
    let attributes: Vec<f64> = motion
        .descriptor()
        .attributes
        .iter()
        .map(|own| own.default_value().number().unwrap())
        .collect();
    let (mut state, mut speed_m_s) = (vec![0.0; motion.descriptor().state_len], 1.23);
    let mut step = |index: u32| {
        let input = MotionInput {
            time_s: f64::from(index) * 0.1,
            dt_s: 0.1,
            length_m,
            speed_m_s,
            position_m: [0.0; 3],
            orientation: [0.0, 0.0, 0.0, 1.0],
            controls,
            contact_force_n: &[0.0; BodyPart::ALL.len()],
            contact_port_m: &[0.0; BodyPart::ALL.len()],
            thrust_speed_m_s: None,
        };
        let moved = motion.step(&attributes, &input, &mut state).unwrap();
        speed_m_s = moved.speed_m_s;
        moved.posture
    };
    (0..300).map(&mut step).collect()
}

/// Cruise straight on, in a full yaw turn, in a full pitch turn, in both, and at a burst.
fn controls() -> [Controls; 5] {
    let cruise = Controls { speed: 1.0, ..Controls::default() };
    [
        cruise,
        Controls { yaw: 1.0, ..cruise },
        Controls { pitch: 1.0, ..cruise },
        Controls { yaw: -1.0, pitch: -1.0, ..cruise },
        Controls { burst: 1.0, ..cruise },
    ]
}

fn volume(skin: &Skin, posture: &Posture) -> f64 {
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(skin, DVec3::ZERO, DQuat::IDENTITY, posture, &mut bones);
    skin_all(skin, &bones, &mut places);
    let corner = |index: u32| places[index as usize];
    skin.triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum()
}

#[test]
fn every_vertex_is_shared_out_among_four_bones_at_most() {
    for whale in whales() {
        let skin = whale.skin_at(whale.form.length_m);
        assert!(skin.bones.len() >= 25, "{} has {} bones", whale.entry.id, skin.bones.len());
        for weights in &skin.weights {
            assert!((weights.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
            assert!(
                weights
                    .iter()
                    .all(|(bone, weight)| *weight >= 0.0 && usize::from(*bone) < skin.bones.len())
            );
        }
        for (index, bone) in skin.bones.iter().enumerate().skip(1) {
            let used = skin
                .weights
                .iter()
                .flatten()
                .any(|(mover, weight)| usize::from(*mover) == index && *weight > 0.0);
            assert!(used, "{} of {} moves nothing", bone.name, whale.entry.id);
        }
        assert_eq!(
            skin.bones.iter().filter(|bone| bone.parent.is_none()).count(),
            1,
            "one control bone"
        );
    }
}

/// The volume of the skin changes by less than 3 % during the beats of a swim.
#[test]
fn a_swim_keeps_the_volume() {
    for whale in whales() {
        let skin = whale.skin_at(whale.form.length_m);
        let rest = volume(&skin, &Posture::default());
        let mut worst: f64 = 0.0;
        for controls in controls() {
            for posture in swim(whale.form.length_m, controls) {
                worst = worst.max((volume(&skin, &posture) / rest - 1.0).abs());
            }
        }
        println!("{}: the volume changes by {:.2} % at most", whale.entry.id, 100.0 * worst);
        assert!(worst < 0.03, "{} changes by {worst}", whale.entry.id);
    }
}

/// This limit applies to any posture within the joint ranges, with the mouth closed.
#[test]
fn no_posture_within_the_ranges_costs_much_volume() {
    for whale in whales() {
        let skin = whale.skin_at(whale.form.length_m);
        let rest = volume(&skin, &Posture::default());
        let closed =
            |seed| Posture { jaw: 0.0, lips: [0.0; 2], ..whale.joints.ranges.random(seed) };
        let worst = (0..200)
            .map(|seed| (volume(&skin, &closed(seed)) / rest - 1.0).abs())
            .fold(0.0, f64::max);
        println!(
            "{}: the volume changes by {:.2} % at most over 200 postures",
            whale.entry.id,
            100.0 * worst
        );
        assert!(worst < 0.03, "{} changes by {worst}", whale.entry.id);
    }
}

/// The shipped swim does not exceed the joint ranges.
#[test]
fn a_swim_stays_within_the_joints_ranges() {
    let whales = whales();
    let ranges = whales.iter().find(|whale| whale.entry.id == "right-whale").unwrap().joints.ranges;
    for controls in controls() {
        for mut posture in swim(13.7, controls) {
            let asked = posture;
            assert!(
                !ranges.hold(&mut posture),
                "{controls:?} asks for {asked:?}, held at {posture:?}"
            );
        }
    }
}

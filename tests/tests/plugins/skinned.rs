//! What the swim says of joint angles, seen on the right whale's own skin: two parts of the house
//! that meet only in the words of the sdk.

use endline_gear::whale::{WhaleForm, build_skin};
use endline_sdk::{BodyPart, Controls, MotionInput, Posture, Region, WhaleMotion};
use endline_sim::whale::Skin;
use endline_sim::whale::pose::{pose, skin_vertex};
use endline_whale_motions::Swim;
use glam::{DQuat, DVec3};

const LENGTH_M: f64 = 13.7;

/// Postures of every 0.1 s of a swim at cruise speed.
fn postures(seconds: f64, controls: Controls) -> Vec<Posture> {
    let motion = Swim::new();
    let attributes: Vec<f64> = motion
        .descriptor()
        .attributes
        .iter()
        .map(|a| a.default_value().number().unwrap())
        .collect();
    let mut state = vec![0.0; motion.descriptor().state_len];
    let mut step = |index: i32| {
        let input = MotionInput {
            time_s: f64::from(index) * 0.1,
            dt_s: 0.1,
            length_m: LENGTH_M,
            speed_m_s: 1.23,
            position_m: [0.0; 3],
            orientation: [0.0, 0.0, 0.0, 1.0],
            controls,
            contact_force_n: &[0.0; BodyPart::ALL.len()],
            contact_port_m: &[0.0; BodyPart::ALL.len()],
            thrust_speed_m_s: None,
        };
        motion.step(&attributes, &input, &mut state).unwrap().posture
    };
    (0..(seconds * 10.0) as i32).map(&mut step).collect()
}

fn skin() -> Skin {
    build_skin(&WhaleForm::right_whale(LENGTH_M))
}

/// Vertices of the triangles of some regions.
fn vertices_of(skin: &Skin, regions: &[Region]) -> Vec<usize> {
    let chosen =
        skin.triangles.iter().zip(&skin.regions).filter(|(_, region)| regions.contains(region));
    let mut vertices: Vec<usize> =
        chosen.flat_map(|(triangle, _)| triangle.map(|vertex| vertex as usize)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

/// Mean place of some vertices in the whale's frame.
fn mean(skin: &Skin, posture: &Posture, vertices: &[usize]) -> DVec3 {
    let mut bones = Vec::new();
    pose(skin, DVec3::ZERO, DQuat::IDENTITY, posture, &mut bones);
    vertices.iter().map(|vertex| skin_vertex(skin, &bones, *vertex)).sum::<DVec3>()
        / vertices.len() as f64
}

fn span(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::MIN, f64::max)
        - values.iter().copied().fold(f64::MAX, f64::min)
}

#[test]
fn flukes_beat_a_fifth_of_body_length_while_mid_body_keeps_still() {
    let skin = skin();
    let flukes = vertices_of(&skin, &[Region::LeftFluke, Region::RightFluke]);
    let waist: Vec<usize> =
        (0..skin.vertices.len()).filter(|v| skin.vertices[*v].x.abs() < 0.02 * LENGTH_M).collect();
    let cruise = postures(30.0, Controls { speed: 1.0, ..Controls::default() });
    let heights = |vertices: &[usize]| {
        cruise[150..].iter().map(|posture| mean(&skin, posture, vertices).z).collect::<Vec<_>>()
    };
    let (beat, still) = (span(&heights(&flukes)) / LENGTH_M, span(&heights(&waist)) / LENGTH_M);
    assert!((0.15..0.25).contains(&beat), "flukes beat {beat} L");
    assert!(still < 0.01, "mid-body heaves {still} L");
}

#[test]
fn flukes_turn_their_trailing_edge_down_as_they_rise() {
    let skin = skin();
    let trailing = vertices_of(&skin, &[Region::LeftFlukeTrailing, Region::RightFlukeTrailing]);
    let leading = vertices_of(&skin, &[Region::LeftFlukeLeading, Region::RightFlukeLeading]);
    let cruise = postures(30.0, Controls { speed: 1.0, ..Controls::default() });
    let (mut product, mut heave_square, mut tilt_square) = (0.0, 0.0, 0.0);
    let rest = mean(&skin, &Posture::default(), &leading).z
        - mean(&skin, &Posture::default(), &trailing).z;
    for pair in cruise[150..].windows(2) {
        let heave = mean(&skin, &pair[1], &leading).z - mean(&skin, &pair[0], &leading).z;
        let tilt = mean(&skin, &pair[1], &leading).z - mean(&skin, &pair[1], &trailing).z - rest;
        product += heave * tilt;
        heave_square += heave * heave;
        tilt_square += tilt * tilt;
    }
    let correlation = product / (heave_square * tilt_square).sqrt();
    assert!(correlation > 0.9, "{correlation}");
}

#[test]
fn a_turn_bends_head_and_tail_to_its_inside() {
    let skin = skin();
    let flukes = vertices_of(&skin, &[Region::LeftFluke, Region::RightFluke]);
    let snout = vertices_of(&skin, &[Region::Rostrum]);
    let to_port = *postures(10.0, Controls { yaw: 1.0, ..Controls::default() }).last().unwrap();
    assert!(mean(&skin, &to_port, &flukes).y > 0.05 * LENGTH_M, "tail to port");
    assert!(mean(&skin, &to_port, &snout).y > 0.01 * LENGTH_M, "head to port");
    let nose_up = *postures(10.0, Controls { pitch: 1.0, ..Controls::default() }).last().unwrap();
    assert!(
        mean(&skin, &nose_up, &flukes).z
            > mean(&skin, &Posture::default(), &flukes).z + 0.02 * LENGTH_M,
        "tail up"
    );
    assert!(
        mean(&skin, &nose_up, &snout).z > mean(&skin, &Posture::default(), &snout).z,
        "head up"
    );
}

#[test]
fn flippers_and_jaw_go_where_the_controls_say() {
    let skin = skin();
    let tips = vertices_of(&skin, &[Region::LeftFlipperTip]);
    let (leading, trailing) = (
        vertices_of(&skin, &[Region::LeftFlipperLeading]),
        vertices_of(&skin, &[Region::LeftFlipperTrailing]),
    );
    let rest = Posture::default();
    let after = |controls: Controls| *postures(10.0, controls).last().unwrap();
    let raised = after(Controls { flipper_raise: 1.0, ..Controls::default() });
    assert!(mean(&skin, &raised, &tips).z > mean(&skin, &rest, &tips).z + 0.3, "tip lifted");
    let twisted = after(Controls { flipper_twist: 1.0, ..Controls::default() });
    let tilt =
        |posture: &Posture| mean(&skin, posture, &leading).z - mean(&skin, posture, &trailing).z;
    assert!(tilt(&twisted) < tilt(&rest) - 0.1, "leading edge down");
    let cruising = after(Controls { speed: 1.0, ..Controls::default() });
    assert!(mean(&skin, &cruising, &tips).x < mean(&skin, &rest, &tips).x - 0.1, "swept aft");
    let turning = after(Controls { speed: 1.0, yaw: 1.0, ..Controls::default() });
    assert!(
        mean(&skin, &turning, &tips).x > mean(&skin, &rest, &tips).x + 0.1,
        "inner flipper forward in a turn"
    );
    let lips = vertices_of(&skin, &[Region::Lips]);
    let open = after(Controls { mouth: 1.0, ..Controls::default() });
    assert!(mean(&skin, &open, &lips).z < mean(&skin, &rest, &lips).z - 0.05, "jaw dropped");
}

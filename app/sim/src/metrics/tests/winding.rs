//! Wraps of helices of known turns, and what must not change them.

use std::f64::consts::TAU;

use super::*;
use crate::metrics::EventKind;
use crate::metrics::summary::{RegionSummary, Summary};

/// Folds contacts of one line's segments at places of the skin, once, with the whale as `pose` leaves it.
fn wrapped(model: &Model, places: &[(usize, [f64; 3])], pose: impl Fn(&mut State)) -> Summary {
    let (mut metrics, mut state) = (Metrics::new(model), State::start(model));
    pose(&mut state);
    let contacts: Vec<_> =
        places.iter().enumerate().map(|(segment, place)| contact(model, segment, *place)).collect();
    advance(&mut metrics, model, &mut state, &contacts);
    metrics.summary(model, &state)
}

fn region(summary: &Summary, part: BodyPart) -> &RegionSummary {
    &summary.whale.as_ref().unwrap().regions[part as usize]
}

#[test]
fn a_helix_about_the_peduncle_counts_its_turns() {
    for length in [0.02, 0.05, 0.1, 0.2] {
        for turns in [0.5_f64, 1.0, 2.25, -1.0] {
            let count = (turns.abs() * TAU * PEDUNCLE_R / length).round() as usize;
            let model = model(spec(vec![length; count]));
            let places = helix(&model.spec.whale.as_ref().unwrap().skin, turns, count);
            let summary = wrapped(&model, &places, |_| {});
            let wraps = region(&summary, BodyPart::Peduncle).touching_wraps;
            assert!(
                (wraps - turns.abs()).abs() < 0.02 * turns.abs(),
                "{length} m, {turns} turns: {wraps}"
            );
            assert!(region(&summary, BodyPart::Body).touching_wraps.abs() < 1e-12);
            assert!(
                (region(&summary, BodyPart::Peduncle).contact_length_m - length * count as f64)
                    .abs()
                    < 1e-9
            );
        }
    }
}

/// The Gauss integral of the same helix against the axis, drawn out 50 m both ways, counts the same turns.
#[test]
fn wraps_agree_with_the_gauss_integral() {
    let (turns, count) = (2.25, 300);
    let mut spec = spec(vec![0.02; count]);
    let mut straight = skin();
    straight.vertices.iter_mut().for_each(|vertex| vertex.z -= 0.01 * vertex.x * vertex.x);
    spec.whale.as_mut().unwrap().skin = Arc::new(straight.clone());
    let places: Vec<_> = (0..count)
        .map(|k| {
            let share = (k as f64 + 0.5) / count as f64;
            let (angle, x) = (TAU * turns * share, -5.5 + share);
            ray(
                &straight,
                BodyPart::Peduncle,
                DVec3::X * x,
                DVec3::new(0.0, libm::cos(angle), libm::sin(angle)),
            )
        })
        .collect();
    let rest = |(triangle, weights): &(usize, [f64; 3])| {
        let corners =
            straight.triangles[*triangle].map(|vertex| straight.vertices[vertex as usize]);
        corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]
    };
    let rope: Vec<DVec3> = places.iter().map(rest).collect();
    let mut gauss = 0.0;
    for pair in rope.windows(2) {
        for step in -25_000..25_000 {
            let apart = pair[0].midpoint(pair[1]) - DVec3::X * (f64::from(step) + 0.5) * 0.002;
            gauss += apart.dot((pair[1] - pair[0]).cross(DVec3::X * 0.002))
                / (apart.length() * apart.length_squared())
                / (2.0 * TAU);
        }
    }
    let whole = gauss.abs() * count as f64 / (count as f64 - 1.0);
    let model = model(spec);
    let wraps = region(&wrapped(&model, &places, |_| {}), BodyPart::Peduncle).touching_wraps;
    assert!((wraps - whole).abs() < 0.005 * turns, "azimuth {wraps}, Gauss {whole}");
}

#[test]
fn rope_along_the_back_and_across_it_does_not_wrap() {
    let model = model(spec(vec![0.1; 12]));
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    let along: Vec<_> = (0..12)
        .map(|k| {
            ray(
                skin,
                BodyPart::Body,
                trunk_middle(0.051 + 0.1 * f64::from(k)),
                DVec3::Z + DVec3::Y * 0.01,
            )
        })
        .collect();
    assert!(region(&wrapped(&model, &along, |_| {}), BodyPart::Body).touching_wraps < 0.01);
    let across: Vec<_> = (0..12)
        .map(|k| {
            let angle = (f64::from(k) - 5.5) * 0.1 / 1.2;
            ray(
                skin,
                BodyPart::Body,
                trunk_middle(1.05),
                DVec3::new(0.0, libm::sin(angle), libm::cos(angle)),
            )
        })
        .collect();
    let wraps = region(&wrapped(&model, &across, |_| {}), BodyPart::Body).touching_wraps;
    assert!(
        wraps > 0.1 && wraps < 0.25,
        "1.2 m of rope on a radius of 1.2 m turns by one radian: {wraps}"
    );
}

#[test]
fn wraps_about_a_flipper_count_about_its_own_axis() {
    for side in [1.0, -1.0] {
        let part = if side > 0.0 { BodyPart::LeftFlipper } else { BodyPart::RightFlipper };
        let model = model(spec(vec![0.05; 60]));
        let skin = &model.spec.whale.as_ref().unwrap().skin;
        let places: Vec<_> = (0..60)
            .map(|k| {
                let share = (f64::from(k) + 0.5) / 60.0;
                let (angle, middle) =
                    (TAU * 1.5 * share, FLIPPER_ROOT.lerp(FLIPPER_TIP, 0.4 + 0.2 * share));
                let out = DVec3::new(0.4 * libm::cos(angle), 0.0, 0.1 * libm::sin(angle));
                ray(skin, part, middle * DVec3::new(1.0, side, 1.0), out)
            })
            .collect();
        let summary = wrapped(&model, &places, |_| {});
        let wraps = region(&summary, part).touching_wraps;
        assert!((wraps - 1.5).abs() < 0.03, "{wraps}");
        assert!(region(&summary, BodyPart::Body).touching_wraps.abs() < 1e-12);
    }
}

#[test]
fn a_moved_and_turned_whale_changes_no_bit() {
    let model = model(spec(vec![0.05; 60]));
    let places = helix(&model.spec.whale.as_ref().unwrap().skin, 1.5, 60);
    let still = wrapped(&model, &places, |_| {});
    let moved = wrapped(&model, &places, |state| {
        let whale = state.whale.as_mut().unwrap();
        whale.position = DVec3::new(30.0, -7.0, -12.0);
        whale.orientation = DQuat::from_euler(glam::EulerRot::ZYX, 1.0, -0.4, 2.0);
        whale.posture.spine_yaw = [0.1; endline_sdk::SPINE_JOINTS];
    });
    assert_eq!(region(&still, BodyPart::Peduncle), region(&moved, BodyPart::Peduncle));
}

/// Two halves of one turn: rope off the skin for 0.25 m leaves one run, for 0.35 m it makes two.
#[test]
fn short_gaps_are_bridged_and_long_ones_are_not() {
    for (gap, expected) in [(0.25, 1.0), (0.35, 0.5)] {
        let mut lengths = vec![0.05; 40];
        lengths[20] = gap;
        let model = model(spec(lengths));
        let places = helix(&model.spec.whale.as_ref().unwrap().skin, 1.0, 40);
        let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
        let contacts: Vec<_> =
            (0..40).filter(|k| *k != 20).map(|k| contact(&model, k, places[k])).collect();
        advance(&mut metrics, &model, &mut state, &contacts);
        let wraps = region(&metrics.summary(&model, &state), BodyPart::Peduncle).touching_wraps;
        assert!((wraps - expected).abs() < 0.03, "{gap} m: {wraps}");
    }
}

/// Two lines of ten segments, the second laid against the first, with two contacts on each segment.
fn two_lines(spec: ModelSpec, turns: f64) -> (Model, Vec<ContactPoint>) {
    let model = model(spec);
    let places = helix(&model.spec.whale.as_ref().unwrap().skin, turns, 40);
    let place_of = |k: usize| match k {
        0..20 => (0, k / 2, [0.25, 0.75][k % 2]),
        _ => (1, 10 + (39 - k) / 2, [0.75, 0.25][k % 2]),
    };
    let contact_at = |k: usize| {
        let (line, segment, fraction) = place_of(k);
        ContactPoint { line, segment, fraction, length_m: 0.05, ..contact(&model, 0, places[k]) }
    };
    let contacts = (0..40).rev().map(contact_at).collect();
    (model, contacts)
}

#[test]
fn a_cut_ends_a_wrap_and_a_splice_does_not() {
    let mut spec = spec(vec![0.1; 10]);
    spec.joints.push(joint("end", JointKind::Free, DVec3::new(0.0, 0.0, -38.0)));
    spec.lines.push(line("upper", 2, 1, vec![0.1; 10]));
    let (model, mut contacts) = two_lines(spec, 1.0);
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    advance(&mut metrics, &model, &mut state, &contacts);
    let wraps = region(&metrics.summary(&model, &state), BodyPart::Peduncle).touching_wraps;
    assert!((wraps - 1.0).abs() < 0.02, "{wraps}");
    state.rope.cut[19] = true;
    contacts.retain(|contact| contact.segment != 19);
    advance(&mut metrics, &model, &mut state, &contacts);
    let wraps = region(&metrics.summary(&model, &state), BodyPart::Peduncle).touching_wraps;
    assert!((wraps - 0.5).abs() < 0.02, "{wraps}");
}

/// Two ropes that lie end to end on the skin but are not joined wrap each for itself.
#[test]
fn ropes_that_are_not_joined_do_not_add_up() {
    let mut spec = spec(vec![0.1; 10]);
    spec.joints.push(joint("start", JointKind::Free, DVec3::new(0.0, 0.0, -39.0)));
    spec.joints.push(joint("end", JointKind::Free, DVec3::new(0.0, 0.0, -38.0)));
    spec.lines.push(line("other", 2, 3, vec![0.1; 10]));
    let (model, contacts) = two_lines(spec, 1.0);
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    advance(&mut metrics, &model, &mut state, &contacts);
    let wraps = region(&metrics.summary(&model, &state), BodyPart::Peduncle).touching_wraps;
    assert!((wraps - 0.5).abs() < 0.02, "{wraps}");
}

/// The nodes of a rope that lies on the places of [`helix`].
fn helix_nodes(turns: f64, count: usize) -> Vec<DVec3> {
    let node = |k: usize| {
        let share = k as f64 / count as f64;
        let (angle, x) = (0.3 + TAU * turns * share, -5.5 + 0.4 * share);
        trunk_middle(x) + DVec3::new(0.0, libm::cos(angle), libm::sin(angle)) * (PEDUNCLE_R + 0.005)
            - DVec3::Z * 20.0
    };
    (0..=count).map(node).collect()
}

/// Winding up to 1.2 turns in small steps raises no alarm and reports 0.5 and 1; a jump by 0.5 raises one.
#[test]
fn growing_wraps_are_told_and_jumps_alarm() {
    let model = model(spec(vec![0.05; 40]));
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    let mut fold = |metrics: &mut Metrics, turns: f64| {
        let contacts: Vec<_> = helix(skin, turns, 40)
            .iter()
            .enumerate()
            .map(|(k, place)| contact(&model, k, *place))
            .collect();
        state.rope.position = helix_nodes(turns, 40);
        advance(metrics, &model, &mut state, &contacts);
        metrics.summary(&model, &state).whale.unwrap()
    };
    let grown = (0..=24).map(|k| fold(&mut metrics, 0.05 * f64::from(k))).last().unwrap();
    assert_eq!(grown.winding_jumps, 0);
    let jumped = fold(&mut metrics, 0.7);
    assert_eq!(jumped.winding_jumps, 1);
    let peduncle = &jumped.regions[BodyPart::Peduncle as usize];
    assert!(
        (peduncle.touching_wraps - 0.7).abs() < 0.02
            && (peduncle.peak_touching_wraps - 1.2).abs() < 0.03,
        "{peduncle:?}"
    );
    let levels: Vec<_> = metrics
        .events()
        .iter()
        .filter(|event| event.kind == EventKind::Wrap)
        .map(|event| event.value)
        .collect();
    assert_eq!(levels, [0.5, 1.0]);
}

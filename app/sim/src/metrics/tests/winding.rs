//! Winding, wraps and twist of rope of known turns, and their invariances.

use std::f64::consts::TAU;

use super::*;
use crate::metrics::summary::{RegionSummary, Summary};
use crate::metrics::{EventKind, RopePlace};

/// Summary of one fold of contacts of a line's segments at points of the skin, after `pose` has changed the state.
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
            let whale = summary.whale.as_ref().unwrap();
            assert_eq!(whale.is_constricted(), turns.abs() > 0.75, "{turns} turns");
            assert!(whale.has_rope_on(RopePlace::Tail) && !whale.has_rope_on(RopePlace::Head));
        }
    }
}

/// The Gauss integral of the same helix and the axis, extended by 50 m both ways, has the same turns.
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
    let across = about_body(skin, 1.05, -0.5 / TAU, 0.5 / TAU, 12);
    let wraps = region(&wrapped(&model, &across, |_| {}), BodyPart::Body).touching_wraps;
    assert!(
        wraps > 0.1 && wraps < 0.25,
        "1.2 m of rope on a radius of 1.2 m turns by one radian: {wraps}"
    );
}

/// Points on the body at a place along it, as a fraction of a turn about it from the back, one for each segment.
fn about_body(skin: &Skin, x: f64, from: f64, to: f64, count: usize) -> Vec<(usize, [f64; 3])> {
    let place = |k: usize| {
        let angle = TAU * (from + (to - from) * (k as f64 + 0.5) / count as f64);
        let toward = DVec3::new(0.0, libm::sin(angle), libm::cos(angle));
        ray(skin, BodyPart::Body, trunk_middle(x), toward)
    };
    (0..count).map(place).collect()
}

/// The first segment of a strand, and the contact of each of its segments.
type Pass = (usize, Vec<(usize, [f64; 3])>);

#[test]
fn a_strand_across_the_back_counts_once_and_a_turn_does_not() {
    // Of segments of 0.1 m on a girth of 7.5 m: a third of a turn over the back, with 3 m of free rope before the next.
    let model = model(spec(vec![0.1; 120]));
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    let across = |passes: &[Pass], cut: &[usize]| {
        let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
        cut.iter().for_each(|segment| state.rope.cut[*segment] = true);
        let contacts: Vec<_> = passes
            .iter()
            .flat_map(|(first, places)| {
                let own = places.iter().enumerate();
                own.map(|(k, place)| contact(&model, *first + k, *place)).collect::<Vec<_>>()
            })
            .collect();
        advance(&mut metrics, &model, &mut state, &contacts);
        region(&metrics.summary(&model, &state), BodyPart::Body).across
    };
    assert_eq!(across(&[(0, about_body(skin, 1.05, -0.17, 0.17, 25))], &[]), 1);
    let twice = [0, 55].map(|first| (first, about_body(skin, 1.05, -0.17, 0.17, 25)));
    assert_eq!(across(&twice, &[]), 2);
    // Along the back, and once round with a gap of 1 m under the belly.
    let along: Vec<_> = (0..25)
        .map(|k| {
            let toward = DVec3::Z + DVec3::Y * 0.01;
            ray(skin, BodyPart::Body, trunk_middle(0.051 + 0.1 * f64::from(k)), toward)
        })
        .collect();
    assert_eq!(across(&[(0, along)], &[]), 0);
    let round = [
        (0, about_body(skin, 1.05, -0.55, -0.05, 38)),
        (48, about_body(skin, 1.05, 0.05, 0.6, 42)),
    ];
    assert_eq!(across(&round, &[]), 0);
    assert_eq!(across(&round, &[42]), 2, "cut, each half lies across its flank");
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

/// Two halves of one turn: a gap of 0.25 m leaves one run, a gap of 0.35 m makes two.
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

/// Two ropes that are end to end on the skin but not joined have separate wraps.
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

/// Nodes of a rope at the points of [`helix`].
fn helix_nodes(turns: f64, count: usize) -> Vec<DVec3> {
    let node = |k: usize| {
        let share = k as f64 / count as f64;
        let (angle, x) = (0.3 + TAU * turns * share, -5.5 + 0.4 * share);
        trunk_middle(x) + DVec3::new(0.0, libm::cos(angle), libm::sin(angle)) * (PEDUNCLE_R + 0.005)
            - DVec3::Z * 20.0
    };
    (0..=count).map(node).collect()
}

/// Winding up to 1.2 turns in small steps raises no alarm and reports the levels 0.5 and 1; a jump by 0.5 raises one.
#[test]
fn growing_wraps_are_reported_and_jumps_raise_an_alarm() {
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

/// Position of the fixture's whale.
const WHALE: DVec3 = DVec3::new(0.0, 0.0, -20.0);

/// Positions about the peduncle: `turns` at radius `r`, with straight ends of `tail` metres.
fn coil(turns: f64, r: f64, each_turn: f64, tail: f64) -> Vec<DVec3> {
    let count = (each_turn * turns.abs()).ceil();
    let at = |angle: f64, share: f64| {
        let x = -5.0 + 0.3 * share;
        trunk_middle(x) + DVec3::new(0.0, libm::cos(angle), libm::sin(angle)) * r
    };
    let mut nodes: Vec<DVec3> = (0..=count as u32)
        .map(|k| f64::from(k) / count)
        .map(|share| at(0.3 + TAU * turns * share, share))
        .collect();
    let tangent =
        |angle: f64| DVec3::new(0.0, -libm::sin(angle), libm::cos(angle)) * turns.signum();
    let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
    for k in 1..=20 {
        let away = tail * f64::from(k) / 20.0;
        nodes.insert(0, first - tangent(0.3) * away);
        nodes.push(last + tangent(0.3 + TAU * turns) * away);
    }
    nodes
}

/// A model and its state with the rope at these positions.
fn laid(nodes: &[DVec3]) -> (Model, State) {
    let model = model(spec(nodes.windows(2).map(|pair| pair[0].distance(pair[1])).collect()));
    let mut state = State::start(&model);
    state.rope.position = nodes.iter().map(|node| *node + WHALE).collect();
    (model, state)
}

/// A point of the peduncle for a contact.
fn on_peduncle(model: &Model) -> (usize, [f64; 3]) {
    ray(&model.spec.whale.as_ref().unwrap().skin, BodyPart::Peduncle, trunk_middle(-4.85), DVec3::Y)
}

/// Wraps about the peduncle of rope at these positions, with a contact at its middle only.
fn wraps(nodes: &[DVec3]) -> f64 {
    let (model, mut state) = laid(nodes);
    let mut metrics = Metrics::new(&model);
    let contacts = [contact(&model, model.segment_count / 2, on_peduncle(&model))];
    advance(&mut metrics, &model, &mut state, &contacts);
    metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Peduncle as usize].wraps
}

#[test]
fn turns_by_construction_are_counted_whatever_the_segments() {
    for turns in [0.5, 1.0, 2.25, 3.0, -1.5] {
        let [coarse, fine] =
            [24.0, 48.0].map(|each_turn| wraps(&coil(turns, 0.31, each_turn, 2.0)));
        println!("{turns}: {coarse:.4} and {fine:.4}");
        assert!(
            (fine - turns.abs()).abs() < 0.02 && (coarse - fine).abs() < 0.01,
            "{turns}: {coarse}, {fine}"
        );
    }
}

#[test]
fn loose_loops_count_as_tight_ones() {
    for turns in [1.0, 2.0] {
        let loose = wraps(&coil(turns, 0.6, 24.0, 2.0));
        assert!((loose - turns).abs() < 0.03, "{turns}: {loose}");
    }
}

#[test]
fn rope_that_touches_but_does_not_wrap_counts_nothing() {
    let straight = |from: DVec3, to: DVec3| -> Vec<DVec3> {
        (0..=40).map(|k| from.lerp(to, f64::from(k) / 40.0)).collect()
    };
    let beside = trunk_middle(-4.85) + DVec3::Y * 0.305;
    // Along the axis, which sags by a third of the radius, rope turns slightly about it.
    for (way, most) in [
        (DVec3::Z, 0.02),
        (DVec3::new(0.3, 0.0, 1.0), 0.02),
        (DVec3::new(-0.5, 0.0, 1.0), 0.02),
        (DVec3::X, 0.12),
    ] {
        let way = way.normalize() * 3.0;
        let count = wraps(&straight(beside - way, beside + way));
        assert!(count < most, "along {way}: {count}");
    }
    // Bent by a right angle.
    let quarter = wraps(&coil(0.25, 0.31, 48.0, 2.0));
    assert!((quarter - 0.25).abs() < 0.02, "{quarter}");
}

#[test]
fn wraps_are_invariant_under_a_rigid_motion() {
    let nodes = coil(2.25, 0.31, 24.0, 2.0);
    let (model, mut state) = laid(&nodes);
    let (turn, shift) =
        (DQuat::from_euler(glam::EulerRot::ZYX, 1.0, -0.4, 2.0), DVec3::new(30.0, -7.0, -12.0));
    state.rope.position = nodes.iter().map(|node| turn * *node + shift).collect();
    let whale = state.whale.as_mut().unwrap();
    (whale.position, whale.orientation) = (shift, turn);
    let mut metrics = Metrics::new(&model);
    let contacts = [contact(&model, model.segment_count / 2, on_peduncle(&model))];
    advance(&mut metrics, &model, &mut state, &contacts);
    let moved =
        metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Peduncle as usize].wraps;
    assert!((moved - wraps(&nodes)).abs() < 1e-9, "{moved}");
}

/// The wraps of a loop that is raised from below until it hangs about the peduncle are continuous, and so are those of a loop
/// that slides off the end of the part.
#[test]
fn wraps_grow_and_shrink_without_a_jump() {
    let nodes = coil(0.5, 0.4, 48.0, 3.0);
    let turned = DQuat::from_rotation_x(-0.3 - std::f64::consts::PI);
    let at = |shift: DVec3| -> Vec<DVec3> {
        let middle = trunk_middle(-4.85);
        nodes.iter().map(|node| turned * (*node - middle) + middle + shift).collect()
    };
    let (model, mut state) = laid(&at(DVec3::ZERO));
    let contacts = [contact(&model, model.segment_count / 2, on_peduncle(&model))];
    let mut metrics = Metrics::new(&model);
    let mut count = |nodes: Vec<DVec3>| {
        state.rope.position = nodes.iter().map(|node| *node + WHALE).collect();
        advance(&mut metrics, &model, &mut state, &contacts);
        metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Peduncle as usize].wraps
    };
    for way in [DVec3::NEG_Z * 2.5, DVec3::new(0.3, 0.4, -2.5), DVec3::NEG_X * 2.5] {
        let counts: Vec<f64> = (0..=250).map(|k| count(at(way * (f64::from(k) / 250.0)))).collect();
        let jump = counts.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        let most = counts.iter().copied().fold(0.0, f64::max);
        println!(
            "{way}: from {:.3} to {:.3}, at most {most:.3}, greatest change in a centimetre {jump:.3}",
            counts[0], counts[250]
        );
        assert!(counts[0] > 0.45 && counts[250] < 0.02, "{way}: {} to {}", counts[0], counts[250]);
        // Near the boundary the wraps vary with the square root of the depth: fast, but from zero.
        assert!(way.x < -1.0 || jump < 0.15, "{way}: {jump}");
    }
}

/// A loss of contact of less than a second does not end wraps, a longer one does; levels are reported upwards and downwards.
#[test]
fn wraps_outlast_short_gaps_and_are_reported() {
    let (model, mut state) = laid(&coil(1.0, 0.31, 24.0, 2.0));
    let mut metrics = Metrics::new(&model);
    let contacts = [contact(&model, model.segment_count / 2, on_peduncle(&model))];
    let now = |metrics: &Metrics, state: &State| {
        metrics.summary(&model, state).whale.unwrap().regions[BodyPart::Peduncle as usize].wraps
    };
    state.rope.position = coil(1.2, 0.31, 24.0, 2.0)
        .iter()
        .take(model.node_count)
        .map(|node| *node + WHALE)
        .collect();
    advance(&mut metrics, &model, &mut state, &contacts);
    (0..90).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
    assert!(now(&metrics, &state) > 0.9, "{}", now(&metrics, &state));
    (0..20).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
    assert!(now(&metrics, &state).abs() < 1e-12);
    let reported: Vec<_> = metrics.events().iter().map(|event| (event.kind, event.value)).collect();
    for (kind, value) in [
        (EventKind::Wrap, 0.5),
        (EventKind::Wrap, 1.0),
        (EventKind::WrapUndone, 1.0),
        (EventKind::WrapUndone, 0.5),
    ] {
        assert!(reported.contains(&(kind, value)), "{reported:?}");
    }
}

/// Length of the legs [m].
const LEG_M: f64 = 2.0;

/// Twist of a strand along `nodes`, with one contact in the middle of segment `touched`, after a change of the state.
fn twist(nodes: &[DVec3], touched: usize, change: impl Fn(&mut State)) -> [f64; 2] {
    let model = model(spec(nodes.windows(2).map(|ends| ends[0].distance(ends[1])).collect()));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    state.rope.position.copy_from_slice(nodes);
    change(&mut state);
    let mut touch = touch(&model);
    touch[0].segment = touched;
    advance(&mut metrics, &model, &mut state, &touch);
    let summary = metrics.summary(&model, &state);
    [summary.lines[0].twist, summary.lines[0].peak_twist]
}

/// Nodes of a bight: `one` from its far end to the whale, a bend of one segment, then `other` outwards.
fn bight(one: &[DVec3], other: &[DVec3]) -> (Vec<DVec3>, usize) {
    (one.iter().rev().chain(other).copied().collect(), one.len() - 1)
}

/// A leg that winds about the x axis from `turn`, with a radius that grows by `grows` along it.
fn winding_leg(turns: f64, turn: f64, radius: f64, grows: f64, segments: usize) -> Vec<DVec3> {
    let place = |k: usize| {
        let share = k as f64 / segments as f64;
        let (angle, wide) = (TAU * (turns * share + turn), radius + grows * share);
        DVec3::new(LEG_M * share, wide * libm::cos(angle), wide * libm::sin(angle))
    };
    (0..=segments).map(place).collect()
}

#[test]
fn helices_twist_by_their_turns() {
    for turns in [1.0_f64, 2.5, -3.0, 0.0] {
        for (segments, others) in [(200, 200), (200, 170), (60, 91)] {
            for radius in [0.005, 0.02, 0.07] {
                let (nodes, touched) = bight(
                    &winding_leg(turns, 0.0, radius, 0.0, segments),
                    &winding_leg(turns, 0.5, radius, 0.0, others),
                );
                let [now, most] = twist(&nodes, touched, |_| {});
                assert!(
                    (now - turns).abs() < 0.02 * turns.abs() + 1e-9
                        && now.to_bits() == most.to_bits(),
                    "{segments} and {others} segments, {radius} m: {now} for {turns}"
                );
            }
        }
    }
}

/// A straight leg with the other wound about it, and legs that diverge.
#[test]
fn legs_of_different_shape_have_their_twist() {
    let straight = winding_leg(0.0, 0.0, 0.0, 0.0, 150);
    let (nodes, touched) = bight(&straight, &winding_leg(4.0, 0.0, 0.01, 0.0, 200));
    let now = twist(&nodes, touched, |_| {})[0];
    assert!((now / 4.0 - 1.0).abs() < 0.02, "{now}");
    let (nodes, touched) =
        bight(&winding_leg(1.5, 0.0, 0.01, 0.2, 150), &winding_leg(1.5, 0.5, 0.01, 0.2, 150));
    let now = twist(&nodes, touched, |_| {})[0];
    assert!((now / 1.5 - 1.0).abs() < 0.02, "{now}");
}

/// A rigid motion, or a bend of both legs along a plane curve, does not change the twist.
#[test]
fn twist_is_invariant_under_rigid_motion_and_bending() {
    let (nodes, touched) =
        bight(&winding_leg(2.5, 0.0, 0.02, 0.0, 200), &winding_leg(2.5, 0.5, 0.02, 0.0, 200));
    let straight = twist(&nodes, touched, |_| {})[0];
    let turned = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 1.1);
    let moved: Vec<DVec3> = nodes.iter().map(|at| turned * *at + DVec3::splat(7.0)).collect();
    assert!((twist(&moved, touched, |_| {})[0] - straight).abs() < 1e-9);
    let bend = |at: &DVec3| {
        let (angle, out) = (at.x / 1.2, 1.2 + at.y);
        DVec3::new(out * libm::sin(angle), out * libm::cos(angle), at.z)
    };
    let bent: Vec<DVec3> = nodes.iter().map(bend).collect();
    let now = twist(&bent, touched, |_| {})[0];
    assert!((now / straight - 1.0).abs() < 0.02, "{now} for {straight}");
}

/// A straight rope has no legs side by side; nor have legs far apart or beyond a cut.
#[test]
fn only_legs_side_by_side_count() {
    let straight: Vec<DVec3> = (0..=80).map(|k| DVec3::X * (0.05 * f64::from(k))).collect();
    assert!(twist(&straight, 40, |_| {})[0].abs() < 1e-12);
    let (nodes, touched) =
        bight(&winding_leg(0.5, 0.0, 0.3, 0.0, 100), &winding_leg(0.5, 0.5, 0.3, 0.0, 100));
    assert!(twist(&nodes, touched, |_| {})[0].abs() < 1e-12);
    let (nodes, touched) =
        bight(&winding_leg(2.0, 0.0, 0.01, 0.0, 100), &winding_leg(2.0, 0.5, 0.01, 0.0, 100));
    let half = twist(&nodes, touched, |state| state.rope.cut[touched + 51] = true)[0];
    assert!((half - 1.0).abs() < 0.02, "{half}");
}

/// Legs remain for a second after the last contact.
#[test]
fn legs_end_a_second_after_the_last_contact() {
    let (nodes, touched) =
        bight(&winding_leg(1.0, 0.0, 0.01, 0.0, 100), &winding_leg(1.0, 0.5, 0.01, 0.0, 100));
    let model = model(spec(nodes.windows(2).map(|ends| ends[0].distance(ends[1])).collect()));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    state.rope.position.copy_from_slice(&nodes);
    let mut touch = touch(&model);
    touch[0].segment = touched;
    advance(&mut metrics, &model, &mut state, &touch);
    let mut after = |steps: usize| {
        (0..steps).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
        let line = metrics.summary(&model, &state).lines.remove(0);
        [line.twist, line.peak_twist]
    };
    assert!(after(90).iter().all(|turns| (turns - 1.0).abs() < 0.02));
    let [now, most] = after(20);
    assert!(now.abs() < 1e-12 && (most - 1.0).abs() < 0.02, "{now}, {most}");
}

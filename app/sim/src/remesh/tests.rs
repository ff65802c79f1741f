//! Conservation and target lengths of remeshing.

use glam::DVec3;

use super::*;
use crate::contact::rope_on_skin::stored_faces::segment_of;
use crate::metrics::tests::{model, spec};
use crate::model::{JointKind, WeakPlace};
use crate::water::Current;
use crate::{Input, Workspace, step};

/// Rope 0.4 m beside the fixture whale's trunk, 40 m of it in 200 segments, from the bed up.
fn beside() -> Model {
    let mut spec = spec(vec![0.2; 200]);
    for joint in &mut spec.joints {
        joint.position_m += DVec3::new(0.3, 1.6, 0.0);
    }
    spec.settings.resolution = Some(Resolution::default());
    model(spec)
}

/// The rope under 20 N, with a sag of 2 cm and a velocity wave.
fn drawn(model: &Model) -> State {
    let mut state = State::start(model);
    let strain = 20.0 / model.spec.ropes[0].axial_stiffness_n;
    for node in 0..model.node_count {
        let along = node as f64 / 200.0;
        let wave = 12.0 * along;
        state.rope.position[node].z = -40.0 + 40.0 * along * (1.0 + strain);
        state.rope.position[node].x += 0.02 * libm::sin(std::f64::consts::PI * along);
        state.rope.velocity[node] =
            DVec3::new(0.3 * libm::sin(wave), 0.2 * libm::cos(wave), 0.001 * libm::cos(0.2 * wave));
        state.rope.earlier_position[node] =
            state.rope.position[node] - 0.01 * state.rope.velocity[node];
        state.rope.earlier_velocity[node] = state.rope.velocity[node] * 0.9;
    }
    state.rope.tension.fill(20.0);
    state.rope.earlier_dt_s = 0.01;
    state
}

/// Remeshes until nothing changes; returns the number of splits.
fn rest(model: &Model, state: &mut State) -> u64 {
    let mut work = RemeshWorkspace::new(model);
    (0..20).map(|_| remesh(model, state, &mut work).splits).sum()
}

/// Sum over nodes of tributary length times a vector.
fn sum(model: &Model, state: &State, of: impl Fn(&State, usize) -> DVec3) -> DVec3 {
    let lengths = &state.rope.segment_length;
    let hanging = |node: usize| {
        0.5 * (if node > 0 { lengths[node - 1] } else { 0.0 }
            + lengths.get(node).copied().unwrap_or(0.0))
    };
    (0..model.node_count).map(|node| of(state, node) * hanging(node)).sum()
}

/// Elastic and damping tension at a distance from end A.
fn tension_at(model: &Model, state: &State, mut along_m: f64) -> f64 {
    let rope = &model.spec.ropes[0];
    for (segment, length) in state.rope.segment_length.iter().enumerate() {
        if along_m <= *length {
            let chord = state.rope.position[segment + 1] - state.rope.position[segment];
            let rate = (state.rope.velocity[segment + 1] - state.rope.velocity[segment])
                .dot(chord.normalize())
                / length;
            return (rope.axial_stiffness_n * (chord.length() / length - 1.0)
                + rope.axial_damping_n_s * rate)
                .max(0.0);
        }
        along_m -= length;
    }
    f64::NAN
}

#[test]
fn length_and_momentum_are_kept_and_tension_does_not_jump() {
    let model = beside();
    let mut state = drawn(&model);
    let before = state.clone();
    let splits = rest(&model, &mut state);
    assert!(splits > 50, "{splits} splits");
    let whole: f64 = state.rope.segment_length.iter().sum();
    assert!((whole - 40.0).abs() < 1e-12);
    let momentum: [fn(&State, usize) -> DVec3; 3] = [
        |state, node| state.rope.velocity[node],
        |state, node| state.rope.earlier_velocity[node],
        |state, node| state.rope.position[node] - state.rope.earlier_position[node],
    ];
    for of in momentum {
        assert!((sum(&model, &before, of) - sum(&model, &state, of)).length() < 1e-12);
    }
    // Rope may be merged more than once; each merge may change the tension by either limit.
    let jump = (0..4000).map(|k| 0.01 * f64::from(k) + 0.005).map(|along| {
        (tension_at(&model, &state, along) - tension_at(&model, &before, along)).abs()
    });
    let worst = jump.fold(0.0, f64::max);
    println!("{splits} splits, tension changes by {worst:.4} N of 20 N at most");
    assert!(worst < 0.4, "{worst} N");
}

#[test]
fn rope_is_fine_near_skin_coarse_far_and_in_proportion() {
    let model = beside();
    let mut state = drawn(&model);
    rest(&model, &mut state);
    let lengths = &state.rope.segment_length;
    for pair in lengths.windows(2) {
        assert!(pair[0] <= 2.000_001 * pair[1] && pair[1] <= 2.000_001 * pair[0], "{pair:?}");
    }
    let near: Vec<f64> = (0..200)
        .filter(|k| (state.rope.position[*k].z + 20.0).abs() < 0.5)
        .map(|k| lengths[k])
        .collect();
    assert!(near.iter().all(|length| *length <= 0.1001), "{near:?}");
    assert!(lengths.iter().any(|length| *length >= 0.4), "{lengths:?}");
    assert_eq!(rest(&model, &mut state), 0, "what is at rest stays");
}

#[test]
fn the_ratio_near_the_whale_is_reported_where_nodes_do_not_suffice() {
    let ratio = |near_m: f64| {
        let mut spec = beside().spec;
        spec.settings.resolution = Some(Resolution { near_m, edge_m: near_m, far_m: 1.0 });
        let model = model(spec);
        let mut state = drawn(&model);
        let mut work = RemeshWorkspace::new(&model);
        let ratio = (0..20).filter_map(|_| remesh(&model, &mut state, &mut work).near_ratio).last();
        let near = (0..200).filter(|k| (state.rope.position[*k].z + 20.0).abs() < 0.2);
        let longest = near.map(|k| state.rope.segment_length[k]).fold(0.0, f64::max);
        (ratio.unwrap(), longest / near_m)
    };
    let (kept, _) = ratio(0.2);
    assert!(kept < 1.0 + 1e-9, "{kept}");
    let (missed, longest) = ratio(0.01);
    assert!(missed > 2.0 && missed >= longest - 1e-9, "{missed}, {longest} beside the trunk");
}

#[test]
fn end_cut_and_touching_segments_do_not_change() {
    let model = beside();
    let mut state = drawn(&model);
    state.rope.cut[150] = true;
    // In contact: a segment beside the whale, and its neighbour.
    state.rope.friction.sites = vec![(99 << 20) | 24, 100 << 20];
    state.rope.friction.floats = vec![1.0, 2.0];
    let place_of = |state: &State, segment: usize| {
        (state.rope.position[segment], state.arc(&model, segment, 0.0))
    };
    let touching = [99, 100].map(|segment| place_of(&state, segment));
    let cut = place_of(&state, 150);
    assert!(rest(&model, &mut state) > 20);
    let lengths = &state.rope.segment_length;
    assert!([lengths[0], lengths[199]].iter().all(|length| (length - 0.2).abs() < 1e-15));
    let now = state
        .rope
        .friction
        .sites
        .clone()
        .into_iter()
        .map(|site| (segment_of(site), site & 0xf_ffff))
        .collect::<Vec<_>>();
    assert_eq!((now[0].1, now[1].1), (24, 0));
    for ((segment, _), (place, arc_m)) in now.iter().zip(touching) {
        assert!((lengths[*segment] - 0.2).abs() < 1e-15);
        assert_eq!(place_of(&state, *segment).0, place);
        assert!((place_of(&state, *segment).1 - arc_m).abs() < 1e-12);
    }
    let is_cut = (0..200).filter(|segment| state.rope.cut[*segment]).collect::<Vec<_>>();
    assert_eq!(is_cut.len(), 1);
    assert!(
        place_of(&state, is_cut[0]).0 == cut.0
            && (place_of(&state, is_cut[0]).1 - cut.1).abs() < 1e-12
    );
}

/// A kink under tension is not merged, because a single chord would have less tension.
#[test]
fn a_kink_under_tension_is_not_merged() {
    let model = beside();
    let mut state = drawn(&model);
    for node in (0..model.node_count).step_by(2) {
        state.rope.position[node].y += 0.003;
    }
    assert_eq!(rest(&model, &mut state), 0);
}

/// Random numbers from 0 to 1: Knuth's multiplicative congruences, upper bits.
fn draw(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

/// Rope in a current, taut between a fixture and an oscillating end, after one second.
fn towed(seed: &mut u64) -> (Model, State) {
    let mut spec = beside().spec;
    spec.settings.resolution = None;
    spec.whale = None;
    spec.friction = None;
    spec.water.current = Current::uniform(DVec3::new(0.6 * draw(seed), 0.6 * draw(seed), 0.0));
    let pull_m = 40.0 * (40.0 + 400.0 * draw(seed)) / spec.ropes[0].axial_stiffness_n;
    let velocity_m_s = DVec3::new(draw(seed) - 0.5, draw(seed) - 0.5, 0.02 * draw(seed));
    spec.joints[1].position_m.z = pull_m;
    spec.joints[1].kind = JointKind::Driven { velocity_m_s, from_s: 0.0, until_s: 100.0 };
    let model = model(spec);
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    (0..100).for_each(|_| step(&model, &Input::default(), &mut state, &mut workspace).unwrap());
    (model, state)
}

/// One random swap at a time on moving rope: the change of tension at the swap and in the next step.
#[test]
fn moving_taut_rope_keeps_its_tension_through_random_splits_and_merges() {
    let resolution = Resolution::default();
    let mut work = RemeshWorkspace::new(&beside()).unwrap();
    let mut seed = 7;
    let (mut swaps, mut at_once, mut after) = (0, 0.0_f64, 0.0_f64);
    for _ in 0..12 {
        let (model, mut state) = towed(&mut seed);
        for _ in 0..20 {
            work.wanted.iter_mut().for_each(|wanted| *wanted = 0.06 + draw(&mut seed));
            let view = Line::of(&model, &state, 0, &work.wanted, &work.gripped, &resolution);
            let Some((split, merge)) = best(&view) else { continue };
            let mut other = state.clone();
            split_merge::split_and_merge(&model, &mut state, 0, split, merge, &mut work);
            swaps += 1;
            let greatest = other.rope.tension.iter().copied().fold(0.0, f64::max);
            let jump = |state: &State, other: &State| {
                let along = (0..400).map(|k| 0.1 * f64::from(k) + 0.05);
                along
                    .map(|along| {
                        (tension_at(&model, state, along) - tension_at(&model, other, along)).abs()
                    })
                    .fold(0.0, f64::max)
                    / greatest
            };
            let momentum = sum(&model, &state, |state, node| state.rope.velocity[node])
                - sum(&model, &other, |state, node| state.rope.velocity[node]);
            assert!(momentum.length() < 1e-12, "{momentum}");
            at_once = at_once.max(jump(&state, &other));
            for state in [&mut state, &mut other] {
                step(&model, &Input::default(), state, &mut Workspace::new(&model)).unwrap();
            }
            after = after.max(jump(&state, &other));
            assert!((state.rope.segment_length.iter().sum::<f64>() - 40.0).abs() < 1e-12);
        }
    }
    println!(
        "{swaps} swaps: tension changes by {:.3} % of the greatest at once, {:.3} % after a step",
        100.0 * at_once,
        100.0 * after
    );
    assert!(swaps > 150 && at_once < 0.002 && after < 0.002, "{swaps} swaps, {at_once}, {after}");
}

/// Weak places stay where they are as segments move along the line; each has one segment.
#[test]
fn weak_places_keep_their_place_on_the_line() {
    let places: Vec<WeakPlace> = (0..8)
        .map(|index| WeakPlace { at_m: 2.3 + 4.9 * f64::from(index), strength_n: 100.0 })
        .collect();
    let mut spec = beside().spec;
    spec.ropes[0].strength_n = 200.0;
    spec.lines[0].weak_places = places.clone();
    let model = model(spec);
    let mut state = drawn(&model);
    let segment_of = |state: &State, at_m: f64| {
        let all = model.weakest(0, &state.rope.segment_length).enumerate();
        let own: Vec<usize> = all
            .filter(|(_, weakest)| weakest.at_m == Some(at_m))
            .map(|(segment, _)| segment)
            .collect();
        let [segment] = own[..] else { panic!("{own:?}") };
        let [from_m, to_m] = [0.0, 1.0].map(|end| state.arc(&model, segment, end));
        assert!(from_m <= at_m && at_m < to_m, "{from_m} to {to_m} m");
        segment
    };
    let before = places.iter().map(|place| segment_of(&state, place.at_m)).collect::<Vec<_>>();
    assert!(rest(&model, &mut state) > 50);
    let after = places.iter().map(|place| segment_of(&state, place.at_m)).collect::<Vec<_>>();
    assert!(before != after, "{before:?}: nodes moved past the places");
    // A tension between the strengths cuts a weak place, and no other segment.
    state.rope.tension.fill(150.0);
    assert!(crate::parting::part(&model, &mut state));
    let cut: Vec<usize> = (0..200).filter(|segment| state.rope.cut[*segment]).collect();
    let (_, at_m) = state.line_parted[0].unwrap();
    assert_eq!(cut, [segment_of(&state, at_m)]);
    state.rope.tension.fill(99.0);
    assert!(!crate::parting::part(&model, &mut state));
}

/// The bins of rope that is remeshed while it moves: the greatest tension at every place in them is recorded.
#[test]
fn bins_record_tensions_of_rope_whose_segments_move() {
    let mut spec = beside().spec;
    let velocity_m_s = DVec3::new(0.2, 0.0, 0.6);
    spec.joints[1].kind = JointKind::Driven { velocity_m_s, from_s: 0.0, until_s: 100.0 };
    let model = model(spec);
    let (mut state, mut work) = (State::start(&model), Workspace::new(&model));
    let mut metrics = crate::metrics::Metrics::new(&model);
    // Greatest tension at every centimetre.
    let mut places_n = vec![0.0_f64; 4000];
    let mut lengths = Vec::new();
    for _ in 0..60 {
        step(&model, &Input::default(), &mut state, &mut work).unwrap();
        metrics.fold_step(&model, &state, &work);
        lengths.push(state.rope.segment_length.clone());
        let mut to_m = 0.0;
        for (segment, length_m) in state.rope.segment_length.iter().enumerate() {
            let first = (100.0_f64 * to_m).ceil() as usize;
            to_m += length_m;
            let peak_n = work.peak_tension_n[segment].max(work.unconverged_peak_n[segment]);
            for place_n in places_n.iter_mut().take((100.0 * to_m).ceil() as usize).skip(first) {
                *place_n = place_n.max(peak_n);
            }
        }
    }
    lengths.dedup();
    assert!(lengths.len() > 1, "segments moved while it was drawn");
    let line = &metrics.summary(&model, &state).lines[0];
    assert!(line.bin_peaks_n.len() >= 80, "40 m, to rounding");
    for (bin, own) in places_n.chunks(50).enumerate() {
        let (least_n, bin_n) = (own.iter().copied().fold(0.0, f64::max), line.bin_peaks_n[bin]);
        let beside_n = [bin.saturating_sub(1), bin, (bin + 1).min(79)]
            .map(|bin| places_n[50 * bin..50 * bin + 50].iter().copied().fold(0.0, f64::max));
        let most_n = beside_n.into_iter().fold(0.0, f64::max);
        assert!(least_n <= bin_n && bin_n <= most_n, "bin {bin}: {least_n} {bin_n} {most_n}");
    }
    let most = places_n.iter().copied().fold(0.0, f64::max);
    assert!((most - line.peak_tension_n.max(line.unconverged_peak_n)).abs() < 1e-12 && most > 10.0);
}

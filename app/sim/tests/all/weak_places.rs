//! Weak places of a line: where and at which tension it parts, whatever the segments.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use endline_fixtures::gear::{fixed, line, model, rope, water};
use endline_sim::metrics::{Metrics, TENSION_BIN_M};
use endline_sim::model::{Joint, JointKind, Line, Rope, Settings, Strength, WeakPlace};
use endline_sim::water::Water;
use endline_sim::{DVec3, Input, Model, State, Workspace, step};

/// Speed at which the end is drawn away [m/s].
const SPEED_M_S: f64 = 0.5;
/// Strength of the rope itself [N].
const ROPE_N: f64 = 5000.0;

/// A weak place of 2,000 N.
fn weak(at_m: f64) -> WeakPlace {
    WeakPlace { at_m, strength_n: 2000.0 }
}

/// Rope of 10 m without weight, one end of which is drawn away in a vacuum.
fn drawn(segments_m: Vec<f64>, weak_places: Vec<WeakPlace>, strength: Strength) -> Model {
    let hand =
        JointKind::Driven { velocity_m_s: DVec3::X * SPEED_M_S, from_s: 0.0, until_s: 100.0 };
    let joints = vec![
        fixed("post", DVec3::ZERO),
        Joint { id: "hand".into(), kind: hand, position_m: DVec3::X * 10.0 },
    ];
    let lines = vec![Line { segments_m, weak_places, strength, ..line("warp", 10.0, 1) }];
    let settings = Settings { step_s: 0.005, as_placed: true, ..Settings::default() };
    let mut spec =
        model(Water { gravity_m_s2: 0.0, ..water(0.0, 0.0) }, joints, lines, Vec::new(), settings)
            .spec;
    spec.ropes = vec![Rope { strength_n: ROPE_N, axial_damping_n_s: 200.0, ..rope() }];
    Model::new(spec).unwrap_or_else(|errors| panic!("{errors:?}"))
}

/// Runs until the line parts; returns the state, and the greatest tension of its bins [N].
fn until_it_parts(model: &Model) -> (State, Vec<f64>) {
    let (mut state, mut work) = (State::start(model), Workspace::new(model));
    let mut metrics = Metrics::new(model);
    while state.line_parted[0].is_none() {
        assert!(state.time_s < 5.0, "it did not part");
        step(model, &Input::default(), &mut state, &mut work)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        metrics.fold_step(model, &state, &work);
    }
    let bins_n = metrics.summary(model, &state).lines[0].bin_peaks_n.clone();
    (state, bins_n)
}

/// The tension of rope drawn slowly is `EA ε`: 2,000 N at 0.2 m, after 0.4 s. The place is where the line parts, at any resolution.
#[test]
fn a_line_parts_at_its_weak_place_and_at_its_strength() {
    let uneven: Vec<f64> = [0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 1.6, 0.8, 0.4, 0.4, 0.3, 0.2].to_vec();
    let even = |count: usize| vec![10.0 / count as f64; count];
    for segments_m in [even(1), even(7), even(40), uneven] {
        // At 5 m two of the meshes have a node.
        for at_m in [0.0, 0.03, 3.3, 5.0, 9.99, 10.0] {
            let count = segments_m.len();
            let model = drawn(segments_m.clone(), vec![weak(at_m)], Strength::default());
            let (state, bins_n) = until_it_parts(&model);
            let (time_s, parted_m) = state.line_parted[0].expect("it parted");
            assert_eq!(parted_m.to_bits(), at_m.to_bits(), "{count} segments");
            assert!((time_s - 0.4).abs() < 0.02, "{count} segments, {at_m} m: {time_s} s");
            let peak_n = bins_n.iter().copied().fold(0.0, f64::max);
            assert!((peak_n / 2000.0 - 1.0).abs() < 0.01, "{count} segments, {at_m} m: {peak_n} N");
            let cut = state.rope.cut.iter().position(|cut| *cut).expect("a cut segment");
            let [from_m, to_m] = [0.0, 1.0].map(|end| state.arc(&model, cut, end));
            assert!(from_m - 1e-9 <= at_m && at_m <= to_m + 1e-9, "{from_m} to {to_m} m");
        }
    }
}

#[test]
fn the_weakest_of_rope_end_and_places_counts() {
    let at = |at_m, strength_n| WeakPlace { at_m, strength_n };
    let end = Strength { all: 1.0, end_a: 0.3, end_b: 1.0 };
    let whole = Strength::default();
    for (places, strength, parted_m, parted_n) in [
        // Rope of 5,000 N parts before a place of 6,000 N: at the middle of a segment.
        (vec![at(3.3, 6000.0)], whole, None, ROPE_N),
        (vec![at(2.2, 3000.0), at(6.6, 2500.0)], whole, Some(6.6), 2500.0),
        // Two in one segment.
        (vec![at(6.6, 2500.0), at(6.7, 2400.0)], whole, Some(6.7), 2400.0),
        // The knot at the end holds 1,500 N.
        (vec![at(6.6, 2500.0)], end, Some(0.25), 1500.0),
        (vec![at(0.1, 1400.0)], end, Some(0.1), 1400.0),
    ] {
        let (state, bins_n) = until_it_parts(&drawn(vec![0.5; 20], places.clone(), strength));
        let (_, at_m) = state.line_parted[0].expect("it parted");
        assert!(parted_m.is_none_or(|wanted: f64| (wanted - at_m).abs() < 1e-12), "{places:?}");
        let peak_n = bins_n.iter().copied().fold(0.0, f64::max);
        assert!((peak_n / parted_n - 1.0).abs() < 0.01, "{places:?}: {peak_n} N");
    }
}

/// Nothing but strength: until it parts, a line with weak places moves as one without, to the bit.
#[test]
fn weak_places_change_no_bit_until_one_parts() {
    let models = [vec![], vec![weak(3.3), weak(9.9)]]
        .map(|places| drawn(vec![0.25; 40], places, Strength::default()));
    let mut states = [0, 1].map(|which| State::start(&models[which]));
    let mut work = [0, 1].map(|which| Workspace::new(&models[which]));
    for _ in 0..70 {
        for which in [0, 1] {
            step(&models[which], &Input::default(), &mut states[which], &mut work[which])
                .unwrap_or_else(|stop| panic!("{stop:?}"));
        }
        assert!(states[0] == states[1], "at {} s", states[0].time_s);
    }
    assert!(states[0].rope.tension[0] > 1500.0);
}

#[test]
fn a_weak_place_that_is_not_on_the_line_is_refused() {
    let spec = drawn(vec![0.5; 20], Vec::new(), Strength::default()).spec;
    for places in [
        vec![weak(10.1)],
        vec![weak(-0.1)],
        vec![weak(f64::NAN)],
        vec![weak(5.0), weak(4.0)],
        vec![WeakPlace { at_m: 5.0, strength_n: 0.0 }],
    ] {
        let mut spec = spec.clone();
        spec.lines[0].weak_places = places.clone();
        let Err(errors) = Model::new(spec) else { panic!("accepted: {places:?}") };
        assert!(errors[0].message.contains("weak place"), "{errors:?}");
    }
}

/// Rope that is drawn up: each bin has the greatest tension of the segments in it, found here by the intervals that overlap.
#[test]
fn bins_have_the_greatest_tension_of_the_segments_in_them() {
    let segments_m = [0.13, 0.26, 0.52, 1.04, 2.08, 2.08, 1.04, 1.04, 0.9, 0.5, 0.25, 0.1];
    let mut spec = drawn(segments_m.to_vec(), Vec::new(), Strength::default()).spec;
    spec.water.gravity_m_s2 = 9.81;
    spec.joints[1].position_m = DVec3::Z * 10.0;
    let velocity_m_s = DVec3::Z * SPEED_M_S;
    spec.joints[1].kind = JointKind::Driven { velocity_m_s, from_s: 0.0, until_s: 100.0 };
    let model = Model::new(spec).unwrap_or_else(|errors| panic!("{errors:?}"));
    let (mut state, mut work) = (State::start(&model), Workspace::new(&model));
    let mut metrics = Metrics::new(&model);
    let mut greatest_n = vec![0.0_f64; segments_m.len()];
    for _ in 0..40 {
        step(&model, &Input::default(), &mut state, &mut work)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        metrics.fold_step(&model, &state, &work);
        for (segment, greatest) in greatest_n.iter_mut().enumerate() {
            let now = work.peak_tension_n[segment].max(work.unconverged_peak_n[segment]);
            *greatest = greatest.max(now);
        }
    }
    let line = &metrics.summary(&model, &state).lines[0];
    assert_eq!(line.bin_peaks_n.len(), 20);
    for (bin, peak_n) in line.bin_peaks_n.iter().enumerate() {
        let [from_m, to_m] = [bin, bin + 1].map(|end| end as f64 * TENSION_BIN_M);
        let overlaps = |segment: &usize| {
            let begin_m: f64 = segments_m[..*segment].iter().sum();
            begin_m < to_m && begin_m + segments_m[*segment] > from_m
        };
        let own = (0..segments_m.len()).filter(overlaps);
        let wanted_n = own.map(|segment| greatest_n[segment]).fold(0.0, f64::max);
        assert_eq!(peak_n.to_bits(), wanted_n.to_bits(), "bin {bin}");
    }
    let peaks = &line.bin_peaks_n;
    // 10 m of 0.06 kg/m hang from the hand.
    assert!(peaks[19] > peaks[0] + 3.0, "{peaks:?}");
}

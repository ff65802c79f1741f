//! Rope wrapped about the right whale at the start: turns, distance from the skin, used rope, problems.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::idle::{TestHooks, library};
use endline_gear::{Diagnostic, Options, Scenario, assemble};
use endline_sdk::BodyPart;
use endline_sim::geometry::distance::segment_triangle;
use endline_sim::metrics::Metrics;
use endline_sim::whale::axes::{PosedAxis, axes_of};
use endline_sim::whale::{pose, skin_all};
use endline_sim::{ContactPoint, DQuat, DVec3, Model, ModelSpec, State};

const RADIUS_M: f64 = 0.005;

/// A right whale at rest 20 m down, heading north, and a rope in a wrap between two free ends.
fn scenario(ends: [DVec3; 2], length_m: f64, wraps: &str) -> String {
    let joint = |id: &str, at: DVec3| {
        format!(
            "[[joint]]\nid = \"{id}\"\nposition = [\"{} m\", \"{} m\", \"{} m\"]\n",
            at.x, at.y, at.z
        )
    };
    format!(
        "format = 1\nkind = \"scenario\"\nname = \"wound\"\nsource = \"test\"\nconfidence = \"estimate\"\nduration = \"1 s\"\n\
         segment = \"0.5 m\"\nstart = \"placed\"\n[site]\nitem = \"cape-cod-bay\"\n[current]\nspeed = \"0 m/s\"\n\
         [whale]\nitem = \"right-whale\"\nlength = \"13 m\"\nposition = [\"0 m\", \"0 m\"]\ndepth = \"20 m\"\nheading = \"0 deg\"\n\
         speed = \"0 m/s\"\nmotion = \"test.idle\"\n[friction]\nmodel = \"test.idle\"\n{}{}\
         [[line]]\nid = \"rope\"\nrope = \"polysteel-3-8\"\nfrom = \"low\"\nto = \"high\"\nlength = \"{length_m} m\"\nstart = \"wrapped\"\n{wraps}",
        joint("low", ends[0]),
        joint("high", ends[1])
    )
}

fn read(text: &str) -> Result<ModelSpec, Vec<Diagnostic>> {
    let scenario = Scenario::read("test.toml", text)?;
    assemble(&scenario, library(), &TestHooks::without_effect(), &Options::default())
}

/// The least distance of the line's segments from the skin [m].
fn clearance(spec: &ModelSpec) -> f64 {
    let whale = spec.whale.as_ref().unwrap();
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(&whale.skin, whale.position_m, whale.orientation, &whale.start_posture(), &mut bones);
    skin_all(&whale.skin, &bones, &mut places);
    let mut least = f64::INFINITY;
    for ends in spec.lines[0].start_m.windows(2) {
        for corners in &whale.skin.triangles {
            let corners = corners.map(|corner| places[corner as usize]);
            if corners.iter().all(|corner| corner.distance(ends[0]) > 1.0) {
                continue;
            }
            least = least.min(segment_triangle([ends[0], ends[1]], corners).distance);
        }
    }
    least
}

#[test]
fn rope_lies_clear_of_the_skin_with_all_its_length() {
    let out = [DVec3::new(-6.0, 0.0, -26.0), DVec3::new(-6.0, 1.0, -14.0)];
    for part in [BodyPart::LeftFlipper, BodyPart::Body, BodyPart::Peduncle] {
        for turns in [0.5_f64, 1.0, 2.75, -3.0] {
            let text = scenario(
                out,
                50.0,
                &format!("[[line.wrap]]\npart = \"{}\"\nturns = {turns}\n", part.name()),
            );
            let spec = read(&text)
                .unwrap_or_else(|problems| panic!("{} {turns}: {}", part.name(), problems[0]));
            let line = &spec.lines[0];
            assert!((line.segments_m.iter().sum::<f64>() - 50.0).abs() < 1e-9);
            let (least, radius) = (clearance(&spec), 0.5 * spec.ropes[0].diameter_m);
            let bends = turned(&spec, part);
            println!(
                "{} {turns}: {} segments, {:.2} mm clear, bends {bends:.3}",
                part.name(),
                line.segments_m.len(),
                1e3 * least
            );
            // The ends determine the bends except for whole turns; the azimuth is chosen for the nearest number.
            assert!(
                part != BodyPart::Peduncle || (bends - turns.abs()).abs() < 0.55,
                "{turns}: its bends are {bends}"
            );
            assert!(
                least > 0.9 * radius && least < 1.1 * radius + RADIUS_M,
                "{}: {least} m",
                part.name()
            );
        }
    }
}

/// The first and last node of the wrap, by its short segments of equal length.
fn wrap_of(spec: &ModelSpec) -> (usize, usize) {
    let segments = &spec.lines[0].segments_m;
    let same = |from: usize| {
        (from..segments.len()).take_while(|k| (segments[*k] - segments[from]).abs() < 1e-9).count()
    };
    let from = (0..segments.len())
        .filter(|from| segments[*from] < 0.06)
        .max_by_key(|from| same(*from))
        .unwrap();
    (from, from + same(from))
}

/// A wrap with straight rope of 1.5 m at both ends.
fn wrapped(part: BodyPart, turns: f64, segment_m: f64) -> ModelSpec {
    let wrap = format!(
        "[[line.wrap]]\npart = \"{}\"\nturns = {turns}\nazimuth = \"60 deg\"\nsegment = \"{segment_m} m\"\n",
        part.name()
    );
    // The places of its ends do not matter, but their paths must be free.
    let north = if part == BodyPart::LeftFlipper { 2.0 } else { -3.0 };
    let far = [DVec3::new(-4.0, north, -12.0), DVec3::new(-4.0, north, -28.0)];
    let pairs =
        far.iter().flat_map(|one| far.iter().map(move |other| [*one, *other + DVec3::Y * 0.1]));
    let spec = pairs.into_iter().find_map(|ends| read(&scenario(ends, 90.0, &wrap)).ok());
    let spec = spec.unwrap_or_else(|| panic!("{} {turns}: none of these ends", part.name()));
    let (from, to) = wrap_of(&spec);
    let (nodes, segments) = (&spec.lines[0].start_m, &spec.lines[0].segments_m);
    let [first, last] =
        [nodes[from] - nodes[from + 1], nodes[to] - nodes[to - 1]].map(|way| way.normalize() * 1.5);
    let rope_m: f64 = segments[from..to].iter().sum();
    let ends = [nodes[from] + first, nodes[to] + last];
    read(&scenario(ends, rope_m + 3.001, &wrap))
        .unwrap_or_else(|problems| panic!("{} {turns}: {}", part.name(), problems[0]))
}

/// Wraps on a part where the middle of the rope touches it, with the whole turned and moved.
fn measured(spec: ModelSpec, part: BodyPart, turn: DQuat, shift: DVec3) -> f64 {
    let model = Model::new(spec).unwrap_or_else(|errors| panic!("{errors:?}"));
    let mut state = State::start(&model);
    state.rope.position.iter_mut().for_each(|node| *node = turn * *node + shift);
    let whale = state.whale.as_mut().unwrap();
    (whale.position, whale.orientation) = (turn * whale.position + shift, turn * whale.orientation);
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    let triangle = skin.regions.iter().position(|region| region.part() == part).unwrap();
    let contact = ContactPoint {
        is_knot: false,
        line: 0,
        segment: model.segment_count / 2,
        fraction: 0.5,
        triangle,
        barycentric: [1.0 / 3.0; 3],
        region: skin.regions[triangle],
        position: DVec3::ZERO,
        normal: DVec3::Z,
        distance_m: 0.005,
        length_m: 0.01,
        normal_force_n: 1.0,
        friction_n: DVec3::ZERO,
        slip_m: DVec3::ZERO,
        dt_s: 0.01,
    };
    let mut metrics = Metrics::new(&model);
    metrics.fold(&model, &state, &[contact]);
    metrics.summary(&model, &state).whale.unwrap().regions[part as usize].wraps
}

/// Total turn of a rope's direction about the axis of the whale or the flipper: the sum of its bends [turns].
fn turned(spec: &ModelSpec, part: BodyPart) -> f64 {
    let whale = spec.whale.as_ref().unwrap();
    let (mut bones, mut axis) = (Vec::new(), PosedAxis::default());
    pose(&whale.skin, whale.position_m, whale.orientation, &whale.start_posture(), &mut bones);
    let rest = axes_of(&whale.skin)[part as usize].clone().unwrap();
    rest.pose(&bones, &mut axis);
    let nodes = &spec.lines[0].start_m;
    let along = axis.locate(nodes[nodes.len() / 2]).unwrap().along();
    let flat = |way: DVec3| (way - along * way.dot(along)).normalize();
    let ways: Vec<DVec3> = nodes.windows(2).map(|pair| flat(pair[1] - pair[0])).collect();
    let bend = |pair: &[DVec3]| pair[0].cross(pair[1]).dot(along).atan2(pair[0].dot(pair[1]));
    ways.windows(2).map(bend).sum::<f64>().abs() / std::f64::consts::TAU
}

/// The laid turns, the sum of the bends and the measured wraps agree, on a round trunk and on a thin blade.
#[test]
fn wraps_laid_by_construction_are_counted_on_the_right_whale() {
    let (turn, shift) = (
        DQuat::from_euler(endline_sim::EulerRot::ZYX, 1.0, -0.4, 2.0),
        DVec3::new(30.0, -7.0, -12.0),
    );
    for (part, segment_m) in
        [(BodyPart::LeftFlipper, 0.02), (BodyPart::Body, 0.05), (BodyPart::Peduncle, 0.05)]
    {
        for turns in [0.5, 1.0, 2.25, 3.0] {
            let [whole, halved] =
                [segment_m, 0.5 * segment_m].map(|segment_m| wrapped(part, turns, segment_m));
            let bends = turned(&whole, part);
            let counts = [
                measured(whole.clone(), part, DQuat::IDENTITY, DVec3::ZERO),
                measured(halved, part, DQuat::IDENTITY, DVec3::ZERO),
                measured(whole, part, turn, shift),
            ];
            println!("{} {turns}: {counts:.4?}, bends {bends:.4}", part.name());
            assert!((bends - turns).abs() < 0.02, "{} {turns}: its bends are {bends}", part.name());
            assert!(
                counts.iter().all(|count| (count - turns).abs() < 0.05),
                "{} {turns}: {counts:?}",
                part.name()
            );
            assert!(
                (counts[0] - bends).abs() < 0.05,
                "{} {turns}: {counts:?}, its bends {bends}",
                part.name()
            );
            assert!(
                (counts[0] - counts[1]).abs() < 0.02 && (counts[0] - counts[2]).abs() < 1e-9,
                "{counts:?}"
            );
        }
    }
}

#[test]
fn pretension_and_slack_are_in_the_rope() {
    let laid = |more: &str| {
        let wrap =
            format!("[[line.wrap]]\npart = \"peduncle\"\nturns = 2\nazimuth = \"90 deg\"\n{more}");
        let spec = read(&scenario(
            [DVec3::new(-6.0, 0.0, -26.0), DVec3::new(-6.0, 1.0, -14.0)],
            50.0,
            &wrap,
        ));
        let spec = spec.unwrap_or_else(|problems| panic!("{}", problems[0]));
        let (from, to) = wrap_of(&spec);
        let line = &spec.lines[0];
        let way: f64 =
            line.start_m[from..=to].windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let rope: f64 = line.segments_m[from..to].iter().sum();
        (way, rope, spec.ropes[0].axial_stiffness_n)
    };
    let (tight, rope, _) = laid("");
    assert!((tight / rope - 1.0).abs() < 2e-3, "{tight} m of way, {rope} m of rope");
    let (way, rope, stiffness_n) = laid("pretension = \"2 kN\"\n");
    assert!(
        ((way / rope) / (1.0 + 2000.0 / stiffness_n) - 1.0).abs() < 2e-3,
        "{way} m of way, {rope} m of rope"
    );
    let (loose, rope, _) = laid("slack = 0.2\n");
    assert!(
        (loose / tight - 1.2).abs() < 0.01 && (loose / rope - 1.0).abs() < 2e-3,
        "{loose} m, {rope} m"
    );
}

#[test]
fn an_impossible_wrap_is_reported_with_its_place() {
    let ends = [DVec3::new(-6.0, 0.0, -26.0), DVec3::new(-6.0, 1.0, -14.0)];
    let good = "[[line.wrap]]\npart = \"peduncle\"\nturns = 2\n";
    let refused = |text: &str, line: &str, words: &str| {
        let at = 1 + text
            .lines()
            .position(|known| known.contains(line))
            .unwrap_or_else(|| panic!("no line has {line}"));
        let problems = read(text).err().unwrap_or_else(|| panic!("this is taken:\n{text}"));
        assert!(
            problems
                .iter()
                .any(|problem| problem.line == at && problem.to_string().contains(words)),
            "{words}: {}",
            problems[0]
        );
    };
    let with = |from: &str, to: &str| scenario(ends, 50.0, &good.replace(from, to));
    refused(&with("peduncle", "pedunkle"), "part =", "did you mean `peduncle`");
    refused(&with("turns = 2", "turns = 0"), "turns =", "almost zero");
    refused(&with("turns = 2", "turns = 2\nstation = 1.2"), "station =", "between 0 and 1");
    refused(
        &with("turns = 2", "turns = 2\nslack = 0.1\npretension = \"5 N\""),
        "slack =",
        "keep one of them",
    );
    refused(&with("turns = 2", "turns = 2\nloops = 3"), "loops =", "unknown field `loops`");
    refused(&scenario(ends, 50.0, ""), "[[line]]", "`wrap` is missing");
    refused(&scenario(ends, 12.0, good), "id = \"rope\"", "its path needs");
    refused(
        &scenario(ends, 50.0, good).replace("start = \"placed\"\n", ""),
        "id = \"rope\"",
        "starts where it is laid",
    );
    refused(
        &with("turns = 2", "turns = 20\npitch = \"2 m\""),
        "[[line.wrap]]",
        "there is no skin of the",
    );
}

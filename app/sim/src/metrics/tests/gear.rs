//! Lines, links, bodies, probes and routes against values computed by hand.

use endline_sdk::Side;

use super::encounter::single;
use super::*;
use crate::metrics::{EventKind, LeadsTo, Route, end_tension, energy, reading, routes};
use crate::model::EnergyForm;

/// A vertical line that hangs from its top: the tension at a height is the weight in water of the rope below.
#[test]
fn end_tension_of_a_hanging_line_is_its_whole_weight() {
    for segments in [1, 2, 7] {
        let model = model(spec(vec![20.0 / f64::from(segments); segments as usize]));
        let mut state = State::start(&model);
        let wet = (0.1 - 5e-5 * 1025.0) * 9.81;
        for k in 0..segments {
            state.rope.tension[k as usize] =
                5.0 + wet * 20.0 * (f64::from(k) + 0.5) / f64::from(segments);
        }
        assert!((end_tension(&model, &state, 0, LineEnd::A) - 5.0).abs() < 1e-9);
        assert!((end_tension(&model, &state, 0, LineEnd::B) - (5.0 + wet * 20.0)).abs() < 1e-9);
    }
}

/// A line along the current: tension decreases by the drag from the held end to the free one, and its own motion counts.
#[test]
fn end_tension_of_a_trailed_line_is_its_whole_drag() {
    let mut spec = spec(vec![0.5; 8]);
    spec.joints[1].position_m = DVec3::new(4.0, 0.0, -40.0);
    spec.water.gravity_m_s2 = 0.0;
    spec.water.current.surface_m_s = DVec3::X * 2.5;
    let model = model(spec);
    let mut state = State::start(&model);
    state.rope.velocity.fill(DVec3::X * 1.0);
    let drag = 0.5 * 1025.0 * 0.01 * std::f64::consts::PI * 0.01 * 1.5 * 1.5;
    for k in 0..8_u32 {
        state.rope.tension[k as usize] = drag * 0.5 * (7.5 - f64::from(k));
    }
    assert!((end_tension(&model, &state, 0, LineEnd::A) - 4.0 * drag).abs() < 1e-9);
    assert!(end_tension(&model, &state, 0, LineEnd::B).abs() < 1e-9);
}

#[test]
fn a_slack_or_cut_end_has_no_tension() {
    let model = model(spec(vec![1.0; 4]));
    let mut state = State::start(&model);
    state.rope.tension = vec![-3.0, 5.0, 5.0, 5.0];
    state.rope.cut[3] = true;
    for end in [LineEnd::A, LineEnd::B] {
        assert!(end_tension(&model, &state, 0, end).abs() < 1e-12);
    }
}

#[test]
fn peaks_have_their_time_and_parting_is_reported_once() {
    let mut spec = spec(vec![1.0; 4]);
    spec.links =
        vec![Link { id: "weak".into(), line: 0, end: LineEnd::B, rating_n: 90.0, enabled: true }];
    let model = model(spec);
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    for step in 1..=100_u32 {
        let wave = libm::sin(f64::from(step) * 0.05) * 100.0;
        state.rope.tension = vec![0.5 * wave, wave, 0.2 * wave, 0.9 * wave];
        if step >= 60 {
            (state.link_parted_s[0], state.rope.cut[3]) = (Some(0.595), true);
        }
        advance(&mut metrics, &model, &mut state, &[]);
    }
    let summary = metrics.summary(&model, &state);
    assert!((summary.lines[0].peak_tension_n - libm::sin(1.55) * 100.0).abs() < 1e-9);
    assert!((summary.lines[0].peak_at_s - 0.31).abs() < 1e-12);
    assert!((summary.links[0].peak_tension_n - libm::sin(1.55) * 90.0).abs() < 1e-9);
    assert_eq!(summary.links[0].parted_at_s, Some(0.595));
    let reported: Vec<_> = metrics
        .events()
        .iter()
        .map(|event| (event.kind, event.subject.as_str(), event.time_s))
        .collect();
    assert_eq!(reported, [(EventKind::LinkParted, "weak", 0.6)]);
}

/// A line of four segments with a weak link at its end B.
fn with_link() -> Model {
    let mut spec = spec(vec![1.0; 4]);
    spec.links =
        vec![Link { id: "weak".into(), line: 0, end: LineEnd::B, rating_n: 90.0, enabled: true }];
    model(spec)
}

/// After a step that parts a link its tension is zero; the peaks of the step contain its load.
#[test]
fn a_step_peak_outlives_the_parting() {
    let model = with_link();
    let (mut metrics, mut state, mut workspace) =
        (Metrics::new(&model), State::start(&model), crate::Workspace::new(&model));
    (state.time_s, state.link_parted_s[0], state.rope.cut[3]) = (0.01, Some(0.007), true);
    workspace.peak_tension_n = vec![60.0, 70.0, 95.0, 91.0];
    metrics.fold_step(&model, &state, &workspace);
    let summary = metrics.summary(&model, &state);
    let peaks = [
        summary.links[0].peak_tension_n,
        summary.lines[0].peak_tension_n,
        metrics.events()[0].value,
    ];
    assert!(
        peaks.iter().zip([91.0, 95.0, 91.0]).all(|(got, wanted)| (got - wanted).abs() < 1e-12),
        "{peaks:?}"
    );
}

/// The tension of unconverged solver steps is separate from the peaks.
#[test]
fn peaks_come_from_solver_steps_that_converged() {
    let model = with_link();
    let (mut metrics, mut state, mut workspace) =
        (Metrics::new(&model), State::start(&model), crate::Workspace::new(&model));
    for (time_s, converged_n, unconverged_n) in [(0.01, 60.0, 0.0), (0.02, 0.0, 4000.0)] {
        state.time_s = time_s;
        workspace.peak_tension_n = vec![converged_n; 4];
        workspace.unconverged_peak_n = vec![unconverged_n; 4];
        metrics.fold_step(&model, &state, &workspace);
    }
    let summary = metrics.summary(&model, &state);
    let (line, link) = (&summary.lines[0], &summary.links[0]);
    let reported = [line.peak_tension_n, link.peak_tension_n, line.peak_at_s];
    assert!(
        reported.iter().zip([60.0, 60.0, 0.01]).all(|(got, wanted)| (got - wanted).abs() < 1e-12)
    );
    let apart = [line.unconverged_peak_n, link.unconverged_peak_n];
    assert!(apart.iter().all(|peak| (peak - 4000.0).abs() < 1e-12), "{apart:?}");
}

/// A reading of 3 + 2 t has mean 3 + T over T seconds, also with uneven steps.
#[test]
fn probe_means_weigh_by_time() {
    let mut spec = spec(vec![1.0; 4]);
    spec.probes = vec![
        Probe { id: "z".into(), target: ProbeTarget::LineMiddle(0, 2) },
        Probe { id: "end".into(), target: ProbeTarget::Joint(1, 0) },
    ];
    let model = model(spec);
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    for time in [0.0, 0.1, 0.15, 0.9, 1.0, 4.0] {
        state.time_s = time;
        state.rope.position[2].z = 3.0 + 2.0 * time;
        state.rope.position[4].x = -time;
        metrics.fold(&model, &state, &[]);
    }
    let probes = metrics.summary(&model, &state).probes;
    assert!((probes[0].mean - 7.0).abs() < 1e-12, "{:?}", probes[0]);
    assert_eq!(
        (probes[0].last, probes[0].min, probes[0].max, probes[0].unit),
        (11.0, 3.0, 11.0, "m")
    );
    assert!((probes[1].mean + 2.0).abs() < 1e-12 && probes[1].max.abs() < 1e-12, "{:?}", probes[1]);
}

#[test]
fn a_dragged_trap_and_a_submerged_buoy_are_reported() {
    let mut spec = spec(vec![1.0; 4]);
    spec.bodies = vec![
        body("trap", BodyRole::Trap, DVec3::new(0.0, 0.0, -50.0)),
        body("buoy", BodyRole::Buoy, DVec3::ZERO),
    ];
    let model = model(spec);
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    for step in 1..=300_u32 {
        let time = f64::from(step) * STEP_S;
        state.bodies[0].position.x = 0.5 * time;
        state.bodies[0].velocity.x = 0.5;
        state.bodies[1].position.z = -0.4 * libm::sin(std::f64::consts::PI * time);
        advance(&mut metrics, &model, &mut state, &[]);
    }
    let reported: Vec<_> =
        metrics.events().iter().map(|event| (event.kind, event.subject.as_str())).collect();
    let under = (EventKind::PulledUnder, "buoy");
    assert_eq!(reported, [under, (EventKind::Dragged, "trap"), under]);
    let (sunk, dragged) = (&metrics.events()[0], &metrics.events()[1]);
    assert!(
        (sunk.time_s - 0.17).abs() < 1e-9,
        "half its height is under at asin(1/2)/pi = 0.1667 s: {sunk:?}"
    );
    assert!((dragged.time_s - 2.015).abs() < 0.006 && dragged.value > 1.0, "{dragged:?}");
    let bodies = metrics.summary(&model, &state).bodies;
    assert!(
        (bodies[0].peak_speed_m_s - 0.5).abs() < 1e-12
            && (bodies[0].position_m.x - 1.5).abs() < 1e-12
    );
}

/// Four metres of line at 1 kg/m, stretched by a tenth and falling: each form by hand.
#[test]
fn energy_has_its_three_forms() {
    let mut spec = spec(vec![1.0; 4]);
    (spec.ropes[0].mass_kg_m, spec.ropes[0].axial_stiffness_n) = (1.0, 1000.0);
    spec.bodies = vec![body("weight", BodyRole::Weight, DVec3::new(0.0, 0.0, 5.0))];
    let model = model(spec);
    let mut state = State::start(&model);
    for (node, place) in state.rope.position.iter_mut().enumerate() {
        *place = DVec3::new(1.1 * node as f64, 0.0, 2.0);
    }
    state.rope.velocity.fill(DVec3::Z * -3.0);
    let mass_kg = model.spec.bodies[0].mass_kg;
    (state.bodies[0].velocity, state.bodies[0].spin) = (DVec3::X * 2.0, DVec3::ZERO);
    let gravity = model.spec.water.gravity_m_s2;
    for (form, wanted) in [
        (EnergyForm::Kinetic, 0.5 * 4.0 * 9.0 + 0.5 * mass_kg * 4.0),
        (EnergyForm::Height, gravity * (4.0 * 2.0 + mass_kg * 5.0)),
        (EnergyForm::Stretch, 4.0 * 0.5 * 1000.0 * 0.01),
    ] {
        let got = energy(&model, &state, form);
        assert!((got - wanted).abs() < 1e-9 * wanted, "{form:?}: {got} J for {wanted} J");
    }
    state.rope.position[1].x = 0.9;
    let slack = energy(&model, &state, EnergyForm::Stretch);
    assert!(
        (slack - 500.0 * (0.3 * 0.3 + 2.0 * 0.01)).abs() < 1e-9,
        "a slack segment holds nothing: {slack} J"
    );
}

/// The greatest height is that of the highest node far enough from both ends, above a bed that may slope, or that of the
/// midpoint without such a node.
#[test]
fn the_height_of_a_line_excludes_its_ends() {
    let mut spec = spec(vec![1.0, 3.0, 2.0]);
    let at = |away_m| Probe { id: String::new(), target: ProbeTarget::Height(0, away_m) };
    spec.probes = [0.0, 1.5, 3.0].map(at).into();
    let depth = spec.water.depth_m;
    let model = model(spec);
    let mut state = State::start(&model);
    for (node, height) in [2.0, 7.0, 5.0, 6.0].into_iter().enumerate() {
        state.rope.position[node] = DVec3::Z * (height - depth);
    }
    let read: Vec<f64> =
        model.spec.probes.iter().map(|probe| reading(&model, &state, probe.target)).collect();
    // The nodes at 0 m, 1 m and 6 m of 6 m are within 1.5 m of the ends; the midpoint is at two thirds of the second segment.
    let middle = 7.0 - 2.0 * 2.0 / 3.0;
    assert!(
        read.iter().zip([7.0, 5.0, middle]).all(|(got, wanted)| (got - wanted).abs() < 1e-12),
        "{read:?}"
    );
}

/// Positions are linear between nodes, tensions between the middles of segments.
#[test]
fn a_line_is_read_at_any_length() {
    let mut spec = spec(vec![1.0, 3.0, 2.0]);
    let at = |target| Probe { id: String::new(), target };
    spec.probes = vec![
        at(ProbeTarget::LineAt(0, 2.5, 2)),
        at(ProbeTarget::TensionAt(0, 1.0)),
        at(ProbeTarget::TensionAt(0, 5.9)),
    ];
    let model = model(spec);
    let mut state = State::start(&model);
    for (node, height) in [0.0, 1.0, 5.0, 5.0].into_iter().enumerate() {
        state.rope.position[node] = DVec3::Z * height;
    }
    state.rope.tension = vec![10.0, 20.0, 60.0];
    let read: Vec<f64> =
        model.spec.probes.iter().map(|probe| reading(&model, &state, probe.target)).collect();
    // Middles at 0.5 m, 2.5 m and 5 m: a length of 1 m is at a quarter between the first and the second.
    assert!(
        read.iter().zip([3.0, 12.5, 60.0]).all(|(got, wanted)| (got - wanted).abs() < 1e-12),
        "{read:?}"
    );
}

/// The whale heads west instead of east: a point 1 m before its origin is 1 m west of it.
#[test]
fn the_place_of_the_whale_and_of_its_skin_moves_and_turns_with_it() {
    let mut spec = spec(vec![1.0]);
    let skin = &spec.whale.as_ref().unwrap().skin;
    let (triangle, barycentric) = ray(skin, BodyPart::Body, trunk_middle(1.05), DVec3::Z);
    let hitch = Hitch { triangle, barycentric, stand_off_m: 0.0 };
    let corners = skin.triangles[triangle].map(|vertex| skin.vertices[vertex as usize]);
    let rest: DVec3 = corners.into_iter().zip(barycentric).map(|(at, share)| at * share).sum();
    let targets = (0..3).map(ProbeTarget::WhaleOrigin);
    let targets = targets.chain((0..3).map(|axis| ProbeTarget::Skin(hitch, axis)));
    spec.probes = targets.map(|target| Probe { id: String::new(), target }).collect();
    let model = model(spec);
    let mut state = State::start(&model);
    let whale = state.whale.as_mut().unwrap();
    whale.position = DVec3::new(3.0, -2.0, -10.0);
    whale.orientation = DQuat::from_rotation_z(std::f64::consts::PI);
    let read: Vec<f64> =
        model.spec.probes.iter().map(|probe| reading(&model, &state, probe.target)).collect();
    let wanted = [3.0, -2.0, -10.0, 3.0 - rest.x, -2.0 - rest.y, -10.0 + rest.z];
    assert!((rest.x - 1.05).abs() < 0.1 && rest.z > 1.0, "{rest}");
    assert!(
        read.iter().zip(wanted).all(|(got, wanted)| (got - wanted).abs() < 1e-9),
        "{read:?} {wanted:?}"
    );
}

/// A contact of a line's segment with a part, on the ray from its axis.
fn on(model: &Model, line: usize, segment: usize, part: BodyPart, toward: DVec3) -> ContactPoint {
    let from = match part {
        BodyPart::Body => trunk_middle(0.55),
        BodyPart::Peduncle => trunk_middle(-4.55),
        _ => FLIPPER_ROOT.lerp(FLIPPER_TIP, 0.52),
    };
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    ContactPoint { line, segment, ..contact(model, 0, ray(skin, part, from, toward)) }
}

/// Routes with cuts, their stations by part and side.
fn found(contacts: &[ContactPoint], cuts: &[usize]) -> Vec<Route> {
    let model = model(single());
    let mut state = State::start(&model);
    cuts.iter().for_each(|segment| state.rope.cut[*segment] = true);
    routes(&model, &state, contacts)
}

#[test]
fn stations_are_in_the_order_of_the_rope_across_a_splice() {
    let model = model(single());
    let side = |sign: f64| DVec3::new(0.0, sign, 0.1);
    let contacts = [
        on(&model, 1, 25, BodyPart::Peduncle, side(-1.0)),
        on(&model, 0, 4, BodyPart::LeftFlipper, DVec3::Z),
        on(&model, 0, 5, BodyPart::LeftFlipper, DVec3::Z),
        on(&model, 0, 9, BodyPart::Body, side(1.0)),
        on(&model, 0, 12, BodyPart::Body, DVec3::new(0.0, 0.01, 1.0)),
    ];
    let routes = found(&contacts, &[]);
    let [route] = routes.as_slice() else { panic!("{routes:?}") };
    let stations: Vec<_> =
        route.stations.iter().map(|station| (station.part, station.side)).collect();
    assert_eq!(
        stations,
        [
            (BodyPart::LeftFlipper, None),
            (BodyPart::Body, Some(Side::Left)),
            (BodyPart::Body, None),
            (BodyPart::Peduncle, Some(Side::Right)),
        ]
    );
    assert!(route.stations.iter().all(|station| !station.in_mouth));
}

/// The trap's line is 10 m long, the buoy's 8 m, in segments of 0.5 m; contacts are at the middle of segments.
#[test]
fn ends_are_what_rope_leads_to_and_how_far() {
    let model = model(single());
    let touch = |line, segment| on(&model, line, segment, BodyPart::Body, DVec3::Z);
    let ends = |contacts: &[ContactPoint], cuts: &[usize]| {
        let routes = found(contacts, cuts);
        let end = |route: &Route| route.ends.map(|end| (end.leads_to, end.rope_m));
        routes.iter().map(end).collect::<Vec<_>>()
    };
    let one = [touch(0, 4)];
    assert_eq!(ends(&one, &[]), [[(LeadsTo::Body(0), 2.25), (LeadsTo::Body(1), 15.75)]]);
    assert_eq!(ends(&one, &[0]), [[(LeadsTo::Broken, 1.75), (LeadsTo::Body(1), 15.75)]]);
    assert_eq!(ends(&one, &[24]), [[(LeadsTo::Body(0), 2.25), (LeadsTo::Broken, 9.75)]]);
    // The tail beyond the buoy and the groundline are separate strands.
    let two = [touch(2, 37), touch(3, 45)];
    assert_eq!(
        ends(&two, &[]),
        [
            [(LeadsTo::Body(1), 0.75), (LeadsTo::Bare, 1.25)],
            [(LeadsTo::Body(0), 5.5), (LeadsTo::Body(2), 14.5)],
        ]
    );
    assert!(ends(&[], &[]).is_empty());
}

//! Wraps on the right whale's mesh: a rope laid once round a part, at any place and tilt, is one wrap.
#![allow(clippy::panic, reason = "a test fails by panicking, in its helpers too")]

use std::sync::Arc;

use endline_fixtures::hooks::NoEffect;
use endline_gear::whale::{WhaleForm, build_skin};
use endline_sdk::{BodyPart, Region};
use endline_sim::metrics::Metrics;
use endline_sim::model::{
    Friction, Joint, JointKind, Line, PilotProgram, Rope, Settings, Strength, Whale,
};
use endline_sim::water::{Current, Water};
use endline_sim::whale::{JointRanges, Measures, Skin};
use endline_sim::{ContactPoint, DQuat, DVec3, Model, ModelSpec, State};

/// A line of these segments and the whale.
fn model(skin: &Skin, segments_m: Vec<f64>) -> Model {
    let joint =
        |id: &str, z| Joint { id: id.into(), kind: JointKind::Free, position_m: DVec3::Z * z };
    let whale = Whale {
        skin: Arc::new(skin.clone()),
        joints: JointRanges::unbounded(),
        length_m: 13.0,
        measures: Measures::default(),
        burst_speed_m_s: 4.0,
        position_m: DVec3::Z * -20.0,
        orientation: DQuat::IDENTITY,
        speed_m_s: 0.0,
        motion: NoEffect::shared(),
        motion_attributes: Vec::new(),
        pilot: PilotProgram::default(),
        contact_stiffness_n_m2: 2e6,
        jaws: None,
        kinetic: None,
    };
    let rope = Rope {
        id: "rope".into(),
        diameter_m: 0.01,
        mass_kg_m: 0.06,
        displaced_m3_m: 5e-5,
        axial_stiffness_n: 1e5,
        axial_stiffening_n: 0.0,
        axial_damping_n_s: 5.0,
        axial_damping_ratio: 0.0,
        bending_stiffness_n_m2: 0.0,
        drag_normal: 1.2,
        drag_tangential: 0.02,
        drag_tangential_viscous: 0.0,
        drag_tangential_speed_m_s: 2.0,
        added_mass_normal: 1.0,
        added_mass_tangential: 0.0,
        strength_n: f64::INFINITY,
    };
    let current = Current::uniform(DVec3::ZERO);
    let spec = ModelSpec {
        water: Water {
            density_kg_m3: 1025.0,
            gravity_m_s2: 9.81,
            depth_m: 40.0,
            rope_dries: true,
            current,
            waves: None,
        },
        seabed: None,
        ropes: vec![rope],
        joints: vec![joint("low", -30.0), joint("high", -10.0)],
        lines: vec![Line {
            id: "rope".into(),
            rope: 0,
            from: 0,
            to: 1,
            segments_m,
            strength: Strength::default(),
            weak_places: Vec::new(),
            knots_m: [0.0; 2],
            start_m: Vec::new(),
        }],
        bodies: Vec::new(),
        links: Vec::new(),
        gear: Vec::new(),
        whale: Some(whale),
        friction: Some(Friction::of_one(
            NoEffect::shared(),
            Vec::new(),
            vec![[0.2; Region::ALL.len()]],
        )),
        obstacles: Vec::new(),
        probes: Vec::new(),
        settings: Settings::default(),
    };
    Model::new(spec).unwrap_or_else(|errors| panic!("{errors:?}"))
}

/// A plane's cut through a triangle: triangle, barycentric middle of the cut, its ends.
type Cut = (usize, [f64; 3], [DVec3; 2]);

/// Where a plane cuts the triangles of a part.
fn section(skin: &Skin, part: BodyPart, point: DVec3, normal: DVec3) -> Vec<Cut> {
    let of_part = (0..skin.triangles.len()).filter(|index| skin.regions[*index].part() == part);
    of_part.filter_map(|index| cut(skin, index, point, normal)).collect()
}

fn cut(skin: &Skin, triangle: usize, point: DVec3, normal: DVec3) -> Option<Cut> {
    let corners = skin.triangles[triangle].map(|vertex| skin.vertices[vertex as usize]);
    let heights = corners.map(|corner| (corner - point).dot(normal));
    let on_edge = |(i, j): (usize, usize)| {
        let share = heights[i] / (heights[i] - heights[j]);
        let mut weights = [0.0; 3];
        (weights[i], weights[j]) = (1.0 - share, share);
        weights
    };
    let crossed = [(0, 1), (1, 2), (2, 0)]
        .into_iter()
        .filter(|(i, j)| (heights[*i] > 0.0) != (heights[*j] > 0.0));
    let ends: Vec<[f64; 3]> = crossed.map(on_edge).collect();
    let [one, other] = ends[..] else { return None };
    let place = |weights: [f64; 3]| {
        corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]
    };
    Some((triangle, [0, 1, 2].map(|k| 0.5 * (one[k] + other[k])), [place(one), place(other)]))
}

/// The cuts in the order of the loop they form; `None` where it does not close within the part.
fn closed_loop(mut cuts: Vec<Cut>) -> Option<Vec<Cut>> {
    let mut ordered = vec![cuts.pop()?];
    let [start, mut at] = ordered[0].2;
    let meets = |a: DVec3, b: DVec3| a.distance(b) < 1e-9;
    while let Some(next) = cuts.iter().position(|cut| meets(cut.2[0], at) || meets(cut.2[1], at)) {
        let cut = cuts.swap_remove(next);
        at = if meets(cut.2[0], at) { cut.2[1] } else { cut.2[0] };
        ordered.push(cut);
    }
    meets(at, start).then_some(ordered)
}

/// Wraps on a part of a rope that follows a loop of cuts once and ends at its start.
fn wraps(skin: &Skin, part: BodyPart, mut cuts: Vec<Cut>) -> f64 {
    cuts.extend(cuts.first().copied());
    let lengths: Vec<f64> = cuts.iter().map(|cut| cut.2[0].distance(cut.2[1]).max(1e-4)).collect();
    let model = model(skin, lengths);
    let contact = |segment: usize| ContactPoint {
        is_knot: false,
        line: 0,
        segment,
        fraction: 0.5,
        triangle: cuts[segment].0,
        barycentric: cuts[segment].1,
        region: skin.regions[cuts[segment].0],
        position: DVec3::ZERO,
        normal: DVec3::Z,
        distance_m: 0.005,
        length_m: 1e-6,
        normal_force_n: 10.0,
        friction_n: DVec3::ZERO,
        slip_m: DVec3::ZERO,
        dt_s: 0.002,
    };
    let contacts: Vec<_> = (0..cuts.len()).map(contact).collect();
    let (mut metrics, state) = (Metrics::new(&model), State::start(&model));
    metrics.fold(&model, &state, &contacts);
    metrics
        .summary(&model, &state)
        .whale
        .map_or(0.0, |whale| whale.regions[part as usize].touching_wraps)
}

/// Least and greatest place of a part's vertices along a direction.
fn reach(skin: &Skin, part: BodyPart, along: DVec3) -> [f64; 2] {
    let of_part =
        skin.triangles.iter().zip(&skin.regions).filter(|(_, region)| region.part() == part);
    let places = of_part
        .flat_map(|(triangle, _)| triangle.map(|vertex| skin.vertices[vertex as usize].dot(along)));
    places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], place| {
        [low.min(place), high.max(place)]
    })
}

/// Fins are cut across the whale, the trunk across its length. The head is excluded: a plane through it
/// cuts its mouth too, so that its cut is not a single loop.
#[test]
fn a_loop_round_any_part_of_the_right_whale_is_one_wrap() {
    let skin = build_skin(&WhaleForm::right_whale(13.0));
    for part in BodyPart::ALL.into_iter().filter(|part| *part != BodyPart::Head) {
        let along =
            if matches!(part, BodyPart::Body | BodyPart::Peduncle) { DVec3::X } else { DVec3::Y };
        let [low, high] = reach(&skin, part, along);
        let (mut closed, mut worst) = (0, 0.0_f64);
        for station in 0..9 {
            let place = along * (low + (high - low) * (0.1003 + 0.1 * f64::from(station)));
            let straight = section(&skin, part, place, along);
            let middle = straight.iter().map(|cut| cut.2[0]).sum::<DVec3>() / straight.len() as f64;
            for tilt in [DVec3::ZERO, DVec3::Z * 0.3, DVec3::X * 0.1 - DVec3::Z * 0.2] {
                if let Some(cuts) =
                    closed_loop(section(&skin, part, middle, (along + tilt).normalize()))
                {
                    closed += 1;
                    worst = worst.max((wraps(&skin, part, cuts) - 1.0).abs());
                }
            }
        }
        println!("{}: {closed} loops, off one turn by at most {worst:.4}", part.name());
        assert!(closed >= 20 && worst < 1e-4, "{}: {closed} loops, off by {worst}", part.name());
    }
}

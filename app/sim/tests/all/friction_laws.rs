//! Laws of friction at work in the rope solve: a rope drawn over a drum of skin obeys the capstan law of whichever law holds where it
//! lies, baleen knows its plates, and a law that adds energy ends the run with its name.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test says what it needs"
)]

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use endline_fixtures::gear::{self, line, on_body, water, weight};
use endline_fixtures::hooks::descriptor;
use endline_fixtures::skin::drum_along;
use endline_fixtures::whale;
use endline_friction_models::{Baleen, Coulomb, Stribeck};
use endline_sdk::{
    AttributeKind, Contacts, Descriptor, FrictionModel, FrictionResponse, HookError, Region,
};
use endline_sim::model::{
    Friction, FrictionLaw, Joint, JointKind, Model, ModelSpec, Settings, Whale,
};
use endline_sim::whale::Skin;
use endline_sim::{DQuat, DVec3, Input, State, Stop, Workspace, step};

const RADIUS: f64 = 0.3;
const REACH: f64 = 0.005;
const FACETS: u32 = 96;

/// Returns the drum of these tests; see [`drum_along`].
fn drum(axes: [DVec3; 3], region: impl Fn(f64) -> Region) -> Skin {
    drum_along(axes, [RADIUS, 0.5], FACETS, region)
}

/// Returns a turned whale that keeps its place.
fn still(skin: Skin, orientation: DQuat) -> Whale {
    Whale { orientation, ..whale::still(skin) }
}

/// Half a turn over a drum in the plane of x and z; a weight hangs on the side of -x, the other side is drawn down from 0.3 s on.
fn drawn_over(whale: Whale, friction: Friction, speed: f64) -> Model {
    let (over, tail) = (RADIUS + REACH, 0.8);
    let whole = 2.0 * tail + PI * over;
    let path = |s: f64| {
        if s < tail {
            DVec3::new(-over, 0.0, s - tail)
        } else if s > whole - tail {
            DVec3::new(over, 0.0, whole - tail - s)
        } else {
            let angle = PI - (s - tail) / over;
            DVec3::new(over * libm::cos(angle), 0.0, over * libm::sin(angle))
        }
    };
    let mut rope = gear::rope();
    rope.axial_damping_n_s = 200.0;
    let mut line = line("rope", whole, 72);
    line.start_m = (0..=72).map(|k| path(whole * f64::from(k) / 72.0)).collect();
    let driven =
        JointKind::Driven { velocity_m_s: DVec3::Z * -speed, from_s: 0.3, until_s: f64::INFINITY };
    Model::new(ModelSpec {
        ropes: vec![rope],
        joints: vec![
            on_body("hanging", 0),
            Joint { id: "hand".into(), kind: driven, position_m: path(whole) },
        ],
        lines: vec![line],
        bodies: vec![weight("hanging", 20.0, path(0.0), None)],
        whale: Some(whale),
        friction: Some(friction),
        settings: Settings { step_s: 0.002, ..Settings::default() },
        ..gear::spec(water(0.0, 0.0))
    })
    .expect("a sound model")
}

fn law(model: impl FrictionModel + 'static, changed: &[(&str, f64)]) -> FrictionLaw {
    let value = |attribute: &endline_sdk::Attribute| match attribute.kind {
        AttributeKind::Number { default, .. } => changed
            .iter()
            .find(|(key, _)| attribute.key == *key)
            .map_or(default, |(_, value)| *value),
        _ => panic!("a number"),
    };
    FrictionLaw {
        attributes: model.descriptor().attributes.iter().map(value).collect(),
        model: Arc::new(model),
    }
}

/// Angle times effective friction, `ln(T2/T1)`, once the rope slides steadily.
fn log_ratio(model: &Model) -> f64 {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    let (mut slack, mut taut) = (0.0, 0.0);
    while state.time_s < 1.8 - 1e-9 {
        step(model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        if state.time_s > 1.0 {
            slack += state.rope.tension[0];
            taut += state.rope.tension[model.segment_count - 1];
        }
    }
    assert_eq!(workspace.audit.tunnelled, 0);
    libm::log(taut / slack)
}

/// A drum along the whale, turned to lie athwart, has its grain round it: rope that slides round it goes along the plates. A drum athwart has
/// its grain along itself: rope goes across the plates.
#[test]
fn rope_over_baleen_obeys_the_capstan_law_of_its_direction() {
    let (mu, ratio) = (0.2, 1.6);
    let friction = || Friction {
        laws: vec![law(Baleen::new(), &[("across_ratio", ratio), ("wedge_pressure", 1e6)])],
        law_of: vec![[0; Region::ALL.len()]],
        coefficients: vec![[mu; Region::ALL.len()]],
        law_of_bodies: [0; Region::ALL.len()],
        coefficients_of_bodies: [mu; Region::ALL.len()],
    };
    let baleen = |_| Region::Baleen;
    let lengthwise =
        still(drum([DVec3::X, DVec3::Y, DVec3::Z], baleen), DQuat::from_rotation_z(FRAC_PI_2));
    let athwart = still(drum([DVec3::Y, DVec3::Z, DVec3::X], baleen), DQuat::IDENTITY);
    let along = log_ratio(&drawn_over(lengthwise, friction(), 0.2)) / PI;
    let across = log_ratio(&drawn_over(athwart, friction(), 0.2)) / PI;
    println!("effective friction {along:.4} along the plates, {across:.4} across");
    assert!((along / mu - 1.0).abs() < 0.02, "along {along}");
    assert!((across / (ratio * mu) - 1.0).abs() < 0.02, "across {across}");
}

/// On one quarter of the drum one law holds, on the other another: their angles add up. Steady slip of Stribeck friction has its curve.
#[test]
fn each_region_has_its_own_law() {
    let (mu, speed) = (0.2, 0.1);
    let halves = |angle: f64| if libm::cos(angle) > 0.0 { Region::Body } else { Region::Peduncle };
    let skin = drum([DVec3::Y, DVec3::Z, DVec3::X], move |angle| halves(angle - FRAC_PI_2));
    let mut law_of = [0; Region::ALL.len()];
    law_of[Region::Peduncle as usize] = 1;
    let wet = law(
        Stribeck::new(),
        &[("static_ratio", 1.5), ("stribeck_speed", 0.1), ("viscous_speed", 1.0)],
    );
    let friction = Friction {
        laws: vec![law(Coulomb::new(), &[]), wet],
        law_of: vec![law_of],
        coefficients: vec![[mu; Region::ALL.len()]],
        law_of_bodies: [0; Region::ALL.len()],
        coefficients_of_bodies: [mu; Region::ALL.len()],
    };
    let model = drawn_over(still(skin, DQuat::IDENTITY), friction, speed);
    let expected = mu * FRAC_PI_2 * (1.0 + (1.0 + 0.5 * libm::exp(-1.0) + 0.1));
    let got = log_ratio(&model);
    println!("ln(T2/T1) {got:.4}, {expected:.4} by the laws");
    assert!((got / expected - 1.0).abs() < 0.025, "{got} for {expected}");
    replays_to_the_bit(&model);
}

/// Rope bears on the edges of a drum of few facets, whose regions alternate. The two triangles of an edge are equally near.
#[test]
fn an_edge_between_two_regions_belongs_to_one_of_them() {
    let facets = 12;
    let alternate = move |angle: f64| {
        let facet = libm::floor(angle / (2.0 * PI / f64::from(facets))) as i64;
        if facet % 2 == 0 { Region::Body } else { Region::Baleen }
    };
    let skin = drum_along([DVec3::Y, DVec3::Z, DVec3::X], [RADIUS, 0.5], facets, alternate);
    let triangles = skin.triangles.clone();
    let mut law_of = [0; Region::ALL.len()];
    law_of[Region::Baleen as usize] = 1;
    let friction = Friction {
        laws: vec![law(Coulomb::new(), &[]), law(Baleen::new(), &[("wedge_pressure", 1e6)])],
        law_of: vec![law_of],
        coefficients: vec![[0.2; Region::ALL.len()]],
        law_of_bodies: [0; Region::ALL.len()],
        coefficients_of_bodies: [0.2; Region::ALL.len()],
    };
    let model = drawn_over(still(skin, DQuat::IDENTITY), friction, 0.1);
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    let mut region_of: BTreeMap<[u32; 2], (Region, u32)> = BTreeMap::new();
    while state.time_s < 1.0 {
        step(&model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        for contact in &workspace.contacts {
            let Some(opposite) = contact.barycentric.iter().position(|share| *share == 0.0) else {
                continue;
            };
            let corners = triangles[contact.triangle];
            let mut edge = [corners[(opposite + 1) % 3], corners[(opposite + 2) % 3]];
            edge.sort_unstable();
            let (region, count) = region_of.entry(edge).or_insert((contact.region, 0));
            assert_eq!(*region, contact.region, "edge {edge:?} at {} s", state.time_s);
            *count += 1;
        }
    }
    let often = region_of.values().filter(|(_, count)| *count > 100).count();
    assert!(often > 3, "rope bears on {often} edges");
}

/// At an edge between skin of much and of little friction, rope slips on one side and sticks on the other. Within a solver step a contact
/// keeps the region that it had first, else iterations alternate between both.
#[test]
fn rope_converges_at_an_edge_between_much_and_little_friction() {
    let facets = 12;
    let alternate = move |angle: f64| {
        let facet = libm::floor(angle / (2.0 * PI / f64::from(facets)) + 0.5) as i64;
        if facet % 2 == 0 { Region::Body } else { Region::Peduncle }
    };
    let skin = drum_along([DVec3::Y, DVec3::Z, DVec3::X], [RADIUS, 0.5], facets, alternate);
    let mut coefficients = [0.02; Region::ALL.len()];
    coefficients[Region::Peduncle as usize] = 0.6;
    let friction = Friction {
        laws: vec![law(Coulomb::new(), &[])],
        law_of: vec![[0; Region::ALL.len()]],
        coefficients: vec![coefficients],
        law_of_bodies: [0; Region::ALL.len()],
        coefficients_of_bodies: coefficients,
    };
    let model = drawn_over(still(skin, DQuat::IDENTITY), friction, 0.1);
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    while state.time_s < 2.0 {
        step(&model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    let audit = workspace.audit;
    println!("{audit:?}");
    assert_eq!([audit.unconverged, audit.halved], [0, 0], "{audit:?}");
}

/// The floats of both laws are in the state: dropped scratch memory changes no bit.
fn replays_to_the_bit(model: &Model) {
    let run = |drop_every: usize| {
        let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
        for count in 1..=400 {
            step(model, &Input::default(), &mut state, &mut workspace)
                .unwrap_or_else(|stop| panic!("{stop:?}"));
            if count % drop_every == 0 {
                workspace = Workspace::new(model);
            }
        }
        state
    };
    let (one, other) = (run(usize::MAX), run(7));
    assert!(!one.rope.friction.sites.is_empty() && one.rope.friction.sites.is_sorted());
    let bits =
        |state: &State| state.rope.friction.floats.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(
        (bits(&one), one.rope.position.clone()),
        (bits(&other), other.rope.position.clone())
    );
}

/// Friction with a memory that pushes the rope the way it slipped last: each answer alone could come out of a bristle.
struct Motor(Descriptor);

impl FrictionModel for Motor {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn respond(
        &self,
        _: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        for (index, answer) in out.iter_mut().enumerate() {
            let force = 0.5 * contacts.coefficient[index] * contacts.normal_force_n[index];
            answer.force_n = std::array::from_fn(|i| force * contacts.state[3 * index + i]);
            answer.by_slip = [[0.0; 3]; 3];
            answer.by_normal_force = [0.0; 3];
        }
        Ok(())
    }

    fn advance(
        &self,
        _: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [f64],
    ) -> Result<(), HookError> {
        for (floats, slip) in out.chunks_exact_mut(3).zip(contacts.slip_m) {
            let way = slip.iter().map(|c| c * c).sum::<f64>().sqrt().max(1e-12);
            floats.copy_from_slice(&slip.map(|c| c / way));
        }
        Ok(())
    }
}

#[test]
fn a_law_that_adds_energy_ends_the_run_with_its_name() {
    let friction = Friction::of_one(
        Arc::new(Motor(Descriptor { state_len: 3, ..descriptor("org.example.friction.motor") })),
        Vec::new(),
        vec![[0.3; Region::ALL.len()]],
    );
    let model = drawn_over(
        still(drum([DVec3::Y, DVec3::Z, DVec3::X], |_| Region::Body), DQuat::IDENTITY),
        friction,
        0.2,
    );
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    let stop: Stop = (0..1000)
        .find_map(|_| step(&model, &Input::default(), &mut state, &mut workspace).err())
        .expect("the run ends");
    assert_eq!(stop.part, "org.example.friction.motor");
    assert!(stop.reason.contains("its friction adds energy"), "{}", stop.reason);
}

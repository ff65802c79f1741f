//! A plugin linked into a program and the same plugin loaded from its library give the same bits.

use std::fs;
use std::sync::Arc;

use endline_gear::{Library, Sources};
use endline_gear_types::Single;
use endline_sdk::{
    Attribute, AttributeKind, AttributeValue, BodyPart, Contacts, Controls, FrictionModel,
    FrictionResponse, GearStep, GearType, MotionInput, MotionOutput, Site, WhaleMotion,
};
use endline_session::plugins::{PluginHost, PluginKind};
use endline_sim::whale::acts::{Acting, Answers};
use endline_tests::root;
use endline_whale_motions::Swim;

use crate::built::{first_party, first_party_file};
use crate::random::Random;

const SWIM: &str = "org.endline.motion.swim";
const SINGLE: &str = "org.endline.gear.single";

pub fn loaded() -> PluginHost {
    let (host, problems) = PluginHost::discover(&[first_party().to_path_buf()]);
    assert!(problems.is_empty(), "{problems:?}");
    host
}

/// A value within an attribute's range.
fn value(attribute: &Attribute, random: &mut Random) -> AttributeValue {
    match &attribute.kind {
        AttributeKind::Number { min, max, .. } => {
            AttributeValue::Number(random.between(*min, *max))
        }
        AttributeKind::Count { min, max, .. } => {
            AttributeValue::Number(random.between(f64::from(*min), f64::from(*max) + 1.0).floor())
        }
        AttributeKind::Choice { words, .. } => {
            AttributeValue::Choice(words[random.next() as usize % words.len()].to_string())
        }
        AttributeKind::Item { default, .. } if random.between(0.0, 1.0) < 0.5 => {
            AttributeValue::Item(default.to_string())
        }
        AttributeKind::Item { library, .. } => {
            AttributeValue::Item(format!("{library}-{}", random.next() % 100))
        }
    }
}

fn numbers(attributes: &[Attribute], random: &mut Random) -> Vec<f64> {
    attributes.iter().map(|attribute| value(attribute, random).number().unwrap()).collect()
}

fn bits(values: impl IntoIterator<Item = f64>) -> Vec<u64> {
    values.into_iter().map(f64::to_bits).collect()
}

#[test]
fn the_library_declares_what_the_linked_plugin_declares() {
    let host = loaded();
    let (gear, friction) = (endline_gear_types::all(), endline_friction_models::all());
    let frictions = friction.iter().map(|model| model.descriptor().id.to_string());
    let gears = gear.iter().map(|gear| gear.descriptor().id.to_string());
    let mut ids: Vec<_> = gears.chain(frictions).chain([SWIM.to_owned()]).collect();
    ids.sort();
    assert_eq!(host.ids(), ids);
    assert_eq!(host.motion(SWIM).unwrap().descriptor(), Swim::new().descriptor());
    for linked in &friction {
        assert_eq!(
            host.friction(&linked.descriptor().id).unwrap().descriptor(),
            linked.descriptor()
        );
    }
    for linked in &gear {
        assert_eq!(host.gear(&linked.descriptor().id).unwrap().descriptor(), linked.descriptor());
    }
    assert!(
        host.motion("org.endline.friction.coulomb").is_none()
            && host.friction(SWIM).is_none()
            && host.gear("org.example.none").is_none()
    );
    let swim = host.list().iter().find(|info| info.id == SWIM).unwrap();
    let file = first_party_file("endline_whale_motions");
    assert_eq!(swim.kind, PluginKind::Motion);
    assert_eq!(swim.file.as_deref(), Some(file.canonicalize().unwrap().as_path()));
    assert_eq!(swim.hash, Some(blake3::hash(&fs::read(file).unwrap()).to_hex().to_string()));
}

fn output_bits(out: &MotionOutput) -> Vec<u64> {
    let p = &out.posture;
    let angles = p
        .spine_pitch
        .into_iter()
        .chain(p.spine_yaw)
        .chain(p.fluke_flex)
        .chain(p.flipper_sweep)
        .chain(p.flipper_raise);
    let rest = p
        .flipper_twist
        .into_iter()
        .chain(p.spine_roll)
        .chain(p.flipper_flex)
        .chain(p.lips)
        .chain([p.fluke_pitch, p.jaw, out.speed_m_s])
        .chain(out.turn_rate_rad_s);
    bits(angles.chain(rest))
}

#[test]
fn swim_gives_the_same_bits_linked_and_loaded() {
    let (linked, loaded) = (Swim::new(), loaded().motion(SWIM).unwrap());
    let mut random = Random(1);
    for _ in 0..40 {
        let attributes = numbers(&linked.descriptor().attributes, &mut random);
        let mut states =
            [vec![0.0; linked.descriptor().state_len], vec![0.0; linked.descriptor().state_len]];
        let mut speed_m_s = random.between(0.0, 5.0);
        for step in 0..100 {
            let forces =
                std::array::from_fn::<_, { BodyPart::ALL.len() }, _>(|_| random.between(0.0, 1e4));
            let port =
                std::array::from_fn::<_, { BodyPart::ALL.len() }, _>(|_| random.between(-1.5, 1.5));
            let input = MotionInput {
                time_s: f64::from(step) * 0.1,
                dt_s: random.between(1e-4, 0.05),
                length_m: 13.7,
                speed_m_s,
                position_m: random.vector(10.0),
                orientation: [0.0, 0.0, 0.0, 1.0],
                controls: controls(&mut random),
                contact_force_n: &forces,
                contact_port_m: &port,
                thrust_speed_m_s: None,
            };
            let [one, other] = &mut states;
            let out = linked.step(&attributes, &input, one).unwrap();
            assert_eq!(
                output_bits(&out),
                output_bits(&loaded.step(&attributes, &input, other).unwrap())
            );
            assert_eq!(bits(one.iter().copied()), bits(other.iter().copied()));
            speed_m_s = out.speed_m_s;
        }
    }
}

/// Acts of the shipped library over the swim, with touches that it answers: the player is the program's own and gives
/// the same bits over a loaded motion as over a linked one.
#[test]
fn acts_give_the_same_bits_over_a_linked_and_a_loaded_swim() {
    let (library, problems) =
        Library::read(&Sources::from_folder(&root().join("gear-library")).unwrap());
    assert!(problems.is_empty());
    let clips: Vec<_> = library.acts.iter().flat_map(|act| act.clips.iter().cloned()).collect();
    let answers = Some(Answers { first: Some(1), above_n: 5.0, again_s: 3.0, drawn: None });
    let swims: [Arc<dyn WhaleMotion>; 2] = [Arc::new(Swim::new()), loaded().motion(SWIM).unwrap()];
    let [one, other] = swims.map(|swim| Acting::new(swim, clips.clone(), answers.clone()));
    let attributes: Vec<f64> = one
        .descriptor()
        .attributes
        .iter()
        .map(|attribute| attribute.default_value().number().unwrap())
        .collect();
    let mut states =
        [vec![0.0; one.descriptor().state_len], vec![0.0; other.descriptor().state_len]];
    let (mut random, mut asked, mut forces) =
        (Random(5), Controls::default(), [0.0; BodyPart::ALL.len()]);
    let mut port = forces;
    for step in 0..6000 {
        if step % 70 == 0 {
            asked = controls(&mut random);
            asked.act = random.between(0.0, 1.0 + clips.len() as f64).floor();
            forces = std::array::from_fn(|_| random.between(-40.0, 20.0).max(0.0));
            port = std::array::from_fn(|_| random.between(-1.5, 1.5));
        }
        let input = MotionInput {
            time_s: f64::from(step) * 0.02,
            dt_s: 0.02,
            length_m: 13.7,
            speed_m_s: 1.2,
            position_m: [0.0; 3],
            orientation: [0.0, 0.0, 0.0, 1.0],
            controls: asked,
            contact_force_n: &forces,
            contact_port_m: &port,
            thrust_speed_m_s: None,
        };
        let [first, second] = &mut states;
        let out = one.step(&attributes, &input, first).unwrap();
        assert_eq!(
            output_bits(&out),
            output_bits(&other.step(&attributes, &input, second).unwrap())
        );
        assert_eq!(bits(first.iter().copied()), bits(second.iter().copied()));
    }
}

fn controls(random: &mut Random) -> Controls {
    let mut axis = || random.between(-1.0, 1.0);
    Controls {
        speed: axis().max(0.0),
        pitch: axis(),
        roll: axis(),
        yaw: axis(),
        burst: f64::from(u8::from(axis() > 0.7)),
        mouth: axis().max(0.0),
        flipper_raise: axis(),
        flipper_twist: axis(),
        flipper_sweep: axis(),
        act: (3.0 * axis()).max(0.0).floor(),
    }
}

/// Arrays of contacts drawn at random.
struct Draw {
    normal_force_n: Vec<f64>,
    normal: Vec<[f64; 3]>,
    grain: Vec<[f64; 3]>,
    along: Vec<[f64; 3]>,
    slip_m: Vec<[f64; 3]>,
    length_m: Vec<f64>,
    coefficient: Vec<f64>,
    region: Vec<u32>,
    rope: Vec<u32>,
    state: Vec<f64>,
}

impl Draw {
    fn new(random: &mut Random, state_len: usize) -> Self {
        let count = 0..random.next() % 40;
        let mut each = |draw: &mut dyn FnMut(&mut Random) -> f64| {
            count.clone().map(|_| draw(random)).collect::<Vec<_>>()
        };
        let normal_force_n = each(&mut |r| r.between(-50.0, 500.0).max(0.0));
        let length_m = each(&mut |r| r.between(1e-3, 0.03));
        let coefficient = each(&mut |r| r.between(0.0, 1.0));
        let region: Vec<u32> = count.clone().map(|_| (random.next() % 20) as u32).collect();
        let rope = region.iter().map(|region| region % 3).collect();
        let normal: Vec<_> = count.clone().map(|_| random.direction()).collect();
        let grain: Vec<_> = normal.iter().map(|normal| random.tangent(*normal)).collect();
        let along = normal.iter().map(|normal| random.tangent(*normal)).collect();
        let slip_m = count.clone().map(|_| random.vector(1e-4)).collect();
        let state = count
            .flat_map(|_| (0..state_len).map(|_| random.between(-2e-5, 2e-5)).collect::<Vec<_>>())
            .collect();
        Self {
            normal_force_n,
            normal,
            grain,
            along,
            slip_m,
            length_m,
            coefficient,
            region,
            rope,
            state,
        }
    }

    fn contacts(&self) -> Contacts<'_> {
        Contacts {
            dt_s: 0.002,
            normal_force_n: &self.normal_force_n,
            normal: &self.normal,
            grain: &self.grain,
            along: &self.along,
            slip_m: &self.slip_m,
            length_m: &self.length_m,
            coefficient: &self.coefficient,
            region: &self.region,
            rope: &self.rope,
            state: &self.state,
        }
    }
}

fn response_bits(answers: &[FrictionResponse]) -> Vec<u64> {
    let flat = |a: &FrictionResponse| {
        a.force_n.into_iter().chain(a.by_slip.into_iter().flatten()).chain(a.by_normal_force)
    };
    bits(answers.iter().flat_map(flat))
}

#[test]
fn every_friction_model_gives_the_same_bits_linked_and_loaded() {
    for linked in endline_friction_models::all() {
        let descriptor = linked.descriptor();
        let (loaded, mut random) = (loaded().friction(&descriptor.id).unwrap(), Random(2));
        for _ in 0..300 {
            let attributes = numbers(&descriptor.attributes, &mut random);
            let draw = Draw::new(&mut random, descriptor.state_len);
            let contacts = draw.contacts();
            let respond = |model: &dyn FrictionModel| {
                let mut out = vec![FrictionResponse::default(); contacts.len()];
                model.respond(&attributes, &contacts, &mut out).map(|()| response_bits(&out))
            };
            let advance = |model: &dyn FrictionModel| {
                let mut out = vec![0.0; draw.state.len()];
                model.advance(&attributes, &contacts, &mut out).map(|()| bits(out))
            };
            assert_eq!(
                respond(linked.as_ref()).unwrap(),
                respond(loaded.as_ref()).unwrap(),
                "{}",
                descriptor.id
            );
            assert_eq!(
                advance(linked.as_ref()).unwrap(),
                advance(loaded.as_ref()).unwrap(),
                "{}",
                descriptor.id
            );
        }
    }
}

/// Values of a gear type drawn at random, half of the numbers at their defaults so that much of it can be built.
fn drawn(gear: &dyn GearType, random: &mut Random) -> Vec<AttributeValue> {
    let draw = |attribute: &Attribute| match &attribute.kind {
        AttributeKind::Number { .. } if random.between(0.0, 1.0) < 0.7 => attribute.default_value(),
        _ => value(attribute, random),
    };
    gear.descriptor().attributes.iter().map(draw).collect()
}

#[test]
fn every_gear_type_gives_the_same_rig_linked_and_loaded() {
    let host = loaded();
    for linked in endline_gear_types::all() {
        let id = linked.descriptor().id.to_string();
        let (loaded, mut random) = (host.gear(&id).unwrap(), Random(3));
        let (mut built, mut refused) = (0, 0);
        for _ in 0..400 {
            let values = drawn(linked.as_ref(), &mut random);
            let [x, y, depth] = random.vector(60.0);
            let site = Site { depth_m: depth.max(-1.0), current_m_s: [x / 60.0, y / 60.0] };
            match (linked.build(&values, &site), loaded.build(&values, &site)) {
                (Ok(one), Ok(other)) => {
                    built += 1;
                    assert_eq!(one, other);
                }
                (Err(one), Err(other)) => {
                    refused += 1;
                    assert_eq!(other.message, format!("plugin `{id}`: {}", one.message));
                }
                (one, other) => panic!("{one:?} but {other:?}"),
            }
        }
        assert!(built > 20 && refused > 20, "{id}: {built} built, {refused} refused");
    }
}

/// Tensions come and go and time runs: the gear types that act ask for the same cuts and releases, with the same floats.
#[test]
fn every_gear_type_acts_the_same_linked_and_loaded() {
    let (host, mut acted) = (loaded(), 0);
    for linked in endline_gear_types::all() {
        let (descriptor, mut random) = (linked.descriptor(), Random(4));
        let loaded = host.gear(&descriptor.id).unwrap();
        let values: Vec<_> = descriptor.attributes.iter().map(Attribute::default_value).collect();
        let lines = linked
            .build(&values, &Site { depth_m: 30.0, current_m_s: [0.2, 0.0] })
            .unwrap()
            .lines
            .len();
        let mut states = [vec![0.0; descriptor.state_len], vec![0.0; descriptor.state_len]];
        for step in 0..400 {
            let least = if step % 100 < 20 { 0.0 } else { 3000.0 };
            let tensions: Vec<_> = (0..lines)
                .map(|_| [random.between(least, 5000.0), random.between(least, 5000.0)])
                .collect();
            let input = GearStep { time_s: f64::from(step), dt_s: 1.0, end_tension_n: &tensions };
            let (mut asked, mut other) = (Vec::new(), Vec::new());
            linked.step(&values, &input, &mut states[0], &mut asked).unwrap();
            loaded.step(&values, &input, &mut states[1], &mut other).unwrap();
            assert_eq!(asked, other);
            assert_eq!(bits(states[0].iter().copied()), bits(states[1].iter().copied()));
            acted += asked.len();
        }
    }
    assert_eq!(acted, 9, "one cut, and a release with seven ties");
}

/// Several runs may call one loaded plugin at once.
#[test]
fn a_loaded_plugin_serves_several_threads() {
    let gear: Arc<dyn GearType> = loaded().gear(SINGLE).unwrap();
    let values: Vec<_> =
        gear.descriptor().attributes.iter().map(Attribute::default_value).collect();
    let site = Site { depth_m: 30.0, current_m_s: [0.3, 0.1] };
    let alone = Single::new().build(&values, &site).unwrap();
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..200 {
                    assert_eq!(gear.build(&values, &site).unwrap(), alone);
                    let step =
                        GearStep { time_s: 0.0, dt_s: 0.01, end_tension_n: &[[1.0, 2.0]; 2] };
                    gear.step(&values, &step, &mut [], &mut Vec::new()).unwrap();
                }
            });
        }
    });
}

//! Outcomes and events of scripted encounters, rope beyond the whale, and loads against worked examples.

use std::f64::consts::{FRAC_PI_2, PI};

use endline_sdk::Region;
use glam::DVec3;

use super::{model, spec, *};
use crate::contact::ContactPoint;
use crate::metrics::mouth::inside_of_mouth;
use crate::metrics::pressure::ExcessForceMeter;
use crate::metrics::{EventKind, Outcome, RopePlace, WhaleSummary};
use crate::model::Model;
use crate::state::State;
use crate::whale::{Mark, Skin};

/// Intervals of (duration [s], contact), time at which the link parted, outcome, and whether it is decided.
type Case = (&'static [(f64, bool)], Option<f64>, Outcome, bool);

/// Plays intervals of (duration [s], contact); returns the outcome and whether it is decided.
fn play(spells: &[(f64, bool)], parted_s: Option<f64>) -> (Outcome, bool) {
    let mut spec = spec(vec![0.5; 4]);
    spec.links =
        vec![Link { id: "weak".into(), line: 0, end: LineEnd::B, rating_n: 90.0, enabled: true }];
    let model = model(spec);
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    let contacts = touch(&model);
    for (seconds, touching) in spells {
        for _ in 0..(seconds / STEP_S).round() as usize {
            state.link_parted_s[0] = parted_s.filter(|parted| *parted <= state.time_s);
            advance(&mut metrics, &model, &mut state, if *touching { &contacts } else { &[] });
        }
    }
    let whale = metrics.summary(&model, &state).whale.unwrap();
    (whale.outcome, whale.decided)
}

#[test]
fn outcomes_follow_their_definition() {
    let cases: [Case; 14] = [
        (&[(20.0, false)], None, Outcome::NoContact, true),
        // A link that parts without contact is no encounter.
        (&[(20.0, false)], Some(3.0), Outcome::NoContact, true),
        (&[(5.0, false), (30.0, true)], None, Outcome::Entangled, true),
        (&[(5.0, false), (3.0, true)], None, Outcome::Entangled, false),
        // Long contact, then free: 9 s are not sufficient, 11 s are.
        (&[(40.0, true), (9.0, false)], None, Outcome::Entangled, false),
        (&[(40.0, true), (11.0, false)], None, Outcome::Shed, true),
        // A short episode: free for a third of it.
        (&[(6.0, true), (2.5, false)], None, Outcome::Entangled, false),
        (&[(6.0, true), (3.5, false)], None, Outcome::Shed, false),
        // Short gaps do not end the contact.
        (
            &[(6.0, true), (0.9, false), (0.1, true), (0.9, false), (0.1, true), (0.9, false)],
            None,
            Outcome::Entangled,
            false,
        ),
        // Shed, then a short contact: a separate episode.
        (
            &[(20.0, true), (12.0, false), (0.1, true), (0.5, false)],
            None,
            Outcome::Entangled,
            false,
        ),
        (&[(20.0, true), (12.0, false), (0.1, true), (1.5, false)], None, Outcome::Shed, false),
        (&[(5.0, true), (15.0, true)], Some(3.0), Outcome::PartedEntangled, true),
        (&[(5.0, true), (15.0, false)], Some(3.0), Outcome::PartedFree, true),
        // Parted before the first contact: only contact determines the outcome.
        (&[(5.0, false), (5.0, true), (12.0, false)], Some(1.0), Outcome::Shed, true),
    ];
    for (spells, parted, outcome, decided) in cases {
        assert_eq!(play(spells, parted), (outcome, decided), "{spells:?} parted {parted:?}");
    }
}

/// Rope with half a turn or more is not shed before the full time has elapsed.
#[test]
fn a_hooked_rope_needs_the_full_time() {
    let model = model(spec(vec![0.05; 40]));
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    for (turns, outcome) in [(0.3, Outcome::Shed), (0.7, Outcome::Entangled)] {
        let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
        let contacts: Vec<_> = helix(skin, turns, 40)
            .iter()
            .enumerate()
            .map(|(k, place)| contact(&model, k, *place))
            .collect();
        (0..300).for_each(|_| advance(&mut metrics, &model, &mut state, &contacts));
        (0..500).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
        assert_eq!(
            metrics.summary(&model, &state).whale.unwrap().outcome,
            outcome,
            "{turns} turns"
        );
        (0..600).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
        assert_eq!(
            metrics.summary(&model, &state).whale.unwrap().outcome,
            Outcome::Shed,
            "{turns} turns"
        );
    }
}

#[test]
fn contact_events_bridge_flicker_and_times_add_up() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    let contacts = touch(&model);
    for step in 1..=1000 {
        let touching = (100..200).contains(&step) || (250..300).contains(&step) || step >= 900;
        advance(&mut metrics, &model, &mut state, if touching { &contacts } else { &[] });
    }
    let of_contact = metrics.events().iter().filter(|event| event.kind != EventKind::Shed);
    let reported: Vec<_> =
        of_contact.map(|event| (event.kind, event.subject.as_str(), event.time_s)).collect();
    assert_eq!(
        reported,
        [
            (EventKind::Contact, "body", 1.0),
            (EventKind::ContactLost, "body", 3.99),
            (EventKind::Contact, "body", 9.0)
        ]
    );
    let whale = metrics.summary(&model, &state).whale.unwrap();
    assert_eq!((whale.first_contact_s, whale.last_contact_s), (Some(1.0), Some(10.0)));
    assert!((whale.contact_time_s - 2.51).abs() < 1e-9, "{}", whale.contact_time_s);
}

/// Slip is reported once after a second of sticking, not at a low speed, and not if rope never stuck.
#[test]
fn slip_after_sticking_is_reported() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    let mut contacts = touch(&model);
    for step in 1..=1000 {
        let speed = match step {
            1..100 => 0.2,
            100..400 => 0.005,
            400..500 => 0.03,
            500..600 => 0.2,
            600..650 => 0.0,
            _ => 0.3,
        };
        contacts[0].slip_m = DVec3::Y * speed * STEP_S;
        advance(&mut metrics, &model, &mut state, &contacts);
    }
    let slips: Vec<_> = metrics
        .events()
        .iter()
        .filter(|event| event.kind == EventKind::Slip)
        .map(|event| (event.time_s, event.value))
        .collect();
    assert_eq!(slips.len(), 1, "{slips:?}");
    assert!((slips[0].0 - 5.0).abs() < 1e-9 && (slips[0].1 - 0.2).abs() < 1e-9, "{slips:?}");
}

/// The trunk's lowest point in the fixture's rest posture is 1.2 m below the origin amidships.
#[test]
fn seabed_and_surface_are_reported_with_hysteresis() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    for z in [-20.0, -48.0, -49.0, -48.5, -49.0, -40.0, -1.0, -2.5, -1.0] {
        state.whale.as_mut().unwrap().position.z = z;
        advance(&mut metrics, &model, &mut state, &[]);
    }
    let reported: Vec<_> = metrics.events().iter().map(|event| event.kind).collect();
    assert_eq!(reported, [EventKind::AtSeabed, EventKind::AtSurface, EventKind::AtSurface]);
    assert!((metrics.events()[0].value + 0.2).abs() < 0.02, "{:?}", metrics.events()[0]);
}

/// Folding is deterministic: equal steps give an equal summary and equal events.
#[test]
fn folding_twice_gives_the_same() {
    let model = model(spec(vec![0.05; 40]));
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    let run = || {
        let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
        for k in 0..50 {
            let contacts: Vec<_> = helix(skin, 0.03 * f64::from(k), 40)
                .iter()
                .enumerate()
                .map(|(i, place)| contact(&model, i, *place))
                .collect();
            advance(&mut metrics, &model, &mut state, &contacts);
        }
        (metrics.summary(&model, &state), metrics.events().to_vec())
    };
    assert_eq!(run(), run());
}

/// Trap - 10 m - splice - 8 m - buoy - 2 m - bare end, and a groundline of 20 m from the trap to an anchor.
pub(super) fn single() -> ModelSpec {
    let mut spec = spec(vec![0.5; 20]);
    let at = |body, z| (JointKind::Body { body, offset_m: DVec3::ZERO }, DVec3::new(0.0, 0.0, z));
    let [trap, buoy, anchor] = [at(0, -50.0), at(1, 0.0), at(2, -50.0)];
    spec.bodies = vec![
        body("trap", BodyRole::Trap, trap.1),
        body("buoy", BodyRole::Buoy, buoy.1),
        body("anchor", BodyRole::Anchor, anchor.1 + DVec3::X * 20.0),
    ];
    spec.joints = vec![
        joint("trap", trap.0, trap.1),
        joint("splice", JointKind::Free, DVec3::new(0.0, 0.0, -20.0)),
        joint("buoy", buoy.0, buoy.1),
        joint("tail", JointKind::Free, DVec3::X * 2.0),
        joint("anchor", anchor.0, anchor.1 + DVec3::X * 20.0),
    ];
    spec.lines = vec![
        line("lower", 0, 1, vec![0.5; 20]),
        line("upper", 1, 2, vec![0.5; 16]),
        line("tail", 2, 3, vec![0.5; 4]),
        line("groundline", 0, 4, vec![1.0; 20]),
    ];
    spec
}

/// Trailing and tethered rope with contacts at these segments, after these cuts.
fn beyond(contacts: &[(usize, usize)], cuts: &[usize]) -> [f64; 2] {
    let model = model(single());
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    cuts.iter().for_each(|segment| state.rope.cut[*segment] = true);
    let one = touch(&model).remove(0);
    let contacts: Vec<_> = contacts
        .iter()
        .map(|(line, segment)| ContactPoint { line: *line, segment: *segment, ..one.clone() })
        .collect();
    advance(&mut metrics, &model, &mut state, &contacts);
    let whale = metrics.summary(&model, &state).whale.unwrap();
    [whale.trailing_m, whale.tethered_m]
}

#[test]
fn rope_beyond_the_whale_is_trailing_or_tethered() {
    let close = |got: [f64; 2], wanted: [f64; 2]| {
        assert!(
            (got[0] - wanted[0]).abs() < 1e-9 && (got[1] - wanted[1]).abs() < 1e-9,
            "{got:?}, wanted {wanted:?}"
        );
    };
    close(beyond(&[], &[]), [0.0, 0.0]);
    // Contact 2.25 m above the trap: the trap holds the rope below; above are 7.75 + 8 + 2 m.
    close(beyond(&[(0, 4)], &[]), [17.75, 2.25]);
    // Two contacts: rope between them neither trails nor is tethered.
    close(beyond(&[(0, 4), (0, 10)], &[]), [14.75, 2.25]);
    close(beyond(&[(0, 4), (1, 21)], &[]), [7.25 + 2.0, 2.25]);
    // Cut at the trap's end: the lower part is loose too.
    close(beyond(&[(0, 4)], &[0]), [17.75 + 1.75, 0.0]);
    // Cut above: only the rope up to the cut is attached to the whale.
    close(beyond(&[(0, 4)], &[7]), [1.25, 2.25]);
    // Cut in the upper line.
    close(beyond(&[(0, 4)], &[24]), [7.75 + 2.0, 2.25]);
}

#[test]
fn a_held_whale_is_described_by_its_state_at_the_end() {
    let model = model(single());
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    let contacts: Vec<_> = touch(&model)
        .into_iter()
        .map(|contact| ContactPoint {
            line: 0,
            segment: 4,
            region: Region::LeftFlipperTip,
            ..contact
        })
        .collect();
    let mut after = |contacts: &[ContactPoint], time_s: f64| {
        for _ in 0..(time_s / STEP_S).round() as usize {
            advance(&mut metrics, &model, &mut state, contacts);
        }
        metrics.summary(&model, &state).whale.unwrap()
    };
    let places = [RopePlace::Head, RopePlace::Flipper, RopePlace::Tail];
    let by_place = |whale: &WhaleSummary| places.map(|place| whale.has_rope_on(place));
    let touched = |whale: &WhaleSummary| whale.regions.iter().any(|region| region.touching);
    let held = after(&contacts, 30.0);
    assert_eq!(by_place(&held), [false, true, false]);
    assert!(held.is_held() && held.is_trailing() && held.is_anchored() && !held.is_constricted());
    assert_eq!((held.carried_traps, held.carried_buoys), (1, 1));
    // Off the skin for half a second, rope still holds it at the same places and to the same gear.
    let flickers = after(&[], 0.5);
    assert_eq!(by_place(&flickers), by_place(&held));
    assert_eq!((flickers.trailing_m, flickers.carried_traps), (held.trailing_m, 1));
    let later = after(&[], 2.0);
    assert!(later.is_held() && !touched(&later) && later.is_trailing());
    assert_eq!(by_place(&later), [false; 3]);
    let free = after(&[], 10.0);
    assert!(!free.is_held() && !free.is_trailing() && !free.is_anchored());
    assert_eq!((free.trailing_m, free.carried_traps, free.carried_buoys), (0.0, 0, 0));
}

/// Rope of 3 N/m pressed on the back, dragged aft at 0.5 m/s with friction 0.4 for 2 s: work = mu N v t.
#[test]
fn friction_work_of_a_steady_slide() {
    for solver_steps in [1.0, 5.0] {
        let model = model(spec(vec![0.5; 4]));
        let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
        let mut contacts = touch(&model);
        contacts[0].normal_force_n = 30.0;
        contacts[0].friction_n = DVec3::X * 12.0;
        contacts[0].slip_m = DVec3::X * -0.5 * STEP_S / solver_steps;
        contacts[0].dt_s = STEP_S / solver_steps;
        (0..200).for_each(|_| advance(&mut metrics, &model, &mut state, &contacts));
        let whale = metrics.summary(&model, &state).whale.unwrap();
        let body = &whale.regions[BodyPart::Body as usize];
        assert!((body.friction_work_j - 12.0 * 0.5 * 2.0).abs() < 1e-9, "{body:?}");
        assert!((body.peak_pressure_pa - 30.0 / (0.5 * 0.01)).abs() < 1e-9);
        assert!(
            whale
                .regions
                .iter()
                .filter(|region| region.part != BodyPart::Body)
                .all(|region| region.friction_work_j.abs() < 1e-12)
        );
    }
}

/// The displacement of a sticking contact that is reversed does no net work.
#[test]
fn reversed_sticking_does_no_work() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    let mut contacts = touch(&model);
    for k in 0..1000 {
        let phase = std::f64::consts::TAU * f64::from(k) / 1000.0;
        contacts[0].friction_n = DVec3::Y * -1e4 * 1e-3 * libm::sin(phase);
        contacts[0].slip_m = DVec3::Y * 1e-3 * libm::cos(phase) * std::f64::consts::TAU / 1000.0;
        advance(&mut metrics, &model, &mut state, &contacts);
    }
    let work = metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Body as usize]
        .friction_work_j;
    assert!(work.abs() < 1e-9, "{work}");
}

/// Normal forces add up over a part, and the peak is of the sum.
#[test]
fn peak_normal_force_is_of_the_sum() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    for force in [5.0, 40.0, 20.0] {
        let one = ContactPoint { normal_force_n: force, ..touch(&model)[0].clone() };
        let idle = ContactPoint { normal_force_n: 0.0, segment: 2, ..one.clone() };
        advance(
            &mut metrics,
            &model,
            &mut state,
            &[one.clone(), ContactPoint { segment: 1, ..one }, idle],
        );
    }
    let body = &metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Body as usize];
    assert_eq!((body.peak_normal_n, body.contact_length_m), (80.0, 1.0));
}

/// Contact that pushes rope north opposes a whale that heads north; 100 N for 3 s of the last 5 s are 60 N.
#[test]
fn added_drag_is_along_the_heading_and_a_mean_of_five_seconds() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    state.whale.as_mut().unwrap().orientation = DQuat::from_rotation_z(FRAC_PI_2);
    let mut contacts = touch(&model);
    (contacts[0].normal, contacts[0].normal_force_n) = (DVec3::new(0.0, 0.6, 0.8), 100.0);
    contacts[0].friction_n = DVec3::new(7.0, 40.0, -30.0);
    (0..400).for_each(|_| advance(&mut metrics, &model, &mut state, &contacts));
    let early = metrics.summary(&model, &state).whale.unwrap();
    assert!(
        (early.drag_added_n - 100.0).abs() < 1e-9 && (early.drag_added_now_n - 100.0).abs() < 1e-9,
        "{early:?}"
    );
    (0..700).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
    (0..300).for_each(|_| advance(&mut metrics, &model, &mut state, &contacts));
    let late = metrics.summary(&model, &state).whale.unwrap();
    assert!((late.drag_added_n - 60.0).abs() < 0.3, "{}", late.drag_added_n);
}

/// A contact of segment `segment`, with a normal force.
fn pressed(segment: usize, normal: DVec3, normal_force_n: f64) -> ContactPoint {
    ContactPoint {
        is_knot: false,
        line: 0,
        segment,
        fraction: 0.5,
        triangle: 0,
        barycentric: [1.0, 0.0, 0.0],
        region: Region::ALL[0],
        position: DVec3::ZERO,
        normal,
        distance_m: 0.005,
        length_m: 0.1,
        normal_force_n,
        friction_n: DVec3::ZERO,
        slip_m: DVec3::ZERO,
        dt_s: 0.01,
    }
}

/// Triangle 1 of a skin that is inside the mouth.
const INSIDE: usize = 1;

/// Share of normal force beyond what rope can exert, for constant contacts.
fn share(model: &Model, state: &State, contacts: &[ContactPoint]) -> f64 {
    let skin = Skin {
        vertices: vec![DVec3::ZERO; 4],
        triangles: vec![[0, 1, 2], [1, 2, 3]],
        regions: vec![Region::Head; 2],
        weights: Vec::new(),
        marks: vec![Mark::Skin, Mark::Mouth, Mark::Mouth, Mark::Mouth],
        bones: Vec::new(),
    };
    let mut meter = ExcessForceMeter::new(inside_of_mouth(&skin));
    (0..10).for_each(|_| meter.fold(model, state, contacts, 0.01));
    meter.beyond_share()
}

/// A line of `count` segments under a tension, bent uniformly by `turn` about the z axis, straight if that is zero.
fn bent(count: usize, turn: f64, tension_n: f64) -> (Model, State) {
    let model = model(spec(vec![0.1; count]));
    let mut state = State::start(&model);
    let mut place = DVec3::ZERO;
    for node in 0..=count {
        state.rope.position[node] = place;
        let angle = turn * node as f64 / (count - 1) as f64;
        place += 0.1 * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
    }
    state.rope.tension.fill(tension_n);
    (model, state)
}

/// Normal forces with the sum `T θ`, away from the axis of the bend, on the inner segments.
fn capstan(count: usize, turn: f64, tension_n: f64) -> Vec<ContactPoint> {
    let each = tension_n * turn / (count - 2) as f64;
    let away = |segment: usize| {
        let angle = turn * segment as f64 / (count - 1) as f64 - FRAC_PI_2;
        DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
    };
    (1..count - 1).map(|segment| pressed(segment, away(segment), each)).collect()
}

#[test]
fn rope_round_a_drum_or_an_edge_is_within_the_bound() {
    for turn in [0.3, PI, 3.0 * PI, 8.0 * PI] {
        let (model, state) = bent(40, turn, 250.0);
        let share = share(&model, &state, &capstan(40, turn, 250.0));
        assert!(share.abs() < 1e-12, "{share} at {turn} rad");
    }
}

#[test]
fn a_supported_load_is_within_its_resultant() {
    // Slack rope pushed by a fluke: no tension, and all forces in one direction.
    let (model, state) = bent(20, 0.2, 0.0);
    let contacts: Vec<_> = (3..12).map(|segment| pressed(segment, DVec3::Y, 40.0)).collect();
    assert!(share(&model, &state, &contacts).abs() < 1e-12);
}

#[test]
fn rope_pressed_from_two_sides_exceeds_the_bound() {
    let (model, state) = bent(20, 0.0, 10.0);
    let contacts =
        [pressed(5, DVec3::Y, 1000.0), pressed(5, -DVec3::Y, 1000.0), pressed(15, DVec3::Z, 15.0)];
    // Of 2,015 N, the bound of two straight stretches under 10 N is 20 N each plus their resultants.
    let expected = (2000.0 - 20.0) / 2015.0;
    assert!((share(&model, &state, &contacts) - expected).abs() < 1e-12);
}

/// Cancelling forces between the lips or inside the mouth do not count as excess; those between two other parts do.
#[test]
fn a_mouth_may_press_rope_from_two_sides() {
    let (model, state) = bent(20, 0.0, 10.0);
    let mut contacts =
        [pressed(5, DVec3::Y, 1000.0), pressed(5, -DVec3::Y, 900.0), pressed(15, DVec3::Z, 15.0)];
    let free = share(&model, &state, &contacts);
    assert!((free - (1900.0 - 20.0 - 100.0) / 1915.0).abs() < 1e-12, "{free}");
    contacts[0].region = Region::Lips;
    // 1,800 N cancel; the remaining 100 N are the resultant.
    assert!(share(&model, &state, &contacts).abs() < 1e-12);
    contacts[0].region = Region::Head;
    contacts[1].triangle = INSIDE;
    assert!(share(&model, &state, &contacts).abs() < 1e-12);
    contacts[1].triangle = 0;
    // Contact with lips at another segment has no effect here.
    contacts[2].region = Region::Lips;
    assert!((share(&model, &state, &contacts) - free).abs() < 1e-12);
}

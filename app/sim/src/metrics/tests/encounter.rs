//! Outcomes and events of scripted encounters.

use super::*;
use crate::metrics::{EventKind, Outcome};

/// Spells of (seconds, touching), when the link parted, the outcome and whether it stands.
type Case = (&'static [(f64, bool)], Option<f64>, Outcome, bool);

/// Plays spells of (seconds, touching) and returns what the whale's summary says of it.
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
        // A link that parts in a storm without a whale is no encounter.
        (&[(20.0, false)], Some(3.0), Outcome::NoContact, true),
        (&[(5.0, false), (30.0, true)], None, Outcome::Entangled, true),
        (&[(5.0, false), (3.0, true)], None, Outcome::Entangled, false),
        // Long contact, then free: 9 s are not enough, 11 s are.
        (&[(40.0, true), (9.0, false)], None, Outcome::Entangled, false),
        (&[(40.0, true), (11.0, false)], None, Outcome::Shed, true),
        // A short episode: free for a third of it.
        (&[(6.0, true), (2.5, false)], None, Outcome::Entangled, false),
        (&[(6.0, true), (3.5, false)], None, Outcome::Shed, false),
        // Flutter does not let go.
        (
            &[(6.0, true), (0.9, false), (0.1, true), (0.9, false), (0.1, true), (0.9, false)],
            None,
            Outcome::Entangled,
            false,
        ),
        // Shed, then a graze: judged as an episode of its own.
        (
            &[(20.0, true), (12.0, false), (0.1, true), (0.5, false)],
            None,
            Outcome::Entangled,
            false,
        ),
        (&[(20.0, true), (12.0, false), (0.1, true), (1.5, false)], None, Outcome::Shed, false),
        (&[(5.0, true), (15.0, true)], Some(3.0), Outcome::PartedEntangled, true),
        (&[(5.0, true), (15.0, false)], Some(3.0), Outcome::PartedFree, true),
        // Parted before the whale came: the encounter is judged by contact alone.
        (&[(5.0, false), (5.0, true), (12.0, false)], Some(1.0), Outcome::Shed, true),
    ];
    for (spells, parted, outcome, decided) in cases {
        assert_eq!(play(spells, parted), (outcome, decided), "{spells:?} parted {parted:?}");
    }
}

/// Rope that hung in half a turn or more is not let go before the full time is over.
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
    let told: Vec<_> =
        of_contact.map(|event| (event.kind, event.subject.as_str(), event.time_s)).collect();
    assert_eq!(
        told,
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

/// Slip is reported once after a second of sticking, not at a creep, and not where rope never stuck.
#[test]
fn slip_after_sticking_is_told() {
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
fn seabed_and_surface_are_told_with_their_way_back() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    for z in [-20.0, -48.0, -49.0, -48.5, -49.0, -40.0, -1.0, -2.5, -1.0] {
        state.whale.as_mut().unwrap().position.z = z;
        advance(&mut metrics, &model, &mut state, &[]);
    }
    let told: Vec<_> = metrics.events().iter().map(|event| event.kind).collect();
    assert_eq!(told, [EventKind::AtSeabed, EventKind::AtSurface, EventKind::AtSurface]);
    assert!((metrics.events()[0].value + 0.2).abs() < 0.02, "{:?}", metrics.events()[0]);
}

/// The same steps give the same summary and events, and folding reads nothing else.
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

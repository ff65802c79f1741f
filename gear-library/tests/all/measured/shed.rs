//! A loop pulled off a flipper's tip: its wraps decrease by levels, contact ends, and the rope counts as shed; events are in order.

use endline_sdk::MotionOutput;
use endline_sim::metrics::{EventKind, Outcome};

use super::{Run, hands, scenario, spec};

#[test]
fn a_loop_pulled_off_a_flipper_gives_events_in_order() {
    // Both ends are pulled to port, west for a whale that heads north; without friction the loop follows.
    let end = |id: &str, y: f64, z: f64| {
        format!(
            "[[fixture]]\nid = \"{id}\"\nposition = [\"-5 m\", \"{y} m\", \"{z} m\"]\nvelocity = [\"-1 m/s\", \"0 m/s\", \"0 m/s\"]\n\
             from = \"0 s\"\nuntil = \"30 s\"\n"
        )
    };
    let line = "[[line]]\nid = \"rope\"\nrope = \"rope\"\nfrom = \"fore\"\nto = \"aft\"\nlength = \"12 m\"\nstart = \"wrapped\"\n\
                [[line.wrap]]\npart = \"left_flipper\"\nturns = 1.5\n";
    let hooks = hands(Box::new(|_| MotionOutput::default()), false);
    let mut run = Run::of(spec(
        &scenario(&(end("fore", 2.0, -21.0) + &end("aft", 0.0, -22.0) + line)),
        &hooks,
    ));
    run.until(1.0, |_| ());
    let early = run.summary().whale.unwrap();
    assert_eq!(
        (early.outcome, early.hooked),
        (Outcome::Entangled, true),
        "{:?}",
        run.metrics.events()
    );
    run.until(20.0, |_| ());
    let events = run.metrics.events();
    events.iter().for_each(|event| {
        println!("{:6.2} s {:?} {} {:.2}", event.time_s, event.kind, event.subject, event.value)
    });
    assert!(events.windows(2).all(|pair| pair[0].time_s <= pair[1].time_s), "in order of time");
    let of_wraps = |event: &&endline_sim::metrics::Event| {
        event.subject == "left_flipper" && event.kind != EventKind::Slip
    };
    let reported: Vec<(EventKind, f64)> =
        events.iter().filter(of_wraps).map(|event| (event.kind, event.value)).collect();
    let kinds: Vec<EventKind> = reported.iter().map(|(kind, _)| *kind).collect();
    let [contact, wraps @ .., lost] = &kinds[..] else { panic!("{reported:?}") };
    assert_eq!((*contact, *lost), (EventKind::Contact, EventKind::ContactLost), "{reported:?}");
    assert_eq!(
        wraps.iter().filter(|kind| **kind == EventKind::Wrap).count(),
        2,
        "half a turn and one: {reported:?}"
    );
    let undone: Vec<f64> = reported
        .iter()
        .filter(|(kind, _)| *kind == EventKind::WrapUndone)
        .map(|(_, level)| *level)
        .collect();
    assert_eq!(undone, [1.0, 0.5], "{reported:?}");
    // Less than half a turn at the last contact: released once free for a third of the episode, t - t_last = (t - t_first)/3.
    let shed = events.iter().find(|event| event.kind == EventKind::Shed).unwrap();
    let wanted_s = 1.5 * shed.value - 0.5 * early.first_contact_s.unwrap();
    assert!((shed.time_s - wanted_s).abs() < 0.02, "{shed:?}, wanted at {wanted_s} s");
    let late = run.summary().whale.unwrap();
    assert_eq!((late.outcome, late.decided, late.hooked), (Outcome::Shed, true, false));
    assert!(late.regions.iter().all(|region| region.wraps < 1e-12));
}

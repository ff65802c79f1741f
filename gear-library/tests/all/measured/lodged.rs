//! Rope in the mouth: lodged once the jaws have closed on it, released once they open and the whale backs off.

use endline_sdk::{MotionOutput, Posture, Region};
use endline_sim::metrics::EventKind;

use super::{Run, hands, ramp, scenario, spec};

/// The whale opens its mouth, swims into a rope across its way, closes on it, waits, opens again and backs off.
fn timetable(ahead_m: f64) -> impl Fn(f64) -> MotionOutput + Send + Sync {
    let (go, stop) = (1.0, 1.0 + ahead_m);
    move |time_s| {
        let open = ramp(time_s, 0.0, 1.0) - ramp(time_s, stop + 0.5, stop + 1.5)
            + ramp(time_s, stop + 3.5, stop + 4.5);
        let pace = |from: f64, to: f64| ramp(time_s, from, from + 0.2) - ramp(time_s, to, to + 0.2);
        let posture = Posture { jaw: 0.35 * open, lips: [0.3 * open; 2], ..Posture::default() };
        MotionOutput {
            speed_m_s: pace(go, stop) - pace(stop + 4.5, stop + 6.5 + ahead_m),
            posture,
            ..MotionOutput::default()
        }
    }
}

#[test]
fn rope_lodges_in_the_mouth_and_comes_out_again() {
    let across = |y: f64, z: f64, rope_m: f64| {
        let end = |id: &str, x: f64| {
            format!("[[fixture]]\nid = \"{id}\"\nposition = [\"{x} m\", \"{y} m\", \"{z} m\"]\n")
        };
        let line = format!(
            "[[line]]\nid = \"rope\"\nrope = \"rope\"\nfrom = \"west\"\nto = \"east\"\nlength = \"{rope_m} m\"\n"
        );
        scenario(&(end("west", -2.0) + &end("east", 2.0) + &line))
    };
    let still = hands(Box::new(|_| MotionOutput::default()), true);
    let skin = spec(&across(20.0, -20.0, 4.0), &still).whale.unwrap().skin;
    let rostrum =
        skin.triangles.iter().zip(&skin.regions).filter(|(_, region)| **region == Region::Rostrum);
    let places: Vec<_> = rostrum
        .flat_map(|(corners, _)| corners.map(|corner| skin.vertices[corner as usize]))
        .collect();
    let snout = places.iter().map(|place| place.x).fold(f64::NEG_INFINITY, f64::max);
    let lowest = places
        .iter()
        .filter(|place| place.x > snout - 0.3)
        .map(|place| place.z)
        .fold(f64::INFINITY, f64::min);
    // The rope lies 0.3 m ahead of the snout, just below its tip; the whale takes it in as far as it may.
    let (start, ahead_m, height) = (snout + 0.3, 1.8, lowest - 0.08);
    println!("snout at x = {snout:.2} m, its tip's lowest at z = {lowest:.2} m");
    let hooks = hands(Box::new(timetable(ahead_m)), true);
    let mut run = Run::of(spec(&across(start, -20.0 + height, 4.1), &hooks));
    let stop = 1.0 + ahead_m;
    let lodged = |run: &Run| run.summary().whale.unwrap().lodged_in_mouth;
    run.until(stop - 0.5, |_| ());
    assert!(!lodged(&run), "it has only begun to touch");
    run.until(stop + 3.4, |_| ());
    println!("{:?}", run.metrics.events());
    assert!(
        lodged(&run),
        "{:?}",
        run.summary()
            .whale
            .unwrap()
            .patches
            .iter()
            .filter(|patch| patch.normal_n > 0.0)
            .collect::<Vec<_>>()
    );
    run.until(stop + 8.5 + ahead_m, |_| ());
    println!("{:?}", run.metrics.events());
    let whale = run.summary().whale.unwrap();
    assert!(!whale.lodged_in_mouth && whale.was_lodged_in_mouth);
    let reported = |kind: EventKind| {
        run.metrics
            .events()
            .iter()
            .find(|event| event.kind == kind)
            .map(|event| event.time_s)
            .unwrap()
    };
    let (in_s, out_s) = (reported(EventKind::Lodged), reported(EventKind::Dislodged));
    assert!(in_s > stop - 0.5 && in_s < stop + 3.4, "{in_s}");
    assert!(out_s > stop + 3.5, "not before the jaws open: {out_s}");
    assert_eq!(run.workspace.audit.tunnelled, 0);
}

//! The single: its parts, its lengths, a first guess that the rope can reach.
#![expect(clippy::unwrap_used, reason = "helpers of tests: an error in one fails its test")]

use endline_gear_types::Single;
use endline_sdk::{AttributeValue, GearType, LineEnd, Rig, RigEnd, Site};

const SITE: Site = Site { depth_m: 25.0, current_m_s: [0.0, 0.4] };

fn values() -> Vec<AttributeValue> {
    Single::new()
        .descriptor()
        .attributes
        .iter()
        .map(|attribute| attribute.default_value())
        .collect()
}

fn with(key: &str, value: AttributeValue) -> Vec<AttributeValue> {
    let index = Single::new()
        .descriptor()
        .attributes
        .iter()
        .position(|attribute| attribute.key == key)
        .unwrap();
    let mut values = values();
    values[index] = value;
    values
}

fn item(id: &str) -> AttributeValue {
    AttributeValue::Item(id.to_owned())
}

fn place(rig: &Rig, end: &RigEnd) -> [f64; 3] {
    match end {
        RigEnd::Body(id) => rig.bodies.iter().find(|body| &body.id == id).unwrap().position_m,
        RigEnd::Joint(id) => rig.joints.iter().find(|joint| &joint.id == id).unwrap().position_m,
    }
}

#[test]
fn default_single_is_a_trap_a_buoy_and_two_ropes_in_a_row() {
    let rig = Single::new().build(&values(), &SITE).unwrap();
    let parts: Vec<_> =
        rig.bodies.iter().map(|body| (body.id.as_str(), body.item.as_str())).collect();
    assert_eq!(parts, [("trap", "wire-lobster-3ft"), ("buoy", "bullet-6x14")]);
    let ropes: Vec<_> =
        rig.lines.iter().map(|line| (line.id.as_str(), line.rope.as_str())).collect();
    assert_eq!(ropes, [("endline-bottom", "pp-3-8"), ("endline-top", "sink-3-8")]);
    assert_eq!(rig.lines[0].to, rig.lines[1].from);
    let length: f64 = rig.lines.iter().map(|line| line.length_m).sum();
    assert!((length - 1.3 * 25.0).abs() < 1e-9);
    assert!((rig.lines[0].length_m - length / 3.0).abs() < 1e-9);
    let link = &rig.links[0];
    assert_eq!(
        (link.id.as_str(), link.item.as_str(), link.line.as_str(), link.end),
        ("buoy-link", "wl-600", "endline-top", LineEnd::B)
    );
}

#[test]
fn first_guess_is_downstream_and_within_the_reach_of_every_line() {
    for scope in [1.0, 1.3, 2.0, 5.0] {
        for current_m_s in [[0.0, 0.4], [-0.7, 0.1], [0.0, 0.0]] {
            let rig = Single::new()
                .build(&with("scope", AttributeValue::Number(scope)), &Site { current_m_s, ..SITE })
                .unwrap();
            for line in &rig.lines {
                let (a, b) = (place(&rig, &line.from), place(&rig, &line.to));
                let apart: f64 = (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>().sqrt();
                assert!(
                    apart <= line.length_m * (1.0 + 1e-12),
                    "{}: ends {apart} m apart, {} m of rope",
                    line.id,
                    line.length_m
                );
            }
            let buoy = place(&rig, &RigEnd::Body("buoy".into()));
            assert!(
                buoy[0] * current_m_s[0] + buoy[1] * current_m_s[1] >= 0.0,
                "upstream: {buoy:?}"
            );
        }
    }
}

#[test]
fn surface_system_comes_out_of_the_upper_rope_and_takes_the_link() {
    let rig = Single::new().build(&with("surface_rope", item("sink-5-16")), &SITE).unwrap();
    assert_eq!(rig.lines.len(), 3);
    assert!((rig.lines[2].length_m - 2.0).abs() < 1e-12);
    assert!((rig.lines.iter().map(|line| line.length_m).sum::<f64>() - 32.5).abs() < 1e-9);
    assert_eq!(rig.lines[1].to, rig.lines[2].from);
    assert_eq!(rig.lines[2].to, RigEnd::Body("buoy".into()));
    assert_eq!(rig.links[0].line, "surface-system");
}

#[test]
fn weak_link_may_be_left_out_but_ropes_may_not() {
    assert!(Single::new().build(&with("weak_link", item("")), &SITE).unwrap().links.is_empty());
    let error = Single::new().build(&with("lower_rope", item("")), &SITE).unwrap_err();
    assert!(error.message.contains("`lower_rope`"), "{error}");
}

#[test]
fn what_cannot_be_built_is_said() {
    let error = Single::new().build(&values(), &Site { depth_m: f64::NAN, ..SITE }).unwrap_err();
    assert!(error.message.contains("depth"), "{error}");
    let mut long = with("surface_length", AttributeValue::Number(40.0));
    long[6] = item("sink-5-16");
    let error = Single::new().build(&long, &SITE).unwrap_err();
    assert!(error.message.contains("`surface_length`"), "{error}");
    assert!(Single::new().build(&values()[..3], &SITE).is_err());
}

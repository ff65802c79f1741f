//! Values of a gear type, and queries of the rig that it builds.
#![allow(dead_code, reason = "each test uses what it needs")]

use endline_sdk::{AttributeValue, GearType, Rig, RigEnd, Site};

pub const SITE: Site = Site { depth_m: 25.0, current_m_s: [0.0, 0.4] };

/// Defaults with these changes.
pub fn values(gear: &dyn GearType, changes: &[(&str, AttributeValue)]) -> Vec<AttributeValue> {
    let attributes = &gear.descriptor().attributes;
    assert!(
        changes.iter().all(|(key, _)| attributes.iter().any(|attribute| attribute.key == *key)),
        "{changes:?}"
    );
    let changed =
        |key: &str| changes.iter().find(|(known, _)| *known == key).map(|(_, value)| value.clone());
    attributes
        .iter()
        .map(|attribute| changed(&attribute.key).unwrap_or_else(|| attribute.default_value()))
        .collect()
}

pub fn built(gear: &dyn GearType, changes: &[(&str, AttributeValue)]) -> Rig {
    gear.build(&values(gear, changes), &SITE).unwrap()
}

pub fn number(value: f64) -> AttributeValue {
    AttributeValue::Number(value)
}

pub fn item(id: &str) -> AttributeValue {
    AttributeValue::Item(id.to_owned())
}

pub fn word(word: &str) -> AttributeValue {
    AttributeValue::Choice(word.to_owned())
}

/// First guess of the place of a line's end [m].
pub fn place(rig: &Rig, end: &RigEnd) -> [f64; 3] {
    match end {
        RigEnd::Body(id) => {
            let id = id.split(':').next().unwrap();
            rig.bodies.iter().find(|body| body.id == id).unwrap().position_m
        }
        RigEnd::Joint(id) => rig.joints.iter().find(|joint| &joint.id == id).unwrap().position_m,
    }
}

pub fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>().sqrt()
}

/// Ids of the lines with a prefix.
pub fn lines<'a>(rig: &'a Rig, begin: &str) -> Vec<&'a str> {
    rig.lines.iter().map(|line| line.id.as_str()).filter(|id| id.starts_with(begin)).collect()
}

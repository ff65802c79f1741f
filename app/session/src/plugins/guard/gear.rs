//! Guard of a gear type: a rig whose parts fit together, actions that name parts it has.

use std::collections::BTreeSet;
use std::sync::Arc;

use endline_sdk::{
    Attribute, AttributeKind, AttributeValue, Descriptor, GearAction, GearStep, GearType,
    HookError, Rig, RigEnd, RigLine, Site,
};

use super::{expect_finite, expect_len, fault, named};

pub(super) struct Guarded(pub Arc<dyn GearType>);

impl GearType for Guarded {
    fn descriptor(&self) -> &Descriptor {
        self.0.descriptor()
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        self.watched_build(attributes, site).map_err(named(&self.descriptor().id))
    }

    fn step(
        &self,
        attributes: &[AttributeValue],
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        self.watched_step(attributes, input, state, actions).map_err(named(&self.descriptor().id))
    }
}

impl Guarded {
    fn watched_build(&self, values: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        check_values(&self.descriptor().attributes, values)?;
        let rig = self.0.build(values, site)?;
        check_rig(&rig)?;
        Ok(rig)
    }

    fn watched_step(
        &self,
        values: &[AttributeValue],
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        check_values(&self.descriptor().attributes, values)?;
        expect_len("floats of state", state.len(), self.descriptor().state_len)?;
        let before = actions.len();
        self.0.step(values, input, state, actions)?;
        expect_finite("a float of its state", state)?;
        let lines = input.end_tension_n.len();
        for action in actions.iter().skip(before) {
            if let GearAction::CutLine { line, .. } = action
                && *line as usize >= lines
            {
                return fault(format!(
                    "it cuts line {line}, but its rig has {lines} lines, counted from 0"
                ));
            }
        }
        Ok(())
    }
}

fn check_values(attributes: &[Attribute], values: &[AttributeValue]) -> Result<(), HookError> {
    expect_len("attribute values", values.len(), attributes.len())?;
    for (attribute, value) in attributes.iter().zip(values) {
        match (&attribute.kind, value) {
            (
                AttributeKind::Number { .. } | AttributeKind::Count { .. },
                AttributeValue::Number(_),
            )
            | (AttributeKind::Choice { .. }, AttributeValue::Choice(_))
            | (AttributeKind::Item { .. }, AttributeValue::Item(_)) => {}
            (AttributeKind::Choice { .. }, _) => {
                return fault(format!("attribute `{}`: expected one of its words", attribute.key));
            }
            (AttributeKind::Number { .. } | AttributeKind::Count { .. }, _) => {
                return fault(format!("attribute `{}`: expected a number", attribute.key));
            }
            (AttributeKind::Item { .. }, _) => {
                return fault(format!("attribute `{}`: expected a library item", attribute.key));
            }
        }
    }
    Ok(())
}

fn check_rig(rig: &Rig) -> Result<(), HookError> {
    let bodies = unique("body", rig.bodies.iter().map(|body| &body.id))?;
    let joints = unique("joint", rig.joints.iter().map(|joint| &joint.id))?;
    let lines = unique("line", rig.lines.iter().map(|line| &line.id))?;
    unique("link", rig.links.iter().map(|link| &link.id))?;
    let places = rig
        .bodies
        .iter()
        .map(|body| &body.position_m)
        .chain(rig.joints.iter().map(|joint| &joint.position_m));
    places.into_iter().try_for_each(|place| expect_finite("a place in its rig", place))?;
    if let Some(body) = rig.bodies.iter().find(|body| body.item.is_empty()) {
        return fault(format!("body `{}` names no library item", body.id));
    }
    rig.lines.iter().try_for_each(|line| check_line(line, &bodies, &joints))?;
    match rig.links.iter().find(|link| link.item.is_empty() || !lines.contains(link.line.as_str()))
    {
        Some(link) => fault(format!(
            "link `{}` names item `{}` in line `{}`, which its rig lacks",
            link.id, link.item, link.line
        )),
        None => Ok(()),
    }
}

fn check_line(
    line: &RigLine,
    bodies: &BTreeSet<&str>,
    joints: &BTreeSet<&str>,
) -> Result<(), HookError> {
    if !(line.length_m > 0.0 && line.length_m.is_finite()) {
        return fault(format!("line `{}` is {} m long", line.id, line.length_m));
    }
    line.laid_m.iter().try_for_each(|place| expect_finite("a place in its rig", place))?;
    if line.laid_m.len() == 1 {
        return fault(format!(
            "line `{}` is laid through one place; it takes two or more, or none",
            line.id
        ));
    }
    if line.rope.is_empty() {
        return fault(format!("line `{}` names no rope", line.id));
    }
    for end in [&line.from, &line.to] {
        let (known, what, id) = match end {
            // Which points a body has is known at assembly.
            RigEnd::Body(id) => (bodies, "body", id.split(':').next().unwrap_or_default()),
            RigEnd::Joint(id) => (joints, "joint", id.as_str()),
        };
        if !known.contains(id) {
            return fault(format!("line `{}` ends at {what} `{id}`, which its rig lacks", line.id));
        }
    }
    Ok(())
}

fn unique<'a>(
    what: &str,
    ids: impl Iterator<Item = &'a String>,
) -> Result<BTreeSet<&'a str>, HookError> {
    let mut seen = BTreeSet::new();
    for id in ids {
        if id.is_empty() || !seen.insert(id.as_str()) {
            return fault(format!("the {what} id `{id}` is empty or used twice in its rig"));
        }
    }
    Ok(seen)
}

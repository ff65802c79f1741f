//! Watches over a plugin: right lengths in, finite and passive values out, its id in every error.
//!
//! Forces of a friction model are finite, lie across the normal and cannot drive the rope. A law of friction may return what its bristles
//! stored, so force along slip alone proves nothing. Two conditions do: a contact that stores nothing (all floats zero) may not push
//! in the direction of its slip, and no contact may pull harder than [`GREATEST_RATIO`] times coefficient times normal force.

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::sync::Arc;

use endline_sdk::{
    Attribute, AttributeKind, AttributeValue, Contacts, Descriptor, FrictionModel,
    FrictionResponse, GearAction, GearStep, GearType, HookError, MotionInput, MotionOutput, Rig,
    RigEnd, RigLine, Site, WhaleMotion,
};

use super::info::Hook;

/// A plugin that is watched over.
struct Guarded<P: ?Sized>(Arc<P>);

pub(super) fn guarded(hook: Hook) -> Hook {
    match hook {
        Hook::Motion(motion) => Hook::Motion(Arc::new(Guarded(motion))),
        Hook::Friction(friction) => Hook::Friction(Arc::new(Guarded(friction))),
        Hook::Gear(gear) => Hook::Gear(Arc::new(Guarded(gear))),
    }
}

/// Runs a guarded call; its error has the plugin's id in front.
fn named<T>(
    plugin: &Descriptor,
    call: impl FnOnce() -> Result<T, HookError>,
) -> Result<T, HookError> {
    call().map_err(|error| HookError::new(format!("plugin `{}`: {}", plugin.id, error.message)))
}

fn fault<T>(message: impl Into<String>) -> Result<T, HookError> {
    Err(HookError::new(message))
}

fn expect_len(what: &str, got: usize, expected: usize) -> Result<(), HookError> {
    if got == expected { Ok(()) } else { fault(format!("expected {expected} {what}, got {got}")) }
}

fn expect_finite(what: &str, values: &[f64]) -> Result<(), HookError> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => fault(format!("it gave {value} for {what}")),
    }
}

/// Greatest friction force over coefficient times normal force that passes for friction [1].
const GREATEST_RATIO: f64 = 10.0;

/// Share of rounding that is forgiven [1].
const ROUNDING: f64 = 1e-9;

/// Mark of a place for an answer before the call: a NaN that no arithmetic returns.
pub(in crate::plugins) const BLANK: f64 = f64::from_bits(0x7ff8_5eed_0e4d_11e5);
/// An answer of such numbers.
pub(in crate::plugins) const UNWRITTEN: FrictionResponse =
    FrictionResponse { force_n: [BLANK; 3], by_slip: [[BLANK; 3]; 3], by_normal_force: [BLANK; 3] };

impl FrictionModel for Guarded<dyn FrictionModel> {
    fn descriptor(&self) -> &Descriptor {
        self.0.descriptor()
    }

    fn respond(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        named(self.descriptor(), || {
            self.check_input(attributes, contacts)?;
            expect_len("places for answers", out.len(), contacts.len())?;
            out.fill(UNWRITTEN);
            self.0.respond(attributes, contacts, out)?;
            let is_blank = |number: &f64| number.to_bits() == BLANK.to_bits();
            if out.iter().any(|answer| answer.force_n.iter().all(is_blank)) {
                return fault(format!(
                    "it wrote fewer answers than the {} contacts it was asked about",
                    contacts.len()
                ));
            }
            let floats = self.descriptor().state_len;
            for (index, answer) in out.iter().enumerate() {
                let fresh = contacts.state[floats * index..floats * (index + 1)]
                    .iter()
                    .all(|float| *float == 0.0);
                check_answer(answer, contacts, index, fresh).map_err(|error| {
                    HookError::new(format!("contact {index}: {}", error.message))
                })?;
            }
            Ok(())
        })
    }

    fn advance(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [f64],
    ) -> Result<(), HookError> {
        named(self.descriptor(), || {
            self.check_input(attributes, contacts)?;
            expect_len(
                "places for floats",
                out.len(),
                contacts.len() * self.descriptor().state_len,
            )?;
            out.fill(BLANK);
            self.0.advance(attributes, contacts, out)?;
            if out.iter().any(|float| float.to_bits() == BLANK.to_bits()) {
                return fault(format!(
                    "it wrote fewer than the {} floats of its contacts",
                    out.len()
                ));
            }
            expect_finite("a float of its state", out)
        })
    }
}

impl Guarded<dyn FrictionModel> {
    fn check_input(&self, attributes: &[f64], contacts: &Contacts<'_>) -> Result<(), HookError> {
        expect_len("attribute values", attributes.len(), self.descriptor().attributes.len())?;
        let count = contacts.len();
        for got in [
            contacts.normal.len(),
            contacts.grain.len(),
            contacts.along.len(),
            contacts.slip_m.len(),
            contacts.length_m.len(),
            contacts.coefficient.len(),
            contacts.region.len(),
            contacts.rope.len(),
        ] {
            expect_len("entries in each array of contacts", got, count)?;
        }
        expect_len("floats of state", contacts.state.len(), count * self.descriptor().state_len)
    }
}

fn check_answer(
    answer: &FrictionResponse,
    contacts: &Contacts<'_>,
    index: usize,
    fresh: bool,
) -> Result<(), HookError> {
    expect_finite("the force", &answer.force_n)?;
    expect_finite("the derivative by slip", answer.by_slip.as_flattened())?;
    expect_finite("the derivative by normal force", &answer.by_normal_force)?;
    let (force, slip) = (answer.force_n, contacts.slip_m[index]);
    let (size, way) = (dot(force, force).sqrt(), dot(slip, slip).sqrt());
    let limit = contacts.coefficient[index] * contacts.normal_force_n[index];
    if dot(force, contacts.normal[index]).abs() > 1e-6 * (size + limit) {
        return fault(format!(
            "its force {force:?} N does not lie across the normal {:?}",
            contacts.normal[index]
        ));
    }
    if fresh && dot(force, slip) > ROUNDING * size * way {
        return fault(format!(
            "its force {force:?} N pushes the way the rope slips, {slip:?} m: friction may not create energy"
        ));
    }
    let most = GREATEST_RATIO * limit;
    if size > most * (1.0 + ROUNDING) + f64::MIN_POSITIVE {
        return fault(format!(
            "its force of {size} N is beyond {GREATEST_RATIO} times coefficient times normal force, {most} N"
        ));
    }
    Ok(())
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl GearType for Guarded<dyn GearType> {
    fn descriptor(&self) -> &Descriptor {
        self.0.descriptor()
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        named(self.descriptor(), || {
            check_values(&self.descriptor().attributes, attributes)?;
            let rig = self.0.build(attributes, site)?;
            check_rig(&rig)?;
            Ok(rig)
        })
    }

    fn step(
        &self,
        attributes: &[AttributeValue],
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        named(self.descriptor(), || {
            check_values(&self.descriptor().attributes, attributes)?;
            expect_len("floats of state", state.len(), self.descriptor().state_len)?;
            let before = actions.len();
            self.0.step(attributes, input, state, actions)?;
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
        })
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
            (kind, _) => {
                let expected = match kind {
                    AttributeKind::Choice { .. } => "one of its words",
                    AttributeKind::Number { .. } | AttributeKind::Count { .. } => "a number",
                    AttributeKind::Item { .. } => "a library item",
                };
                return fault(format!("attribute `{}`: expected {expected}", attribute.key));
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

/// No whale swims faster than this [m/s].
const GREATEST_SPEED_M_S: f64 = 30.0;

/// No whale turns faster than this [rad/s].
const GREATEST_TURN_RAD_S: f64 = 10.0;

impl WhaleMotion for Guarded<dyn WhaleMotion> {
    fn descriptor(&self) -> &Descriptor {
        self.0.descriptor()
    }

    fn step(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        named(self.descriptor(), || {
            expect_len("attribute values", attributes.len(), self.descriptor().attributes.len())?;
            expect_len("floats of state", state.len(), self.descriptor().state_len)?;
            let out = self.0.step(attributes, input, state)?;
            expect_finite("a float of its state", state)?;
            expect_within("the speed", &[out.speed_m_s], GREATEST_SPEED_M_S, "m/s")?;
            expect_within("a turn rate", &out.turn_rate_rad_s, GREATEST_TURN_RAD_S, "rad/s")?;
            for (what, angles) in out.posture.groups() {
                expect_within(what, angles, PI, "rad")?;
            }
            Ok(out)
        })
    }
}

fn expect_within(what: &str, values: &[f64], most: f64, unit: &str) -> Result<(), HookError> {
    expect_finite(what, values)?;
    match values.iter().find(|value| value.abs() > most) {
        None => Ok(()),
        Some(value) => fault(format!("it gave {value} {unit} for {what}, beyond {most} {unit}")),
    }
}

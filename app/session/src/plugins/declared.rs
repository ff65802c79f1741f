//! Whether what a plugin declares of itself makes sense.

use std::collections::BTreeSet;

use endline_sdk::{AttributeKind, Controls, Descriptor};

use super::info::Refusal;

/// Most attributes, and floats of state, that a plugin may declare; more is taken for a lie.
pub(super) const MOST_ATTRIBUTES: usize = 1000;
pub(super) const MOST_STATE: usize = 1_000_000;

/// Most acts that a motion may declare.
pub(super) const MOST_ACTS: usize = Controls::MOST_ACTS;

const TELL_AUTHOR: &str = "tell the plugin's author";

/// Checks id, attributes, defaults, state length and acts.
pub(super) fn check(descriptor: &Descriptor) -> Result<(), Refusal> {
    let id = descriptor.id.as_ref();
    if !id_is_sound(id) {
        let reason =
            format!("its id `{id}` is not a reverse-domain name such as org.example.friction.wet");
        return Err(Refusal::new(reason, TELL_AUTHOR));
    }
    let wrong = |reason: String| Err(Refusal::of(id, reason, TELL_AUTHOR));
    if descriptor.state_len > MOST_STATE {
        return wrong(format!(
            "it asks for {} floats of state, more than {MOST_STATE}",
            descriptor.state_len
        ));
    }
    let mut keys = BTreeSet::new();
    for attribute in &descriptor.attributes {
        let key = attribute.key.as_ref();
        if key.is_empty() || !keys.insert(key) {
            return wrong(format!("its attribute key `{key}` is empty or used twice"));
        }
        if let Some(reason) = fault(&attribute.kind) {
            return wrong(format!("its attribute `{key}`: {reason}"));
        }
    }
    match act_fault(descriptor) {
        Some(reason) => wrong(reason),
        None => Ok(()),
    }
}

/// Acts are named in scenarios by their id, each once.
fn act_fault(descriptor: &Descriptor) -> Option<String> {
    let is_sound = |id: &str| {
        !id.is_empty()
            && id.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
    };
    let mut ids = BTreeSet::new();
    let wrong =
        descriptor.acts.iter().find(|act| !is_sound(&act.id) || !ids.insert(act.id.as_ref()))?;
    Some(format!(
        "its act `{}` is named twice or not in small letters, digits and hyphens, such as roll-away",
        wrong.id
    ))
}

fn id_is_sound(id: &str) -> bool {
    let part = |part: &str| {
        !part.is_empty() && part.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
    };
    id.contains('.') && id.split('.').all(part)
}

fn fault(kind: &AttributeKind) -> Option<String> {
    match kind {
        AttributeKind::Number { min, max, default } => {
            let sound = [min, max, default].iter().all(|number| number.is_finite())
                && min <= default
                && default <= max;
            (!sound).then(|| format!("its default {default} and range {min} to {max} must be finite, the default within the range"))
        }
        AttributeKind::Count { min, max, default } => (!(min..=max).contains(&default))
            .then(|| format!("its default {default} is not within its range {min} to {max}")),
        AttributeKind::Choice { words, default } => {
            let sound = words.iter().all(|word| !word.is_empty() && !word.contains('|'))
                && words.contains(default);
            (!sound).then(|| format!("its words must not be empty or hold a `|`, and its default `{default}` must be one of them"))
        }
        AttributeKind::Item { .. } => None,
    }
}

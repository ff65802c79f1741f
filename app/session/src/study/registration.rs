//! Registration: events, claims and observations of a study, stored in its folder of results before the first run.
//!
//! Events, claims and observations change no run and may be added at any time. A choice made after seeing the results may only fit
//! chance. The folder therefore stores the list before the first run, with its hash, and a report marks later additions. The hash may
//! be published beforehand.
//! Reference: Nosek et al. 2018, The preregistration revolution (doi:10.1073/pnas.1708274114).

use std::collections::BTreeMap;

use endline_gear::Study;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Registered events, claims and observations.
#[derive(Clone, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub struct Registration {
    /// Names of the events by which options are compared; that by which they are ranked first.
    pub events: Vec<String>,
    /// Claims: id and hash of what is counted.
    pub claims: BTreeMap<String, String>,
    /// Observations: id and hash of what is counted and expected.
    pub observations: BTreeMap<String, String>,
    /// BLAKE3 of all of this.
    pub hash: String,
}

impl Registration {
    /// As a study's file has it now.
    pub fn of(study: &Study) -> Self {
        let mut events = vec![study.event.name()];
        events.extend(study.registered.iter().map(|event| event.value.name()));
        let claims = study.claims.iter().map(|claim| {
            let counted =
                format!("{:?}", (&claim.event, &claim.more, &claim.less_event, &claim.less));
            (claim.id.value.clone(), short_hash(&counted))
        });
        let observations = study.observations.iter().map(|seen| {
            let which = (&seen.of, &seen.among, &seen.option, &seen.fewer_with);
            let decided = if seen.by_construction.is_some() { " by construction" } else { "" };
            let counted = format!("{which:?} {:?} {:?}{decided}", seen.times, seen.observed);
            (seen.id.value.clone(), short_hash(&counted))
        });
        let mut own = Self {
            events,
            claims: claims.collect(),
            observations: observations.collect(),
            hash: String::new(),
        };
        own.hash = short_hash(&format!("{own:?}"));
        own
    }

    /// Whether an event was named.
    pub fn has_event(&self, name: &str) -> bool {
        self.events.iter().any(|known| known == name)
    }

    /// Whether a claim of another list was named here, and counted in the same way.
    pub fn has_claim(&self, now: &Self, id: &str) -> bool {
        self.claims.contains_key(id) && self.claims.get(id) == now.claims.get(id)
    }

    /// Whether an observation of another list was named here, with the same expectation.
    pub fn has_observation(&self, now: &Self, id: &str) -> bool {
        self.observations.contains_key(id) && self.observations.get(id) == now.observations.get(id)
    }
}

/// The first 128 bits of a BLAKE3.
fn short_hash(text: &str) -> String {
    blake3::derive_key("endline study registration 1", text.as_bytes())
        .iter()
        .take(16)
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const STUDY: &str = r#"
format = 1
kind = "study"
name = "Registered"
scenario = "hello-endline"
encounters = 8
baseline = "a"
event = "held_fast"
registered = ["parted"]
[[option]]
id = "a"
[encounter.speed]
value = "1 m/s"
source = "assumed"
[[claim]]
id = "one"
says = "more wraps than contacts"
source = "none"
event = "wrap_any"
less_event = "contact"
more = ["a"]
less = ["a"]
[[observation]]
id = "B0"
says = "half"
source = "none"
of = "contact"
observed = [0.4, 0.6]
"#;

    #[test]
    fn what_is_added_or_changed_later_is_not_registered() {
        let read = |text: &str| Registration::of(&Study::read("registered.toml", text).unwrap());
        let first = read(STUDY);
        assert!(
            first.has_event("held_fast") && first.has_event("parted") && !first.has_event("shed")
        );
        assert!(first.has_claim(&first, "one") && first.has_observation(&first, "B0"));
        let renamed = read(&STUDY.replace("says = \"half\"", "says = \"about half\""));
        assert_eq!(first, renamed, "words change nothing");
        let moved =
            read(&STUDY.replace("[0.4, 0.6]", "[0.1, 0.6]").replace("\"wrap_any\"", "\"lodged\""));
        assert!(!first.has_claim(&moved, "one") && !first.has_observation(&moved, "B0"));
        assert_ne!(first.hash, moved.hash);
    }
}

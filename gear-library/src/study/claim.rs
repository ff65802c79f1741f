//! A claim: a statement that one rate is greater than another, whose sign a study looks at.

use crate::diagnostic::At;
use crate::fields::{Fields, Problems};
use crate::tree::Node;

use super::event::{self, StudyEvent};
use super::option::{StudyOption, check_known, texts};

/// A statement with a sign.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Id.
    pub id: At<String>,
    /// The statement in words.
    pub says: String,
    /// Who says so.
    pub source: String,
    /// What should happen more often.
    pub event: StudyEvent,
    /// In these options, pooled.
    pub more: Vec<String>,
    /// Than this event; mostly the same one.
    pub less_event: StudyEvent,
    /// In these options, pooled.
    pub less: Vec<String>,
}

/// Reads `[[claim]]`, sorted by id.
pub(super) fn read_all(fields: &Fields<'_>, options: &[StudyOption]) -> Vec<Claim> {
    let mut claims: Vec<Claim> = fields
        .tables("claim")
        .iter()
        .filter_map(|node| read(node, options, fields.problems()))
        .collect();
    claims.sort_by(|one, other| one.id.value.cmp(&other.id.value));
    claims
}

fn read(node: &Node, options: &[StudyOption], problems: &Problems) -> Option<Claim> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write an id such as \"slack-mouth\"");
    let says = fields.need_text("says", "write the statement in words");
    let source = fields.need_text("source", "say who states it");
    let event = event::need(&fields, "event");
    let less_event = event::maybe(&fields, "less_event");
    let more = known(&fields, "more", options);
    let less = known(&fields, "less", options);
    fields.finish();
    let event = event?;
    Some(Claim {
        id: id?,
        says: says?.value,
        source: source?.value,
        less_event: less_event.unwrap_or_else(|| event.clone()),
        event,
        more: more?,
        less: less?,
    })
}

/// Options by id, at least one.
fn known(fields: &Fields<'_>, key: &'static str, options: &[StudyOption]) -> Option<Vec<String>> {
    let named: Vec<At<String>> = texts(fields, key);
    if named.is_empty() {
        fields.missing(key, "name one or more options, such as [\"slack\"]");
        return None;
    }
    named.iter().for_each(|id| check_known(id, options, fields.problems()));
    Some(named.into_iter().map(|id| id.value).collect())
}

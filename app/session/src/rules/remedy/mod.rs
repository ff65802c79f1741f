//! Edits by which an assembly complies with rules, each tried on a copy.
//!
//! ```text
//! rule that fails -> demands of its check -> candidates (edits of the file) -> copy assembled and checked -> proposals
//! ```
//! A candidate that does not meet its rule is no proposal. The other rules that a proposal passes and breaks are found by
//! the same check that a user calls.
//!
//! | module | content |
//! |---|---|
//! | `demand` | the demands of a check, read from its expression |
//! | `propose` | edits that may meet a demand |
//! | `trials` | edits as steps on the file, and copies assembled, checked and measured; the usual weak inserts |

mod demand;
mod propose;
#[cfg(test)]
mod tests;
mod trials;

use endline_gear::{Document, Rule, Sources};
use schemars::JsonSchema;
use serde::Serialize;

use crate::error::Error;
use crate::plugins::PluginHost;

use super::packs::Packs;
use super::sheet::{Fishing, RuleSheet};
use super::verdict::{RuleResult, Verdict};
use propose::Scene;
use trials::{Candidate, CandidateTrials, Tried, size};

pub use trials::{Change, Edited, usual_inserts, usual_inserts_of_own};

/// Name and version of the JSON.
const SCHEMA: &str = "endline.rules.fix/1";

/// Most proposals listed for one rule.
const MOST_PROPOSALS: usize = 6;

/// Edits made one after another to meet every rule.
const MOST_ROUNDS: usize = 16;

/// Edits for one rule among them: edits that undo each other end here.
const MOST_TIMES: usize = 2;

/// Edits by which an assembly would comply.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Remedies {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// Verdicts before any edit, without the rules that do not apply.
    pub before: RuleSheet,
    /// Every rule that the assembly does not pass, with its proposals.
    pub rules: Vec<Remedy>,
    /// One edit after another, each the least one, for the rules that bind; none where no edit helps.
    pub all: Option<Proposal>,
}

/// A rule that an assembly does not pass, and edits that bring it to pass.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Remedy {
    /// Id of the rule.
    pub rule: String,
    /// Whether people are bound to it.
    pub binding: bool,
    /// Its verdict: it fails, or cannot be checked.
    pub verdict: Verdict,
    /// Edits that meet it, the one that changes least first; those that break another rule last.
    pub proposals: Vec<Proposal>,
    /// Why there is no proposal; empty where there is one.
    pub why_none: String,
}

/// An edit that was tried on a copy.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Proposal {
    /// Its effect, in a sentence.
    pub says: String,
    /// Fields that it changes.
    pub changes: Vec<Change>,
    /// Rules that pass with it and did not before.
    pub passes: Vec<String>,
    /// Rules that fail with it and did not before.
    pub breaks: Vec<String>,
    /// Rules that fail before and with it.
    pub still_fails: Vec<String>,
    /// Share of the rope that is replaced or taken off [1].
    pub rope_share: f64,
    /// Number of traps, endlines, floats and reflectors added or removed.
    pub parts: usize,
    /// The assembly's file with the edit.
    #[serde(skip)]
    pub text: String,
}

/// An assembly and its library.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// Id of the assembly.
    pub id: &'a str,
    /// Text of its file.
    pub text: &'a str,
    /// The library.
    pub sources: &'a Sources,
}

impl Remedies {
    /// Every proposal with its rule, in the order in which they are numbered from 1.
    pub fn numbered(&self) -> impl Iterator<Item = (&Remedy, &Proposal)> {
        self.rules.iter().flat_map(|rule| rule.proposals.iter().map(move |edit| (rule, edit)))
    }
}

impl Proposal {
    /// Order of proposals: those that break no rule first, then by the change of the gear.
    fn order(&self, other: &Self) -> std::cmp::Ordering {
        let counts = |one: &Self| (one.breaks.len(), one.parts);
        counts(self)
            .cmp(&counts(other))
            .then(self.rope_share.total_cmp(&other.rope_share))
            .then(self.changes.len().cmp(&other.changes.len()))
    }
}

/// The verdicts on an assembly without an edit.
pub fn checked(
    asked: Asked<'_>,
    packs: &Packs,
    fishing: &Fishing,
    host: &PluginHost,
) -> Result<RuleSheet, Error> {
    let trials = CandidateTrials::new(asked.id, asked.sources, host, packs, fishing);
    Ok(trials.tried(asked.text)?.sheet)
}

/// Edits by which an assembly would comply where and when it is fished.
pub fn remedies(
    asked: Asked<'_>,
    packs: &Packs,
    fishing: &Fishing,
    host: &PluginHost,
) -> Result<Remedies, Error> {
    let trials = CandidateTrials::new(asked.id, asked.sources, host, packs, fishing);
    let base = trials.tried(asked.text)?;
    let mut rules = Vec::new();
    for result in &base.sheet.rules {
        match result.verdict {
            Verdict::Fail => rules.push(of_failing(&trials, &base, asked.text, result)?),
            Verdict::CannotBeChecked => rules.push(Remedy::without(result, result.why.clone())),
            Verdict::Pass | Verdict::NotApplicable => {}
        }
    }
    let all = all(&trials, &base, asked.text)?;
    let mut before = base.sheet;
    before.rules.retain(|rule| rule.verdict != Verdict::NotApplicable);
    Ok(Remedies { schema: SCHEMA, before, rules, all })
}

/// The least edit by fields set and parts added that brings one rule to pass where it applies: one that an option of a study
/// can state. None where the gear passes the rule without an edit.
pub fn least_added(
    asked: Asked<'_>,
    rule: &str,
    packs: &Packs,
    fishing: &Fishing,
    host: &PluginHost,
) -> Result<Option<Proposal>, Error> {
    let trials = CandidateTrials::new(asked.id, asked.sources, host, packs, fishing);
    let base = trials.tried(asked.text)?;
    let result = base.sheet.rules.iter().find(|one| one.rule == rule);
    let result = result.ok_or_else(|| Error::Message(format!("there is no rule `{rule}`")))?;
    let refused = |why: &str| Error::Message(format!("`{rule}` gives no option: {why}"));
    match result.verdict {
        Verdict::Pass => Ok(None),
        Verdict::Fail => {
            let remedy = of_failing(&trials, &base, asked.text, result)?;
            let why = if remedy.why_none.is_empty() {
                "each edit takes something out of the file, which an option cannot; write the edited assembly by `endline rules fix --write` and name it"
            } else {
                &remedy.why_none
            };
            let is_added = |edit: &Proposal| edit.changes.iter().all(|one| one.after.is_some());
            let least = remedy.proposals.iter().find(|edit| is_added(edit));
            least.cloned().map(Some).ok_or_else(|| refused(why))
        }
        Verdict::NotApplicable | Verdict::CannotBeChecked => Err(refused(&result.why)),
    }
}

impl Remedy {
    fn without(result: &RuleResult, why_none: String) -> Self {
        Self {
            rule: result.rule.clone(),
            binding: result.binding,
            verdict: result.verdict,
            proposals: Vec::new(),
            why_none,
        }
    }
}

/// The proposals for a rule that fails.
fn of_failing(
    trials: &CandidateTrials<'_>,
    base: &Tried,
    text: &str,
    result: &RuleResult,
) -> Result<Remedy, Error> {
    let Some((_, rule)) = trials.packs.rules().find(|(_, rule)| rule.id.value == result.rule)
    else {
        return Ok(Remedy::without(result, "no pack has it".to_owned()));
    };
    let document = parsed(text)?;
    let scene = Scene::new(&document, base, trials, rule, result);
    let (mut proposals, mut tried) = (Vec::<Proposal>::new(), 0);
    for lever in propose::levers(&scene) {
        for tier in lever {
            let found: Vec<Proposal> =
                tier.iter().filter_map(|one| verified(trials, base, text, rule, one)).collect();
            tried += tier.len();
            let is_met = !found.is_empty();
            let fresh = found
                .into_iter()
                .filter(|one| proposals.iter().all(|known| known.text != one.text));
            let fresh: Vec<Proposal> = fresh.collect();
            proposals.extend(fresh);
            // A greater edit of the same kind is not asked for where a lesser one serves.
            if is_met {
                break;
            }
        }
    }
    proposals.sort_by(Proposal::order);
    proposals.truncate(MOST_PROPOSALS);
    let why_none = match (proposals.len(), tried) {
        (0, 0) => scene.why_none(),
        (0, 1) => "one edit was tried, and the rule fails with it".to_owned(),
        (0, tried) => format!("{tried} edits were tried, and the rule fails with each"),
        _ => String::new(),
    };
    Ok(Remedy { proposals, ..Remedy::without(result, why_none) })
}

fn parsed(text: &str) -> Result<Document, Error> {
    Document::parse(text).map_err(|error| Error::Message(error.to_string()))
}

/// A candidate tried on a copy: a proposal where its rule passes then.
fn verified(
    trials: &CandidateTrials<'_>,
    base: &Tried,
    text: &str,
    rule: &Rule,
    candidate: &Candidate,
) -> Option<Proposal> {
    let mut document = Document::parse(text).ok()?;
    let changes = candidate.apply(&mut document).ok()?;
    let text = document.text();
    let tried = trials.tried(&text).ok()?;
    let proposal = proposal(base, &tried, candidate.says.clone(), changes, text);
    proposal.passes.contains(&rule.id.value).then_some(proposal)
}

/// The verdicts with an edit, compared with those before.
fn proposal(
    base: &Tried,
    tried: &Tried,
    says: String,
    changes: Vec<Change>,
    text: String,
) -> Proposal {
    let pairs = || base.sheet.rules.iter().zip(&tried.sheet.rules);
    let with = |was: fn(Verdict) -> bool, is: Verdict| {
        let those = pairs().filter(|(before, after)| was(before.verdict) && after.verdict == is);
        those.map(|(_, after)| after.rule.clone()).collect()
    };
    let (rope_share, parts) = size(&base.gear, &tried.gear);
    Proposal {
        says,
        changes,
        passes: with(|was| was != Verdict::Pass, Verdict::Pass),
        breaks: with(|was| was != Verdict::Fail, Verdict::Fail),
        still_fails: with(|was| was == Verdict::Fail, Verdict::Fail),
        rope_share,
        parts,
        text,
    }
}

/// An assembly as edits have made it.
#[derive(Clone, Default)]
struct Made {
    text: String,
    says: Vec<String>,
    changes: Vec<Change>,
}

impl Made {
    /// A field changed twice is one change from its first value.
    fn change(&mut self, change: Change) {
        match self.changes.iter_mut().find(|known| known.field == change.field) {
            Some(known) => known.after = change.after,
            None => self.changes.push(change),
        }
    }
}

/// The least edit for each rule that binds and fails, one after another, up to where the fewest of them fail.
///
/// An edit may break a rule that a later edit meets: more traps ask for a radar reflector.
fn all(trials: &CandidateTrials<'_>, base: &Tried, text: &str) -> Result<Option<Proposal>, Error> {
    let mut now = Made { text: text.to_owned(), ..Made::default() };
    let mut best = (base.sheet.counts.fail_binding, now.clone());
    let mut asked: Vec<String> = Vec::new();
    for _ in 0..MOST_ROUNDS {
        let tried = trials.tried(&now.text)?;
        if tried.sheet.counts.fail_binding < best.0 {
            best = (tried.sheet.counts.fail_binding, now.clone());
        }
        let times = |rule: &str| asked.iter().filter(|one| *one == rule).count();
        let open = |rule: &&RuleResult| {
            rule.binding && rule.verdict == Verdict::Fail && times(&rule.rule) < MOST_TIMES
        };
        // What changes the make of the gear comes before what changes its lines.
        let mut failing: Vec<&RuleResult> = tried.sheet.rules.iter().filter(open).collect();
        failing.sort_by_key(|rule| !rule.measured.iter().all(|one| one.line.is_empty()));
        let Some(result) = failing.first() else { break };
        let remedy = of_failing(trials, &tried, &now.text, result)?;
        asked.push(result.rule.clone());
        if let Some(edit) = remedy.proposals.into_iter().next() {
            now.says.push(edit.says);
            edit.changes.into_iter().for_each(|change| now.change(change));
            now.text = edit.text;
        }
    }
    let Made { text, says, changes } = best.1;
    if says.is_empty() {
        return Ok(None);
    }
    let tried = trials.tried(&text)?;
    Ok(Some(proposal(base, &tried, says.join(" "), changes, text)))
}

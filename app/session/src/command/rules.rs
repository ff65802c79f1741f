//! Commands on the rules for an assembly: edits by which it would comply, a study of options, its compliance sheet.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use super::info::Make;
use super::info::{has_edit_of_all, has_edits, has_verdicts};
use super::{Command, Info};
use crate::workbench::{RuleQuestion, Workbench};

/// An action on rules.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RuleAction {
    /// Ask about another assembly, place, day or way to fish.
    Ask(RuleQuestion),
    /// Make a proposed edit of the assembly checked, by its place among all proposals, from 0.
    Take(usize),
    /// Make all edits by which the assembly meets the rules that bind.
    TakeAll,
    /// Make a study of the assembly edited for each of these rules.
    Compare(Vec<String>),
    /// Write the compliance sheet of the assembly checked.
    Sheet,
}

impl RuleAction {
    /// The identity it is declared by.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Ask(_) => "rules.ask",
            Self::Take(_) => "rules.take",
            Self::TakeAll => "rules.take-all",
            Self::Compare(_) => "rules.compare",
            Self::Sheet => "rules.sheet",
        }
    }
}

/// The actions on rules, declared.
pub static COMMANDS: &[Info] = &[
    Info::new(
        "rules.take-all",
        "Apply all edits that rules require",
        "Edits the assembly checked so that it complies with the rules that bind; one undo takes it back.",
        Make::Plain(|| Command::Rules(RuleAction::TakeAll)),
    )
    .only_if(has_edit_of_all),
    Info::new(
        "rules.take",
        "Take an edit that a rule asks for",
        "Edits the assembly checked so that it complies with the rule; one undo takes it back.",
        Make::Values("its place among the proposals"),
    )
    .only_if(has_edits),
    Info::new(
        "rules.ask",
        "Ask rules about gear",
        "Checks an assembly where, when and how it is fished.",
        Make::Values("assembly, area, day, depth, distance, traps"),
    ),
    Info::new(
        "rules.compare",
        "Compare options of rules",
        "Writes a study to a new file and opens it: the assembly checked, edited for each of the chosen rules, in the same encounters.",
        Make::Values("rules"),
    )
    .only_if(has_verdicts),
    Info::new(
        "rules.sheet",
        "Write the compliance sheet",
        "Writes one page on the assembly checked for a hearing: its shape, rules, strength, hauling and what is not known.",
        Make::Plain(|| Command::Rules(RuleAction::Sheet)),
    )
    .only_if(has_verdicts),
];

/// Dispatches an action.
pub(super) fn perform(workbench: &mut Workbench, action: RuleAction) -> Result<(), String> {
    match action {
        RuleAction::Ask(question) => {
            workbench.rules.question = question;
            Ok(())
        }
        RuleAction::Take(number) => workbench.take_rule_edit(Some(number)),
        RuleAction::TakeAll => workbench.take_rule_edit(None),
        RuleAction::Compare(rules) => workbench.compare_rules(rules),
        RuleAction::Sheet => workbench.write_sheet(),
    }
}

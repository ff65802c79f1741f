//! Commands on the rules for an assembly: edits by which it would comply, a study of options, its compliance sheet.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::{Path, PathBuf};

use strum::{EnumDiscriminants, EnumMessage, IntoStaticStr};

use super::info::{has_verdicts, require};
use super::{Command, FileQuestion, Info, Make};
use crate::compliance::can_print;
use crate::workbench::{RuleQuestion, Workbench};

/// An action on rules.
#[derive(Clone, Debug, PartialEq, Eq, EnumDiscriminants)]
#[strum_discriminants(name(RuleVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "rules.", serialize_all = "kebab-case"))]
pub enum RuleAction {
    /// Checks an assembly where, when and how it is fished.
    #[strum_discriminants(strum(message = "Ask rules about gear"))]
    Ask(RuleQuestion),
    // By its place among all proposals, from 0.
    /// Edits the assembly checked so that it complies with the rule; one undo takes it back.
    #[strum_discriminants(strum(message = "Take an edit that a rule asks for"))]
    Take(usize),
    /// Edits the assembly checked so that it complies with the rules that bind; one undo takes it back.
    #[strum_discriminants(strum(message = "Apply all edits that rules require"))]
    TakeAll,
    /// Writes a study to a new file and opens it: the assembly checked, edited for each of the chosen rules, in the same encounters.
    #[strum_discriminants(strum(message = "Compare options of rules"))]
    Compare(Vec<String>),
    /// Writes one page on the assembly checked for a hearing: its shape, rules, strength, hauling and what is not known.
    #[strum_discriminants(strum(message = "Write the compliance sheet"))]
    Sheet,
    /// Saves the last compliance sheet under a name: as HTML, or printed by an installed browser if the name ends in `.pdf`.
    #[strum_discriminants(strum(message = "Save the compliance sheet as HTML or PDF"))]
    SaveSheet(PathBuf),
}

/// The actions on rules, declared.
pub(super) fn commands() -> Vec<Info> {
    vec![
        Info::plain(RuleAction::TakeAll).only_if(|workbench| {
            has_verdicts(workbench)?;
            let remedies =
                workbench.rules.answer.as_ref().and_then(|answer| answer.remedies.as_ref());
            let any = remedies.is_some_and(|remedies| remedies.all.is_some());
            require(any, "no edit is proposed for a rule that binds")
        }),
        Info::values(RuleVerb::Take, "its place among the proposals").only_if(|workbench| {
            has_verdicts(workbench)?;
            let remedies =
                workbench.rules.answer.as_ref().and_then(|answer| answer.remedies.as_ref());
            let any = remedies.is_some_and(|remedies| remedies.numbered().next().is_some());
            require(any, "no edit is proposed")
        }),
        Info::values(RuleVerb::Ask, "assembly, area, day, depth, distance, traps"),
        Info::values(RuleVerb::Compare, "rules").only_if(has_verdicts),
        Info::plain(RuleAction::Sheet).only_if(has_verdicts),
        Info::of(
            RuleVerb::SaveSheet,
            Make::File {
                question: |workbench| {
                    let page = workbench.rules.page().and_then(Path::file_stem);
                    let stem = page.unwrap_or_default().to_string_lossy();
                    let extension = if can_print() { "pdf" } else { "html" };
                    FileQuestion::write("sheet", &["pdf", "html"], format!("{stem}.{extension}"))
                },
                command: |_, file| Command::Rules(RuleAction::SaveSheet(file)),
            },
        )
        .only_if(|workbench| {
            require(workbench.rules.page().is_some(), "write the compliance sheet first")?;
            require(
                !workbench.sheet_is_outdated(),
                "the gear, its place or the rules have changed since the sheet was written; write it again",
            )
        }),
    ]
}

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
        RuleAction::SaveSheet(file) => workbench.save_sheet(file),
    }
}

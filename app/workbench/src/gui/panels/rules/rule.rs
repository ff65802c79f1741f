//! The selected rule: its requirement and source, the measured values, and edits by which the gear would comply.

use egui::{Frame, Label, RichText, Stroke, Ui};
use endline_session::command::RuleAction;
use endline_session::rules::remedy::{Change, Proposal, Remedies};
use endline_session::rules::{RuleResult, Verdict};
use endline_session::workbench::RuleAnswer;

use super::table::compared;
use super::{colour, on_screen};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::gui::widgets::command;

/// Maximum number of fields shown of an edit.
const MOST_FIELDS: usize = 6;

/// Draws a rule.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, answer: &RuleAnswer, rule: &RuleResult) {
    let palette = Theme::palette_of(ui);
    ui.add(Label::new(RichText::new(&rule.asks).strong()).wrap());
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(rule.verdict.words()).color(colour(rule, palette)));
        ui.label(RichText::new(standing(rule)).color(palette.faint));
    });
    let cited = RichText::new(&rule.cite).color(palette.faint);
    ui.add(Label::new(cited).wrap()).on_hover_text(format!("{}\n{}", rule.rule, rule.source));
    if !rule.why.is_empty() {
        ui.add(Label::new(on_screen(&rule.why)).wrap());
    }
    measured(ui, rule);
    if rule.verdict != Verdict::Pass && rule.verdict != Verdict::NotApplicable {
        edits(ui, shared, answer, rule);
    }
}

/// Id of the rule, whether it is binding, its dates, and the reliability of its wording.
fn standing(rule: &RuleResult) -> String {
    let binds = if rule.binding { "law" } else { "advice, not binding" };
    let from = rule.from.as_ref().map_or(String::new(), |from| format!(", from {from}"));
    let until = rule.until.as_ref().map_or(String::new(), |until| format!(" to {until}"));
    let sure = match rule.confidence {
        "measured" => "checked with the source",
        "derived" => "from a summary",
        _ => "from memory, not verified",
    };
    format!("{}: {binds}{from}{until}; {sure}", rule.rule)
}

fn measured(ui: &mut Ui, rule: &RuleResult) {
    let palette = Theme::palette_of(ui);
    for one in &rule.measured {
        let part = if one.part.is_empty() { String::new() } else { format!("{}: ", one.part) };
        let colour = if one.holds { palette.text } else { colour(rule, palette) };
        let text = format!("{part}{}", compared(&one.says));
        ui.add(Label::new(RichText::new(text).color(colour)).wrap());
    }
}

/// Draws the edits by which the gear complies, or why there is none.
fn edits(ui: &mut Ui, shared: &mut Shared, answer: &RuleAnswer, rule: &RuleResult) {
    let palette = Theme::palette_of(ui);
    widgets::caption(ui, "To comply");
    if !rule.remedy.is_empty() {
        ui.add(Label::new(&rule.remedy).wrap());
    }
    let Some(remedies) = &answer.remedies else {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(RichText::new("trying edits …").color(palette.faint));
        });
        return;
    };
    let Some(remedy) = remedies.rules.iter().find(|one| one.rule == rule.rule) else { return };
    if rule.verdict == Verdict::CannotBeChecked {
        let text = "The missing information cannot be supplied by an edit of the assembly.";
        ui.add(Label::new(RichText::new(text).color(palette.faint)).wrap());
    } else if !remedy.why_none.is_empty() {
        let text = format!("No edit makes the gear comply: {}.", on_screen(&remedy.why_none));
        ui.add(Label::new(RichText::new(text).color(palette.faint)).wrap());
    }
    for proposal in &remedy.proposals {
        if let Some(number) = number(remedies, &remedy.rule, proposal) {
            card(ui, shared, number, proposal);
        }
    }
}

/// Index of a proposal among all.
fn number(remedies: &Remedies, rule: &str, proposal: &Proposal) -> Option<usize> {
    remedies.numbered().position(|(remedy, one)| remedy.rule == rule && one == proposal)
}

/// Draws an edit: its changes, the rules it passes and breaks, and the button that applies it.
fn card(ui: &mut Ui, shared: &mut Shared, number: usize, edit: &Proposal) {
    let palette = Theme::palette_of(ui);
    ui.add_space(4.0);
    let frame =
        Frame::new().stroke(Stroke::new(1.0, palette.line)).corner_radius(4.0).inner_margin(6.0);
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.add(Label::new(&edit.says).wrap()).on_hover_text(fields(edit));
        outcome(ui, edit);
        command(ui, shared, "Apply this edit", RuleAction::Take(number));
    });
}

/// Lists the fields that an edit changes, for the hover text of its sentence.
fn fields(edit: &Proposal) -> String {
    let or_none = |value: &Option<String>| value.clone().unwrap_or_else(|| "none".to_owned());
    let line = |change: &Change| {
        format!("{}: {} to {}", change.field, or_none(&change.before), or_none(&change.after))
    };
    let mut lines: Vec<String> = edit.changes.iter().take(MOST_FIELDS).map(line).collect();
    if edit.changes.len() > MOST_FIELDS {
        lines.push(format!("and {} more fields", edit.changes.len() - MOST_FIELDS));
    }
    lines.join("\n")
}

/// Draws the verdicts of the edited copy.
fn outcome(ui: &mut Ui, edit: &Proposal) {
    let palette = Theme::palette_of(ui);
    let mut say = |text: String, colour| {
        ui.add(Label::new(RichText::new(text).small().color(colour)).wrap());
    };
    say(format!("then passes {}", edit.passes.join(", ")), palette.good);
    if !edit.breaks.is_empty() {
        say(format!("but breaks {}", edit.breaks.join(", ")), palette.error);
    }
    if !edit.still_fails.is_empty() {
        say(format!("still fails {}", edit.still_fails.join(", ")), palette.faint);
    }
    let mut costs = Vec::new();
    if edit.rope_share > 0.0 {
        costs.push(format!("{:.0} % of the rope is replaced", 100.0 * edit.rope_share));
    }
    if edit.parts > 0 {
        costs.push(format!("{} parts are added or removed", edit.parts));
    }
    if !costs.is_empty() {
        say(costs.join(", "), palette.faint);
    }
}

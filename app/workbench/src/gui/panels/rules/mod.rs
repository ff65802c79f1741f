//! Rules of law checked on an assembly: every rule with its verdict, edits by which the assembly would comply, a study of options for
//! rules, and the compliance sheet.

mod asked;
mod rule;
mod table;

use std::path::Path;

use egui::{Color32, Label, RichText, ScrollArea, Ui};
use endline_session::command::RuleAction;
use endline_session::rules::{RuleResult, RuleSheet, Verdict};
use endline_session::workbench::RuleAnswer;

use crate::gui::command::action::WindowAction;
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::{Palette, Theme};
use crate::gui::widgets;
use crate::gui::widgets::command;

/// Least width at which the selected rule is beside the table [points].
const WIDE: f32 = 820.0;

/// Height of the table's head, and of a row with its spacing.
const HEAD_HEIGHT: f32 = 30.0;
const ROW_HEIGHT: f32 = 24.5;

/// The panel of rules.
#[derive(Debug, Default)]
pub struct RulesPanel {
    /// Id of the selected rule; the first of the table if it is not in it.
    pub chosen: Option<String>,
    /// Rules that are compared as options, in order of selection.
    pub compared: Vec<String>,
    /// Whether rules that do not apply are listed too.
    pub all: bool,
    typed: asked::Typed,
}

impl Panel for RulesPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        asked::show(ui, &mut self.typed, shared);
        ui.separator();
        let why = &shared.workbench.rules().why;
        if !why.is_empty() {
            let colour = Theme::palette_of(ui).error;
            ui.add(Label::new(RichText::new(why).color(colour)).wrap());
            return;
        }
        let Some(answer) = shared.workbench.rules().answer.clone() else {
            return widgets::nothing(ui, "Reading the rules …");
        };
        self.head(ui, shared, &answer);
        let rules = listed(&answer, self.all);
        if rules.is_empty() {
            return widgets::nothing(ui, "No rule applies in this area on this date.");
        }
        self.body(ui, shared, &answer, &rules);
    }
}

impl RulesPanel {
    /// Draws the counts of verdicts, and actions for all rules.
    fn head(&mut self, ui: &mut Ui, shared: &mut Shared, answer: &RuleAnswer) {
        let palette = Theme::palette_of(ui);
        let counts = answer.sheet.counts;
        ui.horizontal_wrapped(|ui| {
            let (text, colour) = result(&answer.sheet, palette);
            ui.label(RichText::new(text).strong().color(colour));
            ui.label(format!(
                "{} pass, {} cannot be checked, {} do not apply",
                counts.pass, counts.cannot_be_checked, counts.not_applicable
            ));
            ui.checkbox(&mut self.all, "All").on_hover_text("Also lists rules that do not apply");
            ui.separator();
            command(ui, shared, "Apply all edits", RuleAction::TakeAll);
            self.compare(ui, shared, palette);
            sheet(ui, shared, palette);
            if shared.workbench.rules().busy() {
                ui.spinner();
            }
        });
        for says in &answer.sheet.uncovered {
            ui.add(Label::new(RichText::new(says).color(palette.warning)).wrap());
        }
    }

    /// Draws the button that makes a study of the ticked rules.
    fn compare(&mut self, ui: &mut Ui, shared: &mut Shared, palette: Palette) {
        let ticked = self.compared.len();
        if ticked < 2 {
            let hint = "Tick at least two rules at the left of the table, such as one insert and two inserts. A study then compares gear that complies with each";
            ui.add_enabled(false, egui::Button::new("Compare options …"))
                .on_disabled_hover_text(hint);
            return;
        }
        if shared.workbench.rules().comparing() {
            ui.label(RichText::new("making the study …").color(palette.faint));
            return;
        }
        let text = format!("Compare {ticked} options …");
        command(ui, shared, &text, RuleAction::Compare(self.compared.clone()));
    }

    /// Draws the table, and the selected rule beside or below it.
    fn body(
        &mut self,
        ui: &mut Ui,
        shared: &mut Shared,
        answer: &RuleAnswer,
        rules: &[&RuleResult],
    ) {
        let chosen = self.chosen.as_ref();
        let own = rules.iter().position(|rule| Some(&rule.rule) == chosen).unwrap_or(0);
        let whole = ui.available_rect_before_wrap();
        let (table, detail) = if whole.width() < WIDE {
            #[expect(clippy::cast_precision_loss, reason = "a count of rows")]
            let rows = HEAD_HEIGHT + ROW_HEIGHT * rules.len() as f32;
            let high = rows.min(0.45 * whole.height());
            let (above, below) = whole.split_top_bottom_at_y(whole.top() + high);
            (above, below.with_min_y(below.top() + 6.0))
        } else {
            let (left, right) = whole.split_left_right_at_x(whole.left() + 0.6 * whole.width());
            (left, right.with_min_x(right.left() + 12.0))
        };
        widgets::within(ui, table, |ui| self.table(ui, rules, own));
        widgets::within(ui, detail, |ui| {
            ScrollArea::vertical().id_salt("rule").auto_shrink(false).show(ui, |ui| {
                rule::show(ui, shared, answer, rules[own]);
            });
        });
    }
}

/// The result in a few words, with its colour. It is good only if every binding rule was checked.
fn result(sheet: &RuleSheet, palette: Palette) -> (String, Color32) {
    let counts = sheet.counts;
    let fails = match counts.fail - counts.fail_binding {
        0 => format!("{} fail", counts.fail),
        advice => format!("{} fail, {advice} of them advice", counts.fail),
    };
    match sheet.missing() {
        _ if sheet.fails_binding() => (fails, palette.error),
        Some(missing) if counts.fail == 0 => {
            (format!("No verdict yet: {missing}"), palette.warning)
        }
        Some(missing) => (format!("No verdict yet: {missing}; {fails}"), palette.warning),
        None => (fails, palette.good),
    }
}

/// Draws the buttons that write the compliance sheet and that open the last one, marked if it is outdated.
fn sheet(ui: &mut Ui, shared: &mut Shared, palette: Palette) {
    if shared.workbench.rules().writing() {
        ui.label(RichText::new("simulating the hauling for the sheet …").color(palette.faint));
        return;
    }
    command(ui, shared, "Compliance sheet", RuleAction::Sheet);
    let Some(page) = shared.workbench.rules().page().map(Path::to_owned) else { return };
    let file = page.display();
    let (text, help) = if shared.workbench.sheet_is_outdated() {
        let why = "The gear, its place or the rules have changed since this sheet was written. Click Compliance sheet to update it.";
        (RichText::new("Open the outdated sheet").color(palette.warning), format!("{why}\n{file}"))
    } else {
        (RichText::new("Open it"), file.to_string())
    };
    if ui.button(text).on_hover_text(help).clicked() {
        shared.give(WindowAction::OpenFolder(page));
    }
    if shared.workbench.rules().saving() {
        ui.label(RichText::new("saving the sheet …").color(palette.faint));
        return;
    }
    command(ui, shared, "Save sheet as …", WindowAction::Ask("rules.save-sheet"));
}

/// Rules in the order of the table: failures first, rules that do not apply last or omitted.
fn listed(answer: &RuleAnswer, all: bool) -> Vec<&RuleResult> {
    let mut order = vec![Verdict::Fail, Verdict::CannotBeChecked, Verdict::Pass];
    order.extend(all.then_some(Verdict::NotApplicable));
    let rules = order.into_iter().flat_map(|verdict| answer.sheet.with(verdict));
    // Advice comes after law.
    let (mut binding, advice): (Vec<_>, Vec<_>) =
        rules.partition(|rule| rule.binding || rule.verdict != Verdict::Fail);
    let fails = binding.iter().take_while(|rule| rule.verdict == Verdict::Fail).count();
    binding.splice(fails..fails, advice);
    binding
}

/// A reason with names of fields instead of options of the command line.
fn on_screen(why: &str) -> String {
    why.replace("needs --", "needs the ")
}

/// Colour of a verdict; failed advice is a warning.
fn colour(rule: &RuleResult, palette: Palette) -> Color32 {
    match (rule.verdict, rule.binding) {
        (Verdict::Pass, _) => palette.good,
        (Verdict::Fail, true) => palette.error,
        (Verdict::Fail, false) | (Verdict::CannotBeChecked, _) => palette.warning,
        (Verdict::NotApplicable, _) => palette.faint,
    }
}

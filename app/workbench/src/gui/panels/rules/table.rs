//! The table of rules: tick for comparison, verdict, requirement, measured value.

use egui::{Align, Label, Layout, RichText, Sense, Ui};
use egui_extras::{Column, TableBuilder, TableRow};
use endline_session::rules::{RuleResult, Verdict};

use super::{RulesPanel, colour, on_screen};
use crate::gui::theme::Theme;

const HEADS: [(&str, &str); 4] = [
    ("", "Tick at least two rules to compare them as options of a study"),
    ("Verdict", "Verdict for this gear, area and date"),
    ("Requires", "Requirement of the rule, with the citation on hover"),
    ("Measured", "Measured value and limit, or why there is none"),
];

impl RulesPanel {
    /// Draws the table; a click selects a rule.
    pub(super) fn table(&mut self, ui: &mut Ui, rules: &[&RuleResult], chosen: usize) {
        let measured = (0.27 * ui.available_width()).clamp(130.0, 300.0);
        let table = TableBuilder::new(ui)
            .id_salt("rules")
            .striped(true)
            .resizable(true)
            .sense(Sense::click())
            .cell_layout(Layout::left_to_right(Align::Center))
            .column(Column::exact(24.0))
            .column(Column::initial(112.0).clip(true))
            .column(Column::remainder().at_least(120.0).clip(true))
            .column(Column::initial(measured).at_least(80.0).clip(true));
        table
            .header(20.0, |mut header| {
                for (name, help) in HEADS {
                    header.col(|ui| {
                        let faint = Theme::palette_of(ui).faint;
                        ui.label(RichText::new(name).small().color(faint)).on_hover_text(help);
                    });
                }
            })
            .body(|body| {
                body.rows(21.0, rules.len(), |mut line| {
                    let rule = rules[line.index()];
                    line.set_selected(line.index() == chosen);
                    self.tick(&mut line, rule);
                    cells(&mut line, rule);
                    let cited =
                        format!("{}\n{}, {}\n{}", rule.asks, rule.rule, rule.cite, rule.source);
                    if line.response().on_hover_text(cited).clicked() {
                        self.chosen = Some(rule.rule.clone());
                    }
                });
            });
    }

    /// Whether the rule is one of the options.
    fn tick(&mut self, line: &mut TableRow<'_, '_>, rule: &RuleResult) {
        line.col(|ui| {
            let mut on = self.compared.contains(&rule.rule);
            let response =
                ui.checkbox(&mut on, "").on_hover_text("Compare as an option of a study");
            response.widget_info(|| {
                let label = format!("compare {}", rule.rule);
                egui::WidgetInfo::selected(egui::WidgetType::Checkbox, true, on, label)
            });
            if response.clicked() {
                self.compared.retain(|one| *one != rule.rule);
                self.compared.extend(on.then(|| rule.rule.clone()));
            }
        });
    }
}

fn cells(line: &mut TableRow<'_, '_>, rule: &RuleResult) {
    line.col(|ui| {
        let words = match (rule.verdict, rule.binding) {
            (Verdict::Fail, false) => "fail (advice)",
            (verdict, _) => verdict.words(),
        };
        let colour = colour(rule, Theme::palette_of(ui));
        ui.add(Label::new(RichText::new(words).color(colour)).selectable(false));
    });
    line.col(|ui| drop(ui.add(Label::new(&rule.asks).selectable(false).truncate())));
    line.col(|ui| {
        let palette = Theme::palette_of(ui);
        let text = comparison(rule);
        let colour = if rule.measured.is_empty() { palette.faint } else { palette.text };
        ui.add(Label::new(RichText::new(text).color(colour)).selectable(false).truncate());
    });
}

/// The decisive comparison, or why there is none.
fn comparison(rule: &RuleResult) -> String {
    let wanted = rule.verdict == Verdict::Pass;
    let decides = rule.measured.iter().find(|one| one.holds == wanted).or(rule.measured.first());
    decides.map_or_else(|| on_screen(&rule.why), |one| compared(&one.says))
}

/// A comparison with mathematical signs.
pub(super) fn compared(says: &str) -> String {
    says.replace("<=", "≤").replace(">=", "≥").replace("==", "=")
}

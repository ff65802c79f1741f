//! Each figure that is declared for a panel stands there, with its label and its value.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use endline_session::command::RunAction;
use std::sync::Arc;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use endline_session::figures::compare::groups;
use endline_session::figures::{
    Figure, LINE, LINK, PART, View, WHALE, lines, parts, shares, shown,
};
use endline_session::live::{LiveView, Status};
use endline_workbench::gui::app::App;
use endline_workbench::gui::panel_id::PanelId;
use endline_workbench::gui::widgets::words::capital;

use crate::common::{Folder, flown, wait};

/// Shows one panel alone.
fn only(harness: &mut Harness<'static, App>, panel: PanelId) {
    harness.state_mut().dock = egui_dock::DockState::new(vec![panel.id().to_owned()]);
    harness.run_steps(3);
}

fn view(harness: &Harness<'static, App>) -> Arc<LiveView> {
    harness.state().shared.workbench.view().cloned().unwrap()
}

/// How many figures of a list stand on screen; each that the view shows must.
fn stands<S>(
    harness: &Harness<'static, App>,
    figures: &[Figure<S>],
    source: &S,
    view: View,
) -> usize {
    let units = harness.state().shared.workbench.preferences.units;
    let check = |figure: &Figure<S>| {
        let value = figure.quantity.text(&(figure.read)(source), units);
        for text in [capital(figure.label), value] {
            let found = harness.query_all_by_label(&text).next().is_some();
            assert!(found, "no `{text}` for `{}` in {view:?}", figure.key);
        }
    };
    shown(figures, view).map(check).count()
}

#[test]
fn summary_and_entanglement_have_every_figure_that_is_declared_for_them() {
    let folder = Folder::new("figures");
    let mut harness = flown(&folder);
    let shown = view(&harness);
    let summary = shown.summary.as_ref().unwrap();
    let whale = summary.whale.as_ref().unwrap();
    let parts = parts(whale, &shown.frame.contacts);

    only(&mut harness, PanelId::SUMMARY);
    let mut count = stands(&harness, WHALE, whale, View::Summary);
    parts.iter().for_each(|part| count += stands(&harness, PART, part, View::Summary));
    let lines = lines(summary, &[]);
    lines.iter().for_each(|line| count += stands(&harness, LINE, line, View::Summary));
    summary.links.iter().for_each(|link| count += stands(&harness, LINK, link, View::Summary));
    assert!(count > 40, "{count} figures");

    only(&mut harness, PanelId::ENTANGLEMENT);
    let mut count = stands(&harness, WHALE, whale, View::Entanglement);
    parts.iter().for_each(|part| count += stands(&harness, PART, part, View::Entanglement));
    assert!(count > 50, "{count} figures");
}

#[test]
fn the_run_panel_tells_what_the_computing_time_goes_to() {
    let folder = Folder::new("figures-cost");
    let mut harness = flown(&folder);
    only(&mut harness, PanelId::RUN);
    let shown = view(&harness);
    let (greatest, share) = shares(&shown.cost)[0];
    let told = format!("Time goes to {} {:.0} %", greatest.label, 100.0 * share);
    harness.get_by_label_contains(&told);
}

#[test]
fn the_comparison_has_every_figure_that_is_declared_for_it() {
    let folder = Folder::new("figures-compared");
    let mut harness = flown(&folder);
    harness.state_mut().shared.give(RunAction::Hold);
    harness.run_steps(2);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.state_mut().shared.perform(RunAction::Start);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Finished));
    only(&mut harness, PanelId::COMPARE);
    let (a, b) = (view(&harness), harness.state().shared.workbench.compared_view().unwrap());
    let all = groups(&a, &b, harness.state().shared.workbench.preferences.units);
    let whale = &all.iter().find(|(head, _)| *head == "Whale").unwrap().1;
    assert_eq!(whale.len(), shown(WHALE, View::Compare).count());
    let lines = &all.iter().find(|(head, _)| *head == "Lines").unwrap().1;
    assert_eq!(lines.len(), shown(LINE, View::Compare).count() * a.model.spec.lines.len());
    for row in all.iter().flat_map(|(_, rows)| rows) {
        for text in [capital(&row.name), row.a.clone(), row.b.clone()] {
            assert!(harness.query_all_by_label(&text).next().is_some(), "no `{text}` of {row:?}");
        }
    }
}

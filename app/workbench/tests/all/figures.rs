//! Each figure that is declared for a panel stands there, with its label and its value.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use endline_session::command::{RunAction, TimeAction};
use endline_session::edit::Documents;
use std::slice::from_ref;
use std::sync::Arc;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use endline_session::figures::compare::groups;
use endline_session::figures::{
    Figure, LINE, LINK, PART, View, WHALE, lines, parts, shares, shown,
};
use endline_session::live::{Engine, Launch, LiveView, RunCommand, Status};
use endline_workbench::gui::app::App;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::widgets::words::capital;
use endline_workbench::input::Pilot;

use crate::common::{Folder, flown, give, only, opened, wait};

fn view(harness: &Harness<'static, App>) -> Arc<LiveView> {
    harness.state().shared.workbench.view().cloned().unwrap()
}

/// How many figures of these sources stand on screen; each that the view shows must, but for those that say nothing of any, which must not.
fn stands<S>(
    harness: &Harness<'static, App>,
    figures: &[Figure<S>],
    sources: &[S],
    view: View,
) -> usize {
    let units = harness.state().shared.workbench.preferences.units;
    let check = |figure: &Figure<S>, source: &S| {
        let value = figure.quantity.text(&(figure.read)(source), units);
        for text in [capital(figure.label), value] {
            let found = harness.query_all_by_label(&text).next().is_some();
            assert!(found, "no `{text}` for `{}` in {view:?}", figure.key);
        }
    };
    let mut count = 0;
    for figure in shown(figures, view) {
        let told: Vec<&S> = sources.iter().filter(|source| figure.is_told(source)).collect();
        told.iter().for_each(|source| check(figure, source));
        count += told.len();
        let label = capital(figure.label);
        assert!(!told.is_empty() || harness.query_by_label(&label).is_none(), "{}", figure.key);
    }
    count
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
    let lines = lines(summary, &[]);
    let count = stands(&harness, WHALE, from_ref(whale), View::Summary)
        + stands(&harness, PART, &parts, View::Summary)
        + stands(&harness, LINE, &lines, View::Summary)
        + stands(&harness, LINK, &summary.links, View::Summary);
    assert!(count > 40, "{count} figures");

    only(&mut harness, PanelId::ENTANGLEMENT);
    let count = stands(&harness, WHALE, from_ref(whale), View::Entanglement)
        + stands(&harness, PART, &parts, View::Entanglement);
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

/// An engine that shows one view, whatever it is told.
struct Still(Arc<LiveView>);

impl Engine for Still {
    fn send(&self, _command: RunCommand) -> bool {
        true
    }

    fn latest(&self) -> Arc<LiveView> {
        Arc::clone(&self.0)
    }
}

#[test]
fn the_run_panel_tells_why_a_run_is_not_valid_and_that_resolution_was_not_kept() {
    let folder = Folder::new("figures-valid");
    let launch: Launch = Box::new(|prepared, _host, _waker| {
        let mut view = LiveView { status: Status::Finished, ..LiveView::before(&prepared) };
        let audit = &mut view.audit;
        (audit.solver_steps, audit.touching_steps, audit.unconverged) = (2000, 1000, 300);
        (audit.resolution_looks, audit.resolution_missed, audit.resolution_ratio) = (200, 50, 4.0);
        let engine: Box<dyn Engine> = Box::new(Still(Arc::new(view)));
        Ok(engine)
    });
    let mut harness = opened(folder.documents(), launch, Pilot::default());
    only(&mut harness, PanelId::RUN);
    harness.get_by_label_contains("Not valid: 30 % of the solver steps in touch did not converge");
    harness.get_by_label_contains("Resolution near the whale not kept for 25 % of the time");
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

#[test]
fn the_map_of_the_skin_has_a_scale_of_its_own_and_says_which_moment_it_shows() {
    let folder = Folder::new("figures-map");
    let mut harness = flown(&folder);
    only(&mut harness, PanelId::ENTANGLEMENT);
    harness.get_by_label("At 2.00 s");
    // The top stands where a run with a hundredth of a turn does not move it.
    harness.get_by_label("1.00 turns");
    give(&mut harness, TimeAction::Seek(1.0));
    wait(&mut harness, |app| app.shared.workbench.view().is_some_and(|view| view.sought));
    harness.run_steps(2);
    let shown = format!("At {:.2} s", view(&harness).frame.time_s);
    assert_ne!(shown, "At 2.00 s");
    harness.get_by_label(&shown);
    harness.get_by_label("Most until 2.00 s");
}

#[test]
fn a_whale_that_no_gear_holds_is_told_with_its_tensions_and_let_feel_it_by_a_click() {
    let folder = Folder::new("figures-steered");
    let mut harness = flown(&folder);
    let warning = "This whale does not feel the gear";
    let feels = |harness: &Harness<'static, App>| {
        let documents = &harness.state().shared.workbench.project.documents;
        documents.field(Documents::SCENARIO, "whale.dynamics")
    };
    for panel in [PanelId::SUMMARY, PanelId::TENSION] {
        only(&mut harness, panel);
        harness.get_by_label_contains(warning);
    }
    assert_eq!(feels(&harness), None);
    harness.get_by_label("Let it feel gear").click();
    harness.run_steps(3);
    assert_eq!(feels(&harness).as_deref(), Some("kinetic"));
    harness.state_mut().shared.perform(RunAction::Start);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| {
            view.model.spec.whale.as_ref().is_some_and(|whale| whale.kinetic.is_some())
                && view.summary.is_some()
        })
    });
    harness.run_steps(2);
    assert!(harness.query_by_label_contains(warning).is_none(), "this run's whale is held");
}

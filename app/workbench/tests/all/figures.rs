//! Every figure that is declared for a panel is on screen, with its label and value.

use endline_session::command::{RunAction, TimeAction};
use endline_session::edit::Documents;
use std::slice::from_ref;
use std::sync::Arc;

use egui_kittest::kittest::Queryable;
use endline_session::figures::compare::groups;
use endline_session::figures::{
    Figure, LINE, LINK, PART, View, WHALE, lines, parts, shares, shown,
};
use endline_session::live::{Engine, Launch, LiveView, RunCommand, Status};
use endline_sim::State;
use endline_sim::metrics::Metrics;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::widgets::words::capital;
use endline_workbench::input::Pilot;

use crate::common::{Folder, Reach as _, Window, flown, flown_from, give, only, opened, wait};

/// Checks that the figures of a view are on screen, and that figures without a value are not; returns their number.
fn count_figures<S>(harness: &Window, figures: &[Figure<S>], sources: &[S], view: View) -> usize {
    let units = harness.workbench().preferences().units;
    let check = |figure: &Figure<S>, source: &S| {
        let value = figure.quantity.text(&(figure.read)(source), units);
        for text in [capital(figure.label), value] {
            let found = harness.query_all_by_label(&text).next().is_some();
            assert!(found, "no `{text}` for `{}` in {view:?}", figure.key);
        }
    };
    let mut count = 0;
    for figure in shown(figures, view) {
        let present: Vec<&S> = sources.iter().filter(|source| figure.is_shown(source)).collect();
        present.iter().for_each(|source| check(figure, source));
        count += present.len();
        let label = capital(figure.label);
        assert!(!present.is_empty() || harness.query_by_label(&label).is_none(), "{}", figure.key);
    }
    count
}

#[test]
fn summary_and_entanglement_show_every_figure_that_is_declared_for_them() {
    let folder = Folder::new("figures");
    let mut harness = flown(&folder);
    let shown = harness.view();
    let summary = shown.summary.as_ref().unwrap();
    let whale = summary.whale.as_ref().unwrap();
    let parts = parts(whale, &shown.frame.contacts);

    only(&mut harness, PanelId::Summary);
    let lines = lines(summary, &[]);
    let count = count_figures(&harness, WHALE, from_ref(whale), View::Summary)
        + count_figures(&harness, PART, &parts, View::Summary)
        + count_figures(&harness, LINE, &lines, View::Summary)
        + count_figures(&harness, LINK, &summary.links, View::Summary);
    assert!(count > 40, "{count} figures");

    only(&mut harness, PanelId::Entanglement);
    let red = harness.query_by_label("Entangled").is_some();
    assert!(whale.decided || !red, "an outcome that is not decided is not stated");
    let count = count_figures(&harness, WHALE, from_ref(whale), View::Entanglement)
        + count_figures(&harness, PART, &parts, View::Entanglement);
    assert!(count > 50, "{count} figures");
}

#[test]
fn the_run_panel_shows_the_largest_share_of_computing_time() {
    let folder = Folder::new("figures-cost");
    let mut harness = flown(&folder);
    only(&mut harness, PanelId::Run);
    let shown = harness.view();
    let (greatest, share) = shares(&shown.cost)[0];
    let text = format!("Computing time: {} {:.0} %", greatest.label, 100.0 * share);
    harness.get_by_label_contains(&text);
}

/// An engine that always shows the same view.
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
fn the_run_panel_reports_an_invalid_run_and_insufficient_resolution() {
    let folder = Folder::new("figures-valid");
    let launch: Launch = Box::new(|prepared, _host, _waker| {
        let mut view = LiveView { status: Status::Finished, ..LiveView::before(&prepared) };
        let model = Arc::clone(&view.model);
        view.summary = Some(Metrics::new(&model).summary(&model, &State::start(&model)));
        let audit = &mut view.audit;
        (audit.solver_steps, audit.touching_steps, audit.unconverged) = (2000, 1000, 300);
        (audit.resolution_looks, audit.resolution_missed, audit.resolution_ratio) = (200, 50, 4.0);
        let engine: Box<dyn Engine> = Box::new(Still(Arc::new(view)));
        Ok(engine)
    });
    let mut harness = opened(folder.documents(), launch, Pilot::default());
    only(&mut harness, PanelId::Run);
    harness.get_by_label_contains(
        "Do not use these numbers: 30 % of the solver steps in touch did not converge",
    );
    harness.get_by_label_contains("longer than requested in 25 % of the checks, at most 4.0 times");
}

#[test]
fn the_comparison_shows_every_figure_that_is_declared_for_it() {
    let folder = Folder::new("figures-compared");
    let mut harness = flown(&folder);
    harness.state_mut().shared.give(RunAction::Hold);
    harness.run_steps(2);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.perform(RunAction::Start);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Finished));
    only(&mut harness, PanelId::Compare);
    let (a, b) = (harness.view(), harness.workbench().compared_view().unwrap());
    let all = groups(&a, &b, harness.workbench().preferences().units);
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
fn the_map_of_the_skin_has_its_own_scale_and_names_its_moment() {
    let folder = Folder::new("figures-map");
    let mut harness = flown(&folder);
    only(&mut harness, PanelId::Entanglement);
    harness.get_by_label("At 2.00 s");
    // The top of the scale is at least one turn, so that small wraps do not move it.
    harness.get_by_label("1.00 turns");
    give(&mut harness, TimeAction::Seek(1.0));
    wait(&mut harness, |app| app.shared.workbench.view().is_some_and(|view| view.sought));
    harness.run_steps(2);
    let shown = format!("At {:.2} s", harness.view().frame.time_s);
    assert_ne!(shown, "At 2.00 s");
    harness.get_by_label(&shown);
    harness.get_by_label("Most until 2.00 s");
}

#[test]
fn a_kinematic_whale_is_reported_with_its_tensions_and_made_kinetic_by_a_click() {
    let folder = Folder::new("figures-steered");
    let mut harness = flown(&folder);
    let warning = "The gear does not act on this whale";
    let dynamics = |harness: &Window| {
        let documents = harness.documents();
        documents.field(Documents::SCENARIO, "whale.dynamics")
    };
    for panel in [PanelId::Summary, PanelId::Tension] {
        only(&mut harness, panel);
        harness.get_by_label_contains(warning);
    }
    assert_eq!(dynamics(&harness), None);
    harness.get_by_label("Let gear act on it").click();
    harness.run_steps(3);
    assert_eq!(dynamics(&harness).as_deref(), Some("kinetic"));
    harness.perform(RunAction::Start);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| {
            view.model.spec.whale.as_ref().is_some_and(|whale| whale.kinetic.is_some())
                && view.summary.is_some()
        })
    });
    harness.run_steps(2);
    assert!(harness.query_by_label_contains(warning).is_none(), "the whale of this run is kinetic");
}

#[test]
fn a_run_with_too_long_segments_offers_more_nodes() {
    let folder = Folder::new("figures-coarse");
    let mut harness = flown_from(&folder, "-4 m");
    only(&mut harness, PanelId::Summary);
    harness.get_by_label_contains("Rope segments near the whale were longer than requested");
    harness.get_by_label("Use 240 rope nodes").click();
    harness.run_steps(3);
    let nodes = harness.documents().field(Documents::SCENARIO, "rope_nodes");
    assert_eq!(nodes.as_deref(), Some("240"));
}

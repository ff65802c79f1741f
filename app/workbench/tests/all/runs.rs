//! Inputs of runs edited and rerun, the pilot program on its timeline, and runs compared.

use endline_session::command::{EditAction, RunAction, TimeAction};
use endline_workbench::gui::command::action::PanelAction;
use std::sync::Arc;

use egui_kittest::kittest::Queryable;
use endline_session::edit::Documents;
use endline_session::edit::pilot_program::entries;
use endline_session::export::chart::{Chart, Kind, Style};
use endline_session::figures::compare::groups;
use endline_session::live::{LiveView, Status};
use endline_session::units::Units;
use endline_workbench::gui::panel::PanelId;

use crate::common::{Folder, Reach as _, Window, drag, flown, give, only, wait};

/// Seeks a moment and waits until it is shown.
fn seek(harness: &mut Window, time_s: f64) -> Arc<LiveView> {
    harness.perform(TimeAction::Seek(time_s));
    wait(harness, |app| app.shared.workbench.view().is_some_and(|view| view.sought));
    harness.view()
}

/// Whether rope and whale have identical positions, to the bit.
fn same(one: &LiveView, other: &LiveView) -> bool {
    one.frame.nodes == other.frame.nodes && one.frame.whale == other.frame.whale
}

/// Reruns from the moment shown to the end.
fn rerun(harness: &mut Window) -> Arc<LiveView> {
    let before = harness.view();
    harness.perform(RunAction::Rerun);
    wait(harness, |app| {
        app.shared.workbench.view().is_some_and(|view| {
            !Arc::ptr_eq(&view.model, &before.model) && view.status == Status::Finished
        })
    });
    harness.view()
}

#[test]
fn the_inputs_of_a_run_become_a_program_that_is_edited_and_rerun_from_a_moment() {
    let folder = Folder::new("edit-inputs");
    let mut harness = flown(&folder);
    let (end, middle) = (harness.view(), seek(&mut harness, 1.0));
    only(&mut harness, PanelId::Pilot);
    harness.get_by_label("Edit inputs of this run").click();
    wait(&mut harness, |app| {
        app.shared
            .workbench
            .project()
            .documents
            .text(Documents::SCENARIO)
            .is_some_and(|text| text.contains("# Flown"))
    });
    let program = entries(harness.documents());
    assert!(!program.is_empty() && program[0].begin_s == Some(0.0), "{program:?}");
    assert!(!harness.documents().any_error(), "{:?}", harness.documents().problems());

    harness.get_by_label_contains("Rerun from").click();
    harness.run_steps(2);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| {
            !Arc::ptr_eq(&view.model, &end.model) && view.status == Status::Finished
        })
    });
    let again = harness.view();
    assert!(same(&again, &end), "the program reproduces the run to the bit");

    seek(&mut harness, 1.0);
    give(&mut harness, EditAction::AddEntry);
    let added = harness.state().panels.program.chosen.unwrap();
    let program = entries(harness.documents());
    assert!((program[added].begin_s.unwrap() - middle.frame.time_s).abs() < 1e-3, "{program:?}");
    let other = rerun(&mut harness);
    assert!(!same(&other, &end), "the edit changes what follows");
    let before = seek(&mut harness, 1.0);
    assert!(same(&before, &middle), "nothing before the edit has changed");
    give(&mut harness, PanelAction::DeleteEntry);
    assert_eq!(entries(harness.documents()).len(), program.len() - 1);
}

#[test]
fn the_inputs_of_a_recording_become_a_separate_scenario() {
    let folder = Folder::new("edit-recording");
    let mut harness = flown(&folder);
    let end = harness.view();
    give(&mut harness, RunAction::Reset);
    let kept = folder.0.join("recordings/hello-endline 0001.endline");
    wait(&mut harness, |_| kept.exists());
    let documents = |harness: &Window| {
        let documents = harness.documents();
        (
            documents.scenario_path().to_owned(),
            documents.text(Documents::SCENARIO).unwrap().to_owned(),
        )
    };
    give(&mut harness, EditAction::Save);
    let (open, text) = documents(&harness);
    let on_disk = std::fs::read_to_string(&open).unwrap();

    harness.perform(RunAction::OpenRecording(kept));
    wait(&mut harness, |app| {
        let view = app.shared.workbench.view().unwrap();
        !Arc::ptr_eq(&view.model, &end.model)
            && view.frame.step == end.frame.step
            && view.status != Status::Running
    });
    give(&mut harness, EditAction::EditInputs);
    wait(&mut harness, |app| app.shared.workbench.project().documents.scenario_path() != open);
    let (copy, program) = documents(&harness);
    assert!(program.contains("# Flown") && !copy.exists(), "{}", copy.display());
    give(&mut harness, EditAction::Save);
    assert_eq!(std::fs::read_to_string(&copy).unwrap(), program);
    assert_eq!(
        std::fs::read_to_string(&open).unwrap(),
        on_disk,
        "the file of the open scenario is unchanged"
    );
    give(&mut harness, EditAction::Undo);
    assert_eq!(documents(&harness).1, text, "one undo restores its text");
}

#[test]
fn a_bar_of_the_timeline_is_dragged_and_each_drag_is_one_undo() {
    let folder = Folder::new("timeline");
    let mut harness = flown(&folder);
    harness.set(Documents::SCENARIO, "duration", "20 s");
    only(&mut harness, PanelId::Pilot);
    seek(&mut harness, 1.0);
    harness.get_by_label("Add entry").click();
    harness.run_steps(3);
    let text = harness.documents().text(Documents::SCENARIO).unwrap().to_owned();
    let chosen = harness.state().panels.program.chosen.unwrap();
    let rect = harness.get_by_label("Timeline").rect();
    // Names are to the left of the tracks. Speed is the first track, yaw, the track of the new entry, the second.
    let (left, width) = (rect.left() + 92.0, rect.width() - 100.0);
    let x = |time_s: f32| left + width * time_s / 20.0;
    let y = rect.top() + 20.0 + 24.0 * 1.5;
    drag(&mut harness, egui::pos2(x(1.5), y), egui::pos2(x(6.5), y));
    let moved = &entries(harness.documents())[harness.state().panels.program.chosen.unwrap()];
    assert!((moved.begin_s.unwrap() - 6.0).abs() < 0.11, "moved by five seconds: {moved:?}");
    assert_eq!(moved.hold_s, Some(2.0));
    drag(&mut harness, egui::pos2(x(8.0) - 2.0, y), egui::pos2(x(10.0) - 2.0, y));
    let held = &entries(harness.documents())[harness.state().panels.program.chosen.unwrap()];
    assert!((held.hold_s.unwrap() - 4.0).abs() < 0.21, "two seconds longer: {held:?}");
    for _ in 0..2 {
        harness.perform(EditAction::Undo);
    }
    assert_eq!(harness.documents().text(Documents::SCENARIO), Some(text.as_str()));
    assert_eq!(entries(harness.documents())[chosen].hold_s, Some(2.0));
}

#[test]
fn a_run_compared_with_itself_has_no_differences_and_with_another_has_some() {
    let folder = Folder::new("compare");
    let mut harness = flown(&folder);
    let first = harness.view();
    harness.state_mut().shared.give(RunAction::Hold);
    harness.run_steps(2);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.perform(RunAction::Speed(f64::INFINITY));
    harness.perform(RunAction::Start);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Finished));
    let (a, b) = (harness.view(), harness.workbench().compared_view().unwrap());
    assert!(
        Arc::ptr_eq(&b.model, &first.model) && !Arc::ptr_eq(&a.model, &b.model),
        "B is the held run, A a new one"
    );
    let all = groups(&a, &b, Units::Si);
    let rows: Vec<_> = all.iter().flat_map(|(_, rows)| rows).collect();
    assert!(
        rows.len() > 8
            && rows.iter().all(|row| row.difference == "same" || row.difference.is_empty()),
        "{rows:?}"
    );

    check_identical_plots(&a, &b);
    seek(&mut harness, 1.0);
    let at_s = harness.view().frame.time_s;
    wait(&mut harness, |app| {
        app.shared
            .workbench
            .compared_view()
            .is_some_and(|other| (other.frame.time_s - at_s).abs() < 1e-9)
    });
    only(&mut harness, PanelId::View);
    assert!(harness.query_by_label("Pane 1 of B").is_some(), "both runs are drawn");

    harness.set(Documents::SCENARIO, "whale.depth", "9 m");
    harness.perform(RunAction::Start);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| {
            !Arc::ptr_eq(&view.model, &a.model) && view.status == Status::Finished
        })
    });
    let (a, b) = (harness.view(), harness.workbench().compared_view().unwrap());
    let all = groups(&a, &b, Units::Si);
    assert!(
        all.iter().flat_map(|(_, rows)| rows).any(|row| row.difference.contains('%')),
        "{all:?}"
    );
    only(&mut harness, PanelId::Compare);
    assert!(harness.query_all_by_label("A − B").next().is_some(), "the table is on screen");
    harness.get_by_label("End comparison").click();
    harness.run_steps(3);
    assert!(harness.workbench().comparison().is_none());
}

#[test]
fn a_recording_compared_with_the_run_shown_follows_its_time() {
    let folder = Folder::new("compare-kept");
    let mut harness = flown(&folder);
    let kept = folder.0.join("recordings/hello-endline 0001.endline");
    wait(&mut harness, |_| kept.exists());
    harness.state_mut().shared.give(RunAction::CompareWith(kept));
    harness.run_steps(2);
    let end = harness.view();
    wait(&mut harness, |app| {
        app.shared.workbench.compared_view().is_some_and(|other| other.frame.step == end.frame.step)
    });
    assert_eq!(
        harness.workbench().compared_view().unwrap().state_hash,
        end.state_hash,
        "replayed to the bit"
    );
    let middle = seek(&mut harness, 0.5);
    wait(&mut harness, |app| {
        app.shared
            .workbench
            .compared_view()
            .is_some_and(|other| other.frame.step == middle.frame.step)
    });
    assert_eq!(harness.workbench().compared_view().unwrap().frame.nodes, middle.frame.nodes);
}

/// Compares the plots of identical runs: dashed curves equal solid ones. The greatest tension along a line is its peak.
fn check_identical_plots(a: &LiveView, b: &LiveView) {
    let both =
        Chart::of(Kind::Tension, a, Units::Si).beside(Chart::of(Kind::Tension, b, Units::Si));
    let of = |style: Style| both.curves.iter().filter(move |curve| curve.style == style);
    assert!(of(Style::Solid).count() > 1 && of(Style::Solid).count() == of(Style::Dashed).count());
    for (solid, dashed) in of(Style::Solid).zip(of(Style::Dashed)) {
        assert_eq!(
            (format!("{} (B)", solid.name), &solid.points),
            (dashed.name.clone(), &dashed.points)
        );
        assert_eq!(solid.colour, dashed.colour);
    }
    let along = Chart::of(Kind::Along, a, Units::Si);
    for line in &a.summary.as_ref().unwrap().lines {
        let greatest = along
            .curves
            .iter()
            .find(|curve| curve.name == format!("{}, greatest so far", line.id))
            .unwrap();
        let top = greatest.points.iter().map(|[_, y]| *y).fold(0.0, f64::max);
        assert!(
            (top - line.peak_tension_n).abs() < 1e-6 * line.peak_tension_n.max(1.0),
            "{}: {top} N, {} N",
            line.id,
            line.peak_tension_n
        );
    }
}

//! Runs edited, run again and compared, in a window without a display.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use endline_session::command::{EditAction, RunAction, TimeAction};
use endline_workbench::gui::command::action::PanelAction;
use std::sync::Arc;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use endline_session::edit::Documents;
use endline_session::edit::pilot_program::entries;
use endline_session::export::chart::{Chart, Kind, Style};
use endline_session::figures::compare::groups;
use endline_session::live::{LiveView, Status};
use endline_session::units::Units;
use endline_workbench::gui::app::App;
use endline_workbench::gui::panel::PanelId;

use crate::common::{Folder, drag, flown, give, only, wait};

fn view(harness: &Harness<'static, App>) -> Arc<LiveView> {
    harness.state().shared.workbench.view().cloned().unwrap()
}

/// Looks at a moment and waits until it is shown.
fn seek(harness: &mut Harness<'static, App>, time_s: f64) -> Arc<LiveView> {
    harness.state_mut().shared.perform(TimeAction::Seek(time_s));
    wait(harness, |app| app.shared.workbench.view().is_some_and(|view| view.sought));
    view(harness)
}

/// Whether rope and whale are at the same places, to the bit.
fn same(one: &LiveView, other: &LiveView) -> bool {
    one.frame.nodes == other.frame.nodes && one.frame.whale == other.frame.whale
}

/// Runs again from the moment shown, to the end.
fn rerun(harness: &mut Harness<'static, App>) -> Arc<LiveView> {
    let before = view(harness);
    harness.state_mut().shared.perform(RunAction::Rerun);
    wait(harness, |app| {
        app.shared.workbench.view().is_some_and(|view| {
            !Arc::ptr_eq(&view.model, &before.model) && view.status == Status::Finished
        })
    });
    view(harness)
}

#[test]
fn the_inputs_of_a_run_are_edited_as_a_program_and_rerun_from_a_moment() {
    let folder = Folder::new("edit-inputs");
    let mut harness = flown(&folder);
    let (end, middle) = (view(&harness), seek(&mut harness, 1.0));
    only(&mut harness, PanelId::PROGRAM);
    harness.get_by_label("Edit inputs of this run").click();
    wait(&mut harness, |app| {
        app.shared
            .workbench
            .project
            .documents
            .text(Documents::SCENARIO)
            .is_some_and(|text| text.contains("# Flown"))
    });
    let program = entries(&harness.state().shared.workbench.project.documents);
    assert!(!program.is_empty() && program[0].begin_s == Some(0.0), "{program:?}");
    assert!(
        !harness.state().shared.workbench.project.documents.any_error(),
        "{:?}",
        harness.state().shared.workbench.project.documents.problems()
    );

    harness.get_by_label_contains("Rerun from").click();
    harness.run_steps(2);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| {
            !Arc::ptr_eq(&view.model, &end.model) && view.status == Status::Finished
        })
    });
    let again = view(&harness);
    assert!(
        same(&again, &end),
        "the program is the run: rope and whale where they were, to the bit"
    );

    seek(&mut harness, 1.0);
    give(&mut harness, EditAction::AddEntry);
    let added = harness.state().panels.program.chosen.unwrap();
    let program = entries(&harness.state().shared.workbench.project.documents);
    assert!((program[added].begin_s.unwrap() - middle.frame.time_s).abs() < 1e-3, "{program:?}");
    let other = rerun(&mut harness);
    assert!(!same(&other, &end), "from there on the edited program steers");
    let before = seek(&mut harness, 1.0);
    assert!(same(&before, &middle), "up to there nothing has changed");
    give(&mut harness, PanelAction::DeleteEntry);
    assert_eq!(
        entries(&harness.state().shared.workbench.project.documents).len(),
        program.len() - 1
    );
}

#[test]
fn the_inputs_of_a_recording_become_a_scenario_of_their_own() {
    let folder = Folder::new("edit-recording");
    let mut harness = flown(&folder);
    let end = view(&harness);
    give(&mut harness, RunAction::Reset);
    let kept = folder.0.join("recordings/hello-endline 0001.endline");
    wait(&mut harness, |_| kept.exists());
    let documents = |harness: &Harness<'static, App>| {
        let documents = &harness.state().shared.workbench.project.documents;
        (
            documents.scenario_path().to_owned(),
            documents.text(Documents::SCENARIO).unwrap().to_owned(),
        )
    };
    give(&mut harness, EditAction::Save);
    let (open, text) = documents(&harness);
    let on_disk = std::fs::read_to_string(&open).unwrap();

    harness.state_mut().shared.perform(RunAction::OpenRecording(kept));
    wait(&mut harness, |app| {
        let view = app.shared.workbench.view().unwrap();
        !Arc::ptr_eq(&view.model, &end.model)
            && view.frame.step == end.frame.step
            && view.status != Status::Running
    });
    give(&mut harness, EditAction::EditInputs);
    wait(&mut harness, |app| app.shared.workbench.project.documents.scenario_path() != open);
    let (copy, program) = documents(&harness);
    assert!(program.contains("# Flown") && !copy.exists(), "{}", copy.display());
    give(&mut harness, EditAction::Save);
    assert_eq!(std::fs::read_to_string(&copy).unwrap(), program);
    assert_eq!(std::fs::read_to_string(&open).unwrap(), on_disk, "the open scenario's file stays");
    give(&mut harness, EditAction::Undo);
    assert_eq!(documents(&harness).1, text, "its text is one undo away");
}

#[test]
fn a_bar_of_the_timeline_is_dragged_and_one_undo_takes_it_back() {
    let folder = Folder::new("timeline");
    let mut harness = flown(&folder);
    harness.state_mut().shared.workbench.set(Documents::SCENARIO, "duration", "20 s");
    only(&mut harness, PanelId::PROGRAM);
    seek(&mut harness, 1.0);
    harness.get_by_label("Add entry").click();
    harness.run_steps(3);
    let text = harness
        .state()
        .shared
        .workbench
        .project
        .documents
        .text(Documents::SCENARIO)
        .unwrap()
        .to_owned();
    let chosen = harness.state().panels.program.chosen.unwrap();
    let rect = harness.get_by_label("Timeline").rect();
    // Names stand to the left of the tracks; speed is the first track, yaw, which the new entry tells, the second.
    let (left, width) = (rect.left() + 92.0, rect.width() - 100.0);
    let x = |time_s: f32| left + width * time_s / 20.0;
    let y = rect.top() + 20.0 + 24.0 * 1.5;
    drag(&mut harness, egui::pos2(x(1.5), y), egui::pos2(x(6.5), y));
    let moved = &entries(&harness.state().shared.workbench.project.documents)
        [harness.state().panels.program.chosen.unwrap()];
    assert!((moved.begin_s.unwrap() - 6.0).abs() < 0.11, "moved by five seconds: {moved:?}");
    assert_eq!(moved.hold_s, Some(2.0));
    drag(&mut harness, egui::pos2(x(8.0) - 2.0, y), egui::pos2(x(10.0) - 2.0, y));
    let held = &entries(&harness.state().shared.workbench.project.documents)
        [harness.state().panels.program.chosen.unwrap()];
    assert!((held.hold_s.unwrap() - 4.0).abs() < 0.21, "held two seconds longer: {held:?}");
    for _ in 0..2 {
        harness.state_mut().shared.perform(EditAction::Undo);
    }
    assert_eq!(
        harness.state().shared.workbench.project.documents.text(Documents::SCENARIO),
        Some(text.as_str())
    );
    assert_eq!(
        entries(&harness.state().shared.workbench.project.documents)[chosen].hold_s,
        Some(2.0)
    );
}

#[test]
fn a_run_held_beside_itself_differs_in_nothing_and_beside_another_in_something() {
    let folder = Folder::new("compare");
    let mut harness = flown(&folder);
    let first = view(&harness);
    harness.state_mut().shared.give(RunAction::Hold);
    harness.run_steps(2);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.state_mut().shared.perform(RunAction::Speed(f64::INFINITY));
    harness.state_mut().shared.perform(RunAction::Start);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Finished));
    let (a, b) = (view(&harness), harness.state().shared.workbench.compared_view().unwrap());
    assert!(
        Arc::ptr_eq(&b.model, &first.model) && !Arc::ptr_eq(&a.model, &b.model),
        "B is the run held, A a new one"
    );
    let all = groups(&a, &b, Units::Si);
    let rows: Vec<_> = all.iter().flat_map(|(_, rows)| rows).collect();
    assert!(
        rows.len() > 8
            && rows.iter().all(|row| row.difference == "same" || row.difference.is_empty()),
        "{rows:?}"
    );

    drawn_alike(&a, &b);
    seek(&mut harness, 1.0);
    let at_s = view(&harness).frame.time_s;
    wait(&mut harness, |app| {
        app.shared
            .workbench
            .compared_view()
            .is_some_and(|other| (other.frame.time_s - at_s).abs() < 1e-9)
    });
    only(&mut harness, PanelId::VIEW);
    assert!(harness.query_by_label("Pane 1 of B").is_some(), "both are drawn");

    harness.state_mut().shared.workbench.set(Documents::SCENARIO, "whale.depth", "9 m");
    harness.state_mut().shared.perform(RunAction::Start);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| {
            !Arc::ptr_eq(&view.model, &a.model) && view.status == Status::Finished
        })
    });
    let (a, b) = (view(&harness), harness.state().shared.workbench.compared_view().unwrap());
    let all = groups(&a, &b, Units::Si);
    assert!(
        all.iter().flat_map(|(_, rows)| rows).any(|row| row.difference.contains('%')),
        "{all:?}"
    );
    only(&mut harness, PanelId::COMPARE);
    assert!(harness.query_all_by_label("A less B").next().is_some(), "the table is on screen");
    harness.get_by_label("End comparison").click();
    harness.run_steps(3);
    assert!(harness.state().shared.workbench.comparison().is_none());
}

#[test]
fn a_kept_run_is_opened_beside_the_one_shown_and_follows_its_clock() {
    let folder = Folder::new("compare-kept");
    let mut harness = flown(&folder);
    let kept = folder.0.join("recordings/hello-endline 0001.endline");
    wait(&mut harness, |_| kept.exists());
    harness.state_mut().shared.give(RunAction::CompareWith(kept));
    harness.run_steps(2);
    let end = view(&harness);
    wait(&mut harness, |app| {
        app.shared.workbench.compared_view().is_some_and(|other| other.frame.step == end.frame.step)
    });
    assert_eq!(
        harness.state().shared.workbench.compared_view().unwrap().state_hash,
        end.state_hash,
        "run again to the bit"
    );
    let middle = seek(&mut harness, 0.5);
    wait(&mut harness, |app| {
        app.shared
            .workbench
            .compared_view()
            .is_some_and(|other| other.frame.step == middle.frame.step)
    });
    assert_eq!(
        harness.state().shared.workbench.compared_view().unwrap().frame.nodes,
        middle.frame.nodes
    );
}

/// Plots of a run beside itself: dashed lies on solid; along a line the greatest so far is the line's peak.
fn drawn_alike(a: &LiveView, b: &LiveView) {
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

//! Runs that were kept by themselves, to be opened and seen again.

use crate::gui::command::action::WindowAction;
use crate::gui::widgets::command::command;
use endline_session::command::RunAction;
use std::path::PathBuf;
use std::time::SystemTime;

use egui::{RichText, ScrollArea, Ui};

use crate::gui::files;
use crate::gui::panel::Panel;
use crate::gui::panel_id::PanelId;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;

/// The list of recordings, read again when a run was kept.
#[derive(Debug, Default)]
pub struct RecordingsPanel {
    files: Option<(u64, Vec<Recorded>)>,
}

#[derive(Clone, Debug)]
struct Recorded {
    path: PathBuf,
    age: String,
    kilobytes: u64,
}

impl Panel for RecordingsPanel {
    fn id(&self) -> PanelId {
        PanelId::RECORDINGS
    }

    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let Some(folder) = shared.workbench.recordings.clone() else {
            return widgets::nothing(
                ui,
                "No folder to keep recordings in: there is no user data folder here.",
            );
        };
        let kept = shared.workbench.kept_runs();
        if self.files.as_ref().is_none_or(|(seen, _)| *seen != kept) {
            self.files = Some((kept, list(&folder)));
        }
        let files = self.files.as_ref().map_or(&[][..], |(_, files)| files);
        ui.horizontal_wrapped(|ui| {
            ui.label(
                RichText::new("Every run is kept here when it ends or another begins.")
                    .color(Theme::palette_of(ui).faint),
            );
            command(ui, shared, "Open other …", WindowAction::Ask("run.open-recording"));
        });
        if files.is_empty() {
            return widgets::nothing(ui, "No runs yet.");
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for file in files {
                row(ui, shared, file);
            }
        });
    }
}

fn row(ui: &mut Ui, shared: &mut Shared, file: &Recorded) {
    let faint = Theme::palette_of(ui).faint;
    let name = files::stem(&file.path);
    ui.horizontal_wrapped(|ui| {
        ui.label(name);
        ui.label(RichText::new(format!("{}, {} kB", file.age, file.kilobytes)).color(faint));
        if ui
            .button("Open")
            .on_hover_text("Run it again, to the bit, and look at any moment")
            .clicked()
        {
            shared.give(RunAction::OpenRecording(file.path.clone()));
        }
        if ui.button("Compare").on_hover_text("Run it again beside the run shown, as B").clicked() {
            shared.give(RunAction::CompareWith(file.path.clone()));
        }
        if ui.button("Copy command").on_hover_text("endline replay …, for a terminal").clicked() {
            ui.ctx().copy_text(format!("endline replay '{}'", file.path.display()));
        }
    });
}

fn list(folder: &std::path::Path) -> Vec<Recorded> {
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut found: Vec<(SystemTime, PathBuf, u64)> = files
        .filter(|path| path.extension().is_some_and(|ending| ending == "endline"))
        .filter_map(|path| {
            let data = std::fs::metadata(&path).ok()?;
            Some((data.modified().ok()?, path, data.len()))
        })
        .collect();
    found.sort_by(|a, b| b.0.cmp(&a.0).then(b.1.cmp(&a.1)));
    let recorded = |(at, path, bytes): (SystemTime, PathBuf, u64)| Recorded {
        path,
        age: age(at),
        kilobytes: bytes.div_ceil(1024),
    };
    found.into_iter().map(recorded).collect()
}

/// How long ago, in the largest whole unit.
fn age(at: SystemTime) -> String {
    let seconds = SystemTime::now().duration_since(at).unwrap_or_default().as_secs();
    let (count, unit) = match seconds {
        0..=59 => return "just now".to_owned(),
        60..=3599 => (seconds / 60, "minute"),
        3600..=86_399 => (seconds / 3600, "hour"),
        _ => (seconds / 86_400, "day"),
    };
    format!("{count} {unit}{} ago", if count == 1 { "" } else { "s" })
}

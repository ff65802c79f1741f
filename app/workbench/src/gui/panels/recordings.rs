//! The list of recordings, which are stored automatically, with their thumbnails, names and notes.

use crate::gui::command::action::WindowAction;
use crate::gui::widgets::{self, command, words};
use endline_session::command::RunAction;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use egui::{
    Color32, Frame, Label, Rect, RichText, ScrollArea, Sense, TextEdit, TextureHandle,
    TextureOptions, Ui, Vec2, pos2, vec2,
};
use endline_session::recording::{self, kept::Kept};
use endline_sim::metrics::Outcome;

use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::{files, pictures};

/// The list of recordings, read again after a run was stored.
#[derive(Default)]
pub struct RecordingsPanel {
    files: Option<(u64, Vec<Recorded>)>,
}

struct Recorded {
    path: PathBuf,
    /// Name and note while they are typed.
    name: String,
    note: String,
    age: String,
    kept: Option<Kept>,
    /// Thumbnail, read when it becomes visible; the inner `None` if there is none.
    picture: Option<Option<TextureHandle>>,
}

/// Width and height of thumbnails [points].
const PICTURE: Vec2 = vec2(96.0, 54.0);

impl Panel for RecordingsPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let Some(folder) = shared.workbench.recordings().map(Path::to_owned) else {
            return widgets::nothing(
                ui,
                "Recordings cannot be stored: the system has no folder for user data.",
            );
        };
        let version = shared.workbench.recordings_version();
        if self.files.as_ref().is_none_or(|(seen, _)| *seen != version) {
            self.files = Some((version, list(&folder)));
        }
        let files = self.files.as_mut().map_or(&mut [][..], |(_, files)| files);
        ui.horizontal_wrapped(|ui| {
            ui.label(
                RichText::new("Every run is stored here when it ends or another one starts.")
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

/// Draws the thumbnail of a recording, and its facts beside it.
fn row(ui: &mut Ui, shared: &mut Shared, file: &mut Recorded) {
    ui.horizontal_top(|ui| {
        let (rect, response) = ui.allocate_exact_size(PICTURE, Sense::click());
        if ui.is_rect_visible(rect) {
            picture(ui, rect, file);
        }
        if response.on_hover_text("The end of the run. Click to open the recording").clicked() {
            shared.give(RunAction::OpenRecording(file.path.clone()));
        }
        ui.vertical(|ui| about(ui, shared, file));
    });
    ui.separator();
}

fn picture(ui: &Ui, rect: Rect, file: &mut Recorded) {
    let shown = file.picture.get_or_insert_with(|| {
        let image = pictures::thumbnail(&file.path)?;
        let name = file.path.display().to_string();
        Some(ui.ctx().load_texture(name, image, TextureOptions::LINEAR))
    });
    match shown {
        Some(texture) => {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture.id(), rect, whole, Color32::WHITE);
        }
        None => {
            ui.painter().rect_filled(rect, 2.0, Theme::palette_of(ui).field);
        }
    }
}

/// Draws outcome and actions of a recording, above its note.
fn about(ui: &mut Ui, shared: &mut Shared, file: &mut Recorded) {
    ui.horizontal_wrapped(|ui| {
        let name = TextEdit::singleline(&mut file.name).desired_width(190.0);
        if ui.add(name).on_hover_text("Click to rename").lost_focus()
            && file.name != files::stem(&file.path)
        {
            let (file, name) = (file.path.clone(), file.name.clone());
            shared.give(RunAction::RenameRecording { file, name });
        }
        ended(ui, shared, file);
        if ui
            .button("Open")
            .on_hover_text("Replays the run to the bit, to show any moment")
            .clicked()
        {
            shared.give(RunAction::OpenRecording(file.path.clone()));
        }
        if ui.button("Compare").on_hover_text("Replays it beside the run shown, as run B").clicked()
        {
            shared.give(RunAction::CompareWith(file.path.clone()));
        }
        if ui.button("Copy command").on_hover_text("Copies the command endline replay …").clicked()
        {
            ui.ctx().copy_text(format!("endline replay '{}'", file.path.display()));
        }
        if ui.button("Delete").on_hover_text("Moves it to the folder `deleted`").clicked() {
            shared.give(RunAction::DeleteRecording(file.path.clone()));
        }
    });
    let note = TextEdit::singleline(&mut file.note).hint_text("Note").desired_width(f32::INFINITY);
    let known = file.kept.as_ref().map_or("", |kept| kept.note.as_str());
    if ui.add(note.frame(Frame::NONE)).lost_focus() && file.note != known {
        let (file, note) = (file.path.clone(), file.note.clone());
        shared.give(RunAction::NoteRecording { file, note });
    }
}

/// Outcome, greatest tension, duration and age, if known.
fn ended(ui: &mut Ui, shared: &Shared, file: &Recorded) {
    let palette = Theme::palette_of(ui);
    let Some(kept) = &file.kept else {
        ui.label(RichText::new(&file.age).color(palette.faint));
        return;
    };
    let named = |outcome: &Outcome| kept.outcome.as_deref() == Some(outcome.name());
    if let Some(outcome) = Outcome::ALL.iter().copied().find(named) {
        let (mut words, mut help, mut colour) = words::outcome(outcome, palette);
        if kept.undecided {
            ((words, help), colour) = (words::UNDECIDED, palette.faint);
        }
        ui.label(RichText::new(words).color(colour)).on_hover_text(help);
    }
    let force = shared.workbench.preferences().units.force().text(kept.greatest_tension_n);
    let facts = format!("peak {force}, {:.0} s, {}", kept.simulated_s, file.age);
    ui.add(Label::new(RichText::new(facts).color(palette.faint)).extend())
        .on_hover_text(format!("of {}", kept.of));
}

fn list(folder: &Path) -> Vec<Recorded> {
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut found: Vec<(SystemTime, PathBuf)> = files
        .filter(|path| path.extension().is_some_and(|ending| ending == recording::EXTENSION))
        .filter_map(|path| Some((std::fs::metadata(&path).ok()?.modified().ok()?, path)))
        .collect();
    found.sort_by(|a, b| b.cmp(a));
    let recorded = |(at, path): (SystemTime, PathBuf)| {
        let kept = Kept::beside(&path);
        let note = kept.as_ref().map(|kept| kept.note.clone()).unwrap_or_default();
        Recorded { name: files::stem(&path), note, age: age(at), kept, path, picture: None }
    };
    found.into_iter().map(recorded).collect()
}

/// Age in the largest whole unit.
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

//! Files and tables of a gear library in lists on screen.

use std::path::{Path, PathBuf};

use egui::{ComboBox, PopupCloseBehavior, RichText, TextEdit, Ui};
use endline_gear::{Document, Kind};
pub use endline_session::locate::scenarios;

use super::theme::Theme;

/// A file in a list, under the heading of its subject.
#[derive(Clone, Debug)]
pub struct Listed {
    /// Heading.
    pub heading: &'static str,
    /// The file.
    pub path: PathBuf,
    /// Its name.
    pub name: String,
}

/// A choice among files by name, under headings, with a text box that filters them. The files are read when the list opens.
#[derive(Debug, Default)]
pub struct FileChooser {
    listed: Option<Vec<Listed>>,
    sought: String,
}

/// Greatest height of the list of files [points].
const LIST_HEIGHT: f32 = 460.0;

impl FileChooser {
    /// Draws the choice, with the name of the present file; returns another file that is chosen.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        (id, width): (&str, f32),
        (present, name): (Option<&Path>, &str),
        list: impl FnOnce() -> Vec<Listed>,
    ) -> Option<PathBuf> {
        let combo = ComboBox::from_id_salt(id)
            .width(width)
            .height(LIST_HEIGHT)
            .truncate()
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .selected_text(name);
        let open = combo.show_ui(ui, |ui| {
            let is_new = self.listed.is_none();
            let listed = self.listed.get_or_insert_with(list);
            let edit = TextEdit::singleline(&mut self.sought).hint_text("Search by name");
            let edit = ui.add(edit.desired_width(f32::INFINITY));
            if is_new {
                edit.request_focus();
            }
            let chosen = rows(ui, listed, &self.sought, present);
            if chosen.is_some() {
                ui.close();
            }
            chosen
        });
        if open.inner.is_none() {
            (self.listed, self.sought) = (None, String::new());
        }
        open.inner.flatten().filter(|chosen| Some(chosen.as_path()) != present)
    }
}

/// Draws the files whose names or ids contain all words sought; returns the one that is clicked.
fn rows(ui: &mut Ui, listed: &[Listed], sought: &str, present: Option<&Path>) -> Option<PathBuf> {
    let words: Vec<String> = sought.to_lowercase().split_whitespace().map(str::to_owned).collect();
    let (mut heading, mut chosen) = ("", None);
    for file in listed {
        let (name, id) = (file.name.to_lowercase(), stem(&file.path));
        if !words.iter().all(|word| name.contains(word) || id.contains(word.as_str())) {
            continue;
        }
        if file.heading != heading {
            heading = file.heading;
            ui.label(RichText::new(heading).small().color(Theme::palette_of(ui).faint));
        }
        let own = present == Some(file.path.as_path());
        if ui.selectable_label(own, &file.name).on_hover_text(id).clicked() {
            chosen = Some(file.path.clone());
        }
    }
    if heading.is_empty() {
        ui.label(RichText::new("No name contains these words.").color(Theme::palette_of(ui).faint));
    }
    chosen
}

/// Name of a file without folder and extension.
pub fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Name that the file of an item states; `None` if it states none or cannot be read.
pub fn name_of(path: &Path) -> Option<String> {
    let text = endline_gear::read::text(path).ok()?;
    Document::parse(&text).ok()?.get("name")
}

/// Shows a folder in the file manager of the system, or opens a file with its default program.
pub fn open_folder(folder: &Path) -> Result<(), String> {
    let program = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(windows) {
        "explorer"
    } else {
        "xdg-open"
    };
    let opened = std::process::Command::new(program).arg(folder).spawn();
    opened
        .map(|_| ())
        .map_err(|error| format!("{}: {program} cannot show it: {error}", folder.display()))
}

/// Kinds with a table and the title of its tab, in the order of the tabs.
pub const KINDS: [(Kind, &str); 9] = [
    (Kind::Rope, "Ropes"),
    (Kind::Trap, "Traps"),
    (Kind::Buoy, "Buoys"),
    (Kind::WeakLink, "Weak links"),
    (Kind::Knot, "Knots"),
    (Kind::Anchor, "Anchors"),
    (Kind::Site, "Sites"),
    (Kind::Friction, "Friction"),
    (Kind::Whale, "Whales"),
];

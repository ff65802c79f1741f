//! The command palette: every order by its name (Ctrl+P).

use egui::{Align2, Context, Key, RichText, TextEdit, Window, vec2};

use super::desk::{Desk, Order};
use super::layout::{Layout, Panel};
use super::panels::scenario::scenarios;
use super::studies::studies;
use super::theme::Theme;
use super::units::Units;
use crate::scene::View;

/// Names shown at once.
const SHOWN: usize = 10;

/// The palette, open or not.
#[derive(Clone, Debug, Default)]
pub struct Palette {
    open: bool,
    typed: String,
    chosen: usize,
}

/// Every order a user may give by name.
#[must_use]
pub fn orders(desk: &Desk) -> Vec<(String, Order)> {
    let mut all = vec![
        ("Run or pause".to_owned(), Order::PlayPause),
        ("Step".to_owned(), Order::Step),
        ("Reset".to_owned(), Order::Reset),
        ("Apply changes".to_owned(), Order::Apply),
        ("Fly the whale, or stop".to_owned(), Order::Fly),
        ("First or third person".to_owned(), Order::Person),
        ("Next act of the whale".to_owned(), Order::NextAct),
        ("Weak links on or off".to_owned(), Order::WeakLinks),
        ("Open or close the mouth".to_owned(), Order::Mouth),
        ("Play what was run".to_owned(), Order::Replay),
        ("First moment".to_owned(), Order::Seek(0.0)),
        ("Newest moment".to_owned(), Order::Newest),
        ("One moment back".to_owned(), Order::Shift(-1)),
        ("One moment on".to_owned(), Order::Shift(1)),
        ("Slower".to_owned(), Order::Slower),
        ("Faster".to_owned(), Order::Faster),
        ("See everything".to_owned(), Order::Frame),
        ("Copy as command line".to_owned(), Order::CopyCommandLine),
        ("Go on from the moment shown".to_owned(), Order::Branch),
        ("Open a recording".to_owned(), Order::AskRecording),
        ("Save the gear as STL".to_owned(), Order::AskExportModel("stl")),
        ("Save the gear as glTF".to_owned(), Order::AskExportModel("glb")),
        ("Save the plots as SVG".to_owned(), Order::AskExportPlots("svg")),
        ("Save the plots as PNG".to_owned(), Order::AskExportPlots("png")),
        ("Save the plots as CSV".to_owned(), Order::AskExportPlots("csv")),
        ("Dark".to_owned(), Order::Dress(Theme::Dark)),
        ("Light".to_owned(), Order::Dress(Theme::Light)),
        ("Duplicate the chosen entry".to_owned(), Order::Duplicate),
        ("Save the library's table as CSV".to_owned(), Order::AskExportTable),
        ("Take a CSV into the library".to_owned(), Order::AskImportTable),
        ("Reload plugins".to_owned(), Order::ReloadPlugins),
        ("Run the study".to_owned(), Order::QueueStudy),
        ("Pause the study, or go on".to_owned(), Order::PauseStudy),
        ("Cancel the study".to_owned(), Order::CancelStudy),
        ("Duplicate the study".to_owned(), Order::DuplicateStudy),
        ("Copy the study as command line".to_owned(), Order::CopyStudyLine),
        ("Open a study's file".to_owned(), Order::AskStudy),
        ("Open a study's results".to_owned(), Order::AskResults),
        ("Save all".to_owned(), Order::Save),
        ("Undo".to_owned(), Order::Undo),
        ("Redo".to_owned(), Order::Redo),
    ];
    all.extend(desk.acts().iter().enumerate().map(|(index, act)| (format!("Act {}", act.name), Order::ChooseAct(index))));
    all.extend(desk.plugins.waiting().map(|(file, ask)| {
        let name = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        (format!("Allow plugin {name}"), Order::AllowPlugin(file.clone(), ask.hash.clone()))
    }));
    let switches = desk.every_plugin().into_iter();
    all.extend(
        switches.map(|(info, on)| (format!("Switch {} {}", if on { "off" } else { "on" }, info.name), Order::SwitchPlugin(info.id, !on))),
    );
    all.extend([0.1, 0.25, 0.5, 1.0, 2.0, 5.0].map(|speed| (format!("Speed {speed}×"), Order::Speed(speed))));
    all.push(("Speed as fast as it goes".to_owned(), Order::Speed(f64::INFINITY)));
    let views = View::WHOLE.into_iter().chain(View::OF_WHALE);
    all.extend(views.map(|view| (format!("View {}", view.name().replace('-', " ")), Order::Look(view))));
    all.extend(Panel::ALL.map(|panel| (format!("Show {}", panel.title()), Order::Show(panel))));
    all.extend(Panel::ALL.map(|panel| (format!("Close {}", panel.title()), Order::Close(panel))));
    all.extend(Units::ALL.map(|units| (format!("Units {}", units.name()), Order::Measure(units))));
    all.extend([1.0, 1.25, 1.5, 2.0].map(|size| (format!("Size {:.0} %", 100.0 * size), Order::Size(size))));
    all.extend(Layout::ALL.map(|layout| (format!("Layout {}", layout.name()), Order::Arrange(layout))));
    all.extend(scenarios(desk.book.root()).into_iter().map(|path| {
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        (format!("Open {name}"), Order::Open(path))
    }));
    all.extend(studies(desk.book.root()).into_iter().map(|path| {
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        (format!("Open study {name}"), Order::OpenStudy(path))
    }));
    all
}

/// The orders whose names hold every typed word, whatever its case.
fn matching(all: Vec<(String, Order)>, typed: &str) -> Vec<(String, Order)> {
    let words: Vec<String> = typed.to_lowercase().split_whitespace().map(str::to_owned).collect();
    all.into_iter().filter(|(name, _)| words.iter().all(|word| name.to_lowercase().contains(word.as_str()))).collect()
}

impl Palette {
    /// Opens it empty, or closes it.
    pub fn toggle(&mut self) {
        *self = Self { open: !self.open, ..Self::default() };
    }

    /// Draws it where open; leaves the chosen order on the desk.
    pub fn show(&mut self, context: &Context, desk: &mut Desk) {
        if !self.open {
            return;
        }
        let found = matching(orders(desk), &self.typed);
        let (down, up, enter, escape) = context.input(|input| {
            (
                input.key_pressed(Key::ArrowDown),
                input.key_pressed(Key::ArrowUp),
                input.key_pressed(Key::Enter),
                input.key_pressed(Key::Escape),
            )
        });
        self.chosen = (self.chosen + usize::from(down)).saturating_sub(usize::from(up)).min(found.len().saturating_sub(1));
        let mut taken = enter.then(|| found.get(self.chosen).cloned()).flatten();
        let window = Window::new("Commands")
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::CENTER_TOP, vec2(0.0, 70.0))
            .fixed_size(vec2(380.0, 300.0));
        window.show(context, |ui| taken = self.list(ui, &found).or(taken.take()));
        if taken.is_some() || escape || enter {
            self.open = false;
        }
        desk.orders.extend(taken.map(|(_, order)| order));
    }

    fn list(&mut self, ui: &mut egui::Ui, found: &[(String, Order)]) -> Option<(String, Order)> {
        let field = ui.add(TextEdit::singleline(&mut self.typed).hint_text("Type a command").desired_width(f32::INFINITY));
        field.request_focus();
        if field.changed() {
            self.chosen = 0;
        }
        let first = self.chosen.saturating_sub(SHOWN - 1);
        let mut taken = None;
        for (index, (name, order)) in found.iter().enumerate().skip(first).take(SHOWN) {
            if ui.selectable_label(index == self.chosen, name).clicked() {
                taken = Some((name.clone(), order.clone()));
            }
        }
        if found.is_empty() {
            ui.label(RichText::new("no such command").color(Theme::palette_of(ui).faint));
        }
        taken
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_narrow_the_list_in_any_order_and_case() {
        let all = vec![("Show Tension".to_owned(), Order::Step), ("Show Events".to_owned(), Order::Save), ("Undo".to_owned(), Order::Undo)];
        let names = |typed: &str| matching(all.clone(), typed).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
        assert_eq!(names("tens SHOW"), ["Show Tension"]);
        assert_eq!(names("").len(), 3);
        assert!(names("dance").is_empty());
    }
}

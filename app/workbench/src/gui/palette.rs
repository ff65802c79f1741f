//! The command palette: every order by its name (Ctrl+P).

use egui::{Align2, Context, Key, RichText, TextEdit, Ui, Window, vec2};
use endline_session::units::Units;

use super::canvas::MOST_PANES;
use super::desk::{Desk, Order};
use super::files::{scenarios, stem, studies};
use super::inspector::worst_m;
use super::layout::Layout;
use super::order::Dialog;
use super::panel_id::PanelId;
use super::tables::KINDS;
use super::theme::Theme;
use crate::scene::{Picked, View};

/// Names shown at once.
const SHOWN: usize = 10;

/// The palette, open or not.
#[derive(Clone, Debug, Default)]
pub struct Palette {
    open: bool,
    typed: String,
    chosen: usize,
}

/// Orders that are always there, by name.
static NAMED: [(&str, Order); 51] = [
    ("Run or pause", Order::PlayPause),
    ("Step", Order::Step),
    ("Reset", Order::Reset),
    ("Apply changes", Order::Apply),
    ("Fly the whale, or stop", Order::Fly),
    ("First or third person", Order::Person),
    ("Next act of the whale", Order::NextAct),
    ("Weak links on or off", Order::WeakLinks),
    ("Open or close the mouth", Order::Mouth),
    ("Play what was run", Order::Replay),
    ("First moment", Order::Seek(0.0)),
    ("Newest moment", Order::Newest),
    ("One moment back", Order::Shift(-1)),
    ("One moment on", Order::Shift(1)),
    ("Slower", Order::Slower),
    ("Faster", Order::Faster),
    ("See everything", Order::Frame),
    ("Drag the whale's start", Order::Pose),
    ("Ruler", Order::Ruler),
    ("Clear the inspector and the ruler", Order::LetGo),
    ("Hold this run to compare with", Order::HoldRun),
    ("End the comparison", Order::EndCompare),
    ("Add an entry to the pilot program", Order::AddEntry),
    ("Delete the chosen entry of the pilot program", Order::DeleteEntry),
    ("Edit the inputs of this run", Order::EditInputs),
    ("Rerun from the moment shown", Order::Rerun),
    ("Copy as command line", Order::CopyCommandLine),
    ("Go on from the moment shown", Order::Branch),
    ("Open a recording", Order::Ask(Dialog::Recording)),
    ("Save the scenario as", Order::Ask(Dialog::ScenarioAs)),
    ("Save the gear as STL", Order::Ask(Dialog::ExportModel("stl"))),
    ("Save the gear as glTF", Order::Ask(Dialog::ExportModel("glb"))),
    ("Save the plots as SVG", Order::Ask(Dialog::ExportPlots("svg"))),
    ("Save the plots as PNG", Order::Ask(Dialog::ExportPlots("png"))),
    ("Save the plots as CSV", Order::Ask(Dialog::ExportPlots("csv"))),
    ("Dark", Order::Dress(Theme::Dark)),
    ("Light", Order::Dress(Theme::Light)),
    ("Duplicate the chosen entry", Order::Duplicate),
    ("Save the library's table as CSV", Order::Ask(Dialog::ExportTable)),
    ("Take a CSV into the library", Order::Ask(Dialog::ImportTable)),
    ("Reload plugins", Order::ReloadPlugins),
    ("Run the study", Order::QueueStudy),
    ("Pause the study, or go on", Order::PauseStudy),
    ("Cancel the study", Order::CancelStudy),
    ("Duplicate the study", Order::DuplicateStudy),
    ("Copy the study as command line", Order::CopyStudyLine),
    ("Open a study's file", Order::Ask(Dialog::Study)),
    ("Open a study's results", Order::Ask(Dialog::Results)),
    ("Save all", Order::Save),
    ("Undo", Order::Undo),
    ("Redo", Order::Redo),
];

/// Every order a user may give by name.
#[must_use]
pub fn orders(desk: &Desk) -> Vec<(String, Order)> {
    let mut all: Vec<(String, Order)> =
        NAMED.iter().map(|(name, order)| ((*name).to_owned(), order.clone())).collect();
    all.extend(
        desk.acts()
            .iter()
            .enumerate()
            .map(|(index, act)| (format!("Act {}", act.name), Order::ChooseAct(index))),
    );
    all.extend(desk.plugins.waiting().map(|(file, ask)| {
        let name =
            file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        (format!("Allow plugin {name}"), Order::AllowPlugin(file.clone(), ask.hash.clone()))
    }));
    let switches = desk.every_plugin().into_iter();
    all.extend(switches.map(|(info, on)| {
        (
            format!("Switch {} {}", if on { "off" } else { "on" }, info.name),
            Order::SwitchPlugin(info.id, !on),
        )
    }));
    all.extend(
        [0.1, 0.25, 0.5, 1.0, 2.0, 5.0]
            .map(|speed| (format!("Speed {speed}×"), Order::Speed(speed))),
    );
    all.push(("Speed as fast as it goes".to_owned(), Order::Speed(f64::INFINITY)));
    let views = View::WHOLE.into_iter().chain(View::OF_WHALE);
    all.extend(
        views.map(|view| (format!("View {}", view.name().replace('-', " ")), Order::Look(view))),
    );
    all.extend(
        (1..=MOST_PANES).map(|count| (format!("Views at once: {count}"), Order::Views(count))),
    );
    all.extend(readable(desk));
    all.extend(PanelId::ALL.into_iter().flat_map(of_panel));
    all.extend(
        KINDS.map(|(kind, title)| {
            (format!("Table of {}", title.to_lowercase()), Order::Table(kind))
        }),
    );
    all.extend(Units::ALL.map(|units| (format!("Units {}", units.name()), Order::Measure(units))));
    all.extend(
        [1.0, 1.25, 1.5, 2.0]
            .map(|size| (format!("Size {:.0} %", 100.0 * size), Order::Size(size))),
    );
    all.extend(
        Layout::ALL.map(|layout| (format!("Layout {}", layout.name()), Order::Arrange(layout))),
    );
    all.extend(
        scenarios(desk.documents.root())
            .into_iter()
            .map(|path| (format!("Open {}", stem(&path)), Order::Open(path))),
    );
    all.extend(
        studies(desk.documents.root())
            .into_iter()
            .map(|path| (format!("Open study {}", stem(&path)), Order::OpenStudy(path))),
    );
    all
}

/// A panel brought to the front, and taken away.
fn of_panel(panel: PanelId) -> [(String, Order); 2] {
    let title = panel.title();
    [(format!("Show {title}"), Order::Show(panel)), (format!("Close {title}"), Order::Close(panel))]
}

/// The things in the 3-D view that can be read: each line where its tension is greatest now, each body.
fn readable(desk: &Desk) -> Vec<(String, Order)> {
    let Some(view) = &desk.view else { return Vec::new() };
    let spec = &view.model.spec;
    let lines = spec.lines.iter().enumerate().map(|(line, of)| {
        (
            format!("Read line {}", of.id),
            Order::Read(Picked::Rope { line, at_m: worst_m(&view.model, &view.frame, line) }),
        )
    });
    let bodies = spec
        .bodies
        .iter()
        .enumerate()
        .map(|(index, body)| (format!("Read {}", body.id), Order::Read(Picked::Body(index))));
    lines.chain(bodies).collect()
}

/// The orders whose names hold every typed word, whatever its case.
fn matching(all: Vec<(String, Order)>, typed: &str) -> Vec<(String, Order)> {
    let words: Vec<String> = typed.to_lowercase().split_whitespace().map(str::to_owned).collect();
    let holds = |(name, _): &(String, Order)| {
        words.iter().all(|word| name.to_lowercase().contains(word.as_str()))
    };
    let mut found: Vec<(String, Order)> = all.into_iter().filter(holds).collect();
    // "Speed 1" is also a part of "Speed 0.1×": names whose words begin as typed come first, and no keyboard has a "×".
    let begins = |name: &str, word: &str| name.split_whitespace().any(|own| own.starts_with(word));
    let whole = words.join(" ");
    found.sort_by_cached_key(|(name, _)| {
        let name = name.to_lowercase();
        (words.iter().filter(|word| !begins(&name, word)).count(), name != whole)
    });
    found
}

impl Palette {
    /// Opens it, or closes it. What was typed before the frame in which it opens was drawn is its text.
    pub fn toggle(&mut self, context: &Context) {
        let text = |event: &egui::Event| {
            if let egui::Event::Text(text) = event { Some(text.clone()) } else { None }
        };
        let typed = if self.open {
            String::new()
        } else {
            context.input(|input| input.events.iter().filter_map(text).collect())
        };
        *self = Self { open: !self.open, typed, ..Self::default() };
    }

    /// Draws it where open; leaves the chosen order on the desk.
    pub fn show(&mut self, context: &Context, desk: &mut Desk) {
        if !self.open {
            return;
        }
        let (down, up, enter, escape) = context.input(|input| {
            (
                input.key_pressed(Key::ArrowDown),
                input.key_pressed(Key::ArrowUp),
                input.key_pressed(Key::Enter),
                input.key_pressed(Key::Escape),
            )
        });
        let window = Window::new("Commands")
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::CENTER_TOP, vec2(0.0, 70.0))
            .fixed_size(vec2(380.0, 300.0));
        let mut taken = None;
        window.show(context, |ui| {
            self.field(ui);
            // What was typed in this frame counts for an Enter in it.
            let found = matching(orders(desk), &self.typed);
            self.chosen = (self.chosen + usize::from(down))
                .saturating_sub(usize::from(up))
                .min(found.len().saturating_sub(1));
            taken = self
                .list(ui, &found)
                .or_else(|| enter.then(|| found.get(self.chosen).cloned()).flatten());
        });
        if taken.is_some() || escape || enter {
            self.open = false;
        }
        desk.orders.extend(taken.map(|(_, order)| order));
    }

    fn field(&mut self, ui: &mut Ui) {
        let field = ui.add(
            TextEdit::singleline(&mut self.typed)
                .hint_text("Type a command")
                .desired_width(f32::INFINITY),
        );
        field.request_focus();
        if field.changed() {
            self.chosen = 0;
        }
    }

    fn list(&self, ui: &mut Ui, found: &[(String, Order)]) -> Option<(String, Order)> {
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
        let all = vec![
            ("Show Tension".to_owned(), Order::Step),
            ("Show Events".to_owned(), Order::Save),
            ("Undo".to_owned(), Order::Undo),
        ];
        let names = |typed: &str| {
            matching(all.clone(), typed).into_iter().map(|(name, _)| name).collect::<Vec<_>>()
        };
        assert_eq!(names("tens SHOW"), ["Show Tension"]);
        let speeds = ["Speed 0.1×", "Speed 1×"].map(|name| (name.to_owned(), Order::Step)).to_vec();
        for typed in ["speed 1×", "speed 1", "1 speed"] {
            assert_eq!(
                matching(speeds.clone(), typed)[0].0,
                "Speed 1×",
                "{typed}: a word's beginning comes before its middle"
            );
        }
        assert_eq!(names("").len(), 3);
        assert!(names("dance").is_empty());
    }
}

//! The command palette (Ctrl+P): a list of all commands, searched by name.

use egui::{Align2, Button, Context, Key, RichText, TextEdit, Ui, Window, vec2};

use super::command::action::WindowCommand;
use super::command::{Offer, declared};
use super::shared::Shared;
use super::theme::Theme;

/// Number of commands shown.
const SHOWN: usize = 10;

/// State of the palette.
#[derive(Clone, Debug, Default)]
pub struct Palette {
    open: bool,
    typed: String,
    chosen: usize,
}

/// All commands that the palette lists, enabled or not.
pub fn offers(shared: &Shared) -> Vec<Offer> {
    declared().flat_map(|command| command.offers(shared)).collect()
}

/// Words of other programs, each with words of names in this program.
const SYNONYMS: &[(&str, &[&str])] = &[
    ("remove", &["delete"]),
    ("erase", &["delete"]),
    ("copy", &["duplicate"]),
    ("clone", &["duplicate"]),
    ("zoom", &["see everything", "size"]),
    ("fit", &["see everything"]),
    ("camera", &["view", "person"]),
    ("preferences", &["units", "size", "dark", "light"]),
    ("settings", &["units", "size", "dark", "light"]),
    ("options", &["units", "size", "dark", "light"]),
    ("theme", &["dark", "light"]),
    ("font", &["size"]),
    ("scale", &["size"]),
    ("peak", &["read", "tension"]),
    ("maximum", &["read", "tension"]),
    ("report", &["results"]),
    ("graph", &["plots", "tension"]),
    ("chart", &["plots", "tension"]),
    ("export", &["save"]),
    ("screenshot", &["picture", "png"]),
    ("image", &["picture", "png"]),
    ("video", &["film", "recording"]),
    ("movie", &["film", "recording"]),
    ("gamepad", &["pad", "fly"]),
    ("joystick", &["pad", "fly"]),
    ("simulate", &["run"]),
    ("exit", &["quit"]),
    ("shortcuts", &["keys"]),
    ("measure", &["ruler"]),
];

/// Commands that match every typed word, in any case, best match first.
fn matching(all: Vec<Offer>, typed: &str) -> Vec<Offer> {
    let words: Vec<String> = typed.to_lowercase().split_whitespace().map(str::to_owned).collect();
    let whole = words.join(" ");
    let ranked = |offer: Offer| {
        let name = offer.name.to_lowercase();
        let ranks = words.iter().map(|word| rank(&name, offer.help, word));
        Some((ranks.sum::<Option<u32>>()?, name != whole, offer))
    };
    let mut found: Vec<_> = all.into_iter().filter_map(ranked).collect();
    found.sort_by_key(|(rank, is_other, _)| (*rank, *is_other));
    found.into_iter().map(|(.., offer)| offer).collect()
}

/// Rank of a typed word for a command with this lower-case name and help, 0 best; `None` if it does not match.
fn rank(name: &str, help: &str, word: &str) -> Option<u32> {
    // "1" is also in "Speed 0.1×": a word that begins as typed ranks first.
    if name.split_whitespace().any(|own| own.starts_with(word)) {
        return Some(0);
    }
    if name.contains(word) {
        return Some(1);
    }
    // Shorter words would match too many synonyms.
    let meant = SYNONYMS.iter().filter(|(other, _)| word.len() > 2 && other.starts_with(word));
    if meant.flat_map(|(_, names)| *names).any(|own| name.contains(own)) {
        return Some(10);
    }
    (word.len() > 2 && help.to_lowercase().contains(word)).then_some(100)
}

impl Palette {
    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Opens or closes it. Text typed in the frame in which it opens becomes its content.
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

    /// Draws it if it is open, and gives the selected command.
    pub fn show(&mut self, context: &Context, shared: &mut Shared) {
        if !self.open {
            return;
        }
        let [down, up, enter, escape] = [Key::ArrowDown, Key::ArrowUp, Key::Enter, Key::Escape]
            .map(|key| context.input(|input| input.key_pressed(key)));
        let window = Window::new("Commands")
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::CENTER_TOP, vec2(0.0, 70.0))
            .fixed_size(vec2(380.0, 300.0));
        let mut taken: Option<WindowCommand> = None;
        window.show(context, |ui| {
            self.field(ui);
            // Filtered after the text box, so that Enter in the same frame applies to all that was typed.
            let found = matching(offers(shared), &self.typed);
            self.chosen = (self.chosen + usize::from(down))
                .saturating_sub(usize::from(up))
                .min(found.len().saturating_sub(1));
            let chosen = || found.get(self.chosen).map(|offer| offer.command.clone());
            taken = self.list(ui, &found).or_else(|| enter.then(chosen).flatten());
        });
        if taken.is_some() || escape || enter {
            self.open = false;
        }
        shared.commands.extend(taken);
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

    /// Lists commands; a disabled one is grey, with the reason on hover.
    fn list(&self, ui: &mut Ui, found: &[Offer]) -> Option<WindowCommand> {
        let faint = Theme::palette_of(ui).faint;
        let first = self.chosen.saturating_sub(SHOWN - 1);
        let mut taken = None;
        for (index, offer) in found.iter().enumerate().skip(first).take(SHOWN) {
            let name = RichText::new(&offer.name);
            let name = if offer.enabled.is_ok() { name } else { name.color(faint) };
            let row = Button::selectable(index == self.chosen, name).shortcut_text(&offer.keys);
            let hint = offer.enabled.as_ref().err().map_or(offer.help, String::as_str);
            if ui.add(row).on_hover_text(hint).clicked() {
                taken = Some(offer.command.clone());
            }
        }
        if found.is_empty() {
            ui.label(RichText::new("no command matches").color(faint));
        }
        taken
    }
}

#[cfg(test)]
mod tests {
    use endline_session::command::RunAction;

    use super::*;

    fn offer(name: &str) -> Offer {
        Offer {
            name: name.to_owned(),
            help: "",
            keys: String::new(),
            enabled: Ok(()),
            command: RunAction::Step.into(),
        }
    }

    #[test]
    fn typed_words_filter_the_list_in_any_order_and_case() {
        let all = || ["Show Tension", "Show Events", "Undo"].map(offer).to_vec();
        let names = |typed: &str| {
            matching(all(), typed).into_iter().map(|offer| offer.name).collect::<Vec<_>>()
        };
        assert_eq!(names("tens SHOW"), ["Show Tension"]);
        let speeds = || ["Speed 0.1×", "Speed 1×"].map(offer).to_vec();
        for typed in ["speed 1×", "speed 1", "1 speed"] {
            assert_eq!(
                matching(speeds(), typed)[0].name,
                "Speed 1×",
                "{typed}: the beginning of a word ranks before its middle"
            );
        }
        assert_eq!(names("").len(), 3);
        assert_eq!(names("graph"), ["Show Tension"], "a synonym");
        let with_help = || {
            let undo = Offer { help: "Takes the last edit back.", ..offer("Undo") };
            vec![undo, offer("Edit inputs")]
        };
        let found: Vec<String> =
            matching(with_help(), "edit").into_iter().map(|offer| offer.name).collect();
        assert_eq!(
            found,
            ["Edit inputs", "Undo"],
            "a match in the help ranks after a match in the name"
        );
        assert!(names("dance").is_empty());
    }
}

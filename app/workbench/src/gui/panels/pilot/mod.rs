//! The pilot program on a timeline: entries as bars to be dragged, the chosen one as a form, reactions below.

mod form;
mod tracks;

use std::sync::Arc;

use egui::{Button, RichText, ScrollArea, Ui};
use endline_gear::Document;
use endline_session::edit::Documents;
use endline_session::edit::pilot_program::{Entry, LIST, add, entries};

use super::super::desk::{Desk, Order};
use super::super::theme::Theme;

/// Width of the form [points].
const FORM: f32 = 292.0;

/// State of the pilot panel.
#[derive(Clone, Debug, Default)]
pub struct PilotState {
    /// The entry that is edited.
    pub chosen: Option<usize>,
    drag: Option<tracks::Drag>,
    /// Entries as read, with the version of the texts they were read from.
    read: Option<(u64, Arc<Vec<Entry>>)>,
}

impl PilotState {
    /// The entries of the present text; read again where it has changed.
    fn entries(&mut self, documents: &Documents) -> Arc<Vec<Entry>> {
        let (version, read) =
            self.read.get_or_insert_with(|| (documents.version(), Arc::new(entries(documents))));
        if *version != documents.version() {
            (*version, *read) = (documents.version(), Arc::new(entries(documents)));
        }
        Arc::clone(read)
    }
}

/// Draws the pilot panel.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    if desk.documents.field(Documents::SCENARIO, "whale.item").is_none() {
        return super::nothing(ui, "This scenario has no whale to pilot.");
    }
    let all = desk.program.entries(&desk.documents);
    desk.program.chosen = desk.program.chosen.filter(|chosen| *chosen < all.len());
    toolbar(ui, desk, &all);
    let whole = ui.available_rect_before_wrap();
    let beside = if desk.program.chosen.is_some() { FORM.min(0.5 * whole.width()) } else { 0.0 };
    super::within(ui, whole.with_max_x(whole.right() - beside - 8.0), |ui| {
        ScrollArea::vertical().id_salt("tracks").auto_shrink(false).show(ui, |ui| {
            tracks::show(ui, desk, &all);
            reactions(ui, desk, &all);
        });
    });
    if let Some(entry) = desk.program.chosen.and_then(|chosen| all.get(chosen)) {
        super::within(ui, whole.with_min_x(whole.right() - beside), |ui| {
            ScrollArea::vertical()
                .id_salt("form")
                .auto_shrink(false)
                .show(ui, |ui| form::show(ui, desk, entry));
        });
    }
}

fn toolbar(ui: &mut Ui, desk: &mut Desk, all: &[Entry]) {
    let run = desk.view.as_ref().is_some_and(|view| view.newest_s > 0.0);
    let shown_s = desk.view.as_ref().map_or(0.0, |view| view.frame.time_s);
    ui.horizontal_wrapped(|ui| {
        let help = "An entry at the moment shown";
        if ui.button("Add entry").on_hover_text(help).clicked() {
            desk.orders.push(Order::AddEntry);
        }
        if ui.add_enabled(desk.program.chosen.is_some(), Button::new("Delete entry")).clicked() {
            desk.orders.push(Order::DeleteEntry);
        }
        let help = "What was flown or steered in the run shown becomes this program, entry by entry; one Undo takes it back";
        if ui.add_enabled(run, Button::new("Edit inputs of this run")).on_hover_text(help).clicked() {
            desk.orders.push(Order::EditInputs);
        }
        let text = format!("Rerun from {shown_s:.2} s");
        let help = "The same inputs up to the moment shown, then this program as it stands now";
        if ui.add_enabled(run && !desk.documents.any_error(), Button::new(text)).on_hover_text(help).clicked() {
            desk.orders.push(Order::Rerun);
        }
        let count = if all.len() == 1 { "1 entry".to_owned() } else { format!("{} entries", all.len()) };
        ui.label(RichText::new(count).color(Theme::palette_of(ui).faint));
    });
}

/// Entries whose beginning shows only in the run.
fn reactions(ui: &mut Ui, desk: &mut Desk, all: &[Entry]) {
    let unknown: Vec<&Entry> = all.iter().filter(|entry| entry.begin_s.is_none()).collect();
    if unknown.is_empty() {
        return;
    }
    super::caption(ui, "Reactions: begin when something happens");
    for entry in unknown {
        let chosen = desk.program.chosen == Some(entry.index);
        let label = Button::selectable(chosen, RichText::new(entry.words())).truncate();
        if ui.add(label).clicked() {
            desk.program.chosen = Some(entry.index);
        }
    }
}

/// Changes the program; one undo takes it back, and what hinders it is said.
fn change(desk: &mut Desk, change: impl FnOnce(&mut Document) -> Result<(), String>) {
    if let Err(error) = desk.documents.alter(Documents::SCENARIO, change) {
        desk.notice = Some((error, true));
    }
}

/// Adds an entry at the moment shown, and chooses it.
pub fn add_entry(desk: &mut Desk) {
    let shown_s = desk.view.as_ref().map_or(0.0, |view| view.frame.time_s);
    // Two entries at one time are an error; a fresh one goes beside.
    let taken = entries(&desk.documents)
        .iter()
        .any(|entry| entry.trigger == "at" && entry.begin_s == Some(shown_s));
    let time_s = if taken { shown_s + 0.5 } else { shown_s };
    let mut chosen = None;
    change(desk, |document| add(document, time_s).map(|index| chosen = Some(index)));
    desk.program.chosen = chosen.or(desk.program.chosen);
}

/// Takes the chosen entry away.
pub fn delete_entry(desk: &mut Desk) {
    if let Some(chosen) = desk.program.chosen.take() {
        change(desk, |document| {
            document.remove_table(LIST, chosen).map_err(|error| error.to_string())
        });
    }
}

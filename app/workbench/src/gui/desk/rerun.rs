//! A run's inputs as a pilot program to be edited, and run again from any moment.

use std::sync::Arc;

use endline_gear::Document;
use endline_gear::units::{Quantity, parse};
use endline_session::edit::Documents;
use endline_session::live::{Made, RunCommand};

use super::{Desk, Order};
use crate::gui::panel_id::PanelId;

/// How far a control of the program may be off what was flown, so that it has entries to be read and not one a step [1].
const THIN: f64 = 0.02;

/// What is under way.
#[derive(Default)]
pub(super) struct Again {
    /// Whether the next model takes the inputs of the run shown.
    rerun: bool,
    /// Whether a program is asked for.
    wanted: bool,
    /// The program taken last.
    taken: Option<Arc<Made>>,
}

impl Again {
    /// Whether the model that is there now takes the inputs of the run shown; once.
    pub(super) fn rerun_when_made(&mut self) -> bool {
        std::mem::take(&mut self.rerun)
    }
}

impl Desk {
    /// Asks the run for its inputs as a pilot program.
    pub(super) fn edit_inputs(&mut self) {
        if self.view.as_ref().is_none_or(|view| view.newest_s <= 0.0) {
            self.notice = Some(("nothing was run yet".into(), true));
            return;
        }
        self.again.wanted = true;
        self.tell(RunCommand::Program(THIN));
    }

    /// Takes the program asked for; one undo takes it back.
    pub(super) fn take_program(&mut self) {
        let Some(made) = self.view.as_ref().and_then(|view| view.program.clone()) else { return };
        let new = self.again.taken.as_ref().is_none_or(|taken| !Arc::ptr_eq(taken, &made));
        if !(new && std::mem::take(&mut self.again.wanted)) {
            return;
        }
        self.again.taken = Some(Arc::clone(&made));
        match made.as_ref() {
            Ok(program) => {
                let text = self.as_long_as_before(&program.scenario);
                self.documents.put_all(vec![(Documents::SCENARIO.to_owned(), text)]);
                self.notice = Some((
                    format!(
                        "the run's inputs are the pilot program now: {} in all",
                        counted(program.entries)
                    ),
                    false,
                ));
                self.orders.push(Order::Show(PanelId::PROGRAM));
            }
            Err(error) => self.notice = Some((error.clone(), true)),
        }
    }

    /// The scenario of a run with its duration as it was, where the run was stopped short of that.
    fn as_long_as_before(&self, scenario: &str) -> String {
        let seconds =
            |text: Option<String>| text.and_then(|text| parse(&text, Quantity::Time).ok());
        let before = self.documents.field(Documents::SCENARIO, "duration");
        let Ok(mut document) = Document::parse(scenario) else { return scenario.to_owned() };
        match before
            .filter(|before| seconds(Some(before.clone())) > seconds(document.get("duration")))
        {
            Some(before) if document.set("duration", &before).is_ok() => document.text(),
            _ => scenario.to_owned(),
        }
    }

    /// Makes the model anew and runs the inputs up to the moment shown in it; then its pilot program steers.
    pub(super) fn rerun(&mut self) {
        if self.view.is_none() || self.documents.any_error() {
            self.notice = Some(("nothing can be run: see Problems".into(), true));
            return;
        }
        if self.flying {
            self.toggle_fly();
        }
        self.replaying_s = None;
        self.again.rerun = true;
        self.make();
    }
}

/// So many entries, in words.
fn counted(entries: usize) -> String {
    if entries == 1 { "1 entry".to_owned() } else { format!("{entries} entries") }
}

//! The inputs of a run: written as a pilot program, and run again up to the moment shown.

use std::sync::Arc;

use endline_gear::Document;
use endline_gear::units::{Quantity, parse};

use super::Workbench;
use super::model::Then;
use super::notice::{Event, Notice};
use crate::edit::Documents;
use crate::live::{Made, RunCommand};

/// How far a control of the program may be off what was flown, so that it has few entries [1].
const THIN: f64 = 0.02;

/// The pilot program asked of the run.
#[derive(Default)]
pub(super) struct ProgramRequest {
    wanted: bool,
    /// The program taken last.
    taken: Option<Arc<Made>>,
}

impl Workbench {
    /// Asks the run for its inputs as a pilot program; [`refresh`](Self::refresh) takes it.
    pub(crate) fn edit_inputs(&mut self) -> Result<(), String> {
        self.run.program.wanted = true;
        self.send(RunCommand::Program(THIN))
    }

    /// Takes the program asked for; one undo takes it back.
    pub(super) fn take_program(&mut self) {
        let Some(made) = self.view().and_then(|view| view.program.clone()) else { return };
        let request = &mut self.run.program;
        let new = request.taken.as_ref().is_none_or(|taken| !Arc::ptr_eq(taken, &made));
        if !(new && std::mem::take(&mut request.wanted)) {
            return;
        }
        request.taken = Some(Arc::clone(&made));
        self.notice = Some(match made.as_ref() {
            Ok(program) => {
                let place = self.put_program(&program.scenario);
                self.events.push(Event::ProgramWritten);
                let count = counted(program.entries);
                Notice::done(format!(
                    "the run's inputs are the pilot program {place}: {count} in all"
                ))
            }
            Err(error) => Notice::fault(error),
        });
    }

    /// Puts a run's scenario with its inputs in the place of the open one, or under a name of its own where the run is of something
    /// else, such as a recording. Answers where.
    fn put_program(&mut self, scenario: &str) -> String {
        if self.run.made.is_guest() {
            let path = self.project.documents.put_scenario_as_new(scenario.to_owned(), "inputs");
            return format!("of a new scenario, {} (not saved yet)", path.display());
        }
        let text = self.as_long_as_before(scenario);
        self.project.documents.put_all(vec![(Documents::SCENARIO.to_owned(), text)]);
        "now".to_owned()
    }

    /// The scenario of a run with its duration as it was, where the run was stopped short of that.
    fn as_long_as_before(&self, scenario: &str) -> String {
        let seconds =
            |text: Option<String>| text.and_then(|text| parse(&text, Quantity::Time).ok());
        let before = self.project.documents.field(Documents::SCENARIO, "duration");
        let Ok(mut document) = Document::parse(scenario) else { return scenario.to_owned() };
        let longer =
            |before: &String| seconds(Some(before.clone())) > seconds(document.get("duration"));
        match before.filter(longer) {
            Some(before) if document.set("duration", &before).is_ok() => document.text(),
            _ => scenario.to_owned(),
        }
    }

    /// Makes the model anew and runs the inputs up to the moment shown in it; then its pilot program steers.
    pub(crate) fn rerun(&mut self) -> Result<(), String> {
        self.run.replay.stop();
        self.make_model_then(Then::Rerun)
    }

    /// Runs the inputs up to the moment shown again and stands still.
    pub(crate) fn branch(&mut self) -> Result<(), String> {
        self.keep_run();
        self.run.replay.stop();
        self.send(RunCommand::Branch)
    }
}

/// A number of entries, in words.
fn counted(entries: usize) -> String {
    if entries == 1 { "1 entry".to_owned() } else { format!("{entries} entries") }
}

//! The texts of a user: opened, edited, saved, taken back.

use std::path::Path;

use endline_gear::units::{self, Quantity};
use endline_gear::{Diagnostic, Kind};

use super::Workbench;
use super::model::Texts;
use super::notice::{Event, Notice};
use crate::edit::bundled::OwnCopy;
use crate::edit::recovery::{Autosave, UnsavedEdits};
use crate::edit::saving::Keep;
use crate::edit::{Documents, library_table, pilot_program};
use crate::rules::remedy::{Asked, usual_inserts, usual_inserts_of_own};
use crate::statics::TrialGear;
use crate::study::Files;

/// The texts, and what is wrong with them.
pub struct Project {
    /// Every open text.
    pub documents: Documents,
    /// Keeps unsaved edits for the case of a crash.
    pub(super) autosave: Autosave,
    /// Problems found in making the model last.
    pub(super) model_problems: Vec<Diagnostic>,
    /// The texts they were found in.
    pub(super) model_texts: Texts,
}

impl Project {
    /// The project of open texts.
    pub fn new(documents: Documents) -> Self {
        let (model_problems, model_texts) = (Vec::new(), Texts::new());
        Self { documents, autosave: Autosave::default(), model_problems, model_texts }
    }

    /// Problems of the texts and of making the model.
    pub fn problems(&self) -> impl Iterator<Item = &Diagnostic> {
        let known = self.documents.problems();
        known.iter().chain(self.model_problems.iter().filter(|problem| !known.contains(problem)))
    }

    /// Problems found in making the model last.
    pub fn model_problems(&self) -> &[Diagnostic] {
        &self.model_problems
    }

    /// The worst problem at a field of a text, or of the model made last of the texts as they stand.
    pub fn problem_at(&self, path: &str, field: &str) -> Option<&Diagnostic> {
        let file = self.documents.shown_name(path);
        let here = |problem: &&Diagnostic| problem.file == file && problem.field == field;
        let of_model = || {
            let problem = self.model_problems.iter().find(here);
            problem.filter(|_| self.documents.same_run(&self.model_texts))
        };
        self.documents.problem_at(path, field).or_else(of_model)
    }

    /// The scenario's name without folder and extension.
    pub fn scenario_stem(&self) -> String {
        let stem = self.documents.scenario_path().file_stem();
        stem.map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
    }

    /// The library and the scenario as they are edited, for a study or a search to run on.
    pub(super) fn files(&self) -> Files {
        let documents = &self.documents;
        let scenario = documents.text(Documents::SCENARIO).map(str::to_owned);
        Files {
            root: documents.root().to_owned(),
            sources: documents.sources(),
            scenario: scenario.map(|text| (documents.scenario_path().to_owned(), text)),
        }
    }

    /// Whether the scenario has a whale.
    pub fn has_whale(&self) -> bool {
        self.documents.has(Documents::SCENARIO, "whale")
    }
}

impl Workbench {
    /// Sets a field of a text; the notice says what else changed.
    pub(crate) fn set_field(&mut self, path: &str, field: &str, value: &str) -> Result<(), String> {
        if let Some(said) = self.project.documents.set(path, field, value)? {
            self.notice = Some(Notice::done(said));
        }
        Ok(())
    }

    /// Puts the usual weak inserts along the endlines of an assembly, in the scenario's depth, or of the scenario's own parts.
    pub(crate) fn add_inserts(&mut self, gear: &TrialGear) -> Result<(), String> {
        let documents = &self.project.documents;
        let path = match gear {
            TrialGear::Assembly(id) => format!("assemblies/{id}.toml"),
            TrialGear::Own => Documents::SCENARIO.to_owned(),
        };
        let text = documents.text(&path).ok_or_else(|| format!("there is no `{path}`"))?;
        let (host, _) = self.helpers();
        let made = match gear {
            TrialGear::Assembly(id) => {
                let depth = documents.field(Documents::SCENARIO, "site.depth");
                let depth_m = depth.and_then(|text| units::parse(&text, Quantity::Length).ok());
                let asked = Asked { id, text, sources: &documents.sources() };
                usual_inserts(asked, depth_m, &host)
            }
            TrialGear::Own => usual_inserts_of_own(text, documents.library(), &host),
        };
        let made = made.map_err(|error| error.to_string())?;
        self.project.documents.put_all(vec![(path, made.text)]);
        self.notice = Some(Notice::done(format!("{} Undo takes it back.", made.says)));
        Ok(())
    }

    pub(crate) fn undo(&mut self) -> Result<(), String> {
        let done = self.project.documents.undo();
        if done { Ok(()) } else { Err("nothing to undo".to_owned()) }
    }

    pub(crate) fn redo(&mut self) -> Result<(), String> {
        let done = self.project.documents.redo();
        if done { Ok(()) } else { Err("nothing to redo".to_owned()) }
    }

    pub(crate) fn save(&mut self) -> Result<(), String> {
        let documents = &mut self.project.documents;
        let saved = documents.save().map_err(|error| format!("not saved: {error}"))?;
        self.notice = Some(Notice::done(saved.sentence()));
        for OwnCopy { from, to, file, .. } in saved.copies {
            if from == Documents::SCENARIO {
                self.preferences.remember(&file);
            } else if from != to {
                self.events.push(Event::Duplicated { from, to });
            }
        }
        Ok(())
    }

    pub(crate) fn reconcile(&mut self, path: &str, keep: Keep) -> Result<(), String> {
        let done = self.project.documents.reconcile(path, keep)?;
        self.notice = Some(Notice::done(done));
        Ok(())
    }

    pub(crate) fn save_scenario_as(&mut self, path: &Path) -> Result<(), String> {
        self.project.documents.save_scenario_as(path)?;
        self.preferences.remember(path);
        self.notice = Some(Notice::done(format!("saved {}", path.display())));
        Ok(())
    }

    pub(crate) fn open_scenario(&mut self, path: &Path) -> Result<(), String> {
        self.project.documents.open_scenario(path)?;
        self.preferences.remember(path);
        self.make_model()
    }

    /// Takes up edits that a crash left; one undo takes them back.
    pub(crate) fn recover(&mut self, edits: &UnsavedEdits) -> Result<(), String> {
        let documents = &mut self.project.documents;
        let elsewhere = edits.scenario != documents.scenario_path()
            && edits.texts.contains_key(Documents::SCENARIO);
        if elsewhere {
            documents.open_scenario(&edits.scenario)?;
        }
        let study = edits.study.as_deref().filter(|study| {
            edits.texts.contains_key(Documents::STUDY) && Some(*study) != documents.study_path()
        });
        study.map_or(Ok(()), |study| documents.open_study(study))?;
        let observation = edits.observation.as_deref().filter(|observation| {
            edits.texts.contains_key(Documents::OBSERVATION)
                && Some(*observation) != documents.observation_path()
        });
        observation.map_or(Ok(()), |observation| documents.open_observation(observation))?;
        let texts = edits.texts.iter().map(|(path, text)| (path.clone(), text.clone()));
        documents.restore(texts.collect());
        self.notice = Some(Notice::done("unsaved edits are back; Save all writes them"));
        Ok(())
    }

    pub(crate) fn toggle_weak_links(&mut self) -> Result<(), String> {
        let documents = &mut self.project.documents;
        let field = documents.field(Documents::SCENARIO, "weak_links");
        let on = field.is_none_or(|text| text == "true");
        documents.set(Documents::SCENARIO, "weak_links", if on { "false" } else { "true" })?;
        self.make_model()
    }

    pub(crate) fn duplicate(&mut self, from: String) -> Result<(), String> {
        let to = self.project.documents.duplicate(&from)?;
        self.events.push(Event::Duplicated { from, to });
        Ok(())
    }

    pub(crate) fn new_assembly(&mut self, gear_type: &str) -> Result<(), String> {
        let gear = self.plugins.host.gear(gear_type);
        let gear = gear.ok_or_else(|| format!("there is no gear type {gear_type}"))?;
        let stem = gear_type.rsplit('.').next().unwrap_or("gear");
        let documents = &mut self.project.documents;
        let path = documents.fresh_path("assemblies", &format!("my-{stem}"));
        let text = format!(
            "format = 1\nkind = \"assembly\"\nname = \"My {}\"\nnotes = \"\"\n\ngear_type = \"{gear_type}\"\n\n[attributes]\n",
            gear.descriptor().name.to_lowercase(),
        );
        documents.put_all(vec![(path.clone(), text)]);
        self.events.push(Event::AssemblyAdded(path));
        Ok(())
    }

    pub(crate) fn remove(&mut self, path: &str) -> Result<(), String> {
        let documents = &mut self.project.documents;
        if documents.text(path).is_none() {
            return Err(format!("{path} is not in the library"));
        }
        if documents.in_use(path) {
            return Err(format!(
                "{path} is in use by the open scenario: choose another there first"
            ));
        }
        if documents.is_bundled(path) {
            return Err(format!("{path} came with Endline and is not deleted"));
        }
        documents.remove(path);
        self.notice =
            Some(Notice::done(format!("{path} goes with the next save; Undo brings it back")));
        Ok(())
    }

    pub(crate) fn import_table(&mut self, kind: Kind, file: &Path) -> Result<(), String> {
        let text = endline_gear::read::text(file)
            .map_err(|error| format!("{}: {error}", file.display()))?;
        let taken = library_table::import(&mut self.project.documents, kind, &text)
            .map_err(|reason| format!("not taken in: {reason}"))?;
        let notice = if taken.left_out.is_empty() { Notice::done } else { Notice::hint };
        self.notice = Some(notice(taken.sentence()));
        Ok(())
    }

    /// Puts cells of the clipboard into a library table: over the entries and fields of `at`, or by their head row.
    pub(crate) fn paste(
        &mut self,
        kind: Kind,
        cells: &str,
        at: Option<(Vec<String>, Vec<&'static str>)>,
    ) -> Result<(), String> {
        let documents = &mut self.project.documents;
        let taken = match at {
            Some((paths, keys)) => library_table::cells(cells)
                .and_then(|cells| library_table::spread(documents, &paths, &keys, &cells)),
            None => library_table::import(documents, kind, cells),
        };
        let taken = taken.map_err(|reason| format!("not pasted: {reason}"))?;
        let notice = if taken.left_out.is_empty() { Notice::done } else { Notice::hint };
        self.notice = Some(notice(taken.sentence()));
        Ok(())
    }

    /// Adds an entry at the moment shown to the pilot program.
    pub(crate) fn add_entry(&mut self) -> Result<(), String> {
        let shown_s = self.view().map_or(0.0, |view| view.frame.time_s);
        // Two entries at one time are an error; a new one goes beside.
        let taken = pilot_program::entries(&self.project.documents)
            .iter()
            .any(|entry| entry.trigger == "at" && entry.begin_s == Some(shown_s));
        let time_s = if taken { shown_s + 0.5 } else { shown_s };
        let mut added = None;
        self.project.documents.alter(Documents::SCENARIO, |document| {
            added = Some(pilot_program::add(document, time_s)?);
            Ok(())
        })?;
        self.events.extend(added.map(Event::EntryAdded));
        Ok(())
    }

    pub(crate) fn delete_entry(&mut self, index: usize) -> Result<(), String> {
        self.project.documents.alter(Documents::SCENARIO, |document| {
            document.remove_table(pilot_program::LIST, index).map_err(|error| error.to_string())
        })
    }
}

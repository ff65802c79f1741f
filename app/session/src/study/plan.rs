//! An option of a study as a plan: the fields that it sets and removes, the scenario and library with these changes, and what it differs in
//! from the baseline.

use std::collections::BTreeSet;

use endline_gear::{
    Diagnostic, Document, EditError, Law, Level, OptionSetting, Prior, Sources, Study, StudyOption,
    library_field,
};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::{Prepared, Source, set_field};

use super::exposure::{self, GearPlace};
use crate::encounters::equilibria::is_drawn_for_gear;
use crate::encounters::priors::{field_of, put_drawn};
use crate::encounters::{Drawn, Encounter};

/// An option as a scenario and a library.
pub struct OptionPlan {
    /// Id.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// Strength that it represents [N].
    pub strength_n: Option<f64>,
    /// Which curve of break-away against strength it belongs to.
    pub curve: Option<String>,
    /// Whether its runs end where something parts.
    pub until_parted: bool,
    /// Paths of all it sets, of scenario and library.
    pub(super) own: Vec<String>,
    /// These paths with their values, as text of a file.
    pub(super) sets: Vec<(String, String)>,
    pub(super) settings: Vec<OptionSetting>,
    pub(super) removes: Vec<String>,
    /// The baseline scenario, before anything is set.
    pub(super) scenario: Document,
    /// The scenario with what the option sets and removes, without drawn values.
    own_scenario: Document,
    pub(super) scenario_name: String,
    pub(super) sources: Sources,
    /// Places of its gear, in a study with `[exposure]`.
    pub(super) places: Vec<GearPlace>,
    /// The option without drawn values, for its library files and its plugins.
    pub prepared: Prepared,
}

impl OptionPlan {
    /// What it differs in from another option, as dotted paths without the numbers of lists, such as `line.delivered_strength`: equal changes
    /// of several lines are one difference. A table that only one of the options has is one too.
    pub fn differs_in(&self, other: &Self) -> Vec<String> {
        let fields =
            [self, other].into_iter().flat_map(|option| option.own.iter().chain(&option.removes));
        let differing: BTreeSet<String> =
            fields.filter_map(|field| self.difference(other, field)).collect();
        differing.into_iter().collect()
    }

    /// The shortest path to a field at which two options differ; `None` if it is the same in both.
    fn difference(&self, other: &Self, field: &str) -> Option<String> {
        let (file, path) =
            library_field(field).map_or((None, field), |(file, path)| (Some(file), path));
        let [own, others] = [self, other].map(|option| option.document(file.as_deref()));
        let (own, others) = (own?, others?);
        let within = path.match_indices('.').map(|(dot, _)| &path[..dot]).chain([path]);
        let apart = within.into_iter().find(|part| own.has(part) != others.has(part));
        let apart = apart.or_else(|| (own.get(path) != others.get(path)).then_some(path))?;
        let names = apart.split('.').filter(|part| part.parse::<usize>().is_err());
        let item = file.iter().map(|file| file.trim_end_matches(".toml"));
        Some(item.chain(names).collect::<Vec<_>>().join("."))
    }

    /// Its scenario, or a file of its library.
    fn document(&self, file: Option<&str>) -> Option<Document> {
        match file {
            None => Some(self.own_scenario.clone()),
            Some(file) => Document::parse(self.sources.get(file)?).ok(),
        }
    }

    /// The baseline scenario and the library with the drawn values, and with the settings and removals of the option.
    /// Errors: a field that cannot be set or removed.
    pub(super) fn edited<'a>(
        &self,
        drawn: impl Iterator<Item = (&'a Prior, &'a Drawn)>,
        is_wanted: impl Fn(&str) -> bool,
    ) -> Result<(Document, Sources), Error> {
        let (mut scenario, mut sources) = (self.scenario.clone(), self.sources.clone());
        put_drawn(&mut scenario, &mut sources, drawn, &self.own)?;
        let fault =
            |error: EditError| Error::Message(format!("option `{}`: {}", self.id, error.message));
        for field in self.removes.iter().filter(|field| is_wanted(field)) {
            scenario.remove(field).map_err(fault)?;
        }
        for setting in self.settings.iter().filter(|setting| is_wanted(&setting.field.value)) {
            scenario.put(&setting.field.value, &setting.value).map_err(fault)?;
        }
        Ok((scenario, sources))
    }
}

/// Paths of all an option sets.
fn own(option: &StudyOption) -> Vec<String> {
    option.settings.iter().map(|setting| setting.field.value.clone()).collect()
}

/// The baseline that options change.
pub(super) struct Base<'a> {
    /// The study that has the options.
    pub study: &'a Study,
    /// File of the baseline scenario.
    pub name: String,
    /// Text of the baseline scenario.
    pub text: String,
    /// Files of the library.
    pub sources: &'a Sources,
    /// The plugins.
    pub host: &'a PluginHost,
}

impl Base<'_> {
    /// The plan of an option, checked by assembling it.
    pub fn option(&self, option: &StudyOption) -> Result<OptionPlan, Error> {
        let scenario = Document::parse(&self.text)
            .map_err(|error| Error::Message(format!("{}: {}", self.name, error.message)))?;
        let mut sources = self.sources.clone();
        let mut edited = scenario.clone();
        self.put(option, &mut edited, &mut sources)?;
        let drawn = Encounter::of(self.study, 0).drawn;
        let places = match self.study.exposure {
            Some(_) => exposure::places(&self.name, &edited).map_err(|error| {
                error.for_each_problem(|problem| self.relocate(option, problem))
            })?,
            None => Vec::new(),
        };
        let prepared = self
            .prepare(option, (&edited, &sources), &drawn)
            .map_err(|error| error.for_each_problem(|problem| self.relocate(option, problem)))?;
        let settings = option
            .settings
            .iter()
            .filter(|setting| setting.library_field().is_none())
            .cloned()
            .collect();
        Ok(OptionPlan {
            id: option.id.value.clone(),
            name: option.name.clone(),
            strength_n: option.strength_n,
            curve: option.curve.clone(),
            until_parted: option.until_parted,
            own: own(option),
            sets: option
                .settings
                .iter()
                .map(|setting| (setting.field.value.clone(), setting.value.written()))
                .collect(),
            settings,
            removes: option.removes.iter().map(|field| field.value.clone()).collect(),
            scenario,
            own_scenario: edited,
            scenario_name: self.name.clone(),
            sources,
            places,
            prepared,
        })
    }

    fn put(
        &self,
        option: &StudyOption,
        scenario: &mut Document,
        sources: &mut Sources,
    ) -> Result<(), Error> {
        for field in &option.removes {
            let help = "name a field of the baseline scenario";
            scenario
                .remove(&field.value)
                .map_err(|error| field.place.error(error.message, help))?;
        }
        for setting in &option.settings {
            set_field(scenario, sources, &setting.field.value, &setting.value)
                .map_err(|error| setting.field.place.error(error.message, error.help))?;
        }
        Ok(())
    }

    /// Assembles an option with each word that a prior of the gear can draw, such as the id of an assembly. Words of the whale, such as
    /// acts, take as long to assemble and are checked where they are drawn.
    /// Errors: every problem, at the prior that draws the word.
    pub fn check_words(&self, option: &StudyOption) -> Result<(), Error> {
        let mut scenario = Document::parse(&self.text)
            .map_err(|error| Error::Message(format!("{}: {}", self.name, error.message)))?;
        let mut sources = self.sources.clone();
        self.put(option, &mut scenario, &mut sources)?;
        let usual = Encounter::of(self.study, 0).drawn;
        let mut problems = Vec::new();
        let for_gear = self.study.priors.iter().enumerate();
        for (index, prior) in for_gear.filter(|(_, prior)| is_drawn_for_gear(prior)) {
            let Law::Choice(levels) = &prior.law else { continue };
            let words = levels.iter().map(|(level, _)| level);
            let is_new = |level: &&Level| level.number.is_none() && level.text != usual[index].text;
            for Level { text, plain, .. } in words.filter(is_new) {
                let mut drawn = usual.clone();
                drawn[index] = Drawn { text: text.clone(), plain: *plain, ..drawn[index].clone() };
                let found = self.prepare(option, (&scenario, &sources), &drawn);
                let at_prior = |problem: Diagnostic| {
                    let message = format!("value `{text}`: {} ({})", problem.message, problem.file);
                    prior.name.place.error(message, problem.help)
                };
                match found.map_err(|error| error.for_each_problem(at_prior)) {
                    Err(Error::Diagnostics(found)) => problems.extend(found),
                    found => drop(found?),
                }
            }
        }
        if problems.is_empty() { Ok(()) } else { Err(Error::Diagnostics(problems)) }
    }

    /// An option assembled with these drawn values in the place of what it leaves open, so that drawn values are checked too.
    fn prepare(
        &self,
        option: &StudyOption,
        (scenario, sources): (&Document, &Sources),
        drawn: &[Drawn],
    ) -> Result<Prepared, Error> {
        let (mut text, mut sources) = (scenario.clone(), sources.clone());
        put_drawn(&mut text, &mut sources, self.study.priors.iter().zip(drawn), &own(option))?;
        if self.study.exposure.is_some() {
            // Of the gear, one is simulated at a time.
            let places = exposure::places(&self.name, &text)?;
            exposure::leave_only(&mut text, &places[0])?;
        }
        Source::new(&self.name, text.text(), sources).prepare_for_study(self.host)
    }

    /// A problem of an option's texts, located at the setting that causes it. These texts are in no file, so that their lines
    /// would lead nowhere: where no setting is to blame, the option is.
    fn relocate(&self, option: &StudyOption, problem: Diagnostic) -> Diagnostic {
        let by_option = option.settings.iter().find(|setting| match setting.library_field() {
            Some((file, field)) => problem.file == file && meet(field, &problem.field),
            None => problem.file == self.name && meet(&setting.field.value, &problem.field),
        });
        let by_prior =
            || self.study.priors.iter().find(|prior| meet(field_of(prior), &problem.field));
        let is_changed = || !option.settings.is_empty() || !option.removes.is_empty();
        let place = by_option
            .map(|setting| &setting.field.place)
            .or_else(|| Some(&by_prior()?.name.place))
            .or_else(|| is_changed().then_some(&option.id.place));
        place.map_or_else(
            || problem.clone(),
            |place| {
                let at = match problem.field.is_empty() {
                    true => problem.file.clone(),
                    false => format!("{}, {}", problem.file, problem.field),
                };
                let message = format!("option `{}`: {} ({at})", option.id.value, problem.message);
                place.error(message, problem.help.clone())
            },
        )
    }
}

/// Whether one of two dotted paths leads to the other, or into it.
fn meet(one: &str, other: &str) -> bool {
    let within = |outer: &str, inner: &str| {
        inner.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    !one.is_empty() && !other.is_empty() && (within(one, other) || within(other, one))
}

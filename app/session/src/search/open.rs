//! A story as a run in a window, and as a scenario of its own.

use endline_gear::{Document, EditError, Setting};

use crate::encounters::Encounter;
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::Prepared;
use crate::study::prepare::until;

use super::question::Question;
use super::stories::Story;

/// How long a story is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// To the moment at which the search held it against the observation.
    Ended,
    /// To the end of the scenario: to be steered by hand on the way, or followed further.
    Whole,
}

impl Question {
    /// The model of a story.
    ///
    /// # Errors
    /// Where its scenario cannot be assembled.
    pub fn prepare(
        &self,
        story: &Story,
        length: Length,
        host: &PluginHost,
    ) -> Result<Prepared, Error> {
        let prepared = self.encounter(story)?;
        match length {
            Length::Ended => until(&prepared, story.simulated_s, host),
            Length::Whole => (*prepared.source).clone().prepare(host),
        }
    }

    /// A story as the text of a scenario, with the paths of library files that it has otherwise than the library.
    ///
    /// # Errors
    /// Where its scenario cannot be assembled.
    pub fn scenario(&self, story: &Story) -> Result<(String, Vec<String>), Error> {
        let failed = |error: EditError| Error::Replay(error.message);
        let prepared = self.encounter(story)?;
        let mut scenario = Document::parse(&prepared.source.scenario).map_err(failed)?;
        let acts = story.acts_in_words();
        let name = format!(
            "{}: first the {}, {acts}",
            self.observation.name,
            story.first_part.replace('_', " ")
        );
        scenario.put("name", &Setting::text(&name)).map_err(failed)?;
        let notes = format!(
            "An encounter that a search found among those of {}. Its ending is {:.2} away from what was seen.",
            self.opened.study.name, story.distance
        );
        scenario.put("notes", &Setting::text(&notes)).map_err(failed)?;
        let other = prepared.source.library.iter().filter(|(path, text)| {
            self.opened.library_text(path).is_some_and(|shipped| shipped != *text)
        });
        let other = other.map(|(path, _)| path.to_owned()).collect();
        Ok((scenario.text(), other))
    }

    fn encounter(&self, story: &Story) -> Result<Prepared, Error> {
        self.opened.prepare(0, &Encounter::at_point(&self.opened.study, &story.point))
    }
}

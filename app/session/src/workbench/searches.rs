//! The search of a user: its observation, the search at work, and the stories found.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_sim::whale::Skin;

use super::Workbench;
use super::model::Then;
use super::notice::Notice;
use crate::campaign::{State, pool};
use crate::edit::{Documents, observation};
use crate::save;
use crate::search::job::{self, SearchJob, SearchRequest};
use crate::search::question::Length;
use crate::search::{Question, Story};
use crate::task::{Fault, Task};

/// Default limit of runs.
const TRIALS: usize = 1000;

/// Default number of neighbours of each story.
const NEIGHBOURS: usize = 12;

/// The animal drawn where the observation names none.
const WHALE: &str = "right-whale";

/// A scenario that was kept: its file, and library files that its story has otherwise than the library.
type Kept = (PathBuf, Vec<String>);

/// How long to search, and with what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SearchEffort {
    /// Runs at most.
    pub trials: usize,
    /// Threads.
    pub threads: usize,
    /// Neighbours run of every story that is like the observation.
    pub neighbours: usize,
    /// Whether it runs at normal priority rather than the lowest.
    pub normal_priority: bool,
}

impl Default for SearchEffort {
    fn default() -> Self {
        let threads = pool::default_count();
        Self { trials: TRIALS, threads, neighbours: NEIGHBOURS, normal_priority: false }
    }
}

/// The search at work, and how long to search.
#[derive(Default)]
pub struct Searches {
    /// The search at work, or the one whose stories are shown.
    pub job: Option<SearchJob>,
    /// How long to search, and with what.
    pub effort: SearchEffort,
    /// Folder that searches are kept in; `results` where the program was started, without one.
    pub folder: Option<PathBuf>,
    keeping: Task<Result<Kept, String>>,
}

impl Searches {
    /// The search that runs or is paused; one that only reads what is there is none.
    pub fn at_work(&self) -> Option<&SearchJob> {
        self.job.as_ref().filter(|job| job.is_unfinished() && !job.request.only_reads)
    }
}

impl Workbench {
    /// Takes in what was kept.
    pub(super) fn refresh_searches(&mut self) {
        let Some(kept) = self.searches.keeping.poll() else { return };
        let kept = kept.unwrap_or_else(|Fault| {
            Err("keeping the story ended by a fault inside the program".to_owned())
        });
        self.notice = Some(match kept {
            Ok((file, other)) if other.is_empty() => {
                Notice::done(format!("kept as {}", file.display()))
            }
            Ok((file, other)) => Notice::hint(format!(
                "kept as {}; the story has other values of {} than the library",
                file.display(),
                other.join(", ")
            )),
            Err(reason) => Notice::fault(reason),
        });
    }

    /// Whether neither the open observation nor the gear has an error.
    pub fn observation_is_sound(&self) -> bool {
        let documents = &self.project.documents;
        !documents.file_has_error(Documents::OBSERVATION) && !documents.any_error()
    }

    /// Whether the stories shown are of another observation than the open one as it stands.
    pub fn stories_are_of_another(&self) -> bool {
        let text = self.project.documents.text(Documents::OBSERVATION);
        self.searches.job.as_ref().is_some_and(|job| Some(job.request.text.as_str()) != text)
    }

    /// Skin of the animal of the open observation, at the length of its file.
    pub fn observed_skin(&self) -> Option<Arc<Skin>> {
        let documents = &self.project.documents;
        let id = documents.field(Documents::OBSERVATION, "whale");
        let id = id.as_deref().unwrap_or(WHALE);
        let whales = &documents.library().whales;
        let whale = whales.iter().find(|whale| whale.entry.id == id).or(whales.first())?;
        Some(whale.skin_for(whale.form.length_m, 1.0, false))
    }

    /// Opens an observation for editing, and the stories that were found for it.
    pub(crate) fn open_observation(&mut self, path: &Path) -> Result<(), String> {
        self.leave_observation()?;
        self.project.documents.open_observation(path)?;
        self.read_search();
        Ok(())
    }

    /// Opens a new observation beside those of the library.
    pub(crate) fn new_observation(&mut self) -> Result<(), String> {
        self.leave_observation()?;
        let file = self.project.documents.new_observation(observation::NEW)?;
        self.notice = Some(Notice::done(format!("a new observation: {}", file.display())));
        self.read_search();
        Ok(())
    }

    /// Opens a copy of the open observation beside those of the library.
    pub(crate) fn duplicate_observation(&mut self) -> Result<(), String> {
        let copy = self.project.documents.duplicate_observation()?;
        self.notice = Some(Notice::done(format!("a copy: {}", copy.display())));
        self.read_search();
        Ok(())
    }

    fn leave_observation(&self) -> Result<(), String> {
        let documents = &self.project.documents;
        let unsaved =
            documents.observation_path().is_some() && documents.is_unsaved(Documents::OBSERVATION);
        if unsaved {
            let reason = "the open observation has unsaved edits; save or undo them first";
            return Err(reason.to_owned());
        }
        Ok(())
    }

    /// Reads what an earlier search for the open observation has left, unless it has errors or a search is at work.
    fn read_search(&mut self) {
        if self.searches.at_work().is_some() {
            return;
        }
        let (host, waker) = self.helpers();
        let request = self.search_request().filter(|_| self.observation_is_sound());
        self.searches.job = request.map(|request| {
            SearchJob::search(SearchRequest { only_reads: true, ..request }, &host, &waker)
        });
    }

    /// What a search for the open observation asks for; `None` where none is open.
    fn search_request(&self) -> Option<SearchRequest> {
        let (documents, searches) = (&self.project.documents, &self.searches);
        Some(SearchRequest {
            file: documents.observation_path()?.to_owned(),
            text: documents.text(Documents::OBSERVATION)?.to_owned(),
            files: self.project.files(),
            study: documents.study_path().zip(documents.text(Documents::STUDY)).map(owned),
            root: searches.folder.clone().unwrap_or_else(|| PathBuf::from("results")),
            trials: searches.effort.trials,
            threads: searches.effort.threads,
            neighbours: searches.effort.neighbours,
            normal_priority: searches.effort.normal_priority,
            only_reads: false,
        })
    }

    /// Starts or continues the search for the open observation, on the texts as they are edited. Nothing is saved.
    pub(crate) fn run_search(&mut self) -> Result<(), String> {
        let request = self.search_request().ok_or("open an observation first")?;
        let (host, waker) = self.helpers();
        self.searches.job = Some(SearchJob::search(request, &host, &waker));
        self.say_unsaved("the search");
        Ok(())
    }

    /// Pauses or continues the running search.
    pub(crate) fn pause_search(&mut self) -> Result<(), String> {
        let job = self.searches.at_work().ok_or("no search is at work")?;
        if job.state() == State::Paused {
            job.resume()
        } else {
            job.pause()
        }
        Ok(())
    }

    /// Ends the search at work; what was run stays.
    pub(crate) fn cancel_search(&mut self) -> Result<(), String> {
        self.searches.at_work().ok_or("no search is at work")?.cancel();
        Ok(())
    }

    /// Runs a story, to its ending in the search or to the end of its scenario.
    pub(crate) fn run_story(&mut self, story: usize, length: Length) -> Result<(), String> {
        let (question, found) = self.story(story)?;
        self.keep_run();
        let host = Arc::clone(&self.plugins.host);
        let name = format!("{}, story {}", question.observation.name, story + 1);
        self.make_guest(name, Then::Start, move || question.prepare(&found, length, &host))
    }

    /// Writes a story as a scenario of the library.
    pub(crate) fn keep_story(&mut self, number: usize) -> Result<(), String> {
        let (question, story) = self.story(number)?;
        let folder = self.project.documents.root().join("scenarios");
        let stem = format!("{}-story", question.observation.id);
        let work = move || {
            let (text, other) = question.scenario(&story).map_err(|error| error.to_string())?;
            let named = |number: u32| folder.join(format!("{stem}-{number}.toml"));
            let mut files = (1..10_000).map(named);
            let file = files.find(|file| !file.exists()).ok_or("there are 10,000 already")?;
            save::atomically(&file, text.as_bytes())
                .map_err(|error| format!("{}: {error}", file.display()))?;
            Ok((file, other))
        };
        let (_, waker) = self.helpers();
        self.searches
            .keeping
            .start("endline-keep-story", work, waker)
            .map_err(|error| error.to_string())
    }

    fn story(&self, number: usize) -> Result<(Arc<Question>, Story), String> {
        let found = self.searches.job.as_ref().map(SearchJob::found).unwrap_or_default();
        let story = found.stories.and_then(|found| found.stories.get(number).cloned());
        found.question.zip(story).ok_or_else(|| "there is no such story".to_owned())
    }

    /// The command line that searches for the open observation; `None` where none is open.
    pub fn search_command_line(&self) -> Option<String> {
        let request = self.search_request()?;
        let own = self.searches.job.as_ref().filter(|job| job.request.text == request.text);
        let usual = || {
            request.root.join(format!(
                "search-{}",
                request.file.file_stem().unwrap_or_default().to_string_lossy()
            ))
        };
        let folder = own.and_then(|job| job.found().folder).unwrap_or_else(usual);
        Some(job::command_line(&request, &folder))
    }
}

fn owned((path, text): (&Path, &str)) -> (PathBuf, String) {
    (path.to_owned(), text.to_owned())
}

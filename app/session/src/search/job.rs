//! A search behind a window: opened, run and reported on threads of its own, paused, cancelled and resumed.
//!
//! Its rounds are stored in a folder named after the observation and the hash of the search. An edited observation therefore begins a
//! folder of its own, and a cancelled search continues from its folder.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::campaign::job::{AtWork, Job, State};
use crate::campaign::pool::Shard;
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::shell;
use crate::study::Files;
use crate::task::Waker;

use super::folder::Folder;
use super::question::Question;
use super::stories::Stories;
use super::{DEFAULT_NET, Effort, page, search};

/// Folder of the draws that all searches of a root share, so that an edited observation costs local searches only.
const NET: &str = "net";

/// A search to be run, or to be read.
#[derive(Clone, Debug)]
pub struct SearchRequest {
    /// The observation's file.
    pub file: PathBuf,
    /// Its text: what is searched for.
    pub text: String,
    /// The library, and the open scenario.
    pub files: Files,
    /// File and text of the open study.
    pub study: Option<(PathBuf, String)>,
    /// Folder that holds the folders of searches.
    pub root: PathBuf,
    /// Runs at most.
    pub trials: usize,
    /// Threads.
    pub threads: usize,
    /// Neighbours of every story that is like the observation.
    pub neighbours: usize,
    /// Whether it runs at normal priority rather than the lowest.
    pub normal_priority: bool,
    /// Whether the results of an earlier search of the same observation are read, and nothing is run.
    pub only_reads: bool,
}

/// The results of a search so far.
#[derive(Clone, Default)]
pub struct SearchFound {
    /// The question, once it is opened.
    pub question: Option<Arc<Question>>,
    /// The folder, once it is opened.
    pub folder: Option<PathBuf>,
    /// Runs of the rounds that are done.
    pub trials: usize,
    /// The least distance so far.
    pub best: Option<f64>,
    /// The stories so far.
    pub stories: Option<Arc<Stories>>,
}

/// A search at work, or what an earlier one has found.
pub type SearchJob = Job<SearchRequest, SearchFound>;

impl SearchJob {
    /// Begins a search on a thread of its own; the waker is called at every change.
    pub fn search(request: SearchRequest, host: &Arc<PluginHost>, waker: &Waker) -> Self {
        let job = Self::new(request, Arc::clone(waker));
        if job.request.only_reads {
            job.cancel();
        }
        let (request, host) = (job.request.clone(), Arc::clone(host));
        job.begin("search", request.normal_priority, move |job| run(job, &request, &host));
        job
    }

    /// The report, where it is written.
    pub fn report(&self) -> Option<PathBuf> {
        let folder = self.found().folder?;
        Some(folder.join("report.html")).filter(|file| file.is_file())
    }
}

/// Opens the question, runs what is missing and writes the report.
fn run(
    job: &AtWork<SearchFound>,
    request: &SearchRequest,
    host: &PluginHost,
) -> Result<State, Error> {
    let SearchRequest { file, text, files, study, only_reads, .. } = request;
    let question = Question::of_sources((file, text), None, files.clone(), study.as_ref(), host)?;
    let question = Arc::new(question);
    let path = Folder::path_under(&request.root, &question);
    job.found(|found| found.question = Some(Arc::clone(&question)));
    // A search that was never run has no folder, and reading must not make one.
    if *only_reads && !Folder::is_there(&path) {
        return Ok(State::Cancelled);
    }
    let folder = Folder::open(&path, Some(&request.root.join(NET)), &question)?;
    job.found(|found| found.folder = Some(folder.path.clone()));
    job.enter(State::Running);
    let stories = search(&question, &folder, &effort(request), &job.control, |round| {
        job.found(|found| {
            (found.trials, found.best) = (round.trials, round.best);
            found.stories = Some(Arc::new(round.stories));
        });
        if round.trials >= round.of {
            job.enter(State::Finishing);
        }
    })?;
    page::write(&question, &folder, &stories)?;
    job.found(|found| found.stories = Some(Arc::new(stories)));
    Ok(if job.control.is_cancelled() { State::Cancelled } else { State::Done })
}

/// The requested effort; a job that only reads takes all stored rounds.
fn effort(request: &SearchRequest) -> Effort {
    Effort {
        trials: if request.only_reads { usize::MAX } else { request.trials },
        threads: request.threads,
        shard: Shard::WHOLE,
        neighbours: request.neighbours,
        net: DEFAULT_NET,
    }
}

/// The command line that searches as asked for, in a folder.
pub fn command_line(request: &SearchRequest, folder: &Path) -> String {
    let SearchRequest { file, files, root, trials, neighbours, .. } = request;
    let [file, library, folder, net] =
        [file, &files.root, folder, &root.join(NET)].map(shell::path);
    format!(
        "endline search {file} --library {library} --trials {trials} --neighbours {neighbours} --out {folder} --net-folder {net}"
    )
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    use endline_gear::Sources;

    use super::super::tests::place;
    use super::*;
    use crate::study::tests::Place;

    fn request(place: &Place, trials: usize) -> SearchRequest {
        let library = place.library();
        let file = library.join("observations/made-up.toml");
        SearchRequest {
            text: std::fs::read_to_string(&file).unwrap(),
            root: place.0.join("searches"),
            file,
            files: Files {
                sources: Sources::from_folder(&library).unwrap(),
                root: library,
                scenario: None,
            },
            study: None,
            trials,
            threads: 2,
            neighbours: 0,
            normal_priority: true,
            only_reads: false,
        }
    }

    fn begin(request: SearchRequest) -> SearchJob {
        SearchJob::search(request, &Arc::new(PluginHost::empty()), &waker())
    }

    fn read(request: SearchRequest) -> SearchJob {
        begin(SearchRequest { only_reads: true, ..request })
    }

    fn waker() -> Waker {
        Arc::new(|| {})
    }

    fn ended(job: &SearchJob) -> State {
        let patience = Instant::now() + Duration::from_secs(60);
        while job.is_unfinished() {
            assert!(
                Instant::now() < patience,
                "waited in vain: {:?}, {:?}",
                job.state(),
                job.progress()
            );
            std::thread::sleep(Duration::from_millis(5));
        }
        job.state()
    }

    #[test]
    fn a_search_runs_to_its_end_and_is_read_again() {
        let place = place("job");
        let job = read(request(&place, 64));
        assert_eq!(ended(&job), State::Cancelled);
        assert!(job.found().stories.is_none() && !place.0.join("searches").exists());

        let job = begin(request(&place, 64));
        assert_eq!(ended(&job), State::Done);
        let found = job.found();
        assert_eq!((found.trials, found.stories.as_ref().unwrap().net), (64, 64));
        assert!(job.report().is_some());
        let read = read(request(&place, 64));
        assert_eq!(ended(&read), State::Cancelled);
        assert_eq!(read.found().stories, found.stories);
    }

    #[test]
    fn a_paused_search_does_not_advance_and_a_cancelled_one_continues_later() {
        let place = place("job-paused");
        let job = begin(request(&place, 96));
        job.pause();
        assert_eq!(job.state(), State::Paused);
        job.cancel();
        assert_eq!(ended(&job), State::Cancelled);
        let run = job.progress().encounters.done;
        assert!(run < 96, "{run}");
        let job = begin(request(&place, 96));
        assert_eq!(ended(&job), State::Done);
        assert_eq!(job.progress().encounters.total, 0, "no story, no neighbour");
        assert_eq!(job.found().trials, 96);
    }

    #[test]
    fn an_error_of_an_observation_names_its_file() {
        let place = place("job-wrong");
        let wrong = SearchRequest { text: "format = 1\n".into(), ..request(&place, 32) };
        let State::Failed(why) = ended(&begin(wrong)) else { panic!() };
        assert!(why.contains("made-up.toml"), "{why}");
    }
}

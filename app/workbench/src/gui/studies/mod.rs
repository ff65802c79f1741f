//! Studies in the window: the queue of those at work, and the results shown.
//!
//! A study runs on threads of its own behind everything else, one core left to the window. Its blocks of encounters lie in
//! a folder named after the study and the hash of what defines its runs, so that an edited study begins a folder of its own
//! and one that was left off goes on.

pub mod job;
mod results;

use std::path::{Path, PathBuf};

use endline_session::edit::Documents;
use endline_session::study::Opened;
use endline_session::study::encounter::Encounter;
use endline_session::{Error, PluginHost, Prepared};

pub use results::{Asked, Results, Shown};

use super::desk::{Desk, Order};
use job::Job;

/// What the panels of studies share.
#[derive(Default)]
pub struct Studies {
    /// Studies waiting, at work, and done, in the order they were queued.
    pub jobs: Vec<Job>,
    /// The results shown.
    pub results: Results,
    /// Folder that results are kept in; `results` where the program was started, without one.
    pub folder: Option<PathBuf>,
    /// Whether studies run at ordinary priority, not behind everything else on the machine.
    pub eager: bool,
    /// The library's scenarios when the study was opened: id twice, as choices want it.
    pub scenarios: Vec<(String, String)>,
}

impl Studies {
    /// Folder that results are kept in.
    #[must_use]
    pub fn root(&self) -> PathBuf {
        self.folder.clone().unwrap_or_else(|| PathBuf::from("results"))
    }

    /// The job at work or paused.
    #[must_use]
    pub fn current(&self) -> Option<&Job> {
        self.jobs
            .iter()
            .find(|job| job.at_work())
            .or_else(|| self.jobs.iter().find(|job| job.unfinished()))
    }
}

/// The folder of a study's results under a root: its id and the head of its hash.
#[must_use]
pub fn folder_of(root: &Path, opened: &Opened) -> PathBuf {
    root.join(format!("{}-{}", opened.study.id, opened.hash.get(..8).unwrap_or(&opened.hash)))
}

/// Once a frame: begins the next study that waits, and takes in results.
pub fn tick(desk: &mut Desk) {
    let (host, waker) = desk.helpers();
    let busy = desk.studies.jobs.iter().any(Job::at_work);
    if !busy && let Some(next) = desk.studies.jobs.iter_mut().find(|job| job.waits()) {
        next.begin(&host, &waker, desk.studies.eager);
    }
    if let Some(Err(error)) = desk.studies.results.take() {
        desk.notice = Some((error, true));
    }
    if desk.studies.results.follows_next
        && let Some(folder) = desk.studies.jobs.last().and_then(Job::folder)
    {
        desk.studies.results.follow(folder);
    }
    follow(desk);
}

/// Results of the job shown are read again as it goes on.
fn follow(desk: &mut Desk) {
    let Some(shown) = desk.studies.results.followed() else { return };
    let job = desk.studies.jobs.iter().find(|job| job.folder().as_deref() == Some(shown));
    let Some((opened, blocks, over)) =
        job.and_then(|job| Some((job.opened()?, job.progress().blocks, !job.at_work())))
    else {
        return;
    };
    if desk.studies.results.is_due(blocks, over) {
        let folder = shown.to_owned();
        ask(desk, Asked { folder: Some(folder), opened: Some(opened), blocks, ..Asked::default() });
    }
}

/// Asks for results to be read in the background.
pub fn ask(desk: &mut Desk, asked: Asked) {
    let (host, waker) = desk.helpers();
    let asked =
        Asked { library: desk.documents.root().to_owned(), root: desk.studies.root(), ..asked };
    if let Err(error) = desk.studies.results.ask(asked, host, waker) {
        desk.notice = Some((error, true));
    }
}

/// Opens a study for editing, and the results it already has.
pub fn open(desk: &mut Desk, path: &Path) {
    if desk.documents.study_path().is_some() && desk.documents.is_unsaved(Documents::STUDY) {
        desk.notice =
            Some(("the open study has unsaved edits; save or undo them first".into(), true));
        return;
    }
    if let Err(error) = desk.documents.open_study(path) {
        desk.notice = Some((error, true));
        return;
    }
    let id = |path: &PathBuf| {
        path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
    };
    desk.studies.scenarios = super::files::scenarios(desk.documents.root())
        .iter()
        .map(|path| (id(path), id(path)))
        .collect();
    ask(desk, Asked { file: Some(path.to_owned()), ..Asked::default() });
}

/// Shows the results in a folder.
pub fn open_results(desk: &mut Desk, folder: &Path) {
    ask(desk, Asked { folder: Some(folder.to_owned()), ..Asked::default() });
}

/// Queues the open study; its text is saved first, for the study is run from its file.
pub fn queue(desk: &mut Desk) {
    let Some(path) = desk.documents.study_path().map(Path::to_owned) else {
        desk.notice = Some(("open a study first".into(), true));
        return;
    };
    if desk.documents.file_has_error(Documents::STUDY) || desk.documents.any_error() {
        desk.notice = Some(("study or gear have errors; see Problems".into(), true));
        return;
    }
    if !desk.documents.unsaved().is_empty()
        && let Err(error) = desk.documents.save()
    {
        desk.notice = Some((format!("not saved, so not queued: {error}"), true));
        return;
    }
    if let Some(job) = desk.studies.jobs.iter().find(|job| job.file == path && job.unfinished()) {
        job.resume();
        desk.notice = Some(("this study is in the queue already".into(), false));
        return;
    }
    let name = desk
        .documents
        .field(Documents::STUDY, "name")
        .unwrap_or_else(|| path.display().to_string());
    desk.studies.jobs.retain(|job| job.file != path);
    let job = Job::new(path, name, desk.documents.root().to_owned(), desk.studies.root());
    desk.studies.jobs.push(job);
    desk.studies.results.follows_next = true;
}

/// Obeys an order about studies; does nothing of any other.
pub fn obey(desk: &mut Desk, order: &Order) {
    match order {
        Order::OpenStudy(path) => open(desk, path),
        Order::DuplicateStudy => duplicate(desk),
        Order::QueueStudy => queue(desk),
        Order::PauseStudy => pause(desk),
        Order::CancelStudy => cancel(desk),
        Order::OpenResults(folder) => open_results(desk, folder),
        _ => {}
    }
}

/// The study at work stands still, or goes on.
pub fn pause(desk: &mut Desk) {
    match desk.studies.current() {
        Some(job) if job.progress().state == job::State::Paused => job.resume(),
        Some(job) => job.pause(),
        None => desk.notice = Some(("no study is at work".into(), false)),
    }
}

/// Takes the study at work out of the queue.
pub fn cancel(desk: &mut Desk) {
    match desk.studies.current() {
        Some(job) => job.cancel(),
        None => desk.notice = Some(("no study is at work".into(), false)),
    }
}

/// Goes on with a copy of the open study beside those of the library.
pub fn duplicate(desk: &mut Desk) {
    let (Some(path), Some(text)) =
        (desk.documents.study_path(), desk.documents.text(Documents::STUDY).map(str::to_owned))
    else {
        desk.notice = Some(("open a study first".into(), true));
        return;
    };
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let folder = desk.documents.root().join("studies");
    let Some(fresh) = (2..1000)
        .map(|number| folder.join(format!("{stem}-{number}.toml")))
        .find(|path| !path.exists())
    else {
        return;
    };
    let written = endline_gear::Document::parse(&text).map_err(|error| error.message).and_then(
        |mut document| {
            let name = document.get("name").unwrap_or_default();
            document.set("name", &format!("{name} (copy)")).map_err(|error| error.message)?;
            std::fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
            document.save(&fresh).map_err(|error| error.to_string())
        },
    );
    match written.and_then(|()| desk.documents.open_study(&fresh)) {
        Ok(()) => desk.notice = Some((format!("a copy: {}", fresh.display()), false)),
        Err(error) => desk.notice = Some((format!("{}: {error}", fresh.display()), true)),
    }
}

/// A run of the results shown, made again: it ends where it ended in the study.
pub fn again(
    shown: &Shown,
    option: usize,
    encounter: u32,
    host: &PluginHost,
) -> Result<Prepared, Error> {
    let prepared = shown.opened.prepare(option, &Encounter::of(&shown.opened, encounter))?;
    let (table, id) = (&shown.table, &shown.opened.options[option].id);
    let (encounters, options, ends) =
        (table.reals("encounter"), table.texts("option"), table.reals("simulated_s"));
    let row = (0..table.rows())
        .find(|row| encounters[*row] == Some(f64::from(encounter)) && options[*row] == *id);
    let Some(end_s) = row.and_then(|row| ends[row]) else { return Ok(prepared) };
    let mut source = (*prepared.source).clone();
    let fault = |error: endline_gear::EditError| Error::Replay(error.message);
    let mut scenario = endline_gear::Document::parse(&source.scenario).map_err(fault)?;
    scenario.put("duration", &endline_gear::Setting::text(&format!("{end_s} s"))).map_err(fault)?;
    source.scenario = scenario.text();
    source.prepare(host)
}

/// The command lines that run the open study and report it as the window does, and whether files must be saved before.
#[must_use]
pub fn command_line(desk: &Desk) -> Option<(String, bool)> {
    let path = desk.documents.study_path()?;
    let quoted = |path: &Path| format!("'{}'", path.display().to_string().replace('\'', "'\\''"));
    let job = desk.studies.jobs.iter().find(|job| job.file == path).and_then(Job::folder);
    let shown = desk
        .studies
        .results
        .shown()
        .filter(|shown| shown.opened.study.place.source.path == path.display().to_string());
    let folder = job.or_else(|| shown.map(|shown| shown.folder.clone()));
    let out = folder.map_or_else(String::new, |folder| format!(" --out {}", quoted(&folder)));
    let line = |verb: &str| {
        format!(
            "endline study {verb} {} --library {}{out}",
            quoted(path),
            quoted(desk.documents.root())
        )
    };
    Some((["run", "merge", "report"].map(line).join(" && "), !desk.documents.unsaved().is_empty()))
}

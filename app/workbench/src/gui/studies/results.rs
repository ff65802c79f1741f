//! The results shown: read and counted on a thread of their own, again and again while a study is at work.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

use endline_session::study::folder::{Folder, Label};
use endline_session::study::stats::Findings;
use endline_session::study::{Opened, Table, merge};
use endline_session::{Error, PluginHost};

use super::super::engine::Waker;

/// Time between two countings of a study at work.
const AGAIN: Duration = Duration::from_secs(4);

/// What is to be read.
#[derive(Clone, Default)]
pub struct Asked {
    /// The study's file; looked for by the folder's label where `None`.
    pub file: Option<PathBuf>,
    /// The study where it is open already.
    pub opened: Option<Arc<Opened>>,
    /// Folder of results; that of the study under `root` where `None`.
    pub folder: Option<PathBuf>,
    /// Folder of the gear library.
    pub library: PathBuf,
    /// Folder that results are kept in.
    pub root: PathBuf,
    /// Blocks that are known to be there.
    pub blocks: u32,
}

/// Results as they stood when they were read.
pub struct Shown {
    /// The study.
    pub opened: Arc<Opened>,
    /// Its folder.
    pub folder: PathBuf,
    /// Rows of the encounters that stand without a gap.
    pub table: Table,
    /// What was found in them.
    pub findings: Findings,
    /// Whether these are all the study wants.
    pub whole: bool,
}

type Answer = Result<Option<Arc<Shown>>, String>;

/// The results shown, and those being read.
#[derive(Default)]
pub struct Results {
    shown: Option<Arc<Shown>>,
    pending: Option<Receiver<Answer>>,
    /// Folder of the study whose progress is followed.
    folder: Option<PathBuf>,
    /// Blocks when they were last read, and when that was.
    read: Option<(u32, Instant)>,
    /// Whether the study queued last is to be shown once it has a folder.
    pub follows_next: bool,
    /// Why nothing is shown.
    pub problem: Option<String>,
}

impl Results {
    /// The results shown.
    #[must_use]
    pub fn shown(&self) -> Option<&Arc<Shown>> {
        self.shown.as_ref()
    }

    /// Whether some are being read.
    #[must_use]
    pub fn busy(&self) -> bool {
        self.pending.is_some()
    }

    /// The folder whose study is followed while it is at work.
    #[must_use]
    pub fn followed(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Follows the study of a folder.
    pub fn follow(&mut self, folder: PathBuf) {
        (self.folder, self.read, self.follows_next) = (Some(folder), None, false);
    }

    /// Whether it is time to read again, with so many blocks there.
    #[must_use]
    pub fn is_due(&self, blocks: u32, over: bool) -> bool {
        let fresh = self
            .read
            .is_none_or(|(before, at)| before != blocks && (over || at.elapsed() >= AGAIN));
        !self.busy() && blocks > 0 && fresh
    }

    /// Begins to read; what was being read is dropped.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub fn ask(&mut self, asked: Asked, host: Arc<PluginHost>, waker: Waker) -> Result<(), String> {
        self.read = Some((asked.blocks, Instant::now()));
        let (sender, receiver) = channel();
        let work = move || {
            // Nobody waits any more where the receiver is gone.
            let _ = sender.send(read(asked, &host).map_err(|error| error.to_string()));
            waker();
        };
        std::thread::Builder::new()
            .name("endline-results".into())
            .spawn(work)
            .map_err(|error| error.to_string())?;
        self.pending = Some(receiver);
        Ok(())
    }

    /// Takes in what was read; once a frame.
    pub fn take(&mut self) -> Option<Result<(), String>> {
        let answer = match self.pending.as_ref()?.try_recv() {
            Ok(answer) => answer,
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => {
                Err("reading the results ended by a fault inside the program".into())
            }
        };
        self.pending = None;
        Some(
            answer
                .map(|shown| {
                    if let Some(shown) = shown {
                        self.folder = Some(shown.folder.clone());
                        self.shown = Some(shown);
                    }
                    self.problem = None;
                })
                .inspect_err(|error| self.problem = Some(error.clone())),
        )
    }
}

fn read(asked: Asked, host: &PluginHost) -> Result<Option<Arc<Shown>>, Error> {
    let at_work = asked.opened.is_some();
    let opened = match (asked.opened, &asked.file, &asked.folder) {
        (Some(opened), _, _) => opened,
        (None, Some(file), _) => Arc::new(Opened::open(file, Some(&asked.library), host)?),
        (None, None, Some(folder)) => Arc::new(of_folder(folder, &asked.library, host)?),
        (None, None, None) => return Ok(None),
    };
    let path = asked.folder.unwrap_or_else(|| super::folder_of(&asked.root, &opened));
    // A study that was never run has no folder, and none is made for looking.
    if !path.join("study.json").is_file() {
        return Ok(None);
    }
    let folder = Folder::open(&path, &opened)?;
    let (table, whole) = rows(&opened, &folder, at_work)?;
    if table.rows() == 0 {
        return Ok(None);
    }
    let findings = Findings::of(&opened, &table);
    Ok(Some(Arc::new(Shown { opened, folder: path, table, findings, whole })))
}

/// The merged table, else the rows of the blocks that stand without a gap; and whether they are all.
fn rows(opened: &Opened, folder: &Folder, at_work: bool) -> Result<(Table, bool), Error> {
    if let (Ok(table), false) = (merge::load(opened, folder), at_work) {
        return Ok((table, true));
    }
    let mut table = Table::default();
    let there = (0..folder.blocks()).take_while(|block| folder.file_of(*block).is_file()).count();
    for block in 0..u32::try_from(there).unwrap_or_default() {
        table.append(folder.read(block)?);
    }
    Ok((table, there == folder.blocks() as usize))
}

/// The study a folder of results belongs to: of the bundle in it, else of the library.
fn of_folder(folder: &Path, library: &Path, host: &PluginHost) -> Result<Opened, Error> {
    let file = folder.join("study.json");
    let text = std::fs::read_to_string(&file)
        .map_err(|error| Error::at(&file, format!("no results of a study are here: {error}")))?;
    let label: Label = serde_json::from_str(&text)
        .map_err(|error| Error::at(&file, format!("is damaged: {error}")))?;
    let bundle = folder.join("bundle/study.toml");
    if bundle.is_file() {
        return Opened::open(&bundle, Some(&folder.join("bundle/gear-library")), host);
    }
    Opened::open(
        &library.join("studies").join(format!("{}.toml", label.study)),
        Some(library),
        host,
    )
}

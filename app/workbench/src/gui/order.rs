//! The closed list of what can be asked of the workbench: by menus, keys, palette and tests alike.

use std::path::PathBuf;

use endline_gear::Kind;
use endline_session::units::Units;

use super::layout::Layout;
use super::panel_id::PanelId;
use super::theme::Theme;
use crate::scene::{Picked, View};

/// A file dialog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialog {
    /// A scenario to open.
    Scenario,
    /// Another file to save the scenario to.
    ScenarioAs,
    /// A recording to open.
    Recording,
    /// A file to save the run so far to.
    SaveRecording,
    /// A study to open.
    Study,
    /// A folder of results to show.
    Results,
    /// A file to write the gear shown to as a 3-D model: `stl` or `glb`.
    ExportModel(&'static str),
    /// A file to write the plots shown to: `svg`, `png` or `csv`.
    ExportPlots(&'static str),
    /// A file to write the shown table of the library to.
    ExportTable,
    /// A table to take into the library.
    ImportTable,
}

/// All that can be asked of the workbench besides editing a text.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// Run on; first takes over edited gear.
    Start,
    /// Stand still.
    Pause,
    /// The one of the two that fits.
    PlayPause,
    /// One step.
    Step,
    /// Back to the settled gear.
    Reset,
    /// Take over edited gear and scenario, back at the start.
    Apply,
    /// Simulated seconds for each real one.
    Speed(f64),
    /// The next slower speed.
    Slower,
    /// The next faster speed.
    Faster,
    /// Show the moment nearest to a time [s].
    Seek(f64),
    /// So many kept moments later, or earlier.
    Shift(i64),
    /// Show the newest moment.
    Newest,
    /// Play what was run from the moment shown on, or stop.
    Replay,
    /// Open a file dialog; its answer gives the order that follows from it.
    Ask(Dialog),
    /// Write the plots shown, in the format of the file's ending.
    ExportPlots(PathBuf),
    /// Write the shown table of the library.
    ExportTable(PathBuf),
    /// Take a table into the library.
    ImportTable(PathBuf),
    /// Weak links on or off, in the scenario's text.
    WeakLinks,
    /// The pilot's hands on the whale, or off.
    Fly,
    /// First or third person.
    Person,
    /// The next act of the whale's motion.
    NextAct,
    /// The act of this index.
    ChooseAct(usize),
    /// The mouth open, or shut.
    Mouth,
    /// A named view of the 3-D drawing.
    Look(View),
    /// Everything into sight.
    Frame,
    /// So many views at once, one to four.
    Views(usize),
    /// Handles in the 3-D view to drag the whale's start by, or none.
    Pose,
    /// Clicks in the 3-D view measure, or read again.
    Ruler,
    /// Show the properties of a thing in the 3-D view.
    Read(Picked),
    /// Tell and measure nothing any more.
    LetGo,
    /// Put the command line that gives this run into the clipboard.
    CopyCommandLine,
    /// Show a table of the library.
    Table(Kind),
    /// Show an entry of the library in its table, by its file's path.
    Entry(String),
    /// Show an assembly by its id.
    Assembly(String),
    /// Copy the chosen entry of the library to a file of its own.
    Duplicate,
    /// Save every changed text.
    Save,
    /// Save the scenario to another file and go on with that.
    ScenarioAs(PathBuf),
    /// Save the run so far.
    SaveRecording(PathBuf),
    /// Open a scenario.
    Open(PathBuf),
    /// Load the plugins again: what was built anew counts from the next run on.
    ReloadPlugins,
    /// Let a plugin library be opened with the bytes of this hash.
    AllowPlugin(PathBuf, String),
    /// Switch a plugin on or off.
    SwitchPlugin(String, bool),
    /// Try a plugin file in a child process.
    CheckPlugin(PathBuf),
    /// Put a motion or a law of friction into the scenario.
    UsePlugin(String),
    /// Show a folder in the system's file manager.
    OpenFolder(PathBuf),
    /// Take the last edit back.
    Undo,
    /// Do it again.
    Redo,
    /// Write the gear shown as a 3-D model, in the format of the file's ending.
    ExportModel(PathBuf),
    /// Run a recording again and look at it.
    OpenRecording(PathBuf),
    /// Run again up to the moment shown, to go on from there in another way.
    Branch,
    /// Open a study.
    OpenStudy(PathBuf),
    /// Go on with a copy of the open study.
    DuplicateStudy,
    /// Run the open study, or go on with it.
    QueueStudy,
    /// The study at work stands still, or goes on.
    PauseStudy,
    /// Take the study at work out of the queue.
    CancelStudy,
    /// Put the command lines that run the open study into the clipboard.
    CopyStudyLine,
    /// Show the results in a folder.
    OpenResults(PathBuf),
    /// Run an encounter of the results shown again: place of the option, index of the encounter.
    ReplayEncounter(usize, u32),
    /// The run shown stays, to be compared with; the texts make a new one.
    HoldRun,
    /// Run a recording again beside the run shown.
    CompareWith(PathBuf),
    /// Compare no more.
    EndCompare,
    /// Add an entry to the pilot program at the moment shown.
    AddEntry,
    /// Take the chosen entry out of the pilot program.
    DeleteEntry,
    /// What was flown or steered in the run shown becomes the scenario's pilot program.
    EditInputs,
    /// The same inputs up to the moment shown, then the pilot program as it stands now.
    Rerun,
    /// Size of everything on screen.
    Size(f32),
    /// Dark, or light.
    Dress(Theme),
    /// Units on screen.
    Measure(Units),
    /// Take a panel away.
    Close(PanelId),
    /// Bring a panel to the front.
    Show(PanelId),
    /// A named layout.
    Arrange(Layout),
    /// The list of all orders, open or closed.
    Commands,
}

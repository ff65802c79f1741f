//! What a user asks of the window: commands of the workbench, and those that need a screen.

use std::path::{Path, PathBuf};

use endline_gear::Kind;
use endline_session::command::{
    Command, EditAction, ExportAction, PluginAction, RuleAction, RunAction, SearchAction,
    StudyAction, TimeAction,
};
use endline_session::units::Units;

use crate::documents::Document;
use crate::gui::layout::Layout;
use crate::gui::panel::PanelId;
use crate::gui::theme::Theme;
use crate::scene::{Picked, View};

/// What a user asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum WindowCommand {
    /// A command that needs no screen.
    Workbench(Command),
    /// Look around in the 3-D view.
    View(ViewAction),
    /// Steer the whale by hand.
    Flight(FlightAction),
    /// What is shown and chosen in panels.
    Panel(PanelAction),
    /// The window as a whole.
    Window(WindowAction),
}

/// An action in the 3-D view.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewAction {
    /// Look from a named place.
    Look(View),
    /// Bring everything into sight.
    Frame,
    /// Shows a number of views at once, one to four.
    Split(usize),
    /// Show or hide the handles that drag the whale's start.
    Pose,
    /// Clicks measure, or inspect again.
    Ruler,
    /// Show the figures of a thing.
    Inspect(Picked),
    /// Inspect and measure nothing any more.
    LetGo,
    /// Write what the chosen pane shows as a PNG file.
    SavePicture(PathBuf),
    /// Write the run as the chosen pane shows it as a film: GIF, MP4 or WebM by the file's extension.
    SaveFilm(PathBuf),
    /// End the film that is being made.
    CancelFilm,
    /// Set a key of the camera: what the chosen pane shows, at the moment shown.
    SetKey,
    /// Take the keys of the camera away.
    ClearKeys,
}

/// An action of the pilot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlightAction {
    /// Take the controls of the whale, or leave them to the pilot program.
    Toggle,
    /// First or third person.
    Person,
    /// Choose the next act of the whale's motion.
    NextAct,
    /// Choose the act of this index.
    ChooseAct(usize),
    /// Open the mouth, or shut it.
    Mouth,
}

/// An action on what panels show and have chosen.
#[derive(Clone, Debug, PartialEq)]
pub enum PanelAction {
    /// Bring a panel to the front.
    Show(PanelId),
    /// Take a panel away.
    Close(PanelId),
    /// Put the panels in the places of a named layout.
    Arrange(Layout),
    /// Show a table of the library.
    Table(Kind),
    /// Show an entry of the library in its table, by its path.
    Entry(String),
    /// Show an assembly by its id.
    Assembly(String),
    /// Copy the entry chosen in the library.
    Duplicate,
    /// Delete the entry chosen in the library.
    Remove,
    /// Delete the entry chosen in the pilot program.
    DeleteEntry,
    /// Write the table shown, as it is sorted and searched.
    ExportTable(PathBuf),
    /// Take a table of the kind shown into the library.
    ImportTable(PathBuf),
    /// Write the plots shown: SVG, PNG or CSV by the file's extension.
    ExportPlots(PathBuf),
    /// Write the gear shown as a 3-D model: STL or glTF by the file's extension.
    ExportModel(PathBuf),
}

/// An action on the window as a whole.
#[derive(Clone, Debug, PartialEq)]
pub enum WindowAction {
    /// Open or close the list of commands.
    Palette,
    /// Dark or light.
    Theme(Theme),
    /// Units on screen.
    Units(Units),
    /// Size of everything on screen, 1 for usual.
    Size(f32),
    /// Copy the command line that gives the run.
    CopyCommandLine,
    /// Copy the command lines that run the open study.
    CopyStudyLine,
    /// Copy the command line that searches for the open observation.
    CopySearchLine,
    /// Open the report of the results shown.
    OpenReport,
    /// Open a document as a page.
    Read(Document),
    /// Show a folder in the system's file manager, or open a file.
    OpenFolder(PathBuf),
    /// Ask for the file of the command of this identity.
    Ask(&'static str),
    /// The 3-D view alone on the whole screen, in large letters; or back.
    Present,
    /// Close the window.
    Quit,
}

/// Whether a file has an extension, in any case.
pub fn has_extension(file: &Path, wanted: &str) -> bool {
    file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted))
}

impl WindowCommand {
    /// The identity it is declared by, such as `view.frame`.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Workbench(command) => command.id(),
            Self::View(action) => action.id(),
            Self::Flight(action) => action.id(),
            Self::Panel(action) => action.id(),
            Self::Window(action) => action.id(),
        }
    }
}

impl ViewAction {
    fn id(&self) -> &'static str {
        match self {
            Self::Look(View::Orbit) => "view.orbit",
            Self::Look(View::Side) => "view.side",
            Self::Look(View::Top) => "view.top",
            Self::Look(View::Front) => "view.front",
            Self::Look(_) => "view.look",
            Self::Frame => "view.frame",
            Self::Split(_) => "view.split",
            Self::Pose => "view.pose",
            Self::Ruler => "view.ruler",
            Self::Inspect(_) => "view.inspect",
            Self::LetGo => "view.let-go",
            Self::SavePicture(_) => "view.save-picture",
            Self::SaveFilm(_) => "view.save-film",
            Self::CancelFilm => "view.cancel-film",
            Self::SetKey => "view.set-key",
            Self::ClearKeys => "view.clear-keys",
        }
    }
}

impl FlightAction {
    fn id(&self) -> &'static str {
        match self {
            Self::Toggle => "flight.toggle",
            Self::Person => "flight.person",
            Self::NextAct => "flight.next-act",
            Self::ChooseAct(_) => "flight.act",
            Self::Mouth => "flight.mouth",
        }
    }
}

impl PanelAction {
    fn id(&self) -> &'static str {
        match self {
            Self::Show(PanelId::HELP) => "panel.help",
            Self::Show(_) => "panel.show",
            Self::Close(_) => "panel.close",
            Self::Arrange(_) => "panel.layout",
            Self::Table(_) => "panel.table",
            Self::Entry(_) => "panel.entry",
            Self::Assembly(_) => "panel.assembly",
            Self::Duplicate => "panel.duplicate",
            Self::Remove => "panel.remove",
            Self::DeleteEntry => "panel.delete-entry",
            Self::ExportTable(_) => "panel.export-table",
            Self::ImportTable(_) => "panel.import-table",
            Self::ExportPlots(file) if has_extension(file, "png") => "panel.plots-png",
            Self::ExportPlots(file) if has_extension(file, "csv") => "panel.plots-csv",
            Self::ExportPlots(_) => "panel.plots-svg",
            Self::ExportModel(file) if has_extension(file, "stl") => "panel.model-stl",
            Self::ExportModel(_) => "panel.model-gltf",
        }
    }
}

impl WindowAction {
    fn id(&self) -> &'static str {
        match self {
            Self::Palette => "window.palette",
            Self::Theme(Theme::Dark) => "window.dark",
            Self::Theme(Theme::Light) => "window.light",
            Self::Units(_) => "window.units",
            Self::Size(_) => "window.size",
            Self::CopyCommandLine => "window.copy-run",
            Self::CopyStudyLine => "window.copy-study",
            Self::CopySearchLine => "window.copy-search",
            Self::OpenReport => "window.open-report",
            Self::Read(_) => "window.read",
            Self::OpenFolder(_) => "window.open-folder",
            Self::Ask(id) => id,
            Self::Present => "window.present",
            Self::Quit => "window.quit",
        }
    }
}

macro_rules! into_window_command {
    ($($action:ident => $variant:ident),*) => {$(
        impl From<$action> for WindowCommand {
            fn from(action: $action) -> Self {
                Self::$variant(action)
            }
        }
    )*};
}

macro_rules! into_workbench_command {
    ($($action:ident => $variant:ident),*) => {$(
        impl From<$action> for WindowCommand {
            fn from(action: $action) -> Self {
                Self::Workbench(Command::$variant(action))
            }
        }
    )*};
}

into_window_command!(
    Command => Workbench,
    ViewAction => View,
    FlightAction => Flight,
    PanelAction => Panel,
    WindowAction => Window
);

into_workbench_command!(
    RunAction => Run,
    TimeAction => Time,
    EditAction => Edit,
    StudyAction => Study,
    SearchAction => Search,
    RuleAction => Rules,
    ExportAction => Export,
    PluginAction => Plugin
);

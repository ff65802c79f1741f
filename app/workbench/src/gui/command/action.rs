//! What a user asks of the window: commands of the workbench, and those that need a screen.

use std::path::{Path, PathBuf};

use endline_gear::Kind;
use endline_session::command::{
    Command, EditAction, ExportAction, PluginAction, RuleAction, RunAction, SearchAction,
    StudyAction, TimeAction,
};
use endline_session::units::Units;
use strum::{EnumDiscriminants, EnumMessage, IntoDiscriminant, IntoStaticStr};

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
#[derive(Clone, Debug, PartialEq, EnumDiscriminants)]
#[strum_discriminants(name(ViewVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "view.", serialize_all = "kebab-case"))]
pub enum ViewAction {
    /// Looks at the whale, or from it, and goes with it.
    #[strum_discriminants(strum(message = "View"))]
    Look(View),
    /// Brings the gear and the whale into sight.
    #[strum_discriminants(strum(message = "See everything"))]
    Frame,
    /// Shows this number of views of the same moment side by side.
    #[strum_discriminants(strum(message = "Views at once:"))]
    Split(usize),
    /// Shows handles that move where the whale starts, how deep, and where it heads; or hides them.
    #[strum_discriminants(strum(message = "Drag the whale's start"))]
    Pose,
    /// Lets two clicks measure between two places, straight and along the rope; or lets a click inspect again.
    #[strum_discriminants(strum(message = "Ruler"))]
    Ruler,
    /// Shows the properties of a body, or of a line where its tension is greatest.
    #[strum_discriminants(strum(message = "Read"))]
    Inspect(Picked),
    /// Takes the properties and the measure away.
    #[strum_discriminants(strum(message = "Clear the inspector and the ruler"))]
    LetGo,
    /// Draws what the chosen view shows at full size, 1920 by 1080, into a PNG file.
    #[strum_discriminants(strum(message = "Save a picture of the view"))]
    SavePicture(PathBuf),
    /// Draws the run, or the part of it chosen in the menu Film, by the camera keys, or as the chosen view shows it, at 20 pictures a second, into a GIF, or by ffmpeg into MP4 or WebM. The window can be used meanwhile.
    #[strum_discriminants(strum(message = "Save a film of the run"))]
    SaveFilm(PathBuf),
    /// Ends the film that is being made; the pictures drawn so far stay.
    #[strum_discriminants(strum(message = "Cancel the film"))]
    CancelFilm,
    /// Notes what the chosen view shows at this moment: a film goes from key to key.
    #[strum_discriminants(strum(message = "Set a camera key"))]
    SetKey,
    /// Takes the keys of the camera away: a film is seen as the view is now.
    #[strum_discriminants(strum(message = "Clear the camera keys"))]
    ClearKeys,
}

/// An action of the pilot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, EnumDiscriminants)]
#[strum_discriminants(name(FlightVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "flight.", serialize_all = "kebab-case"))]
pub enum FlightAction {
    /// Gives the controls of the whale to keys and game controller, or back to the pilot program.
    #[strum_discriminants(strum(message = "Fly the whale, or stop"))]
    Toggle,
    /// Looks through the whale's eyes, or from behind it.
    #[strum_discriminants(strum(message = "First or third person"))]
    Person,
    /// Chooses the next act of the whale's motion.
    #[strum_discriminants(strum(message = "Next act of the whale"))]
    NextAct,
    /// Chooses an act of the whale's motion.
    #[strum_discriminants(strum(message = "Act", serialize = "act"))]
    ChooseAct(usize),
    /// Opens the mouth of the whale that is flown, or shuts it.
    #[strum_discriminants(strum(message = "Open or close the mouth"))]
    Mouth,
}

/// An action on what panels show and have chosen.
#[derive(Clone, Debug, PartialEq, EnumDiscriminants)]
#[strum_discriminants(name(PanelVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "panel.", serialize_all = "kebab-case"))]
pub enum PanelAction {
    /// Brings a panel to the front.
    #[strum_discriminants(strum(message = "Show"))]
    Show(PanelId),
    /// Takes a panel away.
    #[strum_discriminants(strum(message = "Close"))]
    Close(PanelId),
    /// Puts the panels in their places for a kind of work.
    #[strum_discriminants(strum(message = "Layout", serialize = "layout"))]
    Arrange(Layout),
    /// Shows a table of the library.
    #[strum_discriminants(strum(message = "Table of"))]
    Table(Kind),
    /// Shows an entry in its table.
    #[strum_discriminants(strum(message = "Show an entry of the library"))]
    Entry(String),
    /// Shows an assembly and settles it.
    #[strum_discriminants(strum(message = "Show an assembly"))]
    Assembly(String),
    /// Copies the row chosen in the library to a file of its own.
    #[strum_discriminants(strum(message = "Duplicate the chosen entry"))]
    Duplicate,
    /// Deletes the row chosen in the library; its file goes with the next save, and Undo brings it back.
    #[strum_discriminants(strum(message = "Delete the chosen entry of the library"))]
    Remove,
    /// Takes the entry chosen on the timeline out of the pilot program.
    #[strum_discriminants(strum(message = "Delete the chosen entry of the pilot program"))]
    DeleteEntry,
    /// Writes the table shown, with its search and order.
    #[strum_discriminants(strum(message = "Save the library's table as CSV"))]
    ExportTable(PathBuf),
    /// Changes the entries of the table shown that a CSV names, and adds those that it does not know.
    #[strum_discriminants(strum(message = "Take a CSV into the library"))]
    ImportTable(PathBuf),
    /// Write the plots shown: SVG, PNG or CSV by the file's extension.
    ExportPlots(PathBuf),
    /// Write the gear shown as a 3-D model: STL or glTF by the file's extension.
    ExportModel(PathBuf),
}

/// An action on the window as a whole.
#[derive(Clone, Debug, PartialEq, EnumDiscriminants)]
#[strum_discriminants(name(WindowVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "window.", serialize_all = "kebab-case"))]
pub enum WindowAction {
    /// Lists every command by its name.
    #[strum_discriminants(strum(message = "Commands"))]
    Palette,
    /// Dark or light.
    Theme(Theme),
    /// Chooses the units on screen; files keep theirs.
    #[strum_discriminants(strum(message = "Units"))]
    Units(Units),
    // 1 for usual.
    /// Makes everything on screen larger or smaller.
    #[strum_discriminants(strum(message = "Size"))]
    Size(f32),
    /// Copies the command that gives this run, for a terminal or a script.
    #[strum_discriminants(strum(message = "Copy as command line", serialize = "copy-run"))]
    CopyCommandLine,
    /// Copies the commands that run the open study and report it.
    #[strum_discriminants(strum(
        message = "Copy the study as command line",
        serialize = "copy-study"
    ))]
    CopyStudyLine,
    /// Copies the command that searches for the open observation.
    #[strum_discriminants(strum(
        message = "Copy the search as command line",
        serialize = "copy-search"
    ))]
    CopySearchLine,
    /// Opens the report of the results shown with the program that is usual for pages.
    #[strum_discriminants(strum(message = "Open the study's report"))]
    OpenReport,
    /// Opens a document with the program that is usual for pages; it is inside the program.
    #[strum_discriminants(strum(message = "Read"))]
    Read(Document),
    /// Shows a folder in the system's file manager, or opens a file with its usual program.
    #[strum_discriminants(strum(message = "Open a folder"))]
    OpenFolder(PathBuf),
    /// Ask for the file of the command of this identity.
    Ask(&'static str),
    /// Shows the 3-D view alone on the whole screen, in large letters, for a talk; F11 or Esc goes back.
    #[strum_discriminants(strum(message = "Present"))]
    Present,
    /// Closes the window; unsaved edits are asked about first.
    #[strum_discriminants(strum(message = "Quit"))]
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
            Self::Flight(action) => action.discriminant().into(),
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
            other => ViewVerb::from(other).into(),
        }
    }
}

impl PanelAction {
    fn id(&self) -> &'static str {
        match self {
            Self::Show(PanelId::Help) => "panel.help",
            Self::ExportPlots(file) if has_extension(file, "png") => "panel.plots-png",
            Self::ExportPlots(file) if has_extension(file, "csv") => "panel.plots-csv",
            Self::ExportModel(file) if has_extension(file, "stl") => "panel.model-stl",
            Self::ExportPlots(_) => "panel.plots-svg",
            Self::ExportModel(_) => "panel.model-gltf",
            other => PanelVerb::from(other).into(),
        }
    }
}

impl WindowAction {
    fn id(&self) -> &'static str {
        match self {
            Self::Theme(Theme::Dark) => "window.dark",
            Self::Theme(Theme::Light) => "window.light",
            Self::Ask(id) => id,
            other => WindowVerb::from(other).into(),
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

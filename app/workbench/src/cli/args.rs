//! What the command line takes.

use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum};
use endline_gear::units::{self, Quantity};
use endline_session::Overrides;
use endline_session::plugins::{Language, PluginKind};

use super::study::args::StudyCommand;

/// Design fishing gear that whales get out of alive.
///
/// Without a command the workbench opens.
#[derive(Debug, Parser)]
#[command(
    name = "endline",
    version,
    after_help = "Exit codes: 0 done, 1 the run or check failed, 2 wrong use."
)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub(super) command: Option<Command>,
    /// Folder of the gear library; found beside the scenario or the program where not given.
    #[arg(long, global = true, value_name = "DIR")]
    pub(super) library: Option<PathBuf>,
    /// Allow the plugin libraries found that are new or have changed, as `plugins allow` does one by one.
    #[arg(long, global = true)]
    pub(super) allow_plugins: bool,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Run a scenario and print its summary.
    Run(RunArgs),
    /// Find the gear at rest: shape, tensions, residual.
    Settle(SettleArgs),
    /// Run a recording again; with --verify compare every step.
    Replay(ReplayArgs),
    /// Write a recorded run as a scenario whose pilot program flies it again, to be edited as text.
    Pilot(PilotArgs),
    /// Draw a moment of a recording or a scenario; needs no display.
    Render(RenderArgs),
    /// Run validation cases and tell what was expected and what was got.
    Validate(ValidateArgs),
    /// Compare options of gear on the same encounters: plan, run, merge, report, replay.
    Study {
        #[command(subcommand)]
        what: StudyCommand,
    },
    /// Check files, a gear library or a project, and tell all that is wrong.
    Check(CheckArgs),
    /// Write a whale's mesh as a file for other programs, such as Blender.
    Whale {
        #[command(subcommand)]
        what: WhaleCommand,
    },
    /// List plugins, check or allow a library, switch one off, begin a new one.
    Plugins {
        #[command(subcommand)]
        what: PluginsCommand,
    },
}

#[derive(Debug, clap::Args)]
pub(super) struct RunArgs {
    /// Scenario file.
    pub(super) scenario: PathBuf,
    /// Folder for the summary, the recording and a picture; made where it is not there.
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    pub(super) json: bool,
    /// Start even where the gear did not come to rest.
    #[arg(long = "allow-unsettled", alias = "unsettled")]
    pub(super) unsettled: bool,
    /// Take over from a moment of this recording: up to --at its inputs steer, from then on the scenario's pilot.
    #[arg(long, value_name = "RECORDING", requires = "at")]
    pub(super) from: Option<PathBuf>,
    /// The moment taken over, in seconds of the recording.
    #[arg(long, value_name = "T", requires = "from")]
    pub(super) at: Option<f64>,
    #[command(flatten)]
    pub(super) over: OverArgs,
    /// Threads to use; one run takes one thread, and the result is the same for any number.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: u16,
}

#[derive(Debug, clap::Args)]
pub(super) struct SettleArgs {
    /// Scenario file.
    pub(super) scenario: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) over: OverArgs,
}

/// What may be set over a scenario.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct OverArgs {
    /// Seed, over the scenario's.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Step between inputs in seconds, over the scenario's.
    #[arg(long, value_name = "S", value_parser = step)]
    dt: Option<f64>,
    /// Weak links on or off, over the scenario's.
    #[arg(long, value_name = "on|off")]
    weak_links: Option<Switch>,
    /// Rating of every weak link: newtons, or with a unit such as 1700lbf.
    #[arg(long, value_name = "FORCE", value_parser = force)]
    rating: Option<f64>,
    /// Whether the whale feels the gear (kinetic) or goes as it is steered whatever the rope does (kinematic), over the scenario's.
    #[arg(long, value_name = "kinetic|kinematic")]
    whale: Option<Dynamics>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Switch {
    On,
    Off,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Dynamics {
    Kinetic,
    Kinematic,
}

#[derive(Debug, clap::Args)]
pub(super) struct ReplayArgs {
    /// Recording file.
    pub(super) recording: PathBuf,
    /// Compare every step with the recording and name the first that differs.
    #[arg(long)]
    pub(super) verify: bool,
    /// Print one JSON object.
    #[arg(long)]
    pub(super) json: bool,
    /// Go on with plugins of another version or file than recorded.
    #[arg(long)]
    pub(super) other_plugins: bool,
}

#[derive(Debug, clap::Args)]
pub(super) struct PilotArgs {
    /// Recording file.
    pub(super) recording: PathBuf,
    /// Scenario to write.
    #[arg(long, value_name = "FILE.toml")]
    pub(super) out: PathBuf,
    /// Leave out changes of a control up to this, from 0 to 1; with 0 the run is the same to the bit.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, value_parser = share)]
    pub(super) thin: f64,
}

#[derive(Debug, clap::Args)]
pub(super) struct RenderArgs {
    /// Recording, or scenario file: its gear at rest, or run up to the moment.
    #[arg(value_name = "RECORDING|SCENARIO")]
    pub(super) file: PathBuf,
    /// Simulated time of the moment, in seconds.
    #[arg(long, value_name = "T", default_value_t = 0.0)]
    pub(super) at: f64,
    /// Bodies and lines to fit into the picture, such as trap-1,endline-top; all there is where not given.
    #[arg(long, value_name = "ID,...", value_delimiter = ',')]
    pub(super) fit: Vec<String>,
    /// View: orbit, side, top or front; of the whale: whale, first-person, whale-side, whale-top or whale-front.
    #[arg(long, value_name = "NAME", default_value = "orbit")]
    pub(super) view: String,
    /// Picture to write.
    #[arg(long, value_name = "FILE.png")]
    pub(super) out: PathBuf,
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x800", value_parser = size)]
    pub(super) size: [u32; 2],
    /// Go on with plugins of another version or file than recorded.
    #[arg(long)]
    pub(super) other_plugins: bool,
}

#[derive(Debug, clap::Args)]
pub(super) struct ValidateArgs {
    /// Cases by name, such as reference-a-100; all of the gear library where none is given.
    pub(super) cases: Vec<String>,
    /// Print one JSON object.
    #[arg(long)]
    pub(super) json: bool,
    /// Only at each case's own step and segments, without halving them.
    #[arg(long)]
    pub(super) plain: bool,
    /// Write the document of these cases, and their plots beside it.
    #[arg(long, value_name = "FILE.md")]
    pub(super) write: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(super) struct CheckArgs {
    /// Files, library folders or project folders; the gear library where none is given.
    pub(super) paths: Vec<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(super) enum WhaleCommand {
    /// Write the skinned mesh of a whale of the library as glTF 2.0.
    Build(WhaleBuildArgs),
}

#[derive(Debug, clap::Args)]
pub(super) struct WhaleBuildArgs {
    /// Whale of the library, such as right-whale.
    pub(super) whale: String,
    /// Body length, over the library's, such as "13.7 m".
    #[arg(long, value_name = "LENGTH", value_parser = body_length)]
    pub(super) length: Option<f64>,
    /// File to write: .glb (binary) or .gltf (text).
    #[arg(long, value_name = "FILE.glb")]
    pub(super) out: PathBuf,
}

#[derive(Debug, Subcommand)]
pub(super) enum PluginsCommand {
    /// List the plugins found, with what they take, and those that failed.
    List,
    /// Try a plugin file in a child process: its declaration, random inputs, bits, state, energy, threads, time.
    Check {
        /// Plugin file, or folder of a plugin without code.
        file: PathBuf,
        /// Try it in this process, which it may crash.
        #[arg(long, hide = true)]
        here: bool,
    },
    /// Write a small plugin project that builds and passes the check.
    New(NewPluginArgs),
    /// Let the program open these libraries, as they are now: a plugin runs with your rights.
    Allow {
        /// Plugin files.
        #[arg(required = true)]
        files: Vec<PathBuf>,
    },
    /// Take back that these libraries were allowed.
    Forget {
        /// Plugin files.
        #[arg(required = true)]
        files: Vec<PathBuf>,
    },
    /// Leave a plugin out, until it is switched on again.
    Off {
        /// Id of the plugin.
        id: String,
    },
    /// Use a plugin that was switched off.
    On {
        /// Id of the plugin.
        id: String,
    },
}

#[derive(Debug, clap::Args)]
pub(super) struct NewPluginArgs {
    /// Folder to write; its name is the plugin's. Where not given, my-motion, my-friction or my-gear.
    pub(super) folder: Option<PathBuf>,
    /// What it is.
    #[arg(long)]
    pub(super) kind: PluginKindArg,
    /// Language it is written in.
    #[arg(long, default_value = "rust")]
    pub(super) lang: PluginLanguage,
    /// Folder of the crate endline-sdk, for Rust; that of Endline's source where not given.
    #[arg(long, value_name = "FOLDER")]
    pub(super) sdk: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum PluginKindArg {
    /// How a whale moves.
    Motion,
    /// How rope rubs on a whale.
    Friction,
    /// Gear built from attributes.
    Gear,
}

impl PluginKindArg {
    /// Its word in ids and names.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Motion => "motion",
            Self::Friction => "friction",
            Self::Gear => "gear",
        }
    }
}

impl From<PluginKindArg> for PluginKind {
    fn from(kind: PluginKindArg) -> Self {
        match kind {
            PluginKindArg::Motion => Self::Motion,
            PluginKindArg::Friction => Self::Friction,
            PluginKindArg::Gear => Self::Gear,
        }
    }
}

impl From<PluginLanguage> for Language {
    fn from(language: PluginLanguage) -> Self {
        match language {
            PluginLanguage::Rust => Self::Rust,
            PluginLanguage::C => Self::C,
            PluginLanguage::Text => Self::Text,
        }
    }
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum PluginLanguage {
    /// Rust, on the crate endline-sdk.
    Rust,
    /// C, on the header alone.
    C,
    /// No code: motion clips (for motion) or a gear type (for gear) as text.
    Text,
}

impl OverArgs {
    pub(super) fn overrides(&self) -> Overrides {
        let weak_links = self.weak_links.map(|switch| switch == Switch::On);
        let kinetic = self.whale.map(|dynamics| dynamics == Dynamics::Kinetic);
        Overrides { seed: self.seed, step_s: self.dt, weak_links, rating_n: self.rating, kinetic }
    }
}

fn step(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| "expected seconds, such as 0.01".to_owned())?;
    if seconds > 0.0 && seconds <= 1.0 {
        Ok(seconds)
    } else {
        Err("expected seconds above 0 and at most 1".into())
    }
}

fn share(text: &str) -> Result<f64, String> {
    let share: Option<f64> = text.parse().ok();
    share
        .filter(|share| (0.0..=1.0).contains(share))
        .ok_or_else(|| "expected a number from 0 to 1, such as 0.02".into())
}

fn force(text: &str) -> Result<f64, String> {
    let newtons = match text.parse() {
        Ok(newtons) => newtons,
        Err(_) => units::parse(text, Quantity::Force).map_err(|error| error.to_string())?,
    };
    if newtons > 0.0 && f64::is_finite(newtons) {
        Ok(newtons)
    } else {
        Err("expected a force above 0".into())
    }
}

fn body_length(text: &str) -> Result<f64, String> {
    let metres = units::parse(text, Quantity::Length).map_err(|error| error.to_string())?;
    if (1.0..=35.0).contains(&metres) {
        Ok(metres)
    } else {
        Err("expected a length from 1 m to 35 m".into())
    }
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let pixels = |text: &str| text.parse().ok().filter(|pixels| (16..=8192).contains(pixels));
    let both =
        text.split_once('x').and_then(|(width, height)| Some([pixels(width)?, pixels(height)?]));
    both.ok_or_else(|| "expected width and height from 16 to 8192, such as 1280x800".into())
}

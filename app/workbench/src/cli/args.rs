//! The arguments of the command line.

use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum};
use endline_gear::Setting;
use endline_sdk::BodyPart;
use endline_session::Overrides;
use endline_session::plugins::{Language, PluginKind};

use super::haul::HaulArgs;
use super::mill::MillArgs;
use super::output::Verbosity;
use super::quantity::{body_length, force, length, step, time};
use super::rules::RulesCommand;
use super::search::SearchArgs;
use super::sheet::SheetArgs;
use super::study::args::StudyCommand;

/// Design fishing gear that entangled whales can escape from.
///
/// Without a command, the workbench opens in a window.
#[derive(Debug, Parser)]
#[command(
    name = "endline",
    version,
    after_help = "Exit codes: 0 success, 1 the run or check failed, 2 wrong usage, 128 and the signal's number when interrupted (130 by Ctrl+C)."
)]
pub struct Args {
    /// Command to run.
    #[command(subcommand)]
    pub(super) command: Option<Command>,
    /// Folder of the gear library [default: found near the scenario or the program].
    #[arg(long, global = true, value_name = "DIR")]
    pub(super) library: Option<PathBuf>,
    /// Allow all plugin libraries that are new or have changed; `plugins allow` does so one by one.
    #[arg(long, global = true)]
    pub(super) allow_plugins: bool,
    /// Print errors alone on standard error.
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Print also which gear library and which plugins are used, and all figures of a run.
    #[arg(long, short, global = true)]
    verbose: bool,
}

impl Args {
    /// What is printed on standard error.
    pub(super) fn verbosity(&self) -> Verbosity {
        match (self.quiet, self.verbose) {
            (true, _) => Verbosity::Errors,
            (_, true) => Verbosity::Details,
            _ => Verbosity::Notes,
        }
    }
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Run a scenario and print its summary.
    Run(RunArgs),
    /// Compute the gear at rest and print its shape, tensions and residual.
    Settle(SettleArgs),
    /// Run a recording again; --verify compares every step.
    Replay(ReplayArgs),
    /// Write a recorded run as a scenario with a pilot program that repeats it and can be edited.
    Pilot(PilotArgs),
    /// Draw a moment of a recording or a scenario as a picture, or a stretch of it as a film, without a display.
    Render(RenderArgs),
    /// Write the moments of a recording or a scenario as tables for programs that analyse data: nodes, tensions, whale, contacts.
    Export(ExportArgs),
    /// Run validation cases and compare results with expected values.
    Validate(ValidateArgs),
    /// Compare options of gear on the same encounters.
    Study {
        #[command(subcommand)]
        what: StudyCommand,
    },
    /// Search for encounters that end like an observation of a real whale.
    Search(SearchArgs),
    /// Check files or folders of gear and report every problem.
    Check(CheckArgs),
    /// Check an assembly against rules of fishing law, or list them.
    Rules {
        #[command(subcommand)]
        what: RulesCommand,
    },
    /// Haul an assembly from a boat: loads, the part nearest to parting, and the probability that it parts.
    Haul(HaulArgs),
    /// Write one page on a gear for a hearing: its shape, rules, strength and threat.
    Sheet(SheetArgs),
    /// Estimate the strength law of a product from a mill's breaks, and the probability that the product is approved.
    Mill(MillArgs),
    /// Write a whale's mesh to a file for other programs, such as Blender.
    Whale {
        #[command(subcommand)]
        what: WhaleCommand,
    },
    /// Print the JSON schema of a form that a command prints with --json, or list the forms.
    Schema {
        /// Form, such as endline.run/1, or a command that prints it, such as "study report".
        form: Option<String>,
    },
    /// Print a document, or list the documents.
    Docs {
        /// Document, such as physics.
        document: Option<String>,
    },
    /// Print the script for a shell that completes the arguments of this program.
    Completions {
        /// Shell that it is for.
        shell: clap_complete::Shell,
    },
    /// Write manual pages of the program and its commands.
    Man {
        /// Folder for the pages; it is created if missing.
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
    },
    /// List, check, allow, enable, disable or create plugins.
    Plugins {
        #[command(subcommand)]
        what: PluginsCommand,
    },
}

#[derive(Debug, clap::Args)]
pub(super) struct RunArgs {
    /// Scenario file, a scenario of the gear library by its id, or - for standard input.
    pub(super) scenario: PathBuf,
    /// Folder for the summary, the recording and a picture; it is created if missing.
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Print the result as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
    /// Print all figures after the headline, as --verbose does.
    #[arg(long)]
    pub(super) all: bool,
    /// End the run once its outcome is decided: no touch within 30 s, gear shed, or 30 s of entanglement.
    #[arg(long)]
    pub(super) until_over: bool,
    /// Start the run even if statics finds no rest position of the gear.
    #[arg(long = "allow-unsettled", alias = "unsettled")]
    pub(super) unsettled: bool,
    /// Recording to continue from: its inputs steer until --at, then the scenario's pilot.
    #[arg(long, value_name = "RECORDING", requires = "at")]
    pub(super) from: Option<PathBuf>,
    /// Time of the recording at which the scenario's pilot takes over, such as 12s.
    #[arg(long, value_name = "TIME", requires = "from", value_parser = time)]
    pub(super) at: Option<f64>,
    #[command(flatten)]
    pub(super) over: OverArgs,
}

#[derive(Debug, clap::Args)]
pub(super) struct SettleArgs {
    /// Scenario file, a scenario of the gear library by its id, or - for standard input.
    pub(super) scenario: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) over: OverArgs,
}

/// Options that override values of a scenario.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct OverArgs {
    /// Seed of the random draws, in place of the scenario's.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Step between inputs, such as 10ms, in place of the scenario's.
    #[arg(long, value_name = "TIME", value_parser = step)]
    dt: Option<f64>,
    /// Whether weak links can part, in place of the scenario's setting.
    #[arg(long, value_name = "on|off")]
    weak_links: Option<Switch>,
    /// Rating of every weak link, such as 1700lbf.
    #[arg(long, value_name = "FORCE", value_parser = force)]
    rating: Option<f64>,
    /// Whether rope forces move the whale (kinetic) or it follows its pilot regardless (kinematic).
    #[arg(long, value_name = "kinetic|kinematic")]
    whale: Option<Dynamics>,
    /// Field of the scenario, such as current.speed="0.5 m/s", or of a library file, such as ropes/sink-3-8.strength="2000 lbf"; may be given several times.
    #[arg(long, value_name = "FIELD=VALUE", value_parser = field_and_value)]
    pub(super) set: Vec<(String, Setting)>,
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
    /// Compare every step with the recording and report the first that differs.
    #[arg(long)]
    pub(super) verify: bool,
    /// Print the result as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
    /// Accept plugins whose version or file differs from the recorded ones.
    #[arg(long)]
    pub(super) other_plugins: bool,
}

#[derive(Debug, clap::Args)]
pub(super) struct PilotArgs {
    /// Recording file.
    pub(super) recording: PathBuf,
    /// Scenario file to write.
    #[arg(long, value_name = "FILE.toml")]
    pub(super) out: PathBuf,
    /// Leave out changes of a control up to this size, from 0 to 1; 0 repeats the run bit for bit.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, value_parser = share)]
    pub(super) thin: f64,
}

#[derive(Debug, clap::Args)]
pub(super) struct RenderArgs {
    /// Recording file, scenario file, or a scenario of the gear library by its id; it is run up to the time --at.
    #[arg(value_name = "RECORDING|SCENARIO")]
    pub(super) file: PathBuf,
    /// Simulated time, such as 20s; at 0s a scenario shows its gear at rest.
    #[arg(long, value_name = "TIME", default_value = "0s", value_parser = time)]
    pub(super) at: f64,
    /// Start of a film, such as 10s [default: 0s].
    #[arg(long, value_name = "TIME", conflicts_with = "at", value_parser = time)]
    pub(super) from: Option<f64>,
    /// End of a film [default: the end of the run].
    #[arg(long, value_name = "TIME", conflicts_with = "at", value_parser = time)]
    pub(super) to: Option<f64>,
    /// Pictures a second of a film, 1 to 50.
    #[arg(long, value_name = "N", default_value_t = 20, conflicts_with = "at", value_parser = clap::value_parser!(u32).range(1..=50))]
    pub(super) fps: u32,
    /// Bodies and lines to fit into the picture, such as trap-1,endline-top [default: all].
    #[arg(long, value_name = "ID,...", value_delimiter = ',')]
    pub(super) fit: Vec<String>,
    /// View: orbit, side, top, front, whale, first-person, left-eye, right-eye, whale-side, whale-top or whale-front. For a film also views with
    /// the time at which the camera stands there, such as side@0s,whale@10s,whale-side@14s.
    #[arg(long, value_name = "NAME", default_value = "orbit")]
    pub(super) view: String,
    /// What is drawn: measured shows tension as colour, scales, contact and current; film shows rope in its own colour, particles and
    /// shafts of light, and no marks or text.
    #[arg(long, value_enum, default_value_t = Look::Measured)]
    pub(super) look: Look,
    /// File to write: .png is a picture; .gif, .mp4 and .webm are films, the latter two by the program ffmpeg; .glb is an animated 3-D
    /// model for Blender and others.
    #[arg(long, value_name = "FILE")]
    pub(super) out: PathBuf,
    /// Width and height in pixels, each from 16 to 8192.
    #[arg(long, value_name = "WxH", default_value = "1280x800", value_parser = size)]
    pub(super) size: [u32; 2],
    /// Accept plugins whose version or file differs from the recorded ones.
    #[arg(long)]
    pub(super) other_plugins: bool,
}

#[derive(Debug, clap::Args)]
pub(super) struct ExportArgs {
    /// Recording file, scenario file, or a scenario of the gear library by its id, which is run.
    #[arg(value_name = "RECORDING|SCENARIO")]
    pub(super) file: PathBuf,
    /// Format of the tables.
    #[arg(long, value_enum, default_value_t = TableFormat::Parquet)]
    pub(super) format: TableFormat,
    /// Moments a second, 1 to 1000.
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(super) rate: u32,
    /// First moment, such as 10s [default: 0s].
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub(super) from: Option<f64>,
    /// Last moment [default: the end of the run].
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub(super) to: Option<f64>,
    /// Folder for the tables; it is created if missing.
    #[arg(long, value_name = "DIR")]
    pub(super) out: PathBuf,
    /// Accept plugins whose version or file differs from the recorded ones.
    #[arg(long)]
    pub(super) other_plugins: bool,
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Look {
    /// Instruments and measured colours.
    Measured,
    /// The scene alone, for films and print.
    Film,
}

/// Format of tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum TableFormat {
    /// Apache Parquet, with units and meanings of the columns in its metadata.
    Parquet,
    /// Apache Arrow (IPC file), the same uncompressed, for programs that map a file into memory.
    Arrow,
    /// Comma-separated values.
    Csv,
}

#[derive(Debug, clap::Args)]
pub(super) struct ValidateArgs {
    /// Names of cases, such as reference-a-100 [default: all cases of the gear library].
    pub(super) cases: Vec<String>,
    /// Print the result as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
    /// Run each case only at its own step and segments, without the convergence study.
    #[arg(long)]
    pub(super) plain: bool,
    /// Write a document of these cases to this file, with plots in a folder beside it.
    #[arg(long, value_name = "FILE.md")]
    pub(super) write: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(super) struct CheckArgs {
    /// Files or folders to check [default: the gear library].
    pub(super) paths: Vec<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(super) enum WhaleCommand {
    /// Write the skinned mesh of a whale in the library as glTF 2.0.
    Build(WhaleBuildArgs),
    /// Compute the start from which a scenario's whale meets a line at a depth with a part of its body.
    Aim(AimArgs),
}

#[derive(Debug, clap::Args)]
pub(super) struct AimArgs {
    /// Scenario file, or a scenario of the gear library by its id.
    pub(super) scenario: PathBuf,
    /// Line to meet, such as endline-top.
    #[arg(long, value_name = "ID")]
    pub(super) line: String,
    /// Depth of the place on the line, such as "5 fathom".
    #[arg(long, value_name = "DEPTH", value_parser = length)]
    pub(super) depth: f64,
    /// Part of the body that meets it.
    #[arg(long, value_name = "PART", value_parser = body_part)]
    pub(super) part: BodyPart,
    /// Distance over the ground before the foremost skin reaches the line.
    #[arg(long, value_name = "LENGTH", value_parser = length, default_value = "3 m")]
    pub(super) gap: f64,
    /// Print the result as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) over: OverArgs,
}

#[derive(Debug, clap::Args)]
pub(super) struct WhaleBuildArgs {
    /// Id of the whale in the library, such as right-whale.
    pub(super) whale: String,
    /// Body length in place of the library's, such as "13.7 m".
    #[arg(long, value_name = "LENGTH", value_parser = body_length)]
    pub(super) length: Option<f64>,
    /// File to write: .glb (binary) or .gltf (text).
    #[arg(long, value_name = "FILE.glb")]
    pub(super) out: PathBuf,
}

#[derive(Debug, Subcommand)]
pub(super) enum PluginsCommand {
    /// List the plugins found with their attributes, and those that failed to load.
    List,
    /// Test a plugin in a child process: declaration, random inputs, repeatability, energy, threads and time.
    Check {
        /// Plugin library, or folder of a plugin without code.
        file: PathBuf,
        /// Test it in this process, which it may crash.
        #[arg(long, hide = true)]
        here: bool,
    },
    /// Write a small plugin project that builds and passes the check.
    New(NewPluginArgs),
    /// Serve the library that the program names on standard input.
    #[command(hide = true)]
    Serve,
    /// Allow Endline to load these libraries in their present version, each in a process of its own; a plugin runs with your rights.
    Allow {
        /// Trust them: run them in the program's own process, which a faulty one can crash or hold up.
        #[arg(long)]
        in_process: bool,
        /// Plugin files.
        #[arg(required = true)]
        files: Vec<PathBuf>,
    },
    /// Withdraw the permission to load these libraries.
    Forget {
        /// Plugin files.
        #[arg(required = true)]
        files: Vec<PathBuf>,
    },
    /// Disable a plugin until it is enabled again.
    Off {
        /// Id of the plugin.
        id: String,
    },
    /// Enable a plugin that was disabled.
    On {
        /// Id of the plugin.
        id: String,
    },
}

#[derive(Debug, clap::Args)]
pub(super) struct NewPluginArgs {
    /// Folder to write; its name becomes the plugin's [default: my-motion, my-friction or my-gear].
    pub(super) folder: Option<PathBuf>,
    /// Kind of plugin.
    #[arg(long)]
    pub(super) kind: PluginKindArg,
    /// Language of the plugin.
    #[arg(long, default_value = "rust")]
    pub(super) lang: PluginLanguage,
    /// Folder of the crate endline-sdk, for Rust [default: a copy within the project].
    #[arg(long, value_name = "FOLDER")]
    pub(super) sdk: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum PluginKindArg {
    /// How a whale moves.
    Motion,
    /// Friction of rope on a whale.
    Friction,
    /// Type of gear built from attributes.
    Gear,
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
    /// Rust, with the crate endline-sdk.
    Rust,
    /// C, with the header alone.
    C,
    /// No code: motion clips (for motion) or a gear type (for gear) as text files.
    Text,
}

impl OverArgs {
    pub(super) fn overrides(&self) -> Overrides {
        let weak_links = self.weak_links.map(|switch| switch == Switch::On);
        let kinetic = self.whale.map(|dynamics| dynamics == Dynamics::Kinetic);
        Overrides { seed: self.seed, step_s: self.dt, weak_links, rating_n: self.rating, kinetic }
    }
}

/// A field and the value that replaces it: a TOML value, else a text.
fn field_and_value(text: &str) -> Result<(String, Setting), String> {
    let (field, value) = text
        .split_once('=')
        .filter(|(field, _)| !field.trim().is_empty())
        .ok_or_else(|| "expected FIELD=VALUE, such as current.speed=\"0.5 m/s\"".to_owned())?;
    Ok((field.trim().to_owned(), Setting::plain(value.trim())))
}

fn body_part(text: &str) -> Result<BodyPart, String> {
    let named = BodyPart::ALL.into_iter().find(|part| part.name() == text);
    named.ok_or_else(|| format!("expected one of {}", BodyPart::ALL.map(BodyPart::name).join(", ")))
}

fn share(text: &str) -> Result<f64, String> {
    let share: Option<f64> = text.parse().ok();
    share
        .filter(|share| (0.0..=1.0).contains(share))
        .ok_or_else(|| "expected a number from 0 to 1, such as 0.02".into())
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let pixels = |text: &str| text.parse().ok().filter(|pixels| (16..=8192).contains(pixels));
    let both =
        text.split_once('x').and_then(|(width, height)| Some([pixels(width)?, pixels(height)?]));
    both.ok_or_else(|| "expected width and height from 16 to 8192, such as 1280x800".into())
}

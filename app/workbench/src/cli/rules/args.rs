//! Arguments of `endline rules`.

use std::path::{Path, PathBuf};

use endline_gear::Date;
use endline_session::rules::study::USUAL_LIKE;
use endline_session::rules::{Fishing, Packs};

use crate::cli::Failure;
use crate::cli::quantity::length;

#[derive(Debug, clap::Subcommand)]
pub(in crate::cli) enum RulesCommand {
    /// Check an assembly against every rule that applies where and when it is fished.
    Check(CheckArgs),
    /// Propose edits by which an assembly would comply, each tried on a copy; write one as a new assembly.
    Fix(FixArgs),
    /// Write a study of an assembly edited for each of several rules, in the same encounters.
    Study(StudyArgs),
    /// List rules with their citations, dates and standing, and the areas.
    List(ListArgs),
}

/// The gear, where, when and how it is fished.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct FishedArgs {
    /// Assembly file, or the id of an assembly in the gear library.
    #[arg(value_name = "ASSEMBLY")]
    pub assembly: String,
    /// Area in which it is fished; `endline rules list` names them.
    #[arg(long, value_name = "NAME")]
    pub area: String,
    /// Day on which it is fished.
    #[arg(long, value_name = "YYYY-MM-DD", value_parser = day)]
    pub on: Date,
    /// Depth of the water, such as "30 fathom"; gear types build for it [default: 25 m, and depth counts as not known].
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub depth: Option<f64>,
    /// Distance from shore, such as "5 nmi".
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub distance: Option<f64>,
    /// Traps on one set, in place of those of the assembly.
    #[arg(long, value_name = "N")]
    pub traps: Option<u16>,
    /// Rule pack besides those of the library; may be given several times.
    #[arg(long, value_name = "FILE")]
    pub pack: Vec<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct CheckArgs {
    #[command(flatten)]
    pub fished: FishedArgs,
    /// Leave rules out that do not apply.
    #[arg(long)]
    pub brief: bool,
    /// Print the result as one JSON object.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct FixArgs {
    #[command(flatten)]
    pub fished: FishedArgs,
    /// Number of the proposal that is written [default: all edits together by which the rules that bind are met].
    #[arg(long, value_name = "N", requires = "write")]
    pub take: Option<usize>,
    /// New assembly to write with the edit: a file, or an id that the library does not have.
    #[arg(long, value_name = "FILE")]
    pub write: Option<String>,
    /// Print the proposals as one JSON object.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct StudyArgs {
    /// Id of an assembly in the gear library.
    #[arg(value_name = "ASSEMBLY")]
    pub assembly: String,
    /// Rule for which the assembly is edited, whose id the option gets; give two or more, the baseline first.
    #[arg(long, value_name = "RULE", required = true)]
    pub option: Vec<String>,
    /// New study to write: a file, or an id that the library does not have.
    #[arg(long, value_name = "FILE")]
    pub out: String,
    /// Study whose scenario, encounters and rule of ending are taken: a file, or an id of the library.
    #[arg(long, value_name = "STUDY", default_value = USUAL_LIKE)]
    pub like: String,
    /// Depth for which the gear is edited and in which whales meet it [default: 25 m for edits, and that of the scenario].
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub depth: Option<f64>,
    /// Rule pack besides those of the library; may be given several times.
    #[arg(long, value_name = "FILE")]
    pub pack: Vec<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct ListArgs {
    /// Rule pack besides those of the library; may be given several times.
    #[arg(long, value_name = "FILE")]
    pub pack: Vec<PathBuf>,
    /// Print packs, areas and rules as one JSON object.
    #[arg(long)]
    pub json: bool,
}

impl FishedArgs {
    /// The packs, and where, when and how the gear is fished; an area that no pack declares is wrong use.
    pub fn open(&self, library: Option<&Path>) -> Result<(Packs, Fishing), Failure> {
        let packs = Packs::open(library, &self.pack)?;
        packs.around(&self.area).map_err(Failure::usage)?;
        let fishing = Fishing {
            area: self.area.clone(),
            on: self.on,
            depth_m: self.depth,
            distance_m: self.distance,
            traps: self.traps,
        };
        Ok((packs, fishing))
    }
}

fn day(text: &str) -> Result<Date, String> {
    Date::parse(text).ok_or_else(|| "expected year, month and day, such as 2024-06-01".to_owned())
}

//! `endline sheet`: one page on a gear, or on several beside each other, for a hearing.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use endline_session::compliance::{
    ComplianceSheet, Request, USUAL_TIDE_M_S, comparison, print_pdf,
};
use endline_session::plugins::PluginHost;
use endline_session::source::AssemblyFile;
use endline_session::{Error, save};

use super::quantity::running;
use super::rules::FishedArgs;
use super::{Failure, host, output};

#[derive(Debug, clap::Args)]
pub(super) struct SheetArgs {
    #[command(flatten)]
    fished: FishedArgs,
    /// Speed of the running tide at the surface, such as "0.5 kn" [default: 0.25 m/s].
    #[arg(long, value_name = "SPEED", value_parser = running)]
    tide: Option<f64>,
    /// Threat table with bands, as `endline study threat STUDY --to` writes it.
    #[arg(long, value_name = "FILE-bands.csv")]
    threat: Option<PathBuf>,
    /// The page [default: the assembly's id, with -sheet.html].
    #[arg(long, value_name = "FILE.html")]
    to: Option<PathBuf>,
    /// Another assembly, to be compared on one page; may be repeated.
    #[arg(long = "with", value_name = "ASSEMBLY")]
    others: Vec<String>,
    /// Print it as PDF too, by an installed browser.
    #[arg(long, value_name = "FILE.pdf")]
    pdf: Option<PathBuf>,
}

pub(super) fn sheet(args: &SheetArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let host = host::load();
    let assemblies = std::iter::once(&args.fished.assembly).chain(&args.others);
    let sheets: Vec<ComplianceSheet> = assemblies
        .map(|assembly| sheet_of(assembly, args, library, &host))
        .collect::<Result<_, _>>()?;
    let (html, name) = match sheets.as_slice() {
        [one] => (one.html()?, "sheet"),
        several => (comparison(several)?, "comparison"),
    };
    let usual = || PathBuf::from(format!("{}-{name}.html", sheets[0].id));
    let page = args.to.clone().unwrap_or_else(usual);
    save::atomically(&page, html.as_bytes()).map_err(Error::on(&page, "cannot be written"))?;
    output::note(&format!("the {name} is {}", page.display()));
    if let Some(file) = &args.pdf {
        print_pdf(&page, file)?;
        output::note(&format!("printed as {}", file.display()));
    }
    Ok(ExitCode::SUCCESS)
}

fn sheet_of(
    assembly: &str,
    args: &SheetArgs,
    library: Option<&Path>,
    host: &PluginHost,
) -> Result<ComplianceSheet, Failure> {
    let (packs, fishing) = args.fished.open(library)?;
    let file = AssemblyFile::open(assembly, library)?;
    let request = Request {
        assembly: &file.id,
        sources: &file.sources,
        fishing,
        tide_m_s: args.tide.unwrap_or(USUAL_TIDE_M_S),
        threat: args.threat.clone(),
    };
    Ok(ComplianceSheet::of(&request, &packs, host)?)
}

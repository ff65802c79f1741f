//! `endline mill`: the strength law of a weak rope or link from a mill's breaks.

use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use endline_session::Error;
use endline_session::mill::{StrengthLaw, read_breaks, weak_link};
use endline_session::units::N_PER_LBF;

use super::quantity::force;
use super::{Failure, output};

#[derive(Debug, clap::Args)]
pub(super) struct MillArgs {
    /// Table of breaks: a CSV file with a column `break`, a force with its unit in each row.
    #[arg(value_name = "FILE.csv", required_unless_present = "breaks")]
    file: Option<PathBuf>,
    /// A break, such as "1,650 lbf", in place of a table; give it once for each.
    #[arg(long = "break", value_name = "FORCE", value_parser = force, conflicts_with = "file")]
    breaks: Vec<f64>,
    /// Write the product as a weak link for the gear library.
    #[arg(long, value_name = "FILE.toml", requires = "name")]
    out: Option<PathBuf>,
    /// Name of the product.
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(super) fn mill(args: &MillArgs) -> Result<ExitCode, Failure> {
    let (breaks, source) = match &args.file {
        None => (args.breaks.clone(), "breaks given on the command line".to_owned()),
        Some(file) => {
            let name = file.display().to_string();
            let text = endline_gear::read::text(file).map_err(Error::on(file, "cannot be read"))?;
            (read_breaks(&name, &text).map_err(Error::Diagnostics)?, name)
        }
    };
    let law = StrengthLaw::of(&breaks).map_err(Failure::failed)?;
    if let (Some(out), Some(name)) = (&args.out, &args.name) {
        let text =
            weak_link(&law, name, &source).map_err(|error| Failure::failed(error.message))?;
        fs::write(out, text).map_err(Error::on(out, "cannot be written"))?;
        output::note(&format!("wrote {}", out.display()));
    }
    let json = || serde_json::to_string_pretty(&law).map_err(Failure::failed);
    output::print(&if args.json { json()? + "\n" } else { words(&law) })?;
    Ok(ExitCode::SUCCESS)
}

fn words(law: &StrengthLaw) -> String {
    let between = |[least, most]: [f64; 2]| {
        format!("95 % between {:.0} and {:.0} lbf", least / N_PER_LBF, most / N_PER_LBF)
    };
    let mut text = format!(
        "{} breaks\nmean       {:.0} lbf, {}\ndeviation  {:.0} lbf, {}\n\n",
        law.breaks,
        law.mean_N / N_PER_LBF,
        between(law.mean_interval_N),
        law.deviation_N / N_PER_LBF,
        between(law.deviation_interval_N)
    );
    for approval in &law.approvals {
        text += &format!(
            "{}: mean of ten from {:.0} to {:.0} lbf\n  these breaks {}; ten more meet it with probability {:.3}\n",
            approval.source,
            approval.least_N / N_PER_LBF,
            approval.most_N / N_PER_LBF,
            if approval.holds { "meet it" } else { "do not meet it" },
            approval.probability
        );
    }
    text
}

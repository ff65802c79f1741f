//! `endline mill`: the strength law of a weak rope or link from a mill's breaks.

use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use endline_session::Error;
use endline_session::mill::{
    Approval, MeansLaws, MillTable, Sample, StrengthLaw, read_table, weak_link,
};
use endline_session::units::N_PER_LBF;
use serde::Serialize;

use super::quantity::force;
use super::{Failure, output};

#[derive(Debug, clap::Args)]
pub(super) struct MillArgs {
    /// CSV table with a column `break`, a force with its unit in each row; or with columns `mean` and `count`, and optionally `deviation` and `sample`.
    #[arg(value_name = "FILE.csv", required_unless_present_any = ["breaks", "mean"])]
    file: Option<PathBuf>,
    /// A break, such as "1,650 lbf", in place of a table; give it once for each.
    #[arg(long = "break", value_name = "FORCE", value_parser = force, conflicts_with = "file")]
    breaks: Vec<f64>,
    /// Mean of breaks as a report prints it, in place of single breaks.
    #[arg(long, value_name = "FORCE", value_parser = force, requires = "count", conflicts_with_all = ["file", "breaks"])]
    mean: Option<f64>,
    /// Number of breaks behind the mean.
    #[arg(long, value_name = "N", requires = "mean", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    count: Option<u32>,
    /// Standard deviation of these breaks, if the report prints it.
    #[arg(long, value_name = "FORCE", value_parser = force, requires = "mean")]
    deviation: Option<f64>,
    /// Greatest strength that is allowed, such as "600 lbf", in place of NOAA's two criteria for 1,700 lbf; give it once for each.
    #[arg(long = "limit", value_name = "FORCE", value_parser = force)]
    limits: Vec<f64>,
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
    let (sample, source) = match sample(args)? {
        Given::One(sample, source) => (sample, source),
        Given::Several(samples) => {
            if args.out.is_some() {
                let says = "--out writes one product, and the table has means of several samples; give --mean, --count and --deviation of one of them";
                return Err(Failure::failed(says));
            }
            let laws = MeansLaws::of(&samples, &args.limits).map_err(Failure::failed)?;
            let all: Vec<String> = laws.samples.iter().map(words).collect();
            print(args, &laws, &all.join("\n"))?;
            return Ok(ExitCode::SUCCESS);
        }
    };
    let law = StrengthLaw::of(&sample, &args.limits).map_err(Failure::failed)?;
    if let (Some(out), Some(name)) = (&args.out, &args.name) {
        let text =
            weak_link(&law, name, &source).map_err(|error| Failure::failed(error.message))?;
        fs::write(out, text).map_err(Error::on(out, "cannot be written"))?;
        output::note(&format!("wrote {}", out.display()));
    }
    print(args, &law, &words(&law))?;
    Ok(ExitCode::SUCCESS)
}

/// What the user gave: one product with its source, or the rows of a table of means.
enum Given {
    One(Sample, String),
    Several(Vec<Sample>),
}

fn sample(args: &MillArgs) -> Result<Given, Failure> {
    if let Some((mean_n, count)) = args.mean.zip(args.count) {
        let count = usize::try_from(count).map_err(Failure::failed)?;
        let sample = Sample { name: String::new(), count, mean_n, deviation_n: args.deviation };
        return Ok(Given::One(sample, "mean given on the command line".to_owned()));
    }
    let (breaks, source) = match &args.file {
        None => (args.breaks.clone(), "breaks given on the command line".to_owned()),
        Some(file) => {
            let name = file.display().to_string();
            let text = endline_gear::read::text(file).map_err(Error::on(file, "cannot be read"))?;
            match read_table(&name, &text).map_err(Error::Diagnostics)? {
                MillTable::Breaks(breaks) => (breaks, name),
                MillTable::Means(samples) => return Ok(Given::Several(samples)),
            }
        }
    };
    Ok(Given::One(Sample::of(&breaks).map_err(Failure::failed)?, source))
}

fn print(args: &MillArgs, result: &impl Serialize, words: &str) -> Result<(), Failure> {
    let json = || serde_json::to_string_pretty(result).map_err(Failure::failed);
    let text = if args.json { json()? + "\n" } else { words.to_owned() };
    output::print(&text)?;
    Ok(())
}

fn words(law: &StrengthLaw) -> String {
    let lbf = |newtons: f64| newtons / N_PER_LBF;
    let between = |interval: Option<[f64; 2]>| match interval {
        Some([least, most]) => format!(", 95 % between {:.0} and {:.0} lbf", lbf(least), lbf(most)),
        None => String::new(),
    };
    let name = if law.sample.is_empty() { String::new() } else { format!("{}: ", law.sample) };
    let breaks = if law.breaks == 1 { "break" } else { "breaks" };
    let mut text = format!(
        "{name}{} {breaks}\nmean       {:.0} lbf{}\n",
        law.breaks,
        lbf(law.mean_N),
        between(law.mean_interval_N)
    );
    text += &match law.deviation_N {
        Some(deviation_n) => format!(
            "deviation  {:.0} lbf{}\n\n",
            lbf(deviation_n),
            between(law.deviation_interval_N)
        ),
        None => "deviation  unknown\n\n".to_owned(),
    };
    for approval in &law.approvals {
        text += &of_approval(approval);
    }
    for says in &law.unknown {
        text += &format!("{says}\n");
    }
    text
}

fn of_approval(approval: &Approval) -> String {
    let [least, most] = [approval.least_N, approval.most_N].map(|newtons| newtons / N_PER_LBF);
    let asks = if least > 0.0 {
        format!("mean of ten from {least:.0} to {most:.0} lbf")
    } else {
        format!("at most {most:.0} lbf")
    };
    let held = if approval.holds { "meet it" } else { "do not meet it" };
    let mut text = format!("{}: {asks}\n  these breaks {held} in the mean", approval.source);
    if let Some((ten, one)) = approval.probability.zip(approval.one_probability) {
        text += &format!(
            "; the mean of ten more meets it with probability {ten:.3}, one more break with {one:.3}"
        );
    }
    text + "\n"
}

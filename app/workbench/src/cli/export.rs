//! `endline export`: the moments of a recording, or of a scenario, as tables.

use std::path::Path;
use std::process::ExitCode;

use endline_session::export::tables;

use super::args::{ExportArgs, TableFormat};
use super::interrupt::Interrupt;
use super::player::Player;
use super::table::columns;
use super::{Failure, output};

/// Rows of a table at most: some 150 bytes of memory each.
const MOST: usize = 4_000_000;

pub(super) fn export(args: &ExportArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let interrupt = Interrupt::watch();
    let mut player = Player::open(&args.file, args.other_plugins, library)?;
    let times = player.times(args.from, args.to, args.rate)?;
    let nodes = player.run.frame().nodes.len();
    if nodes * times.len() > MOST {
        return Err(Failure::usage(format!(
            "{} moments of {nodes} nodes are more than {MOST} rows; ask for fewer with --rate, --from or --to",
            times.len()
        )));
    }
    let (frames, readings) = player.moments(&times, &interrupt)?;
    let about = [
        ("program", format!("endline {}", endline_session::VERSION)),
        ("scenario", player.scenario.clone()),
        ("moments_per_second", args.rate.to_string()),
        ("axes", "x east, y north, z up; z = 0 is the mean sea surface".to_owned()),
    ];
    let about = about.map(|(key, text)| (key.to_owned(), text));
    let format = match args.format {
        TableFormat::Parquet => tables::TableFormat::Parquet,
        TableFormat::Arrow => tables::TableFormat::Arrow,
        TableFormat::Csv => tables::TableFormat::Csv,
    };
    let moments =
        tables::Moments { model: player.run.model(), frames: &frames, readings: &readings };
    let written = tables::write(&args.out, format, &moments, &about);
    let mut rows = vec![vec!["table".to_owned(), "rows".to_owned()]];
    let written = written.map_err(Failure::failed)?;
    rows.extend(written.iter().map(|(name, rows)| vec![(*name).to_owned(), rows.to_string()]));
    output::print(&columns(&rows))?;
    if frames.len() < times.len() {
        output::note(&format!("{} of {} moments: the run ends there", frames.len(), times.len()));
    }
    Ok(interrupt.exit_code().unwrap_or(ExitCode::SUCCESS))
}

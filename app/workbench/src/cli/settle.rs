//! `endline settle`: the gear at rest.

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use endline_session::settled::SettledShape;
use endline_sim::settle as find_rest;

use super::args::SettleArgs;
use super::{Failure, host, output, scenario, table};

pub(super) fn settle(args: &SettleArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let over = args.over.overrides();
    let prepared = scenario::prepared(&args.scenario, library, &host::load(), over)?;
    let start = Instant::now();
    let settled = find_rest(&prepared.model);
    let shape = SettledShape::of(&prepared, &settled, start.elapsed().as_secs_f64());
    output::print(&if args.json { shape.json() + "\n" } else { table::settled(&shape) })?;
    if settled.converged {
        return Ok(ExitCode::SUCCESS);
    }
    Err(Failure::failed(format!(
        "did not come to rest in {} passes: {}",
        settled.trace_n.len(),
        settled.why()
    )))
}

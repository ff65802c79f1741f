//! `cargo xtask instructions`: counts the instructions of the sections of the encounter benchmark, and compares them with the
//! table of counts that the repository keeps.
//!
//! Clock times differ between machines and hours; the number of instructions of a run does not. Callgrind counts them. Copies by
//! the C library are left out, because Callgrind counts one instruction for each byte or vector of a copy, by the processor's
//! kind, and not by the work of the program.

mod callgrind;
mod table;

use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::Outcome;
use crate::system_packages::are_here;
use crate::workspace::Workspace;
use table::{Row, Table};

/// Change of a count that is not an error.
const TOLERANCE: f64 = 0.02;

/// Compares the counts of this checkout with the last row of the table; prints both.
/// Errors: when a count differs by more than the tolerance, a section has no count, or the benchmark fails.
pub fn compare(workspace: &Workspace) -> Outcome {
    let Some(row) = measured(workspace, "")? else { return Ok(()) };
    let table = Table::read(workspace)?;
    let complaints = table.complaints(&row, TOLERANCE);
    print!("{}", table.comparison(&row));
    if complaints.is_empty() {
        return Ok(());
    }
    let of = table.last().map(|last| last.compiler.as_str()).unwrap_or_default();
    if of != row.compiler {
        println!(
            "the table was written with {of}, this is {}: differences are not an error",
            row.compiler
        );
        return Ok(());
    }
    Err(format!(
        "{}\nIf this is intended, run `cargo xtask instructions --write \"REASON\"` and commit the table with the change",
        complaints.join("\n")
    ))
}

/// Adds a row with the counts of this checkout to the table, and writes the page of its history.
/// Errors: when the benchmark fails or a file cannot be written.
pub fn write(workspace: &Workspace, reason: &str) -> Outcome {
    let Some(row) = measured(workspace, reason)? else {
        return Err("without Callgrind there are no counts to write".to_owned());
    };
    let mut table = Table::read(workspace)?;
    print!("{}", table.comparison(&row));
    table.add(row);
    table.write(workspace)
}

/// Counts all sections; `None` where the tools for it are missing, which is printed.
fn measured(workspace: &Workspace, reason: &str) -> Outcome<Option<Row>> {
    if !are_here("counting instructions", &["valgrind"], "valgrind") {
        return Ok(None);
    }
    let processor = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    if !(cfg!(target_arch = "x86_64") && processor.contains("avx2")) {
        eprintln!("skipped: instructions are counted on x86-64 processors with AVX2 only");
        return Ok(None);
    }
    let bench = workspace.bench("endline-gear", "encounter")?;
    let names = answer(Command::new(&bench).arg("sections=all").current_dir(&workspace.root))?;
    let names: Vec<&str> = names.lines().collect();
    let folder = workspace.target.join("instructions");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let (next, counts) = (AtomicUsize::new(0), Mutex::new(vec![None; names.len()]));
    let work = || {
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(name) = names.get(at) else { return };
            let count = callgrind::count(&bench, name, &folder);
            if let Ok(mut counts) = counts.lock() {
                counts[at] = Some(count);
            }
        }
    };
    std::thread::scope(|scope| {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        (0..threads.min(names.len())).for_each(|_| drop(scope.spawn(work)));
    });
    let counts = counts.into_inner().map_err(|error| error.to_string())?;
    let counts = names.iter().zip(counts).map(|(name, count)| {
        let count = count.ok_or_else(|| format!("{name}: not counted"))??;
        Ok(((*name).to_owned(), count))
    });
    Ok(Some(Row {
        date: answer(Command::new("date").args(["--utc", "+%F"]))?,
        compiler: answer(Command::new("rustc").arg("--version"))?
            .split_whitespace()
            .take(2)
            .collect::<Vec<_>>()
            .join(" "),
        reason: reason.to_owned(),
        counts: counts.collect::<Outcome<_>>()?,
    }))
}

/// Runs a command; returns its standard output.
/// Errors: when it cannot be started or fails.
fn answer(command: &mut Command) -> Outcome<String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("cannot start {name}: {error}"))?;
    if !output.status.success() {
        return Err(format!("{name} failed: {}", String::from_utf8_lossy(&output.stderr)));
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

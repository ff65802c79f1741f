//! `cargo xtask instructions`: counts the instructions of the sections of the encounter benchmark, and compares them with the
//! table of counts that the repository keeps.
//!
//! Clock times differ between machines and hours; the number of instructions of a run does not. Callgrind counts them. Copies by
//! the C library are left out, because Callgrind counts one instruction for each byte or vector of a copy, by the processor's
//! kind, and not by the work of the program.

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

/// Runs a section of the benchmark under Callgrind, and sums the instructions in its output file.
///
/// The format of the file: <https://valgrind.org/docs/manual/cl-format.html>.
mod callgrind {
    use std::collections::HashMap;
    use std::path::Path;
    use std::process::Command;

    use crate::Outcome;

    /// Functions of the C library that copy or fill memory, by the begin of their names.
    const COPIES: [&str; 4] = ["__memcpy", "__memmove", "__memset", "__memcmp"];

    /// Counts the instructions of a section without copies, per simulated second.
    /// Errors: when the benchmark fails, or its output cannot be read.
    pub fn count(bench: &Path, section: &str, folder: &Path) -> Outcome<f64> {
        let file = folder.join(section).with_extension("callgrind");
        let option = format!("--callgrind-out-file={}", file.display());
        let arguments = ["--tool=callgrind", "--instr-atstart=no", &option];
        let mut command = Command::new("valgrind");
        command.args(arguments).arg(bench).arg(format!("count={section}"));
        let printed = super::answer(&mut command)?;
        let seconds = printed.split_whitespace().nth(1).and_then(|word| word.parse::<f64>().ok());
        let seconds = seconds
            .filter(|seconds| *seconds > 0.0)
            .ok_or(format!("{section}: printed {printed:?}"))?;
        let text = std::fs::read_to_string(&file)
            .map_err(|error| format!("cannot read {}: {error}", file.display()))?;
        Ok(without_copies(&text) as f64 / seconds)
    }

    /// Sums the instructions of all functions except copies.
    fn without_copies(text: &str) -> u64 {
        let mut names: HashMap<&str, &str> = HashMap::new();
        let (mut sum, mut is_copy, mut is_call) = (0, false, false);
        for line in text.lines() {
            if let Some((key, rest)) = line.split_once('=') {
                // A function is named where its number appears first: `fn=(12) name`, later `fn=(12)`.
                if let Some((number, name)) = rest.split_once(' ').filter(|_| key.ends_with("fn")) {
                    names.insert(number, name);
                }
                match key {
                    "fn" => {
                        let number = rest.split(' ').next().unwrap_or_default();
                        let name = names.get(number).copied().unwrap_or_default();
                        is_copy = COPIES.iter().any(|copy| name.starts_with(copy));
                    }
                    "calls" => is_call = true,
                    _ => {}
                }
            } else if line
                .starts_with(|first: char| first.is_ascii_digit() || "+-*".contains(first))
            {
                // The line after `calls` has the cost of the called function, which is counted there.
                if !is_copy && !is_call {
                    let cost = line.split(' ').nth(1).and_then(|cost| cost.parse::<u64>().ok());
                    sum += cost.unwrap_or(0);
                }
                is_call = false;
            }
        }
        sum
    }

    #[cfg(test)]
    mod tests {
        use super::without_copies;

        #[test]
        fn calls_and_copies_are_left_out() {
            let text = "events: Ir\nfl=(1) a.rs\nfn=(1) main\n16 400\ncfn=(2) __memcpy_avx\ncalls=1 50\n16 90\n+1 3\n\
                        fn=(2)\n50 90\n\nfn=(3) step\n+3 7\n* 20\n-1 5\ntotals: 525\n";
            assert_eq!(without_copies(text), 400 + 3 + 7 + 20 + 5);
        }
    }
}

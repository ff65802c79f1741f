//! Runs a section of the benchmark under Callgrind, and sums the instructions in its output file.
//!
//! The format of the file: <https://valgrind.org/docs/manual/cl-format.html>.

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
        } else if line.starts_with(|first: char| first.is_ascii_digit() || "+-*".contains(first)) {
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

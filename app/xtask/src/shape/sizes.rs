//! How long files and functions are, and how many arguments functions take.

use super::functions::functions;
use super::tree::Crate;
use super::{ARGUMENTS_MAX, FILE_MAX, FILE_MEDIAN, FUNCTION_MAX, FUNCTION_MEDIAN, FUNCTION_P95};

/// Something measured, with where it is.
pub struct Measured {
    /// Its size: lines or arguments.
    pub size: usize,
    /// File, and for a function its line and name.
    pub place: String,
}

/// The sizes of the whole workspace; each list from the largest to the smallest.
#[derive(Default)]
pub struct Sizes {
    /// Lines of files.
    pub files: Vec<Measured>,
    /// Lines of functions from `fn` to the closing brace.
    pub functions: Vec<Measured>,
    /// Lines of code in functions, as clippy counts them.
    pub bodies: Vec<Measured>,
    /// Arguments of functions.
    pub arguments: Vec<Measured>,
}

impl Sizes {
    /// Measures all files of these crates.
    pub fn of(crates: &[Crate]) -> Self {
        let mut sizes = Self::default();
        for file in crates.iter().flat_map(|one| &one.files) {
            sizes.files.push(Measured { size: file.code.lines, place: file.path.clone() });
            for function in functions(&file.code.tokens) {
                let place = format!("{}:{} {}", file.path, function.line, function.name);
                let measured = |size| Measured { size, place: place.clone() };
                sizes.functions.push(measured(function.lines));
                sizes.bodies.push(measured(function.body_lines));
                sizes.arguments.push(measured(function.arguments));
            }
        }
        for list in
            [&mut sizes.files, &mut sizes.functions, &mut sizes.bodies, &mut sizes.arguments]
        {
            list.sort_by(|one, other| (other.size, &one.place).cmp(&(one.size, &other.place)));
        }
        sizes
    }
}

/// The smallest size that this share (0 to 1) of a list does not exceed; 0 for an empty list.
pub fn quantile(largest_first: &[Measured], share: f64) -> usize {
    let above = (largest_first.len() as f64 * (1.0 - share)).floor() as usize;
    let at = above.min(largest_first.len().saturating_sub(1));
    largest_first.get(at).map_or(0, |measured| measured.size)
}

/// Those over a limit.
pub fn over(largest_first: &[Measured], limit: usize) -> &[Measured] {
    &largest_first[..largest_first.partition_point(|measured| measured.size > limit)]
}

/// One list: its spread, how many are over the limits, and the largest, at least ten.
fn table(title: &str, list: &[Measured], limits: &[usize]) -> String {
    let [median, p95, max] = [0.5, 0.95, 1.0].map(|share| quantile(list, share));
    let count = list.len();
    let mut text =
        format!("{title}: {count} of them, median {median}, 95th percentile {p95}, max {max}\n");
    for &limit in limits {
        text += &format!("  over {limit}: {}\n", over(list, limit).len());
    }
    let shown = limits.last().map_or(0, |&limit| over(list, limit).len()).max(10);
    for measured in list.iter().take(shown) {
        text += &format!("  {:5}  {}\n", measured.size, measured.place);
    }
    text
}

/// Lists the sizes of these crates.
pub fn list(crates: &[Crate]) -> String {
    let sizes = Sizes::of(crates);
    [
        table("lines of a file", &sizes.files, &[FILE_MEDIAN, FILE_MAX]),
        table(
            "lines of a function, from `fn` to its brace",
            &sizes.functions,
            &[FUNCTION_MEDIAN, FUNCTION_P95, FUNCTION_MAX],
        ),
        table("lines of code in a function, as clippy counts", &sizes.bodies, &[]),
        table(
            "arguments of a function, members of tuples counted, `self` not",
            &sizes.arguments,
            &[ARGUMENTS_MAX],
        ),
    ]
    .concat()
}

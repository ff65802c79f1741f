//! The lines at which a study aims its whales, as a model has them.

use endline_gear::{At, hint};
use endline_sim::Model;

use crate::error::Error;

/// The lines of a model that a study aims at, in its order; a line made of pieces is all of them. All lines where it names none.
///
/// # Errors
/// A line that the model lacks, at its place in the study.
pub(crate) fn lines_aimed_at(model: &Model, wanted: &[At<String>]) -> Result<Vec<usize>, Error> {
    let ids = || model.spec.lines.iter().map(|line| line.id.as_str());
    if wanted.is_empty() {
        return Ok((0..ids().count()).collect());
    }
    let mut lines = Vec::new();
    for id in wanted {
        let is_piece =
            |known: &str| known.strip_prefix(&id.value).is_some_and(|rest| rest.starts_with('.'));
        let found = ids().enumerate().filter(|(_, known)| *known == id.value || is_piece(known));
        let before = lines.len();
        lines.extend(found.map(|(line, _)| line));
        if lines.len() == before {
            let message = format!("the baseline's gear has no line `{}`", id.value);
            return Err(Error::Diagnostics(vec![id.place.error(message, hint(&id.value, ids()))]));
        }
    }
    Ok(lines)
}

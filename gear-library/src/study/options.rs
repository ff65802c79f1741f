//! All options of a study: those written out, and those that axes make.

use crate::fields::Fields;

use super::axis;
use super::option::{StudyOption, read_each, sorted};

/// Reads `[[option]]` and `[[axis]]`; options sorted by id.
pub(super) fn read_all(fields: &Fields<'_>) -> Vec<StudyOption> {
    let (written, axes) = (fields.tables("option"), fields.tables("axis"));
    if written.is_empty() && axes.is_empty() {
        fields.missing("option", "write each option under [[option]], the baseline too");
    }
    let mut options = read_each(written, "option", fields.problems());
    options.extend(axis::read_all(axes, fields.problems()));
    sorted(options, "option", fields.problems())
}

//! Numbers of an outcome as people read them; the same in the table, the document and its check.

use super::outcome::Verdict;

/// A value with its unit: metres below a centimetre in millimetres, six significant digits.
#[must_use]
pub fn value(number: f64, unit: &str) -> String {
    match unit {
        "m" if number.abs() < 0.01 && number.abs() > 0.0 => {
            format!("{} mm", significant(1e3 * number))
        }
        "" => significant(number),
        _ => format!("{} {unit}", significant(number)),
    }
}

/// A share in percent.
#[must_use]
pub fn percent(share: f64) -> String {
    let digits = if share.abs() < 0.1 { 3 } else { 1 };
    format!("{:.digits$} %", 100.0 * share)
}

/// How far off a verdict is.
#[must_use]
pub fn error(verdict: &Verdict, error: f64) -> String {
    if verdict.share { percent(error) } else { value(error, verdict.unit) }
}

/// How far off it may be.
#[must_use]
pub fn limit(verdict: &Verdict) -> String {
    match verdict.between {
        Some([least, most]) => {
            format!("{} to {}", value(least, verdict.unit), value(most, verdict.unit))
        }
        None if verdict.share => format!("{} %", significant(100.0 * verdict.limit)),
        None => value(verdict.limit, verdict.unit),
    }
}

/// Six significant digits, without zeros at the end.
fn significant(number: f64) -> String {
    let rounded: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    if rounded.abs() >= 1e6 || (rounded.abs() < 1e-4 && rounded.abs() > 0.0) {
        format!("{rounded:e}")
    } else {
        format!("{rounded}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(value(0.000_523_4, "m"), "0.5234 mm");
        assert_eq!(value(50.340_610_59, "m"), "50.3406 m");
        assert_eq!(value(23.936_301, "N"), "23.9363 N");
        assert_eq!(value(2.566_316, ""), "2.56632");
        assert_eq!(percent(0.001_31), "0.131 %");
        assert_eq!(percent(0.25), "25.0 %");
    }
}

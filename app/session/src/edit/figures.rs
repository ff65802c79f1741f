//! Figures of library entries as they are typed: each loses the source of the value before it, and the weight in water follows the
//! mass.

use endline_gear::units::{self, Quantity};
use endline_gear::{Confidence, Document, EditError, Field, Kind, UNSOURCED};

use super::option::parts;

/// A figure, and another that changes with it in proportion for the same material.
const FOLLOWS: (&str, &str) = ("mass", "wet_weight");

/// Sets a field of a text by its path. Answers what else changed, in a sentence.
/// Errors: where the text has no such place.
pub(super) fn set(
    document: &mut Document,
    path: &str,
    field: &str,
    value: &str,
) -> Result<Option<String>, EditError> {
    let figures = kind_of(path).map_or(&[][..], Kind::fields);
    let figure = |key: &str| figures.iter().find(|figure| figure.key == key);
    if let Some(figure) = figure(field) {
        return typed(document, figure, figures, value);
    }
    match field.rsplit_once('.') {
        Some((of, key @ ("source" | "confidence"))) if figure(of).is_some() => {
            document.set_of_figure(of, key, value)?;
        }
        _ => document.set(field, value)?,
    }
    Ok(None)
}

/// A number typed without a unit, with the unit of the value before it; `None` where either has no such thing. A share stays as it is
/// typed, for `0.5` and `0.5 %` are both meant.
pub(super) fn with_unit_before(typed: &str, before: &str) -> Option<String> {
    let typed = typed.trim();
    let is_number = |letter: char| letter.is_ascii_digit() || "+-.,/ ".contains(letter);
    let bare = !typed.is_empty() && typed.chars().all(is_number);
    let mut measures =
        Quantity::ALL.iter().copied().filter(|quantity| *quantity != Quantity::Ratio);
    let measured = bare && measures.any(|quantity| units::parse(before, quantity).is_ok());
    let unit = before.trim().trim_start_matches(is_number);
    measured.then(|| format!("{typed} {unit}"))
}

/// Marks every source in the copy of a library item as copied from the item of an id, and every confidence as an estimate.
///
/// A source that differs from the one in `original` is the user's own and stays.
pub(super) fn mark_copied(
    copy: &mut Document,
    id: &str,
    original: &Document,
) -> Result<(), EditError> {
    mark_below(copy, "", id, original)
}

fn mark_below(
    copy: &mut Document,
    table: &str,
    id: &str,
    original: &Document,
) -> Result<(), EditError> {
    let parts = parts(copy, table);
    let is_key = |part: &String, key: &str| part.rsplit('.').next() == Some(key);
    if let Some(field) = parts.iter().find(|part| is_key(part, "source")) {
        let source = copy.get(field).unwrap_or_default();
        if original.get(field).as_ref() != Some(&source) {
            return Ok(());
        }
        copy.set(field, &format!("copied from {id}, not verified; its source there: {source}"))?;
    }
    let is_confidence = |part: &&String| is_key(part, "confidence") || is_key(part, "sureness");
    if let Some(field) = parts.iter().find(is_confidence) {
        copy.set(field, Confidence::Estimate.word())?;
    }
    parts.iter().try_for_each(|part| mark_below(copy, part, id, original))
}

/// The kind of a library file by its path.
fn kind_of(path: &str) -> Option<Kind> {
    path.split_once('/').and_then(|(folder, _)| Kind::in_folder(folder))
}

fn typed(
    document: &mut Document,
    figure: &Field,
    figures: &[Field],
    value: &str,
) -> Result<Option<String>, EditError> {
    let before = document.get(figure.key);
    document.set_figure(figure.key, value, UNSOURCED, Confidence::Estimate)?;
    let (leads, follows) = FOLLOWS;
    let other = figures.iter().find(|other| figure.key == leads && other.key == follows);
    let (Some(other), Some(before)) = (other, before) else { return Ok(None) };
    let Some(factor) = factor(&before, value, figure.quantity) else { return Ok(None) };
    let Some(old) = document.get(other.key) else { return Ok(None) };
    let Some(new) = scaled(&old, factor) else { return Ok(None) };
    let source = format!("{old} at {before}, in proportion to the mass of the same material");
    document.set_figure(other.key, &new, &source, Confidence::Derived)?;
    Ok(Some(format!("the weight in water follows the mass: {old} became {new}")))
}

/// The new value over the old one, where both can be read and differ.
fn factor(before: &str, after: &str, quantity: Quantity) -> Option<f64> {
    let [before, after] = [before, after].map(|text| units::parse(text, quantity).ok());
    let factor = after? / before?;
    (factor.is_finite() && factor > 0.0 && (factor - 1.0).abs() > 1e-12).then_some(factor)
}

/// A figure's text with its number multiplied, to four digits; its unit stays.
fn scaled(text: &str, factor: f64) -> Option<String> {
    let is_number = |letter: char| letter.is_ascii_digit() || "+-.,".contains(letter);
    let end = text.find(|letter| !is_number(letter)).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let value: f64 = number.replace(',', "").parse().ok()?;
    let value = value * factor;
    #[expect(clippy::cast_possible_truncation, reason = "digits of a number of everyday size")]
    let whole_digits = value.abs().max(1e-9).log10().floor() as i32 + 1;
    let decimals = usize::try_from(4 - whole_digits).unwrap_or(0);
    let digits = format!("{value:.decimals$}");
    let short = if digits.contains('.') {
        digits.trim_end_matches('0').trim_end_matches('.')
    } else {
        &digits
    };
    Some(format!("{short}{unit}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRAP: &str = "source = \"a shop\"\nconfidence = \"measured\"\nmass = \"40 lb\"\nwet_weight = { value = \"130 N\", source = \"weighed\", confidence = \"measured\" }\n";

    fn trap() -> Document {
        Document::parse(TRAP).unwrap()
    }

    #[test]
    fn twice_the_mass_is_twice_the_weight_in_water_and_says_so() {
        let mut trap = trap();
        let said = set(&mut trap, "traps/my-trap.toml", "mass", "80 lb").unwrap();
        assert_eq!(
            said.as_deref(),
            Some("the weight in water follows the mass: 130 N became 260 N")
        );
        let text = |field: &str| trap.get(field).unwrap();
        assert_eq!([text("mass"), text("mass.source")], ["80 lb".to_owned(), UNSOURCED.into()]);
        assert_eq!(text("wet_weight.value"), "260 N");
        assert_eq!(
            text("wet_weight.source"),
            "130 N at 40 lb, in proportion to the mass of the same material"
        );
        assert_eq!(text("wet_weight.confidence"), "derived");
    }

    #[test]
    fn a_weight_that_is_typed_stands_and_a_source_is_taken() {
        let mut trap = trap();
        let path = "traps/my-trap.toml";
        set(&mut trap, path, "wet_weight", "140 N").unwrap();
        assert_eq!(trap.get("mass").as_deref(), Some("40 lb"));
        assert_eq!(trap.get("wet_weight.source").as_deref(), Some(UNSOURCED));
        set(&mut trap, path, "wet_weight.source", "weighed at the dock").unwrap();
        set(&mut trap, path, "wet_weight.confidence", "measured").unwrap();
        let line = "wet_weight = { value = \"140 N\", source = \"weighed at the dock\", confidence = \"measured\" }";
        assert!(trap.text().contains(line), "{}", trap.text());
        // What is no figure of an entry has no source of its own.
        set(&mut trap, path, "name", "Mine").unwrap();
        assert_eq!(trap.get("name").as_deref(), Some("Mine"));
        assert!(set(&mut trap, "scenario", "mass", "1 kg").unwrap().is_none());
    }

    #[test]
    fn a_copy_claims_no_source_of_its_own_and_no_measurement() {
        let original = trap();
        let mut copy = trap();
        set(&mut copy, "traps/copy.toml", "mass", "50 lb").unwrap();
        copy.set_of_figure("mass", "source", "my scale").unwrap();
        mark_copied(&mut copy, "my-trap", &original).unwrap();
        let text = |field: &str| copy.get(field).unwrap();
        let copied = "copied from my-trap, not verified; its source there: a shop";
        assert_eq!([text("source"), text("confidence")], [copied, "estimate"]);
        assert_eq!(text("mass.source"), "my scale", "a source that the user gave stays");
        assert!(!copy.text().contains("measured"), "{}", copy.text());
    }

    #[test]
    fn a_bare_number_takes_the_unit_that_was_there() {
        let cases = [
            ("1700", "2,700 lbf", Some("1700 lbf")),
            ("1,700", "12 kN", Some("1,700 kN")),
            ("7/16", "3/8 in", Some("7/16 in")),
            ("-0.5", "-0.701 N/m", Some("-0.5 N/m")),
            ("0.5", "75 %", None),
            ("0.5", "0.3", None),
            ("1700 N", "2,700 lbf", None),
            ("pp", "12 kN", None),
            ("12", "e7-99", None),
            ("1700", "1,700 lbf link", None),
            ("1", "2 cases of 2005", None),
            ("45", "90 deg", Some("45 deg")),
            ("", "12 kN", None),
        ];
        for (typed, before, expected) in cases {
            assert_eq!(with_unit_before(typed, before).as_deref(), expected, "{typed} {before}");
        }
    }

    #[test]
    fn numbers_keep_unit_sign_and_four_digits() {
        let cases = [
            ("130 N", 2.0, "260 N"),
            ("-0.701 N/m", 1.1, "-0.7711 N/m"),
            ("1,700 lbf", 0.5, "850 lbf"),
            ("0.42", 3.0, "1.26"),
            ("2.5 kN", 1.0 / 3.0, "0.8333 kN"),
        ];
        for (text, factor, expected) in cases {
            assert_eq!(scaled(text, factor).as_deref(), Some(expected));
        }
        assert_eq!(scaled("much", 2.0), None);
    }
}

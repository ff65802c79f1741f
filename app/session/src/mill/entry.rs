//! Breaks as an item of the library.

use endline_gear::units::{Quantity, find, format};
use endline_gear::{Document, EditError, Setting};

use super::law::StrengthLaw;

/// The text of a weak link that parts as the product broke: its mean as rating, its spread between pieces.
///
/// # Errors
/// Where the texts cannot be written into the file.
pub fn weak_link(law: &StrengthLaw, name: &str, source: &str) -> Result<String, EditError> {
    let mut document = Document::parse("format = 1\nkind = \"weak-link\"\n")?;
    let newtons = (law.mean_N * 10.0).round() / 10.0;
    let rating = match find("lbf", Quantity::Force) {
        Some(unit) => {
            let number = (law.mean_N / unit.factor() * 10.0).round() / 10.0;
            format(number * unit.factor(), unit)
        }
        None => format!("{newtons} N"),
    };
    let spread = format!("{:.4}", law.deviation_N / law.mean_N);
    let breaks = law.breaks;
    let source = format!("{source}: mean and standard deviation of {breaks} breaks");
    let texts =
        [("name", name), ("source", &source), ("confidence", "measured"), ("rating", &rating)];
    for (field, text) in texts {
        document.put(field, &Setting::text(text))?;
    }
    document.put("spread", &Setting::plain(&spread))?;
    Ok(document.text())
}

#[cfg(test)]
mod tests {
    use endline_gear::Library;

    use super::*;

    #[test]
    fn the_entry_is_an_item_of_the_library_without_a_problem() {
        let law = StrengthLaw::of(&[7400.0, 7500.0, 7600.0]).unwrap();
        let text = weak_link(&law, "Sleeve of a mill", "mill.csv").unwrap();
        let problems = Library::check_file("weak-links/mill.toml", &text);
        assert!(problems.is_empty(), "{problems:?}\n{text}");
        // 7,500 N are 1,686.1 lbf; 100 of 7,500 are 1.33 %.
        assert!(text.contains("\"1686.1 lbf\"") && text.contains("spread = 0.0133"), "{text}");
        assert!(text.contains("mill.csv: mean and standard deviation of 3 breaks"), "{text}");
    }
}

//! Names as stems of files.

/// A name as the stem of a file: lower case, words joined by dashes.
#[must_use]
pub fn slug(name: &str) -> String {
    let words: String = name
        .to_lowercase()
        .chars()
        .map(|letter| if letter.is_ascii_alphanumeric() { letter } else { ' ' })
        .collect();
    let joined = words.split_whitespace().collect::<Vec<_>>().join("-");
    if joined.is_empty() { "entry".to_owned() } else { joined }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_becomes_a_stem() {
        assert_eq!(slug("3/8 in Poly (mill)"), "3-8-in-poly-mill");
        assert_eq!(slug("***"), "entry");
    }
}

//! Names of files: a name as a stem, and a file that is not there yet.

use std::path::{Path, PathBuf};

/// A name as the stem of a file: lower case, words joined by dashes.
pub fn slug(name: &str) -> String {
    let words: String = name
        .to_lowercase()
        .chars()
        .map(|letter| if letter.is_ascii_alphanumeric() { letter } else { ' ' })
        .collect();
    let joined = words.split_whitespace().collect::<Vec<_>>().join("-");
    if joined.is_empty() { "entry".to_owned() } else { joined }
}

/// A file of a folder that is not there: `stem.toml`, else `stem-2.toml` and so on; none where a thousand are.
pub fn free_file(folder: &Path, stem: &str) -> Option<PathBuf> {
    let named = |number: u32| match number {
        1 => folder.join(format!("{stem}.toml")),
        number => folder.join(format!("{stem}-{number}.toml")),
    };
    (1..=1000).map(named).find(|path| !path.exists())
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

//! Words of a command line as a shell takes them.

use std::path::Path;

/// A word quoted for a shell where it needs that.
pub fn word(word: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./=,:+%@".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// A path quoted for a shell where it needs that.
pub fn path(path: &Path) -> String {
    word(&path.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with the words that a shell reads.
    #[cfg(unix)]
    #[test]
    fn a_shell_takes_a_word_for_what_it_was() {
        let words =
            ["study", "", "it's", "a b", "$HOME", "`id`", "two\nlines", "\\", "*", "#1", "Bä r"];
        for wanted in words {
            let script = format!("printf %s {}", word(wanted));
            let output = std::process::Command::new("sh").args(["-c", &script]).output().unwrap();
            assert_eq!(String::from_utf8(output.stdout).unwrap(), wanted);
        }
        assert_eq!(path(Path::new("results/a-1")), "results/a-1");
    }
}

//! Valid ids and paths in files.

use std::path::{Component, Path};

/// Help on ids.
pub const ID_HELP: &str =
    "an id begins with a letter or digit, followed by letters, digits, spaces and . - _ +";

/// Whether a text is an id: it has no characters with a meaning in tables, file names or folders.
pub fn is_id(text: &str) -> bool {
    let is_allowed =
        |letter: char| letter.is_alphanumeric() || matches!(letter, '.' | '-' | '_' | '+' | ' ');
    text.chars().next().is_some_and(char::is_alphanumeric)
        && text.chars().all(is_allowed)
        && !text.ends_with([' ', '.'])
}

/// Whether a path stays below its folder.
pub fn stays_below(path: &str) -> bool {
    let mut parts = Path::new(path).components().peekable();
    // Separators of other systems are rejected too.
    parts.peek().is_some()
        && !path.contains(['\\', ':'])
        && parts.all(|part| matches!(part, Component::Normal(_)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_name_parts_and_nothing_else() {
        for id in ["link-0600", "ma.strength", "anchor tension", "2", "sink_3-8", "baldé", "a+b"] {
            assert!(is_id(id), "{id}");
        }
        for text in [
            "",
            " ",
            ".",
            "..",
            "../../x",
            "a/b",
            "=cmd|' /C calc'!A0",
            "+1",
            "-a",
            "a\n",
            "a\u{1b}[31m",
            "a ",
            "a.",
            "@x",
        ] {
            assert!(!is_id(text), "{text:?}");
        }
    }

    #[test]
    fn paths_stay_below_their_folder() {
        for path in ["small.toml", "scenarios/small.toml"] {
            assert!(stays_below(path), "{path}");
        }
        for path in [
            "",
            "/etc/passwd",
            "../small.toml",
            "a/../../b",
            "./a/../..",
            "C:\\x.toml",
            "a\\..\\b",
            "a:b",
        ] {
            assert!(!stays_below(path), "{path}");
        }
    }
}

//! What a stranger's file may call its parts and the files that it names.

use std::path::{Component, Path};

/// What an id is made of, for messages.
pub const ID_HELP: &str =
    "an id begins with a letter or digit and goes on with letters, digits, spaces and . - _ +";

/// Whether a text is an id: it names a part in tables, files and folders, so it holds nothing that means something there.
#[must_use]
pub fn is_id(text: &str) -> bool {
    let may_stand =
        |letter: char| letter.is_alphanumeric() || matches!(letter, '.' | '-' | '_' | '+' | ' ');
    text.chars().next().is_some_and(char::is_alphanumeric)
        && text.chars().all(may_stand)
        && !text.ends_with([' ', '.'])
}

/// Whether a path that a file names stays below the folder of that file.
#[must_use]
pub fn stays_below(path: &str) -> bool {
    let mut parts = Path::new(path).components().peekable();
    // What parts folders on another system does so here too.
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

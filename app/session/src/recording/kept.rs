//! Data about a stored recording that need no replay: its outcome, and its user's note.
//!
//! The file lies beside the recording, `NAME.kept.json` for `NAME.endline`, with a picture of its end, `NAME.kept.png`; a recording
//! without them is as good.

use std::fs;
use std::path::{Path, PathBuf};

use endline_gear::read;
use endline_sim::metrics::Summary;
use serde::{Deserialize, Serialize};

use super::EXTENSION;
use crate::error::Error;
use crate::save;

/// Folder beside recordings that deleted ones are moved to.
const DELETED: &str = "deleted";

/// How a recorded run ended, and a note.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Kept {
    /// Its origin: a scenario, or another recording, an encounter of a study, a story.
    pub of: String,
    /// Simulated time [s].
    pub simulated_s: f64,
    /// Outcome by its name in results; none without a whale.
    pub outcome: Option<String>,
    /// Whether the whale was held and the run too short for a final outcome.
    pub undecided: bool,
    /// Greatest tension of any line [N].
    pub greatest_tension_n: f64,
    /// Its user's note.
    pub note: String,
}

impl Kept {
    /// Of a run up to its newest moment.
    pub fn of_run(of: String, simulated_s: f64, summary: Option<&Summary>) -> Self {
        let lines = summary.map_or(&[][..], |summary| &summary.lines);
        let whale = summary.and_then(|summary| summary.whale.as_ref());
        Self {
            of,
            simulated_s,
            outcome: whale.map(|whale| whale.outcome.name().to_owned()),
            undecided: whale.is_some_and(|whale| whale.is_held() && !whale.decided),
            greatest_tension_n: lines.iter().map(|line| line.peak_tension_n).fold(0.0, f64::max),
            note: String::new(),
        }
    }

    /// Reads the data beside a recording; none where there are none, or they cannot be read.
    pub fn beside(recording: &Path) -> Option<Self> {
        serde_json::from_str(&read::text(&place(recording)).ok()?).ok()
    }

    /// Writes it beside a recording.
    pub fn save(&self, recording: &Path) -> Result<(), Error> {
        let place = place(recording);
        let failed = "cannot be written";
        let text = serde_json::to_string_pretty(self).map_err(Error::on(&place, failed))?;
        save::atomically(&place, text.as_bytes()).map_err(Error::on(&place, failed))
    }
}

/// Renames a recording and the files beside it; returns its new path.
pub fn rename(recording: &Path, name: &str) -> Result<PathBuf, Error> {
    let name = name.trim();
    let plain = !name.is_empty()
        && !name.starts_with('.')
        && !name.chars().any(|letter| letter.is_control() || "/\\:*?\"<>|".contains(letter));
    if !plain {
        let wanted = "a name is letters, digits, spaces and marks, without any of / \\ : * ? \" < > | and no point first";
        return Err(Error::at(recording, format!("cannot be named `{name}`: {wanted}")));
    }
    // Not by `with_extension`: a name may have points in it.
    let renamed = recording.with_file_name(format!("{name}.{EXTENSION}"));
    relocate(recording, &renamed)?;
    Ok(renamed)
}

/// Moves a recording and the files beside it to the folder of deleted ones; returns its path there.
pub fn delete(recording: &Path) -> Result<PathBuf, Error> {
    let folder = recording.with_file_name(DELETED);
    fs::create_dir_all(&folder).map_err(Error::on(&folder, "cannot be made"))?;
    let stem = recording.file_stem().unwrap_or_default().to_string_lossy();
    let named = |number: u32| match number {
        0 => folder.join(format!("{stem}.{EXTENSION}")),
        number => folder.join(format!("{stem} ({number}).{EXTENSION}")),
    };
    let free = (0..10_000).map(named).find(|path| !path.exists());
    let to = free.ok_or_else(|| Error::at(&folder, "holds too many of this name"))?;
    relocate(recording, &to)?;
    Ok(to)
}

fn relocate(from: &Path, to: &Path) -> Result<(), Error> {
    if from == to {
        return Ok(());
    }
    if to.exists() {
        return Err(Error::at(to, "is there already; choose another name"));
    }
    fs::rename(from, to).map_err(Error::on(from, "cannot be moved"))?;
    // A recording without them is as good.
    let _ = fs::rename(place(from), place(to));
    let _ = fs::rename(picture(from), picture(to));
    Ok(())
}

/// The path of the picture of a recording's end.
pub fn picture(recording: &Path) -> PathBuf {
    recording.with_extension("kept.png")
}

fn place(recording: &Path) -> PathBuf {
    recording.with_extension("kept.json")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_and_note_go_with_a_recording_and_nothing_is_lost() {
        let folder = std::env::temp_dir().join(format!("endline-kept-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let first = folder.join("hello 0001.endline");
        let kept = Kept { note: "turned late".into(), simulated_s: 20.0, ..Kept::default() };
        for file in [&first, &folder.join("taken.endline")] {
            fs::write(file, "bytes").unwrap();
        }
        kept.save(&first).unwrap();
        fs::write(picture(&first), "pixels").unwrap();

        let renamed = rename(&first, " flipper, v2.1 ").unwrap();
        assert_eq!(renamed, folder.join("flipper, v2.1.endline"));
        assert_eq!(Kept::beside(&renamed), Some(kept.clone()));
        assert!(!first.exists() && Kept::beside(&first).is_none());
        for (name, words) in [
            ("", "cannot be named"),
            ("../up", "cannot be named"),
            (".x", "no point first"),
            ("taken", "already"),
        ] {
            let error = rename(&renamed, name).unwrap_err().to_string();
            assert!(error.contains(words), "{name}: {error}");
        }

        let deleted = delete(&renamed).unwrap();
        assert_eq!(deleted, folder.join("deleted/flipper, v2.1.endline"));
        assert_eq!(Kept::beside(&deleted), Some(kept));
        assert!(picture(&deleted).exists() && !picture(&first).exists());
        fs::write(&renamed, "another").unwrap();
        assert_eq!(delete(&renamed).unwrap(), folder.join("deleted/flipper, v2.1 (1).endline"));
        fs::remove_dir_all(&folder).unwrap();
    }
}

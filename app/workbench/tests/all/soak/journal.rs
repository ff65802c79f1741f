//! The journal of a session, one line per event, and the edits that may be lost at its end.
//!
//! | line | meaning |
//! |---|---|
//! | `soak does NAME` | a command or an edit follows |
//! | `soak unsaved T PATH DIGEST` | a text differs from its file since `T` [s, clock of the window] |
//! | `soak saved T PATH` | it no longer differs: saved, undone or discarded |
//! | `soak at T MB` | time and peak memory |

use std::collections::BTreeMap;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};

/// Greatest age of lost edits [s].
const LOST_S: f64 = 30.0;

/// The journal of a session.
#[derive(Default)]
pub struct Journal {
    pub commands: u64,
    pub edits: u64,
    pub most_mb: u64,
    /// Last command or edit.
    pub last: String,
    now_s: f64,
    /// For each text: times and digests since then; `None` if it does not differ from its file.
    states: BTreeMap<String, Vec<(f64, Option<u64>)>>,
}

/// Digest of a text, or of a removed one.
pub fn digest(text: Option<&str>) -> u64 {
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    hasher.finish()
}

impl Journal {
    /// Reads a line; returns false if it does not belong to a journal.
    pub fn take(&mut self, line: &str) -> bool {
        // The test harness sometimes prints on the same line.
        let Some((_, line)) = line.split_once("soak ") else { return false };
        if let Some(name) = line.strip_prefix("does ") {
            self.last = name.to_owned();
            self.edits += u64::from(name.starts_with("edit of "));
            self.commands += u64::from(!name.starts_with("edit of "));
            return true;
        }
        let words: Vec<&str> = line.split(' ').collect();
        let number = |word: &str| word.parse::<f64>().unwrap_or(0.0);
        match words[..] {
            ["unsaved", time_s, path, digest] => {
                let state = (number(time_s), digest.parse().ok());
                self.states.entry(path.to_owned()).or_default().push(state);
            }
            ["saved", time_s, path] => {
                self.states.entry(path.to_owned()).or_default().push((number(time_s), None));
            }
            ["at", time_s, mb] => {
                self.now_s = number(time_s);
                self.most_mb = self.most_mb.max(mb.parse().unwrap_or(0));
            }
            _ => return false,
        }
        true
    }

    /// Texts with edits older than 30 s at the end that are neither in the recovery file nor saved.
    pub fn lost(&self, kept: Option<&BTreeMap<String, Option<String>>>) -> Vec<String> {
        let cut_s = self.now_s - LOST_S;
        let is_lost = |(path, states): (&String, &Vec<(f64, Option<u64>)>)| {
            // Any state since 30 s before the end may be in the recovery file.
            let old = states.iter().rposition(|(time_s, _)| *time_s <= cut_s)?;
            let since = &states[old..];
            let found = kept.and_then(|kept| kept.get(path)).map(|text| digest(text.as_deref()));
            let is_kept = since.iter().any(|(_, state)| *state == found);
            (!is_kept).then(|| {
                format!(
                    "the edits of {path} of {:.1} s of {:.1} s are lost",
                    since[0].0, self.now_s
                )
            })
        };
        self.states.iter().filter_map(is_lost).collect()
    }
}

#[test]
fn an_old_edit_must_be_recoverable_or_saved_and_a_recent_one_need_not() {
    let mut journal = Journal::default();
    let [old, new] = [digest(Some("old")), digest(Some("new"))];
    for line in [
        format!("soak unsaved 10 ropes/a.toml {old}"),
        format!("soak unsaved 60 ropes/a.toml {new}"),
        "soak at 70 100".to_owned(),
    ] {
        assert!(journal.take(&line));
    }
    let kept = |text: &str| {
        let texts = BTreeMap::from([("ropes/a.toml".to_owned(), Some(text.to_owned()))]);
        journal.lost(Some(&texts)).len()
    };
    assert_eq!([kept("old"), kept("new"), kept("older")], [0, 0, 1]);
    assert_eq!(journal.lost(None).len(), 1, "the old edit is lost");
    assert!(journal.take("soak saved 65 ropes/a.toml"));
    assert_eq!(journal.lost(None).len(), 0, "saved afterwards");
}

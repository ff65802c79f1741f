//! What a session tells of itself, a line for each thing, and what may be lost of it.
//!
//! | line | meaning |
//! |---|---|
//! | `soak does NAME` | a command or an edit comes next |
//! | `soak unsaved T PATH DIGEST` | a text differs from its file since `T` [s of the window's clock] |
//! | `soak saved T PATH` | it does no more: saved, taken back or given up |
//! | `soak at T MB` | the time, and the most memory so far |

use std::collections::BTreeMap;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};

/// Edits lost at most [s].
const LOST_S: f64 = 30.0;

/// The journal of a session.
#[derive(Default)]
pub struct Journal {
    pub commands: u64,
    pub edits: u64,
    pub most_mb: u64,
    /// What it did last.
    pub last: String,
    now_s: f64,
    /// By text: since when it is what; the digest, or `None` where it does not differ from its file.
    states: BTreeMap<String, Vec<(f64, Option<u64>)>>,
}

/// The digest of a text; of one that was removed.
pub fn digest(text: Option<&str>) -> u64 {
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    hasher.finish()
}

impl Journal {
    /// Takes a line in; false where it is none of a journal.
    pub fn take(&mut self, line: &str) -> bool {
        // The harness of the tests prints on the same line at times.
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

    /// Texts whose edits of more than 30 s before the end are neither kept nor saved.
    pub fn lost(&self, kept: Option<&BTreeMap<String, Option<String>>>) -> Vec<String> {
        let cut_s = self.now_s - LOST_S;
        let is_lost = |(path, states): (&String, &Vec<(f64, Option<u64>)>)| {
            // What was so 30 s before the end, and all since: any of it may have been kept.
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
fn an_edit_of_a_minute_ago_must_be_kept_or_saved_and_one_of_now_need_not() {
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
    assert_eq!(journal.lost(None).len(), 1, "not even the old edit is kept");
    assert!(journal.take("soak saved 65 ropes/a.toml"));
    assert_eq!(journal.lost(None).len(), 0, "saved since");
}

//! Items of the start page: scenarios, studies and observations of the library, in groups by subject.

use std::path::{Path, PathBuf};

use endline_gear::Document;
use endline_session::locate;
use endline_session::sketch::Sketch;
use strum::{IntoStaticStr, VariantArray};

use crate::gui::files::{self, Listed};

/// Kind of a file, which decides where it opens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// A run.
    Scenario,
    /// Many runs of options.
    Study,
    /// An observation on a whale.
    Observation,
}

/// Subject of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr, VariantArray)]
pub(super) enum Group {
    /// A whale meets gear.
    #[strum(serialize = "Whales meeting gear")]
    Encounter,
    /// Studies.
    #[strum(serialize = "Studies: options compared")]
    Study,
    /// Scenarios that re-create a real case.
    #[strum(serialize = "Real cases")]
    Case,
    /// Observations.
    #[strum(serialize = "Observations of entangled whales")]
    Observation,
    /// Gear without a whale.
    #[strum(serialize = "Gear alone")]
    Gear,
    /// Whales without gear.
    #[strum(serialize = "Whales alone")]
    Whale,
    /// Neither gear of a fishery nor a whale.
    #[strum(serialize = "Checks of the physics")]
    Physics,
    /// Scenarios that studies and searches draw theirs from.
    #[strum(serialize = "Scenarios of studies and searches")]
    Base,
}

impl Group {
    /// All groups, in the order of the page.
    pub(super) const ALL: &'static [Self] = Self::VARIANTS;

    /// Its heading.
    pub(super) fn title(self) -> &'static str {
        self.into()
    }

    /// Whether it is open initially.
    pub(super) fn opens(self) -> bool {
        !matches!(self, Self::Physics | Self::Base | Self::Whale)
    }

    /// Group of a scenario, by the prefix of its id or else by its content.
    fn of_scenario(id: &str, sketch: &Sketch) -> Self {
        let starts = |begins: &[&str]| begins.iter().any(|begin| id.starts_with(begin));
        if starts(&["study-", "search-"]) {
            Self::Base
        } else if starts(&["case-", "eg-"]) {
            Self::Case
        } else if starts(&["reference-", "energy-", "tow-", "part-", "answer-", "weak-link-"]) {
            Self::Physics
        } else {
            match (sketch.whale, sketch.has_gear()) {
                (true, true) => Self::Encounter,
                (true, false) => Self::Whale,
                (false, true) => Self::Gear,
                (false, false) => Self::Physics,
            }
        }
    }
}

/// An item of the start page.
#[derive(Clone, Debug)]
pub(super) struct Item {
    pub what: What,
    pub group: Group,
    pub path: PathBuf,
    pub name: String,
    pub notes: String,
    /// First sentence of the notes.
    pub first_words: String,
    pub sketch: Sketch,
    /// Id, name and notes in lower case, for the search.
    text: String,
}

impl Item {
    /// Whether it contains all of these lower-case words.
    pub(super) fn has(&self, words: &[String]) -> bool {
        words.iter().all(|word| self.text.contains(word))
    }
}

/// Words of a search, in lower case.
pub(super) fn words(sought: &str) -> Vec<String> {
    sought.to_lowercase().split_whitespace().map(str::to_owned).collect()
}

/// First sentence of notes, without code marks, truncated at a word if it is long.
fn first_words(notes: &str) -> String {
    const MOST: usize = 120;
    let notes = notes.replace('`', "").split_whitespace().collect::<Vec<_>>().join(" ");
    let sentence = notes.split_inclusive(". ").next().unwrap_or_default().trim_end();
    if sentence.chars().count() <= MOST {
        return sentence.to_owned();
    }
    let cut: String = sentence.chars().take(MOST).collect();
    let words = cut.rsplit_once(' ').map_or(cut.as_str(), |(words, _)| words);
    format!("{} …", words.trim_end_matches([',', ';', ':']))
}

/// Number of files of the start page.
pub(super) fn count(root: &Path) -> usize {
    locate::scenarios(root).len() + locate::studies(root).len() + locate::observations(root).len()
}

/// Reads all items, in order of names. Files that cannot be read are left out; the panel Problems lists them.
pub(super) fn all(root: &Path) -> Vec<Item> {
    let kinds = [What::Scenario, What::Study, What::Observation];
    let mut items: Vec<Item> = kinds.into_iter().flat_map(|what| of_kind(root, what)).collect();
    // The simplest examples first.
    items.sort_by_key(|item| !files::stem(&item.path).starts_with("hello-"));
    items
}

/// The files of a kind by subject, in the order of the start page, each subject in order of names.
pub fn listed(root: &Path, what: What) -> Vec<Listed> {
    let mut items: Vec<Item> = of_kind(root, what).collect();
    let place = |group: Group| Group::ALL.iter().position(|own| *own == group);
    items.sort_by(|one, other| {
        place(one.group).cmp(&place(other.group)).then_with(|| one.name.cmp(&other.name))
    });
    let row = |item: Item| Listed { heading: item.group.title(), path: item.path, name: item.name };
    items.into_iter().map(row).collect()
}

/// Reads the items of a kind.
fn of_kind(root: &Path, what: What) -> impl Iterator<Item = Item> {
    let paths = match what {
        What::Scenario => locate::scenarios(root),
        What::Study => locate::studies(root),
        What::Observation => locate::observations(root),
    };
    paths.into_iter().filter_map(move |path| read(root, what, path))
}

fn read(root: &Path, what: What, path: PathBuf) -> Option<Item> {
    let document = Document::parse(&endline_gear::read::text(&path).ok()?).ok()?;
    let sketch = match what {
        What::Scenario => Sketch::of_scenario(root, &document),
        What::Study => Sketch::of_study(&document),
        What::Observation => Sketch { whale: true, ..Sketch::default() },
    };
    let group = match what {
        What::Scenario => Group::of_scenario(&files::stem(&path), &sketch),
        What::Study => Group::Study,
        What::Observation => Group::Observation,
    };
    let name = document.get("name").unwrap_or_else(|| files::stem(&path));
    let notes = document.get("notes").unwrap_or_default();
    let text = format!("{} {name} {notes}", files::stem(&path)).to_lowercase();
    Some(Item { what, group, path, name, first_words: first_words(&notes), notes, sketch, text })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shipped() -> Vec<Item> {
        all(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library"))
    }

    #[test]
    fn shipped_items_are_in_the_group_of_their_subject() {
        let items = shipped();
        let group =
            |id: &str| items.iter().find(|item| files::stem(&item.path) == id).unwrap().group;
        for (id, wanted) in [
            ("hello-endline", Group::Encounter),
            ("fly-endline", Group::Encounter),
            ("trawl-10", Group::Gear),
            ("portrait", Group::Whale),
            ("reference-c2-snap", Group::Physics),
            ("study-endline", Group::Base),
            ("case-e25-05-roll", Group::Case),
            ("weak-links", Group::Study),
            ("eg-1140", Group::Observation),
        ] {
            assert_eq!(group(id), wanted, "{id}");
        }
        assert_eq!(files::stem(&items[0].path), "hello-endline");
        assert!(items.iter().all(|item| !item.name.is_empty()));
    }

    #[test]
    fn a_search_finds_items_with_all_its_words() {
        let found = |sought: &str| {
            let words = words(sought);
            shipped().into_iter().filter(|item| item.has(&words)).count()
        };
        assert_eq!(found(""), shipped().len());
        let both = found("trawl offshore");
        assert!(both > 0 && both < found("trawl"), "{both}");
        assert_eq!(found("trawl zeppelin"), 0);
    }

    #[test]
    fn notes_are_truncated_at_a_sentence_or_a_word() {
        assert_eq!(first_words("One trap.\nA second sentence."), "One trap.");
        let words = first_words(&"word, ".repeat(40));
        assert!(words.ends_with("word …") && words.chars().count() <= 123, "{words}");
    }
}

//! Options of the open study made from gear: the unsaved edits of the design, or another assembly.

use std::collections::BTreeSet;

use endline_gear::{Document, Setting};

use super::documents::Documents;
use super::library_table::id_of;

/// What an option changes.
#[derive(Debug, Default, PartialEq)]
struct Changes {
    /// Dotted paths of scenario or library item, with their texts.
    sets: Vec<(String, String)>,
    /// Dotted paths of the scenario that are taken away.
    removes: Vec<String>,
}

impl Documents {
    /// Adds an option to the open study that makes the unsaved edits of the scenario and of library files; these go back to their files,
    /// so that the baseline stays as it was. New files stay. One undo takes all of it back. Answers the option's id.
    /// Errors: where no study of the open scenario is open, nothing is edited, or an edit is none that an option can make.
    pub fn option_from_edits(&mut self) -> Result<String, String> {
        self.is_of_the_study()?;
        let edited = self.edited_gear();
        let mut changes = Changes::default();
        for path in &edited {
            self.take_changes(path, &mut changes)?;
        }
        if changes == Changes::default() {
            return Err(
                "nothing is edited: change the scenario or its gear first, and do not save"
                    .to_owned(),
            );
        }
        let name = match &changes.sets[..] {
            [(field, value)] if changes.removes.is_empty() => {
                format!("{} {value}", spoken(field))
            }
            _ => "Present design".to_owned(),
        };
        let back = edited.into_iter().map(|path| {
            let saved = self.saved_text(&path).map(str::to_owned);
            (path, saved)
        });
        let back: Vec<_> = back.collect();
        self.add_option("design", &name, &changes, back)
    }

    /// Adds an option to the open study whose gear is another assembly of the library, by its id. Answers the option's id.
    /// Errors: where no study of the open scenario is open, or the scenario has no assembly.
    pub fn option_with_assembly(&mut self, assembly: &str) -> Result<String, String> {
        self.is_of_the_study()?;
        let field = "gear.0.assembly";
        if self.field(Self::SCENARIO, field).is_none() {
            return Err("the scenario has no assembly that another could stand for".to_owned());
        }
        let file = format!("assemblies/{assembly}.toml");
        let name = self.field(&file, "name").ok_or_else(|| format!("there is no {file}"))?;
        let sets = vec![(field.to_owned(), assembly.to_owned())];
        self.add_option(assembly, &name, &Changes { sets, ..Changes::default() }, Vec::new())
    }

    /// A study is open, and its options are differences from the open scenario.
    fn is_of_the_study(&self) -> Result<(), String> {
        let of = self.field(Self::STUDY, "scenario").ok_or("open a study first")?;
        let open = self.scenario_path().file_stem().unwrap_or_default().to_string_lossy();
        if id_of(&of) != open {
            return Err(format!(
                "the study is of the scenario {of}, and {open} is open: open {of} and change its gear"
            ));
        }
        Ok(())
    }

    /// The scenario and the library files that differ from files which are there.
    fn edited_gear(&self) -> Vec<String> {
        let outside = [Self::STUDY, Self::OBSERVATION];
        let edited = self.unsaved().iter().filter(|path| !outside.contains(&path.as_str()));
        // Entries that are new or deleted stay so.
        let changed = |path: &&String| self.saved_text(path).is_some() && self.text(path).is_some();
        edited.filter(changed).cloned().collect()
    }

    fn take_changes(&self, path: &str, changes: &mut Changes) -> Result<(), String> {
        let present = self.document(path)?;
        let saved = self.saved_text(path);
        let saved = saved.and_then(|text| Document::parse(text).ok());
        let saved = saved.ok_or_else(|| format!("{path} cannot be read as it was saved"))?;
        let own = changes_of(&saved, &present);
        if path == Self::SCENARIO {
            changes.sets.extend(own.sets);
            changes.removes.extend(own.removes);
            return Ok(());
        }
        if let Some(gone) = own.removes.first() {
            return Err(format!(
                "{path}: an option cannot take `{gone}` out of an entry; duplicate the entry, and use the copy"
            ));
        }
        let item = path.trim_end_matches(".toml");
        changes
            .sets
            .extend(own.sets.into_iter().map(|(field, text)| (format!("{item}.{field}"), text)));
        Ok(())
    }

    /// Adds an option under a fresh id, and puts other texts in their place, as one edit.
    fn add_option(
        &mut self,
        stem: &str,
        name: &str,
        changes: &Changes,
        mut texts: Vec<(String, Option<String>)>,
    ) -> Result<String, String> {
        let mut study = self.document(Self::STUDY)?;
        let ids: BTreeSet<String> = (0..study.count("option"))
            .filter_map(|index| study.get(&format!("option.{index}.id")))
            .collect();
        let numbered = (2..).map(|number| format!("{stem}-{number}"));
        let mut fresh =
            std::iter::once(stem.to_owned()).chain(numbered).filter(|id| !ids.contains(id));
        let id = fresh.next().unwrap_or_default();
        let failed = |error: endline_gear::EditError| error.message;
        let fields = [("id", format!("{id:?}")), ("name", format!("{name:?}"))];
        let fields = fields.each_ref().map(|(key, text)| (*key, text.as_str()));
        let place = study.push_table("option", &fields).map_err(failed)?;
        if !changes.removes.is_empty() {
            let removes = Setting::texts(&changes.removes);
            study.put(&format!("option.{place}.remove"), &removes).map_err(failed)?;
        }
        for (field, text) in &changes.sets {
            let field = format!("option.{place}.set.\"{field}\"");
            study.put(&field, &Setting::plain(text)).map_err(failed)?;
        }
        texts.push((Self::STUDY.to_owned(), Some(study.text())));
        self.restore(texts);
        Ok(id)
    }
}

/// The last two words of a path: `ropes/pp-3-8.strength` is `strength`, `gear.lines.endline.inserts.every` is `inserts every`.
fn spoken(field: &str) -> String {
    // Of a library item, its id says nothing of what is changed.
    let of_item = field.split_once('/').and_then(|(_, item)| item.split_once('.'));
    let field = of_item.map_or(field, |(_, field)| field);
    let words: Vec<&str> = field.split('.').filter(|word| word.parse::<u32>().is_err()).collect();
    words[words.len().saturating_sub(2)..].join(" ").replace('_', " ")
}

/// What of a text is other than saved, leaf by leaf.
fn changes_of(saved: &Document, present: &Document) -> Changes {
    let [before, now] = [saved, present].map(|document| {
        let mut leaves = Vec::new();
        gather(document, "", &mut leaves);
        leaves
    });
    let mut changes = Changes::default();
    for leaf in &now {
        if let Some(text) = present.get(leaf)
            && saved.get(leaf).as_ref() != Some(&text)
        {
            changes.sets.push((leaf.clone(), text));
        }
    }
    for leaf in before.iter().filter(|leaf| !present.has(leaf)) {
        let gone = highest_gone(present, leaf);
        if !changes.removes.contains(&gone) {
            changes.removes.push(gone);
        }
    }
    changes
}

/// The highest table above a leaf that is not there.
fn highest_gone(document: &Document, leaf: &str) -> String {
    let ends = leaf.match_indices('.').map(|(end, _)| end).chain([leaf.len()]);
    let above = ends.map(|end| &leaf[..end]).find(|path| !document.has(path));
    above.unwrap_or(leaf).to_owned()
}

/// Paths of all values under a table or list; a figure with its source is one value.
pub(super) fn gather(document: &Document, table: &str, leaves: &mut Vec<String>) {
    for path in parts(document, table) {
        let holds_values = document.keys(&path).is_empty() && !document.has(&format!("{path}.0"));
        if holds_values || document.has(&format!("{path}.value")) {
            leaves.push(path);
        } else {
            gather(document, &path, leaves);
        }
    }
}

/// Paths of the fields of a table, or of the items of a list; the whole document has the path "".
pub(super) fn parts(document: &Document, table: &str) -> Vec<String> {
    let below = |part: &str| {
        if table.is_empty() { part.to_owned() } else { format!("{table}.{part}") }
    };
    let items = (0..).map(|index| below(&index.to_string())).take_while(|path| document.has(path));
    let items: Vec<String> = if table.is_empty() { Vec::new() } else { items.collect() };
    if items.is_empty() {
        document.keys(table).iter().map(|key| below(key)).collect()
    } else {
        items
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changes(saved: &str, present: &str) -> Changes {
        changes_of(&Document::parse(saved).unwrap(), &Document::parse(present).unwrap())
    }

    #[test]
    fn changes_additions_and_removals_have_paths() {
        let saved = "a = 1\nplace = [1.0, 2.0]\n[waves]\nheight = \"1 m\"\nperiod = \"6 s\"\n[[gear]]\nassembly = \"single\"\n[strength]\nvalue = \"1 kN\"\nsource = \"mill\"\n";
        let present = "a = 2\nplace = [1.0, 3.0]\n[[gear]]\nassembly = \"single\"\n[gear.links]\nbuoy = \"600 lbf\"\n[strength]\nvalue = \"2 kN\"\nsource = \"unsourced\"\n";
        let found = changes(saved, present);
        let sets: Vec<_> =
            found.sets.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
        assert_eq!(
            sets,
            [
                ("a", "2"),
                ("place.1", "3.0"),
                ("gear.0.links.buoy", "600 lbf"),
                ("strength", "2 kN")
            ]
        );
        assert_eq!(found.removes, ["waves"], "a table that is gone is one removal");
        assert_eq!(changes(saved, saved), Changes::default());
    }

    #[test]
    fn a_path_is_spoken_by_its_last_words() {
        assert_eq!(spoken("ropes/pp-3-8.strength"), "strength");
        assert_eq!(spoken("gear.0.lines.endline.inserts.every"), "inserts every");
        assert_eq!(spoken("link.0.rating"), "link rating");
    }
}

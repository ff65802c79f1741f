//! Rule packs: what laws ask of fishing gear, as data.
//!
//! A pack lies in `rules/` and holds the rules of one jurisdiction. Its conditions and checks are expressions over facts of
//! assembled gear; who assembles gear also says which facts there are, and reads the expressions: [`RulePack::read`] hands
//! them over. The format is described in `docs/rules.md`.

mod date;
mod parameter;
mod rule;

use crate::diagnostic::{At, Diagnostic, Place};
use crate::entry;
use crate::fields::{Fields, Problems, Provenance};
use crate::tree::{self, Node};

pub use date::Date;
pub use parameter::Parameter;
pub use rule::{Rule, RuleDraft, Standing, Subject};

/// The rules of a jurisdiction.
#[derive(Clone, Debug)]
pub struct RulePack {
    /// Id: the file's name without `.toml`.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// Remarks; may be empty.
    pub notes: String,
    /// Whose rules they are, such as `US-MA`.
    pub jurisdiction: String,
    /// Areas that it declares.
    pub areas: Vec<Area>,
    /// Its rules, in the order of the file.
    pub rules: Vec<Rule>,
}

/// An area that rules name.
#[derive(Clone, Debug)]
pub struct Area {
    /// Its id, such as `lma-1`.
    pub id: At<String>,
    /// Its name.
    pub name: String,
    /// The area that contains it, of this pack or another: rules of that area apply here too.
    pub within: Option<At<String>>,
}

impl RulePack {
    /// Reads a pack's text; `name` is its path as shown in messages. `judge` reads the expressions of every rule, also of
    /// those with other mistakes, and gives what is wrong with them.
    ///
    /// # Errors
    /// Everything wrong with it that can be seen without other packs.
    pub fn read(
        name: &str,
        text: &str,
        judge: &dyn Fn(&RuleDraft) -> Vec<Diagnostic>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let problems = Problems::default();
        let node = tree::read(name, text).map_err(|problem| vec![*problem])?;
        let pack = Self::from_node(name, &node, &problems, judge);
        match pack {
            Some(pack) if !problems.any_error() => Ok(pack),
            _ => Err(problems.into_sorted()),
        }
    }

    fn from_node(
        path: &str,
        node: &Node,
        problems: &Problems,
        judge: &dyn Fn(&RuleDraft) -> Vec<Diagnostic>,
    ) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, file) = entry::header(&fields, "rules", problems);
        let jurisdiction = fields.need_text("jurisdiction", "say whose rules they are: \"US-MA\"");
        let areas: Vec<Area> =
            fields.tables("area").iter().filter_map(|node| area(node, problems)).collect();
        let rules = rules(&fields, &file, judge);
        fields.finish();
        if fields.tables("rule").is_empty() {
            fields.missing("rule", "write each rule under [[rule]]");
        }
        told_once(areas.iter().map(|area| &area.id), problems);
        told_once(rules.iter().map(|rule| &rule.id), problems);
        let id = path.rsplit(['/', '\\']).next().unwrap_or(path).trim_end_matches(".toml");
        let (id, jurisdiction) = (id.to_owned(), jurisdiction?.value);
        Some(Self { id, name, notes, jurisdiction, areas, rules })
    }
}

fn rules(
    fields: &Fields<'_>,
    file: &Provenance,
    judge: &dyn Fn(&RuleDraft) -> Vec<Diagnostic>,
) -> Vec<Rule> {
    let one = |node: &Node| {
        let draft = RuleDraft::read(node, file, fields.problems());
        fields.problems().extend(judge(&draft));
        draft.finished()
    };
    fields.tables("rule").iter().filter_map(one).collect()
}

/// Reads an `[[area]]`.
fn area(node: &Node, problems: &Problems) -> Option<Area> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write an id such as \"lma-1\"");
    let name = fields.need_text("name", "write a name in quotes");
    let within = fields.text("within");
    fields.finish();
    Some(Area { id: id?, name: name?.value, within })
}

/// An id is given once in a file.
fn told_once<'a>(ids: impl Iterator<Item = &'a At<String>>, problems: &Problems) {
    let mut seen: Vec<(&str, &Place)> = Vec::new();
    for id in ids {
        if seen.iter().any(|(known, _)| *known == id.value) {
            let message = format!("`{}` is given twice", id.value);
            problems.push(id.place.error(message, "give each id once"));
        }
        seen.push((&id.value, &id.place));
    }
}

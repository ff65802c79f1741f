//! An option: differences from the baseline, each a dotted path with its value.

use crate::diagnostic::{At, Place};
use crate::document::Setting as Value;
use crate::fields::{Fields, Problems};
use crate::nearest::hint;
use crate::tree::{Content, Node};

use super::threat::{self, ThreatLabels};

/// An option of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyOption {
    /// Id.
    pub id: At<String>,
    /// Name shown to the user; the id where none is given.
    pub name: String,
    /// Breaking strength that it stands for, for the curve of break-away against strength [N].
    pub strength_n: Option<f64>,
    /// Which of the curves it belongs to, where strengths of several kinds are compared, such as `weak link`.
    pub curve: Option<String>,
    /// What it sets.
    pub settings: Vec<Setting>,
    /// Fields it takes out of the scenario.
    pub removes: Vec<At<String>>,
    /// What it says of the row of a threat table that it stands for.
    pub threat: ThreatLabels,
}

/// A field set over the baseline.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Dotted path in the scenario, such as `gear.0.attributes.buoy`; or of a library item, such as `ropes/sink-3-8.strength`.
    pub field: At<String>,
    /// Its value as it stands in the file.
    pub value: Value,
}

impl Setting {
    /// The library file a setting goes to with the field in it; `None` for one of the scenario.
    #[must_use]
    pub fn library_field(&self) -> Option<(String, &str)> {
        library_field(&self.field.value)
    }
}

/// The library file a dotted path leads to with the field in it; `None` for one of the scenario.
pub(super) fn library_field(path: &str) -> Option<(String, &str)> {
    let (item, field) = path.split_once('.').filter(|(item, _)| item.contains('/'))?;
    Some((format!("{item}.toml"), field))
}

/// Reads options, or values of an axis, sorted by id; `what` they are stands in messages.
pub(super) fn read_each(nodes: &[Node], what: &str, problems: &Problems) -> Vec<StudyOption> {
    sorted(nodes.iter().filter_map(|node| read(node, problems)).collect(), what, problems)
}

/// In order of id; reports an id that stands twice.
pub(super) fn sorted(
    mut options: Vec<StudyOption>,
    what: &str,
    problems: &Problems,
) -> Vec<StudyOption> {
    options.sort_by(|one, other| one.id.value.cmp(&other.id.value));
    for pair in options.windows(2).filter(|pair| pair[0].id.value == pair[1].id.value) {
        let message = format!("there are two {what}s `{}`", pair[1].id.value);
        let help = "give one of them another id";
        problems.push(pair[1].id.place.error(message, help));
    }
    options
}

fn read(node: &Node, problems: &Problems) -> Option<StudyOption> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write an id such as \"link-600\"");
    let name = fields.text("name");
    let strength =
        fields.value("strength", crate::units::Quantity::Force, crate::fields::Range::Positive);
    let curve = fields.text("curve");
    let removes = texts(&fields, "remove");
    let threat = threat::read(fields.get("threat"), problems);
    let mut settings = Vec::new();
    if let Some(set) = fields.get("set") {
        Fields::of(set, problems).rest();
        flatten(set, "", &mut settings, problems);
    }
    fields.finish();
    let id = id?;
    let name = name.map_or_else(|| id.value.clone(), |name| name.value);
    let (strength_n, curve) =
        (strength.map(|strength| strength.value), curve.map(|curve| curve.value));
    Some(StudyOption { id, name, strength_n, curve, settings, removes, threat })
}

/// Every leaf of a table with its dotted path; quoted and bare keys come to the same.
fn flatten(node: &Node, path: &str, settings: &mut Vec<Setting>, problems: &Problems) {
    let Content::Table(entries) = &node.content else { return };
    for (key, place, value) in entries {
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        if matches!(value.content, Content::Table(_)) {
            flatten(value, &path, settings, problems);
        } else {
            settings.extend(setting(path, place, value, problems));
        }
    }
}

fn setting(path: String, place: &Place, node: &Node, problems: &Problems) -> Option<Setting> {
    let Some(value) = Value::of(node) else {
        problems.push(node.place.error(
            format!("`{path}` is {}", node.content.noun()),
            "write a text, a number, true or false, or a list of them",
        ));
        return None;
    };
    Some(Setting { field: At { value: path, place: place.clone() }, value })
}

/// Reports an id that names no option.
pub(super) fn check_known(id: &At<String>, options: &[StudyOption], problems: &Problems) {
    let ids = || options.iter().map(|option| option.id.value.as_str());
    if !ids().any(|known| known == id.value) {
        let message = format!("there is no option `{}`", id.value);
        problems.push(id.place.error(message, hint(&id.value, ids())));
    }
}

/// A list of texts, or one text.
pub(crate) fn texts(fields: &Fields<'_>, key: &'static str) -> Vec<At<String>> {
    let Some(node) = fields.get(key) else { return Vec::new() };
    let items = match &node.content {
        Content::List(items) => items.iter().collect(),
        _ => vec![node],
    };
    let text = |item: &&Node| match &item.content {
        Content::Text(text) => Some(At { value: text.clone(), place: item.place.clone() }),
        other => {
            fields.problems().push(item.place.error(
                format!("`{key}` holds {}, not a text", other.noun()),
                "write texts in quotes",
            ));
            None
        }
    };
    items.iter().filter_map(text).collect()
}

//! Options of a study: differences from the baseline, each a dotted path with its value.
//!
//! Axes generate options: all combinations of one value per axis, such as four ropes by four lengths of trawl.
//! An option may represent a row of a threat table, with the columns of NOAA's decision support tool.

use crate::diagnostic::{At, Place, hint};
use crate::document::Setting as Value;
use crate::fields::{Fields, Problems, Range};
use crate::limits;
use crate::tree::{Content, Node};
use crate::units::Quantity;

/// An option of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyOption {
    /// Id.
    pub id: At<String>,
    /// Name shown to the user; the id by default.
    pub name: String,
    /// Breaking strength, for the curve of break-away against strength [N].
    pub strength_n: Option<f64>,
    /// Its curve, if strengths of several kinds are compared, such as `weak link`.
    pub curve: Option<String>,
    /// Fields that it sets.
    pub settings: Vec<Setting>,
    /// Fields that it removes from the scenario.
    pub removes: Vec<At<String>>,
    /// Labels of its row of a threat table.
    pub threat: ThreatLabels,
    /// Whether its runs end where something parts; otherwise they are followed to the end of the whale's encounter.
    pub until_parted: bool,
}

/// A field that overrides the baseline.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Dotted path in the scenario, such as `gear.0.attributes.buoy`; or of a library item, such as `ropes/sink-3-8.strength`.
    pub field: At<String>,
    /// Its value as written.
    pub value: Value,
}

impl Setting {
    /// Library file and field of a setting; `None` for the scenario.
    pub fn library_field(&self) -> Option<(String, &str)> {
        library_field(&self.field.value)
    }
}

/// Library file and field of a dotted path; `None` for the scenario.
pub fn library_field(path: &str) -> Option<(String, &str)> {
    let (item, field) = path.split_once('.').filter(|(item, _)| item.contains('/'))?;
    Some((format!("{item}.toml"), field))
}

/// Reads options, or values of an axis, sorted by id.
fn read_each(fields: &Fields<'_>, key: &'static str) -> Vec<StudyOption> {
    sorted(fields.each(key, read_option), key, fields.problems())
}

/// Sorts by id; reports duplicate ids.
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

fn read_option(fields: &Fields<'_>) -> Option<StudyOption> {
    let id = fields.need_id("id", "write an id such as \"link-600\"");
    let name = fields.text("name");
    let strength = fields.value("strength", Quantity::Force, Range::Positive);
    let curve = fields.text("curve");
    let removes = texts(fields, "remove");
    let threat = read_threat(fields.get("threat"), fields.problems());
    let until = fields.choice("until", &[("end", false), ("parted", true)]);
    let mut settings = Vec::new();
    if let Some(set) = fields.get("set") {
        Fields::of(set, fields.problems()).rest();
        flatten(set, "", &mut settings, fields.problems());
    }
    let id = id?;
    let name = name.map_or_else(|| id.value.clone(), |name| name.value);
    let (strength_n, curve) =
        (strength.map(|strength| strength.value), curve.map(|curve| curve.value));
    let until_parted = until.is_some_and(|until| until.value);
    Some(StudyOption { id, name, strength_n, curve, settings, removes, threat, until_parted })
}

/// Collects the leaves of a table with their dotted paths; quoted and bare keys are equal.
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
        return problems.refuse(node.place.error(
            format!("`{path}` is {}", node.content.noun()),
            "write a text, a number, true or false, or a list of them",
        ));
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
    let text =
        |item: &&Node| match &item.content {
            Content::Text(text) => Some(At { value: text.clone(), place: item.place.clone() }),
            other => fields.refuse(item.place.error(
                format!("`{key}` holds {}, not a text", other.noun()),
                "write texts in quotes",
            )),
        };
    items.iter().filter_map(text).collect()
}

/// Reads `[[option]]` and `[[axis]]`; options sorted by id.
pub(super) fn read_options(fields: &Fields<'_>) -> Vec<StudyOption> {
    if fields.tables("option").is_empty() && fields.tables("axis").is_empty() {
        fields.missing("option", "write each option under [[option]], including the baseline");
    }
    let mut options = read_each(fields, "option");
    options.extend(read_axes(fields));
    sorted(options, "option", fields.problems())
}

/// Greatest number of options from axes.
const MOST_OPTIONS: usize = 256;

/// An axis with its values by id.
struct Axis {
    id: At<String>,
    values: Vec<StudyOption>,
}

/// Reads axes and combines their values, axes in the order of their ids.
fn read_axes(fields: &Fields<'_>) -> Vec<StudyOption> {
    let mut axes = fields.each("axis", read_axis);
    axes.sort_by(|one, other| one.id.value.cmp(&other.id.value));
    let Some(first) = axes.first() else { return Vec::new() };
    let count = axes.iter().fold(1_usize, |count, axis| count.saturating_mul(axis.values.len()));
    if count > MOST_OPTIONS {
        fields.problems().push(first.id.place.error(
            format!("the axes make {count} options"),
            format!("at most {MOST_OPTIONS} are possible: remove some values"),
        ));
        return Vec::new();
    }
    let mut options = vec![None];
    for axis in &axes {
        options = options
            .iter()
            .flat_map(|option: &Option<StudyOption>| {
                axis.values.iter().map(move |value| Some(joined(option.as_ref(), value)))
            })
            .collect();
    }
    let options: Vec<StudyOption> = options.into_iter().flatten().collect();
    options.first().into_iter().for_each(|option| check_once(option, fields.problems()));
    options
}

fn read_axis(fields: &Fields<'_>) -> Option<Axis> {
    let id = fields.need_id("id", "write the difference of the options, such as id = \"rope\"");
    if fields.tables("value").is_empty() {
        fields.missing("value", "write each of its values under [[axis.value]]");
    }
    let values = read_each(fields, "value");
    Some(Axis { id: id?, values })
}

/// An option combined with a value: ids are joined by hyphens, names by commas; the later strength and curve apply.
fn joined(option: Option<&StudyOption>, value: &StudyOption) -> StudyOption {
    let Some(option) = option else { return value.clone() };
    let both = |one: &str, other: &str, between: &str| format!("{one}{between}{other}");
    StudyOption {
        id: At {
            value: both(&option.id.value, &value.id.value, "-"),
            place: value.id.place.clone(),
        },
        name: both(&option.name, &value.name, ", "),
        strength_n: value.strength_n.or(option.strength_n),
        curve: value.curve.clone().or_else(|| option.curve.clone()),
        settings: [option.settings.as_slice(), &value.settings].concat(),
        removes: [option.removes.as_slice(), &value.removes].concat(),
        threat: ThreatLabels::joined(&option.threat, &value.threat),
        until_parted: option.until_parted || value.until_parted,
    }
}

/// Reports a field that values of two axes set.
fn check_once(option: &StudyOption, problems: &Problems) {
    for (place, setting) in option.settings.iter().enumerate() {
        if option.settings[..place].iter().any(|before| before.field.value == setting.field.value) {
            problems.push(setting.field.place.error(
                format!("two axes set `{}`", setting.field.value),
                "set a field in the values of one axis only",
            ));
        }
    }
}

/// Labels of an option, or of a value of an axis, for its row of a threat table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ThreatLabels {
    rope: Option<String>,
    diameter_m: Option<f64>,
    traps: Option<u64>,
    device: Option<String>,
}

/// A row of a threat table.
#[derive(Clone, Debug, PartialEq)]
pub struct ThreatRow {
    /// Rope by the table's own name, such as `3/8in` or `1,700` (column `Rope`).
    pub rope: String,
    /// Its diameter [m] (column `RopeDiam`, in inches there).
    pub diameter_m: f64,
    /// Traps of the trawl (column `TrawlLen`).
    pub traps: u64,
    /// Device in the endline, or `NA` (column `BuoylineDevice`).
    pub device: String,
}

impl ThreatLabels {
    /// The row, if all labels are present.
    pub fn row(&self) -> Option<ThreatRow> {
        Some(ThreatRow {
            rope: self.rope.clone()?,
            diameter_m: self.diameter_m?,
            traps: self.traps?,
            device: self.device.clone()?,
        })
    }

    /// The labels of two values of axes; the later ones apply.
    pub(super) fn joined(one: &Self, other: &Self) -> Self {
        Self {
            rope: other.rope.clone().or_else(|| one.rope.clone()),
            diameter_m: other.diameter_m.or(one.diameter_m),
            traps: other.traps.or(one.traps),
            device: other.device.clone().or_else(|| one.device.clone()),
        }
    }
}

/// Reads `threat` of an option.
pub(super) fn read_threat(node: Option<&Node>, problems: &Problems) -> ThreatLabels {
    let Some(node) = node else { return ThreatLabels::default() };
    let fields = Fields::of(node, problems);
    let text = |key| fields.text(key).map(|At { value, .. }| value);
    let labels = ThreatLabels {
        rope: text("rope"),
        diameter_m: fields
            .value("diameter", Quantity::Length, Range::Positive)
            .map(|diameter| diameter.value),
        traps: fields.count("traps", &limits::TRAPS).map(|traps| traps.value),
        device: text("device"),
    };
    fields.finish();
    labels
}

#[cfg(test)]
mod tests {
    use crate::study::Study;

    const STUDY: &str = "format = 1\nkind = \"study\"\nname = \"s\"\nscenario = \"hello-endline\"\nencounters = 4\nbaseline = \"thick-3\"\n\
        [[axis]]\nid = \"traps\"\n[[axis.value]]\nid = \"3\"\nthreat = { traps = 3 }\nset = { rope_nodes = 100 }\n\
        [[axis.value]]\nid = \"12\"\nthreat = { traps = 12 }\nset = { rope_nodes = 200 }\n\
        [[axis]]\nid = \"rope\"\n[[axis.value]]\nid = \"thick\"\nname = \"Thick\"\nset = { \"line.0.rope\" = \"pp-1-2\" }\n\
        threat = { rope = \"1/2in\", diameter = \"1/2 in\", device = \"NA\" }\n\
        [[axis.value]]\nid = \"thin\"\nset = { \"line.0.rope\" = \"pp-3-8\" }\n\
        [encounter.speed]\nuniform = [\"0.5 m/s\", \"1 m/s\"]\nsource = \"assumed\"\n";

    #[test]
    fn options_are_all_combinations_and_their_order_in_the_file_does_not_matter() {
        let study = Study::read("s.toml", STUDY).unwrap();
        let ids: Vec<&str> = study.options.iter().map(|option| option.id.value.as_str()).collect();
        assert_eq!(ids, ["thick-12", "thick-3", "thin-12", "thin-3"]);
        let thick = &study.options[1];
        assert_eq!((thick.name.as_str(), thick.settings.len()), ("Thick, 3", 2));
        let row = thick.threat.row().unwrap();
        assert_eq!((row.rope.as_str(), row.traps, row.device.as_str()), ("1/2in", 3, "NA"));
        assert!((row.diameter_m - 0.0127).abs() < 1e-12);
        assert!(study.options[3].threat.row().is_none(), "a rope without labels has no row");

        let [traps, rope] = [STUDY.find("[[axis]]").unwrap(), STUDY.rfind("[[axis]]").unwrap()];
        let end = STUDY.find("[encounter").unwrap();
        let swapped =
            [&STUDY[..traps], &STUDY[rope..end], &STUDY[traps..rope], &STUDY[end..]].concat();
        let swapped = Study::read("s.toml", &swapped).unwrap();
        assert_eq!(swapped.canonical, study.canonical);
        let expected = STUDY.replace("threat = { traps = 3 }\n", "");
        assert_eq!(Study::read("s.toml", &expected).unwrap().canonical, study.canonical);
        let other = STUDY.replace("rope_nodes = 100", "rope_nodes = 101");
        assert_ne!(Study::read("s.toml", &other).unwrap().canonical, study.canonical);
    }

    #[test]
    fn an_error_of_an_axis_has_its_place() {
        for (from, to, expected) in [
            ("id = \"12\"", "id = \"3\"", "there are two values `3`"),
            ("\"line.0.rope\" = \"pp-1-2\"", "rope_nodes = 3", "two axes set `rope_nodes`"),
            ("id = \"traps\"\n", "", "`id` is missing"),
            ("traps = 12", "trap = 12", "unknown field `trap`"),
            ("baseline = \"thick-3\"", "baseline = \"thick\"", "there is no option `thick`"),
        ] {
            let problems = Study::read("s.toml", &STUDY.replace(from, to)).unwrap_err();
            assert!(
                problems.iter().any(|problem| problem.message.contains(expected)),
                "{expected}: {problems:?}"
            );
        }
    }
}

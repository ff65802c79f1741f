//! Axes: options as every combination of one value of each, such as four ropes by four lengths of trawl.

use crate::diagnostic::At;
use crate::fields::{Fields, Problems};
use crate::tree::Node;

use super::option::{self, StudyOption};
use super::threat::ThreatLabels;

/// Most options that axes may make.
const MOST_OPTIONS: usize = 256;

/// One of the things that options differ in, with its values by id.
struct Axis {
    id: At<String>,
    values: Vec<StudyOption>,
}

/// Reads axes and combines their values, axes in the order of their ids.
pub(super) fn read_all(nodes: &[Node], problems: &Problems) -> Vec<StudyOption> {
    let mut axes: Vec<Axis> = nodes.iter().filter_map(|node| read(node, problems)).collect();
    axes.sort_by(|one, other| one.id.value.cmp(&other.id.value));
    let Some(first) = axes.first() else { return Vec::new() };
    let count = axes.iter().fold(1_usize, |count, axis| count.saturating_mul(axis.values.len()));
    if count > MOST_OPTIONS {
        problems.push(first.id.place.error(
            format!("the axes make {count} options"),
            format!("at most {MOST_OPTIONS} are compared: leave out some values"),
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
    options.first().into_iter().for_each(|option| check_once(option, problems));
    options
}

fn read(node: &Node, problems: &Problems) -> Option<Axis> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write what the options differ in, such as id = \"rope\"");
    let nodes = fields.tables("value");
    if nodes.is_empty() {
        fields.missing("value", "write each of its values under [[axis.value]]");
    }
    let values = option::read_each(nodes, "value", problems);
    fields.finish();
    Some(Axis { id: id?, values })
}

/// An option with one more value: ids by hyphens, names by commas; where both give a strength or a curve, the later one's.
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
    fn options_are_every_combination_and_their_order_in_the_file_says_nothing() {
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
        let told = STUDY.replace("threat = { traps = 3 }\n", "");
        assert_eq!(Study::read("s.toml", &told).unwrap().canonical, study.canonical);
        let other = STUDY.replace("rope_nodes = 100", "rope_nodes = 101");
        assert_ne!(Study::read("s.toml", &other).unwrap().canonical, study.canonical);
    }

    #[test]
    fn what_is_wrong_with_axes_is_told_where_it_stands() {
        for (from, to, told) in [
            ("id = \"12\"", "id = \"3\"", "there are two values `3`"),
            ("\"line.0.rope\" = \"pp-1-2\"", "rope_nodes = 3", "two axes set `rope_nodes`"),
            ("id = \"traps\"\n", "", "`id` is missing"),
            ("traps = 12", "trap = 12", "unknown field `trap`"),
            ("baseline = \"thick-3\"", "baseline = \"thick\"", "there is no option `thick`"),
        ] {
            let problems = Study::read("s.toml", &STUDY.replace(from, to)).unwrap_err();
            assert!(
                problems.iter().any(|problem| problem.message.contains(told)),
                "{told}: {problems:?}"
            );
        }
    }
}

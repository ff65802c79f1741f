//! What finer segments and steps change in how often an event comes, as another study found it on the same encounters.

use crate::diagnostic::At;
use crate::fields::{Fields, Problems};
use crate::limits;
use crate::tree::Node;

use super::event::{self, StudyEvent};

/// An event with the segments and steps of this study and with finer ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Discretisation {
    /// The event.
    pub event: StudyEvent,
    /// Encounters by whether the event came: with both, with the segments of this study alone, with finer ones alone, with neither.
    pub both: u64,
    /// As said.
    pub only_here: u64,
    /// As said.
    pub only_finer: u64,
    /// As said.
    pub neither: u64,
    /// The study and the program that found it.
    pub source: String,
}

/// Reads `[[discretisation]]`.
pub(super) fn read_all(fields: &Fields<'_>) -> Vec<Discretisation> {
    let nodes = fields.tables("discretisation").iter();
    nodes.filter_map(|node| read(node, fields.problems())).collect()
}

fn read(node: &Node, problems: &Problems) -> Option<Discretisation> {
    let fields = Fields::of(node, problems);
    let event = event::need(&fields, "event");
    let encounters = count(&fields, "encounters");
    let both = count(&fields, "both");
    let only_here = count(&fields, "only_here");
    let only_finer = count(&fields, "only_finer");
    let source = fields.need_text("source", "name the study and the program that found it");
    fields.finish();
    let (encounters, both) = (encounters?, both?.value);
    let (only_here, only_finer) = (only_here?.value, only_finer?.value);
    let came = both.saturating_add(only_here).saturating_add(only_finer);
    let Some(neither) = encounters.value.checked_sub(came) else {
        problems.push(encounters.place.error(
            format!("`encounters` is {}, fewer than the {came} with the event", encounters.value),
            "write all encounters that count with both, those without the event among them",
        ));
        return None;
    };
    Some(Discretisation {
        event: event?,
        both,
        only_here,
        only_finer,
        neither,
        source: source?.value,
    })
}

/// A number of encounters that must be there.
fn count<'a>(fields: &Fields<'a>, key: &'a str) -> Option<At<u64>> {
    if fields.get(key).is_none() {
        fields.missing(key, "write how many encounters, such as 8");
    }
    fields.count(key, &limits::COUNTED)
}

#[cfg(test)]
mod tests {
    use crate::study::Study;

    const STUDY: &str = "format = 1\nkind = \"study\"\nname = \"s\"\nscenario = \"hello-endline\"\nencounters = 4\nbaseline = \"a\"\n\
        [[option]]\nid = \"a\"\n[encounter.speed]\nuniform = [\"0.5 m/s\", \"1 m/s\"]\nsource = \"assumed\"\n\
        [[discretisation]]\nevent = \"lodged\"\nencounters = 220\nboth = 19\nonly_here = 1\nonly_finer = 5\nsource = \"a study\"\n";

    #[test]
    fn what_finer_segments_change_is_read_and_changes_no_run() {
        let study = Study::read("s.toml", STUDY).unwrap();
        let [found] = study.discretisations.as_slice() else {
            panic!("{:?}", study.discretisations)
        };
        assert_eq!((found.event.name(), found.neither), ("lodged".to_owned(), 195));
        let without = &STUDY[..STUDY.find("[[discretisation]]").unwrap()];
        assert_eq!(Study::read("s.toml", without).unwrap().canonical, study.canonical);
    }

    #[test]
    fn what_is_wrong_with_it_is_told_where_it_stands() {
        for (from, to, told) in [
            ("encounters = 220", "encounters = 24", "fewer than the 25 with the event"),
            ("both = 19\n", "", "`both` is missing"),
            ("\"lodged\"", "\"lodgd\"", "there is no event `lodgd`"),
            ("only_finer = 5", "only_finer = 0.5", "`only_finer` is 0.5"),
        ] {
            let problems = Study::read("s.toml", &STUDY.replace(from, to)).unwrap_err();
            assert!(
                problems.iter().any(|problem| problem.message.contains(told)),
                "{told}: {problems:?}"
            );
        }
    }
}

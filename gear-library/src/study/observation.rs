//! An observation: a share seen on real whales, against which a study's own share is held.

use crate::diagnostic::At;
use crate::fields::{Fields, Problems, Range};
use crate::tree::{Content, Node};
use crate::units::Quantity;

use super::event::{self, StudyEvent};
use super::option::{StudyOption, check_known};

/// A share that was observed, and how a study answers it.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservedShare {
    /// Id.
    pub id: At<String>,
    /// What was seen, in words.
    pub says: String,
    /// Who saw it.
    pub source: String,
    /// What is counted.
    pub of: StudyEvent,
    /// Among which encounters; all where it is not named.
    pub among: Option<StudyEvent>,
    /// In which option; the baseline where it is not named.
    pub option: Option<String>,
    /// By what share the event is rarer with this option than with that one, instead of the event's own share.
    pub fewer_with: Option<String>,
    /// What the share is multiplied by before it is held against what was observed [1].
    pub times: f64,
    /// Least and greatest share that agree with what was observed [1].
    pub observed: [f64; 2],
    /// What is believed to be the reason where it misses, and what the comparison leaves out; may be empty.
    pub notes: String,
}

/// Reads `[[observation]]`, sorted by id.
pub(super) fn read_all(fields: &Fields<'_>, options: &[StudyOption]) -> Vec<ObservedShare> {
    let mut observations: Vec<ObservedShare> = fields
        .tables("observation")
        .iter()
        .filter_map(|node| read(node, options, fields.problems()))
        .collect();
    observations.sort_by(|one, other| one.id.value.cmp(&other.id.value));
    observations
}

fn read(node: &Node, options: &[StudyOption], problems: &Problems) -> Option<ObservedShare> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write an id such as \"mouth\"");
    let says = fields.need_text("says", "write what was seen, in words");
    let source = fields.need_text("source", "say who saw it");
    let of = event::need(&fields, "of");
    let among = event::maybe(&fields, "among");
    let (option, fewer_with) =
        (known(&fields, "option", options), known(&fields, "fewer_with", options));
    let times = fields.value("times", Quantity::Ratio, Range::Positive);
    let observed = observed(&fields);
    let notes = fields.text("notes").map(|notes| notes.value).unwrap_or_default();
    fields.finish();
    Some(ObservedShare {
        id: id?,
        says: says?.value,
        source: source?.value,
        of: of?,
        among,
        option: option.map(|option| option.value),
        fewer_with: fewer_with.map(|option| option.value),
        times: times.map_or(1.0, |times| times.value),
        observed: observed?,
        notes,
    })
}

/// An option by id, if it is named.
fn known(fields: &Fields<'_>, key: &'static str, options: &[StudyOption]) -> Option<At<String>> {
    let named = fields.text(key)?;
    check_known(&named, options, fields.problems());
    Some(named)
}

/// Two shares in rising order.
fn observed(fields: &Fields<'_>) -> Option<[f64; 2]> {
    let help = "write the least and the greatest share that agree, such as observed = [0.60, 0.89]";
    let Some(node) = fields.get("observed") else {
        fields.missing("observed", help);
        return None;
    };
    let numbers: Vec<f64> = match &node.content {
        Content::List(items) => items
            .iter()
            .filter_map(|item| match item.content {
                Content::Number(number) => Some(number),
                _ => None,
            })
            .collect(),
        _ => Vec::new(),
    };
    match *numbers.as_slice() {
        [low, high] if low < high => Some([low, high]),
        _ => {
            fields.problems().push(node.place.error("these are no two rising shares", help));
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::study::Study;

    const STUDY: &str = "format = 1\nkind = \"study\"\nname = \"s\"\nscenario = \"hello-endline\"\nencounters = 4\nbaseline = \"a\"\n\
        [[option]]\nid = \"a\"\n[[option]]\nid = \"b\"\n[encounter.speed]\nuniform = [\"0.5 m/s\", \"1 m/s\"]\nsource = \"assumed\"\n\
        [[observation]]\nid = \"o\"\nsays = \"seen\"\nsource = \"a paper\"\nof = \"held_lodged\"\namong = \"entangled\"\nfewer_with = \"b\"\ntimes = 0.5\nobserved = [0.6, 0.9]\n";

    #[test]
    fn an_observation_is_read_and_changes_no_run() {
        let study = Study::read("s.toml", STUDY).unwrap();
        let [seen] = study.observations.as_slice() else { panic!("{:?}", study.observations) };
        assert_eq!((seen.of.name(), seen.observed), ("held_lodged".to_owned(), [0.6, 0.9]));
        assert_eq!((seen.option.as_deref(), seen.fewer_with.as_deref()), (None, Some("b")));
        let without = &STUDY[..STUDY.find("[[observation]]").unwrap()];
        assert_eq!(Study::read("s.toml", without).unwrap().canonical, study.canonical);
    }

    #[test]
    fn what_is_wrong_with_an_observation_is_told_where_it_stands() {
        for (from, to, told) in [
            ("fewer_with = \"b\"", "fewer_with = \"c\"", "there is no option `c`"),
            ("[0.6, 0.9]", "[0.9, 0.6]", "these are no two rising shares"),
            ("observed = [0.6, 0.9]\n", "", "`observed` is missing"),
            ("held_lodged", "held_loged", "there is no event `held_loged`"),
        ] {
            let problems = Study::read("s.toml", &STUDY.replace(from, to)).unwrap_err();
            assert!(
                problems.iter().any(|problem| problem.message.contains(told)),
                "{told}: {problems:?}"
            );
        }
    }
}

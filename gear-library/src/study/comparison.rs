//! Comparisons of a study: claims (one rate is greater than another), shares observed on real whales, how observed whales are
//! held, and the effect of finer segments and steps found by another study.

use crate::diagnostic::At;
use crate::fields::{Fields, Range};
use crate::limits;
use crate::tree::Content;
use crate::units::Quantity;

use super::event::{self, StudyEvent};
use super::option::{StudyOption, check_known, texts};

/// A statement with a sign.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Id.
    pub id: At<String>,
    /// The statement in words.
    pub says: String,
    /// Its source.
    pub source: String,
    /// Event with the greater rate.
    pub event: StudyEvent,
    /// Pooled options of the greater rate.
    pub more: Vec<String>,
    /// Event with the smaller rate, usually the same one.
    pub less_event: StudyEvent,
    /// Pooled options of the smaller rate.
    pub less: Vec<String>,
}

/// Reads `[[claim]]`, sorted by id.
pub(super) fn read_claims(fields: &Fields<'_>, options: &[StudyOption]) -> Vec<Claim> {
    let mut claims = fields.each("claim", |table| read_claim(table, options));
    claims.sort_by(|one, other| one.id.value.cmp(&other.id.value));
    claims
}

fn read_claim(fields: &Fields<'_>, options: &[StudyOption]) -> Option<Claim> {
    let id = fields.need_id("id", "write an id such as \"slack-mouth\"");
    let says = fields.need_text("says", "write the statement in words");
    let source = fields.need_text("source", "name the source of the statement");
    let event = event::need(fields, "event");
    let less_event = event::maybe(fields, "less_event");
    let more = known_options(fields, "more", options);
    let less = known_options(fields, "less", options);
    let event = event?;
    Some(Claim {
        id: id?,
        says: says?.value,
        source: source?.value,
        less_event: less_event.unwrap_or_else(|| event.clone()),
        event,
        more: more?,
        less: less?,
    })
}

/// Options by id, at least one.
fn known_options(
    fields: &Fields<'_>,
    key: &'static str,
    options: &[StudyOption],
) -> Option<Vec<String>> {
    let named: Vec<At<String>> = texts(fields, key);
    if named.is_empty() {
        fields.missing(key, "name one or more options, such as [\"slack\"]");
        return None;
    }
    named.iter().for_each(|id| check_known(id, options, fields.problems()));
    Some(named.into_iter().map(|id| id.value).collect())
}

/// An observed share, and the share of the study to compare with.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservedShare {
    /// Id.
    pub id: At<String>,
    /// The observation in words.
    pub says: String,
    /// Its source.
    pub source: String,
    /// Counted event.
    pub of: StudyEvent,
    /// Event that selects encounters; `None` for all.
    pub among: Option<StudyEvent>,
    /// Option; `None` for the baseline.
    pub option: Option<String>,
    /// Option for the relative reduction of the event, which replaces the share of the event.
    pub fewer_with: Option<String>,
    /// Factor on the share before the comparison [1].
    pub times: f64,
    /// Range of shares that agree with the observation [1].
    pub observed: [f64; 2],
    /// Why the gear or the question decides the result beforehand, so that it tests nothing; `None` for a real comparison.
    pub by_construction: Option<String>,
    /// Presumed reason of a difference, and limits of the comparison; may be empty.
    pub notes: String,
}

/// Reads `[[observation]]`, sorted by id.
pub(super) fn read_observations(
    fields: &Fields<'_>,
    options: &[StudyOption],
) -> Vec<ObservedShare> {
    let mut observations = fields.each("observation", |table| read_observation(table, options));
    observations.sort_by(|one, other| one.id.value.cmp(&other.id.value));
    observations
}

fn read_observation(fields: &Fields<'_>, options: &[StudyOption]) -> Option<ObservedShare> {
    let id = fields.need_id("id", "write an id such as \"mouth\"");
    let says = fields.need_text("says", "write the observation in words");
    let source = fields.need_text("source", "name the source of the observation");
    let of = event::need(fields, "of");
    let among = event::maybe(fields, "among");
    let (option, fewer_with) =
        (known_option(fields, "option", options), known_option(fields, "fewer_with", options));
    let times = fields.value("times", Quantity::Ratio, Range::Positive);
    let observed = observed(fields);
    let by_construction = by_construction(fields);
    let notes = fields.text("notes").map(|notes| notes.value).unwrap_or_default();
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
        by_construction,
        notes,
    })
}

/// The reason for which a comparison tests nothing, if there is one; an empty reason is refused.
fn by_construction(fields: &Fields<'_>) -> Option<String> {
    let reason = fields.text("by_construction")?;
    if reason.value.trim().is_empty() {
        let help =
            "write what decides the result, such as \"the foot is a fixture\", or remove the field";
        return fields.refuse(reason.place.error("`by_construction` gives no reason", help));
    }
    Some(reason.value)
}

/// An option by id, if present.
fn known_option(
    fields: &Fields<'_>,
    key: &'static str,
    options: &[StudyOption],
) -> Option<At<String>> {
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
        _ => fields.refuse(node.place.error("these are not two rising shares", help)),
    }
}

/// Observed whales by the places at which gear held them.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservedRoutes {
    /// Whales held by the mouth or head alone.
    pub mouth: u64,
    /// Whales held by flippers or the body alone.
    pub flipper: u64,
    /// Whales held by the tail alone.
    pub tail: u64,
    /// Whales held by at least two of these.
    pub several: u64,
    /// Source of the numbers.
    pub source: String,
}

/// Reads `[routes]`.
pub(super) fn read_routes(fields: &Fields<'_>) -> Option<ObservedRoutes> {
    fields.inside("routes", read_observed_routes).flatten()
}

fn read_observed_routes(fields: &Fields<'_>) -> Option<ObservedRoutes> {
    let number = |key| {
        fields.require(key, "write the number of observed whales held in this way, such as 21");
        fields.count(key, &limits::COUNTED)
    };
    let [mouth, flipper, tail, several] = ["mouth", "flipper", "tail", "several"].map(number);
    let source = fields.need_text("source", "name the source of the numbers");
    let (mouth, flipper, tail) = (mouth?, flipper?.value, tail?.value);
    let several = several?.value;
    if mouth.value == 0 && flipper == 0 && tail == 0 && several == 0 {
        let help = "write the numbers of observed whales, or remove the table [routes]";
        return fields.refuse(mouth.place.error("no whale was observed", help));
    }
    Some(ObservedRoutes { mouth: mouth.value, flipper, tail, several, source: source?.value })
}

/// Frequency of an event with the segments and steps of this study and with finer ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Discretisation {
    /// The event.
    pub event: StudyEvent,
    /// Encounters with the event in both discretisations.
    pub both: u64,
    /// Encounters with the event only in that of this study.
    pub only_here: u64,
    /// Encounters with the event only in the finer one.
    pub only_finer: u64,
    /// Encounters without the event.
    pub neither: u64,
    /// The study and the program version.
    pub source: String,
}

/// Reads `[[discretisation]]`.
pub(super) fn read_discretisations(fields: &Fields<'_>) -> Vec<Discretisation> {
    fields.each("discretisation", read_discretisation)
}

fn read_discretisation(fields: &Fields<'_>) -> Option<Discretisation> {
    let event = event::need(fields, "event");
    let encounters = count(fields, "encounters");
    let both = count(fields, "both");
    let only_here = count(fields, "only_here");
    let only_finer = count(fields, "only_finer");
    let source = fields.need_text("source", "name the study and the program version");
    let (encounters, both) = (encounters?, both?.value);
    let (only_here, only_finer) = (only_here?.value, only_finer?.value);
    let with_event = both.saturating_add(only_here).saturating_add(only_finer);
    let Some(neither) = encounters.value.checked_sub(with_event) else {
        return fields.refuse(encounters.place.error(
            format!(
                "`encounters` is {}, fewer than the {with_event} with the event",
                encounters.value
            ),
            "write the number of all compared encounters, including those without the event",
        ));
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

/// A required number of encounters.
fn count<'a>(fields: &Fields<'a>, key: &'a str) -> Option<At<u64>> {
    fields.require(key, "write a number of encounters, such as 8");
    fields.count(key, &limits::COUNTED)
}

#[cfg(test)]
mod tests {
    use crate::study::Study;

    const OBSERVED_STUDY: &str = "format = 1\nkind = \"study\"\nname = \"s\"\nscenario = \"hello-endline\"\nencounters = 4\nbaseline = \"a\"\n\
        [[option]]\nid = \"a\"\n[[option]]\nid = \"b\"\n[encounter.speed]\nuniform = [\"0.5 m/s\", \"1 m/s\"]\nsource = \"assumed\"\n\
        [[observation]]\nid = \"o\"\nsays = \"seen\"\nsource = \"a paper\"\nof = \"held_lodged\"\namong = \"entangled\"\nfewer_with = \"b\"\ntimes = 0.5\nobserved = [0.6, 0.9]\nby_construction = \"the gear decides it\"\n";

    #[test]
    fn an_observation_is_read_and_changes_no_run() {
        let study = Study::read("s.toml", OBSERVED_STUDY).unwrap();
        let [seen] = study.observations.as_slice() else { panic!("{:?}", study.observations) };
        assert_eq!((seen.of.name(), seen.observed), ("held_lodged".to_owned(), [0.6, 0.9]));
        assert_eq!((seen.option.as_deref(), seen.fewer_with.as_deref()), (None, Some("b")));
        assert_eq!(seen.by_construction.as_deref(), Some("the gear decides it"));
        let without = &OBSERVED_STUDY[..OBSERVED_STUDY.find("[[observation]]").unwrap()];
        assert_eq!(Study::read("s.toml", without).unwrap().canonical, study.canonical);
    }

    #[test]
    fn problems_of_an_observation_are_reported() {
        for (from, to, expected) in [
            ("fewer_with = \"b\"", "fewer_with = \"c\"", "there is no option `c`"),
            ("[0.6, 0.9]", "[0.9, 0.6]", "these are not two rising shares"),
            ("observed = [0.6, 0.9]\n", "", "`observed` is missing"),
            ("held_lodged", "held_loged", "there is no event `held_loged`"),
            ("the gear decides it", " ", "`by_construction` gives no reason"),
        ] {
            let problems = Study::read("s.toml", &OBSERVED_STUDY.replace(from, to)).unwrap_err();
            assert!(
                problems.iter().any(|problem| problem.message.contains(expected)),
                "{expected}: {problems:?}"
            );
        }
    }

    #[test]
    fn routes_are_read_and_change_no_run_and_their_problems_are_reported() {
        let plain = &OBSERVED_STUDY[..OBSERVED_STUDY.find("[[observation]]").unwrap()];
        let with = |routes: &str| Study::read("s.toml", &format!("{plain}[routes]\n{routes}"));
        let all = "mouth = 21\nflipper = 8\ntail = 7\nseveral = 48\nsource = \"a table\"\n";
        let study = with(all).unwrap();
        let routes = study.routes.unwrap();
        assert_eq!([routes.mouth, routes.flipper, routes.tail, routes.several], [21, 8, 7, 48]);
        assert_eq!(Study::read("s.toml", plain).unwrap().canonical, study.canonical);
        for (routes, expected) in [
            (all.replace("tail = 7\n", ""), "`tail` is missing"),
            (all.replace("tail = 7", "tail = -7"), "`tail`"),
            (all.replace("source = \"a table\"\n", ""), "`source` is missing"),
            (
                "mouth = 0\nflipper = 0\ntail = 0\nseveral = 0\nsource = \"a\"\n".to_owned(),
                "no whale was observed",
            ),
        ] {
            let problems = with(&routes).unwrap_err();
            let is_it = |problem: &crate::Diagnostic| problem.message.contains(expected);
            assert!(problems.iter().any(is_it), "{expected}: {problems:?}");
        }
    }

    const REFINED_STUDY: &str = "format = 1\nkind = \"study\"\nname = \"s\"\nscenario = \"hello-endline\"\nencounters = 4\nbaseline = \"a\"\n\
        [[option]]\nid = \"a\"\n[encounter.speed]\nuniform = [\"0.5 m/s\", \"1 m/s\"]\nsource = \"assumed\"\n\
        [[discretisation]]\nevent = \"lodged\"\nencounters = 220\nboth = 19\nonly_here = 1\nonly_finer = 5\nsource = \"a study\"\n";

    #[test]
    fn a_discretisation_is_read_and_changes_no_run() {
        let study = Study::read("s.toml", REFINED_STUDY).unwrap();
        let [found] = study.discretisations.as_slice() else {
            panic!("{:?}", study.discretisations)
        };
        assert_eq!((found.event.name(), found.neither), ("lodged".to_owned(), 195));
        let without = &REFINED_STUDY[..REFINED_STUDY.find("[[discretisation]]").unwrap()];
        assert_eq!(Study::read("s.toml", without).unwrap().canonical, study.canonical);
    }

    #[test]
    fn problems_of_a_discretisation_are_reported() {
        for (from, to, expected) in [
            ("encounters = 220", "encounters = 24", "fewer than the 25 with the event"),
            ("both = 19\n", "", "`both` is missing"),
            ("\"lodged\"", "\"lodgd\"", "there is no event `lodgd`"),
            ("only_finer = 5", "only_finer = 0.5", "`only_finer` is 0.5"),
        ] {
            let problems = Study::read("s.toml", &REFINED_STUDY.replace(from, to)).unwrap_err();
            assert!(
                problems.iter().any(|problem| problem.message.contains(expected)),
                "{expected}: {problems:?}"
            );
        }
    }
}

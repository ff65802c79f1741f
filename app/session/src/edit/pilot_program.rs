//! The pilot program in the scenario's text, to be shown and edited: its entries, when each begins
//! and what it steers.

use endline_gear::units::{Quantity, parse};
use endline_gear::{Document, Setting};
use endline_sdk::Controls;

use super::documents::Documents;

/// Path of the list of entries in the scenario.
pub const LIST: &str = "whale.pilot";

/// Keys that begin an entry, each with its name and the value of a new entry.
pub const TRIGGERS: [(&str, &str, &str); 7] = [
    ("at", "at a time", "0 s"),
    ("touch", "when rope touches", "any"),
    ("within", "within a distance of gear", "5 m"),
    ("sees", "seeing gear", "3 m"),
    ("depth", "passing a depth", "10 m"),
    ("heading", "passing a heading", "90 deg"),
    ("after", "after an entry", ""),
];

/// Keys of an entry that are times.
const TIMES: [&str; 3] = ["delay", "hold", "ramp"];

/// An entry of the pilot program.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Its place in the file.
    pub index: usize,
    /// The key that begins it, of [`TRIGGERS`]; empty where it has none.
    pub trigger: &'static str,
    /// The value of that key.
    pub of: String,
    /// When it begins [s]; `None` where only the run decides.
    pub begin_s: Option<f64>,
    /// How long it holds [s]; `None` for ever.
    pub hold_s: Option<f64>,
    /// The controls that it sets, by place in [`Controls::NAMES`], with their values as written.
    pub controls: Vec<(usize, String)>,
}

impl Entry {
    /// A short description: its start and its settings.
    pub fn words(&self) -> String {
        let begins = TRIGGERS
            .iter()
            .find(|(key, ..)| *key == self.trigger)
            .map_or("never", |(_, words, _)| words);
        let values = self
            .controls
            .iter()
            .map(|(control, text)| format!("{} {text}", spoken(Controls::NAMES[*control])));
        format!("{begins} {}: {}", self.of, values.collect::<Vec<_>>().join(", "))
    }

    /// The number that a control is set to; `None` where it is not set, or is an act.
    pub fn number(&self, control: usize) -> Option<f64> {
        self.controls.iter().find(|(known, _)| *known == control)?.1.parse().ok()
    }
}

/// The name of a control in plain words.
pub fn spoken(control: &str) -> String {
    control.replace('_', " ")
}

/// The path of a key of an entry.
pub fn path(index: usize, key: &str) -> String {
    format!("{LIST}.{index}.{key}")
}

/// Every entry, in the order of the file.
pub fn entries(documents: &Documents) -> Vec<Entry> {
    let field = |index: usize, key: &str| documents.field(Documents::SCENARIO, &path(index, key));
    let time = |index: usize, key: &str| {
        field(index, key).and_then(|text| parse(&text, Quantity::Time).ok())
    };
    let mut found: Vec<Entry> = Vec::new();
    let mut ids: Vec<Option<String>> = Vec::new();
    for index in 0..documents.count(Documents::SCENARIO, LIST) {
        let given = TRIGGERS.iter().find_map(|(key, ..)| Some((*key, field(index, key)?)));
        let (trigger, of) = given.unwrap_or_default();
        let begin_s = match trigger {
            "at" => time(index, "at"),
            "after" => {
                let before = ids
                    .iter()
                    .position(|id| id.as_deref() == Some(of.as_str()))
                    .and_then(|before| found[before].begin_s);
                before.map(|before_s| before_s + time(index, "delay").unwrap_or(0.0))
            }
            _ => None,
        };
        let named = Controls::NAMES
            .iter()
            .enumerate()
            .filter_map(|(control, name)| Some((control, field(index, name)?)));
        found.push(Entry {
            index,
            trigger,
            of,
            begin_s,
            hold_s: time(index, "hold"),
            controls: named.collect(),
        });
        ids.push(field(index, "id"));
    }
    found
}

/// Until when an entry's value of a control holds [s]: until its hold is over, until the next entry
/// that sets the control, or until the end.
pub fn until_s(all: &[Entry], entry: &Entry, control: usize, end_s: f64) -> f64 {
    let Some(begin_s) = entry.begin_s else { return end_s };
    let names = |other: &&Entry| other.controls.iter().any(|(known, _)| *known == control);
    let later = all
        .iter()
        .filter(names)
        .filter_map(|other| other.begin_s)
        .filter(|other_s| *other_s > begin_s);
    let next_s = later.fold(end_s.max(begin_s), f64::min);
    entry.hold_s.map_or(next_s, |hold_s| (begin_s + hold_s).min(next_s))
}

/// A time as text: to the millisecond, without trailing zeros.
pub fn seconds(time_s: f64) -> String {
    format!("{} s", (time_s.max(0.0) * 1000.0).round() / 1000.0)
}

/// Moves an entry to another time and sorts the entries by time; returns its new place.
/// Errors: where the scenario has no such entry.
pub fn move_to(document: &mut Document, index: usize, time_s: f64) -> Result<usize, String> {
    document
        .put(&path(index, "at"), &Setting::text(&seconds(time_s)))
        .map_err(|error| error.to_string())?;
    in_order(document, index)
}

/// Sorts the entries that begin at a time; returns the new place of the entry `index`.
/// Errors: where the scenario has no such entry.
pub fn in_order(document: &mut Document, index: usize) -> Result<usize, String> {
    let at = |document: &Document, index: usize| {
        document.get(&path(index, "at")).and_then(|text| parse(&text, Quantity::Time).ok())
    };
    // Only timed entries are sorted. An entry named by `after` stays above the one that names it.
    let timed: Vec<usize> =
        (0..document.count(LIST)).filter(|index| at(document, *index).is_some()).collect();
    let mut here = index;
    for _ in 0..timed.len() {
        for pair in timed.windows(2) {
            let [one, other] = [pair[0], pair[1]];
            if at(document, one) > at(document, other) {
                document.swap_tables(LIST, one, other).map_err(|error| error.to_string())?;
                here = if here == one {
                    other
                } else if here == other {
                    one
                } else {
                    here
                };
            }
        }
    }
    Ok(here)
}

/// Adds an entry that begins at a time; returns its place.
/// Errors: where the scenario has no whale to pilot.
pub fn add(document: &mut Document, time_s: f64) -> Result<usize, String> {
    if !document.has("whale") {
        return Err("this scenario has no whale to pilot".to_owned());
    }
    let fields = [("at", seconds(time_s)), ("hold", "2 s".to_owned()), ("yaw", "0.5".to_owned())];
    let fields: Vec<(&str, &str)> =
        fields.iter().map(|(key, text)| (*key, text.as_str())).collect();
    let index = document.push_table(LIST, &fields).map_err(|error| error.to_string())?;
    in_order(document, index)
}

/// Changes what begins an entry.
/// Errors: where the scenario has no such entry.
pub fn begin_by(
    document: &mut Document,
    index: usize,
    trigger: &str,
    text: &str,
) -> Result<(), String> {
    for key in TRIGGERS
        .iter()
        .map(|(key, ..)| *key)
        .chain(["of", "sees_deviation"])
        .chain((trigger == "at").then_some("delay"))
    {
        if document.has(&path(index, key)) {
            document.remove(&path(index, key)).map_err(|error| error.to_string())?;
        }
    }
    document.put(&path(index, trigger), &Setting::text(text)).map_err(|error| error.to_string())
}

/// Sets a key of an entry to the text typed; an empty text removes it.
/// Errors: where the scenario has no such entry.
pub fn set(document: &mut Document, index: usize, key: &str, text: &str) -> Result<(), String> {
    let path = path(index, key);
    let text = text.trim();
    if text.is_empty() {
        return if document.has(&path) {
            document.remove(&path).map_err(|error| error.to_string())
        } else {
            Ok(())
        };
    }
    let plain = Controls::NAMES.contains(&key) && key != "act";
    let value = if plain { Setting::plain(text) } else { Setting::text(text) };
    document.put(&path, &value).map_err(|error| error.to_string())?;
    if key == "at" { in_order(document, index).map(|_| ()) } else { Ok(()) }
}

/// The keys of times that an entry with this trigger may have.
pub fn times(trigger: &str) -> &'static [&'static str] {
    if trigger == "at" { &TIMES[1..] } else { &TIMES }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[whale]\nitem = \"x\"\n\n# first\n[[whale.pilot]]\nat = \"0 s\"\nspeed = 1.0\n\n# second\n[[whale.pilot]]\nid = \"turn\"\nat = \"4 s\"\nyaw = 0.5\n\n[[whale.pilot]]\nafter = \"turn\"\ndelay = \"1 s\"\nroll = 1.0\n\n[friction]\nmodel = \"m\"\n";

    #[test]
    fn an_entry_moved_past_another_changes_places_with_it_and_takes_its_comment_along() {
        let mut document = Document::parse(TEXT).unwrap();
        assert_eq!(move_to(&mut document, 0, 7.25), Ok(1));
        let text = document.text();
        assert!(text.find("# second").unwrap() < text.find("# first").unwrap(), "{text}");
        assert!(
            text.contains("at = \"7.25 s\"")
                && text.find("# first").unwrap() < text.find("[friction]").unwrap(),
            "{text}"
        );
        assert_eq!(
            document.get("whale.pilot.2.after").as_deref(),
            Some("turn"),
            "reactions stay where they are"
        );
        assert_eq!(move_to(&mut document, 1, 0.0), Ok(0));
        let back = document.text();
        assert!(back.find("# first").unwrap() < back.find("# second").unwrap(), "{back}");
    }

    #[test]
    fn an_added_entry_stands_in_the_order_of_time_and_before_the_tables_after_the_whale() {
        let mut document = Document::parse(TEXT).unwrap();
        let index = add(&mut document, 2.0).unwrap();
        assert_eq!(document.get(&path(index, "at")).as_deref(), Some("2 s"));
        assert_eq!(document.get(&path(0, "at")).as_deref(), Some("0 s"));
        let text = document.text();
        let last = text.rfind("[[whale.pilot]]").unwrap();
        assert!(last < text.find("[friction]").unwrap(), "{text}");
        assert!(add(&mut Document::parse("name = \"x\"").unwrap(), 0.0).is_err());
    }

    #[test]
    fn what_begins_an_entry_is_one_thing() {
        let mut document = Document::parse(TEXT).unwrap();
        begin_by(&mut document, 2, "at", "9 s").unwrap();
        assert_eq!(document.get(&path(2, "after")), None);
        assert_eq!(document.get(&path(2, "delay")), None, "an entry with a time has no delay");
        begin_by(&mut document, 0, "within", "5 m").unwrap();
        set(&mut document, 0, "of", "buoy").unwrap();
        assert_eq!(document.get(&path(0, "of")).as_deref(), Some("buoy"));
        set(&mut document, 0, "speed", "").unwrap();
        assert_eq!(document.get(&path(0, "speed")), None);
        set(&mut document, 1, "yaw", "-0.25").unwrap();
        assert!(document.text().contains("yaw = -0.25"), "{}", document.text());
    }

    #[test]
    fn a_word_holds_until_its_own_hold_or_the_next_that_names_the_control() {
        let entry = |index, begin_s, hold_s, control| Entry {
            index,
            trigger: "at",
            of: String::new(),
            begin_s: Some(begin_s),
            hold_s,
            controls: vec![(control, "1.0".into())],
        };
        let all = [entry(0, 0.0, None, 3), entry(1, 4.0, Some(2.0), 3), entry(2, 5.0, None, 1)];
        let ends: Vec<f64> =
            all.iter().map(|entry| until_s(&all, entry, entry.controls[0].0, 20.0)).collect();
        assert_eq!(ends, [4.0, 6.0, 20.0]);
    }
}

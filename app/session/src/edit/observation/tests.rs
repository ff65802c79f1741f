//! Edits of an observation, each read again as the search reads it.

use endline_gear::{Observation, PathPlace, RopeEnd};

use super::*;

const TEXT: &str = r#"format = 1
kind = "observation"
name = "Seen"
source = "a test"
confidence = "measured"

# What the drawing shows.
[[site]]
part = "peduncle"
present = 0.97 # sure
wraps = [0.5, 2]

[[site]]
part = "flipper"
present = 0.1
"#;

fn edited(edit: impl FnOnce(&mut Document) -> Result<(), String>) -> (String, Observation) {
    let mut document = Document::parse(TEXT).unwrap();
    edit(&mut document).unwrap();
    let text = document.text();
    let seen = Observation::read("seen.toml", &text)
        .unwrap_or_else(|problems| panic!("{text}\n{problems:?}"));
    (text, seen)
}

fn present(seen: &Observation, site: Site) -> Option<f64> {
    seen.sites.iter().find(|seen| seen.site == site).map(|seen| seen.present)
}

#[test]
fn a_part_is_seen_hidden_and_unknown_again() {
    let (text, seen) = edited(|document| set_sighting(document, Site::Mouth, Sighting::Seen(0.8)));
    assert_eq!(present(&seen, Site::Mouth), Some(0.8));
    assert!(text.contains("# What the drawing shows."), "{text}");
    let (_, seen) = edited(|document| {
        set_sighting(document, Site::Peduncle, Sighting::Hidden)?;
        set_sighting(document, Site::Head, Sighting::Hidden)
    });
    assert_eq!((present(&seen, Site::Peduncle), seen.hidden.len()), (None, 2));
    let (text, seen) = edited(|document| {
        set_sighting(document, Site::Head, Sighting::Hidden)?;
        set_sighting(document, Site::Head, Sighting::Seen(0.3))?;
        set_sighting(document, Site::Flipper, Sighting::Nothing)
    });
    assert_eq!((present(&seen, Site::Head), seen.hidden.len()), (Some(0.3), 0));
    assert!(!text.contains("[hidden]") && !text.contains("flipper"), "{text}");
}

#[test]
fn a_part_takes_the_sighting_of_its_pair_and_the_reverse() {
    let (_, seen) = edited(|document| rename(document, Site::Flipper, Site::LeftFlipper));
    assert_eq!(present(&seen, Site::LeftFlipper), Some(0.1));
    assert_eq!(present(&seen, Site::Flipper), None);
    let (_, seen) = edited(|document| {
        set_sighting(document, Site::LeftFluke, Sighting::Hidden)?;
        set_sighting(document, Site::RightFluke, Sighting::Seen(0.9))?;
        rename(document, Site::LeftFluke, Site::Fluke)
    });
    assert_eq!(
        (seen.hidden, present(&seen_sites(&[]), Site::RightFluke)),
        (vec![Site::Fluke], None)
    );
}

/// An observation with a number of sites beside those of the text.
fn seen_sites(sites: &[Site]) -> Observation {
    edited(|document| {
        sites.iter().try_for_each(|site| set_sighting(document, *site, Sighting::Seen(1.0)))
    })
    .1
}

#[test]
fn ranges_begin_with_one_value_and_go_with_it() {
    let none = || [String::new(), String::new()];
    let wraps = Range::Wraps(Site::Body);
    let (_, seen) = edited(|document| set_range(document, wraps, none(), 0, "1"));
    assert_eq!(seen.sites[2].wraps, Some([1.0, 1.0]));
    let (_, seen) = edited(|document| {
        set_range(document, Range::Trailing, none(), 1, "200 ft")?;
        set_range(document, Range::Trailing, ["200 ft".into(), "200 ft".into()], 0, "50 m")?;
        set_range(document, Range::Twist, none(), 0, "2")
    });
    let length_m = seen.trailing.unwrap().length_m.unwrap();
    assert!((length_m[0] - 50.0).abs() < 1e-9 && (length_m[1] - 60.96).abs() < 1e-9);
    assert_eq!(seen.twist, Some([2.0, 2.0]));
    let own = Range::Wraps(Site::Peduncle);
    let (text, seen) = edited(|document| {
        set_range(document, own, ["0.5".into(), "2".into()], 0, " ")?;
        set_range(document, Range::Twist, none(), 0, "1")?;
        set_range(document, Range::Twist, ["1".into(), "1".into()], 1, "")
    });
    assert!(seen.sites[0].wraps.is_none() && !text.contains("twist"), "{text}");
}

#[test]
fn what_is_no_number_is_reported_at_its_line() {
    let mut document = Document::parse(TEXT).unwrap();
    let ends = ["0.5".into(), "2".into()];
    set_range(&mut document, Range::Wraps(Site::Peduncle), ends, 1, "many").unwrap();
    let problems = Observation::read("seen.toml", &document.text()).unwrap_err();
    assert!(
        problems.iter().any(|problem| problem.field.starts_with("site.0.wraps")),
        "{problems:?}"
    );
}

#[test]
fn a_path_is_put_in_order_and_ends_come_and_go() {
    let place = |name: &str| PathPlace::named(name).unwrap();
    let (_, seen) = edited(|document| {
        for name in ["body", "mouth:left", "peduncle"] {
            add_place(document, place(name))?;
        }
        move_place(document, 1)?;
        remove_place(document, 2)?;
        add_end(document, RopeEnd::Buoy)?;
        add_end(document, RopeEnd::Broken)?;
        remove_end(document, 0)
    });
    assert_eq!(seen.path, [place("mouth:left"), place("body")]);
    assert_eq!(seen.trailing.unwrap().ends, [RopeEnd::Broken]);
    let (text, _) = edited(|document| {
        add_place(document, place("body"))?;
        remove_place(document, 0)?;
        add_end(document, RopeEnd::Trap)?;
        remove_end(document, 0)
    });
    assert!(!text.contains("[path]") && !text.contains("[trailing]"), "{text}");
}

#[test]
fn a_length_takes_the_place_of_an_age() {
    let (text, seen) = edited(|document| {
        set_field(document, "age", "2 yr")?;
        set_field(document, "length", "9 m")?;
        set_field(document, "source", "somebody else")?;
        set_field(document, "whale", "minke")?;
        set_field(document, "whale", "")
    });
    assert_eq!(seen.size, Some(endline_gear::Size::Length(9.0)));
    assert!(text.contains("somebody else") && !text.contains("minke"), "{text}");
}

#[test]
fn a_new_observation_wants_only_a_part() {
    let problems = Observation::read("new.toml", NEW).unwrap_err();
    assert!(problems.len() == 1 && problems[0].message.contains("`site`"), "{problems:?}");
}

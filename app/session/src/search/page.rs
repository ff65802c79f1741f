//! The report of a search as one HTML page: the data of `assets/report/search.html`.

use std::collections::BTreeSet;

use askama::Template;
use endline_gear::{Observation, SeenSite, prior_words};

use crate::encounters::in_words;
use crate::error::Error;
use crate::page::{Cell, Line, STYLE, Table};
use crate::save;

use super::body_map::BodyMaps;
use super::distance::LIKE;
use super::folder::Folder;
use super::posterior::Quantity;
use super::question::Question;
use super::stories::{Stories, Story};

/// Stories with a section of their own.
const WITH_SECTION: usize = 6;

/// All that the page shows: the template takes tables and words from these, and escapes texts.
#[derive(Template)]
#[template(path = "search.html")]
struct Page<'a> {
    observation: &'a Observation,
    stories: &'a Stories,
    sections: Vec<Section>,
    /// Outlines of the whale, to which the body maps refer.
    outlines: String,
    /// The head of the search's hash.
    hash: &'a str,
    seed: u64,
    /// The command that makes the search again.
    command: String,
}

/// A story with its terms and its drawn values.
struct Section {
    heading: String,
    /// Body maps of what was seen and of the end of the story, as SVG.
    maps: Option<[String; 2]>,
    picture: Option<String>,
    terms: Option<Table>,
    drawn: Table,
}

/// Writes `report.html` into the folder of a search, with the pictures of stories in that folder.
/// Errors: where it cannot be written.
pub fn write(
    question: &Question,
    folder: &Folder,
    stories: &Stories,
) -> Result<std::path::PathBuf, Error> {
    let file = folder.path.join("report.html");
    let sections = stories.stories.iter().enumerate().take(WITH_SECTION);
    let whale = question
        .opened
        .options
        .first()
        .and_then(|option| option.prepared.model.spec.whale.as_ref());
    let maps = whale.map(|whale| BodyMaps::of(&whale.skin));
    let section = |(index, story): (usize, &Story)| Section {
        maps: maps.as_ref().map(|maps| {
            [maps.seen(&question.observation), maps.found(&story.ending, story.mirrored)]
        }),
        ..one(folder, index + 1, story)
    };
    let page = Page {
        observation: &question.observation,
        stories,
        sections: sections.map(section).collect(),
        outlines: maps.as_ref().map(BodyMaps::definitions).unwrap_or_default(),
        hash: &question.hash[..16],
        seed: question.seed,
        command: format!(
            "endline search {} --encounters {} --trials {} --net {}",
            question.observation.id, stories.encounters, stories.trials, stories.net
        ),
    };
    let html = page.render().map_err(Error::on(&file, "cannot be written"))?;
    save::atomically(&file, html.as_bytes()).map_err(Error::on(&file, "cannot be written"))?;
    Ok(file)
}

/// The observation, site by site, then of the rope as a whole.
fn seen(observation: &Observation) -> Table {
    let range = |range: Option<[f64; 2]>| {
        range.map_or(String::new(), |[least, most]| format!("{least} to {most}"))
    };
    let site = |seen: &SeenSite| {
        let tight = seen.tight.map_or("", |tight| if tight { "tight" } else { "slack" });
        let sure = 100.0 * seen.present.max(1.0 - seen.present);
        let there = if seen.present > 0.5 { "rope" } else { "no rope" };
        [
            seen.site.name().replace('_', " "),
            format!("{there}, {sure:.0} % sure"),
            range(seen.wraps),
            range(seen.across),
            tight.to_owned(),
            seen.seen_by.clone(),
        ]
        .map(Cell::from)
        .into()
    };
    let mut rows: Vec<Vec<Cell>> = observation.sites.iter().map(site).collect();
    let mut whole = |what: &str, text: String| {
        if !text.is_empty() {
            rows.push([what, &text, "", "", "", ""].map(Cell::from).into());
        }
    };
    let places: Vec<String> = observation.path.iter().map(ToString::to_string).collect();
    whole("path", places.join(", "));
    let trailing = observation.trailing.as_ref();
    let length = trailing.and_then(|trailing| trailing.length_m);
    whole("rope behind the whale", length.map_or(String::new(), |[a, b]| format!("{a} to {b} m")));
    let ends = trailing.map(|trailing| &trailing.ends);
    let ends: Vec<&str> = ends.into_iter().flatten().map(|end| end.words()).collect();
    whole("its ends", ends.join(", "));
    whole("twists", range(observation.twist));
    let hidden: Vec<&str> = observation.hidden.iter().map(|site| site.name()).collect();
    whole("hidden from view", hidden.join(", ").replace('_', " "));
    let heads = ["where", "what", "wraps", "strands across", "tightness", "seen by"];
    Table::new("What was seen", &heads, rows)
}

/// The stories, a line each.
fn table_of(stories: &Stories) -> Table {
    let row = |(number, story): (usize, &Story)| {
        [
            format!("{}", number + 1),
            format!("{:.2}", story.distance),
            story.first_part.replace('_', " "),
            story.acts_in_words(),
            story.course.to_owned(),
            if story.mirrored { "yes" } else { "" }.to_owned(),
            alike(story),
            story.on_finer().unwrap_or_default(),
            story.share(stories).map_or(String::new(), |share| format!("{:.0} %", 100.0 * share)),
        ]
        .map(Cell::from)
        .into()
    };
    let rows = stories.stories.iter().enumerate().map(row).collect();
    let headings = [
        "",
        "distance",
        "first touched",
        "acts",
        "course",
        "mirrored",
        "neighbours that end alike",
        "on a finer resolution",
        "share of the draws that end alike",
    ];
    Table::new("Stories, the nearest first", &headings, rows)
}

fn alike(story: &Story) -> String {
    let fragile = if story.is_fragile() { ", fragile" } else { "" };
    story.alike.map_or(String::new(), |alike| format!("{:.0} %{fragile}", 100.0 * alike))
}

fn one(folder: &Folder, number: usize, story: &Story) -> Section {
    let picture = format!("story-{number}/picture.png");
    let terms = story
        .terms
        .iter()
        .map(|(cost, says)| vec![format!("{cost:.2}").into(), says.clone().into()]);
    let drawn = story.drawn.iter().map(|(name, text)| {
        let text = if text.contains(' ') { in_words(text) } else { text.replace('-', " ") };
        vec![prior_words(name).into(), text.into()]
    });
    Section {
        heading: format!(
            "Story {number}: first the {}, {}",
            story.first_part.replace('_', " "),
            story.acts_in_words()
        ),
        maps: None,
        picture: folder.path.join(&picture).is_file().then_some(picture),
        terms: (!story.terms.is_empty()).then(|| {
            Table::new(
                "What is different from what was seen, by cost",
                &["cost", ""],
                terms.collect(),
            )
        }),
        drawn: Table::new("The encounter", &["drawn", ""], drawn.collect()),
    }
}

/// Quantities that the stories like the observation have in common; `None` with fewer than two stories.
fn common(stories: &Stories) -> Option<Table> {
    let like: Vec<&Story> = stories.stories.iter().filter(|story| story.is_like()).collect();
    let first = like.first().filter(|_| like.len() > 1)?;
    let mut rows: Vec<Vec<Cell>> = vec![shared(
        "first touched",
        like.iter().map(|story| story.first_part.replace('_', " ")).collect(),
    )];
    for (name, _) in &first.drawn {
        let of = |story: &&Story| {
            let found = story.drawn.iter().find(|(other, _)| other == name);
            found.map(|(_, text)| in_words(text)).unwrap_or_default()
        };
        rows.push(shared(name, like.iter().map(of).collect()));
    }
    Some(Table::new("Stories that end like what was seen", &["", "in common", "different"], rows))
}

/// Quantities among the draws that end alike, beside all draws; `None` if there are too few.
fn posterior(stories: &Stories) -> Option<Table> {
    let row = |quantity: &Quantity| -> Vec<Cell> {
        let Quantity { name, like, all } = quantity;
        [name, like, all].map(|text| Cell::from(text.clone())).into()
    };
    let rows: Vec<Vec<Cell>> = stories.posterior.iter().map(row).collect();
    let caption = format!("{} of {} draws that end alike", stories.net_like, stories.net);
    (!rows.is_empty())
        .then(|| Table::new(&caption, &["", "draws that end alike", "all draws"], rows))
}

/// A quantity: its one value, its range, or its several words.
fn shared(name: &str, values: BTreeSet<String>) -> Vec<Cell> {
    let number = |text: &String| {
        let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
        number.parse::<f64>().ok().map(|number| (number, unit.to_owned()))
    };
    let numbers: Option<Vec<(f64, String)>> = values.iter().map(number).collect();
    let [common, apart] = match numbers {
        _ if values.len() == 1 => [values.into_iter().collect(), String::new()],
        Some(numbers) => {
            let least = numbers.iter().map(|(number, _)| *number).fold(f64::INFINITY, f64::min);
            let most = numbers.iter().map(|(number, _)| *number).fold(f64::NEG_INFINITY, f64::max);
            [String::new(), format!("{least:.2} to {most:.2} {}", numbers[0].1)]
        }
        None => [String::new(), values.into_iter().collect::<Vec<_>>().join(", ")],
    };
    [name.to_owned(), common, apart].map(Cell::from).into()
}

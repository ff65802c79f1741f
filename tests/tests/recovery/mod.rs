//! Blind recovery: encounters with hidden parameters are run, what they left is told with noise and hidden parts, and a search that
//! knows nothing else looks for encounters that end alike.
#![allow(
    clippy::unwrap_used,
    dead_code,
    reason = "a test fails by panicking, in its helpers too, and each user uses its part"
)]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_gear::Site;
use endline_session::plugins::{Hook, PluginHost};
use endline_session::search::written::observation_text;
use endline_session::search::{Effort, Ending, Folder, Question, search};
use endline_session::study::encounter::Encounter;
use endline_session::study::{Control, Opened, Shard, draw};
use endline_sim::metrics::EventKind;

/// Study whose encounters are hidden and searched.
const STUDY: &str = "met-single";

/// Seed of the hidden encounters; that of the search is the study's.
const SEED: u64 = 77;

/// An encounter that a search shall recover.
pub struct Hidden {
    /// What kind of ending it is.
    pub class: &'static str,
    /// The part that rope touched first.
    pub first_part: String,
    ending: Ending,
}

/// The plugins that ship, linked into this program.
pub fn host() -> PluginHost {
    let mut host = PluginHost::empty();
    host.add(Hook::Motion(Arc::new(endline_whale_motions::Swim::new()))).unwrap();
    let friction = endline_friction_models::all().into_iter().map(Hook::Friction);
    let gear = endline_gear_types::all().into_iter().map(Hook::Gear);
    friction.chain(gear).for_each(|hook| host.add(hook).unwrap());
    host
}

/// The study whose encounters are hidden.
pub fn opened(host: &PluginHost) -> Opened {
    let study = root().join("studies").join(format!("{STUDY}.toml"));
    Opened::open(&study, Some(&root()), host).unwrap()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../gear-library")
}

/// Runs draws until there are as many of each class as asked for, or enough draws were tried.
pub fn hide(opened: &Opened, count: usize) -> Vec<Hidden> {
    let of_each = count.div_ceil(5);
    let mut hidden: BTreeMap<&'static str, Vec<Hidden>> = BTreeMap::new();
    let dimensions = draw::dimensions(&opened.study).len();
    for index in 0..1000 {
        let point = draw::sobol_point(SEED, index, dimensions);
        let Ok(played) = opened.play(0, &Encounter::at_point(opened, &point), 0.0) else {
            continue;
        };
        let ending = Ending::of(&played.run);
        let Some(class) = class(&ending).filter(|_| played.report.is_valid()) else { continue };
        let events = played.run.metrics().events();
        let first = events.iter().find(|event| event.kind == EventKind::Contact).unwrap();
        let own = hidden.entry(class).or_default();
        if own.len() < of_each {
            own.push(Hidden { class, first_part: first.subject.clone(), ending });
        }
        if hidden.values().map(Vec::len).sum::<usize>() >= count {
            break;
        }
    }
    hidden.into_values().flatten().take(count).collect()
}

/// What kind of ending it is; `None` of a whale that came free.
fn class(ending: &Ending) -> Option<&'static str> {
    let wraps = |site| ending.at(site).map(|at| at.wraps);
    let at = |site| ending.at(site).is_some();
    if ending.sites.is_empty() {
        return None;
    }
    Some(if at(Site::Mouth) {
        "mouth"
    } else if at(Site::Fluke) || at(Site::Peduncle) {
        "tail"
    } else if wraps(Site::Body).is_some_and(|wraps| wraps >= 0.4) {
        "body"
    } else if at(Site::Flipper) {
        "flipper"
    } else {
        "head or body, loose"
    })
}

/// What a search made of a hidden encounter.
pub struct Recovered {
    /// Distance of the nearest story.
    pub nearest: f64,
    /// Whether a story that is like it has the part that rope truly touched first.
    pub named: bool,
    /// Trials after which the first story like it was found.
    pub after: Option<usize>,
}

/// Searches for a hidden encounter by what is told of its ending.
pub fn recover(hidden: &Hidden, number: usize, trials: usize, host: &PluginHost) -> Recovered {
    let place =
        std::env::temp_dir().join(format!("endline-recovery-{}-{number}", std::process::id()));
    std::fs::create_dir_all(&place).unwrap();
    let file = place.join(format!("hidden-{number}.toml"));
    std::fs::write(&file, observation_text(&hidden.ending, STUDY, number as u64)).unwrap();
    let question = Question::open(&file.display().to_string(), None, Some(&root()), host).unwrap();
    let folder = Folder::open(&place.join(format!("search-{number}")), &question).unwrap();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let effort = Effort { trials, threads, shard: Shard::WHOLE, neighbours: 0, net_alone: false };
    let mut after = None;
    let stories = search(&question, &folder, &effort, &Control::default(), |progress| {
        if after.is_none() && progress.best.is_some_and(|best| best <= 1.0) {
            after = Some(progress.trials);
        }
    })
    .unwrap();
    let nearest = stories.stories.first().map_or(f64::INFINITY, |story| story.distance);
    let named = stories
        .stories
        .iter()
        .any(|story| story.is_like() && story.first_part == hidden.first_part);
    std::fs::remove_dir_all(place).unwrap();
    Recovered { nearest, named, after }
}

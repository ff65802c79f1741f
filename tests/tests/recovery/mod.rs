//! Blind recovery: encounters with hidden parameters are run, and their endings are reported with noise and hidden parts. A search that
//! has only these reports finds encounters with such endings.
#![allow(
    clippy::unwrap_used,
    dead_code,
    reason = "a test fails by panicking, in its helpers too, and each user uses its part"
)]

use std::collections::VecDeque;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_gear::Site;
use endline_session::campaign::{Control, Shard};
use endline_session::encounters::{Encounter, draw};
use endline_session::plugins::{Hook, PluginHost};
use endline_session::search::observation_from_run::observation_text;
use endline_session::search::{Effort, Ending, Folder, LIKE, Question, search};
use endline_session::study::PreparedStudy;
use endline_sim::metrics::EventKind;

/// Study whose encounters are hidden and searched.
const STUDY: &str = "met-single";

/// Seed of the hidden encounters; that of the search is the study's.
const SEED: u64 = 77;

/// Draws run before it is asked whether there are enough.
const AT_ONCE: u32 = 16;

/// Draws run at most.
const MOST_DRAWS: u32 = 400;

/// Kinds of ending.
const CLASSES: usize = 5;

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
pub fn opened(host: &PluginHost) -> PreparedStudy {
    let study = root().join("studies").join(format!("{STUDY}.toml"));
    PreparedStudy::open(&study, Some(&root()), host).unwrap()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../gear-library")
}

/// Runs draws until there are as many of each class as asked for, or enough were tried; then classes take turns.
pub fn hide(opened: &PreparedStudy, count: usize) -> Vec<Hidden> {
    let of_each = count.div_ceil(CLASSES);
    // In the order in which they appear.
    let mut classes: Vec<VecDeque<Hidden>> = Vec::new();
    for first in (0..MOST_DRAWS).step_by(AT_ONCE as usize) {
        for found in some(opened, first..first + AT_ONCE).into_iter().flatten() {
            match classes.iter_mut().find(|class| class[0].class == found.class) {
                Some(class) => class.push_back(found),
                None => classes.push(VecDeque::from([found])),
            }
        }
        let enough = classes.iter().filter(|class| class.len() >= of_each).count();
        if enough * of_each >= count {
            break;
        }
    }
    let mut hidden = Vec::new();
    while hidden.len() < count && classes.iter().any(|class| !class.is_empty()) {
        hidden.extend(classes.iter_mut().filter_map(VecDeque::pop_front));
    }
    hidden.truncate(count);
    hidden
}

/// Draws that end with rope on the whale, in order, on every core.
fn some(opened: &PreparedStudy, numbers: Range<u32>) -> Vec<Option<Hidden>> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let numbers: Vec<u32> = numbers.collect();
    let run = |numbers: &[u32]| -> Vec<Option<Hidden>> {
        numbers.iter().map(|number| one(opened, *number)).collect()
    };
    let run = &run;
    std::thread::scope(|scope| {
        let shares = numbers.chunks(numbers.len().div_ceil(threads));
        let all: Vec<_> = shares.map(|share| scope.spawn(move || run(share))).collect();
        all.into_iter().flat_map(|share| share.join().unwrap()).collect()
    })
}

/// A draw, where it ends with rope on the whale.
fn one(opened: &PreparedStudy, number: u32) -> Option<Hidden> {
    let point = draw::sobol_point(SEED, number, draw::dimensions(&opened.study).len());
    let played = opened.play(0, &Encounter::at_point(&opened.study, &point), 0.0).ok()?;
    let ending = Ending::of(&played.run);
    let class = class(&ending).filter(|_| played.report.is_valid())?;
    let events = played.run.metrics().events();
    let first = events.iter().find(|event| event.kind == EventKind::Contact)?;
    Some(Hidden { class, first_part: first.subject.clone(), ending })
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

/// Effort and folder of the searches.
pub struct Way<'a> {
    /// Runs of a search whose net alone finds nothing like.
    pub trials: usize,
    /// Of these, draws from the priors before the first local search.
    pub net: usize,
    /// Folder of the observations, the searches, and the draws that they share; a repeated call continues from its contents.
    pub folder: &'a Path,
}

/// Searches for a hidden encounter by the report of its ending.
pub fn recover(hidden: &Hidden, number: usize, way: &Way<'_>, host: &PluginHost) -> Recovered {
    let Way { trials, net, folder } = *way;
    std::fs::create_dir_all(folder).unwrap();
    let file = folder.join(format!("hidden-{number}.toml"));
    std::fs::write(&file, observation_text(&hidden.ending, STUDY, number as u64)).unwrap();
    let question = Question::open(&file.display().to_string(), None, Some(&root()), host).unwrap();
    let own = folder.join(format!("search-{number}"));
    let runs = Folder::open(&own, Some(&folder.join("net")), &question).unwrap();
    let mut after = None;
    let mut search = |trials| {
        let effort = effort(trials, net);
        search(&question, &runs, &effort, &Control::default(), |progress| {
            if after.is_none() && progress.best.is_some_and(|best| best <= LIKE) {
                after = Some(progress.trials);
            }
        })
        .unwrap()
    };
    let drawn = search(net);
    let found = drawn.stories.first().is_some_and(|story| story.distance <= LIKE);
    let stories = if found { drawn } else { search(trials) };
    let nearest = stories.stories.first().map_or(f64::INFINITY, |story| story.distance);
    let named = stories
        .stories
        .iter()
        .any(|story| story.is_like() && story.first_part == hidden.first_part);
    Recovered { nearest, named, after }
}

fn effort(trials: usize, net: usize) -> Effort {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    Effort { trials, threads, shard: Shard::WHOLE, neighbours: 0, net }
}

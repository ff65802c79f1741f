//! What a search found: the best trial of every kind of story, and how many of its neighbours end alike.

use serde::Serialize;

use crate::error::Error;
use crate::save;
use crate::study::control::{Control, Count};
use crate::study::encounter::Encounter;

use super::Effort;
use super::batch;
use super::distance::LIKE;
use super::elites::{Elite, Kind};
use super::folder::Folder;
use super::jitter::neighbour;
use super::question::Question;
use super::rounds::Rounds;
use super::trial::Trial;

/// Stories told at most.
const TOLD: usize = 12;

/// Of this many, neighbours are run.
const JITTERED: usize = 6;

/// A story of which fewer neighbours end alike hangs on chance.
pub const FRAGILE: f64 = 0.5;

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stories {
    /// Id of the observation.
    pub observation: String,
    /// Id of the study whose encounters were searched.
    pub encounters: String,
    /// The best of every kind, the nearest first.
    pub stories: Vec<Story>,
    /// Trials run, neighbours not counted.
    pub trials: usize,
    /// Simulated time of the net's trials, on average [s].
    pub mean_simulated_s: f64,
    /// Trials of the net: draws of the priors themselves.
    pub net: usize,
    /// Of these, those like the observation.
    pub net_like: usize,
}

/// A story: an encounter, and how it ended.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Story {
    /// The part that rope touched first.
    pub first_part: String,
    /// What the whale did before and then.
    pub acts: Vec<String>,
    /// Where it came from, against the current; empty where no heading is drawn.
    pub course: &'static str,
    /// Distance of its ending from the observation.
    pub distance: f64,
    /// The terms of the distance, each with its reason.
    pub terms: Vec<(f64, String)>,
    /// Whether it is the mirror image that is like the observation.
    pub mirrored: bool,
    /// Share of its neighbours that end alike; `None` where none was run.
    pub alike: Option<f64>,
    /// Time that its run took [s].
    pub simulated_s: f64,
    /// What was drawn, by name.
    pub drawn: Vec<(String, String)>,
    /// Hash of the last state.
    pub state_hash: String,
    /// Where in the unit cube of encounters.
    pub point: Vec<f64>,
}

impl Story {
    /// What the whale did, in words.
    #[must_use]
    pub fn acts_in_words(&self) -> String {
        if self.acts.is_empty() { "swims on".to_owned() } else { self.acts.join(", then ") }
    }

    /// Whether it is like the observation.
    #[must_use]
    pub fn is_like(&self) -> bool {
        self.distance <= LIKE
    }

    /// Whether it hangs on chance.
    #[must_use]
    pub fn is_fragile(&self) -> bool {
        self.alike.is_some_and(|alike| alike < FRAGILE)
    }
}

impl Stories {
    /// What was found, in a sentence.
    #[must_use]
    pub fn answer(&self) -> String {
        let like = self.stories.iter().filter(|story| story.is_like()).count();
        let fragile =
            self.stories.iter().filter(|story| story.is_like() && story.is_fragile()).count();
        match like {
            0 => format!("Not found in {} runs: no story ends like what was seen.", self.trials),
            1 if fragile == 1 => {
                "One kind of story ends like this, and hangs on chance.".to_owned()
            }
            1 => "One kind of story ends like this.".to_owned(),
            _ => format!("{like} kinds of story end like this; {fragile} of them hang on chance."),
        }
    }

    /// As JSON.
    #[must_use]
    pub fn json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

/// The stories of a search, and the neighbours of those that are like the observation.
///
/// # Errors
/// A folder that cannot be read or written.
pub(super) fn of(
    question: &Question,
    folder: &Folder,
    effort: &Effort,
    control: &Control,
    rounds: &Rounds<'_>,
) -> Result<Stories, Error> {
    let mut found = so_far(question, rounds);
    let jittered = if effort.neighbours == 0 { 0 } else { JITTERED };
    let like = found.stories.iter().filter(|story| story.is_like()).count().min(jittered);
    control.begin(Count::of(like * effort.neighbours), Count::default());
    for story in found.stories.iter_mut().filter(|story| story.is_like()).take(jittered) {
        story.alike = alike(question, folder, effort, control, &story.point)?;
    }
    let file = folder.path.join("stories.json");
    save::atomically(&file, (found.json() + "\n").as_bytes())
        .map_err(|error| Error::at(&file, format!("cannot be written: {error}")))?;
    Ok(found)
}

/// The stories of the rounds so far, without their neighbours.
pub(super) fn so_far(question: &Question, rounds: &Rounds<'_>) -> Stories {
    let mut elites: Vec<(&Kind, &Elite)> = rounds.elites.0.iter().collect();
    elites.sort_by(|one, other| one.1.trial.distance.total_cmp(&other.1.trial.distance));
    let stories =
        elites.iter().take(TOLD).map(|(kind, elite)| story(question, kind, elite)).collect();
    let net = &rounds.net;
    let simulated: f64 = net.iter().map(|trial| trial.simulated_s).sum();
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 trials")]
    Stories {
        observation: question.observation.id.clone(),
        encounters: question.opened.study.id.clone(),
        stories,
        trials: rounds.trials(),
        mean_simulated_s: simulated / net.len().max(1) as f64,
        net: net.len(),
        net_like: net.iter().filter(|trial| trial.distance <= LIKE).count(),
    }
}

fn story(question: &Question, kind: &Kind, elite: &Elite) -> Story {
    let Trial { distance, terms, mirrored, simulated_s, state_hash, .. } = elite.trial.clone();
    let drawn = Encounter::at_point(&question.opened, &elite.point).drawn;
    Story {
        first_part: kind.first_part.clone(),
        acts: kind.acts.clone(),
        course: kind.quarter.map_or("", course),
        distance,
        terms,
        mirrored,
        alike: None,
        simulated_s,
        drawn: drawn.into_iter().map(|drawn| (drawn.name, drawn.text)).collect(),
        state_hash,
        point: elite.point.clone(),
    }
}

fn course(quarter: u8) -> &'static str {
    match quarter {
        0 => "with the current",
        1 => "current from starboard",
        2 => "against the current",
        _ => "current from port",
    }
}

/// Share of a story's neighbours that are like the observation as well; `None` where the search was cancelled before all were run.
fn alike(
    question: &Question,
    folder: &Folder,
    effort: &Effort,
    control: &Control,
    point: &[f64],
) -> Result<Option<f64>, Error> {
    let mut hasher = blake3::Hasher::new();
    for share in point {
        hasher.update(&share.to_le_bytes());
    }
    let round = format!("neighbours-{}", &hasher.finalize().to_hex()[..16]);
    let trial = |number: usize| Trial::of_encounter(question, &neighbour(question, point, number));
    let run = batch::run(folder, &round, effort.neighbours, effort, control, trial)?;
    let Some(trials) = run else { return Ok(None) };
    let like = trials.iter().filter(|trial| trial.distance <= LIKE).count();
    #[expect(clippy::cast_precision_loss, reason = "a few")]
    let share = like as f64 / effort.neighbours as f64;
    Ok(Some(share))
}

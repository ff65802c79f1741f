//! What a search found: the best trial of every kind of story, its share of the draws that end alike, and whether it hangs on chance
//! or on the resolution.

use schemars::JsonSchema;
use serde::Serialize;

use crate::campaign::control::{Control, Count};
use crate::encounters::Encounter;
use crate::error::Error;
use crate::save;

use super::Effort;
use super::distance::LIKE;
use super::elites::{Elite, Kind};
use super::folder::Folder;
use super::posterior::{Quantity, quantities};
use super::question::Question;
use super::robust::{self, Tried, most_robust};
use super::rounds::Rounds;
use super::trial::{FAULTY, Trial};

/// Name and version of the JSON form.
const SCHEMA: &str = "endline.stories/1";

/// Stories told at most.
const TOLD: usize = 12;

/// Of the nearest kinds, so many are tried by neighbours and on a finer resolution.
const TRIED: usize = 6;

/// A story of which fewer neighbours end alike hangs on chance.
pub const FRAGILE: f64 = 0.5;

/// What was found.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Stories {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// Id of the observation.
    pub observation: String,
    /// Id of the study whose encounters were searched.
    pub encounters: String,
    /// A run of every kind, the kind with the nearest first: the most robust of those like the observation, or else the nearest.
    pub stories: Vec<Story>,
    /// Trials run, neighbours not counted.
    pub trials: usize,
    /// Simulated time of the net's trials, on average [s].
    pub mean_simulated_s: f64,
    /// Trials of the net: draws of the priors themselves.
    pub net: usize,
    /// Of these, those like the observation: what shares of kinds rest on (all draws count alike, so that this is the effective
    /// number).
    pub net_like: usize,
    /// Every quantity among the draws like the observation, beside all draws; none where too few are like it.
    pub posterior: Vec<Quantity>,
}

/// A story: an encounter, and how it ended.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
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
    /// Distance of the same encounter on a finer resolution, 1000 where that run came to no valid end; `None` where it was not run.
    pub finer: Option<f64>,
    /// Draws from the priors that are of this kind and like the observation.
    pub draws_like: usize,
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

    /// Share of the draws like the observation that are of this kind; `None` where no draw is.
    #[must_use]
    pub fn share(&self, stories: &Stories) -> Option<f64> {
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 draws")]
        let share = || self.draws_like as f64 / stories.net_like as f64;
        (stories.net_like > 0).then(share)
    }

    /// How far it is to be trusted, in words: neighbours, finer resolution, share of draws; `None` where nothing is known.
    #[must_use]
    pub fn trust(&self, stories: &Stories) -> Option<String> {
        let fragile = if self.is_fragile() { ", fragile" } else { "" };
        let alike = self
            .alike
            .map(|alike| format!("{:.0} % of its neighbours end alike{fragile}", 100.0 * alike));
        let finer = self.on_finer().map(|finer| format!("on a finer resolution {finer}"));
        let share = self.share(stories).filter(|share| *share > 0.0);
        let share = share.map(|share| {
            let (own, like) = (self.draws_like, stories.net_like);
            format!("{:.0} % of the draws that end alike ({own} of {like})", 100.0 * share)
        });
        let told: Vec<String> = [alike, finer, share].into_iter().flatten().collect();
        (!told.is_empty()).then(|| told.join("; "))
    }

    /// What the encounter comes to on a finer resolution, in words; `None` where it was not run.
    #[must_use]
    pub fn on_finer(&self) -> Option<String> {
        self.finer.map(|distance| match distance {
            FAULTY.. => "no valid end".to_owned(),
            ..=LIKE => format!("alike ({distance:.2})"),
            _ => format!("not alike ({distance:.2})"),
        })
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
    let mut found = so_far(rounds);
    let like = found.stories.iter().filter(|story| story.is_like()).count();
    let tried = if effort.neighbours == 0 { 0 } else { like.min(TRIED) };
    control.begin(Count::of(tried * robust::most_runs(effort)), Count::default());
    for (place, (kind, _)) in nearest(rounds).into_iter().take(tried).enumerate() {
        let like = rounds.elites.like(kind);
        let Some(tried) = most_robust(question, folder, effort, control, &like)? else { break };
        found.stories[place] = story(rounds, kind, tried.elite, Some(&tried));
    }
    let file = folder.path.join("stories.json");
    save::atomically(&file, (found.json() + "\n").as_bytes())
        .map_err(|error| Error::at(&file, format!("cannot be written: {error}")))?;
    Ok(found)
}

/// The nearest of every kind, the nearest first.
fn nearest<'a>(rounds: &'a Rounds<'_>) -> Vec<(&'a Kind, &'a Elite)> {
    let mut elites: Vec<(&Kind, &Elite)> = rounds.elites.best.iter().collect();
    elites.sort_by(|one, other| one.1.trial.distance.total_cmp(&other.1.trial.distance));
    elites
}

/// The stories of the rounds so far, without their neighbours.
pub(super) fn so_far(rounds: &Rounds<'_>) -> Stories {
    let question = rounds.question;
    let told = nearest(rounds).into_iter().take(TOLD);
    let stories = told.map(|(kind, elite)| story(rounds, kind, elite, None)).collect();
    let net = &rounds.net;
    let simulated: f64 = net.iter().map(|(_, trial)| trial.simulated_s).sum();
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 trials")]
    Stories {
        schema: SCHEMA,
        observation: question.observation.id.clone(),
        encounters: question.opened.study.id.clone(),
        stories,
        trials: rounds.trials(),
        mean_simulated_s: simulated / net.len().max(1) as f64,
        net: net.len(),
        net_like: net.iter().filter(|(_, trial)| trial.distance <= LIKE).count(),
        posterior: quantities(rounds),
    }
}

fn story(rounds: &Rounds<'_>, kind: &Kind, elite: &Elite, tried: Option<&Tried<'_>>) -> Story {
    let question = rounds.question;
    let Trial { distance, terms, mirrored, simulated_s, state_hash, .. } = elite.trial.clone();
    let drawn = Encounter::at_point(&question.opened.study, &elite.point).drawn;
    let like = rounds.net.iter().filter(|(_, trial)| trial.distance <= LIKE);
    let is_own = |point: &[f64], trial: &Trial| Kind::of(question, point, trial) == *kind;
    Story {
        first_part: kind.first_part.clone(),
        acts: kind.acts.clone(),
        course: kind.quarter.map_or("", course),
        distance,
        terms,
        mirrored,
        alike: tried.map(|tried| tried.alike),
        finer: tried.map(|tried| tried.finer),
        draws_like: like.filter(|(point, trial)| is_own(point, trial)).count(),
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

//! The stories that a search has found: the best trial of every kind, its share of the draws that end alike, and its robustness.

use crate::campaign::{Control, Count};
use crate::encounters::Encounter;
use crate::error::Error;
use crate::{json, save};

use super::Effort;
use super::distance::LIKE;
use super::elites::{Elite, Kind, Trial};
use super::folder::Folder;
use super::posterior::quantities;
use super::question::Question;
use super::robust::{self, Tried, most_robust};
use super::rounds::Rounds;
use super::stories::{SCHEMA, Stories, Story};

/// Greatest number of stories.
const MOST_STORIES: usize = 12;

/// Number of kinds, the nearest first, that are tested by neighbours and on a finer resolution.
const TESTED: usize = 6;

/// The kinds of the draws that are like the observation.
fn like_draws(rounds: &Rounds<'_>) -> Vec<Kind> {
    let like = rounds.prior_sample.iter().filter(|(_, trial)| trial.distance <= LIKE);
    like.map(|(point, trial)| Kind::of(rounds.question, point, trial)).collect()
}

/// The stories of a search, with the neighbours of those that are like the observation; stored in its folder.
/// Errors: a folder that cannot be read or written.
pub(super) fn stories(
    question: &Question,
    folder: &Folder,
    effort: &Effort,
    control: &Control,
    rounds: &Rounds<'_>,
) -> Result<Stories, Error> {
    let mut found = so_far(rounds);
    let draws = like_draws(rounds);
    let like = found.stories.iter().filter(|story| story.is_like()).count();
    let tried = if effort.neighbours == 0 { 0 } else { like.min(TESTED) };
    control.begin(Count::of(tried * robust::most_runs(effort)), Count::default());
    for (place, (kind, _)) in nearest(rounds).into_iter().take(tried).enumerate() {
        let like = rounds.elites.like(kind);
        let Some(tried) = most_robust(question, folder, effort, control, &like)? else { break };
        found.stories[place] = story(rounds, kind, tried.elite, &draws, Some(&tried));
    }
    let file = folder.path.join("stories.json");
    save::atomically(&file, (json::indented(&found) + "\n").as_bytes())
        .map_err(Error::on(&file, "cannot be written"))?;
    Ok(found)
}

/// The nearest of every kind of story, the nearest first.
fn nearest<'a>(rounds: &'a Rounds<'_>) -> Vec<(&'a Kind, &'a Elite)> {
    let all = rounds.elites.best.iter();
    let mut elites: Vec<(&Kind, &Elite)> =
        all.filter(|(_, elite)| elite.trial.is_story()).collect();
    elites.sort_by(|one, other| one.1.trial.distance.total_cmp(&other.1.trial.distance));
    elites
}

/// The stories of the rounds so far, without their neighbours.
pub(super) fn so_far(rounds: &Rounds<'_>) -> Stories {
    let question = rounds.question;
    let draws = like_draws(rounds);
    let nearest = nearest(rounds).into_iter().take(MOST_STORIES);
    let stories = nearest.map(|(kind, elite)| story(rounds, kind, elite, &draws, None)).collect();
    let net = &rounds.prior_sample;
    let simulated: f64 = net.iter().map(|(_, trial)| trial.simulated_s).sum();
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 trials")]
    Stories {
        schema: SCHEMA,
        observation: question.observation.id.clone(),
        encounters: question.opened.study.id.clone(),
        stories,
        free_kinds: rounds.elites.best.values().filter(|elite| !elite.trial.is_story()).count(),
        trials: rounds.trials,
        mean_simulated_s: simulated / net.len().max(1) as f64,
        net: net.len(),
        net_like: draws.len(),
        posterior: quantities(rounds),
    }
}

fn story(
    rounds: &Rounds<'_>,
    kind: &Kind,
    elite: &Elite,
    draws: &[Kind],
    tried: Option<&Tried<'_>>,
) -> Story {
    let question = rounds.question;
    let Trial { distance, mut terms, mirrored, ending, simulated_s, state_hash, .. } =
        elite.trial.clone();
    terms.sort_by(|(one, _), (other, _)| other.total_cmp(one));
    let drawn = Encounter::at_point(&question.opened.study, &elite.point).drawn;
    Story {
        first_part: kind.first_part.clone(),
        acts: kind.acts.clone(),
        course: kind.quarter.map_or("", course),
        distance,
        terms,
        mirrored,
        ending,
        alike: tried.map(|tried| tried.alike),
        finer: tried.map(|tried| tried.finer),
        draws_like: draws.iter().filter(|other| *other == kind).count(),
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

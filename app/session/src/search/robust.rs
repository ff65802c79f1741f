//! The most robust story of a kind: of its runs that are like the observation, the one with the most neighbours like it.
//!
//! The nearest run is often at the boundary of the encounters that end alike. A few neighbours of several runs far apart show which run is
//! inside; of that one, all neighbours are run, and the encounter on a finer resolution. A neighbour has each quantity varied within its
//! observation error, and rope of any friction that the prior allows.

use endline_gear::units::Quantity;
use endline_gear::{Law, Prior};

use crate::campaign::Control;
use crate::encounters::Encounter;
use crate::encounters::draw::{self, Drawn};
use crate::error::Error;

use super::Effort;
use super::batch::{self, Part};
use super::distance::LIKE;
use super::elites::{Elite, Trial};
use super::ending::RunEnding;
use super::folder::Folder;
use super::question::Question;
use super::stories::FinerRun;

/// Runs of a kind that are compared.
const CANDIDATES: usize = 4;

/// Neighbours by which they are compared.
const FIRST: u32 = 4;

/// A run with the results of its neighbours.
pub(super) struct Tried<'a> {
    /// The run.
    pub(super) elite: &'a Elite,
    /// Share of its neighbours that are like the observation.
    pub(super) alike: f64,
    /// The encounter on a finer resolution.
    pub(super) finer: FinerRun,
}

/// Greatest number of runs for one kind.
pub(super) fn most_runs(effort: &Effort) -> usize {
    let first = effort.neighbours.min(FIRST as usize);
    CANDIDATES * first + (effort.neighbours - first) + 1
}

/// The most robust of the runs of a kind that are like the observation, in order of distance; `None` if there is none or the search
/// was cancelled.
/// Errors: a folder that cannot be read or written.
pub(super) fn most_robust<'a>(
    question: &Question,
    folder: &Folder,
    effort: &Effort,
    control: &Control,
    like: &[&'a Elite],
) -> Result<Option<Tried<'a>>, Error> {
    let asked = u32::try_from(effort.neighbours).unwrap_or(u32::MAX);
    let own = Runs { question, folder, effort, control };
    let mut best: Option<(f64, &Elite)> = None;
    for elite in far_apart(like) {
        let Some(alike) = own.share_alike(elite, FIRST.min(asked))? else { return Ok(None) };
        if best.is_none_or(|(most, _)| alike > most) {
            best = Some((alike, elite));
        }
    }
    let Some((_, elite)) = best else { return Ok(None) };
    let (alike, finer) = (own.share_alike(elite, asked)?, own.finer(elite)?);
    Ok(alike.zip(finer).map(|(alike, finer)| Tried { elite, alike, finer }))
}

/// Some of the runs: the first, then repeatedly the one farthest from those chosen.
fn far_apart<'a>(like: &[&'a Elite]) -> Vec<&'a Elite> {
    let mut chosen: Vec<&Elite> = like.first().copied().into_iter().collect();
    while chosen.len() < CANDIDATES.min(like.len()) {
        let away = |elite: &Elite| {
            let from = chosen.iter().map(|other| distance(&elite.point, &other.point));
            from.fold(f64::INFINITY, f64::min)
        };
        let far = like.iter().max_by(|one, other| away(one).total_cmp(&away(other)));
        chosen.extend(far);
    }
    chosen
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// The search whose neighbours are run.
struct Runs<'a> {
    question: &'a Question,
    folder: &'a Folder,
    effort: &'a Effort,
    control: &'a Control,
}

impl Runs<'_> {
    /// Share of a run's first neighbours that are like the observation; stored runs are read.
    fn share_alike(&self, elite: &Elite, count: u32) -> Result<Option<f64>, Error> {
        let question = self.question;
        let one =
            |number| RunEnding::of(&question.opened, &neighbour(question, &elite.point, number));
        let name = format!("neighbours-{}", name(&elite.point));
        let Some(trials) = self.trials(&name, count, one)? else { return Ok(None) };
        let like = trials.iter().filter(|trial| trial.distance <= LIKE).count();
        #[expect(clippy::cast_precision_loss, reason = "a few")]
        let share = like as f64 / f64::from(count);
        Ok(Some(share))
    }

    /// A run's encounter on a finer resolution.
    fn finer(&self, elite: &Elite) -> Result<Option<FinerRun>, Error> {
        let opened = &self.question.opened;
        let one = |_| RunEnding::finer(opened, &Encounter::at_point(&opened.study, &elite.point));
        let trials = self.trials(&format!("finer-{}", name(&elite.point)), 1, one)?;
        let finer = |trial: &Trial| {
            if trial.is_valid { FinerRun::Distance(trial.distance) } else { FinerRun::Invalid }
        };
        Ok(trials.and_then(|trials| trials.first().map(finer)))
    }

    fn trials(
        &self,
        name: &str,
        count: u32,
        one: impl Fn(u32) -> RunEnding + Sync,
    ) -> Result<Option<Vec<Trial>>, Error> {
        let Self { question, folder, effort, control } = self;
        let part = Part { store: &folder.rounds, name, numbers: 0..count };
        let mut ended = None;
        batch::run(&[part], effort, control, |_, number| one(number), |_, all| ended = Some(all))?;
        let trial = |ended: &RunEnding| Trial::of(&question.observation, ended);
        Ok(ended.map(|ended: Vec<RunEnding>| ended.iter().map(trial).collect()))
    }
}

/// Name of a point.
fn name(point: &[f64]) -> String {
    let mut hasher = blake3::Hasher::new();
    for share in point {
        hasher.update(&share.to_le_bytes());
    }
    hasher.finalize().to_hex()[..16].to_owned()
}

/// Prior of the scale of friction.
const FRICTION: &str = "friction.attributes.coefficient_scale";

/// Neighbour `number` of the encounter at a point.
pub(super) fn neighbour(question: &Question, point: &[f64], number: u32) -> Encounter {
    let priors = &question.opened.study.priors;
    let seed = question.seed ^ 0x9e37_79b9_7f4a_7c15;
    let shares = draw::sobol_point(seed, number, priors.len());
    let mut encounter = Encounter::at_point(&question.opened.study, point);
    for ((prior, drawn), share) in priors.iter().zip(&mut encounter.drawn).zip(shares) {
        *drawn = varied(prior, drawn, share);
    }
    encounter
}

/// A drawn value varied within its observation error; any level of friction's scale, if it is drawn by levels.
fn varied(prior: &Prior, drawn: &Drawn, share: f64) -> Drawn {
    let is_friction = prior.name.value == FRICTION;
    let (ends, quantity) = match &prior.law {
        Law::Choice(_) if is_friction => return draw::at_share(prior, share),
        Law::Choice(_) => return drawn.clone(),
        Law::Uniform { low, high, quantity } | Law::Normal { low, high, quantity, .. } => {
            ([*low, *high], *quantity)
        }
        Law::Bins { edges, quantity, .. } => ([edges[0], edges[edges.len() - 1]], *quantity),
    };
    let Some(value) = drawn.number else { return drawn.clone() };
    let way = 2.0 * share - 1.0;
    let moved = if is_friction {
        value * libm::exp2(way)
    } else {
        value + way * observation_error(quantity, value)
    };
    draw::number(prior.name.value.clone(), moved.clamp(ends[0], ends[1]), quantity)
}

/// Observation error of a quantity: 2 cm, 0.1 s, a degree, 2 cm/s; a twentieth of any other.
fn observation_error(quantity: Quantity, value: f64) -> f64 {
    match quantity {
        Quantity::Length => 0.02,
        Quantity::Time => 0.1,
        Quantity::Angle => 1.0_f64.to_radians(),
        Quantity::Speed => 0.02,
        _ => 0.05 * value.abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn candidates_are_the_nearest_and_then_far_apart() {
        let elite = |share: f64| Elite {
            point: vec![share],
            trial: Trial::of(&crate::search::tests::observation(), &RunEnding::default()),
            begun: 0,
        };
        let all = [0.5, 0.52, 0.9, 0.0, 0.48, 0.7, 0.1].map(elite);
        let like: Vec<&Elite> = all.iter().collect();
        let chosen: Vec<f64> = far_apart(&like).iter().map(|elite| elite.point[0]).collect();
        assert_eq!(chosen, [0.5, 0.0, 0.9, 0.7]);
        assert_eq!(far_apart(&like[..2]).len(), 2);
        assert!(far_apart(&[]).is_empty());
    }
}

//! The stories of a search as JSON, and what is said of them in words.

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use super::distance::LIKE;
use super::elites::INVALID;
use super::ending::Ending;
use super::posterior::Quantity;
use crate::study::stats::Rate;

/// Name and version of the JSON form.
pub(super) const SCHEMA: &str = "endline.stories/1";

/// A story is fragile if fewer than this share of its neighbours end alike.
pub const FRAGILE: f64 = 0.5;

/// The results of a search.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Stories {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// Id of the observation.
    pub observation: String,
    /// Id of the study whose encounters were searched.
    pub encounters: String,
    /// A run of every kind, in order of the least distance: the most robust of those like the observation, else the nearest.
    pub stories: Vec<Story>,
    /// Number of kinds whose nearest run ends with nothing on the whale; they are not listed.
    pub free_kinds: usize,
    /// Trials run, neighbours not counted.
    pub trials: usize,
    /// Mean simulated time of the draws [s].
    pub mean_simulated_s: f64,
    /// Number of draws from the priors.
    pub net: usize,
    /// Draws that are like the observation. All draws have equal weight, so that this is the effective number.
    pub net_like: usize,
    /// Every quantity among the draws like the observation, beside all draws; empty if too few are like it.
    pub posterior: Vec<Quantity>,
}

/// A story: an encounter, and how it ended.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Story {
    /// The part that rope touched first.
    pub first_part: String,
    /// Acts of the whale before and after the touch.
    pub acts: Vec<String>,
    /// Its direction relative to the current; empty if no heading is drawn.
    pub course: &'static str,
    /// Distance of its ending from the observation.
    pub distance: f64,
    /// The terms of the distance, the greatest first, each with its reason.
    pub terms: Vec<(f64, String)>,
    /// Whether the mirror image of its ending is nearer to the observation.
    pub mirrored: bool,
    /// Where rope is on the whale at its end.
    #[serde(skip)]
    #[schemars(skip)]
    pub ending: Ending,
    /// Share of its neighbours that end alike; `None` if none was run.
    pub alike: Option<f64>,
    /// Distance of the same encounter on a finer resolution, 1000 for an invalid run; `None` if it was not run.
    #[schemars(with = "Option<f64>")]
    pub finer: Option<FinerRun>,
    /// Draws from the priors that are of this kind and like the observation.
    pub draws_like: usize,
    /// Simulated time of its run [s].
    pub simulated_s: f64,
    /// Drawn values, by name.
    pub drawn: Vec<(String, String)>,
    /// Hash of the last state.
    pub state_hash: String,
    /// Where in the unit cube of encounters.
    pub point: Vec<f64>,
}

/// An encounter on a finer resolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FinerRun {
    /// Its run is not valid.
    Invalid,
    /// Distance of its ending from the observation.
    Distance(f64),
}

impl Serialize for FinerRun {
    /// As a number, 1000 for an invalid run.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(match self {
            Self::Invalid => INVALID,
            Self::Distance(distance) => *distance,
        })
    }
}

impl Story {
    /// The acts of the whale, in words.
    pub fn acts_in_words(&self) -> String {
        if self.acts.is_empty() { "swims on".to_owned() } else { self.acts.join(", then ") }
    }

    /// Whether it is like the observation.
    pub fn is_like(&self) -> bool {
        self.distance <= LIKE
    }

    /// Share of the draws like the observation that are of this kind; `None` if no draw is like it.
    pub fn share(&self, stories: &Stories) -> Option<f64> {
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 draws")]
        let share = || self.draws_like as f64 / stories.net_like as f64;
        (stories.net_like > 0).then(share)
    }

    /// Its robustness, in words: neighbours, finer resolution, share of draws; `None` if nothing is known.
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
        let known: Vec<String> = [alike, finer, share].into_iter().flatten().collect();
        (!known.is_empty()).then(|| known.join("; "))
    }

    /// Its distance on a finer resolution, in words; `None` if it was not run.
    pub fn on_finer(&self) -> Option<String> {
        self.finer.map(|finer| match finer {
            FinerRun::Invalid => "no valid end".to_owned(),
            FinerRun::Distance(distance @ ..=LIKE) => format!("alike ({distance:.2})"),
            FinerRun::Distance(distance) => format!("not alike ({distance:.2})"),
        })
    }

    /// Whether fewer than half of its neighbours end alike.
    pub fn is_fragile(&self) -> bool {
        self.alike.is_some_and(|alike| alike < FRAGILE)
    }
}

impl Stories {
    /// The result, in a sentence.
    pub fn answer(&self) -> String {
        let like = self.stories.iter().filter(|story| story.is_like()).count();
        let fragile =
            self.stories.iter().filter(|story| story.is_like() && story.is_fragile()).count();
        let free = self.free_in_words().map_or(String::new(), |free| format!(" {free}"));
        let found = match like {
            0 => format!("Not found in {} runs: no story ends like what was seen.", self.trials),
            1 if fragile == 1 => "One kind of story ends like this, and is fragile.".to_owned(),
            1 => "One kind of story ends like this.".to_owned(),
            _ => format!("{like} kinds of story end like this; {fragile} of them are fragile."),
        };
        found + &free
    }

    /// The share of draws from the priors that end like the observation, with its uncertainty: Wilson's interval, or for none in `n` draws the
    /// share `1 - 0.05^(1/n)` with which that has a probability of 5 %.
    pub fn share_of_draws(&self) -> String {
        let [like, all] = [self.net_like, self.net].map(|count| count as u64);
        if all == 0 {
            return "no draws were made".to_owned();
        }
        if like == 0 {
            #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 draws")]
            let most = 1.0 - libm::pow(0.05, 1.0 / all as f64);
            return format!(
                "0 of {all}; with 95 % confidence, fewer than {:.1} % of all draws",
                100.0 * most
            );
        }
        let Rate { rate, interval, .. } = Rate::from_counts(like, all);
        format!(
            "{like} of {all}, {:.1} % [{:.1}, {:.1}]",
            100.0 * rate,
            100.0 * interval.low,
            100.0 * interval.high
        )
    }

    /// The kinds that are not listed, in a sentence; `None` without any.
    pub fn free_in_words(&self) -> Option<String> {
        match self.free_kinds {
            0 => None,
            1 => {
                Some("One more kind ends with nothing on the whale, and is not listed.".to_owned())
            }
            count => Some(format!(
                "{count} more kinds end with nothing on the whale, and are not listed."
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `endline.stories/1` has a number for every run.
    #[test]
    fn an_invalid_finer_run_is_1000_in_json() {
        let runs = [Some(FinerRun::Invalid), Some(FinerRun::Distance(0.5)), None];
        assert_eq!(serde_json::to_string(&runs).unwrap(), "[1000.0,0.5,null]");
    }

    /// No draw of 64: `1 - 0.05^(1/64)` is 4.6 %, near the rule of three, 3/64. Wilson's interval of 3 in 64 is 1.6 to 12.9 %.
    #[test]
    fn the_share_of_draws_has_an_upper_limit() {
        let stories = |net_like| Stories {
            schema: SCHEMA,
            observation: String::new(),
            encounters: String::new(),
            stories: Vec::new(),
            free_kinds: 0,
            trials: 64,
            mean_simulated_s: 0.0,
            net: 64,
            net_like,
            posterior: Vec::new(),
        };
        assert_eq!(
            stories(0).share_of_draws(),
            "0 of 64; with 95 % confidence, fewer than 4.6 % of all draws"
        );
        assert_eq!(stories(3).share_of_draws(), "3 of 64, 4.7 % [1.6, 12.9]");
    }
}

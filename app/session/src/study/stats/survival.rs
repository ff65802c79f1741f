//! Duration for which rope holds a whale that it has touched: Kaplan and Meier's estimate with intervals.
//!
//! `S(t) = Π (1 - d_i / n_i)` over the release times `t_i ≤ t`, with `d_i` whales released then and `n_i` still held and
//! followed just before. A whale that is held when its run ends is followed up to there and counts as held no longer
//! than that, neither as released. With Greenwood's variance `v = Σ d_i / (n_i (n_i - d_i))` the interval is
//! `S^exp(± z √v / ln S)`, even on the scale of `ln(-ln S)`, so that it stays between 0 and 1.
//! Whales of unlike weight count by it, scaled so that all together count as Kish's effective number of them (`weighted.rs`).
//! References: Kaplan and Meier 1958 (doi:10.1080/01621459.1958.10501452); Kalbfleisch and Prentice 2002, section 1.4.

use schemars::JsonSchema;
use serde::Serialize;

use crate::study::runs::{RunRow, Runs};

use super::interval::{Interval, Rate, z95};
use super::weighted::kish;

/// Outcomes of released whales.
const RELEASED: [&str; 2] = ["shed", "parted_free"];

/// Shares still held, by time since first contact.
#[derive(Clone, Debug, Default, JsonSchema, PartialEq, Serialize)]
pub struct Survival {
    /// Whales that rope touched.
    pub touched: u64,
    /// Touched whales that were released while they were followed.
    pub released: u64,
    /// A step for each release time, by time.
    pub steps: Vec<HeldShare>,
    /// Longest time that a whale was followed from its first contact [s].
    pub followed_s: f64,
}

/// Share of whales that rope still holds from a time on.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Serialize)]
pub struct HeldShare {
    /// Time since first contact [s].
    pub time_s: f64,
    /// The share.
    pub share: f64,
    /// Its interval.
    pub interval: Interval,
}

/// Duration for which a whale was followed, and whether it was then released.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Followed {
    /// From first contact to release, or to the end of the run [s].
    pub time_s: f64,
    /// Whether it was released.
    pub released: bool,
    /// Weight of its encounter.
    pub weight: f64,
}

impl Survival {
    /// Of an option's runs that count and are followed to the end.
    pub fn of(runs: &Runs, option: &str) -> Self {
        let followed = |run: &RunRow| {
            let released = RELEASED.contains(&run.outcome.as_str());
            let until = if released { run.last_contact_s } else { run.simulated_s };
            let time_s = (until? - run.first_contact_s?).max(0.0);
            Some(Followed { time_s, released, weight: run.weight })
        };
        Self::from_followed(
            runs.valid_of(option).filter(|run| !run.until_parted).filter_map(followed).collect(),
        )
    }

    /// Of whales that were followed.
    pub(super) fn from_followed(mut followed: Vec<Followed>) -> Self {
        followed.sort_by(|one, other| one.time_s.total_cmp(&other.time_s));
        let (mut share, mut variance, mut steps) = (1.0, 0.0, Vec::new());
        let same = |one: &Followed, other: &Followed| one.time_s.total_cmp(&other.time_s).is_eq();
        let effective = kish(followed.iter().map(|whale| whale.weight));
        let all: f64 = followed.iter().map(|whale| whale.weight).sum();
        let count = |whales: &[Followed], counts: fn(&Followed) -> bool| {
            let own = whales.iter().filter(|whale| counts(whale));
            own.map(|whale| whale.weight).sum::<f64>() * effective / all
        };
        let mut left = count(&followed, |_| true);
        for tied in followed.chunk_by(same) {
            let gone = count(tied, |whale| whale.released);
            if gone > 0.0 {
                // The last whale leaves none, but for rounding.
                let stays = if gone > (1.0 - 1e-9) * left { 0.0 } else { left - gone };
                share *= stays / left;
                variance += gone / (left * stays);
                steps.push(HeldShare {
                    time_s: tied[0].time_s,
                    share,
                    interval: interval(share, variance, effective),
                });
            }
            left -= count(tied, |_| true);
        }
        Self {
            touched: followed.len() as u64,
            released: followed.iter().filter(|whale| whale.released).count() as u64,
            steps,
            followed_s: followed.last().map_or(0.0, |whale| whale.time_s),
        }
    }

    /// The share still held at a time since first contact; `None` beyond the time that any whale was followed.
    pub fn at(&self, time_s: f64) -> Option<HeldShare> {
        if self.touched == 0 || time_s > self.followed_s {
            return None;
        }
        let last = self.steps.iter().rev().find(|step| step.time_s <= time_s);
        let whole = Rate::from_counts(self.touched, self.touched);
        let none_yet = HeldShare { time_s, share: 1.0, interval: whole.interval };
        Some(last.map_or(none_yet, |step| HeldShare { time_s, ..*step }))
    }

    /// Time at which half of the whales are free; `None` where more are held as long as they were followed [s].
    pub fn median_s(&self) -> Option<f64> {
        self.steps.iter().find(|step| step.share <= 0.5).map(|step| step.time_s)
    }
}

/// The interval of a share; Wilson's where the last whale followed has come free.
fn interval(share: f64, variance: f64, touched: f64) -> Interval {
    if share <= 0.0 {
        return Rate::from_counts(0, touched.round() as u64).interval;
    }
    let spread = z95() * variance.sqrt() / share.ln();
    let ends = [spread, -spread].map(|spread| share.powf(spread.exp()));
    Interval { low: ends[0].min(ends[1]), high: ends[0].max(ends[1]) }
}

#[cfg(test)]
mod tests {
    use super::super::bootstrap::Draws;
    use super::*;

    fn followed(released: &[f64], held: &[f64]) -> Vec<Followed> {
        let of = |released: bool| {
            move |time_s: &f64| Followed { time_s: *time_s, released, weight: 1.0 }
        };
        released.iter().map(of(true)).chain(held.iter().map(of(false))).collect()
    }

    /// Remission of 21 patients under 6-mercaptopurine, weeks (Freireich 1963), as every textbook has it.
    #[test]
    fn a_published_curve_comes_out() {
        let found = Survival::from_followed(followed(
            &[6.0, 6.0, 6.0, 7.0, 10.0, 13.0, 16.0, 22.0, 23.0],
            &[6.0, 9.0, 10.0, 11.0, 17.0, 19.0, 20.0, 25.0, 32.0, 32.0, 34.0, 35.0],
        ));
        for (weeks, share) in
            [(6.0, 0.857), (7.0, 0.807), (10.0, 0.753), (13.0, 0.690), (16.0, 0.627), (23.0, 0.448)]
        {
            let at = found.at(weeks).unwrap();
            assert!((at.share - share).abs() < 5e-4, "{weeks}: {}", at.share);
        }
        // Kalbfleisch and Prentice's interval at 10 weeks: 0.503 to 0.889.
        let Interval { low, high } = found.at(10.0).unwrap().interval;
        assert!((low - 0.503).abs() < 1e-3 && (high - 0.889).abs() < 1e-3, "{low} {high}");
        assert_eq!(found.median_s(), Some(23.0));
        assert_eq!((found.touched, found.released), (21, 9));
        assert_eq!(found.at(36.0), None);
    }

    #[test]
    fn without_releases_all_are_held_and_without_ends_the_share_is_that_of_a_count() {
        let held = Survival::from_followed(followed(&[], &[30.0; 20]));
        let at = held.at(20.0).unwrap();
        assert!((at.share - 1.0).abs() < 1e-15 && at.interval.low < 0.9);
        let all = Survival::from_followed(followed(&[1.0, 2.0, 3.0, 4.0], &[]));
        assert!((all.at(2.5).unwrap().share - 0.5).abs() < 1e-15);
        assert!(all.at(4.0).unwrap().share.abs() < 1e-15);
        assert_eq!(Survival::from_followed(Vec::new()).at(0.0), None);
    }

    /// Releases at a constant rate, runs that end at random: the interval holds `exp(-λ t)`.
    #[test]
    fn intervals_cover_an_exponential_law() {
        let mut draws = Draws::of("survival");
        let mut uniform = || (draws.below(1 << 30) as f64 + 0.5) / f64::from(1 << 30);
        let (rate, studies) = (1.0 / 60.0, 2000);
        let held = (0..studies).filter(|_| {
            let whale = |_| {
                let (release, end) = (-uniform().ln() / rate, 200.0 * uniform());
                Followed { time_s: f64::min(release, end), released: release < end, weight: 1.0 }
            };
            let found = Survival::from_followed((0..100).map(whale).collect());
            let Interval { low, high } = found.at(60.0).unwrap().interval;
            (low..=high).contains(&(-1.0_f64).exp())
        });
        let share = held.count() as f64 / f64::from(studies);
        assert!((0.93..=0.97).contains(&share), "{share}");
    }
}

//! Draws of an encounter: point `i` of a scrambled Sobol sequence, one dimension for each prior.
//!
//! A point depends on the seed, the priors' names and `i` alone: any encounter can be drawn without those before it, by
//! any machine, and every option of a study meets the same ones.
//! Reference: Burley 2020, Practical hash-based Owen scrambling (JCGT 9(4)).

use endline_gear::{Law, Level, Prior, Setting, units};
use statrs::distribution::{ContinuousCDF, Normal};

/// A drawn value.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Name of the prior.
    pub name: String,
    /// As it stands in a file: a number in SI with its unit, or a word.
    pub text: String,
    /// Its number [SI]; none for a word.
    pub number: Option<f64>,
    /// Whether it stands in a file without quotes.
    pub plain: bool,
}

impl Drawn {
    /// The value as a file holds it.
    #[must_use]
    pub fn setting(&self) -> Setting {
        if self.plain { Setting::plain(&self.text) } else { Setting::text(&self.text) }
    }
}

/// Every prior's value in encounter `index`, in the order of the priors (by name).
#[must_use]
pub fn draw(priors: &[Prior], seed: u64, index: u32) -> Vec<Drawn> {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "both halves of the seed are folded into the sequence's 32 bits"
    )]
    let seed = (seed ^ (seed >> 32)) as u32;
    let mut dimension = 0;
    let mut drawn = Vec::with_capacity(priors.len());
    for prior in priors {
        let fixed = matches!(&prior.law, Law::Choice(levels) if levels.len() == 1);
        // The middle of the point's cell: never 0, never 1.
        let share = if fixed {
            0.5
        } else {
            f64::from(sobol_burley::sample(index, dimension, seed)) + f64::from(f32::EPSILON) / 4.0
        };
        dimension += u32::from(!fixed);
        drawn.push(value(prior, share));
    }
    drawn
}

/// The value below which a share of the distribution lies.
fn value(prior: &Prior, share: f64) -> Drawn {
    let name = prior.name.value.clone();
    match &prior.law {
        Law::Uniform { low, high, quantity } => number(name, low + (high - low) * share, *quantity),
        Law::Normal { mean, deviation, low, high, quantity } => {
            number(name, cut_normal(*mean, *deviation, [*low, *high], share), *quantity)
        }
        Law::Bins { edges, shares, quantity } => {
            number(name, binned(edges, shares, share), *quantity)
        }
        Law::Choice(levels) => {
            let Level { text, number, plain } = chosen(levels, share).clone();
            Drawn { name, text, number, plain }
        }
    }
}

fn number(name: String, value: f64, quantity: units::Quantity) -> Drawn {
    let plain = quantity == units::Quantity::Ratio;
    let text = if plain { format!("{value:?}") } else { format!("{value} {}", quantity.si_unit()) };
    Drawn { name, text, number: Some(value), plain }
}

/// The value below which a share lies, where each range between two edges has a share of its own.
fn binned(edges: &[f64], shares: &[f64], share: f64) -> f64 {
    let mut below = 0.0;
    for (ends, own) in edges.windows(2).zip(shares) {
        if share < below + own {
            return ends[0] + (ends[1] - ends[0]) * (share - below) / own;
        }
        below += own;
    }
    // The shares add up to 1 but for rounding, and there are at least two edges.
    edges[edges.len() - 1]
}

/// Inverse of the distribution function of a normal law cut off at two ends.
fn cut_normal(mean: f64, deviation: f64, [low, high]: [f64; 2], share: f64) -> f64 {
    let Ok(normal) = Normal::new(mean, deviation) else { return mean };
    let (below, above) = (normal.cdf(low), normal.cdf(high));
    normal.inverse_cdf(below + (above - below) * share).clamp(low, high)
}

/// The level within whose part of the weights the share lies.
fn chosen(levels: &[(Level, f64)], share: f64) -> &Level {
    let mut sum = 0.0;
    for (level, weight) in levels {
        sum += weight;
        if share < sum {
            return level;
        }
    }
    // The weights add up to 1 but for rounding, and a choice has at least one level.
    &levels[levels.len() - 1].0
}

#[cfg(test)]
mod tests {
    use endline_gear::Study;

    use super::*;

    const STUDY: &str = r#"
format = 1
kind = "study"
name = "Draws"
scenario = "hello-endline"
encounters = 4096
baseline = "a"
[[option]]
id = "a"
[encounter.speed]
uniform = ["0.5 m/s", "1.5 m/s"]
source = "assumed"
[encounter.length]
normal = ["12 m", "1.5 m"]
between = ["9 m", "15 m"]
source = "assumed"
[encounter.behaviour]
choice = ["swim", "skim-feed"]
weights = [0.7, 0.3]
source = "assumed"
[encounter.depth]
bins = ["2 m", "10 m", "20 m"]
weights = [0.72, 0.28]
source = "assumed"
[encounter.heading]
value = "90 deg"
source = "assumed"
"#;

    fn priors() -> Vec<Prior> {
        Study::read("draws.toml", STUDY).unwrap_or_else(|problems| panic!("{problems:?}")).priors
    }

    fn numbers(name: &str, count: u32) -> Vec<f64> {
        let priors = priors();
        let one = |index| {
            draw(&priors, 7, index)
                .into_iter()
                .find(|drawn| drawn.name == name)
                .and_then(|drawn| drawn.number)
                .unwrap()
        };
        (0..count).map(one).collect()
    }

    #[test]
    fn draws_follow_their_laws() {
        let speeds = numbers("speed", 4096);
        let mean = speeds.iter().sum::<f64>() / 4096.0;
        assert!((mean - 1.0).abs() < 1e-3, "a Sobol sequence fills evenly: {mean}");
        assert!(speeds.iter().all(|speed| (0.5..1.5).contains(speed)));
        // Cut at two deviations, the deviation of a normal law is 0.8796 of its own.
        let lengths = numbers("length", 4096);
        let mean = lengths.iter().sum::<f64>() / 4096.0;
        let variance = lengths.iter().map(|length| (length - mean).powi(2)).sum::<f64>() / 4096.0;
        assert!(
            (mean - 12.0).abs() < 2e-3 && (variance.sqrt() - 1.5 * 0.8796).abs() < 2e-3,
            "{mean} {}",
            variance.sqrt()
        );
        let depths = numbers("depth", 4096);
        let share = |low: f64, high: f64| {
            depths.iter().filter(|depth| (low..high).contains(depth)).count() as f64 / 4096.0
        };
        for (low, high, expected) in [(2.0, 6.0, 0.36), (6.0, 10.0, 0.36), (10.0, 20.0, 0.28)] {
            assert!((share(low, high) - expected).abs() < 2e-3, "{low}: {}", share(low, high));
        }
        let swims = (0..4096)
            .filter(|index| draw(&priors(), 7, *index).iter().any(|drawn| drawn.text == "swim"))
            .count();
        assert!((swims as f64 / 4096.0 - 0.7).abs() < 2e-3, "{swims}");
    }

    #[test]
    fn a_draw_hangs_on_index_and_seed_alone() {
        let priors = priors();
        assert_eq!(draw(&priors, 7, 123), draw(&priors, 7, 123));
        assert_ne!(draw(&priors, 7, 123), draw(&priors, 8, 123));
        assert_ne!(draw(&priors, 7, 123), draw(&priors, 7, 124));
    }

    #[test]
    fn the_order_of_the_file_changes_nothing() {
        let (head, tables) = STUDY.split_at(STUDY.find("[encounter.speed]").unwrap());
        let (speed, rest) = tables.split_at(tables.find("[encounter.length]").unwrap());
        let turned = format!("{head}{rest}{speed}");
        let [one, other] =
            [STUDY, turned.as_str()].map(|text| Study::read("draws.toml", text).unwrap());
        assert_eq!(one.canonical, other.canonical);
        assert_eq!(draw(&one.priors, 1, 5), draw(&other.priors, 1, 5));
    }
}

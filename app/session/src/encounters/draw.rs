//! Draws of an encounter: point `i` of a scrambled Sobol sequence, one dimension for each prior.
//!
//! A point depends on the seed, the priors' names and `i` alone: any encounter can be drawn without those before it, by
//! any machine, and every option of a study meets the same ones. Where there are proposals, of the file or fitted (`fitted.rs`), one more
//! dimension decides from which part of the mixture all values of an encounter come.
//! Reference: Burley 2020, Practical hash-based Owen scrambling (JCGT 9(4)).

use endline_gear::{Law, Level, Prior, Setting, Study, units};
use statrs::distribution::{ContinuousCDF, Normal};

use super::fitted::{Fitted, Mixture, Part};

/// A drawn value.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Name of the prior.
    pub name: String,
    /// Its text in a file: a number in SI with its unit, or a word.
    pub text: String,
    /// Its number [SI]; none for a word.
    pub number: Option<f64>,
    /// Whether its text has no quotes in a file.
    pub plain: bool,
}

impl Drawn {
    /// The value as a file holds it.
    pub fn setting(&self) -> Setting {
        if self.plain { Setting::plain(&self.text) } else { Setting::text(&self.text) }
    }
}

/// The values drawn for an encounter.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Every prior's value, in the order of the priors (by name).
    pub values: Vec<Drawn>,
    /// Weight of the encounter: its density under the priors over that under which it was drawn. Weights have mean 1.
    pub weight: f64,
}

/// Draws encounter `index` of a study, from priors, proposals and what was fitted to earlier stages.
pub(crate) fn draw(study: &Study, index: u32, fitted: &Fitted) -> Draw {
    let mut point = Point::of(study.seed, index);
    draw_from(study, fitted, || point.share())
}

/// Draws an encounter from the coordinates of a point of the unit cube.
pub(crate) fn draw_from(
    study: &Study,
    fitted: &Fitted,
    mut coordinate: impl FnMut() -> f64,
) -> Draw {
    let priors = &study.priors;
    let shares: Vec<f64> =
        priors.iter().map(|prior| if is_fixed(prior) { 0.5 } else { coordinate() }).collect();
    let has_proposal = priors.iter().any(|prior| prior.proposal.is_some());
    let mixture = Mixture { from_priors: study.from_priors, has_proposal, fitted };
    // The last dimension decides between the parts of the mixture, so that a proposal changes no other draw.
    let part = if mixture.is_plain() { Part::Priors } else { mixture.part(coordinate()) };
    let law = |prior: &'_ Prior| match &prior.proposal {
        Some(proposal) if part == Part::Proposals => proposal.clone(),
        _ => prior.law.clone(),
    };
    let values: Vec<Drawn> = match part {
        Part::Fitted(component) => fitted.draw(study, component, &shares),
        Part::Priors | Part::Proposals => priors
            .iter()
            .zip(shares)
            .map(|(prior, share)| value(&prior.name.value, &law(prior), share))
            .collect(),
    };
    let weight = mixture.weight(priors, &values);
    Draw { values, weight }
}

/// Priors that vary, by their place among all: the dimensions of the unit cube of encounters.
pub fn dimensions(study: &Study) -> Vec<usize> {
    (0..study.priors.len()).filter(|prior| !is_fixed(&study.priors[*prior])).collect()
}

/// Every prior's value at a point of the unit cube: below it lies the share `point[k]` of the law of dimension `k`.
pub fn at_point(study: &Study, point: &[f64]) -> Vec<Drawn> {
    let mut shares = point.iter().copied();
    let mut share = |prior: &Prior| {
        if is_fixed(prior) { 0.5 } else { shares.next().unwrap_or(0.5) }
    };
    study.priors.iter().map(|prior| at_share(prior, share(prior))).collect()
}

/// The value of a prior below which a share of its law lies.
pub fn at_share(prior: &Prior, share: f64) -> Drawn {
    value(&prior.name.value, &prior.law, share)
}

/// Point `index` of the scrambled Sobol sequence in the unit cube of encounters.
pub fn sobol_point(seed: u64, index: u32, dimensions: usize) -> Vec<f64> {
    let mut point = Point::of(seed, index);
    (0..dimensions).map(|_| point.share()).collect()
}

/// Whether a prior has one value.
pub(super) fn is_fixed(prior: &Prior) -> bool {
    matches!(&prior.law, Law::Choice(levels) if levels.len() == 1)
}

/// A point of the sequence, read dimension by dimension.
struct Point {
    index: u32,
    dimension: u32,
    seed: u32,
}

impl Point {
    fn of(seed: u64, index: u32) -> Self {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "both halves of the seed are folded into the sequence's 32 bits"
        )]
        let seed = (seed ^ (seed >> 32)) as u32;
        Self { index, dimension: 0, seed }
    }

    /// The middle of the point's cell: never 0, never 1.
    fn share(&mut self) -> f64 {
        let share = sobol_burley::sample(self.index, self.dimension, self.seed);
        self.dimension += 1;
        f64::from(share) + f64::from(f32::EPSILON) / 4.0
    }
}

/// The value below which a share of the distribution lies.
fn value(name: &str, law: &Law, share: f64) -> Drawn {
    let name = name.to_owned();
    match law {
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

/// A number [SI] as a drawn value.
pub fn number(name: String, value: f64, quantity: units::Quantity) -> Drawn {
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

/// A year of 365.25 days [s].
const YEAR_S: f64 = 31_557_600.0;

/// Least time that is given in years [s].
const LONG_S: f64 = 86_400.0;

/// A drawn value in common units: three figures, angles in degrees, long times in years. Words are unchanged.
pub fn in_words(text: &str) -> String {
    let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
    let Ok(value) = number.parse::<f64>() else { return text.to_owned() };
    let (value, unit) = match unit {
        "rad" => (value.to_degrees(), "deg"),
        "s" if value.abs() >= LONG_S => (value / YEAR_S, "yr"),
        _ => (value, unit),
    };
    let three_figures = format!("{value:.2e}").parse().unwrap_or(value);
    format!("{three_figures} {unit}").trim_end().to_owned()
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

    fn study() -> Study {
        Study::read("draws.toml", STUDY).unwrap_or_else(|problems| panic!("{problems:?}"))
    }

    fn numbers(name: &str, count: u32) -> Vec<f64> {
        let study = study();
        let one = |index| {
            draw(&study, index, &Fitted::default())
                .values
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
            .filter(|index| {
                draw(&study(), *index, &Fitted::default())
                    .values
                    .iter()
                    .any(|drawn| drawn.text == "swim")
            })
            .count();
        assert!((swims as f64 / 4096.0 - 0.7).abs() < 2e-3, "{swims}");
    }

    #[test]
    fn a_draw_depends_on_index_and_seed_alone() {
        let (study, mut other) = (study(), study());
        assert_eq!(draw(&study, 123, &Fitted::default()), draw(&study, 123, &Fitted::default()));
        other.seed += 1;
        assert_ne!(draw(&study, 123, &Fitted::default()), draw(&other, 123, &Fitted::default()));
        assert_ne!(draw(&study, 123, &Fitted::default()), draw(&study, 124, &Fitted::default()));
    }

    #[test]
    fn the_order_of_the_file_changes_nothing() {
        let (head, tables) = STUDY.split_at(STUDY.find("[encounter.speed]").unwrap());
        let (speed, rest) = tables.split_at(tables.find("[encounter.length]").unwrap());
        let turned = format!("{head}{rest}{speed}");
        let [one, other] =
            [STUDY, turned.as_str()].map(|text| Study::read("draws.toml", text).unwrap());
        assert_eq!(one.canonical, other.canonical);
        assert_eq!(draw(&one, 5, &Fitted::default()), draw(&other, 5, &Fitted::default()));
    }

    /// Means of a proposal's draws by their weights are those of the prior; a weight alone is at most four.
    #[test]
    fn weights_bring_a_proposal_back_to_its_prior() {
        let proposed = STUDY
            .replace(
                "weights = [0.72, 0.28]",
                "weights = [0.72, 0.28]\nproposal = { bins = [\"2 m\", \"3 m\", \"20 m\"], weights = [0.8, 0.2] }",
            )
            .replace(
                "weights = [0.7, 0.3]",
                "weights = [0.7, 0.3]\nproposal = { choice = [\"swim\", \"skim-feed\"], weights = [0.2, 0.8] }",
            )
            .replace(
                "between = [\"9 m\", \"15 m\"]",
                "between = [\"9 m\", \"15 m\"]\nproposal = { uniform = [\"9 m\", \"15 m\"] }",
            );
        let study = Study::read("draws.toml", &proposed).unwrap();
        let draws: Vec<Draw> =
            (0..16_384).map(|index| draw(&study, index, &Fitted::default())).collect();
        assert!(draws.iter().all(|draw| draw.weight > 0.0 && draw.weight <= 4.0));
        let mean = |of: &dyn Fn(&[Drawn]) -> f64| {
            let sum: f64 = draws.iter().map(|draw| draw.weight * of(&draw.values)).sum();
            sum / draws.len() as f64
        };
        let number = |values: &[Drawn], name: &str| {
            values.iter().find(|drawn| drawn.name == name).and_then(|drawn| drawn.number).unwrap()
        };
        let shallow = |values: &[Drawn]| f64::from(number(values, "depth") < 3.0);
        let skims =
            |values: &[Drawn]| f64::from(values.iter().any(|drawn| drawn.text == "skim-feed"));
        for (name, found, expected) in [
            ("one", mean(&|_| 1.0), 1.0),
            ("depth below 3 m", mean(&shallow), 0.09),
            ("skims", mean(&skims), 0.3),
            ("both", mean(&|values| shallow(values) * skims(values)), 0.027),
            ("length", mean(&|values| number(values, "length")), 12.0),
            ("speed", mean(&|values| number(values, "speed")), 1.0),
        ] {
            assert!((found - expected).abs() < 0.01 * expected, "{name}: {found} of {expected}");
        }
        let without = draws.iter().filter(|draw| shallow(&draw.values) > 0.5).count();
        assert!(without > 9000, "{without}: the proposal draws these far more often");
    }

    #[test]
    fn a_proposal_that_leaves_values_out_is_refused() {
        for proposal in [
            "{ uniform = [\"2 m\", \"10 m\"] }",
            "{ bins = [\"2 m\", \"3 m\", \"20 m\"], weights = [1, 0] }",
            "{ choice = [\"2 m\", \"20 m\"] }",
        ] {
            let text = STUDY.replace(
                "weights = [0.72, 0.28]",
                &format!("weights = [0.72, 0.28]\nproposal = {proposal}"),
            );
            let problems = Study::read("draws.toml", &text).unwrap_err();
            let is_named = problems.iter().any(|problem| problem.message.contains("proposal"));
            assert!(is_named, "{proposal}: {problems:?}");
        }
    }

    #[test]
    fn a_drawn_value_has_three_figures_and_common_units() {
        assert_eq!(in_words("-2.7802695834678914 rad"), "-159 deg");
        assert_eq!(in_words("568036800 s"), "18 yr");
        assert_eq!(in_words("12.5 s"), "12.5 s");
        assert_eq!(in_words("0.5119571566581724 m"), "0.512 m");
        assert_eq!(in_words("2"), "2");
        assert_eq!(in_words("roll-away"), "roll-away");
        assert_eq!(in_words("barrel roll"), "barrel roll");
    }
}

//! The threat by breaking strength of a study, in the columns of NOAA's present threat model (`RopeStrength, Threat, Threat_Lower,
//! Threat_Upper`), beside that model.
//!
//! The threat at a strength is the rate of the event given an encounter with rope of that strength, with its interval of 95 % by chance.
//! A study simulates some strengths, those of its options on one curve; between them, rates and intervals are linear (`interpolation.rs`).
//! No threat is given outside them.
//!
//! NOAA's threat is a relative selectivity: the tool compares sums of threats, so that a common factor has no effect. Two comparisons are
//! made. The first is of the values as they are. The second is of their shapes: each relative to its own value at the greatest simulated
//! strength that lies in NOAA's table.

use endline_gear::{Study, StudyEvent, StudyOption};
use schemars::JsonSchema;
use serde::Serialize;

use super::filled::{number, written};
use super::interpolation::{Strengths, combined};
use super::noaa::{LineStrengthTable, StrengthThreatTable, THREAT_COLUMNS, ThreatRange};
use super::trawls::{TrawlThreat, of_trawls, ratio_of};
use crate::study::prepared::PreparedStudy;
use crate::study::runs::Runs;
use crate::study::stats::{AssumedBand, EventIndicators, Interval, Rate, z95};
use crate::units::N_PER_LBF;

/// Name and version of the JSON form.
pub const STRENGTH_SCHEMA: &str = "endline.threat_by_strength/1";

/// The threat of an option with a strength.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct OptionThreat {
    /// Id of the option.
    pub option: String,
    /// Its strength [lbf].
    pub strength_lbf: f64,
    /// Rate of the event, with its interval of 95 % by chance.
    pub rate: Rate,
    /// Least and greatest rate at the levels of the assumed inputs, where these vary.
    pub priors: Option<AssumedBand>,
}

/// Origin of a threat at a strength.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Origin {
    /// An option has this strength.
    Simulated,
    /// Interpolated between the options of the next lesser and the next greater strength.
    Interpolated,
}

/// The threat at a strength of NOAA's table, simulated and NOAA's.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct StrengthThreat {
    /// Breaking strength [lbf].
    pub strength_lbf: f64,
    /// Origin of the simulated threat.
    pub origin: Origin,
    /// Simulated threat, with its interval of 95 % by chance.
    pub simulated: ThreatRange,
    /// Least and greatest simulated threat at the levels of the assumed inputs; the threat itself where none varies.
    pub priors: Interval,
    /// Valid runs of the option, or the lesser number of the two options between which it lies.
    pub runs: u64,
    /// NOAA's threat, with the least and the greatest of its three curves as bounds.
    pub noaa: ThreatRange,
    /// Whether the simulated interval and NOAA's bounds have a value in common.
    pub overlaps: bool,
    /// Both relative to their values at the reference strength; none where the simulated threat or NOAA's is 0 there.
    pub relative: Option<RelativeThreat>,
}

/// Threats relative to those at the reference strength.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct RelativeThreat {
    /// Simulated threat over that at the reference, with its interval of 95 % by chance.
    pub simulated: ThreatRange,
    /// NOAA's threat over that at the reference, with the bounds of its three curves, each relative to itself.
    pub noaa: ThreatRange,
    /// Whether the simulated interval and NOAA's bounds have a value in common.
    pub overlaps: bool,
}

/// The threat by breaking strength of a study, beside NOAA's.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct StrengthThreats {
    /// Name and version of this form.
    #[schemars(extend("const" = STRENGTH_SCHEMA))]
    pub schema: &'static str,
    /// Id of the study.
    pub study: String,
    /// Hash of what defines its runs.
    pub hash: String,
    /// Name of the event.
    pub event: String,
    /// Name of the curve; none for options that name no curve.
    pub curve: Option<String>,
    /// The simulated options, by strength.
    pub options: Vec<OptionThreat>,
    /// Rate with rope that cannot part, if the study has such an option: the limit for great strength.
    pub unbreakable: Option<Rate>,
    /// The strength to which relative threats refer: the greatest simulated one within NOAA's table [lbf].
    pub reference_lbf: f64,
    /// By the strengths of NOAA's table within the simulated ones.
    pub strengths: Vec<StrengthThreat>,
    /// Strengths of NOAA's table outside the simulated ones, which have no simulated threat [lbf].
    pub omitted_lbf: Vec<f64>,
    /// Greatest strength of a line in the comparison by trawls [lbf]; none without a cap.
    pub cap_lbf: Option<f64>,
    /// Mean threats by traps of a trawl.
    pub trawls: Vec<TrawlThreat>,
}

/// NOAA's model, with which a study is compared.
#[derive(Clone, Copy, Debug)]
pub struct NoaaModel<'a> {
    /// Threat by breaking strength.
    pub threats: &'a StrengthThreatTable,
    /// Breaking strengths of lines by traps.
    pub lines: &'a LineStrengthTable,
    /// Greatest strength of a line [N]; none without a cap.
    pub cap_n: Option<f64>,
}

/// The options of a curve with what happened in each encounter.
pub(super) struct SimulatedCurve {
    /// By strength, ascending.
    pub options: Vec<OptionThreat>,
    /// Their strengths.
    pub strengths: Strengths,
    /// Of each encounter that is valid with every option: whether the event occurred (1 or 0), by option, and the encounter's weight.
    pub encounters: Vec<(Vec<f64>, f64)>,
}

/// Names of the curves of a study with at least two strengths, those with the most strengths first.
pub fn curves(study: &Study) -> Vec<Option<&str>> {
    let mut found: Vec<(Option<&str>, usize)> = Vec::new();
    for option in study.options.iter().filter(|option| option.strength_n.is_some()) {
        let name = option.curve.as_deref();
        match found.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => found.push((name, 1)),
        }
    }
    found.retain(|(_, count)| *count > 1);
    found.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    found.into_iter().map(|(name, _)| name).collect()
}

impl StrengthThreats {
    /// The threats of a merged study by an event along a curve, beside NOAA's.
    /// Errors: two options of the curve with one strength; strengths or a cap outside NOAA's table or the simulated strengths.
    pub fn of(
        opened: &PreparedStudy,
        runs: &Runs,
        event: &StudyEvent,
        curve: Option<&str>,
        noaa: NoaaModel<'_>,
    ) -> Result<Self, String> {
        let on_curve = |option: &&StudyOption| {
            let is_known = !option.until_parted || event.is_known_at_parting();
            is_known && option.curve.as_deref() == curve
        };
        let options = opened.study.options.iter().filter(on_curve).filter_map(|option| {
            let indicators = EventIndicators::of(runs, &option.id.value, event);
            let threat = OptionThreat {
                option: option.id.value.clone(),
                strength_lbf: lbf_of(option.strength_n?),
                rate: Rate::of(&indicators),
                priors: AssumedBand::of_study(opened, runs, &indicators),
            };
            Some((threat, indicators))
        });
        let in_study = |message: String| format!("{}: {message}", opened.study.id);
        let simulated = SimulatedCurve::of(options.collect()).map_err(in_study)?;
        let (reference_lbf, strengths) = simulated.beside(noaa.threats).map_err(in_study)?;
        let cap_lbf = noaa.cap_n.map(lbf_of);
        if let Some(cap_lbf) = cap_lbf.filter(|cap| !simulated.strengths.contains(*cap)) {
            let (least, greatest) = (simulated.strengths.least(), simulated.strengths.greatest());
            return Err(in_study(format!(
                "a cap of {cap_lbf:.0} lbf is outside the simulated strengths; choose one from {least:.0} to {greatest:.0} lbf"
            )));
        }
        let omitted = noaa.threats.strengths_lbf().iter().copied();
        Ok(Self {
            schema: STRENGTH_SCHEMA,
            study: opened.study.id.clone(),
            hash: opened.hash.clone(),
            event: event.name(),
            curve: curve.map(str::to_owned),
            unbreakable: opened
                .unbreakable()
                .map(|option| Rate::of(&EventIndicators::of(runs, &option.id, event))),
            reference_lbf,
            strengths,
            omitted_lbf: omitted.filter(|lbf| !simulated.strengths.contains(*lbf)).collect(),
            cap_lbf,
            trawls: of_trawls(&simulated, noaa.threats, noaa.lines, cap_lbf),
            options: simulated.options,
        })
    }
}

/// A strength [N] in pounds-force, to a millionth: files state strengths in lbf, which SI units do not give back exactly.
fn lbf_of(strength_n: f64) -> f64 {
    (1e6 * strength_n / N_PER_LBF).round() / 1e6
}

impl SimulatedCurve {
    /// The curve of options, each with its indicators.
    /// Errors: fewer than two options; two options with one strength.
    fn of(mut options: Vec<(OptionThreat, EventIndicators)>) -> Result<Self, String> {
        options.sort_by(|(one, _), (other, _)| one.strength_lbf.total_cmp(&other.strength_lbf));
        let strengths = options.iter().map(|(option, _)| option.strength_lbf).collect();
        let Some(strengths) = Strengths::new(strengths).filter(|_| options.len() > 1) else {
            return Err("a curve needs two options with a strength; write strength = \"1700 lbf\" in options of one curve".to_owned());
        };
        let same = options.windows(2).find(|pair| {
            let [one, other] = [0, 1].map(|side: usize| pair[side].0.strength_lbf);
            other - one <= 1e-9 * other
        });
        if let Some([(one, _), (other, _)]) = same {
            return Err(format!(
                "options `{}` and `{}` of one curve both have the strength {:.0} lbf; name another curve in one of them",
                one.option, other.option, one.strength_lbf
            ));
        }
        let count = options.iter().map(|(_, indicators)| indicators.0.len()).max().unwrap_or(0);
        let encounter = |index: usize| {
            let mut weight = 0.0;
            let of_option = |(_, indicators): &(OptionThreat, EventIndicators)| {
                let indicator = indicators.0.get(index).copied().flatten()?;
                weight = indicator.weight;
                Some(f64::from(indicator.occurred))
            };
            let occurred: Option<Vec<f64>> = options.iter().map(of_option).collect();
            occurred.map(|occurred| (occurred, weight))
        };
        let encounters = (0..count).filter_map(encounter).collect();
        let options = options.into_iter().map(|(option, _)| option).collect();
        Ok(Self { options, strengths, encounters })
    }

    /// The ratio of two mean threats, by their coefficients, with its interval; none where the other never has the event.
    /// Encounters that are invalid with one of the options do not count.
    pub fn ratio(&self, this: &[f64], other: &[f64]) -> Option<ThreatRange> {
        let value = |(occurred, weight): &(Vec<f64>, f64)| {
            let of = |coefficients: &[f64]| combined(coefficients, occurred.iter().copied());
            ([of(this), of(other)], *weight)
        };
        let values: Vec<([f64; 2], f64)> = self.encounters.iter().map(value).collect();
        if this == other {
            let some = values.iter().any(|([value, _], weight)| value * weight > 0.0);
            return some.then_some(ThreatRange { threat: 1.0, lower: 1.0, upper: 1.0 });
        }
        ratio_of(&values, z95())
    }

    /// The reference strength [lbf], and the threats at the strengths of NOAA's table within the simulated ones.
    /// Errors: no strength in common.
    pub fn beside(&self, noaa: &StrengthThreatTable) -> Result<(f64, Vec<StrengthThreat>), String> {
        let own = self.strengths.all().iter().copied();
        let common = noaa.strengths_lbf().iter().copied();
        let common: Vec<f64> = common.filter(|lbf| self.strengths.contains(*lbf)).collect();
        let reference_lbf = own.filter(|lbf| noaa.contains(*lbf)).reduce(f64::max);
        let Some(reference_lbf) = reference_lbf.filter(|_| !common.is_empty()) else {
            return Err(format!(
                "the simulated strengths, {:.0} to {:.0} lbf, have none in common with the table of threat by strength; name options within it, or another table by --model",
                self.strengths.least(),
                self.strengths.greatest()
            ));
        };
        let at_reference = self.strengths.coefficients(reference_lbf);
        let noaa_reference = noaa.at(reference_lbf);
        let has_reference = noaa_reference.iter().all(|value| *value > 0.0);
        let ratio = |strength_lbf: &f64| {
            self.ratio(&self.strengths.coefficients(*strength_lbf), &at_reference)
        };
        let ratios: Option<Vec<ThreatRange>> =
            self.strengths.all().iter().map(ratio).collect::<Option<_>>().filter(|_| has_reference);
        let beside = |strength_lbf: f64| {
            let coefficients = self.strengths.coefficients(strength_lbf);
            let (simulated, values) = (self.range(&coefficients), noaa.at(strength_lbf));
            let noaa = ThreatRange::of_curves(values);
            let relative = ratios.as_ref().map(|ratios| {
                let mean =
                    |of: fn(&ThreatRange) -> f64| combined(&coefficients, ratios.iter().map(of));
                let simulated = ThreatRange {
                    threat: mean(|ratio| ratio.threat),
                    lower: mean(|ratio| ratio.lower),
                    upper: mean(|ratio| ratio.upper),
                };
                let share = |curve: usize| values[curve] / noaa_reference[curve];
                let noaa = ThreatRange::of_curves([0, 1, 2].map(share));
                RelativeThreat { simulated, noaa, overlaps: simulated.overlaps(&noaa) }
            });
            let is_simulated = self.strengths.find(strength_lbf).is_some();
            StrengthThreat {
                strength_lbf,
                origin: if is_simulated { Origin::Simulated } else { Origin::Interpolated },
                simulated,
                priors: self.priors(&coefficients),
                runs: self.runs(&coefficients),
                noaa,
                overlaps: simulated.overlaps(&noaa),
                relative,
            }
        };
        Ok((reference_lbf, common.into_iter().map(beside).collect()))
    }

    /// Least and greatest threat at the levels of the assumed inputs.
    fn priors(&self, coefficients: &[f64]) -> Interval {
        let rates = || {
            let options = self.options.iter();
            options.map(|option| AssumedBand::or_rate(option.priors.as_ref(), option.rate.rate))
        };
        Interval {
            low: combined(coefficients, rates().map(|rates| rates.low)),
            high: combined(coefficients, rates().map(|rates| rates.high)),
        }
    }

    /// Least number of valid runs of the options that have a coefficient above 0.
    fn runs(&self, coefficients: &[f64]) -> u64 {
        let used =
            self.options.iter().zip(coefficients).filter(|(_, coefficient)| **coefficient > 0.0);
        used.map(|(option, _)| option.rate.runs).min().unwrap_or_default()
    }
}

/// Columns beside those of the tool in the table with bands.
const BANDS: [&str; 4] = ["Threat_priors_lo", "Threat_priors_hi", "Threat_n", "how"];

impl StrengthThreats {
    /// The table in the columns of the tool: strength [lbf], rate, ends of its interval; `Threat_Lower` is the lesser one.
    /// Errors: if the table cannot be written.
    pub fn as_own(&self) -> Result<Vec<u8>, String> {
        written(&THREAT_COLUMNS, self.strengths.iter().map(columns))
    }

    /// The table with the band of the assumed inputs, the number of runs, and whether a row is `simulated` or `interpolated`.
    /// Errors: if the table cannot be written.
    pub fn with_bands(&self) -> Result<Vec<u8>, String> {
        let names: Vec<&str> = THREAT_COLUMNS.iter().chain(&BANDS).copied().collect();
        let row = |row: &StrengthThreat| {
            let priors = [number(row.priors.low), number(row.priors.high)];
            (columns(row), priors, row.runs, row.origin)
        };
        written(&names, self.strengths.iter().map(row))
    }

    /// Number of rows with a simulated strength.
    pub fn simulated(&self) -> usize {
        self.strengths.iter().filter(|row| row.origin == Origin::Simulated).count()
    }
}

fn columns(row: &StrengthThreat) -> Vec<String> {
    let simulated = row.simulated;
    let threats = [simulated.threat, simulated.lower, simulated.upper].map(number);
    std::iter::once(row.strength_lbf.to_string()).chain(threats).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::noaa::tests::threats;
    use super::*;

    /// A curve of strengths [lbf] with the number of encounters, of `count`, in which the event occurs: the first ones.
    pub(crate) fn curve(strengths: &[(f64, usize)], count: usize) -> SimulatedCurve {
        SimulatedCurve::of(strengths.iter().map(|(lbf, hits)| option(*lbf, *hits, count)).collect())
            .unwrap()
    }

    fn option(strength_lbf: f64, hits: usize, count: usize) -> (OptionThreat, EventIndicators) {
        let indicators = EventIndicators::even((0..count).map(|index| Some(index < hits)));
        let rate = Rate::of(&indicators);
        let option = format!("rope-{strength_lbf}");
        (OptionThreat { option, strength_lbf, rate, priors: None }, indicators)
    }

    /// Rates 0.1, 0.2 and 0.4 at 1,000, 2,000 and 5,200 lbf; NOAA has 0.04843 at 1,000, 0.08183 at 2,000 and 0.34849 at 5,200 lbf.
    #[test]
    fn threats_at_noaas_strengths_are_those_by_hand() {
        let simulated = curve(&[(1000.0, 10), (2000.0, 20), (5200.0, 40)], 100);
        let (reference_lbf, rows) = simulated.beside(&threats()).unwrap();
        assert_eq!((reference_lbf, rows.len()), (5200.0, 43));
        let at = |lbf: f64| rows.iter().find(|row| (row.strength_lbf - lbf).abs() < 1e-9).unwrap();
        for (lbf, origin, threat, relative) in [
            (1000.0, Origin::Simulated, 0.1, 0.25),
            (1700.0, Origin::Interpolated, 0.17, 0.425),
            (3600.0, Origin::Interpolated, 0.3, 0.75),
            (5200.0, Origin::Simulated, 0.4, 1.0),
        ] {
            let row = at(lbf);
            let own = row.relative.as_ref().unwrap();
            assert_eq!((row.origin, row.runs), (origin, 100));
            assert!((row.simulated.threat - threat).abs() < 1e-12, "{row:?}");
            assert!((own.simulated.threat - relative).abs() < 1e-12, "{row:?}");
        }
        // Wilson's interval of 10 in 100 is 0.0552 to 0.1744; NOAA's bounds at 1,000 lbf are 0.00916 to 0.35208.
        let row = at(1000.0);
        assert!((row.simulated.lower - 0.0552).abs() < 1e-4 && row.overlaps);
        assert_eq!(row.noaa, ThreatRange { threat: 0.048_43, lower: 0.009_16, upper: 0.352_08 });
        // Relative to its own value at 5,200 lbf, each of NOAA's curves is 1 there.
        let reference = at(5200.0).relative.clone().unwrap();
        assert_eq!(reference.noaa, ThreatRange { threat: 1.0, lower: 1.0, upper: 1.0 });
        let [curve, named_lower, named_upper] =
            [0, 1, 2].map(|curve: usize| threats().at(1000.0)[curve] / threats().at(5200.0)[curve]);
        let relative = row.relative.clone().unwrap();
        assert_eq!(
            relative.noaa,
            ThreatRange { threat: curve, lower: named_upper, upper: named_lower }
        );
        // 0.25 with an interval that includes neither 0.05 nor 0.6: 10 of 40 encounters with the event.
        assert!(
            relative.simulated.lower > 0.1 && relative.simulated.upper < 0.5 && relative.overlaps
        );
    }

    /// Between a strength without the event, whose ratio is 0 to some upper end, and the reference, both ends of the ratio are linear.
    #[test]
    fn relative_threats_between_simulated_strengths_are_linear_with_their_intervals() {
        let simulated = curve(&[(1000.0, 0), (2000.0, 20)], 100);
        let (_, rows) = simulated.beside(&threats()).unwrap();
        let first = rows[0].relative.clone().unwrap().simulated;
        assert!(first.threat == 0.0 && first.lower == 0.0 && first.upper > 0.1, "{first:?}");
        let middle = rows.iter().find(|row| (row.strength_lbf - 1500.0).abs() < 1e-9).unwrap();
        let middle = middle.relative.clone().unwrap().simulated;
        assert!((middle.threat - 0.5).abs() < 1e-12 && (middle.lower - 0.5).abs() < 1e-12);
        assert!((middle.upper - 0.5 * (first.upper + 1.0)).abs() < 1e-12, "{middle:?}");
        let given_back = |lbf: f64| lbf_of(lbf * N_PER_LBF).total_cmp(&lbf).is_eq();
        assert!([1132.0, 5200.0].into_iter().all(given_back));
    }

    #[test]
    fn ranges_apart_do_not_overlap_and_no_event_has_no_relative_threat() {
        let simulated = curve(&[(1000.0, 90), (5200.0, 95)], 100);
        let (_, rows) = simulated.beside(&threats()).unwrap();
        assert!(!rows[0].overlaps && rows[0].simulated.lower > rows[0].noaa.upper);
        let (_, rows) = curve(&[(1000.0, 0), (5200.0, 0)], 100).beside(&threats()).unwrap();
        assert!(rows.iter().all(|row| row.relative.is_none() && row.simulated.threat == 0.0));
    }

    #[test]
    fn curves_without_two_strengths_or_outside_the_table_are_errors() {
        let error = |options: &[(f64, usize)]| {
            let options = options.iter().map(|(lbf, hits)| option(*lbf, *hits, 10)).collect();
            SimulatedCurve::of(options).and_then(|curve| curve.beside(&threats())).unwrap_err()
        };
        assert!(error(&[(900.0, 1)]).contains("needs two options with a strength"));
        assert!(error(&[(900.0, 1), (900.0, 2)]).contains("both have the strength 900 lbf"));
        assert!(error(&[(100.0, 1), (200.0, 2)]).contains("100 to 200 lbf, have none in common"));
    }

    /// An encounter that is invalid with one option does not count in ratios.
    #[test]
    fn ratios_are_of_encounters_that_are_valid_with_every_option() {
        let (mut one, mut indicators) = option(1000.0, 1, 4);
        indicators.0[3] = None;
        one.rate = Rate::of(&indicators);
        let curve = SimulatedCurve::of(vec![(one, indicators), option(2000.0, 4, 4)]).unwrap();
        assert_eq!(curve.encounters.len(), 3);
        let ratio = curve.ratio(&[1.0, 0.0], &[0.0, 1.0]).unwrap();
        assert!((ratio.threat - 1.0 / 3.0).abs() < 1e-12, "{ratio:?}");
    }

    #[test]
    fn the_file_reads_as_the_tools_own_and_the_bands_mark_interpolated_rows() {
        let (reference_lbf, strengths) =
            curve(&[(1000.0, 10), (1200.0, 30)], 100).beside(&threats()).unwrap();
        let threats = StrengthThreats {
            schema: STRENGTH_SCHEMA,
            study: "s".into(),
            hash: "h".into(),
            event: "held_fast".into(),
            curve: None,
            options: Vec::new(),
            unbreakable: None,
            reference_lbf,
            strengths,
            omitted_lbf: Vec::new(),
            cap_lbf: None,
            trawls: Vec::new(),
        };
        let own = String::from_utf8(threats.as_own().unwrap()).unwrap();
        // Wilson's intervals of 10 and 30 in 100, and the means of their ends.
        let rows = [
            "RopeStrength,Threat,Threat_Lower,Threat_Upper",
            "1000,0.100000,0.055229,0.174366",
            "1100,0.200000,0.137150,0.285429",
            "1200,0.300000,0.218949,0.395849",
        ];
        let found: Vec<&str> = own.lines().collect();
        assert_eq!(found[..2], rows[..2]);
        assert_eq!(found.len(), rows.len());
        let read = StrengthThreatTable::read("own.csv", &own).unwrap();
        assert!((read.at(1100.0)[0] - 0.2).abs() < 1e-9);
        let bands = String::from_utf8(threats.with_bands().unwrap()).unwrap();
        let ends: Vec<&str> = bands.lines().filter_map(|line| line.rsplit(',').next()).collect();
        assert_eq!(ends, ["how", "simulated", "interpolated", "simulated"]);
        assert!(bands.contains("1000,0.100000,0.055229,0.174366,0.100000,0.100000,100,simulated"));
        assert_eq!(threats.simulated(), 2);
    }
}

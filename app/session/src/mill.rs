//! Mill tests: breaks of a product become its law of strength, and the probability that it is approved or meets a limit.
//!
//! Breaks are taken as draws from a normal law whose mean `μ` and deviation `σ` are unknown. With `n` breaks of mean `x` and
//! deviation `s`, under the usual prior `1/σ`:
//!
//! | quantity | formula |
//! |---|---|
//! | interval of `μ` | `x ± t · s / √n`, `t` of Student's law with `n − 1` degrees of freedom |
//! | interval of `σ` | `s √((n − 1) / χ²)` at the two ends of the χ² law with `n − 1` degrees of freedom |
//! | mean of ten more breaks | `x + s √(1/n + 1/10) · T` with `T` of the same Student's law |
//! | one more break | `x + s √(1/n + 1) · T` |
//!
//! Two texts of NOAA state when a weak rope or insert is approved, and they differ: the mean of ten consecutive breaks within 10 %
//! of 1,700 lbf (its page of approved weak inserts), or at most 1,700 lbf (bulletin 307460d). Both are reported, unless the caller
//! names limits of its own, such as the 600 lbf of a buoy's weak link.
//!
//! Reports often print a mean and a count alone. Then only the mean is compared, and no probability is given.

use std::sync::Arc;

use endline_gear::units::{self, Quantity};
use endline_gear::{Diagnostic, Document, EditError, Place, Setting, SourceText};
use schemars::JsonSchema;
use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF, StudentsT};

use crate::units::N_PER_LBF;

/// Column of single breaks.
const BREAK: &str = "break";
/// Columns of a table of means: name of a sample, mean, number of breaks, standard deviation.
const SAMPLE: &str = "sample";
const MEAN: &str = "mean";
const COUNT: &str = "count";
const DEVIATION: &str = "deviation";

/// Most breaks of a sample.
const MOST: usize = 1_000_000;

/// What a mill reports of breaks of one product.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Its name in the table; empty outside a table.
    pub name: String,
    /// Number of breaks.
    pub count: usize,
    /// Their mean [N].
    pub mean_n: f64,
    /// Their standard deviation, if known [N].
    pub deviation_n: Option<f64>,
}

/// What a table has: the breaks of one product, or a row for each of several samples.
#[derive(Clone, Debug, PartialEq)]
pub enum MillTable {
    /// Single breaks [N].
    Breaks(Vec<f64>),
    /// Means with their counts.
    Means(Vec<Sample>),
}

/// Reads a CSV table: a column `break` of forces, or columns `mean` and `count` with an optional `deviation` and `sample`.
/// Forces have their units; other columns are the mill's own.
pub fn read_table(name: &str, text: &str) -> Result<MillTable, Vec<Diagnostic>> {
    let source = Arc::new(SourceText { path: name.to_owned(), text: text.to_owned() });
    let whole = Place { source: Arc::clone(&source), span: 0..0, field: BREAK.to_owned() };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let failed = |error: csv::Error| {
        let at = error.position().map_or(0, csv::Position::byte);
        let at = usize::try_from(at).unwrap_or_default();
        let place = Place { span: at..at, ..whole.clone() };
        place.error(format!("is no row of the table: {error}"), "write as many values as columns")
    };
    let heads = reader.headers().map_err(|error| vec![failed(error)])?.clone();
    let column = |wanted: &str| heads.iter().position(|head| head == wanted);
    let columns = [SAMPLE, MEAN, COUNT, DEVIATION].map(column);
    let breaks = column(BREAK);
    let wrong = |message: &str, help: &str| Err(vec![whole.error(message, help)]);
    let (message, help) = match (breaks, columns[1], columns[2]) {
        (Some(_), Some(_), _) => (
            "the table has a column `break` and a column `mean`",
            "keep `break`, or `mean` and `count`",
        ),
        (None, Some(_), None) => (
            "the table has a column `mean` and no column `count`",
            "write `count` above a column with the number of breaks of each mean",
        ),
        (None, None, _) => (
            "the table has no column `break`, and none `mean`",
            "write `break` above forces such as \"1,650 lbf\", or columns `mean` and `count`",
        ),
        _ => ("", ""),
    };
    if !message.is_empty() {
        return wrong(message, help);
    }
    let (mut found, mut samples, mut problems) = (Vec::new(), Vec::new(), Vec::new());
    for (number, row) in reader.records().enumerate() {
        match (row, breaks) {
            (Err(error), _) => problems.push(failed(error)),
            (Ok(row), Some(column)) => match force(&Cell::of(&row, column, &whole, BREAK)) {
                Ok(newtons) => found.push(newtons),
                Err(problem) => problems.push(*problem),
            },
            (Ok(row), None) => match sample_of(&row, columns, &whole, number + 1) {
                Ok(sample) => samples.push(sample),
                Err(more) => problems.extend(more),
            },
        }
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    if breaks.is_none() && samples.is_empty() {
        return wrong("the table has no rows", "write a mean and a count in each row");
    }
    Ok(if breaks.is_some() { MillTable::Breaks(found) } else { MillTable::Means(samples) })
}

/// The sample of a row of a table of means, whose columns are in the order of their names above.
fn sample_of(
    row: &csv::StringRecord,
    [sample, mean, count, deviation]: [Option<usize>; 4],
    whole: &Place,
    number: usize,
) -> Result<Sample, Vec<Diagnostic>> {
    let cell =
        |column: Option<usize>, field| Cell::of(row, column.unwrap_or(usize::MAX), whole, field);
    let (mean, count) = (force(&cell(mean, MEAN)), count_of(&cell(count, COUNT)));
    let deviation = cell(deviation, DEVIATION);
    let deviation = (!deviation.text.is_empty()).then(|| force(&deviation)).transpose();
    let name = row.get(sample.unwrap_or(usize::MAX)).filter(|name| !name.is_empty());
    let name = name.map_or_else(|| format!("row {number}"), str::to_owned);
    match (mean, count, deviation) {
        (Ok(mean_n), Ok(count), Ok(deviation_n)) => Ok(Sample { name, count, mean_n, deviation_n }),
        (mean, count, deviation) => {
            let all = [mean.err(), count.err(), deviation.err()];
            Err(all.into_iter().flatten().map(|problem| *problem).collect())
        }
    }
}

/// A cell of a table with its place.
struct Cell<'a> {
    text: &'a str,
    place: Place,
}

impl<'a> Cell<'a> {
    fn of(row: &'a csv::StringRecord, column: usize, whole: &Place, field: &str) -> Self {
        let text = row.get(column).unwrap_or_default();
        let at = row.position().map_or(0, csv::Position::byte);
        let at = usize::try_from(at).unwrap_or_default();
        let rest = whole.source.text.get(at..).unwrap_or_default();
        let line = rest.trim_start_matches(['\r', '\n']);
        let before: usize = row.iter().take(column).map(str::len).sum();
        let from = line.get(before..).map_or(0, |_| before);
        let inside = line.get(from..).and_then(|rest| rest.find(text)).unwrap_or_default();
        let start = at + (rest.len() - line.len()) + from + inside;
        let place =
            Place { span: start..start + text.len(), field: field.to_owned(), ..whole.clone() };
        Self { text, place }
    }
}

/// The force of a cell [N].
fn force(cell: &Cell<'_>) -> Result<f64, Box<Diagnostic>> {
    let Cell { text, place } = cell;
    match units::parse(text, Quantity::Force) {
        Ok(newtons) if newtons > 0.0 => Ok(newtons),
        Ok(_) => Err(Box::new(
            place.error(format!("`{text}` is no {}", place.field), "write a force above zero"),
        )),
        Err(error) => Err(Box::new(place.error(error.message, error.help))),
    }
}

/// The number of breaks in a cell.
fn count_of(cell: &Cell<'_>) -> Result<usize, Box<Diagnostic>> {
    let Cell { text, place } = cell;
    let wrong = || {
        let help = format!("write a whole number from 1 to {MOST}, such as 10");
        Box::new(place.error(format!("`{text}` is no number of breaks"), help))
    };
    let count: usize = text.parse().map_err(|_| wrong())?;
    let fits = (1..=MOST).contains(&count);
    if fits { Ok(count) } else { Err(wrong()) }
}

/// The text of a weak link that parts as the product broke: its mean as rating, its spread between pieces.
/// Errors: where the law has no deviation.
pub fn weak_link(law: &StrengthLaw, name: &str, source: &str) -> Result<String, EditError> {
    let Some(deviation_n) = law.deviation_N else {
        let message = "a weak link needs the spread of its pieces, and no deviation is known; give --deviation, or single breaks";
        return Err(EditError { message: message.to_owned() });
    };
    let mut document = Document::parse("format = 1\nkind = \"weak-link\"\n")?;
    let rating = format!("{:.1} lbf", law.mean_N / N_PER_LBF);
    let spread = format!("{:.4}", deviation_n / law.mean_N);
    let breaks = law.breaks;
    let source = format!("{source}: mean and standard deviation of {breaks} breaks");
    let texts =
        [("name", name), ("source", &source), ("confidence", "measured"), ("rating", &rating)];
    for (field, text) in texts {
        document.put(field, &Setting::text(text))?;
    }
    document.put("spread", &Setting::plain(&spread))?;
    Ok(document.text())
}

/// Name and version of the JSON form of one product.
const SCHEMA: &str = "endline.mill/1";
/// Name and version of the JSON form of a table of means.
const SCHEMA_MEANS: &str = "endline.mill.means/1";

/// Strength that weak rope is approved for: 1,700 lbf [N].
const TARGET_N: f64 = 1700.0 * N_PER_LBF;
/// Band of the first criterion, as a share.
const BAND: f64 = 0.10;
/// Breaks of one approval.
const TESTED: f64 = 10.0;
/// Fewest breaks that have a spread.
const FEWEST: usize = 3;

/// The laws of a table of means.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct MeansLaws {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA_MEANS))]
    pub schema: &'static str,
    /// One for each row of the table.
    pub samples: Vec<StrengthLaw>,
}

impl MeansLaws {
    /// The laws behind samples, each against limits [N]; NOAA's two criteria where there are none.
    /// Errors: as [`StrengthLaw::of`], with the name of the sample.
    pub fn of(samples: &[Sample], limits_n: &[f64]) -> Result<Self, String> {
        let law = |sample: &Sample| {
            StrengthLaw::of(sample, limits_n).map_err(|error| format!("{}: {error}", sample.name))
        };
        let samples = samples.iter().map(law).collect::<Result<_, _>>()?;
        Ok(Self { schema: SCHEMA_MEANS, samples })
    }
}

/// The strength law of a product, from its breaks.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct StrengthLaw {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// Name of the sample in a table of means; empty otherwise.
    pub sample: String,
    /// Number of breaks.
    pub breaks: usize,
    /// Their mean [N].
    pub mean_N: f64,
    /// 95 % interval of the product's mean; null without a deviation [N].
    pub mean_interval_N: Option<[f64; 2]>,
    /// Their standard deviation; null if it is unknown [N].
    pub deviation_N: Option<f64>,
    /// 95 % interval of the product's standard deviation; null without a deviation [N].
    pub deviation_interval_N: Option<[f64; 2]>,
    /// The result of each criterion: the limits of the call, or the two of NOAA in the order of publication in docs/rules.md.
    pub approvals: Vec<Approval>,
    /// What cannot be concluded, in sentences; empty with a deviation.
    pub unknown: Vec<String>,
}

/// One criterion of approval, or a limit.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct Approval {
    /// Where it is published, or `--limit`.
    pub source: String,
    /// Least mean of ten breaks that is approved [N].
    pub least_N: f64,
    /// Greatest mean of ten breaks that is approved [N].
    pub most_N: f64,
    /// Whether the mean of these breaks lies between.
    pub holds: bool,
    /// Probability that the mean of ten more breaks of the product lies between; null without a deviation.
    pub probability: Option<f64>,
    /// Probability that one more break lies between; null without a deviation.
    pub one_probability: Option<f64>,
}

impl Sample {
    /// Mean and deviation of breaks [N].
    /// Errors: of too few breaks, or of breaks without a spread.
    pub fn of(breaks_n: &[f64]) -> Result<Self, String> {
        let count = breaks_n.len();
        if count < FEWEST {
            return Err(format!("{count} breaks: a law of strength needs {FEWEST} or more"));
        }
        #[expect(clippy::cast_precision_loss, reason = "a count of breaks")]
        let n = count as f64;
        let mean_n = breaks_n.iter().sum::<f64>() / n;
        let squares: f64 = breaks_n.iter().map(|one| (one - mean_n) * (one - mean_n)).sum();
        let deviation_n = (squares / (n - 1.0)).sqrt();
        if deviation_n <= 0.0 {
            return Err("all breaks are the same: they have no spread".to_owned());
        }
        Ok(Self { name: String::new(), count, mean_n, deviation_n: Some(deviation_n) })
    }
}

/// What breaks of a sample say about further breaks.
struct Further {
    student: StudentsT,
    mean_n: f64,
    deviation_n: f64,
    n: f64,
}

impl Further {
    /// Probability that the mean of `more` further breaks is at most this [N].
    fn below(&self, limit_n: f64, more: f64) -> f64 {
        let spread_n = self.deviation_n * (1.0 / self.n + 1.0 / more).sqrt();
        self.student.cdf((limit_n - self.mean_n) / spread_n)
    }

    /// Probability that it lies between two forces [N]; 0 as the least has no effect.
    fn between(&self, [least_n, most_n]: [f64; 2], more: f64) -> f64 {
        let lower = if least_n > 0.0 { self.below(least_n, more) } else { 0.0 };
        self.below(most_n, more) - lower
    }
}

/// The criteria: limits of the caller, or both of NOAA. Source, least and most [N].
fn criteria(limits_n: &[f64]) -> Vec<(String, [f64; 2])> {
    if !limits_n.is_empty() {
        return limits_n.iter().map(|limit_n| ("--limit".to_owned(), [0.0, *limit_n])).collect();
    }
    let within = [(1.0 - BAND) * TARGET_N, (1.0 + BAND) * TARGET_N];
    vec![
        ("NOAA Fisheries, approved weak inserts".to_owned(), within),
        ("NOAA bulletin 307460d".to_owned(), [0.0, TARGET_N]),
    ]
}

impl StrengthLaw {
    /// The law behind a sample, against limits [N]; NOAA's two criteria where there are none.
    /// Errors: of too few breaks for a deviation.
    pub fn of(sample: &Sample, limits_n: &[f64]) -> Result<Self, String> {
        let Sample { name, count, mean_n, deviation_n } = sample.clone();
        if deviation_n.is_some() && count < FEWEST {
            let needs = format!("a law of strength needs {FEWEST} or more");
            return Err(format!("{count} breaks with a deviation: {needs}"));
        }
        #[expect(clippy::cast_precision_loss, reason = "a count of breaks")]
        let n = count as f64;
        let law = |deviation_n: f64| -> Result<_, String> {
            let failed =
                |error: &dyn std::fmt::Display| format!("no law of {count} breaks: {error}");
            let student = StudentsT::new(0.0, 1.0, n - 1.0).map_err(|error| failed(&error))?;
            let squared = ChiSquared::new(n - 1.0).map_err(|error| failed(&error))?;
            let away = student.inverse_cdf(0.975) * deviation_n / n.sqrt();
            let scale = |at: f64| deviation_n * ((n - 1.0) / squared.inverse_cdf(at)).sqrt();
            let intervals = [[mean_n - away, mean_n + away], [scale(0.975), scale(0.025)]];
            Ok((Further { student, mean_n, deviation_n, n }, intervals))
        };
        let law = deviation_n.map(law).transpose()?;
        let further = law.as_ref().map(|(further, _)| further);
        let approval = |(source, range): (String, [f64; 2])| Approval {
            source,
            least_N: range[0],
            most_N: range[1],
            holds: (range[0]..=range[1]).contains(&mean_n),
            probability: further.map(|known| known.between(range, TESTED)),
            one_probability: further.map(|known| known.between(range, 1.0)),
        };
        let approvals: Vec<Approval> = criteria(limits_n).into_iter().map(approval).collect();
        Ok(Self {
            schema: SCHEMA,
            unknown: if further.is_some() { Vec::new() } else { unknown(count, &approvals) },
            sample: name,
            breaks: count,
            mean_N: mean_n,
            mean_interval_N: law.as_ref().map(|(_, intervals)| intervals[0]),
            deviation_N: deviation_n,
            deviation_interval_N: law.as_ref().map(|(_, intervals)| intervals[1]),
            approvals,
        })
    }
}

/// Conclusions from a mean without a deviation, and questions that it leaves open.
fn unknown(count: usize, approvals: &[Approval]) -> Vec<String> {
    let open = "No deviation is known, so neither the interval of the mean nor the share of pieces within a limit can be computed.";
    let of = |Approval { source, holds, .. }: &Approval| {
        let says = match (*holds, count) {
            (_, 1) => "one break decides nothing about the next.".to_owned(),
            (true, _) => {
                "the mean lies within it, but single breaks may lie outside; how many is unknown."
                    .to_owned()
            }
            (false, _) => format!(
                "the mean lies outside it, so at least one of the {count} breaks did; how many is unknown."
            ),
        };
        format!("{source}: {says}")
    };
    std::iter::once(open.to_owned()).chain(approvals.iter().map(of)).collect()
}

#[cfg(test)]
mod tests {
    use endline_gear::Library;
    use statrs::distribution::Normal;

    use super::*;

    fn breaks_of(text: &str) -> Result<Vec<f64>, Vec<Diagnostic>> {
        match read_table("mill.csv", text)? {
            MillTable::Breaks(breaks) => Ok(breaks),
            MillTable::Means(samples) => panic!("{samples:?}"),
        }
    }

    fn law_of(breaks_n: &[f64]) -> Result<StrengthLaw, String> {
        StrengthLaw::of(&Sample::of(breaks_n)?, &[])
    }

    #[test]
    fn breaks_are_read_with_their_units_and_mistakes_stand_at_their_rows() {
        let table = "sample,break\n1,\"1,650 lbf\"\n2,7.5 kN\n";
        let breaks = breaks_of(table).unwrap();
        assert!((breaks[0] - 1650.0 * 4.448_221_615_260_5).abs() < 1e-6 && breaks.len() == 2);
        assert!((breaks[1] - 7500.0).abs() < 1e-9);
        let wrong = "sample,break\n1,1650\n2,\"1,700 lb\"\n3,0 N\n4\n5,1700 lbf\n";
        let problems = breaks_of(wrong).unwrap_err();
        let places: Vec<(usize, usize)> =
            problems.iter().map(|problem| (problem.line, problem.column)).collect();
        assert_eq!(places, [(2, 3), (3, 4), (4, 3), (5, 1)], "{problems:?}");
        assert!(problems[0].message.contains("has no unit"), "{problems:?}");
        assert!(problems[1].message.contains("unit of a mass"), "{problems:?}");
        let none = breaks_of("a,b\n1,2\n").unwrap_err();
        assert!(none[0].message.contains("no column `break`") && none[0].line == 1);
    }

    #[test]
    fn the_entry_is_an_item_of_the_library_without_a_problem() {
        let law = law_of(&[7400.0, 7500.0, 7600.0]).unwrap();
        let text = weak_link(&law, "Sleeve of a mill", "mill.csv").unwrap();
        let problems = Library::check_file("weak-links/mill.toml", &text);
        assert!(problems.is_empty(), "{problems:?}\n{text}");
        // 7,500 N are 1,686.1 lbf; 100 of 7,500 are 1.33 %.
        assert!(text.contains("\"1686.1 lbf\"") && text.contains("spread = 0.0133"), "{text}");
        assert!(text.contains("mill.csv: mean and standard deviation of 3 breaks"), "{text}");
    }

    const LBF: f64 = 4.448_221_615_260_5;

    fn breaks(lbf: &[f64]) -> Vec<f64> {
        lbf.iter().map(|one| one * LBF).collect()
    }

    const TEN: [f64; 10] =
        [1650.0, 1720.0, 1580.0, 1705.0, 1690.0, 1610.0, 1745.0, 1660.0, 1700.0, 1640.0];

    #[test]
    fn mean_and_deviation_are_those_of_the_tables() {
        let law = law_of(&breaks(&TEN)).unwrap();
        // Sum 16,700; squares about 1,670: 20² + 50² + 90² + 35² + 20² + 60² + 75² + 10² + 30² + 30² = 23,750.
        assert!((law.mean_N / LBF - 1670.0).abs() < 1e-9);
        let deviation = (23_750.0f64 / 9.0).sqrt();
        assert!((law.deviation_N.unwrap() / LBF - deviation).abs() < 1e-9);
        // t of 9 degrees of freedom at 97.5 %: 2.262157; χ² at 2.5 and 97.5 %: 2.700389, 19.022768.
        let away = 2.262_157 * deviation / 10f64.sqrt();
        assert!((law.mean_interval_N.unwrap()[0] / LBF - (1670.0 - away)).abs() < 1e-3);
        let least = deviation * (9.0f64 / 19.022_768).sqrt();
        let most = deviation * (9.0f64 / 2.700_389).sqrt();
        assert!((law.deviation_interval_N.unwrap()[0] / LBF - least).abs() < 1e-3);
        assert!((law.deviation_interval_N.unwrap()[1] / LBF - most).abs() < 1e-3);
        assert!(law.approvals.iter().all(|approval| approval.holds));
        assert!(law_of(&[1.0, 2.0]).is_err() && law_of(&[1.0; 5]).is_err());
    }

    /// Equal shares of the unit interval, mixed by a full-period generator.
    struct Draws(u64);

    impl Draws {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.0;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 + 1e-17
        }
    }

    /// Products that these breaks may come from are drawn, ten breaks of each are made, and the criterion is applied.
    #[test]
    fn the_probability_of_approval_is_that_of_products_drawn_and_broken() {
        let (normal, squared) = (Normal::new(0.0, 1.0).unwrap(), ChiSquared::new(9.0).unwrap());
        for shift in [0.0, 28.0, 190.0] {
            let lbf: Vec<f64> = TEN.iter().map(|one| one + shift).collect();
            let law = law_of(&breaks(&lbf)).unwrap();
            let (mut draws, mut met, runs) = (Draws(7), [0u32; 2], 20_000u32);
            for _ in 0..runs {
                let sigma =
                    law.deviation_N.unwrap() * (9.0 / squared.inverse_cdf(draws.next())).sqrt();
                let z = normal.inverse_cdf(draws.next());
                let mu = law.mean_N + sigma * z / 10f64.sqrt();
                let sum: f64 = (0..10).map(|_| mu + sigma * normal.inverse_cdf(draws.next())).sum();
                for (met, approval) in met.iter_mut().zip(&law.approvals) {
                    *met += u32::from((approval.least_N..=approval.most_N).contains(&(sum / 10.0)));
                }
            }
            for (met, approval) in met.into_iter().zip(&law.approvals) {
                let p = approval.probability.unwrap();
                let share = f64::from(met) / f64::from(runs);
                let error = (p * (1.0 - p) / f64::from(runs)).sqrt();
                assert!((share - p).abs() < 4.0 * error + 1e-4, "{shift}: {share} against {p}");
            }
        }
    }

    /// Averages of hog-ring links as a report prints them, with a count that it does not print for each.
    const MEANS: &str =
        "sample,mean,count,deviation\n1,470 lbf,10,\n2,605 lbf,10,\n3,540 lbf,10,25 lbf\n";

    fn samples_of(text: &str) -> Result<Vec<Sample>, Vec<Diagnostic>> {
        match read_table("means.csv", text)? {
            MillTable::Means(samples) => Ok(samples),
            MillTable::Breaks(breaks) => panic!("{breaks:?}"),
        }
    }

    #[test]
    fn a_mean_without_a_deviation_is_compared_and_leaves_the_rest_open() {
        let samples = samples_of(MEANS).unwrap();
        let laws = MeansLaws::of(&samples, &[600.0 * LBF]).unwrap();
        let [low, high, known] = laws.samples.as_slice() else { panic!("{laws:?}") };
        assert!(low.approvals[0].holds && !high.approvals[0].holds);
        for law in [low, high] {
            let only = &law.approvals[0];
            assert_eq!((only.probability, only.one_probability), (None, None));
            assert_eq!((law.deviation_N, law.mean_interval_N), (None, None));
            assert!(law.unknown[0].starts_with("No deviation is known"), "{:?}", law.unknown);
        }
        assert!(low.unknown[1].contains("single breaks may lie outside"), "{:?}", low.unknown);
        assert!(high.unknown[1].contains("at least one of the 10 breaks"), "{:?}", high.unknown);
        assert!(weak_link(low, "Link", "report").unwrap_err().message.contains("--deviation"));
        // (600 - 540) / (25 √1.1) = 2.288: T of 9 degrees of freedom is below it with 0.9760.
        assert!(known.unknown.is_empty());
        let one = known.approvals[0].one_probability.unwrap();
        assert!((one - 0.9760).abs() < 5e-4, "{one}");
        let few = [Sample { count: 2, ..samples[2].clone() }];
        let error = MeansLaws::of(&few, &[]).unwrap_err();
        assert!(error.contains("3: 2 breaks with a deviation"), "{error}");
    }

    #[test]
    fn a_mean_with_its_deviation_gives_the_law_of_its_breaks() {
        let of_breaks = Sample::of(&breaks(&TEN)).unwrap();
        let deviation = (23_750.0f64 / 9.0).sqrt() * LBF;
        let given =
            Sample { mean_n: 1670.0 * LBF, deviation_n: Some(deviation), ..of_breaks.clone() };
        let limits = [1100.0 * LBF, 1700.0 * LBF];
        let [one, other] =
            [of_breaks, given].map(|sample| StrengthLaw::of(&sample, &limits).unwrap());
        assert_eq!(one.approvals.len(), 2);
        for (one, other) in one.approvals.iter().zip(&other.approvals) {
            assert!((one.probability.unwrap() - other.probability.unwrap()).abs() < 1e-9);
            assert!((one.one_probability.unwrap() - other.one_probability.unwrap()).abs() < 1e-9);
        }
        assert!(one.approvals[0].probability.unwrap() < 1e-6);
    }

    #[test]
    fn mistakes_in_a_table_of_means_name_their_cell() {
        for (text, says, place) in [
            ("mean\n470 lbf\n", "no column `count`", (1, 1)),
            ("mean,break,count\n1 N,1 N,2\n", "`break` and a column `mean`", (1, 1)),
            ("mean,count\n", "the table has no rows", (1, 1)),
            ("count,mean\n10,470\n", "has no unit", (2, 4)),
            ("mean,count\n470 lbf,ten\n", "`ten` is no number of breaks", (2, 9)),
            ("mean,count\n470 lbf,0\n", "`0` is no number of breaks", (2, 9)),
            ("mean,count,deviation\n470 lbf,10,0 lbf\n", "`0 lbf` is no deviation", (2, 12)),
        ] {
            let problems = samples_of(text).unwrap_err();
            let at = (problems[0].line, problems[0].column);
            assert!(problems[0].message.contains(says), "{text}: {problems:?}");
            assert_eq!(at, place, "{text}: {problems:?}");
        }
    }
}

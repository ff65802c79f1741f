//! Mill tests: breaks of a product become its law of strength, and the probability that it is approved.
//!
//! Breaks are taken as draws from a normal law whose mean `μ` and deviation `σ` are unknown. With `n` breaks of mean `x` and
//! deviation `s`, under the usual prior `1/σ`:
//!
//! | quantity | formula |
//! |---|---|
//! | interval of `μ` | `x ± t · s / √n`, `t` of Student's law with `n − 1` degrees of freedom |
//! | interval of `σ` | `s √((n − 1) / χ²)` at the two ends of the χ² law with `n − 1` degrees of freedom |
//! | mean of ten more breaks | `x + s √(1/n + 1/10) · T` with `T` of the same Student's law |
//!
//! Two texts of NOAA state when a weak rope or insert is approved, and they differ: the mean of ten consecutive breaks within 10 %
//! of 1,700 lbf (its page of approved weak inserts), or at most 1,700 lbf (bulletin 307460d). Both are reported.

use std::sync::Arc;

use endline_gear::units::{self, Quantity, find, format};
use endline_gear::{Diagnostic, Document, EditError, Place, Setting, SourceText};
use schemars::JsonSchema;
use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF, StudentsT};

/// Column of the table that is read.
const COLUMN: &str = "break";

/// Reads the column `break` of a CSV table, a force with its unit in each row [N]; other columns are the mill's own.
pub fn read_breaks(name: &str, text: &str) -> Result<Vec<f64>, Vec<Diagnostic>> {
    let source = Arc::new(SourceText { path: name.to_owned(), text: text.to_owned() });
    let whole = Place { source: Arc::clone(&source), span: 0..0, field: COLUMN.to_owned() };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let failed = |error: csv::Error| {
        let at = error.position().map_or(0, csv::Position::byte);
        let at = usize::try_from(at).unwrap_or_default();
        let place = Place { span: at..at, ..whole.clone() };
        place.error(format!("is no row of the table: {error}"), "write as many values as columns")
    };
    let column = reader.headers().map_err(|error| vec![failed(error)])?.iter().position(is_column);
    let Some(column) = column else {
        let help = "write `break` above the column, and forces below, such as \"1,650 lbf\"";
        return Err(vec![whole.error("the table has no column `break`", help)]);
    };
    let (mut breaks, mut problems) = (Vec::new(), Vec::new());
    for row in reader.records() {
        match row.map(|row| force(&row, column, &whole)) {
            Ok(Ok(newtons)) => breaks.push(newtons),
            Ok(Err(problem)) => problems.push(*problem),
            Err(error) => problems.push(failed(error)),
        }
    }
    if problems.is_empty() { Ok(breaks) } else { Err(problems) }
}

fn is_column(name: &str) -> bool {
    name == COLUMN
}

/// The force of a row [N].
fn force(row: &csv::StringRecord, column: usize, whole: &Place) -> Result<f64, Box<Diagnostic>> {
    let text = row.get(column).unwrap_or_default();
    let at = row.position().map_or(0, csv::Position::byte);
    let at = usize::try_from(at).unwrap_or_default();
    let rest = whole.source.text.get(at..).unwrap_or_default();
    let line = rest.trim_start_matches(['\r', '\n']);
    let start = at + (rest.len() - line.len()) + line.find(text).unwrap_or_default();
    let place = Place { span: start..start + text.len(), ..whole.clone() };
    match units::parse(text, Quantity::Force) {
        Ok(newtons) if newtons > 0.0 => Ok(newtons),
        Ok(_) => {
            Err(Box::new(place.error(format!("`{text}` is no break"), "a rope breaks above zero")))
        }
        Err(error) => Err(Box::new(place.error(error.message, error.help))),
    }
}

/// The text of a weak link that parts as the product broke: its mean as rating, its spread between pieces.
pub fn weak_link(law: &StrengthLaw, name: &str, source: &str) -> Result<String, EditError> {
    let mut document = Document::parse("format = 1\nkind = \"weak-link\"\n")?;
    let newtons = (law.mean_N * 10.0).round() / 10.0;
    let rating = match find("lbf", Quantity::Force) {
        Some(unit) => {
            let number = (law.mean_N / unit.factor() * 10.0).round() / 10.0;
            format(number * unit.factor(), unit)
        }
        None => format!("{newtons} N"),
    };
    let spread = format!("{:.4}", law.deviation_N / law.mean_N);
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

/// Name and version of the JSON form.
const SCHEMA: &str = "endline.mill/1";

/// Strength that weak rope is approved for: 1,700 lbf [N].
const TARGET_N: f64 = 1700.0 * 4.448_221_615_260_5;
/// Band of the first criterion, as a share.
const BAND: f64 = 0.10;
/// Breaks of one approval.
const TESTED: f64 = 10.0;
/// Fewest breaks that have a spread.
const FEWEST: usize = 3;

/// The strength law of a product, from its breaks.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct StrengthLaw {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// Number of breaks.
    pub breaks: usize,
    /// Their mean [N].
    pub mean_N: f64,
    /// 95 % interval of the product's mean [N].
    pub mean_interval_N: [f64; 2],
    /// Their standard deviation [N].
    pub deviation_N: f64,
    /// 95 % interval of the product's standard deviation [N].
    pub deviation_interval_N: [f64; 2],
    /// The result of each criterion, in the order of publication in docs/rules.md.
    pub approvals: [Approval; 2],
}

/// One criterion of approval.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct Approval {
    /// Where it is published.
    pub source: &'static str,
    /// Least mean of ten breaks that is approved [N].
    pub least_N: f64,
    /// Greatest mean of ten breaks that is approved [N].
    pub most_N: f64,
    /// Whether the mean of these breaks lies between.
    pub holds: bool,
    /// Probability that the mean of ten more breaks of the product lies between.
    pub probability: f64,
}

impl StrengthLaw {
    /// The law behind breaks [N].
    pub fn of(breaks_n: &[f64]) -> Result<Self, String> {
        let count = breaks_n.len();
        if count < FEWEST {
            return Err(format!("{count} breaks: a law of strength needs {FEWEST} or more"));
        }
        #[expect(clippy::cast_precision_loss, reason = "a count of breaks")]
        let n = count as f64;
        let mean = breaks_n.iter().sum::<f64>() / n;
        let squares: f64 = breaks_n.iter().map(|one| (one - mean) * (one - mean)).sum();
        let deviation = (squares / (n - 1.0)).sqrt();
        if deviation <= 0.0 {
            return Err("all breaks are the same: they have no spread".to_owned());
        }
        let failed = |error: &dyn std::fmt::Display| format!("no law of {count} breaks: {error}");
        let student = StudentsT::new(0.0, 1.0, n - 1.0).map_err(|error| failed(&error))?;
        let squared = ChiSquared::new(n - 1.0).map_err(|error| failed(&error))?;
        let away = student.inverse_cdf(0.975) * deviation / n.sqrt();
        let scale = |at: f64| deviation * ((n - 1.0) / squared.inverse_cdf(at)).sqrt();
        let of_ten = deviation * (1.0 / n + 1.0 / TESTED).sqrt();
        let below = |limit: f64| student.cdf((limit - mean) / of_ten);
        let approval = |source, least: f64, most: f64| Approval {
            source,
            least_N: least,
            most_N: most,
            holds: (least..=most).contains(&mean),
            probability: below(most) - if least > 0.0 { below(least) } else { 0.0 },
        };
        let (least, most) = ((1.0 - BAND) * TARGET_N, (1.0 + BAND) * TARGET_N);
        Ok(Self {
            schema: SCHEMA,
            breaks: count,
            mean_N: mean,
            mean_interval_N: [mean - away, mean + away],
            deviation_N: deviation,
            deviation_interval_N: [scale(0.975), scale(0.025)],
            approvals: [
                approval("NOAA Fisheries, approved weak inserts", least, most),
                approval("NOAA bulletin 307460d", 0.0, TARGET_N),
            ],
        })
    }
}

#[cfg(test)]
mod tests {
    use endline_gear::Library;
    use statrs::distribution::Normal;

    use super::*;

    #[test]
    fn breaks_are_read_with_their_units_and_mistakes_stand_at_their_rows() {
        let table = "sample,break\n1,\"1,650 lbf\"\n2,7.5 kN\n";
        let breaks = read_breaks("mill.csv", table).unwrap();
        assert!((breaks[0] - 1650.0 * 4.448_221_615_260_5).abs() < 1e-6 && breaks.len() == 2);
        assert!((breaks[1] - 7500.0).abs() < 1e-9);
        let wrong = "sample,break\n1,1650\n2,\"1,700 lb\"\n3,0 N\n4\n5,1700 lbf\n";
        let problems = read_breaks("mill.csv", wrong).unwrap_err();
        let places: Vec<(usize, usize)> =
            problems.iter().map(|problem| (problem.line, problem.column)).collect();
        assert_eq!(places, [(2, 3), (3, 4), (4, 3), (5, 1)], "{problems:?}");
        assert!(problems[0].message.contains("has no unit"), "{problems:?}");
        assert!(problems[1].message.contains("unit of a mass"), "{problems:?}");
        let none = read_breaks("mill.csv", "a,b\n1,2\n").unwrap_err();
        assert!(none[0].message.contains("no column `break`") && none[0].line == 1);
    }

    #[test]
    fn the_entry_is_an_item_of_the_library_without_a_problem() {
        let law = StrengthLaw::of(&[7400.0, 7500.0, 7600.0]).unwrap();
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
        let law = StrengthLaw::of(&breaks(&TEN)).unwrap();
        // Sum 16,700; squares about 1,670: 20² + 50² + 90² + 35² + 20² + 60² + 75² + 10² + 30² + 30² = 23,750.
        assert!((law.mean_N / LBF - 1670.0).abs() < 1e-9);
        let deviation = (23_750.0f64 / 9.0).sqrt();
        assert!((law.deviation_N / LBF - deviation).abs() < 1e-9);
        // t of 9 degrees of freedom at 97.5 %: 2.262157; χ² at 2.5 and 97.5 %: 2.700389, 19.022768.
        let away = 2.262_157 * deviation / 10f64.sqrt();
        assert!((law.mean_interval_N[0] / LBF - (1670.0 - away)).abs() < 1e-3);
        let least = deviation * (9.0f64 / 19.022_768).sqrt();
        let most = deviation * (9.0f64 / 2.700_389).sqrt();
        assert!((law.deviation_interval_N[0] / LBF - least).abs() < 1e-3);
        assert!((law.deviation_interval_N[1] / LBF - most).abs() < 1e-3);
        assert!(law.approvals.iter().all(|approval| approval.holds));
        assert!(StrengthLaw::of(&[1.0, 2.0]).is_err() && StrengthLaw::of(&[1.0; 5]).is_err());
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
            let law = StrengthLaw::of(&breaks(&lbf)).unwrap();
            let (mut draws, mut met, runs) = (Draws(7), [0u32; 2], 20_000u32);
            for _ in 0..runs {
                let sigma = law.deviation_N * (9.0 / squared.inverse_cdf(draws.next())).sqrt();
                let z = normal.inverse_cdf(draws.next());
                let mu = law.mean_N + sigma * z / 10f64.sqrt();
                let sum: f64 = (0..10).map(|_| mu + sigma * normal.inverse_cdf(draws.next())).sum();
                for (met, approval) in met.iter_mut().zip(&law.approvals) {
                    *met += u32::from((approval.least_N..=approval.most_N).contains(&(sum / 10.0)));
                }
            }
            for (met, approval) in met.into_iter().zip(&law.approvals) {
                let p = approval.probability;
                let share = f64::from(met) / f64::from(runs);
                let error = (p * (1.0 - p) / f64::from(runs)).sqrt();
                assert!((share - p).abs() < 4.0 * error + 1e-4, "{shift}: {share} against {p}");
            }
        }
    }
}

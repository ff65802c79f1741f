//! The law of strength behind breaks, and what approves it.

use schemars::JsonSchema;
use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF, StudentsT};

/// Name and version of the JSON form.
const SCHEMA: &str = "endline.mill/1";

/// Strength that weak rope is approved for: 1,700 lbf [N].
const TARGET_N: f64 = 1700.0 * 4.448_221_615_260_5;
/// Band of the first criterion, as a share.
const BAND: f64 = 0.10;
/// Breaks of one approval.
const TESTED: f64 = 10.0;
/// Fewest breaks of which a spread can be told.
const FEWEST: usize = 3;

/// What breaks say of a product.
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
    /// What each criterion says, in the order of publication in docs/rules.md.
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
    ///
    /// # Errors
    /// Fewer than three breaks, or breaks that are all the same.
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
            return Err("all breaks are the same: no spread can be told".to_owned());
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
    use statrs::distribution::Normal;

    use super::*;

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

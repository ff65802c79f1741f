//! Hauls beside a study: probability of parting at the hauler against parting on a whale, by the strength of the line.
//!
//! A haul bore `T` where it came nearest to parting. A line that delivers `S` in the mean there, with the coefficient of variation `c`, parts
//! at the hauler with the probability `Φ((T/S - 1)/c)` (`haul/risk.rs`): the load of a haul depends on weight and speed, hardly on the
//! strength of the rope.

use std::path::Path;

use serde::Deserialize;

use crate::error::Error;
use crate::haul::loads;
use crate::haul::sheet::SCHEMA;

/// Coefficient of variation where the haul's file gives none: that of rope by its entries.
const USUAL_VARIATION: f64 = 0.1;

/// The greatest load of a haul.
#[derive(Clone, Debug, PartialEq)]
pub struct HauledLoad {
    /// Name: the gear hauled, and its sea.
    pub name: String,
    /// Tension where the haul came nearest to parting [N].
    pub tension_n: f64,
    /// Coefficient of variation of what is loaded there.
    pub variation: f64,
}

/// The part of `endline.haul/1` that is read.
#[derive(Deserialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
struct Sheet {
    schema: String,
    assembly: String,
    depth_m: f64,
    sea_m: f64,
    traps: usize,
    nearest: Option<Nearest>,
    strengths: Vec<Strength>,
}

#[derive(Deserialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
struct Nearest {
    part: String,
    tension_N: f64,
}

#[derive(Deserialize)]
struct Strength {
    part: String,
    variation: Option<Variation>,
}

#[derive(Deserialize)]
struct Variation {
    value: f64,
}

impl HauledLoad {
    /// Reads what `endline haul --json` printed.
    /// Errors: a file that cannot be read, or holds something else.
    pub fn read(file: &Path) -> Result<Self, Error> {
        let text = endline_gear::read::text(file).map_err(Error::on(file, "cannot be read"))?;
        let expected = "expected what `endline haul ASSEMBLY --json` prints";
        let sheet: Sheet = serde_json::from_str(&text)
            .map_err(|error| Error::at(file, format!("is no haul: {error}; {expected}")))?;
        if sheet.schema != SCHEMA {
            let message = format!("has the schema `{}`; {expected}, `{SCHEMA}`", sheet.schema);
            return Err(Error::at(file, message));
        }
        let nearest = sheet
            .nearest
            .ok_or_else(|| Error::at(file, "bore no tension; haul gear with an endline"))?;
        let own = sheet.strengths.iter().find(|strength| strength.part == nearest.part);
        let variation = own.and_then(|strength| Some(strength.variation.as_ref()?.value));
        let sea = match sheet.sea_m > 0.0 {
            true => format!("waves of {:.1} m", sheet.sea_m),
            false => "a calm".to_owned(),
        };
        let traps = if sheet.traps == 1 { "trap" } else { "traps" };
        Ok(Self {
            name: format!(
                "at the hauler: {}, {} {traps}, {:.0} m, {sea}",
                sheet.assembly, sheet.traps, sheet.depth_m
            ),
            tension_n: nearest.tension_N,
            variation: variation.unwrap_or(USUAL_VARIATION),
        })
    }

    /// Probability that a line that delivers a strength parts in the haul.
    pub fn parts(&self, strength_n: f64) -> f64 {
        loads::probability(self.tension_n / strength_n, self.variation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHEET: &str = r#"{"schema":"endline.haul/1","assembly":"trawl-10","depth_m":60.0,"sea_m":1.0,"traps":10,
        "nearest":{"part":"endline-bottom","tension_N":2000.0},
        "strengths":[{"part":"endline-top","variation":null},{"part":"endline-bottom","variation":{"value":0.05}}]}"#;

    fn read(name: &str, text: &str) -> Result<HauledLoad, Error> {
        let file = std::env::temp_dir().join(name);
        std::fs::write(&file, text).unwrap();
        HauledLoad::read(&file)
    }

    /// At its mean a line parts in one haul of two, two deviations stronger in one of 44: `S = T/(1 - 2 c)`.
    #[test]
    fn a_haul_is_read_and_parts_lines_by_their_strength() {
        let load = read("endline-haul.json", SHEET).unwrap();
        assert_eq!(load.name, "at the hauler: trawl-10, 10 traps, 60 m, waves of 1.0 m");
        assert!((load.parts(2000.0) - 0.5).abs() < 1e-12);
        assert!((load.parts(2000.0 / 0.9) - 0.02275).abs() < 1e-5);
    }

    #[test]
    fn a_file_that_is_no_haul_is_named() {
        let problem = read("endline-no-haul.json", "{\"schema\":\"endline.run/1\"}").unwrap_err();
        assert!(problem.to_string().contains("endline-no-haul.json is no haul"), "{problem}");
        let other = SHEET.replace("haul/1", "haul/9");
        let problem = read("endline-other-haul.json", &other).unwrap_err();
        assert!(problem.to_string().contains("`endline.haul/9`"), "{problem}");
    }
}

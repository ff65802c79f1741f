//! The compliance sheet: one page on a gear for a hearing, readable in black and white.
//!
//! It shows the gear at slack and at running tide (`drawing.rs`), its make-up, the strength of each part, the verdict on every
//! rule, its haul, the threat of its endline from a simulated table, and the limits of knowledge. Its hash is that of everything the
//! model at running tide is made from, so that the same command makes the same page. The page is HTML (`page.rs`); an
//! installed browser prints it as PDF. Several gears stand beside each other on a page of their own (`comparison.rs`).

mod comparison;
mod drawing;
mod page;
#[cfg(test)]
mod tests;

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use endline_gear::Sources;
use endline_sim::settle;
use serde::Deserialize;

use crate::error::Error;
use crate::haul::{HaulRequest, HaulSheet, haul_of};
use crate::plugins::PluginHost;
use crate::rules::{Fishing, Packs, RuleGear, RuleSheet, check, of_library};
use crate::settled::SettledShape;
use crate::source::{Prepared, Source, library_of};
use crate::statics::{TrialGear, TrialSea, alone};
use crate::study::threat::at_line;
use crate::units::{METRES_PER_INCH, N_PER_LBF};

pub use comparison::comparison;

/// The sea of a preview; site, depth and current are the request's.
const SEA: &str = "format = 1\nkind = \"scenario\"\nname = \"compliance sheet\"\nduration = \"1 s\"\nstrength_scatter = false\n\
    [current]\nspeed = \"0 m/s\"\ntoward = \"90 deg\"\n";

/// Default speed of the running tide [m/s]: a shallow bay at its strongest, as the preview of an assembly begins.
pub const USUAL_TIDE_M_S: f64 = 0.25;

/// The request for a sheet.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// Id of the assembly.
    pub assembly: &'a str,
    /// Files of the library, the assembly's among them.
    pub sources: &'a Sources,
    /// Where, when and how it is fished.
    pub fishing: Fishing,
    /// Speed of the running tide at the surface [m/s].
    pub tide_m_s: f64,
    /// Threat table with bands, as `endline study threat` writes it.
    pub threat: Option<PathBuf>,
}

/// A gear's sheet.
pub struct ComplianceSheet {
    /// Id of the assembly.
    pub id: String,
    name: String,
    notes: String,
    /// Name of the area.
    area: String,
    fishing: Fishing,
    tide_m_s: f64,
    rules: RuleSheet,
    /// At slack and at running tide.
    rest: [AtRest; 2],
    /// Its haul, or why it cannot be hauled.
    haul: Result<HaulSheet, Error>,
    threat: Option<ThreatOfGear>,
}

/// The gear in one sea.
struct AtRest {
    prepared: Prepared,
    shape: SettledShape,
}

impl ComplianceSheet {
    /// The sheet of a gear.
    pub fn of(request: &Request<'_>, packs: &Packs, host: &PluginHost) -> Result<Self, Error> {
        let Request { assembly: id, sources, fishing, tide_m_s, threat } = request;
        let library = library_of(id, sources)?;
        let gear = of_library(id, fishing.depth_m, &library, host)?;
        let at_rest = |current_m_s| -> Result<AtRest, Error> {
            let sea = TrialSea {
                depth: Some(format!("{} m", gear.depth_m)),
                current_m_s: Some(current_m_s),
            };
            let scenario = alone(SEA, &TrialGear::Assembly((*id).to_owned()), &sea, &library)?;
            AtRest::of(Source::new(id, scenario, (*sources).clone()).prepare(host)?)
        };
        let haul = HaulRequest {
            depth_m: Some(gear.depth_m),
            tide_m_s: Some(*tide_m_s),
            traps: fishing.traps,
            ..HaulRequest::default()
        };
        let entry = library.assemblies.iter().find(|assembly| assembly.entry.id == *id);
        let (name, notes) = entry.map_or(((*id).to_owned(), String::new()), |assembly| {
            (assembly.entry.name.clone(), assembly.entry.notes.clone())
        });
        let threat = threat.as_deref().map(|file| -> Result<ThreatOfGear, Error> {
            let text = endline_gear::read::text(file).map_err(Error::on(file, "cannot be read"))?;
            ThreatOfGear::find(&file.display().to_string(), &text, &gear)
        });
        Ok(Self {
            rules: check(&gear, packs, fishing)?,
            rest: [at_rest(0.0)?, at_rest(*tide_m_s)?],
            haul: haul_of(id, &haul, &library, host),
            threat: threat.transpose()?,
            area: packs.area_name(&fishing.area),
            fishing: fishing.clone(),
            tide_m_s: *tide_m_s,
            id: (*id).to_owned(),
            name,
            notes,
        })
    }

    /// The page.
    pub fn html(&self) -> Result<String, Error> {
        page::html(self).map_err(|error| Error::Message(format!("the sheet: {error}")))
    }

    /// BLAKE3 of everything the model at running tide is made from, hexadecimal.
    pub fn hash(&self) -> String {
        self.rest[1].prepared.source.hash()
    }
}

impl AtRest {
    fn of(prepared: Prepared) -> Result<Self, Error> {
        let settled = settle(&prepared.model);
        if !settled.converged {
            return Err(Error::Unsettled { why: settled.why(), passes: settled.trace_n.len() });
        }
        // How long it took is no part of a sheet.
        let shape = SettledShape::of(&prepared, &settled, 0.0);
        Ok(Self { prepared, shape })
    }
}

/// Names under which browsers are installed, in the order of search.
const BROWSERS: [&str; 6] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "microsoft-edge",
];

/// Names the browser to use, by its program.
const CHOICE: &str = "ENDLINE_BROWSER";

/// Prints an HTML file.
pub fn print_pdf(html: &Path, pdf: &Path) -> Result<(), Error> {
    let browser = browser().ok_or_else(|| {
        Error::at(
            pdf,
            format!(
                "cannot be made: no browser was found; install one of {}, name its program in {CHOICE}, or print {} from any browser",
                BROWSERS.join(", "),
                html.display()
            ),
        )
    })?;
    let failed =
        |why: String| Error::at(pdf, format!("cannot be made: {}: {why}", browser.display()));
    let whole = |path: &Path| std::path::absolute(path).map_err(|error| failed(error.to_string()));
    let (from, to) = (whole(html)?, whole(pdf)?);
    // A file from before must not pass for the new one.
    if to.exists() {
        std::fs::remove_file(&to).map_err(|error| failed(error.to_string()))?;
    }
    let mut option = OsString::from("--print-to-pdf=");
    option.push(&to);
    let mut command = Command::new(&browser);
    command.args(["--headless", "--disable-gpu", "--no-pdf-header-footer"]);
    if runs_as_root() {
        // Chromium's sandbox refuses root, as in a container; the page holds no script.
        command.arg("--no-sandbox");
    }
    command.arg(option).arg(from).stdout(Stdio::null()).stderr(Stdio::piped());
    let output = command.output().map_err(|error| failed(error.to_string()))?;
    if to.is_file() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(failed(format!("{}: {}", output.status, said.lines().last().unwrap_or("it said nothing"))))
}

/// Whether a browser is installed that [`print_pdf`] can use.
pub fn can_print() -> bool {
    browser().is_some()
}

/// The browser chosen, or the first that is installed.
fn browser() -> Option<PathBuf> {
    if let Some(chosen) = std::env::var_os(CHOICE) {
        return Some(chosen.into());
    }
    let path = std::env::var_os("PATH")?;
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    BROWSERS.iter().find_map(|name| {
        folders.iter().map(|folder| folder.join(name)).find(|program| program.is_file())
    })
}

#[cfg(unix)]
fn runs_as_root() -> bool {
    rustix::process::geteuid().is_root()
}

#[cfg(not(unix))]
fn runs_as_root() -> bool {
    false
}

/// Device in an endline with weak links between its ends, and without, as the table names them.
const DEVICES: [&str; 2] = ["SSS_Regular", "NA"];

/// The name of rope of at most 1,700 lbf in the table, and that strength [N].
const WEAK: (&str, f64) = ("1,700", 1700.0 * N_PER_LBF);

/// Tolerance of rounding for a strength [N].
const ROUNDING_N: f64 = 1e-6;

/// A row of a threat table with bands.
#[derive(Clone, Debug, Deserialize)]
struct Row {
    #[serde(rename = "Rope")]
    pub rope: String,
    #[serde(rename = "RopeDiam")]
    diameter_in: f64,
    #[serde(rename = "TrawlLen")]
    pub traps: u64,
    #[serde(rename = "BuoylineDevice")]
    pub device: String,
    #[serde(rename = "Risk")]
    pub risk: f64,
    #[serde(rename = "Risk_lo")]
    pub low: f64,
    #[serde(rename = "Risk_hi")]
    pub high: f64,
    #[serde(rename = "Risk_priors_lo")]
    pub priors_low: f64,
    #[serde(rename = "Risk_priors_hi")]
    pub priors_high: f64,
    #[serde(rename = "Risk_n")]
    pub runs: u64,
    pub how: String,
}

/// The threat of a gear from a table.
struct ThreatOfGear {
    /// The table's file.
    pub file: String,
    /// The row taken for the gear.
    pub row: Row,
    /// The greatest risk of the table, for comparison.
    pub greatest: f64,
}

impl ThreatOfGear {
    /// The row for a gear.
    pub fn find(file: &str, text: &str, gear: &RuleGear) -> Result<Self, Error> {
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
        let rows: Result<Vec<Row>, csv::Error> = reader.deserialize().collect();
        let help = "give the file with bands that `endline study threat STUDY --to FILE.csv` writes of a study whose options name rows of the table of 2019, such as `threat`: FILE-bands.csv";
        let rows = rows.map_err(|error| at_line(file, text, &error, help))?;
        let failed = |message: String| Error::Message(format!("{file}: {message}"));
        let endline = gear.endline().ok_or_else(|| {
            failed(format!("{} has no endline to find in the table", gear.assembly))
        })?;
        let device = DEVICES[usize::from(!endline.has_sleeves)];
        let is_weak = endline.rated_n <= WEAK.1 + ROUNDING_N && !endline.has_sleeves;
        let diameter_in = endline.diameter_m / METRES_PER_INCH;
        let apart = |row: &Row| {
            let rope = if (row.rope == WEAK.0) == is_weak { 0.0 } else { 1.0 };
            let traps = (row.traps as f64 - gear.traps() as f64).abs();
            [rope, (row.diameter_in - diameter_in).abs(), traps]
        };
        let greatest = rows.iter().map(|row| row.risk).fold(0.0, f64::max);
        let row = rows
            .into_iter()
            .filter(|row| row.device == device)
            .min_by(|one, other| {
                let pairs = apart(one).into_iter().zip(apart(other));
                pairs
                    .map(|(a, b)| a.total_cmp(&b))
                    .find(|order| order.is_ne())
                    .unwrap_or(std::cmp::Ordering::Equal)
            })
            .ok_or_else(|| failed(format!("has no row of device {device}")))?;
        Ok(Self { file: file.to_owned(), row, greatest })
    }
}

//! The compliance sheet: one page on a gear for a hearing, readable in black and white.
//!
//! It shows the gear at slack and at running tide (`drawing.rs`), what it is made of and what each part delivers, the verdict on every
//! rule, what hauling it takes, the threat of its endline from a simulated table (`threat.rs`), and what is not known. Its hash is that of everything the
//! model at running tide is made from, so that the same command makes the same page. The page is HTML (`page.rs`); an
//! installed browser prints it as PDF (`pdf.rs`). Several gears stand beside each other on a page of their own (`comparison.rs`).

mod comparison;
mod drawing;
mod page;
pub mod pdf;
mod threat;

use std::path::{Path, PathBuf};

use endline_gear::{Library, Sources};
use endline_sim::settle;

use crate::error::Error;
use crate::haul::{HaulRequest, HaulSheet, haul_of};
use crate::plugins::PluginHost;
use crate::rules::{Fishing, Packs, RuleGear, RuleSheet, check, of_library};
use crate::settled::SettledShape;
use crate::source::assembly::library_of;
use crate::source::{Overrides, Prepared, Source};
use crate::statics::preview::{TrialGear, TrialSea, alone};

pub use comparison::comparison;
use threat::ThreatOfGear;

/// The sea that a preview is laid into: whatever the site, depth and current are the request's.
const SEA: &str = "format = 1\nkind = \"scenario\"\nname = \"compliance sheet\"\nduration = \"1 s\"\nstrength_scatter = false\n\
    [current]\nspeed = \"0 m/s\"\ntoward = \"90 deg\"\n";

/// Speed of the running tide where none is given [m/s]: a shallow bay at its strongest, as the preview of an assembly begins.
pub const USUAL_TIDE_M_S: f64 = 0.25;

/// What a sheet is asked for.
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
    id: String,
    name: String,
    notes: String,
    /// Name of the area.
    area: String,
    fishing: Fishing,
    tide_m_s: f64,
    rules: RuleSheet,
    /// At slack and at running tide.
    rest: [AtRest; 2],
    /// What hauling it takes, or why it cannot be hauled.
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
    ///
    /// # Errors
    /// Every located error of assembly, library, packs and threat table; gear that finds no rest.
    pub fn of(request: &Request<'_>, packs: &Packs, host: &PluginHost) -> Result<Self, Error> {
        let Request { assembly: id, sources, fishing, tide_m_s, threat } = request;
        let library = library_of(id, sources)?;
        let gear = of_library(id, fishing.depth_m, &library, host)?;
        let at_rest = |current_m_s| -> Result<AtRest, Error> {
            let sea = TrialSea {
                depth: Some(format!("{} m", gear.depth_m)),
                current_m_s: Some(current_m_s),
            };
            let source = Source {
                scenario_name: (*id).to_owned(),
                scenario: alone(SEA, &TrialGear::Assembly((*id).to_owned()), &sea, &library)?,
                library: (*sources).clone(),
                overrides: Overrides::default(),
            };
            AtRest::of(source.prepare(host)?)
        };
        let haul = HaulRequest {
            depth_m: Some(gear.depth_m),
            tide_m_s: Some(*tide_m_s),
            traps: fishing.traps,
            ..HaulRequest::default()
        };
        let (name, notes) = named(id, &library);
        Ok(Self {
            rules: check(&gear, packs, fishing)?,
            rest: [at_rest(0.0)?, at_rest(*tide_m_s)?],
            haul: haul_of(id, &haul, &library, host),
            threat: threat_of(threat.as_deref(), &gear)?,
            area: packs.area_name(&fishing.area),
            fishing: fishing.clone(),
            tide_m_s: *tide_m_s,
            id: (*id).to_owned(),
            name,
            notes,
        })
    }

    /// Id of the assembly.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.id
    }

    /// The page.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn html(&self) -> Result<String, Error> {
        page::html(self).map_err(|error| Error::Message(format!("the sheet: {error}")))
    }

    /// BLAKE3 of everything the model at running tide is made from, hexadecimal.
    #[must_use]
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

/// Name and notes of an assembly.
fn named(id: &str, library: &Library) -> (String, String) {
    let found = library.assemblies.iter().find(|assembly| assembly.entry.id == id);
    found.map_or((id.to_owned(), String::new()), |assembly| {
        (assembly.entry.name.clone(), assembly.entry.notes.clone())
    })
}

fn threat_of(file: Option<&Path>, gear: &RuleGear) -> Result<Option<ThreatOfGear>, Error> {
    let Some(file) = file else { return Ok(None) };
    let text = endline_gear::read::text(file)
        .map_err(|error| Error::at(file, format!("cannot be read: {error}")))?;
    ThreatOfGear::find(&file.display().to_string(), &text, gear).map(Some)
}

#[cfg(test)]
mod tests;

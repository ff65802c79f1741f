//! Gear at rest without a run: settled while it is edited.
//!
//! The sea is a scenario's. The whale of the scenario is left out. Of an assembly, lines and bodies that belong to none are left
//! out too; where it is the scenario's only gear, the scenario's settings of it apply. A scenario made of parts of its own is previewed with these.
//!
//! | module | content |
//! |---|---|
//! | [`sweep`] | one gear over depths of water and currents |
//! | [`worker`] | previews on a thread of their own |

pub mod sweep;
pub mod worker;

use std::sync::Arc;
use std::time::Instant;

use endline_gear::{
    Assembled, Diagnostic, Document, EditError, Library, Options, Scenario, Setting,
    assemble_traced,
};
use endline_sim::model::ModelError;
use endline_sim::{Frame, Model, settle};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::settled::SettledShape;

pub use worker::{StaticsWorker, Trial};

/// Tables of a scenario that a preview does not use.
const LEFT_OUT: [&str; 12] = [
    "whale",
    "friction",
    "probe",
    "resolution",
    "waves",
    "start",
    "bodies_on_whale",
    "bodies_on_bodies",
    "rope_nodes",
    "segment",
    "segments",
    "step",
];

/// Tables of a scenario's own parts, which a preview of an assembly does not use.
const OWN: [&str; 7] = ["line", "fixture", "body", "joint", "link", "obstacle", "rope"];

/// Whose gear is previewed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TrialGear {
    /// An assembly of the library, by its id.
    Assembly(String),
    /// The parts that the scenario has of its own.
    Own,
}

impl TrialGear {
    /// Its name in messages.
    pub fn name(&self) -> &str {
        match self {
            Self::Assembly(id) => id,
            Self::Own => "scenario",
        }
    }
}

/// The sea of a preview, where it differs from the scenario's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrialSea {
    /// Depth in place of the scenario's, with its unit.
    pub depth: Option<String>,
    /// Surface speed of the current in place of the scenario's [m/s].
    pub current_m_s: Option<f64>,
}

/// A rig at rest, with its model.
#[derive(Clone)]
pub struct RigAtRest {
    /// Shape, tensions, residual.
    pub shape: SettledShape,
    /// Ropes, bodies and links of the rig.
    pub model: Arc<Model>,
    /// The rig at rest, for drawing.
    pub frame: Arc<Frame>,
}

/// The text of a scenario that holds one gear alone, in the sea of `scenario` changed by `sea`.
pub fn alone(
    scenario: &str,
    gear: &TrialGear,
    sea: &TrialSea,
    library: &Library,
) -> Result<String, Error> {
    let failed = |error: EditError| Diagnostic::of_file("scenario", error.message, "");
    let mut document = Document::parse(scenario).map_err(failed)?;
    let toward = document.get("current.toward").unwrap_or_else(|| "90 deg".to_owned());
    let strip = |document: &mut Document, key: &str| {
        // A key that is missing needs no removing.
        let _ = document.remove(key);
    };
    LEFT_OUT.iter().for_each(|key| strip(&mut document, key));
    let mut settings = vec![("segment", "1 m".to_owned())];
    if let Some(speed) = sea.current_m_s {
        strip(&mut document, "current");
        settings.push(("current.speed", format!("{speed} m/s")));
        settings.push(("current.toward", toward.clone()));
    }
    if !document.has("site") {
        let site = library.sites.first().map_or("", |site| site.entry.id.as_str());
        settings.push(("site.item", site.to_owned()));
    }
    settings.extend(sea.depth.iter().map(|depth| ("site.depth", depth.clone())));
    if let TrialGear::Assembly(assembly) = gear {
        OWN.iter().for_each(|key| strip(&mut document, key));
        let only =
            document.get("gear.0.assembly").as_ref() == Some(assembly) && !document.has("gear.1");
        strip(&mut document, "field");
        if !only {
            strip(&mut document, "gear");
            settings.push(("gear.0.assembly", assembly.clone()));
            settings.push(("gear.0.heading", toward));
        }
    }
    for (field, text) in settings {
        let put = document.put(field, &Setting::text(&text));
        put.map_err(failed)?;
    }
    Ok(document.text())
}

/// Assembles the gear of a scenario's text and settles it.
pub fn settled(
    name: &str,
    text: &str,
    library: &Library,
    host: &PluginHost,
) -> Result<RigAtRest, Error> {
    let scenario = Scenario::read(name, text)?;
    let Assembled { spec, strengths, .. } =
        assemble_traced(&scenario, library, host, &Options::default())?;
    let located = |error: ModelError| {
        Diagnostic::of_file(name, format!("{}: {}", error.part, error.message), "")
    };
    let model = Model::new(spec)
        .map_err(|errors| Error::Diagnostics(errors.into_iter().map(located).collect()))?;
    let start = Instant::now();
    let settled = settle(&model);
    let shape =
        SettledShape::named(name, &model, &strengths, &settled, start.elapsed().as_secs_f64());
    let frame = Arc::new(Frame::of(&settled.state, &[], &[]));
    Ok(RigAtRest { shape, model: Arc::new(model), frame })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENARIO: &str = "format = 1\nkind = \"scenario\"\nname = \"s\"\nduration = \"1 s\"\n# the sea\n[site]\nitem = \"bay\"\n\n\
        [current]\nspeed = \"1 kn\"\ntoward = \"45 deg\"\n\n[[gear]]\nassembly = \"single\"\n\n[whale]\nlength = \"9 m\"\n";

    fn assembly(id: &str) -> TrialGear {
        TrialGear::Assembly(id.to_owned())
    }

    #[test]
    fn a_scenarios_own_parts_stay_without_the_whale() {
        let own = SCENARIO.replace("[[gear]]\nassembly = \"single\"", "[[line]]\nid = \"endline\"");
        let library = Library::default();
        let kept = alone(&own, &TrialGear::Own, &TrialSea::default(), &library).unwrap();
        assert!(kept.contains("endline") && !kept.contains("whale"), "{kept}");
        let other = alone(&own, &assembly("pair"), &TrialSea::default(), &library).unwrap();
        assert!(other.contains("pair") && !other.contains("endline"), "{other}");
    }

    #[test]
    fn the_whale_goes_and_the_sea_is_what_is_asked_for() {
        let sea = TrialSea { depth: Some("40 fathom".to_owned()), current_m_s: Some(0.0) };
        let text = alone(SCENARIO, &assembly("single"), &sea, &Library::default()).unwrap();
        assert!(!text.contains("whale") && text.contains("# the sea"), "{text}");
        let document = Document::parse(&text).unwrap();
        let field = |name: &str| document.get(name).unwrap_or_default();
        assert_eq!(
            [field("site.depth"), field("current.speed"), field("current.toward")],
            ["40 fathom", "0 m/s", "45 deg"]
        );
        assert_eq!(field("gear.0.assembly"), "single");
    }

    #[test]
    fn another_assembly_takes_the_place_of_all_gear() {
        let two = format!("{SCENARIO}\n[[gear]]\nassembly = \"pair\"\nid = \"b\"\n");
        let document = Document::parse(
            &alone(&two, &assembly("trawl-10"), &TrialSea::default(), &Library::default()).unwrap(),
        )
        .unwrap();
        assert_eq!(document.get("gear.0.assembly").as_deref(), Some("trawl-10"));
        assert!(!document.has("gear.1"));
        assert_eq!(
            document.get("current.speed").as_deref(),
            Some("1 kn"),
            "the scenario's own current stays"
        );
    }
}

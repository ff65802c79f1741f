//! Edits that may bring a rule to pass. Each kind of edit is a lever; its tiers are tried from the least edit on.
//!
//! | module | changes |
//! |---|---|
//! | `inserts` | weak inserts and sleeves along an endline |
//! | `ropes` | ropes and lengths of lines, the weak link at the buoy |
//! | `endlines` | the numbers of endlines, high-flyers, floats and traps |
//! | [`Scene`] | the gear, its file and the rule |

mod endlines;
mod inserts;
mod ropes;

use std::sync::Arc;

use endline_gear::units::{Quantity, parse};
use endline_gear::{Document, Library, Rule, Subject};
use endline_sdk::{Attribute, AttributeKind, GearType};

use super::super::gear::{Endline, Gear, Piece};
use super::super::sheet::Fishing;
use super::super::verdict::RuleResult;
use super::demand::{self, Demand};
use super::trials::{Candidate, CandidateTrials, Tried};
use crate::edit::assembly::ids;

pub(super) use inserts::usual as usual_inserts;

/// Edits of one kind, tier by tier: a later tier is tried where no edit of an earlier one serves.
pub(super) type Lever = Vec<Vec<Candidate>>;

/// Every lever for the demands of a rule that fails.
pub(super) fn levers(scene: &Scene<'_>) -> Vec<Lever> {
    let mut levers = vec![inserts::at_places(scene)];
    levers.extend(scene.demands.iter().flat_map(|demand| for_demand(scene, demand)));
    levers.retain(|lever| lever.iter().any(|tier| !tier.is_empty()));
    levers
}

fn for_demand(scene: &Scene<'_>, demand: &Demand) -> Vec<Lever> {
    match demand {
        // Places are put in together, for a rule may ask for several.
        Demand::WeakAt { strength_n, .. } | Demand::WeakOver { strength_n, .. } => {
            vec![ropes::weak(scene, *strength_n)]
        }
        Demand::WeakEvery { spacing, top, strength_n } => {
            vec![inserts::every(scene, spacing, *top, *strength_n)]
        }
        Demand::WeakBelow { clear } => vec![inserts::moved_down(scene, clear)],
        Demand::Fact { name, at_most, limit } => {
            let Some(limit) = limit else { return without_limit(scene, name) };
            match (*name, at_most) {
                ("least_rated" | "least_delivered", true) => {
                    vec![inserts::one(scene, limit.si), ropes::weak(scene, limit.si)]
                }
                ("greatest_rated", true) => vec![ropes::weak(scene, limit.si)],
                ("least_new", true) => {
                    vec![inserts::of_other_strength(scene), ropes::weak(scene, limit.si)]
                }
                ("diameter" | "groundline_diameter", true) => vec![ropes::thin(scene, limit.si)],
                (
                    "top_density"
                    | "least_density"
                    | "groundline_density"
                    | "groundline_least_density",
                    false,
                ) => {
                    vec![ropes::sinking(scene, limit.si)]
                }
                ("sinking_share", false) => vec![ropes::sinking(scene, ropes::SEA_WATER_KG_M3)],
                ("insert_length", false) => vec![inserts::longer(scene, limit)],
                ("buoy_link", true) => vec![ropes::at_buoy(scene, limit.si)],
                ("traps", false) => vec![endlines::traps_added(scene, limit.si)],
                ("endlines", true) => vec![endlines::taken_off(scene, limit.si)],
                ("groundline_floats", true) => vec![endlines::without_floats(scene)],
                ("surface_line", true) => vec![ropes::of_surface_line(scene, limit)],
                ("line_length", true) => vec![ropes::of_endline(scene, limit.si)],
                ("trawl_length" | "groundline_longest" | "groundline_length", true) => {
                    vec![
                        ropes::of_trawl(scene, limit.si),
                        endlines::traps_taken_off(scene, limit.si),
                    ]
                }
                _ => Vec::new(),
            }
        }
    }
}

/// Levers for a fact that is not compared with one number.
fn without_limit(scene: &Scene<'_>, fact: &str) -> Vec<Lever> {
    match fact {
        "least_new" => vec![inserts::of_other_strength(scene)],
        "radar_reflectors" => vec![endlines::with_reflectors(scene)],
        _ => Vec::new(),
    }
}

/// Gear type of a trawl, for gear that needs more traps.
const TRAWL: &str = "org.endline.gear.trawl";

/// The gear, its file and the rule that proposals use.
pub(super) struct Scene<'a> {
    /// The assembly's file.
    pub document: &'a Document,
    /// The gear as assembled.
    pub gear: &'a Gear,
    /// The items that gear is made of.
    pub library: &'a Library,
    /// Where, when and how it is fished.
    pub fishing: &'a Fishing,
    /// The demands of the rule's check.
    pub demands: Vec<Demand>,
    /// The gear type that builds it, where one does.
    pub gear_type: Option<Arc<dyn GearType>>,
    /// The gear type of trawls, where it is among the plugins.
    pub trawl: Option<Arc<dyn GearType>>,
    rule: &'a Rule,
    failing: Vec<&'a str>,
}

/// A line of an endline: where it lies along the endline, and how its file is reached.
#[derive(Clone, Debug)]
pub(super) struct OfEndline {
    /// Id of the line.
    pub line: String,
    /// From the buoy to its upper end [m].
    pub start_m: f64,
    /// Its length [m].
    pub length_m: f64,
    /// Whether its end `to` is the upper one.
    pub from_to: bool,
    /// Id of its own rope.
    pub rope: String,
}

impl<'a> Scene<'a> {
    pub fn new(
        document: &'a Document,
        tried: &'a Tried,
        trials: &CandidateTrials<'a>,
        rule: &'a Rule,
        result: &'a RuleResult,
    ) -> Self {
        let gear_type = document.get("gear_type").and_then(|id| trials.host.gear(&id));
        Self {
            document,
            gear: &tried.gear,
            library: &tried.library,
            fishing: trials.fishing,
            demands: demand::of(rule),
            gear_type,
            trawl: trials.host.gear(TRAWL),
            rule,
            failing: result.measured.iter().map(|one| one.line.as_str()).collect(),
        }
    }

    /// Why there is no candidate.
    pub fn why_none(&self) -> String {
        let counts_traps = |demand: &Demand| matches!(demand, Demand::Fact { name: "traps", .. });
        if self.fishing.traps.is_some() && self.demands.iter().any(counts_traps) {
            return "the number of traps is given by the call and not by the assembly".to_owned();
        }
        format!(
            "no edit of an assembly is known that changes what `{}` measures",
            self.rule.check.value
        )
    }

    /// Endlines on which the rule fails; one of them where one is enough.
    pub fn endlines(&self) -> Vec<&'a Endline> {
        let fails = |endline: &&Endline| {
            self.failing.contains(&endline.id.as_str()) || self.rule.subject == Subject::Gear
        };
        let most = if self.rule.subject == Subject::AnyEndline { 1 } else { usize::MAX };
        self.gear.endlines.iter().filter(fails).take(most).collect()
    }

    /// The lines of an endline from the buoy down, pieces of one line taken together.
    pub fn lines(endline: &Endline) -> Vec<OfEndline> {
        let (mut lines, mut at_m) = (Vec::<OfEndline>::new(), 0.0);
        for piece in endline.pieces.iter().filter(|piece| piece.length_m > 0.0) {
            match lines.last_mut().filter(|last| last.line == piece.line) {
                Some(last) => last.length_m += piece.length_m,
                None => lines.push(OfEndline {
                    line: piece.line.clone(),
                    start_m: at_m,
                    length_m: piece.length_m,
                    from_to: piece.from_to,
                    rope: piece.item.clone(),
                }),
            }
            let own = lines.last_mut().filter(|_| !piece.id.contains(".insert-"));
            own.into_iter().for_each(|last| last.rope.clone_from(&piece.item));
            at_m += piece.length_m;
        }
        lines
    }

    /// Lines that the rule is about: those of its endlines, or groundlines.
    pub fn lines_of_rule(&self) -> Vec<String> {
        let of_endlines = self.endlines().into_iter().flat_map(|endline| &endline.pieces);
        let own = |piece: &&Piece| {
            self.rule.subject == Subject::Gear || self.failing.contains(&piece.id.as_str())
        };
        let of_ground = self.gear.groundlines.iter().filter(own);
        let mut lines: Vec<String> =
            of_endlines.chain(of_ground).map(|piece| piece.line.clone()).collect();
        lines.sort();
        lines.dedup();
        lines
    }

    /// Where the file says how a line is made up: `line.2`, or `lines.endline-top` of gear that a gear type builds.
    pub fn make_of(&self, line: &str) -> Option<String> {
        make_of(self.document, line)
    }

    /// Path of a part by its id, such as `line.2`.
    pub fn place_in(&self, list: &str, id: &str) -> Option<String> {
        place_in(self.document, list, id)
    }

    /// A declared attribute of the gear type.
    pub fn attribute(&self, key: &str) -> Option<&Attribute> {
        self.gear_type.as_ref()?.descriptor().attributes.iter().find(|one| one.key == key)
    }

    /// Attributes of the gear type that name an item of a folder, with the item in use.
    pub fn items_of(&self, folder: &str) -> Vec<(String, String)> {
        let attributes = self.gear_type.iter().flat_map(|gear| &gear.descriptor().attributes);
        let item = |attribute: &Attribute| match &attribute.kind {
            AttributeKind::Item { library, default } if library == folder => {
                let given = self.document.get(&format!("attributes.{}", attribute.key));
                Some((attribute.key.to_string(), given.unwrap_or_else(|| default.to_string())))
            }
            _ => None,
        };
        attributes.filter_map(item).collect()
    }

    /// A number of an attribute in SI units, as given or as the gear type has it.
    pub fn number(&self, key: &str, quantity: Quantity) -> Option<f64> {
        let AttributeKind::Number { default, .. } = self.attribute(key)?.kind else { return None };
        let given = self.document.get(&format!("attributes.{key}"));
        Some(given.and_then(|text| parse(&text, quantity).ok()).unwrap_or(default))
    }
}

/// Where an assembly's file says how a line is made up.
fn make_of(document: &Document, line: &str) -> Option<String> {
    if document.has("gear_type") {
        return Some(format!("lines.{line}"));
    }
    place_in(document, "line", line)
}

fn place_in(document: &Document, list: &str, id: &str) -> Option<String> {
    let index = ids(document, list).iter().position(|known| known == id)?;
    Some(format!("{list}.{index}"))
}

/// A length as a file has it, to the centimetre.
fn metres(length_m: f64) -> String {
    format!("{} m", written(length_m))
}

/// A number to two decimals, without zeros at its end.
fn written(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

//! Facts measured on gear.

use endline_gear::units::Quantity;

use super::facts::{About, Fact};
use super::fishing::Fishing;
use super::gear::{Endline, Gear, Piece};
use super::makeup::{MadeUp, Stretch};
use super::value::Value;

/// Sea water that rope sinks in [kg/m³].
const SEA_WATER_KG_M3: f64 = 1025.0;

/// One thing that a rule is checked on.
#[derive(Clone, Copy)]
pub(super) enum Part<'a> {
    /// The gear as a whole.
    Gear,
    /// An endline.
    Endline(&'a Endline),
    /// A groundline.
    Groundline(&'a Piece),
}

impl Part<'_> {
    /// Its id; empty for the gear.
    pub fn id(&self) -> &str {
        match self {
            Self::Gear => "",
            Self::Endline(endline) => &endline.id,
            Self::Groundline(piece) => &piece.id,
        }
    }
}

/// The value of a fact.
pub(super) fn value(fact: &Fact, gear: &Gear, part: Part<'_>, fishing: &Fishing) -> Value {
    let value = match (fact.about, part) {
        (About::Fishing, _) => of_fishing(fact, fishing),
        (About::Gear, _) => of_gear(fact.name, gear, fishing),
        (About::Endline, Part::Endline(endline)) => of_endline(fact.name, endline),
        (About::Groundline, Part::Groundline(piece)) => of_groundline(fact.name, piece),
        _ => None,
    };
    let why = || format!("an assembly does not say: {}", fact.help);
    value.unwrap_or_else(|| Value::Unknown { kind: fact.kind, why: why() })
}

fn of_fishing(fact: &Fact, fishing: &Fishing) -> Option<Value> {
    let known = if fact.name == "depth" { fishing.depth_m } else { fishing.distance_m };
    let missing = || format!("needs --{}", fact.name);
    let unknown = || Value::Unknown { kind: fact.kind, why: missing() };
    Some(known.map_or_else(unknown, |length| Value::measure(length, Quantity::Length)))
}

#[expect(clippy::cast_precision_loss, reason = "counts of gear")]
fn of_gear(name: &str, gear: &Gear, fishing: &Fishing) -> Option<Value> {
    let lines = || gear.groundlines.iter();
    Some(match name {
        "traps" => Value::count(fishing.traps.map_or(gear.traps as f64, f64::from)),
        "endlines" => Value::count(gear.endlines.len() as f64),
        "stowed" => Value::truth(gear.stowed),
        "groundlines" => Value::count(gear.groundlines.len() as f64),
        "groundline_longest" => length(lines().map(|line| line.length_m).fold(0.0, f64::max)),
        "groundline_least_density" => density(least(lines().map(|line| line.density_kg_m3))),
        "trawl_length" => length(lines().map(|line| line.length_m).sum()),
        "groundline_floats" => Value::count(gear.floats.len() as f64),
        "surface_line" => length(gear.surface_m.iter().copied().fold(0.0, f64::max)),
        "radar_reflectors" => Value::count(gear.reflectors as f64),
        _ => return None,
    })
}

#[expect(clippy::cast_precision_loss, reason = "counts of gear")]
fn of_endline(name: &str, endline: &Endline) -> Option<Value> {
    let all = || endline.pieces.iter();
    let rope = || all().filter(|piece| piece.length_m > 0.0);
    let inserts = || all().filter(|piece| piece.id.contains(".insert-"));
    Some(match name {
        "line" => Value::Line(made_up(endline)),
        "line_length" => length(all().map(|piece| piece.length_m).sum()),
        "diameter" => length(rope().map(|piece| piece.diameter_m).fold(0.0, f64::max)),
        "least_rated" => force(least(all().map(|piece| piece.rated_n))),
        "greatest_rated" => force(rope().map(|piece| piece.rated_n).fold(0.0, f64::max)),
        "least_new" => force(least(all().map(|piece| piece.new_n))),
        "least_delivered" => force(least(all().map(|piece| piece.delivered_n))),
        "least_density" => density(least(rope().map(|piece| piece.density_kg_m3))),
        "top_density" => density(rope().next().map_or(f64::INFINITY, |top| top.density_kg_m3)),
        "sinking_share" => Value::count(sinking_share(endline)),
        "inserts" => Value::count(inserts().count() as f64),
        "insert_length" => length(least(inserts().map(|piece| piece.length_m))),
        "buoy_link" => force(endline.buoy_link_n.unwrap_or(f64::INFINITY)),
        _ => return None,
    })
}

fn of_groundline(name: &str, piece: &Piece) -> Option<Value> {
    Some(match name {
        "groundline_length" => length(piece.length_m),
        "groundline_density" => density(piece.density_kg_m3),
        "groundline_diameter" => length(piece.diameter_m),
        _ => return None,
    })
}

fn made_up(endline: &Endline) -> MadeUp {
    let stretch = |piece: &Piece| Stretch { length_m: piece.length_m, rated_n: piece.rated_n };
    MadeUp { pieces: endline.pieces.iter().map(stretch).collect() }
}

fn sinking_share(endline: &Endline) -> f64 {
    let total: f64 = endline.pieces.iter().map(|piece| piece.length_m).sum();
    let sinks = endline.pieces.iter().filter(|piece| piece.density_kg_m3 > SEA_WATER_KG_M3);
    sinks.map(|piece| piece.length_m).sum::<f64>() / total
}

fn least(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::INFINITY, f64::min)
}

fn length(si: f64) -> Value {
    Value::measure(si, Quantity::Length)
}

fn force(si: f64) -> Value {
    Value::measure(si, Quantity::Force)
}

fn density(si: f64) -> Value {
    Value::measure(si, Quantity::Density)
}

/// Whether a value is what its fact declares; a test asks for every fact.
#[cfg(test)]
pub(super) fn fits(fact: &Fact, value: &Value) -> bool {
    value.kind() == Some(fact.kind)
}

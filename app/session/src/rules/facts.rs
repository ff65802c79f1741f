//! The facts that an expression may use, declared once and measured on gear. docs/rules.md has this list.

use endline_gear::Subject;
use endline_gear::units::Quantity;

use super::gear::{Endline, Gear, Piece};
use super::sheet::Fishing;
use super::value::{Kind, MadeUp, Stretch, Value};

/// The subject of a fact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    /// Where and when gear is fished, as the user states it.
    Fishing,
    /// The gear as a whole.
    Gear,
    /// One endline.
    Endline,
    /// One groundline.
    Groundline,
    /// Not described by an assembly: never known.
    Unsaid,
}

/// A fact.
#[derive(Clone, Copy, Debug)]
pub struct Fact {
    /// Its name in expressions.
    pub name: &'static str,
    /// Its name.
    pub kind: Kind,
    /// Its subject.
    pub about: About,
    /// Its meaning.
    pub help: &'static str,
}

const fn fact(name: &'static str, kind: Kind, about: About, help: &'static str) -> Fact {
    Fact { name, kind, about, help }
}

const COUNT: Kind = Kind::Number(Quantity::Ratio);
const LENGTH: Kind = Kind::Number(Quantity::Length);
const FORCE: Kind = Kind::Number(Quantity::Force);
const DENSITY: Kind = Kind::Number(Quantity::Density);
const TIME: Kind = Kind::Number(Quantity::Time);

/// The fact by which a rule names gillnets.
pub(super) const NETTING: &str = "netting_lines";

/// Every fact.
pub static FACTS: &[Fact] = &[
    fact("depth", LENGTH, About::Fishing, "depth of the water, `--depth`"),
    fact("distance", LENGTH, About::Fishing, "distance from shore, `--distance`"),
    fact("traps", COUNT, About::Gear, "traps on one set, counted, or `--traps`"),
    fact("endlines", COUNT, About::Gear, "lines from a buoy to the gear on the seabed"),
    fact(
        "stowed",
        Kind::Truth,
        About::Gear,
        "whether a release holds the endline down until it is called",
    ),
    fact("groundlines", COUNT, About::Gear, "lines on the seabed, without gangions and bridles"),
    fact("groundline_longest", LENGTH, About::Gear, "longest groundline, 0 if there is none"),
    fact(
        "groundline_least_density",
        DENSITY,
        About::Gear,
        "density of the lightest groundline, none without a groundline",
    ),
    fact("trawl_length", LENGTH, About::Gear, "length of all groundlines"),
    fact(
        "groundline_floats",
        COUNT,
        About::Gear,
        "buoys in the lower half of the water, or on no line to the gear",
    ),
    fact("surface_line", LENGTH, About::Gear, "longest line between two buoys, 0 if there is none"),
    fact("radar_reflectors", COUNT, About::Gear, "buoys with a piece named radar reflector"),
    fact(NETTING, COUNT, About::Gear, "lines of netting of a gillnet, 0 for trap gear"),
    fact("line", Kind::Line, About::Endline, "the endline from the buoy down, for functions"),
    fact("line_length", LENGTH, About::Endline, "its length"),
    fact("diameter", LENGTH, About::Endline, "its greatest diameter"),
    fact(
        "least_rated",
        FORCE,
        About::Endline,
        "strength of its weakest rope, insert, sleeve or weak place, when new, by its source",
    ),
    fact(
        "greatest_rated",
        FORCE,
        About::Endline,
        "strength of its strongest rope, when new, by its source",
    ),
    fact("least_new", FORCE, About::Endline, "mean strength of new pieces at the weakest place"),
    fact(
        "least_delivered",
        FORCE,
        About::Endline,
        "mean strength delivered at the weakest place, after wear, knots and splices",
    ),
    fact("least_density", DENSITY, About::Endline, "density of its lightest rope"),
    fact("top_density", DENSITY, About::Endline, "density of the rope at the buoy"),
    fact(
        "sinking_share",
        COUNT,
        About::Endline,
        "share of its length that is denser than sea water of 1,025 kg/m3",
    ),
    fact("inserts", COUNT, About::Endline, "inserts of another rope in it"),
    fact("insert_length", LENGTH, About::Endline, "its shortest insert, none without inserts"),
    fact(
        "buoy_link",
        FORCE,
        About::Endline,
        "rating of the weak link at the buoy, none without a link",
    ),
    fact("groundline_length", LENGTH, About::Groundline, "its length"),
    fact("groundline_density", DENSITY, About::Groundline, "its density"),
    fact("groundline_diameter", LENGTH, About::Groundline, "its diameter"),
    fact("marks", COUNT, About::Unsaid, "colour marks on an endline"),
    fact("mark_length", LENGTH, About::Unsaid, "length of the shortest mark"),
    fact("mark_spacing", LENGTH, About::Unsaid, "longest stretch of endline without a mark"),
    fact("surface_marks", COUNT, About::Unsaid, "colour marks in the surface system"),
    fact(
        "contrasting",
        Kind::Truth,
        About::Unsaid,
        "whether weak inserts contrast in colour with their line",
    ),
    fact(
        "joined_as_approved",
        Kind::Truth,
        About::Unsaid,
        "whether inserts are joined by tuck, splice or sleeve, three-strand rope without knots",
    ),
    fact("braided", Kind::Truth, About::Unsaid, "whether the weak rope is a braid"),
    fact("soak", TIME, About::Unsaid, "time between two hauls"),
];

/// The facts that a rule about a subject may use.
pub(super) fn of_subject(subject: Subject) -> impl Iterator<Item = &'static Fact> {
    FACTS.iter().filter(move |fact| match fact.about {
        About::Fishing | About::Gear | About::Unsaid => true,
        About::Endline => matches!(subject, Subject::EveryEndline | Subject::AnyEndline),
        About::Groundline => subject == Subject::EveryGroundline,
    })
}

/// Sea water that rope sinks in [kg/m³].
const SEA_WATER_KG_M3: f64 = 1025.0;

/// A part of the gear on which a rule is checked.
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

    /// Its name in messages; empty for the gear.
    pub fn name(&self) -> String {
        match self {
            Self::Endline(endline) => endline.name(),
            Self::Gear | Self::Groundline(_) => self.id().to_owned(),
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

/// Why a value of the fishing is unknown: the option that gives it.
pub(super) fn needs(name: &str) -> String {
    format!("{NEEDS}{name}")
}

/// The values of the fishing that a reason asks for (see [`needs`]), such as `distance`.
pub(super) fn needed(why: &str) -> impl Iterator<Item = &str> {
    why.split("; ").filter_map(|reason| reason.strip_prefix(NEEDS))
}

const NEEDS: &str = "needs --";

fn of_fishing(fact: &Fact, fishing: &Fishing) -> Option<Value> {
    let known = if fact.name == "depth" { fishing.depth_m } else { fishing.distance_m };
    let missing = || needs(fact.name);
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
        "groundline_longest" => greatest(lines(), |line| line.length_m, Quantity::Length),
        "groundline_least_density" => least(lines(), |line| line.density_kg_m3, Quantity::Density),
        "trawl_length" => length(lines().map(|line| line.length_m).sum()),
        "groundline_floats" => Value::count(gear.floats.len() as f64),
        "surface_line" => length(gear.surface_m.iter().copied().fold(0.0, f64::max)),
        NETTING => Value::count(gear.netting_lines as f64),
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
        "diameter" => greatest(rope(), |piece| piece.diameter_m, Quantity::Length),
        "least_rated" => least(all(), |piece| piece.rated_n, Quantity::Force),
        "greatest_rated" => greatest(rope(), |piece| piece.rated_n, Quantity::Force),
        "least_new" => least(all(), |piece| piece.new_n, Quantity::Force),
        "least_delivered" => least(all(), |piece| piece.delivered_n, Quantity::Force),
        "least_density" => least(rope(), |piece| piece.density_kg_m3, Quantity::Density),
        "top_density" => least(rope().take(1), |piece| piece.density_kg_m3, Quantity::Density),
        "sinking_share" => Value::count(sinking_share(endline)),
        "inserts" => Value::count(inserts().count() as f64),
        "insert_length" => least(inserts(), |piece| piece.length_m, Quantity::Length),
        "buoy_link" => match &endline.buoy_link {
            Some((id, rated_n)) => Value::measure_of(id, *rated_n, Quantity::Force),
            None => Value::measure(f64::INFINITY, Quantity::Force),
        },
        _ => return None,
    })
}

fn of_groundline(name: &str, piece: &Piece) -> Option<Value> {
    Some(match name {
        "groundline_length" => length(piece.length_m),
        "groundline_density" => Value::measure(piece.density_kg_m3, Quantity::Density),
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

/// The least value among pieces, with the piece that has it; infinite where there is no piece.
fn least<'a>(
    pieces: impl Iterator<Item = &'a Piece>,
    of: impl Fn(&Piece) -> f64,
    quantity: Quantity,
) -> Value {
    let piece = pieces.min_by(|one, other| of(one).total_cmp(&of(other)));
    let infinite = Value::measure(f64::INFINITY, quantity);
    piece.map_or(infinite, |piece| Value::measure_of(&piece.id, of(piece), quantity))
}

/// The greatest value among pieces, with the first piece that has it; zero where there is no piece.
fn greatest<'a>(
    pieces: impl Iterator<Item = &'a Piece>,
    of: impl Fn(&Piece) -> f64,
    quantity: Quantity,
) -> Value {
    // Reversed, because of equal values `max_by` returns the last.
    let pieces: Vec<&Piece> = pieces.collect();
    let piece = pieces.into_iter().rev().max_by(|one, other| of(one).total_cmp(&of(other)));
    let zero = Value::measure(0.0, quantity);
    piece.map_or(zero, |piece| Value::measure_of(&piece.id, of(piece), quantity))
}

fn length(si: f64) -> Value {
    Value::measure(si, Quantity::Length)
}

/// Whether a value is what its fact declares; a test asks for every fact.
#[cfg(test)]
pub(super) fn fits(fact: &Fact, value: &Value) -> bool {
    value.kind() == Some(fact.kind)
}

#[cfg(test)]
mod tests {
    use super::super::expression::begins_with_function;
    use super::*;

    #[test]
    fn each_name_is_declared_once_and_begins_with_no_function() {
        for (index, fact) in FACTS.iter().enumerate() {
            assert!(FACTS[..index].iter().all(|other| other.name != fact.name), "{}", fact.name);
            assert_eq!(begins_with_function(fact.name), None, "{}", fact.name);
        }
    }
}

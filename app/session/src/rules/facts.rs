//! The facts that an expression may use, declared once: name, kind, subject, meaning. docs/rules.md has this list.

use endline_gear::Subject;
use endline_gear::units::Quantity;

use super::value::Kind;

/// What a fact is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    /// Where and when gear is fished; given by who asks.
    Fishing,
    /// The gear as a whole.
    Gear,
    /// One endline.
    Endline,
    /// One groundline.
    Groundline,
    /// What an assembly does not say: it is never known.
    Unsaid,
}

/// A fact.
#[derive(Clone, Copy, Debug)]
pub struct Fact {
    /// Its name in expressions.
    pub name: &'static str,
    /// What it is.
    pub kind: Kind,
    /// What it is about.
    pub about: About,
    /// What it means.
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
    fact("line", Kind::Line, About::Endline, "the endline from the buoy down, for functions"),
    fact("line_length", LENGTH, About::Endline, "its length"),
    fact("diameter", LENGTH, About::Endline, "its greatest diameter"),
    fact(
        "least_rated",
        FORCE,
        About::Endline,
        "strength of its weakest rope, insert or sleeve, when new, by its source",
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

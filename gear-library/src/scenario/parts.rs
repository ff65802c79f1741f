//! Parts written into a scenario: fixtures, bodies and ropes of validation problems; probes.

use endline_sdk::LineEnd;
use endline_sim::DVec3;
use endline_sim::model::{EnergyForm, WhaleFigure};

use crate::diagnostic::At;
use crate::entry::{self, Entry};
use crate::fields::{Fields, Figure, Problems, Provenance, Range, provenance_over};
use crate::limits::{self, Limit};
use crate::schema::Kind;
use crate::tree::Node;
use crate::units::Quantity;

use super::{WrapOf, place3};

/// A point that is held, driven at a steady velocity between two times, or held and then pulled by a steady force.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixture {
    /// Id.
    pub id: At<String>,
    /// Place [m].
    pub position_m: DVec3,
    /// Velocity [m/s] and from when until when [s], where driven.
    pub drive: Option<(DVec3, f64, f64)>,
    /// Force [N] and from when on [s], where pulled.
    pub pull: Option<(DVec3, f64)>,
}

/// A body written in place: a sphere or a box with given figures, the line at its middle.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeBody {
    /// Id.
    pub id: At<String>,
    /// Whether it is drawn and reported as a buoy; else as a weight.
    pub buoy: bool,
    /// Start place [m].
    pub position_m: DVec3,
    /// Start angular velocity in the world [rad/s].
    pub spin_rad_s: DVec3,
    /// Radius [m].
    pub radius_m: f64,
    /// Half extents, where it is a box [m].
    pub half_m: Option<DVec3>,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Principal moments of inertia, where they are given [kg m²].
    pub inertia_kg_m2: Option<DVec3>,
    /// Displaced volume [m³].
    pub volume_m3: f64,
    /// Height over which it goes under evenly, if that is given [m].
    pub float_height_m: Option<f64>,
    /// Drag coefficient times area [m²].
    pub drag_area_m2: f64,
    /// Added mass as a share of the displaced water.
    pub added_mass: f64,
    /// Whether drag and added mass scale with the wet share.
    pub wetted_drag: bool,
    /// Held in place until this time [s].
    pub held_until_s: Option<f64>,
}

/// The shape a line starts in.
#[derive(Clone, Debug, PartialEq)]
pub enum LineStart {
    /// Straight between its ends.
    Straight,
    /// The elastic catenary between its ends under its weight in air, for a run that starts held.
    Catenary,
    /// Round a cylinder.
    Around {
        /// Id of the obstacle.
        obstacle: At<String>,
        /// How often round; below zero is left-handed about its axis.
        turns: f64,
        /// Whether two turns cross over themselves to two half hitches.
        hitched: bool,
    },
    /// Wrapped about the whale, wrap by wrap from its `from` end.
    Wrapped(Vec<WrapOf>),
}

/// A probe as written.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeOf {
    /// Id.
    pub id: At<String>,
    /// What it reads.
    pub part: ProbePart,
}

/// What a probe reads, by id.
#[derive(Clone, Debug, PartialEq)]
pub enum ProbePart {
    /// Tension at an end of a line.
    Tension(At<String>, LineEnd),
    /// Tension of a line at an unstretched length from its end A [m].
    TensionAt(At<String>, f64),
    /// A coordinate of a line at an unstretched length from its end A [m].
    LineAt(At<String>, f64, usize),
    /// Greatest height of a line above the seabed, with this unstretched length left out at each end [m].
    Height(At<String>, f64),
    /// Mechanical energy of all rope and bodies.
    Energy(EnergyForm),
    /// A coordinate of the middle of a line.
    Middle(At<String>, usize),
    /// A coordinate of a body, joint or fixture.
    Place {
        /// Which.
        part: At<String>,
        /// A point of a body other than its middle, in its frame [m].
        point_m: Option<DVec3>,
        /// 0 x, 1 y, 2 z.
        axis: usize,
    },
    /// A figure of the whale.
    Whale(At<WhaleFigure>),
}

/// `[[rope]]` with an id and the figures of a library rope.
pub(super) fn ropes(fields: &Fields<'_>, file: &Provenance) -> Vec<Entry> {
    let read = |node: &Node| {
        let inner = Fields::of(node, fields.problems());
        let id = inner.need_id("id", "write an id such as \"test-rope\"")?;
        let row = provenance_over(&inner, file);
        let entry =
            entry::body(&inner, Kind::Rope, (id.value.clone(), String::new(), row), &id.value);
        inner.finish();
        Some(entry)
    };
    fields.tables("rope").iter().filter_map(read).collect()
}

/// Reads a `[[fixture]]`; `None` where something needed is missing, which is reported.
pub(super) fn fixture(node: &Node, problems: &Problems) -> Option<Fixture> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write an id such as \"anchor\"");
    let position = position(&fields);
    let velocity = fields.values("velocity", Quantity::Speed, &[3]);
    let from = fields.value("from", Quantity::Time, Range::NotNegative);
    let until = fields.value("until", Quantity::Time, Range::NotNegative);
    let force = fields.values("force", Quantity::Force, &[3]);
    match (&velocity, &force, from.as_ref().or(until.as_ref()), &until) {
        (Some(_), Some(force), ..) => {
            problems.push(
                force.place.error("both a `velocity` and a `force`", "keep the one that is meant"),
            );
        }
        (None, None, Some(lone), _) => problems.push(lone.place.error(
            "a time without a `velocity`",
            "write velocity = [\"2 m/s\", \"0 m/s\", \"0 m/s\"], or take the time out",
        )),
        (None, Some(_), _, Some(until)) => {
            problems.push(until.place.error(
                "a `force` has no `until`",
                "take it out: a force acts from `from` on to the end",
            ));
        }
        _ => {}
    }
    fields.finish();
    let begins = from.map_or(0.0, |from| from.value);
    let drive = velocity.map(|velocity| {
        (place3(&velocity.value), begins, until.map_or(f64::INFINITY, |until| until.value))
    });
    let pull = force.map(|force| (place3(&force.value), begins));
    Some(Fixture { id: id?, position_m: position?, drive, pull })
}

/// `[[joint]]`: a free end, or a place where lines meet.
pub(super) fn joint(node: &Node, problems: &Problems) -> Option<(At<String>, DVec3)> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write an id such as \"tail\"");
    let position = position(&fields);
    fields.finish();
    Some((id?, position?))
}

/// Reads a `[[body]]`; `None` where something needed is missing, which is reported.
pub(super) fn body(node: &Node, file: &Provenance, problems: &Problems) -> Option<FreeBody> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write an id such as \"bob\"");
    let role = fields.word("role", &["buoy", "weight"]);
    let position = position(&fields);
    let held = fields.value("held_until", Quantity::Time, Range::NotNegative);
    let wetted = fields.flag("wetted_drag");
    let spin = fields.values("spin", Quantity::TurnRate, &[3]);
    let size = within(&fields, "size", &limits::BODY_SIZE);
    let inertia = above_zero(&fields, "inertia", Quantity::Inertia);
    let row = provenance_over(&fields, file);
    let figure = |key, quantity, range| fields.figure(key, quantity, range, &row);
    if fields.get("mass").is_none() {
        fields.missing("mass", "expected a mass such as 20 kg");
    }
    let mass = figure("mass", Quantity::Mass, Range::Positive);
    let radius = figure("radius", Quantity::Length, Range::Within(&limits::BODY_SIZE));
    let volume = figure("volume", Quantity::Volume, Range::NotNegative);
    let height = figure("float_height", Quantity::Length, Range::Positive);
    let drag = figure("drag_area", Quantity::Area, Range::NotNegative);
    let added = figure("added_mass", Quantity::Ratio, Range::NotNegative);
    fields.finish();
    let or = |figure: Option<Figure>, default: f64| figure.map_or(default, |figure| figure.value);
    let radius_m = or(radius, 0.1);
    Some(FreeBody {
        id: id?,
        buoy: role.is_some_and(|role| role.value == "buoy"),
        position_m: position?,
        spin_rad_s: spin.map_or(DVec3::ZERO, |spin| place3(&spin.value)),
        radius_m,
        half_m: size.map(|size| 0.5 * size),
        mass_kg: mass?.value,
        inertia_kg_m2: inertia,
        volume_m3: or(volume, 0.0),
        float_height_m: height.map(|height| height.value),
        drag_area_m2: or(drag, 0.0),
        added_mass: or(added, 0.0),
        wetted_drag: wetted.unwrap_or(true),
        held_until_s: held.map(|held| held.value),
    })
}

/// Three values that must be above zero.
fn above_zero<'a>(fields: &Fields<'a>, key: &'a str, quantity: Quantity) -> Option<DVec3> {
    let values = fields.values(key, quantity, &[3])?;
    let three = place3(&values.value);
    if three.min_element() > 0.0 {
        return Some(three);
    }
    let message = format!("a value of `{key}` is not above zero");
    fields.problems().push(values.place.error(message, "write three values, each above zero"));
    None
}

/// Three values, each within a limit.
fn within<'a>(fields: &Fields<'a>, key: &'a str, limit: &'static Limit) -> Option<DVec3> {
    let values = fields.values(key, limit.quantity, &[3])?;
    let three = place3(&values.value);
    let beyond = three.to_array().into_iter().find_map(|value| limit.check(key, value).err());
    let Some(beyond) = beyond else { return Some(three) };
    fields.problems().push(beyond.at(&values.place));
    None
}

/// Reads a `[[probe]]`; `None` where something needed is missing, which is reported.
pub(super) fn probe(node: &Node, problems: &Problems) -> Option<ProbeOf> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write an id such as \"anchor tension\"");
    let of = fields.need_text("of", "write tension, middle, line, height, place, energy or whale");
    let of = of.and_then(|_| {
        fields.word("of", &["tension", "middle", "line", "height", "place", "energy", "whale"])
    });
    let part = of.and_then(|of| match of.value.as_str() {
        "tension" => tension(&fields),
        "middle" => coordinate(&fields, "line").map(|(line, axis)| ProbePart::Middle(line, axis)),
        "line" => coordinate(&fields, "line")
            .and_then(|(line, axis)| Some(ProbePart::LineAt(line, length_at(&fields)?, axis))),
        "height" => height(&fields),
        "energy" => Some(ProbePart::Energy(energy_form(&fields))),
        "whale" => whale_figure(&fields).map(ProbePart::Whale),
        _ => place(&fields),
    });
    fields.finish();
    Some(ProbeOf { id: id?, part: part? })
}

/// At an end, or with `at` at a length from end A.
fn tension(fields: &Fields<'_>) -> Option<ProbePart> {
    let line = fields.need_text("line", "write the id of a line");
    if fields.get("at").is_some() {
        return Some(ProbePart::TensionAt(line?, length_at(fields)?));
    }
    let end =
        fields.need_text("end", "write from or to; or `at`, a length of rope from its end `from`");
    let end = end.and_then(|_| fields.word("end", &["from", "to"]))?;
    Some(ProbePart::Tension(line?, if end.value == "from" { LineEnd::A } else { LineEnd::B }))
}

/// Of a body's middle or another `point` of it, of a joint or a fixture.
fn place(fields: &Fields<'_>) -> Option<ProbePart> {
    let point = fields.values("point", Quantity::Length, &[3]);
    let (part, axis) = coordinate(fields, "part")?;
    Some(ProbePart::Place { part, point_m: point.map(|point| place3(&point.value)), axis })
}

/// Of a whole line, or of what lies farther than `away` from its ends.
fn height(fields: &Fields<'_>) -> Option<ProbePart> {
    let line = fields.need_text("line", "write the id of a line");
    let away = fields.value("away", Quantity::Length, Range::NotNegative);
    Some(ProbePart::Height(line?, away.map_or(0.0, |away| away.value)))
}

fn length_at(fields: &Fields<'_>) -> Option<f64> {
    fields.need_value("at", Quantity::Length, Range::NotNegative).map(|at| at.value)
}

fn energy_form(fields: &Fields<'_>) -> EnergyForm {
    let form = fields.word("form", &["total", "kinetic", "height", "stretch"]);
    match form.as_ref().map(|form| form.value.as_str()) {
        Some("kinetic") => EnergyForm::Kinetic,
        Some("height") => EnergyForm::Height,
        Some("stretch") => EnergyForm::Stretch,
        _ => EnergyForm::Total,
    }
}

fn whale_figure(fields: &Fields<'_>) -> Option<At<WhaleFigure>> {
    let figure = fields.need_text("figure", "write speed, thrust, power or body-drag");
    let figure =
        figure.and_then(|_| fields.word("figure", &["speed", "thrust", "power", "body-drag"]))?;
    let value = match figure.value.as_str() {
        "speed" => WhaleFigure::Speed,
        "thrust" => WhaleFigure::Thrust,
        "power" => WhaleFigure::Power,
        _ => WhaleFigure::BodyDrag,
    };
    Some(At { value, place: figure.place })
}

fn coordinate<'a>(fields: &Fields<'a>, key: &'a str) -> Option<(At<String>, usize)> {
    let part = fields.need_text(key, "write an id");
    let axis = fields.need_text("axis", "write x (east), y (north) or z (up)");
    let axis = axis.and_then(|_| fields.word("axis", &["x", "y", "z"]))?;
    Some((part?, ["x", "y", "z"].iter().position(|name| *name == axis.value)?))
}

/// `position`: east, north and up [m]; `None` where it is missing, which is reported.
pub(super) fn position(fields: &Fields<'_>) -> Option<DVec3> {
    let position = fields.values("position", Quantity::Length, &[3]);
    if fields.get("position").is_none() {
        fields.missing("position", "write east, north and up as [\"0 m\", \"0 m\", \"-30 m\"]");
    }
    position.map(|position| place3(&position.value))
}

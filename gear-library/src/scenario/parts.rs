//! Parts written into a scenario: ropes, fixtures, joints, bodies, obstacles and probes.

use endline_sdk::LineEnd;
use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::{EnergyForm, ROPE_ON_HARD_N_M2, WhaleFigure};
use endline_sim::{DQuat, DVec3};

use crate::diagnostic::At;
use crate::entry::{self, Entry};
use crate::fields::{Fields, Figure, Provenance, Range, provenance_over};
use crate::limits::{self, Limit};
use crate::schema::Kind;
use crate::tree::Node;
use crate::units::Quantity;

use super::{WrapOf, place3};

/// A point that is fixed, driven with constant velocity between two times, or first fixed and then pulled by a constant force.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixture {
    /// Id.
    pub id: At<String>,
    /// Place [m].
    pub position_m: DVec3,
    /// Velocity [m/s], start and end [s] of a driven point.
    pub drive: Option<(DVec3, f64, f64)>,
    /// Force [N] and start [s] of a pulled point.
    pub pull: Option<(DVec3, f64)>,
}

/// A body written in place: a sphere or a box; lines are made fast at its middle.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeBody {
    /// Id.
    pub id: At<String>,
    /// Whether it is drawn and reported as a buoy; else as a weight.
    pub buoy: bool,
    /// Initial place [m].
    pub position_m: DVec3,
    /// Initial angular velocity in the world [rad/s].
    pub spin_rad_s: DVec3,
    /// Radius [m].
    pub radius_m: f64,
    /// Half extents of a box [m].
    pub half_m: Option<DVec3>,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Principal moments of inertia, if written [kg m²].
    pub inertia_kg_m2: Option<DVec3>,
    /// Displaced volume [m³].
    pub volume_m3: f64,
    /// Height over which it is immersed linearly, if written [m].
    pub float_height_m: Option<f64>,
    /// Drag coefficient times area [m²].
    pub drag_area_m2: f64,
    /// Added mass as a share of the displaced water.
    pub added_mass: f64,
    /// Whether drag and added mass scale with the wet share.
    pub wetted_drag: bool,
    /// End of the time in which it is held [s].
    pub held_until_s: Option<f64>,
}

/// The initial shape of a line.
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
        /// Turns; negative for left-handed about its axis.
        turns: f64,
        /// Whether two turns form two half hitches.
        hitched: bool,
    },
    /// Wrapped about the whale, from its `from` end.
    Wrapped(Vec<WrapOf>),
}

/// A probe as written.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeOf {
    /// Id.
    pub id: At<String>,
    /// Its reading.
    pub part: ProbePart,
}

/// The reading of a probe, by id.
#[derive(Clone, Debug, PartialEq)]
pub enum ProbePart {
    /// Tension at an end of a line.
    Tension(At<String>, LineEnd),
    /// Tension of a line at an unstretched length from its end A [m].
    TensionAt(At<String>, f64),
    /// A coordinate of a line at an unstretched length from its end A [m].
    LineAt(At<String>, f64, usize),
    /// Greatest height of a line above the seabed, without this unstretched length at each end [m].
    Height(At<String>, f64),
    /// Mechanical energy of all rope and bodies.
    Energy(EnergyForm),
    /// A coordinate of the middle of a line.
    Middle(At<String>, usize),
    /// A coordinate of a body, joint or fixture.
    Place {
        /// Id of the part.
        part: At<String>,
        /// A point of a body other than its middle, in its frame [m].
        point_m: Option<DVec3>,
        /// 0 x, 1 y, 2 z.
        axis: usize,
    },
    /// All three coordinates of a part: one probe for each.
    Position(PositionOf),
    /// A figure of the whale.
    Whale(At<WhaleFigure>),
}

/// What a probe of a position is on.
#[derive(Clone, Debug, PartialEq)]
pub enum PositionOf {
    /// A body, joint or fixture, the whale, or a spot of it; with a point of a body in its frame [m].
    Part(At<String>, Option<DVec3>),
    /// A line at an unstretched length from its end A [m].
    Line(At<String>, f64),
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

/// Reads a `[[fixture]]`; `None` if a required field is missing, which is reported.
pub(super) fn fixture(fields: &Fields<'_>) -> Option<Fixture> {
    let id = fields.need_id("id", "write an id such as \"anchor\"");
    let position = position(fields);
    let velocity = fields.values("velocity", Quantity::Speed, &[3]);
    let from = fields.value("from", Quantity::Time, Range::NotNegative);
    let until = fields.value("until", Quantity::Time, Range::NotNegative);
    let force = fields.values("force", Quantity::Force, &[3]);
    match (&velocity, &force, from.as_ref().or(until.as_ref()), &until) {
        (Some(_), Some(force), ..) => {
            fields
                .problems()
                .push(force.place.error("both a `velocity` and a `force`", "keep one of them"));
        }
        (None, None, Some(lone), _) => fields.problems().push(lone.place.error(
            "a time without a `velocity`",
            "write velocity = [\"2 m/s\", \"0 m/s\", \"0 m/s\"], or remove the time",
        )),
        (None, Some(_), _, Some(until)) => {
            fields.problems().push(until.place.error(
                "a `force` has no `until`",
                "remove it: a force acts from `from` to the end",
            ));
        }
        _ => {}
    }
    let begins = from.map_or(0.0, |from| from.value);
    let drive = velocity.map(|velocity| {
        (place3(&velocity.value), begins, until.map_or(f64::INFINITY, |until| until.value))
    });
    let pull = force.map(|force| (place3(&force.value), begins));
    Some(Fixture { id: id?, position_m: position?, drive, pull })
}

/// Reads a `[[joint]]`: a free end, or a place where lines meet.
pub(super) fn joint(fields: &Fields<'_>) -> Option<(At<String>, DVec3)> {
    let id = fields.need_id("id", "write an id such as \"tail\"");
    let position = position(fields);
    Some((id?, position?))
}

/// Reads a `[[body]]`; `None` if a required field is missing, which is reported.
pub(super) fn body(fields: &Fields<'_>, file: &Provenance) -> Option<FreeBody> {
    let id = fields.need_id("id", "write an id such as \"bob\"");
    let role = fields.word("role", &["buoy", "weight"]);
    let position = position(fields);
    let held = fields.value("held_until", Quantity::Time, Range::NotNegative);
    let wetted = fields.flag("wetted_drag");
    let spin = fields.values("spin", Quantity::TurnRate, &[3]);
    let size = within(fields, "size", &limits::BODY_SIZE);
    let inertia = above_zero(fields, "inertia", Quantity::Inertia);
    let row = provenance_over(fields, file);
    let figure = |key, quantity, range| fields.figure(key, quantity, range, &row);
    fields.require("mass", "expected a mass such as 20 kg");
    let mass = figure("mass", Quantity::Mass, Range::Positive);
    let radius = figure("radius", Quantity::Length, Range::Within(&limits::BODY_SIZE));
    let volume = figure("volume", Quantity::Volume, Range::NotNegative);
    let height = figure("float_height", Quantity::Length, Range::Positive);
    let drag = figure("drag_area", Quantity::Area, Range::NotNegative);
    let added = figure("added_mass", Quantity::Ratio, Range::NotNegative);
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
    fields.refuse(values.place.error(message, "write three values, each above zero"))
}

/// Three values, each within a limit.
fn within<'a>(fields: &Fields<'a>, key: &'a str, limit: &'static Limit) -> Option<DVec3> {
    let values = fields.values(key, limit.quantity, &[3])?;
    let three = place3(&values.value);
    let beyond = three.to_array().into_iter().find_map(|value| limit.check(key, value).err());
    let Some(beyond) = beyond else { return Some(three) };
    fields.refuse(beyond.at(&values.place))
}

/// Reads a `[[probe]]`; `None` if a required field is missing, which is reported.
pub(super) fn probe(fields: &Fields<'_>) -> Option<ProbeOf> {
    let id = fields.need_id("id", "write an id such as \"anchor tension\"");
    let of = fields.need_word(
        "of",
        "write position, place, tension, middle, line, height, energy or whale",
        &["position", "place", "tension", "middle", "line", "height", "energy", "whale"],
    );
    let part = of.and_then(|of| match of.value.as_str() {
        "tension" => tension(fields),
        "middle" => coordinate(fields, "line").map(|(line, axis)| ProbePart::Middle(line, axis)),
        "line" => coordinate(fields, "line")
            .and_then(|(line, axis)| Some(ProbePart::LineAt(line, length_at(fields)?, axis))),
        "height" => height(fields),
        "energy" => Some(ProbePart::Energy(energy_form(fields))),
        "whale" => whale_figure(fields).map(ProbePart::Whale),
        "position" => position_of(fields).map(ProbePart::Position),
        _ => place(fields),
    });
    Some(ProbeOf { id: id?, part: part? })
}

/// Tension at an end, or with `at` at a length from end A.
fn tension(fields: &Fields<'_>) -> Option<ProbePart> {
    let line = fields.need_text("line", "write the id of a line");
    if fields.get("at").is_some() {
        return Some(ProbePart::TensionAt(line?, length_at(fields)?));
    }
    let help = "write from or to; or `at`, a length of rope from its end `from`";
    let end = fields.need_end("end", help)?;
    Some(ProbePart::Tension(line?, end))
}

/// A coordinate of a body or a `point` of it, of a joint or a fixture.
fn place(fields: &Fields<'_>) -> Option<ProbePart> {
    let point = fields.values("point", Quantity::Length, &[3]);
    let (part, axis) = coordinate(fields, "part")?;
    Some(ProbePart::Place { part, point_m: point.map(|point| place3(&point.value)), axis })
}

/// A part with an optional `point`, or a line `at` a length of rope.
fn position_of(fields: &Fields<'_>) -> Option<PositionOf> {
    let (part, line) = (fields.text("part"), fields.text("line"));
    let point = fields.values("point", Quantity::Length, &[3]);
    match (part, line, point) {
        (Some(part), None, point) => {
            Some(PositionOf::Part(part, point.map(|point| place3(&point.value))))
        }
        (None, Some(line), None) => Some(PositionOf::Line(line, length_at(fields)?)),
        (None, Some(_), Some(point)) => {
            let help = "write at = \"12 m\", a length of rope from the line's end `from`, and remove `point`";
            fields.refuse(point.place.error("a line has no `point`", help))
        }
        (Some(part), Some(_), _) => fields
            .refuse(part.place.error("both `part` and `line` are present", "keep one of them")),
        (None, None, _) => {
            let help = "write the id of a body, joint or fixture, `whale` or a spot of it such as `whale:back`; or a `line` with `at`";
            fields.missing("part", help);
            None
        }
    }
}

/// Height of a line, without the length `away` at its ends.
fn height(fields: &Fields<'_>) -> Option<ProbePart> {
    let line = fields.need_text("line", "write the id of a line");
    let away = fields.value("away", Quantity::Length, Range::NotNegative);
    Some(ProbePart::Height(line?, away.map_or(0.0, |away| away.value)))
}

fn length_at(fields: &Fields<'_>) -> Option<f64> {
    fields.need_value("at", Quantity::Length, Range::NotNegative).map(|at| at.value)
}

fn energy_form(fields: &Fields<'_>) -> EnergyForm {
    let forms = [
        ("total", EnergyForm::Total),
        ("kinetic", EnergyForm::Kinetic),
        ("height", EnergyForm::Height),
        ("stretch", EnergyForm::Stretch),
    ];
    fields.choice("form", &forms).map_or(EnergyForm::Total, |form| form.value)
}

fn whale_figure(fields: &Fields<'_>) -> Option<At<WhaleFigure>> {
    let figures = [
        ("speed", WhaleFigure::Speed),
        ("thrust", WhaleFigure::Thrust),
        ("power", WhaleFigure::Power),
        ("body-drag", WhaleFigure::BodyDrag),
        ("contact-force", WhaleFigure::ContactForce),
    ];
    fields.require("figure", "write speed, contact-force, thrust, power or body-drag");
    fields.choice("figure", &figures)
}

fn coordinate<'a>(fields: &Fields<'a>, key: &'a str) -> Option<(At<String>, usize)> {
    let part = fields.need_text(key, "write an id");
    let axes = [("x", 0), ("y", 1), ("z", 2)];
    let axis = fields.need_choice("axis", "write x (east), y (north) or z (up)", &axes)?;
    Some((part?, axis))
}

/// `position`: east, north and up [m]; `None` if it is missing, which is reported.
pub(super) fn position(fields: &Fields<'_>) -> Option<DVec3> {
    let position = fields.values("position", Quantity::Length, &[3]);
    fields.require("position", "write east, north and up as [\"0 m\", \"0 m\", \"-30 m\"]");
    position.map(|position| place3(&position.value))
}

/// Allowed dimensions of an obstacle [m].
const MEASURE: Range = Range::Between(1e-3, 1e4);

/// An obstacle as written: a fixed solid.
#[derive(Clone, Debug, PartialEq)]
pub struct ObstacleOf {
    /// Id.
    pub id: At<String>,
    /// Shape, in its own frame.
    pub shape: SolidShape,
    /// Place [m].
    pub position_m: DVec3,
    /// Rotation from its frame to the world.
    pub orientation: DQuat,
    /// Friction of rope and bodies on it.
    pub friction: f64,
    /// Stiffness under rope, by length of rope [N/m²].
    pub stiffness_n_m2: f64,
}

/// Reads an `[[obstacle]]`.
pub(super) fn obstacle(fields: &Fields<'_>, file: &Provenance) -> Option<ObstacleOf> {
    let id = fields.need_id("id", "write an id such as \"rock\"");
    let word = fields.need_word(
        "shape",
        "write plane, sphere, cylinder or box",
        &["plane", "sphere", "cylinder", "box"],
    );
    let position_m = position(fields);
    let row = provenance_over(fields, file);
    fields.require(
        "friction",
        "write the friction of rope and bodies on it, such as 0.3; 0 is smooth",
    );
    let friction = fields.figure("friction", Quantity::Ratio, Range::Between(0.0, 10.0), &row);
    let stiffness = fields.figure("stiffness", Quantity::Pressure, Range::Positive, &row);
    // The dimensions depend on the shape.
    let Some(word) = word else {
        fields.rest();
        return None;
    };
    let shape = match word.value.as_str() {
        "plane" => direction(fields, "normal").map(|turn| (SolidShape::Plane, turn)),
        "sphere" => {
            measure(fields, "radius").map(|radius| (SolidShape::Sphere(radius), DQuat::IDENTITY))
        }
        "cylinder" => cylinder(fields),
        _ => cuboid(fields),
    };
    let (shape, orientation) = shape?;
    Some(ObstacleOf {
        id: id?,
        shape,
        position_m: position_m?,
        orientation,
        friction: friction?.value,
        stiffness_n_m2: stiffness.map_or(ROPE_ON_HARD_N_M2, |stiffness| stiffness.value),
    })
}

fn cylinder(fields: &Fields<'_>) -> Option<(SolidShape, DQuat)> {
    let (radius, length) = (measure(fields, "radius"), measure(fields, "length"));
    let turn = direction(fields, "axis");
    Some((SolidShape::Cylinder { radius_m: radius?, half_length_m: 0.5 * length? }, turn?))
}

/// A box by length, width and height, with the length along `heading` and a nose-up `pitch`.
fn cuboid(fields: &Fields<'_>) -> Option<(SolidShape, DQuat)> {
    let size = fields.values("size", Quantity::Length, &[3]);
    fields.require("size", "write length, width and height as [\"2 m\", \"1 m\", \"0.5 m\"]");
    let heading = fields
        .value("heading", Quantity::Angle, Range::Any)
        .map_or(std::f64::consts::FRAC_PI_2, |heading| heading.value);
    let pitch = fields.value("pitch", Quantity::Angle, Range::Any).map_or(0.0, |pitch| pitch.value);
    let size = size?;
    let half = 0.5 * place3(&size.value);
    if half.min_element() <= 0.0 {
        return fields.refuse(size.place.error(
            "a `size` is not above zero",
            "write length, width and height, each above zero",
        ));
    }
    let turn = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2 - heading)
        * DQuat::from_rotation_y(-pitch);
    Some((SolidShape::Box(half), turn))
}

fn measure(fields: &Fields<'_>, key: &'static str) -> Option<f64> {
    fields.need_value(key, Quantity::Length, MEASURE).map(|value| value.value)
}

/// The rotation from z to a direction; none by default.
fn direction(fields: &Fields<'_>, key: &'static str) -> Option<DQuat> {
    if fields.get(key).is_none() {
        return Some(DQuat::IDENTITY);
    }
    let values = fields.values(key, Quantity::Ratio, &[3])?;
    let Some(direction) = place3(&values.value).try_normalize() else {
        let message = format!("`{key}` has no length");
        return fields
            .refuse(values.place.error(message, "write east, north and up, such as [0, 0, 1]"));
    };
    Some(DQuat::from_rotation_arc(DVec3::Z, direction))
}

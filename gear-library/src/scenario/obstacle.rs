//! Obstacles of a scenario: solid things that stand still and that rope and bodies meet.

use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::ROPE_ON_HARD_N_M2;
use endline_sim::{DQuat, DVec3};

use crate::diagnostic::At;
use crate::fields::{Fields, Problems, Provenance, Range, provenance_over};
use crate::tree::Node;
use crate::units::Quantity;

use super::parts::position;
use super::place3;

/// Greatest measure of an obstacle [m].
const MEASURE: Range = Range::Between(1e-3, 1e4);

/// A solid thing as written.
#[derive(Clone, Debug, PartialEq)]
pub struct ObstacleOf {
    /// Id.
    pub id: At<String>,
    /// Shape, in its own frame.
    pub shape: SolidShape,
    /// Where it is [m].
    pub position_m: DVec3,
    /// Its frame, to world.
    pub orientation: DQuat,
    /// Friction of rope and bodies on it.
    pub friction: f64,
    /// Stiffness under rope, by length of rope [N/m²].
    pub stiffness_n_m2: f64,
}

/// Reads an `[[obstacle]]`.
pub(super) fn obstacle(node: &Node, file: &Provenance, problems: &Problems) -> Option<ObstacleOf> {
    let fields = Fields::of(node, problems);
    let id = fields.need_id("id", "write an id such as \"rock\"");
    let word = fields.need_text("shape", "write plane, sphere, cylinder or box");
    let word = word.and_then(|_| fields.word("shape", &["plane", "sphere", "cylinder", "box"]));
    let position_m = position(&fields);
    let row = provenance_over(&fields, file);
    if fields.get("friction").is_none() {
        fields.missing(
            "friction",
            "write the friction of rope and bodies on it, such as 0.3; 0 is smooth",
        );
    }
    let friction = fields.figure("friction", Quantity::Ratio, Range::Between(0.0, 10.0), &row);
    let stiffness = fields.figure("stiffness", Quantity::Pressure, Range::Positive, &row);
    // Without a shape its measures cannot be judged.
    let shape = match word?.value.as_str() {
        "plane" => direction(&fields, "normal").map(|turn| (SolidShape::Plane, turn)),
        "sphere" => {
            measure(&fields, "radius").map(|radius| (SolidShape::Sphere(radius), DQuat::IDENTITY))
        }
        "cylinder" => cylinder(&fields),
        _ => cuboid(&fields),
    };
    fields.finish();
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

/// A box by length, width and height; its length points to `heading`, its front rises by `pitch`.
fn cuboid(fields: &Fields<'_>) -> Option<(SolidShape, DQuat)> {
    let size = fields.values("size", Quantity::Length, &[3]);
    if fields.get("size").is_none() {
        fields.missing("size", "write length, width and height as [\"2 m\", \"1 m\", \"0.5 m\"]");
    }
    let heading = fields
        .value("heading", Quantity::Angle, Range::Any)
        .map_or(std::f64::consts::FRAC_PI_2, |heading| heading.value);
    let pitch = fields.value("pitch", Quantity::Angle, Range::Any).map_or(0.0, |pitch| pitch.value);
    let size = size?;
    let half = 0.5 * place3(&size.value);
    if half.min_element() <= 0.0 {
        fields.problems().push(size.place.error(
            "a `size` is not above zero",
            "write length, width and height, each above zero",
        ));
        return None;
    }
    let turn = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2 - heading)
        * DQuat::from_rotation_y(-pitch);
    Some((SolidShape::Box(half), turn))
}

fn measure(fields: &Fields<'_>, key: &'static str) -> Option<f64> {
    fields.need_value(key, Quantity::Length, MEASURE).map(|value| value.value)
}

/// The turn that leads z to a direction; upright where none is given.
fn direction(fields: &Fields<'_>, key: &'static str) -> Option<DQuat> {
    if fields.get(key).is_none() {
        return Some(DQuat::IDENTITY);
    }
    let values = fields.values(key, Quantity::Ratio, &[3])?;
    let Some(direction) = place3(&values.value).try_normalize() else {
        let message = format!("`{key}` has no length");
        fields
            .problems()
            .push(values.place.error(message, "write east, north and up, such as [0, 0, 1]"));
        return None;
    };
    Some(DQuat::from_rotation_arc(DVec3::Z, direction))
}

//! What is fixed to a buoy's float along its axis: staff, counterweight, radar reflector, stick.

use crate::fields::{Fields, Figure, Problems, Provenance, Range, provenance_over};
use crate::tree::Node;
use crate::units::Quantity;

use std::f64::consts::FRAC_PI_4;

/// A piece, reckoned as a cylinder on the buoy's axis.
#[derive(Clone, Debug, PartialEq)]
pub struct BuoyPiece {
    /// Name, such as `staff`.
    pub name: String,
    /// Height of its middle above the middle of the float [m].
    pub at_m: f64,
    /// Diameter [m].
    pub diameter_m: f64,
    /// Length along the axis [m].
    pub length_m: f64,
    /// Mass in air [kg].
    pub mass_kg: f64,
    /// Volume it displaces [m³].
    pub volume_m3: f64,
    /// Drag coefficient across the axis, on diameter times length.
    pub drag_across: f64,
    /// Drag coefficient along the axis, on the end's area.
    pub drag_along: f64,
}

/// Reads the `[[piece]]`s of a buoy.
pub(crate) fn pieces(fields: &Fields<'_>, file: &Provenance) -> Vec<BuoyPiece> {
    fields.tables("piece").iter().filter_map(|node| piece(node, file, fields.problems())).collect()
}

fn piece(node: &Node, file: &Provenance, problems: &Problems) -> Option<BuoyPiece> {
    let fields = Fields::of(node, problems);
    let name = fields.need_text("name", "write a name such as \"staff\"");
    let row = provenance_over(&fields, file);
    let need = |key, quantity: Quantity, range| {
        if fields.get(key).is_none() {
            fields.missing(
                key,
                format!("expected {} such as {}", quantity.noun(), quantity.examples()),
            );
        }
        fields.figure(key, quantity, range, &row)
    };
    let at = need("at", Quantity::Length, Range::Between(-10.0, 10.0));
    let diameter = need("diameter", Quantity::Length, Range::Between(0.001, 2.0));
    let length = need("length", Quantity::Length, Range::Between(0.001, 20.0));
    let mass = need("mass", Quantity::Mass, Range::Positive);
    let volume = fields.figure("volume", Quantity::Volume, Range::NotNegative, &row);
    let across = need("drag_across", Quantity::Ratio, Range::Between(0.0, 10.0));
    let along = need("drag_along", Quantity::Ratio, Range::Between(0.0, 10.0));
    fields.finish();
    let (diameter, length) = (diameter?.value, length?.value);
    let solid = FRAC_PI_4 * diameter * diameter * length;
    check_volume(volume.as_ref(), solid, problems);
    Some(BuoyPiece {
        name: name?.value,
        at_m: at?.value,
        diameter_m: diameter,
        length_m: length,
        mass_kg: mass?.value,
        volume_m3: volume.map_or(solid, |volume| volume.value),
        drag_across: across?.value,
        drag_along: along?.value,
    })
}

fn check_volume(volume: Option<&Figure>, solid: f64, problems: &Problems) {
    let Some(volume) = volume.filter(|volume| volume.value > 1.02 * solid) else { return };
    let message =
        format!("`volume` {} is more than the whole cylinder's {:.2} L", volume.text, 1e3 * solid);
    problems.push(volume.place.error(message, "fix the volume, the diameter or the length"));
}

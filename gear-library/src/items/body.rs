//! Bodies of the library: traps, anchors and buoys, and the points at which lines are made fast to them.
//!
//! Traps and anchors are boxes. A buoy is a float with pieces along its axis (staff, counterweight, radar reflector).
//! Points are measured from the middle of the box or float: along its length, to port, up (the axis of a buoy).
//! A line that names no point is made fast at the first one.

use std::f64::consts::FRAC_PI_4;

use crate::diagnostic::At;
use crate::entry::Entry;
use crate::fields::{Fields, Figure, Problems, Provenance, Range, provenance_over};
use crate::units::Quantity;

use super::rope::{GRAVITY_M_S2, SEA_WATER_KG_M3};

/// Default density of ballast: brick [kg/m³].
const BRICK_KG_M3: f64 = 2000.0;

/// A trap, or an anchor treated as a box.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxGear {
    /// Its file.
    pub entry: Entry,
    /// Length, width, height [m].
    pub size_m: [f64; 3],
    /// Mass in air [kg].
    pub mass_kg: f64,
    /// Weight in sea water [N].
    pub wet_weight_n: f64,
    /// Drag coefficient on the solid part of the faces.
    pub drag_coefficient: f64,
    /// Solid share of a face across x (the ends), y (the sides) and z (top and floor).
    pub solidity: [f64; 3],
    /// Mass of ballast and runners, flat over the floor [kg].
    pub ballast_kg: f64,
    /// Height of the ballast above the underside [m].
    pub ballast_height_m: f64,
    /// Density of the ballast [kg/m³].
    pub ballast_density_kg_m3: f64,
    /// Volume of buoyant foam or wood [m³].
    pub foam_m3: f64,
    /// Height of the foam above the underside [m].
    pub foam_height_m: f64,
    /// Added mass along and across, as a share of the water it encloses.
    pub added_mass_horizontal: f64,
    /// Added mass up and down, as a share of the water it encloses.
    pub added_mass_vertical: f64,
    /// Static friction on the seabed.
    pub start_friction: f64,
    /// Sliding friction on the seabed.
    pub slide_friction: f64,
    /// Breakout force when it is lifted off the seabed [N].
    pub break_out_n: f64,
}

impl BoxGear {
    /// Builds it from a file's figures; `None` if one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry, problems: &Problems) -> Option<Self> {
        let (mass_kg, wet_weight) = (entry.value("mass")?, entry.figure("wet_weight")?);
        if wet_weight.value >= mass_kg * GRAVITY_M_S2 {
            let message = format!(
                "`wet_weight` {} is not below the weight in air, {:.0} N",
                wet_weight.text,
                mass_kg * GRAVITY_M_S2
            );
            problems.push(wet_weight.place.error(
                message,
                "a body weighs less in water than in air; fix the wet weight or the mass",
            ));
        }
        let (start, slide) = (entry.value("start_friction")?, entry.figure("slide_friction")?);
        if slide.value > start {
            let message =
                format!("`slide_friction` {} is above `start_friction` {start}", slide.value);
            problems.push(
                slide.place.error(message, "sliding friction does not exceed static friction"),
            );
        }
        let (ballast_kg, solidity) =
            (entry.value("ballast").unwrap_or(0.0), entry.value("solidity")?);
        let (size_m, or) = (
            [entry.value("length")?, entry.value("width")?, entry.value("height")?],
            |key, usual| entry.value(key).unwrap_or(usual),
        );
        let item = Self {
            size_m,
            mass_kg,
            wet_weight_n: wet_weight.value,
            drag_coefficient: entry.value("drag_coefficient")?,
            solidity: ["solidity_ends", "solidity_sides", "solidity_top"]
                .map(|key| or(key, solidity)),
            ballast_kg,
            ballast_height_m: or("ballast_height", 0.0),
            ballast_density_kg_m3: or("ballast_density", BRICK_KG_M3),
            foam_m3: or("foam", 0.0),
            foam_height_m: or("foam_height", size_m[2]),
            added_mass_horizontal: entry.value("added_mass_horizontal")?,
            added_mass_vertical: entry.value("added_mass_vertical")?,
            start_friction: start,
            slide_friction: slide.value,
            break_out_n: or("break_out", 0.0),
            entry,
        };
        item.check(problems);
        Some(item)
    }

    /// Checks ballast and foam against mass, displaced volume and height of the box.
    fn check(&self, problems: &Problems) {
        let report = |key: &str, message: String, help: &str| {
            let place = self.entry.figure(key).map_or(&self.entry.place, |figure| &figure.place);
            problems.push(place.error(message, help));
        };
        if self.ballast_kg >= self.mass_kg {
            report(
                "ballast",
                format!("`ballast` {} kg is not below the `mass`", self.ballast_kg),
                "the mass includes the ballast",
            );
        } else if self.wire_m3() < 0.0 {
            let litres = 1e3 * (self.ballast_m3() + self.foam_m3);
            let message = format!(
                "ballast and foam displace {litres:.2} L, more than the {:.2} L of the body",
                1e3 * self.displaced_m3()
            );
            let key = if self.foam_m3 > 0.0 { "foam" } else { "ballast" };
            report(
                key,
                message,
                "the displaced volume follows from mass and wet weight; fix the ballast, its density, the foam or `wet_weight`",
            );
        }
        for (key, height) in
            [("ballast_height", self.ballast_height_m), ("foam_height", self.foam_height_m)]
        {
            if height > self.size_m[2] {
                report(
                    key,
                    format!("`{key}` {height} m is above the box"),
                    "it is measured from the underside up to the `height`",
                );
            }
        }
    }

    /// Volume of the ballast [m³].
    pub fn ballast_m3(&self) -> f64 {
        self.ballast_kg / self.ballast_density_kg_m3
    }

    /// Volume of wire and wood, distributed over the faces [m³].
    pub fn wire_m3(&self) -> f64 {
        self.displaced_m3() - self.ballast_m3() - self.foam_m3
    }

    /// Points at which a line can be made fast; the default, the middle of the top edge at one end, is first.
    pub fn points(&self) -> Vec<Point> {
        let [x, y, z] = self.size_m.map(|size| size / 2.0);
        let usual = [
            ("end", [x, 0.0, z]),
            ("bridle-port", [x, y, z]),
            ("bridle-starboard", [x, -y, z]),
            ("far-end", [-x, 0.0, z]),
            ("far-port", [-x, y, z]),
            ("far-starboard", [-x, -y, z]),
            ("port", [0.0, y, z]),
            ("starboard", [0.0, -y, z]),
            ("top", [0.0, 0.0, z]),
        ];
        with_own(
            usual.map(|(name, at_m)| Point { name: name.to_owned(), at_m }).to_vec(),
            &self.entry.points,
        )
    }

    /// Volume of wire, wood and ballast: `(m g - W) / (ρ g)` in sea water [m³].
    pub fn displaced_m3(&self) -> f64 {
        (self.mass_kg * GRAVITY_M_S2 - self.wet_weight_n) / (SEA_WATER_KG_M3 * GRAVITY_M_S2)
    }
}

/// The shape of a buoy's float.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuoyShape {
    /// Sphere (poly ball).
    Sphere,
    /// Cylinder along the axis with rounded ends.
    Bullet,
    /// Spheroid along the axis.
    LowDrag,
    /// Cylinder along the axis with flat ends.
    Cylinder,
}

/// A buoy; its axis is the z axis of the body, and the line leaves at the lower end.
#[derive(Clone, Debug, PartialEq)]
pub struct Buoy {
    /// Its file.
    pub entry: Entry,
    /// Shape of the float.
    pub shape: BuoyShape,
    /// Diameter of the float [m].
    pub diameter_m: f64,
    /// Length of the float along its axis [m].
    pub length_m: f64,
    /// Volume of the float [m³].
    pub volume_m3: f64,
    /// Mass in air, without its pieces [kg].
    pub mass_kg: f64,
    /// Height of the centre of mass above the middle of the float [m].
    pub centre_of_mass_m: f64,
    /// Distance from the middle of the float down to the point where the line leaves [m].
    pub attachment_m: f64,
    /// Drag coefficient across the axis.
    pub drag_across: f64,
    /// Drag coefficient along the axis.
    pub drag_along: f64,
    /// Added-mass coefficient across the axis.
    pub added_mass_across: f64,
    /// Added-mass coefficient along the axis.
    pub added_mass_along: f64,
    /// Pieces fixed to the float, along its axis.
    pub pieces: Vec<BuoyPiece>,
}

impl Buoy {
    /// Builds it from a file's figures; `None` if one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry, problems: &Problems) -> Option<Self> {
        let shape = match entry.word("shape")?.value.as_str() {
            "sphere" => BuoyShape::Sphere,
            "bullet" => BuoyShape::Bullet,
            "low-drag" => BuoyShape::LowDrag,
            _ => BuoyShape::Cylinder,
        };
        let diameter_m = entry.value("diameter")?;
        let length_m = float_length(&entry, shape, diameter_m, problems)?;
        check_volume(&entry, length_m, problems);
        Some(Self {
            shape,
            diameter_m,
            length_m,
            volume_m3: entry.value("volume")?,
            mass_kg: entry.value("mass")?,
            centre_of_mass_m: entry.value("centre_of_mass").unwrap_or(0.0),
            attachment_m: entry.value("attachment").unwrap_or(0.5 * length_m),
            pieces: entry.pieces.clone(),
            drag_across: entry.value("drag_across")?,
            drag_along: entry.value("drag_along")?,
            added_mass_across: entry.value("added_mass_across")?,
            added_mass_along: entry.value("added_mass_along")?,
            entry,
        })
    }

    /// Mass in air with its pieces [kg].
    pub fn whole_mass_kg(&self) -> f64 {
        self.mass_kg + self.pieces.iter().map(|piece| piece.mass_kg).sum::<f64>()
    }

    /// Points at which a line can be made fast; the default, the lower end, is first.
    pub fn points(&self) -> Vec<Point> {
        let usual = [
            ("below", [0.0, 0.0, -self.attachment_m]),
            ("above", [0.0, 0.0, self.length_m / 2.0]),
            ("side", [self.diameter_m / 2.0, 0.0, 0.0]),
        ];
        with_own(
            usual.map(|(name, at_m)| Point { name: name.to_owned(), at_m }).to_vec(),
            &self.entry.points,
        )
    }
}

/// Length of the float: the diameter of a sphere, else the stated length, which is at least the diameter.
fn float_length(
    entry: &Entry,
    shape: BuoyShape,
    diameter_m: f64,
    problems: &Problems,
) -> Option<f64> {
    match (shape, entry.figure("length")) {
        (BuoyShape::Sphere, None) => Some(diameter_m),
        (BuoyShape::Sphere, Some(length)) => problems.refuse(
            length
                .place
                .error("a sphere has no `length`", "take it out, or choose the shape \"bullet\""),
        ),
        (_, Some(length)) if length.value >= diameter_m => Some(length.value),
        (_, Some(length)) => {
            let message = format!("`length` {} is below the diameter", length.text);
            problems.refuse(
                length
                    .place
                    .error(message, "the length is along the axis and not less than the diameter"),
            )
        }
        (_, None) => problems.refuse(entry.place.error(
            "`length` is missing",
            "every shape except a sphere needs a length, such as 14 in",
        )),
    }
}

/// Checks that the volume fits into the dimensions and that the buoy floats.
fn check_volume(entry: &Entry, length_m: f64, problems: &Problems) {
    let (Some(volume), Some(diameter), Some(mass)) =
        (entry.figure("volume"), entry.value("diameter"), entry.value("mass"))
    else {
        return;
    };
    let mass = mass + entry.pieces.iter().map(|piece| piece.mass_kg).sum::<f64>();
    let whole = volume.value + entry.pieces.iter().map(|piece| piece.volume_m3).sum::<f64>();
    if volume.value > 1.02 * diameter * diameter * length_m {
        let message = format!(
            "`volume` {} does not fit into {:.0} × {:.0} mm",
            volume.text,
            diameter * 1e3,
            length_m * 1e3
        );
        problems.push(volume.place.error(message, "fix the volume, the diameter or the length"));
    }
    if whole * SEA_WATER_KG_M3 <= mass {
        let message = format!("`volume` {} does not carry the mass of {mass} kg", volume.text);
        problems.push(volume.place.error(message, "a buoy floats: fix the volume or the mass"));
    }
}

/// A piece, treated as a cylinder on the axis of the buoy.
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
    fields.each("piece", |table| piece(table, file))
}

fn piece(fields: &Fields<'_>, file: &Provenance) -> Option<BuoyPiece> {
    let name = fields.need_text("name", "write a name such as \"staff\"");
    let row = provenance_over(fields, file);
    let need = |key, quantity: Quantity, range| {
        fields.require(key, quantity.expected());
        fields.figure(key, quantity, range, &row)
    };
    let at = need("at", Quantity::Length, Range::Between(-10.0, 10.0));
    let diameter = need("diameter", Quantity::Length, Range::Between(0.001, 2.0));
    let length = need("length", Quantity::Length, Range::Between(0.001, 20.0));
    let mass = need("mass", Quantity::Mass, Range::Positive);
    let volume = fields.figure("volume", Quantity::Volume, Range::NotNegative, &row);
    let across = need("drag_across", Quantity::Ratio, Range::Between(0.0, 10.0));
    let along = need("drag_along", Quantity::Ratio, Range::Between(0.0, 10.0));
    let (diameter, length) = (diameter?.value, length?.value);
    let solid = FRAC_PI_4 * diameter * diameter * length;
    check_piece_volume(volume.as_ref(), solid, fields.problems());
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

fn check_piece_volume(volume: Option<&Figure>, solid: f64, problems: &Problems) {
    let Some(volume) = volume.filter(|volume| volume.value > 1.02 * solid) else { return };
    let message =
        format!("`volume` {} exceeds the {:.2} L of the cylinder", volume.text, 1e3 * solid);
    problems.push(volume.place.error(message, "fix the volume, the diameter or the length"));
}

/// A point with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Name, such as `bridle-port`.
    pub name: String,
    /// Place from the middle of the box or float: along, to port, up [m].
    pub at_m: [f64; 3],
}

/// Reads the `[[point]]`s of a trap, buoy or anchor.
pub(crate) fn points(fields: &Fields<'_>, file: &Provenance) -> Vec<Point> {
    let mut read: Vec<Point> = Vec::new();
    for (name, point) in fields.each("point", |table| point(table, file)) {
        if read.iter().any(|known| known.name == point.name) {
            let message = format!("there are two points `{}`", point.name);
            fields.problems().push(name.place.error(message, "rename one of them"));
        }
        read.push(point);
    }
    read
}

fn point(fields: &Fields<'_>, file: &Provenance) -> Option<(At<String>, Point)> {
    let name = fields.need_text("name", "write a name such as \"eye\"");
    let row = provenance_over(fields, file);
    fields.require("at",
            "write the place along, to port and up from the middle, such as [\"0.4 m\", \"0 m\", \"0.1 m\"]");
    let at = fields.values("at", Quantity::Length, &[3]);
    if row.source.is_none() || row.confidence.is_none() {
        let message = format!("`{}` has no source or no confidence", fields.place.field);
        fields.problems().push(fields.place.error(
            message,
            "write source = \"…\" and confidence = \"measured\" here, or for the whole file",
        ));
    }
    let name = name?;
    if name.value.is_empty() || name.value.contains(':') {
        let message = format!("`{}` cannot be a point's name", name.value);
        fields.problems().push(name.place.error(
            message,
            "a name has letters, digits and dashes; a colon separates the body from its point",
        ));
    }
    let at_m = <[f64; 3]>::try_from(at?.value).ok()?;
    let point = Point { name: name.value.clone(), at_m };
    Some((name, point))
}

/// The default points with those of the item; an item's point replaces a default one of the same name.
pub fn with_own(mut usual: Vec<Point>, own: &[Point]) -> Vec<Point> {
    for point in own {
        match usual.iter_mut().find(|known| known.name == point.name) {
            Some(known) => known.at_m = point.at_m,
            None => usual.push(point.clone()),
        }
    }
    usual
}

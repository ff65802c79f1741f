//! A buoy of the library.

use crate::entry::Entry;
use crate::fields::Problems;

use super::piece::BuoyPiece;
use super::point::{Point, with_own};
use super::rope::SEA_WATER_KG_M3;

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

/// A buoy; its axis is the body's z axis, the line leaves from below.
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
    /// Height of the centre of that mass above the middle of the float [m].
    pub centre_of_mass_m: f64,
    /// How far below the middle of the float the line leaves [m].
    pub attachment_m: f64,
    /// Drag coefficient across the axis.
    pub drag_across: f64,
    /// Drag coefficient along the axis.
    pub drag_along: f64,
    /// Added-mass coefficient across the axis.
    pub added_mass_across: f64,
    /// Added-mass coefficient along the axis.
    pub added_mass_along: f64,
    /// What is fixed to the float, along its axis.
    pub pieces: Vec<BuoyPiece>,
}

impl Buoy {
    /// From a file's figures; `None` where one is missing, which is reported.
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
    #[must_use]
    pub fn whole_mass_kg(&self) -> f64 {
        self.mass_kg + self.pieces.iter().map(|piece| piece.mass_kg).sum::<f64>()
    }

    /// Where a line can be made fast, the usual point first: below.
    #[must_use]
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

/// A sphere is as long as it is wide; anything else says its length, which is no less than its diameter.
fn float_length(
    entry: &Entry,
    shape: BuoyShape,
    diameter_m: f64,
    problems: &Problems,
) -> Option<f64> {
    match (shape, entry.figure("length")) {
        (BuoyShape::Sphere, None) => Some(diameter_m),
        (BuoyShape::Sphere, Some(length)) => {
            problems.push(
                length.place.error(
                    "a sphere has no `length`",
                    "take it out, or choose the shape \"bullet\"",
                ),
            );
            None
        }
        (_, Some(length)) if length.value >= diameter_m => Some(length.value),
        (_, Some(length)) => {
            let message = format!("`length` {} is below the diameter", length.text);
            problems.push(
                length
                    .place
                    .error(message, "a float lies along its axis: the length is the longer one"),
            );
            None
        }
        (_, None) => {
            problems.push(entry.place.error(
                "`length` is missing",
                "every shape but a sphere needs the length of its float, such as 14 in",
            ));
            None
        }
    }
}

/// A volume beyond the box around the float, or one that sinks under the buoy's own weight, is a slip of the pen.
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
        let message = format!("`volume` {} does not carry its own mass of {mass} kg", volume.text);
        problems.push(volume.place.error(message, "a buoy floats: fix the volume or the mass"));
    }
}

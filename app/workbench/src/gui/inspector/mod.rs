//! What is told of a thing picked in the 3-D view, and of the way between two.

mod body;
mod contact;
mod measure;
mod rope;
mod skin;

use endline_session::live::LiveView;
use endline_session::units::Units;
use endline_sim::DVec3;

pub use measure::{along_m, measured};
pub use rope::worst_m;

use crate::scene::Picked;

/// The name of a thing and its properties.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What it is.
    pub title: String,
    /// Names and values, what matters most first.
    pub rows: Vec<(&'static str, String)>,
}

impl Reading {
    /// With its first rows alone, for what the pointer rests on.
    #[must_use]
    pub fn glance(mut self, picked: Picked) -> Self {
        // The whale fills much of a picture, so that less is told of it.
        let rows = if matches!(picked, Picked::Skin { .. }) { 3 } else { 5 };
        self.rows.truncate(rows);
        self
    }
}

/// What a picked thing reads at the moment shown; `None` where this run has no such thing.
#[must_use]
pub fn read(view: &LiveView, picked: Picked, units: Units) -> Option<Reading> {
    match picked {
        Picked::Rope { line, at_m } => rope::read(view, line, at_m, units),
        Picked::Body(index) => body::read(view, index, units),
        Picked::Skin { triangle, .. } => skin::read(view, picked, triangle, units),
        Picked::RopeOnSkin { line, at_m } => contact::of_rope(view, line, at_m, units),
        Picked::BodyOnSkin { body, triangle } => contact::of_body(view, body, triangle, units),
    }
}

/// Depth, and height above the seabed where there is one.
fn levels(view: &LiveView, place: DVec3, units: Units) -> Vec<(&'static str, String)> {
    let above = view.model.spec.seabed.as_ref().map(|seabed| place.z - seabed.height_at(place));
    let depth = if place.z > 0.0 {
        format!("{} above the sea", units.length(place.z))
    } else {
        units.depth(-place.z)
    };
    let mut rows = vec![("Depth", depth)];
    rows.extend(above.map(|above_m| ("Above the seabed", units.length(above_m.max(0.0)))));
    rows
}

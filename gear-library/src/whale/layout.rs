//! Where the rows and columns of the trunk's skin stand.
//!
//! Half the trunk has 33 vertices in a row, from the back (column 0) over port to the belly (column 32). Ahead it ends at the
//! corner of the mouth, where upper and lower jaw part at column [`CORNER`]; aft it ends where the flukes begin.
//! On its side a block of patches is left out for the flipper; rows and columns gather there.

use std::f64::consts::PI;

use super::curve::{MonotoneCubic, smooth_step};
use super::form::WhaleForm;
use super::section::Sections;

/// Patches from back to belly.
pub const HALF_AROUND: usize = 32;
/// Column at the corner of the mouth.
pub const CORNER: usize = 10;
/// Patches of the flipper's hole along the body, and across.
pub const HOLE: [usize; 2] = [12, 4];
/// Rows of patches from the mouth's corner to the flipper, and from the flipper to the flukes.
const AHEAD: usize = 2;
const AFT: usize = 21;
/// Angle from the back of the mouth's corner [rad].
pub const CORNER_ANGLE: f64 = 1.66;
/// Skin left between the flipper's base and the rim of its hole [share of length].
const MARGIN: f64 = 0.011;

/// Rows and columns of the trunk.
pub struct Layout {
    /// Rows [share of length from the snout].
    pub rows: Vec<f64>,
    /// First and last row of the flipper's hole.
    pub hole_rows: [usize; 2],
    /// First and last column of the flipper's hole.
    pub hole_columns: [usize; 2],
    hole_angles: [f64; 2],
    corner_at: f64,
    hole_at: [f64; 2],
}

impl Layout {
    /// The layout of a form.
    #[must_use]
    pub fn of(form: &WhaleForm, sections: &Sections) -> Self {
        let (corner_at, flukes_at) = (corner_at(form), flukes_at(form));
        let room = flukes_at - corner_at;
        let flippers = &form.flippers;
        let half = (flippers.root_chord / 2.0 / libm::cos(flippers.sweep).max(0.3) + MARGIN)
            .min(0.25 * room);
        let least = corner_at + 0.02 * room + half;
        let middle = flippers.insertion.clamp(least, flukes_at - 0.3 * room - half);
        let hole_at = [middle - half, middle + half];
        let girth = sections.halves(middle).max_element().max(1e-6);
        let spread = ((flippers.root_chord * flippers.thickness / 2.0 + MARGIN) / girth).min(0.5);
        let angle = sections
            .angle_of_height(middle, flippers.insertion_height)
            .clamp(spread + 0.9, PI - spread - 0.3);
        let first = (angle / PI * HALF_AROUND as f64 - HOLE[1] as f64 / 2.0).round() as usize;
        let first = first.clamp(CORNER + 3, HALF_AROUND - HOLE[1] - 2);
        Self {
            rows: rows(corner_at, hole_at, flukes_at),
            hole_rows: [AHEAD, AHEAD + HOLE[0]],
            hole_columns: [first, first + HOLE[1]],
            hole_angles: [angle - spread, angle + spread],
            corner_at,
            hole_at,
        }
    }

    /// Angle from the back of a column [rad], exactly 0 and π on the midplane.
    #[must_use]
    pub fn angle(&self, at: f64, column: usize) -> f64 {
        if column == 0 {
            return 0.0;
        }
        if column == HALF_AROUND {
            return PI;
        }
        let column = column as f64;
        let even = column / HALF_AROUND as f64 * PI;
        let gathered = {
            let [first, last] = self.hole_columns;
            let points = [
                [0.0, 0.0],
                [first as f64, self.hole_angles[0]],
                [last as f64, self.hole_angles[1]],
                [HALF_AROUND as f64, PI],
            ];
            MonotoneCubic::through(points).at(column)
        };
        let [front, back] = self.hole_at;
        let away = smooth_step(back, back + 0.12, at);
        let trunk = gathered + (even - gathered) * away;
        let near = 1.0 - smooth_step(self.corner_at, front + 0.02, at);
        trunk + (mouth_angle(CORNER_ANGLE, column) - trunk) * near
    }
}

/// Angle from the back of a column where the mouth opens at an angle [rad].
#[must_use]
pub fn mouth_angle(gape: f64, column: f64) -> f64 {
    let corner = CORNER as f64;
    if column <= corner {
        gape * column / corner
    } else {
        gape + (PI - gape) * (column - corner) / (HALF_AROUND as f64 - corner)
    }
}

/// Where the corner of the mouth lies [share of length from the snout].
#[must_use]
pub fn corner_at(form: &WhaleForm) -> f64 {
    form.head.mouth.clamp(0.05, 0.6)
}

/// Where the flukes begin to grow out of the peduncle [share of length from the snout].
#[must_use]
pub fn flukes_at(form: &WhaleForm) -> f64 {
    1.0 - (1.3 * form.flukes.root_chord).clamp(0.02, 0.25)
}

fn rows(corner: f64, [front, back]: [f64; 2], flukes: f64) -> Vec<f64> {
    let between = |from: f64, to: f64, patches: usize| {
        (0..patches).map(move |row| from + (to - from) * row as f64 / patches as f64)
    };
    let ahead = between(corner, front, AHEAD);
    let beside = between(front, back, HOLE[0]);
    let aft = (0..=AFT).map(|row| {
        let share = row as f64 / AFT as f64;
        back + (flukes - back) * (0.55 * share + 0.45 * (1.5 * share - 0.5 * share * share * share))
    });
    ahead.chain(beside).chain(aft).collect()
}

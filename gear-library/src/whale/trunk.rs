//! The trunk, from the corner of the mouth to the flukes: sections, layout of rows and columns, and skin.
//!
//! Half the trunk has 33 vertices in a row, from the back (column 0) over port to the belly (column 32). It begins at the
//! corner of the mouth, where upper and lower jaw separate at column [`CORNER`], and ends at the flukes.
//! A block of patches on its side is a hole for the flipper, with denser rows and columns around it.
//! Sections are monotone cubic curves through the table, which do not overshoot.

use std::f64::consts::PI;

use endline_sdk::Region;
use glam::{DVec2, DVec3};

use super::Builder;
use super::form::WhaleForm;
use super::mesh::Corner;

/// The edges of the trunk's skin to which other parts are joined.
pub struct Trunk {
    /// Row at the corner of the mouth, from back to belly.
    pub front: Vec<u32>,
    /// Row at the flukes, from back to belly.
    pub back: Vec<u32>,
    /// Rim of the flipper's hole, from its upper front corner downwards.
    pub hole: Vec<u32>,
}

/// Adds the trunk.
pub fn add(build: &mut Builder) -> Trunk {
    let rows: Vec<Vec<u32>> =
        build.layout.rows.clone().into_iter().map(|at| row(build, at)).collect();
    let ([top, bottom], [first, last]) = (build.layout.hole_columns, build.layout.hole_rows);
    for (number, pair) in rows.windows(2).enumerate() {
        let at = (build.layout.rows[number] + build.layout.rows[number + 1]) / 2.0;
        let region = build.trunk_region(at);
        let open =
            |column: usize| (first..last).contains(&number) && (top..bottom).contains(&column);
        build.half.strip(&pair[0], &pair[1], |column| (!open(column)).then_some(region));
    }
    let rim = |step: usize| match step {
        _ if step < HOLE[1] => rows[first][top + step],
        _ if step < HOLE[1] + HOLE[0] => rows[first + step - HOLE[1]][bottom],
        _ if step < 2 * HOLE[1] + HOLE[0] => rows[last][bottom - (step - HOLE[1] - HOLE[0])],
        _ => rows[last - (step - 2 * HOLE[1] - HOLE[0])][top],
    };
    let hole = (0..2 * (HOLE[0] + HOLE[1])).map(rim).collect();
    Trunk { front: rows[0].clone(), back: rows[rows.len() - 1].clone(), hole }
}

fn row(build: &mut Builder, at: f64) -> Vec<u32> {
    let corners: Vec<Corner> = (0..=HALF_AROUND)
        .map(|column| {
            let angle = build.layout.angle(at, column);
            build.trunk_corner(at, angle)
        })
        .collect();
    build.half.row(corners)
}

impl Builder<'_> {
    /// A vertex of the trunk or of the head's outside.
    pub fn trunk_corner(&self, at: f64, angle: f64) -> Corner {
        let place = self.sections.surface(at, angle);
        Corner {
            place,
            weights: self.trunk_weights(place, at, angle),
            mark: self.marks.trunk(at, angle),
        }
    }

    fn trunk_region(&self, at: f64) -> Region {
        if at > self.form.peduncle_start {
            Region::Peduncle
        } else if at > self.form.head.share {
            Region::Body
        } else {
            Region::Head
        }
    }
}

/// Patches from back to belly.
pub const HALF_AROUND: usize = 32;
/// Column at the corner of the mouth.
pub const CORNER: usize = 10;
/// Patches of the flipper's hole along the body, and across.
pub const HOLE: [usize; 2] = [12, 4];
/// Rows of patches from the corner of the mouth to the flipper, and from the flipper to the flukes.
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

/// Angle from the back of a column, for an angle of the gape [rad].
pub fn mouth_angle(gape: f64, column: f64) -> f64 {
    let corner = CORNER as f64;
    if column <= corner {
        gape * column / corner
    } else {
        gape + (PI - gape) * (column - corner) / (HALF_AROUND as f64 - corner)
    }
}

/// Place of the corner of the mouth [share of length from the snout].
pub fn corner_at(form: &WhaleForm) -> f64 {
    form.head.mouth.clamp(0.05, 0.6)
}

/// Start of the flukes at the peduncle [share of length from the snout].
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

/// The body's sections in the whale's frame.
pub struct Sections {
    length_m: f64,
    breadth: f64,
    width: MonotoneCubic,
    dorsal: MonotoneCubic,
    ventral: MonotoneCubic,
    girth: MonotoneCubic,
}

impl Sections {
    /// Smooth sections of a form.
    pub fn of(form: &WhaleForm) -> Self {
        let curve = |value: fn(&super::Station) -> f64| {
            MonotoneCubic::through(form.stations.iter().map(|station| [station.at, value(station)]))
        };
        Self {
            length_m: form.length_m,
            breadth: form.breadth_scale,
            width: curve(|s| s.width),
            dorsal: curve(|s| s.dorsal),
            ventral: curve(|s| s.ventral),
            girth: MonotoneCubic::through(form.girth.iter().copied()),
        }
    }

    /// A place by its share of length from the snout and its offset to port and up [shares of length].
    pub fn place(&self, at: f64, offset: DVec2) -> DVec3 {
        DVec3::new(0.5 - at, offset.x, offset.y) * self.length_m
    }

    /// Half width and half height of a section [share of length].
    pub fn halves(&self, at: f64) -> DVec2 {
        let scale = self.breadth * self.girth.at(at) / 2.0;
        DVec2::new(self.width.at(at), self.dorsal.at(at) - self.ventral.at(at)) * scale
    }

    /// Height of a section's middle [share of length].
    pub fn height(&self, at: f64) -> f64 {
        (self.dorsal.at(at) + self.ventral.at(at)) / 2.0 * self.breadth
    }

    /// Middle of a section in the whale's frame [m].
    pub fn axis(&self, at: f64) -> DVec3 {
        self.place(at, DVec2::Y * self.height(at))
    }

    /// A point of a section's outline, to port and up; `angle` runs from the back (0) over port to the belly (π) [share of length].
    pub fn outline(&self, at: f64, angle: f64) -> DVec2 {
        DVec2::Y * self.height(at)
            + self.halves(at) * DVec2::new(libm::sin(angle), libm::cos(angle))
    }

    /// A place on the surface [m]; on the midplane `y` is exactly 0.
    pub fn surface(&self, at: f64, angle: f64) -> DVec3 {
        let mut outline = self.outline(at, angle);
        if angle <= 0.0 || angle >= PI {
            outline.x = 0.0;
        }
        self.place(at, outline)
    }

    /// Squared relative distance of a place from the axis: below 1 inside the body, above 1 outside.
    pub fn level(&self, place: DVec3) -> f64 {
        let at = 0.5 - place.x / self.length_m;
        let halves = self.halves(at).max(DVec2::splat(1e-9));
        let offset = DVec2::new(place.y, place.z) / self.length_m - DVec2::Y * self.height(at);
        (offset / halves).length_squared()
    }

    /// Angle from the back at a height of a section, on the port side [rad].
    pub fn angle_of_height(&self, at: f64, height: f64) -> f64 {
        let up = (height * self.breadth - self.height(at)) / self.halves(at).y.max(1e-9);
        libm::acos(up.clamp(-1.0, 1.0))
    }

    /// Intersection of the left flipper's axis with the body [m].
    pub fn flipper_root(&self, form: &WhaleForm) -> DVec3 {
        let flippers = &form.flippers;
        self.place(
            flippers.insertion,
            self.outline(
                flippers.insertion,
                self.angle_of_height(flippers.insertion, flippers.insertion_height),
            ),
        )
    }

    /// Factor on widths and heights before girth [1].
    pub fn breadth(&self) -> f64 {
        self.breadth
    }
}

/// A monotone cubic through points (Fritsch and Carlson 1980): it rises and falls only with the table.
#[derive(Clone, Debug)]
pub struct MonotoneCubic {
    points: Vec<[f64; 2]>,
    slopes: Vec<f64>,
}

impl MonotoneCubic {
    /// A curve through points in rising order of their first number; other points are ignored.
    pub fn through(points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let mut rising: Vec<[f64; 2]> = Vec::new();
        for point in points {
            if rising.last().is_none_or(|last| point[0] > last[0]) {
                rising.push(point);
            }
        }
        let slopes = slopes(&rising);
        Self { points: rising, slopes }
    }

    /// The value of the curve, constant beyond its ends; 0 for a curve without points.
    pub fn at(&self, x: f64) -> f64 {
        let above = self.points.partition_point(|point| point[0] <= x);
        match (
            above.checked_sub(1).and_then(|below| self.points.get(below)),
            self.points.get(above),
        ) {
            (Some(&low), Some(&high)) => self.between(above - 1, low, high, x),
            (Some(end), None) | (None, Some(end)) => end[1],
            (None, None) => 0.0,
        }
    }

    fn between(&self, index: usize, low: [f64; 2], high: [f64; 2], x: f64) -> f64 {
        let width = high[0] - low[0];
        let t = (x - low[0]) / width;
        let (t2, t3) = (t * t, t * t * t);
        low[1] * (2.0 * t3 - 3.0 * t2 + 1.0)
            + high[1] * (3.0 * t2 - 2.0 * t3)
            + width
                * (self.slopes[index] * (t3 - 2.0 * t2 + t) + self.slopes[index + 1] * (t3 - t2))
    }
}

/// Slope at each point: the harmonic mean of the adjacent slopes if they have equal sign, else 0.
fn slopes(points: &[[f64; 2]]) -> Vec<f64> {
    let rises: Vec<f64> = points
        .windows(2)
        .map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]))
        .collect();
    (0..points.len())
        .map(|index| match (index.checked_sub(1).map(|before| rises[before]), rises.get(index)) {
            (Some(before), Some(&after)) if before * after > 0.0 => {
                2.0 * before * after / (before + after)
            }
            (Some(_), Some(_)) | (None, None) => 0.0,
            (Some(rise), None) | (None, Some(&rise)) => rise,
        })
        .collect()
}

/// Smooth step: 0 below `low`, 1 above `high`.
pub fn smooth_step(low: f64, high: f64, x: f64) -> f64 {
    if high <= low {
        return if x < low { 0.0 } else { 1.0 };
    }
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_passes_through_the_table_and_never_overshoots() {
        let table = [[0.0, 1.0], [1.0, 3.0], [1.5, 3.0], [4.0, -2.0], [5.0, 0.0]];
        let curve = MonotoneCubic::through(table);
        for [x, y] in table {
            assert!((curve.at(x) - y).abs() < 1e-12);
        }
        for step in 0..=500 {
            let value = curve.at(f64::from(step) / 100.0);
            assert!((-2.0 - 1e-12..=3.0 + 1e-12).contains(&value));
        }
        assert!((curve.at(1.2) - 3.0).abs() < 1e-12, "level between equal points");
        assert!((curve.at(-1.0) - 1.0).abs() < 1e-12 && curve.at(9.0).abs() < 1e-12);
    }

    /// A straight line is reproduced.
    #[test]
    fn a_line_stays_a_line() {
        let curve = MonotoneCubic::through([[0.0, 1.0], [0.3, 1.6], [2.0, 5.0]]);
        for step in 0..=20 {
            let x = f64::from(step) / 10.0;
            assert!((curve.at(x) - 1.0 - 2.0 * x).abs() < 1e-12);
        }
    }
}

//! The trunk: from the corner of the mouth to the flukes, with a hole on the side where the flipper grows.

use endline_sdk::Region;

use super::Builder;
use super::layout::{HALF_AROUND, HOLE};
use super::mesh::Corner;

/// The ends of the trunk's skin that other parts grow from.
pub struct Trunk {
    /// Row at the corner of the mouth, from back to belly.
    pub front: Vec<u32>,
    /// Row at the flukes, from back to belly.
    pub back: Vec<u32>,
    /// Rim of the flipper's hole, from its upper front corner down and round.
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

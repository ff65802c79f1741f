//! The head ahead of the corner of the mouth: two jaws that part at the trunk's front row, each closed at its tip.

use std::f64::consts::TAU;

use endline_sdk::Region;
use endline_sim::whale::Mark;
use glam::DVec2;

use super::Builder;
use super::jaws::{Halfjaw, INSIDE, Jaws};
use super::layout::{CORNER, corner_at};
use super::mesh::Corner;

/// Rows in each rounded tip, and from there to the corner of the mouth.
const TIP: usize = 4;
const ALONG: usize = 17;
/// Depth of the rounded tip [share of length].
const CAP: f64 = 0.016;
/// Share of the mouth's length, from the tip, that dark gums take.
const GUMS: f64 = 0.16;
/// Angle from the back below which the lips are chin and throat [rad].
const CHIN: f64 = 1.95;

/// Adds the head in front of the trunk's first row.
pub fn add(build: &mut Builder, front: &[u32]) {
    let throat = throat(build, front);
    let closing: Vec<u32> = front[..=CORNER].iter().chain(&throat).copied().collect();
    let upper = Jaw { upper: true };
    upper.add(build, closing);
    let closing: Vec<u32> = throat.iter().rev().chain(&front[CORNER..]).copied().collect();
    Jaw { upper: false }.add(build, closing);
}

/// The line across the mouth's back end where palate and floor meet, without the corner itself.
fn throat(build: &mut Builder, front: &[u32]) -> Vec<u32> {
    let (rim, at) = (build.half.place(front[CORNER]), corner_at(build.form));
    let corners: Vec<Corner> = (1..INSIDE)
        .map(|vertex| {
            let mut place = rim;
            place.y *= 1.0 - vertex as f64 / (INSIDE - 1) as f64;
            Corner { place, weights: build.skeleton.along_body(at), mark: Mark::Mouth }
        })
        .collect();
    build.half.row(corners)
}

/// Where the rows of a jaw stand, from its tip to the last before the corner of the mouth.
fn places(corner: f64) -> Vec<f64> {
    let tip = (1..TIP).map(|row| CAP * (1.0 - libm::cos(TAU / 4.0 * row as f64 / TIP as f64)));
    let along = (0..ALONG).map(|row| {
        let share = row as f64 / ALONG as f64;
        CAP + (corner - CAP) * (share - 0.35 / TAU * libm::sin(TAU * share))
    });
    tip.chain(along).collect()
}

struct Jaw {
    upper: bool,
}

impl Jaw {
    /// Adds rows from the tip back, the last of them `closing`, which belongs to the trunk.
    fn add(&self, build: &mut Builder, closing: Vec<u32>) {
        let corner = corner_at(build.form);
        let mut tip = None;
        let mut before: Option<(f64, Vec<u32>)> = None;
        for at in places(corner) {
            let (at, row) = self.row(build, at);
            match &before {
                Some((front, last)) => self.strip(build, [*front, at], last, &row),
                None => tip = Some(row.clone()),
            }
            before = Some((at, row));
        }
        if let Some((at, row)) = before {
            self.strip(build, [at, corner], &row, &closing);
        }
        if let Some(row) = tip {
            self.tip(build, &row);
        }
    }

    fn strip(&self, build: &mut Builder, [front, back]: [f64; 2], before: &[u32], row: &[u32]) {
        let regions = self.regions(build, (front + back) / 2.0);
        build.half.strip(before, row, |patch| regions.get(patch).copied());
    }

    /// Closes the tip by a pole.
    fn tip(&self, build: &mut Builder, row: &[u32]) {
        let ends = [build.half.place(row[0]), build.half.place(row[row.len() - 1])];
        let mut place = (ends[0] + ends[1]) / 2.0;
        let at = if self.upper { 0.0 } else { jaws(build).lower_place(0.0) };
        place.x = (0.5 - at) * build.form.length_m;
        let mark = if self.upper && build.form.head.callosity_m > 0.0 {
            Mark::Callosity
        } else {
            Mark::Skin
        };
        let pole = Corner { place, weights: self.weights(build, at, None), mark };
        let pole = build.half.add(pole);
        let regions = self.regions(build, at);
        build.half.fan_out(pole, row, |patch| regions[patch]);
    }

    fn row(&self, build: &mut Builder, at: f64) -> (f64, Vec<u32>) {
        let jaws = jaws(build);
        let at = if self.upper { at } else { jaws.lower_place(at) };
        let half = if self.upper { jaws.upper(at) } else { jaws.lower(at) };
        let corners = if self.upper {
            self.upper_row(build, at, &half)
        } else {
            self.lower_row(build, at, &half)
        };
        (at, build.half.row(corners))
    }

    fn upper_row(&self, build: &Builder, at: f64, half: &Halfjaw) -> Vec<Corner> {
        let outside = half
            .outside
            .iter()
            .zip(&half.angles)
            .map(|(&place, &angle)| self.outer(build, at, place, angle));
        let hang = jaws(build).hang(at);
        let inside = half.inside.iter().enumerate().skip(1).map(|(vertex, &place)| {
            let mark =
                if vertex < 10 && hang > 0.004 { Mark::Baleen } else { self.within(build, at) };
            self.inner(build, at, place, vertex, mark)
        });
        outside.chain(inside).collect()
    }

    fn lower_row(&self, build: &Builder, at: f64, half: &Halfjaw) -> Vec<Corner> {
        let inside =
            half.inside.iter().enumerate().skip(1).rev().map(|(vertex, &place)| {
                self.inner(build, at, place, vertex, self.within(build, at))
            });
        let outside = half
            .outside
            .iter()
            .zip(&half.angles)
            .map(|(&place, &angle)| self.outer(build, at, place, angle));
        inside.chain(outside).collect()
    }

    /// What is seen inside: dark gums in front, where the closed lips leave a gap.
    fn within(&self, build: &Builder, at: f64) -> Mark {
        if at < GUMS * corner_at(build.form) { Mark::Skin } else { Mark::Mouth }
    }

    fn outer(&self, build: &Builder, at: f64, offset: DVec2, angle: f64) -> Corner {
        let (mark, relief) = build.marks.head(at, angle, self.upper, jaws(build).gape(at));
        let middle = build.sections.height(at);
        let out = (offset - DVec2::Y * middle).normalize_or_zero();
        let mut place = build.sections.place(at, offset + out * relief);
        if angle <= 0.0 || angle >= std::f64::consts::PI {
            place.y = 0.0;
        }
        Corner { place, weights: self.weights(build, at, Some((angle, 0))), mark }
    }

    fn inner(&self, build: &Builder, at: f64, offset: DVec2, vertex: usize, mark: Mark) -> Corner {
        let mut place = build.sections.place(at, offset);
        if vertex == INSIDE - 1 {
            place.y = 0.0;
        }
        Corner { place, weights: self.weights(build, at, Some((0.0, vertex))), mark }
    }

    fn weights(
        &self,
        build: &Builder,
        at: f64,
        place: Option<(f64, usize)>,
    ) -> super::bones::Weights {
        match place {
            _ if self.upper => build.skeleton.along_body(at),
            Some((angle, inside)) => build.lower_jaw_weights(at, angle, inside),
            None => build.lower_jaw_weights(at, CHIN, 0),
        }
    }

    /// Regions of the patches of a strip.
    fn regions(&self, build: &Builder, at: f64) -> Vec<Region> {
        let jaws = jaws(build);
        let (gape, hang) = (jaws.gape(at), jaws.hang(at));
        let half = if self.upper { jaws.upper(at) } else { jaws.lower(at) };
        let outside = half.angles.windows(2).map(|pair| match (pair[0] + pair[1]) / 2.0 {
            _ if self.upper && (gape < 1.0 || at < 0.1) => Region::Rostrum,
            _ if self.upper => Region::Head,
            angle if angle < CHIN => Region::Lips,
            _ => Region::Head,
        });
        let inside = (0..INSIDE - 1).map(|patch| match patch {
            _ if self.upper && patch < 10 && hang > 0.004 => Region::Baleen,
            _ if !self.upper && patch < 4 => Region::Lips,
            _ => Region::Head,
        });
        if self.upper {
            outside.chain(inside).collect()
        } else {
            inside.rev().chain(outside).collect()
        }
    }
}

fn jaws<'a>(build: &'a Builder<'_>) -> Jaws<'a> {
    Jaws::of(build.form, &build.sections)
}

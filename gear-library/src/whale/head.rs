//! The head ahead of the corner of the mouth: the rostrum with its racks of baleen, and the lower jaw with lips and tongue.
//!
//! A section of the head is two closed curves, here the port half of each, which share the outline of the head. Inside the
//! mouth the lower jaw follows the upper at a small distance, so that the closed mouth contains a thin sheet of water.
//! A groove (the orolabial sulcus) separates lip and baleen.

use std::f64::consts::TAU;

use endline_sdk::Region;
use endline_sim::whale::Mark;
use glam::DVec2;

use super::Builder;
use super::form::WhaleForm;
use super::mesh::Corner;
use super::trunk::{
    CORNER, CORNER_ANGLE, HALF_AROUND, MonotoneCubic, Sections, corner_at, mouth_angle, smooth_step,
};

/// Rows in each rounded tip, and from there to the corner of the mouth.
const TIP: usize = 4;
const ALONG: usize = 17;
/// Depth of the rounded tip [share of length].
const CAP: f64 = 0.016;
/// Length of the dark gums from the tip [share of the mouth's length].
const GUMS: f64 = 0.16;
/// Angle from the back at which lips become chin and throat [rad].
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

/// The line across the back of the mouth where palate and floor meet, without the corner.
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

/// Places of the rows of a jaw, from its tip to the last one before the corner of the mouth.
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

    /// Mark inside the mouth: dark gums in front, at the gap of the closed lips.
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

/// Vertices inside the mouth from the rim to the midplane, both counted.
pub const INSIDE: usize = 13;
/// Distance of the lower jaw's tip behind the snout's [share of length].
const CHIN_BACK: f64 = 0.007;
/// Gap between the closed jaws inside the mouth [share of length].
const ROOM: f64 = 0.0038;
/// Gap between rostrum and lip of the closed mouth [share of length].
const GAPE: f64 = 0.0016;

/// Additional gap at the lip's foot near the corner of the mouth, where the opening jaw moves it aft [share of length].
const SWING: f64 = 0.02;
/// Minimum thickness of the lip [share of length].
const LIP: f64 = 0.012;

/// Half a section of a jaw: outside from the midplane to the rim of the mouth, inside from the rim to the midplane [share of length].
pub struct Halfjaw {
    /// Angles from the back of the outside's vertices, in the order of the columns [rad].
    pub angles: Vec<f64>,
    /// Outside, in the order of the columns.
    pub outside: Vec<DVec2>,
    /// Inside, from the rim (its first vertex is the outside's) to the midplane.
    pub inside: Vec<DVec2>,
}

/// The jaws of a form.
pub struct Jaws<'a> {
    sections: &'a Sections,
    corner: f64,
    gape: MonotoneCubic,
    roof: MonotoneCubic,
    baleen: f64,
    lip: f64,
}

impl<'a> Jaws<'a> {
    /// The jaws of a form.
    pub fn of(form: &WhaleForm, sections: &'a Sections) -> Self {
        let head = &form.head;
        let narrow = libm::asin(head.rostrum_width.clamp(0.05, 0.95));
        let (low, mean) = (narrow.max(0.2), |share: f64| narrow + (CORNER_ANGLE - narrow) * share);
        let gape = [
            [0.0, CORNER_ANGLE],
            [0.08, mean(0.93)],
            [0.2, mean(0.58)],
            [0.33, mean(0.22)],
            [0.5, mean(0.0)],
            [0.65, low],
            [0.82, mean(0.16)],
            [0.93, mean(0.42)],
            [1.0, mean(0.6)],
        ];
        let roof =
            [[0.0, 0.0], [0.2, 0.010], [0.45, 0.020], [0.7, 0.017], [0.9, 0.008], [1.0, 0.004]];
        Self {
            sections,
            corner: corner_at(form),
            gape: MonotoneCubic::through(gape),
            roof: MonotoneCubic::through(roof),
            baleen: head.baleen,
            lip: head.lip_arch,
        }
    }

    /// Place between the corner of the mouth (0) and the snout's tip (1).
    fn ahead(&self, at: f64) -> f64 {
        1.0 - at / self.corner
    }

    /// Angle from the back at which the mouth opens [rad].
    pub fn gape(&self, at: f64) -> f64 {
        self.gape.at(self.ahead(at))
    }

    /// Length of baleen at a place [share of length].
    pub fn hang(&self, at: f64) -> f64 {
        let ahead = self.ahead(at);
        let grown = smooth_step(0.10, 0.42, ahead) * (1.0 - smooth_step(0.62, 0.86, ahead));
        let most = 0.64 * self.below(at) - self.roof(at) - LIP * self.sections.breadth();
        self.baleen.min(most).max(0.0) * grown
    }

    /// Depth of the palate below the rim of the mouth, between the racks [share of length].
    fn roof(&self, at: f64) -> f64 {
        (self.roof.at(self.ahead(at)) * self.sections.breadth()).min(0.22 * self.below(at))
    }

    /// Height of the rim of the mouth above the belly [share of length].
    fn below(&self, at: f64) -> f64 {
        self.sections.halves(at).y * (1.0 + libm::cos(self.gape(at)))
    }

    /// Half a section of the upper jaw.
    pub fn upper(&self, at: f64) -> Halfjaw {
        let gape = self.gape(at) - self.slit(at);
        let angles: Vec<f64> =
            (0..=CORNER).map(|column| mouth_angle(gape, column as f64)).collect();
        let outside: Vec<DVec2> =
            angles.iter().map(|&angle| self.sections.outline(at, angle)).collect();
        let inside = self.merged(at, outside[CORNER], &self.palate(at));
        capped(at / CAP, 0.6, angles, outside, inside)
    }

    /// Half a section of the lower jaw.
    pub fn lower(&self, at: f64) -> Halfjaw {
        let gape = self.gape(at) + self.slit(at);
        let angles: Vec<f64> =
            (CORNER..=HALF_AROUND).map(|column| mouth_angle(gape, column as f64)).collect();
        let outside: Vec<DVec2> =
            angles.iter().map(|&angle| self.sections.outline(at, angle)).collect();
        let inside = self.merged(at, outside[0], &self.floor(at));
        capped((at - CHIN_BACK) / (CAP * 0.9), 0.8, angles, outside, inside)
    }

    /// Place of the lower jaw's section that belongs to one of the upper jaw [share of length].
    pub fn lower_place(&self, at: f64) -> f64 {
        let left = (1.0 - at / (CAP + 2.0 * CHIN_BACK)).max(0.0);
        at + CHIN_BACK * left * left
    }

    /// Half the angle of the closed gape [rad].
    fn slit(&self, at: f64) -> f64 {
        let (ahead, halves) = (self.ahead(at), self.sections.halves(at).max(DVec2::splat(1e-4)));
        0.5 * GAPE * (smooth_step(0.0, 0.1, ahead) + 3.0 * smooth_step(0.84, 0.95, ahead))
            / halves.min_element()
    }

    /// Inside of the upper jaw: outer face of the rack, its lower edge, its inner face, the palate.
    fn palate(&self, at: f64) -> [DVec2; INSIDE] {
        let rim = self.sections.outline(at, self.gape(at) - self.slit(at));
        let roof = self.roof(at);
        let deep = roof + self.hang(at);
        let thick = (0.46 * rim.x).min(0.011 * self.sections.breadth());
        let outer = |share: f64| {
            let height = rim.y - deep * share;
            let lip = self.lip_room(at) * libm::fmin(share / 0.38, 1.0);
            let within = (self.outer_edge(at, height) - lip).max(0.5 * rim.x);
            DVec2::new((rim.x * (1.0 - 0.05 * share)).min(within), height)
        };
        let inner = |share: f64| {
            let height = rim.y - roof - (deep - roof) * share;
            DVec2::new(
                outer((rim.y - height) / deep.max(1e-9)).x - thick * (1.0 - 0.5 * share),
                height,
            )
        };
        let bottom = |share: f64| outer(1.0).lerp(inner(1.0), share);
        let across = |share: f64| {
            DVec2::new(inner(0.0).x * (1.0 - share), rim.y - roof * (1.0 - 0.12 * share))
        };
        [
            rim,
            outer(0.12),
            outer(0.38),
            outer(0.7),
            outer(0.96),
            bottom(0.25),
            bottom(0.75),
            inner(0.92),
            inner(0.55),
            inner(0.12),
            across(0.3),
            across(0.65),
            across(1.0),
        ]
    }

    /// Inside of the lower jaw: inner face of the lip, the groove below the rack, the tongue's side and back.
    fn floor(&self, at: f64) -> [DVec2; INSIDE] {
        let upper = self.palate(at);
        let rim = self.sections.outline(at, self.gape(at) + self.slit(at));
        let (ahead, breadth) = (self.ahead(at), self.sections.breadth());
        let (room, front) = (
            ROOM * breadth,
            (0.012 * breadth).min(0.2 * self.below(at)) * smooth_step(0.80, 0.95, ahead),
        );
        let beside = self.beside(at);
        let groove = |share: f64| (self.lip * self.hang(at) + self.swing(at)) * share;
        let lip = |vertex: usize, share: f64| {
            let height = upper[vertex].y - room * (1.0 - beside + beside * share) - 0.6 * front;
            let edge = self.outer_edge(at, height);
            let most = edge - (LIP * breadth * beside * share).max(0.15 * edge * (1.0 - beside));
            DVec2::new((upper[vertex].x + room * beside + groove(share)).min(most), height)
        };
        let under =
            |vertex: usize, side: f64| upper[vertex] + DVec2::new(side * beside, -room - front);
        let tongue = |vertex: usize| {
            DVec2::new((upper[vertex].x - room * beside).max(0.0), upper[vertex].y - room - front)
        };
        let back = |vertex: usize| {
            let share = upper[vertex].x / upper[9].x.max(1e-9);
            DVec2::new(
                (upper[vertex].x - room * beside * share).max(0.0),
                upper[vertex].y - room - front,
            )
        };
        [
            rim,
            lip(1, 0.12 / 0.38),
            lip(2, 1.0),
            lip(3, 1.0),
            lip(4, 1.0),
            under(5, 0.8 * room + groove(0.6)),
            under(6, -0.5 * room),
            tongue(7),
            tongue(8),
            tongue(9),
            back(10),
            back(11),
            back(12),
        ]
    }

    /// 1 where the lip is beside a rack, 0 where it is below the palate at the tip.
    fn beside(&self, at: f64) -> f64 {
        smooth_step(0.0, 0.02, self.hang(at)).max(1.0 - smooth_step(0.5, 0.6, self.ahead(at)))
    }

    /// Additional gap for the lip's foot near the corner of the mouth [share of length].
    fn swing(&self, at: f64) -> f64 {
        let ahead = self.ahead(at);
        SWING
            * self.sections.breadth()
            * smooth_step(0.02, 0.2, ahead)
            * (1.0 - smooth_step(0.38, 0.6, ahead))
    }

    /// Space for the lip between the upper jaw and the head's outline [share of length].
    fn lip_room(&self, at: f64) -> f64 {
        ((LIP + ROOM) * self.sections.breadth() + self.swing(at)) * self.beside(at)
    }

    /// Half width of the head's outline at a height [share of length].
    fn outer_edge(&self, at: f64, height: f64) -> f64 {
        let halves = self.sections.halves(at);
        let up = ((height - self.sections.height(at)) / halves.y.max(1e-9)).clamp(-1.0, 1.0);
        halves.x * libm::sqrt(1.0 - up * up)
    }

    /// The inside of a jaw, flattened towards the corner of the mouth, where palate and floor meet in a line.
    fn merged(&self, at: f64, rim: DVec2, full: &[DVec2; INSIDE]) -> Vec<DVec2> {
        let grown = smooth_step(-0.04, 0.26, self.ahead(at));
        let grown = (grown - smooth_step(-0.04, 0.26, 0.0)) / (1.0 - smooth_step(-0.04, 0.26, 0.0));
        let flat =
            |vertex: usize| DVec2::new(rim.x * (1.0 - vertex as f64 / (INSIDE - 1) as f64), rim.y);
        full.iter().enumerate().map(|(vertex, &place)| flat(vertex).lerp(place, grown)).collect()
    }
}

/// A section contracted about its middle, at a share `lift` of its height, near a jaw's tip; `depth` is 0 at the tip and 1 at
/// the end of the rounding.
fn capped(
    depth: f64,
    lift: f64,
    angles: Vec<f64>,
    outside: Vec<DVec2>,
    inside: Vec<DVec2>,
) -> Halfjaw {
    let off = (1.0 - depth).clamp(0.0, 1.0);
    let left = libm::sqrt(1.0 - off * off);
    let (low, high) = outside
        .iter()
        .chain(&inside)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| {
            (low.min(place.y), high.max(place.y))
        });
    let middle = DVec2::Y * (low + (high - low) * lift);
    let draw = |places: Vec<DVec2>| {
        places.into_iter().map(|place| middle + (place - middle) * left).collect()
    };
    Halfjaw { angles, outside: draw(outside), inside: draw(inside) }
}

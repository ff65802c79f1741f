//! The port half of a skin, built from rows of vertices and closed by its mirror image; marks and callosities.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use endline_sdk::Region;
use endline_sim::whale::{Mark, Skin};
use glam::DVec3;

use super::bones::{Skeleton, Weights};
use super::form::WhaleForm;
use super::trunk::{corner_at, smooth_step};

/// A vertex before it is added to a skin: place in the whale's frame [m], weights, mark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Rest place [m].
    pub place: DVec3,
    /// Bones that move it.
    pub weights: Weights,
    /// Its mark.
    pub mark: Mark,
}

/// The port half of a skin, open at the midplane, where `y` is 0.
#[derive(Clone, Debug, Default)]
pub struct Half {
    corners: Vec<Corner>,
    triangles: Vec<[u32; 3]>,
    regions: Vec<Region>,
}

impl Half {
    /// Adds a vertex; returns its number.
    pub fn add(&mut self, corner: Corner) -> u32 {
        self.corners.push(corner);
        index(self.corners.len() - 1)
    }

    /// Adds a row of vertices; returns their numbers.
    pub fn row(&mut self, corners: impl IntoIterator<Item = Corner>) -> Vec<u32> {
        corners.into_iter().map(|corner| self.add(corner)).collect()
    }

    /// Place of a vertex [m].
    pub fn place(&self, vertex: u32) -> DVec3 {
        self.corners[vertex as usize].place
    }

    /// Its bones.
    pub fn weights(&self, vertex: u32) -> Weights {
        self.corners[vertex as usize].weights
    }

    /// Adds skin between two rows of equal length: seen from outside with the first row on the left, the rows run up.
    /// `region` returns the region of a patch by its number in the row; `None` leaves a hole.
    pub fn strip(&mut self, left: &[u32], right: &[u32], region: impl Fn(usize) -> Option<Region>) {
        for (patch, (low, high)) in left.windows(2).zip(right.windows(2)).enumerate() {
            if let Some(region) = region(patch) {
                self.patch([low[0], low[1], high[1], high[0]], region);
            }
        }
    }

    /// Adds skin between two closed rows, as [`strip`](Self::strip).
    pub fn ring(&mut self, left: &[u32], right: &[u32], region: impl Fn(usize) -> Option<Region>) {
        let closed = |row: &[u32]| row.iter().chain(row.first()).copied().collect::<Vec<u32>>();
        self.strip(&closed(left), &closed(right), region);
    }

    /// Adds skin between a pole on the left and a row on the right.
    pub fn fan_out(&mut self, pole: u32, row: &[u32], region: impl Fn(usize) -> Region) {
        for (patch, pair) in row.windows(2).enumerate() {
            self.triangle([pole, pair[1], pair[0]], region(patch));
        }
    }

    /// Adds skin between a closed row on the left and a pole on the right.
    pub fn fan_in(&mut self, row: &[u32], pole: u32, region: impl Fn(usize) -> Region) {
        for (patch, &vertex) in row.iter().enumerate() {
            self.triangle([vertex, row[(patch + 1) % row.len()], pole], region(patch));
        }
    }

    /// Removes vertices without a triangle, such as those inside the flipper's hole.
    fn tidy(&mut self) {
        let mut used = vec![false; self.corners.len()];
        self.triangles.iter().flatten().for_each(|&corner| used[corner as usize] = true);
        let mut kept = 0;
        let numbers: Vec<u32> = used
            .iter()
            .map(|&used| {
                kept += usize::from(used);
                index(kept.saturating_sub(1))
            })
            .collect();
        self.triangles.iter_mut().flatten().for_each(|corner| *corner = numbers[*corner as usize]);
        let mut keep = used.iter();
        self.corners.retain(|_| keep.next().copied().unwrap_or(false));
    }

    fn triangle(&mut self, corners: [u32; 3], region: Region) {
        self.triangles.push(corners);
        self.regions.push(region);
    }

    /// Adds a patch of four corners, divided along its shorter diagonal.
    fn patch(&mut self, [a, b, c, d]: [u32; 4], region: Region) {
        let long = |from: u32, to: u32| self.place(from).distance_squared(self.place(to));
        let halves =
            if long(a, c) <= long(b, d) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        halves.into_iter().for_each(|half| self.triangle(half, region));
    }

    /// The whole skin: this half and its mirror image, which share the vertices of the midplane.
    pub fn whole(mut self, skeleton: Skeleton) -> Skin {
        self.tidy();
        let half = self.corners.len();
        let mut other = BTreeMap::new();
        for vertex in 0..half {
            let corner = self.corners[vertex];
            let own = if corner.place.y == 0.0 {
                index(vertex)
            } else {
                self.add(mirrored(&corner, &skeleton))
            };
            other.insert(index(vertex), own);
        }
        for triangle in 0..self.triangles.len() {
            let [a, b, c] = self.triangles[triangle].map(|corner| other[&corner]);
            self.triangle([a, c, b], self.regions[triangle].mirrored());
        }
        Skin {
            vertices: self.corners.iter().map(|corner| corner.place).collect(),
            triangles: self.triangles,
            regions: self.regions,
            weights: self.corners.iter().map(|corner| corner.weights).collect(),
            marks: self.corners.iter().map(|corner| corner.mark).collect(),
            bones: skeleton.bones,
        }
    }
}

/// The mirror image of a vertex, with the bones of the other side.
fn mirrored(corner: &Corner, skeleton: &Skeleton) -> Corner {
    Corner {
        place: corner.place * DVec3::new(1.0, -1.0, 1.0),
        weights: corner.weights.map(|(mover, weight)| (skeleton.other_side(mover), weight)),
        mark: corner.mark,
    }
}

/// A vertex number; a whale has thousands, not billions.
fn index(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

/// A patch of callosity: middle and half length along the head [share of the mouth's length], middle and half
/// width round it, from the back [share of the gape's angle, or rad past the gape on the lower jaw], height [share of the bonnet's].
struct Patch {
    upper: bool,
    at: [f64; 2],
    angle: [f64; 2],
    height: f64,
}

/// Positions: bonnet, rostral islands, coaming, behind the blowholes, above the eye, chin, lip (facts 4.5); sizes by eye.
const PATCHES: [Patch; 9] = [
    Patch { upper: true, at: [0.09, 0.09], angle: [0.0, 0.65], height: 1.0 },
    Patch { upper: true, at: [0.33, 0.07], angle: [0.0, 0.55], height: 0.7 },
    Patch { upper: true, at: [0.56, 0.06], angle: [0.0, 0.6], height: 0.7 },
    Patch { upper: true, at: [0.63, 0.05], angle: [0.0, 0.8], height: 0.8 },
    Patch { upper: true, at: [0.80, 0.05], angle: [0.0, 0.22], height: 0.5 },
    Patch { upper: true, at: [0.93, 0.04], angle: [0.72, 0.12], height: 0.7 },
    Patch { upper: false, at: [0.10, 0.07], angle: [1.35, 0.28], height: 0.8 },
    Patch { upper: false, at: [0.34, 0.05], angle: [1.2, 0.2], height: 0.5 },
    Patch { upper: false, at: [0.45, 0.10], angle: [0.12, 0.12], height: 0.4 },
];

/// Half width of the white patch behind the navel, from the middle of the belly [rad]; zero without a patch.
fn belly_patch(at: f64) -> f64 {
    let along = (at - 0.52) / 0.07;
    let round = libm::sqrt((1.0 - along * along).max(0.0));
    // An uneven edge, as on living animals.
    round * (0.55 + 0.14 * libm::sin(150.0 * at) + 0.08 * libm::sin(61.0 * at + 1.0))
}

/// Marks of a form.
pub struct Marks {
    relief: f64,
    corner: f64,
}

impl Marks {
    /// The marks of a form.
    pub fn of(form: &WhaleForm) -> Self {
        Self { relief: form.head.callosity_m / form.length_m, corner: corner_at(form) }
    }

    /// Mark of the trunk.
    pub fn trunk(&self, at: f64, angle: f64) -> Mark {
        let eye = (at - (self.corner + 0.004)).abs() < 0.006 && (angle - 1.45).abs() < 0.09;
        match (eye, angle > PI - belly_patch(at)) {
            (true, _) => Mark::Eye,
            (_, true) => Mark::White,
            _ => Mark::Skin,
        }
    }

    /// Mark of the outside of the head, and its relief [share of length].
    pub fn head(&self, at: f64, angle: f64, upper: bool, gape: f64) -> (Mark, f64) {
        if self.relief <= 0.0 {
            return (Mark::Skin, 0.0);
        }
        let round = if upper { angle / gape.max(0.1) } else { angle - gape };
        let on = |patch: &Patch| {
            let near = |value: f64, [middle, half]: [f64; 2]| {
                1.0 - smooth_step(0.5, 1.25, (value - middle).abs() / half)
            };
            near(at / self.corner, patch.at) * near(round, patch.angle)
        };
        let own = PATCHES
            .iter()
            .filter(|patch| patch.upper == upper)
            .map(|patch| (on(patch), patch.height));
        let (most, height) =
            own.fold((0.0, 0.0), |best, patch| if patch.0 > best.0 { patch } else { best });
        let mark = if most > 0.35 { Mark::Callosity } else { Mark::Skin };
        (mark, most * height * self.relief)
    }
}

//! Half a skin, port side, made of rows of vertices; its mirror image closes it.

use std::collections::BTreeMap;

use endline_sdk::Region;
use endline_sim::whale::{Mark, Skin};
use glam::DVec3;

use super::bones::{Skeleton, Weights};

/// A vertex before it joins a skin: place in the whale's frame [m], weights, looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Rest place [m].
    pub place: DVec3,
    /// Bones that move it.
    pub weights: Weights,
    /// What is seen there.
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
    /// Adds a vertex; its number.
    pub fn add(&mut self, corner: Corner) -> u32 {
        self.corners.push(corner);
        index(self.corners.len() - 1)
    }

    /// Adds a row of vertices; their numbers.
    pub fn row(&mut self, corners: impl IntoIterator<Item = Corner>) -> Vec<u32> {
        corners.into_iter().map(|corner| self.add(corner)).collect()
    }

    /// Place of a vertex [m].
    #[must_use]
    pub fn place(&self, vertex: u32) -> DVec3 {
        self.corners[vertex as usize].place
    }

    /// Its bones.
    #[must_use]
    pub fn weights(&self, vertex: u32) -> Weights {
        self.corners[vertex as usize].weights
    }

    /// Skin between two rows of equally many vertices: seen from outside with the first row on the left,
    /// the rows run up. `region` is asked with the place of each patch in the row; none leaves a hole.
    pub fn strip(&mut self, left: &[u32], right: &[u32], region: impl Fn(usize) -> Option<Region>) {
        for (patch, (low, high)) in left.windows(2).zip(right.windows(2)).enumerate() {
            if let Some(region) = region(patch) {
                self.patch([low[0], low[1], high[1], high[0]], region);
            }
        }
    }

    /// Skin between two closed rows, as [`strip`](Self::strip).
    pub fn ring(&mut self, left: &[u32], right: &[u32], region: impl Fn(usize) -> Option<Region>) {
        let closed = |row: &[u32]| row.iter().chain(row.first()).copied().collect::<Vec<u32>>();
        self.strip(&closed(left), &closed(right), region);
    }

    /// Skin between a pole on the left and a row on the right.
    pub fn fan_out(&mut self, pole: u32, row: &[u32], region: impl Fn(usize) -> Region) {
        for (patch, pair) in row.windows(2).enumerate() {
            self.triangle([pole, pair[1], pair[0]], region(patch));
        }
    }

    /// Skin between a closed row on the left and a pole on the right.
    pub fn fan_in(&mut self, row: &[u32], pole: u32, region: impl Fn(usize) -> Region) {
        for (patch, &vertex) in row.iter().enumerate() {
            self.triangle([vertex, row[(patch + 1) % row.len()], pole], region(patch));
        }
    }

    /// Leaves out vertices that no triangle has, as those inside the flipper's hole.
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

    /// A patch of four corners, cut along its shorter diagonal.
    fn patch(&mut self, [a, b, c, d]: [u32; 4], region: Region) {
        let long = |from: u32, to: u32| self.place(from).distance_squared(self.place(to));
        let halves =
            if long(a, c) <= long(b, d) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        halves.into_iter().for_each(|half| self.triangle(half, region));
    }

    /// The whole skin: this half and its mirror image, which share the vertices of the midplane.
    #[must_use]
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

/// A vertex' mirror image, moved by the bones of the other side.
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

//! Closed pieces of skin made of rings, and how they join into one skin.

use endline_sdk::Region;
use endline_sim::whale::{Bone, Mark, Skin};
use glam::DVec3;

/// Bones that move a vertex, with weights that sum to 1.
pub type Weights = [(u16, f64); 4];

/// A vertex before it joins a skin: place in the whale's frame [m], weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Rest place [m].
    pub place: DVec3,
    /// Bones that move it.
    pub weights: Weights,
    /// What is seen there.
    pub mark: Mark,
}

/// A closed piece of skin.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// Vertices.
    pub corners: Vec<Corner>,
    /// Triangles, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Region of each triangle.
    pub regions: Vec<Region>,
}

/// Rings of equally many corners from one pole to the other, with the region of each patch:
/// `regions[r][c]` lies aft of ring `r - 1` and beside column `c`.
pub struct Rings {
    /// Where the first ring closes.
    pub first_pole: Corner,
    /// The rings.
    pub rings: Vec<Vec<Corner>>,
    /// Where the last ring closes.
    pub last_pole: Corner,
}

impl Part {
    /// Closes rings into a piece; `region` is asked with the ring before the patch
    /// (from 0, the patches at the first pole) and the column.
    ///
    /// Patches in the second half of the columns are cut along the other diagonal, so that a
    /// shape that is its own mirror image gets a mesh that is too.
    pub fn closed(rings: &Rings, region: impl Fn(usize, usize) -> Region) -> Self {
        let columns = rings.rings.first().map_or(0, Vec::len);
        let mut part = Self { corners: vec![rings.first_pole], ..Self::default() };
        part.corners.extend(rings.rings.iter().flatten());
        part.corners.push(rings.last_pole);
        let last = rings.rings.len();
        for column in 0..columns {
            let next = (column + 1) % columns;
            let at = |ring: usize, column: usize| index(1 + (ring - 1) * columns + column);
            part.add([0, at(1, column), at(1, next)], region(0, column));
            for ring in 1..last {
                let quad = [at(ring, column), at(ring + 1, column), at(ring + 1, next), at(ring, next)];
                part.add_patch(quad, column < columns / 2, region(ring, column));
            }
            part.add([index(part.corners.len() - 1), at(last, next), at(last, column)], region(last, column));
        }
        if part.volume() < 0.0 {
            part.turn_out();
        }
        part
    }

    /// Volume inside, by the divergence theorem [m³].
    #[must_use]
    pub fn volume(&self) -> f64 {
        let corner = |index: u32| self.corners[index as usize].place;
        self.triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum()
    }

    /// Area of its surface [m²].
    #[must_use]
    pub fn area(&self) -> f64 {
        let corner = |index: u32| self.corners[index as usize].place;
        self.triangles.iter().map(|&[a, b, c]| (corner(b) - corner(a)).cross(corner(c) - corner(a)).length() / 2.0).sum()
    }

    /// Its mirror image in the whale's midplane, with bones and regions of the other side.
    #[must_use]
    pub fn mirrored(&self, bone: impl Fn(u16) -> u16, region: impl Fn(Region) -> Region) -> Self {
        let mirror = |corner: &Corner| Corner {
            place: corner.place * DVec3::new(1.0, -1.0, 1.0),
            weights: corner.weights.map(|(mover, weight)| (bone(mover), weight)),
            mark: corner.mark,
        };
        let mut part = Self {
            corners: self.corners.iter().map(mirror).collect(),
            triangles: self.triangles.clone(),
            regions: self.regions.iter().map(|&own| region(own)).collect(),
        };
        part.turn_out();
        part
    }

    fn add(&mut self, triangle: [u32; 3], region: Region) {
        self.triangles.push(triangle);
        self.regions.push(region);
    }

    fn add_patch(&mut self, [a, b, c, d]: [u32; 4], rising: bool, region: Region) {
        let halves = if rising { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        halves.into_iter().for_each(|half| self.add(half, region));
    }

    fn turn_out(&mut self) {
        self.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
}

/// One skin of several pieces.
#[must_use]
pub fn join(parts: &[Part], bones: Vec<Bone>) -> Skin {
    let mut skin = Skin { bones, ..Skin::default() };
    for part in parts {
        let before = index(skin.vertices.len());
        skin.vertices.extend(part.corners.iter().map(|corner| corner.place));
        skin.weights.extend(part.corners.iter().map(|corner| corner.weights));
        skin.marks.extend(part.corners.iter().map(|corner| corner.mark));
        skin.triangles.extend(part.triangles.iter().map(|triangle| triangle.map(|corner| corner + before)));
        skin.regions.extend(&part.regions);
    }
    skin
}

/// A vertex number; a whale has thousands, not billions.
fn index(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

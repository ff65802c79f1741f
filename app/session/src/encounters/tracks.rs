//! Tracks of whales through an area with gear, and the rope that they meet.
//!
//! A track starts evenly in the area, on an even heading, and consists of straight legs; at each, the heading changes by a normal number.
//! At an edge it continues as its mirror image, so that all tracks together cover the area evenly. The depth of a leg follows the law of
//! depths of the study.
//!
//! Rope is met where it passes through the square of half-width `r` about mid-body, across the track. Upright lines of `n` per area are
//! then met `2 r n` times for each length swum. Each gear is met once by a leg, at its first rope.

use std::f64::consts::TAU;

use endline_gear::Exposure;
use endline_sim::DVec3;
use statrs::distribution::{ContinuousCDF, Normal};

/// A straight piece of a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Its start, east and north [m].
    pub from_m: [f64; 2],
    /// Unit vector along it, east and north.
    pub ahead: [f64; 2],
    /// Its length [m].
    pub length_m: f64,
    /// Its leg.
    pub leg: u64,
    /// Number from 0 to 1 from which the depth of the leg follows.
    pub depth_share: f64,
}

/// A track, piece by piece.
pub(crate) struct Track<'a> {
    exposure: &'a Exposure,
    seed: u64,
    index: u32,
    at_m: [f64; 2],
    heading: f64,
    leg: u64,
    /// Distance left in the leg, and in all [m].
    left_m: [f64; 2],
    depth_share: f64,
}

/// Four even numbers from 0 to 1, by what they are for.
pub(crate) fn even(seed: u64, index: u32, purpose: u64) -> [f64; 4] {
    let mut hasher = blake3::Hasher::new_derive_key("endline track 1");
    hasher.update(&seed.to_le_bytes()).update(&index.to_le_bytes()).update(&purpose.to_le_bytes());
    let bytes = hasher.finalize();
    let whole = |from: usize| {
        bytes.as_bytes()[from..from + 8].iter().fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte))
    };
    // 53 bits, shifted by half so that neither 0 nor 1 occurs.
    [0, 8, 16, 24].map(|from| ((whole(from) >> 11) as f64 + 0.5) / (1_u64 << 53) as f64)
}

/// Purposes of the even numbers of a track that are not those of a leg.
const START: u64 = u64::MAX;
const CHOICE: u64 = u64::MAX - 1;

/// An even number from 0 to 1 that decides which meeting of a track is simulated.
pub(crate) fn choice(seed: u64, index: u32) -> f64 {
    even(seed, index, CHOICE)[0]
}

impl<'a> Track<'a> {
    /// The track of an encounter of a study with this seed.
    pub fn of(exposure: &'a Exposure, seed: u64, index: u32) -> Self {
        let [east, north, heading, _] = even(seed, index, START);
        let [width_m, height_m] = exposure.area_m;
        Self {
            exposure,
            seed,
            index,
            at_m: [(east - 0.5) * width_m, (north - 0.5) * height_m],
            heading: TAU * heading,
            leg: 0,
            left_m: [0.0, exposure.distance_m],
            depth_share: 0.0,
        }
    }

    /// Starts the next leg.
    fn turn(&mut self) {
        let [depth, turn, ..] = even(self.seed, self.index, self.leg);
        if self.leg > 0 {
            self.heading += self.exposure.turn_rad * Normal::standard().inverse_cdf(turn);
        }
        self.leg += 1;
        self.left_m[0] = self.exposure.leg_m;
        self.depth_share = depth;
    }
}

impl Iterator for Track<'_> {
    type Item = Piece;

    fn next(&mut self) -> Option<Piece> {
        if self.left_m[1] <= 0.0 {
            return None;
        }
        if self.left_m[0] <= 0.0 {
            self.turn();
        }
        let ahead = [libm::sin(self.heading), libm::cos(self.heading)];
        let to_edge = |axis: usize| {
            let edge_m = 0.5 * self.exposure.area_m[axis] * ahead[axis].signum();
            if ahead[axis].abs() < 1e-12 {
                return f64::INFINITY;
            }
            ((edge_m - self.at_m[axis]) / ahead[axis]).max(0.0)
        };
        let edges_m = [to_edge(0), to_edge(1)];
        let length_m = edges_m.into_iter().chain(self.left_m).fold(f64::INFINITY, f64::min);
        let piece = Piece {
            from_m: self.at_m,
            ahead,
            length_m,
            leg: self.leg,
            depth_share: self.depth_share,
        };
        for (at_m, ahead) in self.at_m.iter_mut().zip(ahead) {
            *at_m += length_m * ahead;
        }
        // The heading counts from north to east: an edge in the east or west reverses its sine, one in the north or south its cosine.
        if edges_m[0] <= length_m {
            self.heading = -self.heading;
        }
        if edges_m[1] <= length_m {
            self.heading = std::f64::consts::PI - self.heading;
        }
        self.left_m.iter_mut().for_each(|left_m| *left_m -= length_m);
        Some(piece)
    }
}

impl Piece {
    /// Distance along the piece at which a whale at a depth first meets rope of gear, given as segments from the place of the gear;
    /// `None` if it meets none.
    pub fn meets(
        &self,
        gear_m: [f64; 2],
        segments: &[[DVec3; 2]],
        (depth_m, reach_m): (f64, f64),
    ) -> Option<f64> {
        let [east, north] = self.ahead;
        let origin = DVec3::new(self.from_m[0] - gear_m[0], self.from_m[1] - gear_m[1], -depth_m);
        let axes = [DVec3::new(east, north, 0.0), DVec3::new(north, -east, 0.0), DVec3::Z];
        let ranges = [[0.0, self.length_m], [-reach_m, reach_m], [-reach_m, reach_m]];
        let first = |[from, to]: &[DVec3; 2]| {
            let ends = [*from, *to].map(|end| axes.map(|axis| axis.dot(end - origin)));
            let within = clipped(&ends, &ranges)?;
            let along = |share: f64| ends[0][0] + share * (ends[1][0] - ends[0][0]);
            Some(along(within[0]).min(along(within[1])).clamp(0.0, self.length_m))
        };
        segments.iter().filter_map(first).reduce(f64::min)
    }

    /// Least distance of a place from the piece [m].
    pub fn distance_m(&self, place_m: [f64; 2]) -> f64 {
        let off = [place_m[0] - self.from_m[0], place_m[1] - self.from_m[1]];
        let along = (off[0] * self.ahead[0] + off[1] * self.ahead[1]).clamp(0.0, self.length_m);
        libm::hypot(off[0] - along * self.ahead[0], off[1] - along * self.ahead[1])
    }
}

/// The part of a segment that lies within ranges of all coordinates, as shares of the segment; `None` if none does.
fn clipped(ends: &[[f64; 3]; 2], ranges: &[[f64; 2]; 3]) -> Option<[f64; 2]> {
    let mut within = [0.0_f64, 1.0_f64];
    for (axis, [low, high]) in ranges.iter().enumerate() {
        let (from, change) = (ends[0][axis], ends[1][axis] - ends[0][axis]);
        if change.abs() < 1e-12 {
            if from < *low || from > *high {
                return None;
            }
            continue;
        }
        let (one, other) = ((low - from) / change, (high - from) / change);
        within = [within[0].max(one.min(other)), within[1].min(one.max(other))];
    }
    (within[0] <= within[1]).then_some(within)
}

#[cfg(test)]
mod tests {
    use endline_gear::Confidence;

    use super::*;

    fn exposure(turn_rad: f64) -> Exposure {
        Exposure {
            area_m: [2000.0, 1000.0],
            distance_m: 20_000.0,
            leg_m: 150.0,
            turn_rad,
            reach_m: None,
            source: "a test".into(),
            confidence: Confidence::Assumed,
        }
    }

    #[test]
    fn a_track_has_its_length_stays_in_the_area_and_follows_from_its_seed() {
        let exposure = exposure(0.6);
        let pieces: Vec<Piece> = Track::of(&exposure, 3, 7).collect();
        let sum: f64 = pieces.iter().map(|piece| piece.length_m).sum();
        assert!((sum - 20_000.0).abs() < 1e-6, "{sum} m");
        for pair in pieces.windows(2) {
            for axis in 0..2 {
                let end = pair[0].from_m[axis] + pair[0].length_m * pair[0].ahead[axis];
                assert!((pair[1].from_m[axis] - end).abs() < 1e-9, "pieces are connected");
                assert!(end.abs() <= 0.5 * exposure.area_m[axis] + 1e-9, "{end} m");
            }
        }
        assert_eq!(pieces, Track::of(&exposure, 3, 7).collect::<Vec<_>>());
        assert_ne!(pieces, Track::of(&exposure, 4, 7).collect::<Vec<_>>());
    }

    /// The mean cosine of turns with a deviation `s` is `exp(-s²/2)`.
    #[test]
    fn turns_have_their_deviation() {
        let exposure = exposure(0.5);
        let (mut sum, mut count) = (0.0, 0.0);
        for index in 0..200 {
            let pieces: Vec<Piece> = Track::of(&exposure, 1, index).collect();
            for pair in pieces.windows(2).filter(|pair| pair[0].leg != pair[1].leg) {
                let at_edge = (0..2).any(|axis| {
                    (pair[1].from_m[axis].abs() - 0.5 * exposure.area_m[axis]).abs() < 1e-6
                });
                if !at_edge {
                    let [one, other] = [pair[0].ahead, pair[1].ahead];
                    sum += one[0] * other[0] + one[1] * other[1];
                    count += 1.0;
                }
            }
        }
        let expected = (-0.125_f64).exp();
        assert!((sum / count - expected).abs() < 0.005, "{} of {expected}", sum / count);
    }

    /// Upright lines at even places, straight and winding tracks: `2 r n` meetings for each metre, within 2 %.
    #[test]
    fn upright_lines_are_met_by_breadth_density_and_distance() {
        let (reach_m, lines) = (2.5, 80);
        let upright = [[DVec3::ZERO, DVec3::new(0.0, 0.0, -30.0)]];
        for turn_rad in [0.0, 0.6] {
            let exposure = exposure(turn_rad);
            let places: Vec<[f64; 2]> = (0..lines)
                .map(|line| {
                    let [east, north, ..] = even(99, line, 5);
                    // No line is so near to an edge that the edge cuts off a part of its breadth.
                    [(east - 0.5) * 1990.0, (north - 0.5) * 990.0]
                })
                .collect();
            let (mut met, mut way_m) = (0.0, 0.0);
            for index in 0..1500 {
                for piece in Track::of(&exposure, 5, index) {
                    way_m += piece.length_m;
                    let near = places.iter().filter(|place| {
                        piece.distance_m(**place) < 2.0 * reach_m
                            && piece.meets(**place, &upright, (12.0, reach_m)).is_some()
                    });
                    met += near.count() as f64;
                }
            }
            let expected = 2.0 * reach_m * f64::from(lines) / (2000.0 * 1000.0);
            let ratio = met / way_m / expected;
            println!("turns of {turn_rad} rad: {met} meetings, {ratio} of 2 r n");
            assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
        }
    }

    #[test]
    fn rope_above_or_below_the_whale_is_not_met() {
        let piece = Piece {
            from_m: [0.0, 0.0],
            ahead: [0.0, 1.0],
            length_m: 100.0,
            leg: 1,
            depth_share: 0.5,
        };
        // Rope that rises along the track from 40 m to the surface: the whale at 10 m with a reach of 2 m meets it from 12 m on.
        let rope = [[DVec3::new(0.5, 0.0, -40.0), DVec3::new(0.5, 40.0, 0.0)]];
        let along = piece.meets([0.0, 20.0], &rope, (10.0, 2.0)).unwrap();
        assert!((along - 48.0).abs() < 1e-9, "{along} m");
        assert!(piece.meets([0.0, 20.0], &rope, (50.0, 2.0)).is_none());
        assert!(piece.meets([3.0, 20.0], &rope, (10.0, 2.0)).is_none());
        assert!(piece.meets([0.0, -80.0], &rope, (10.0, 2.0)).is_none(), "it lies behind");
    }
}

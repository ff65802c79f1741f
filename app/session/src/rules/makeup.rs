//! An endline as it is made up, from the buoy down, and the places along it that are weak.

/// An endline, or its upper part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MadeUp {
    /// Pieces from the buoy down; a sleeve or link has no length.
    pub pieces: Vec<Stretch>,
}

/// A piece of an endline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Unstretched length [m].
    pub length_m: f64,
    /// Strength of new material as its source states it [N].
    pub rated_n: f64,
}

/// Places along an endline.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Places {
    /// From and to, from the buoy down [m].
    pub spans_m: Vec<[f64; 2]>,
    /// Length of the endline, or of the part of it that was looked at [m].
    pub length_m: f64,
}

/// A strength that is the limit itself is not above it, whatever its unit did to the last digit.
const ROUNDING: f64 = 1e-9;

impl MadeUp {
    /// Its length [m].
    #[must_use]
    pub fn length_m(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.length_m).sum()
    }

    /// Its upper part, from the buoy to a share of its length.
    #[must_use]
    pub fn upper_part(&self, share: f64) -> Self {
        let mut left_m = share.clamp(0.0, 1.0) * self.length_m();
        let mut pieces = Vec::new();
        for piece in &self.pieces {
            if left_m < 0.0 || (left_m == 0.0 && piece.length_m > 0.0) {
                break;
            }
            pieces.push(Stretch { length_m: piece.length_m.min(left_m), ..*piece });
            left_m -= piece.length_m;
        }
        Self { pieces }
    }

    /// Where it is rated at most this strong; places that touch are one.
    #[must_use]
    pub fn weak_places(&self, most_n: f64) -> Places {
        let (mut spans, mut at_m) = (Vec::<[f64; 2]>::new(), 0.0);
        for piece in &self.pieces {
            let end_m = at_m + piece.length_m;
            if piece.rated_n <= most_n * (1.0 + ROUNDING) {
                match spans.last_mut() {
                    Some(last) if last[1] >= at_m => last[1] = end_m,
                    _ => spans.push([at_m, end_m]),
                }
            }
            at_m = end_m;
        }
        Places { spans_m: spans, length_m: at_m }
    }
}

impl Places {
    /// The longest stretch without one, from the buoy, between two, or to the lower end [m].
    #[must_use]
    pub fn longest_gap_m(&self) -> f64 {
        let starts = self.spans_m.iter().map(|span| span[0]).chain([self.length_m]);
        let ends = [0.0].into_iter().chain(self.spans_m.iter().map(|span| span[1]));
        starts.zip(ends).map(|(start, end)| start - end).fold(0.0, f64::max)
    }

    /// Share of the length that they take.
    #[must_use]
    pub fn share(&self) -> f64 {
        let taken: f64 = self.spans_m.iter().map(|span| span[1] - span[0]).sum();
        if self.length_m > 0.0 { taken / self.length_m } else { 0.0 }
    }

    /// From the buoy to the first; infinite where there is none [m].
    #[must_use]
    pub fn first_m(&self) -> f64 {
        self.spans_m.first().map_or(f64::INFINITY, |span| span[0])
    }

    /// How far the nearest lies from a share of the length, as a share; infinite where there is none.
    #[must_use]
    pub fn from_share(&self, share: f64) -> f64 {
        let at_m = share * self.length_m;
        let away = |span: &[f64; 2]| (span[0] - at_m).max(at_m - span[1]).max(0.0);
        self.spans_m.iter().map(away).fold(f64::INFINITY, f64::min) / self.length_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(pieces: &[(f64, f64)]) -> MadeUp {
        let piece =
            |(length_m, rated_n): &(f64, f64)| Stretch { length_m: *length_m, rated_n: *rated_n };
        MadeUp { pieces: pieces.iter().map(piece).collect() }
    }

    #[test]
    fn weak_places_lie_where_the_line_is_weak_and_gaps_between_them() {
        // 10 m strong, 1 m weak, 20 m strong, a sleeve, 9 m strong, from the buoy down: 40 m.
        let line = line(&[(10.0, 9.0), (1.0, 5.0), (20.0, 9.0), (0.0, 4.0), (9.0, 9.0)]);
        let weak = line.weak_places(5.0);
        assert_eq!(weak.spans_m, [[10.0, 11.0], [31.0, 31.0]]);
        assert_eq!((weak.longest_gap_m(), weak.first_m()), (20.0, 10.0));
        assert!((weak.share() - 1.0 / 40.0).abs() < 1e-12);
        // A quarter of the line is at 10 m, three quarters at 30 m, 1 m above the sleeve.
        assert!((weak.from_share(0.25), weak.from_share(0.75)) == (0.0, 1.0 / 40.0));
        // The upper half ends at 20 m, 9 m below the insert's lower end.
        let upper = line.upper_part(0.5).weak_places(5.0);
        assert_eq!((upper.spans_m.len(), upper.length_m, upper.longest_gap_m()), (1, 20.0, 10.0));
        assert!(line.weak_places(1.0).first_m().is_infinite());
    }

    #[test]
    fn weak_pieces_that_touch_are_one_place() {
        let weak = line(&[(2.0, 5.0), (3.0, 4.0), (5.0, 9.0)]).weak_places(5.0);
        assert_eq!(weak.spans_m, [[0.0, 5.0]]);
        assert_eq!((weak.share(), weak.longest_gap_m()), (0.5, 5.0));
    }
}

//! An axis-aligned box round what is to be seen.

use glam::DVec3;

/// An axis-aligned box [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least corner.
    pub low: DVec3,
    /// Greatest corner.
    pub high: DVec3,
}

impl Bounds {
    /// The least box round some places; a small box at the origin where there are none.
    #[must_use]
    pub fn of(places: impl IntoIterator<Item = DVec3>) -> Self {
        let empty = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        let all = places.into_iter().filter(|place| place.is_finite());
        let bounds = all.fold(empty, |bounds, place| Self {
            low: bounds.low.min(place),
            high: bounds.high.max(place),
        });
        if bounds.low.x > bounds.high.x {
            Self { low: -DVec3::ONE, high: DVec3::ONE }
        } else {
            bounds
        }
    }

    /// Its middle [m].
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        (self.low + self.high) * 0.5
    }

    /// Half its edges [m].
    #[must_use]
    pub fn half_size(&self) -> DVec3 {
        (self.high - self.low) * 0.5
    }

    /// Its eight corners [m].
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|corner| {
            let pick = |bit: usize, low: f64, high: f64| if corner & bit == 0 { low } else { high };
            DVec3::new(
                pick(1, self.low.x, self.high.x),
                pick(2, self.low.y, self.high.y),
                pick(4, self.low.z, self.high.z),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_that_are_not_finite_do_not_stretch_the_box() {
        let bounds = Bounds::of([DVec3::ZERO, DVec3::NAN, DVec3::new(2.0, 4.0, -6.0)]);
        assert_eq!(
            bounds,
            Bounds { low: DVec3::new(0.0, 0.0, -6.0), high: DVec3::new(2.0, 4.0, 0.0) }
        );
        assert!(bounds.corners().contains(&DVec3::new(2.0, 0.0, -6.0)));
    }

    #[test]
    fn nothing_has_a_small_box() {
        assert_eq!(Bounds::of([]).half_size(), DVec3::ONE);
    }
}

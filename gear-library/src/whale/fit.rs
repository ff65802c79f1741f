//! Fits a body to a mass: how wide it is as a whole, how lean or robust, and late in pregnancy.
//!
//! The closed mesh is built and its volume integrated, so that fins, mouth and callosities count as they are:
//!
//! ```text
//! breadth   b  <-  b sqrt(V / V(b))               all widths and heights alike
//! condition g  <-  g + (V - V(g)) g' / V'         girth (1 + g f(x)), f greatest at 0.6 of length (Miller et al. 2012)
//! ```

use super::curve::MonotoneCubic;
use super::form::WhaleForm;
use super::kept::volume_of;

/// Share of the change of girth by place: most variable at 60 % of length (Miller et al. 2012), none at head and flukes.
const CONDITION: [[f64; 2]; 7] =
    [[0.0, 0.0], [0.18, 0.0], [0.35, 0.55], [0.5, 0.9], [0.6, 1.0], [0.75, 0.6], [0.9, 0.0]];
/// Growth of girth late in pregnancy: 5 to 10 % from 0.5 to 0.7 of length, the calf's bulge at 0.55 to 0.65 (facts 4.3, estimate).
const PREGNANCY: [[f64; 2]; 7] =
    [[0.0, 0.0], [0.4, 0.0], [0.5, 0.05], [0.6, 0.10], [0.7, 0.05], [0.8, 0.0], [1.0, 0.0]];
/// Places of the girth's curve.
const PLACES: u32 = 40;

impl WhaleForm {
    /// This body made wider or narrower, so that its skin holds a volume [m³].
    ///
    /// A volume that is no positive number changes nothing.
    #[must_use]
    pub fn displacing(mut self, volume_m3: f64) -> Self {
        for _ in 0..5 {
            let held = self.skin_volume_m3();
            if held > 0.0 && volume_m3 > 0.0 && volume_m3.is_finite() {
                self.breadth_scale =
                    (self.breadth_scale * libm::sqrt(volume_m3 / held)).clamp(0.2, 3.0);
            }
        }
        self
    }

    /// This whale made leaner (below 1) or more robust (above 1): `condition` is its volume over that of
    /// this body [1].
    ///
    /// The girth changes most at 60 % of length; head and flukes stay as they are.
    #[must_use]
    pub fn in_condition(self, condition: f64) -> Self {
        if (condition - 1.0).abs() < f64::EPSILON {
            return self;
        }
        let volume = self.skin_volume_m3();
        let fuller = |girth: f64| self.clone().with_girth(&CONDITION, girth);
        let (mut before, mut girth) = ([0.0, volume], (condition - 1.0) * 0.6);
        for _ in 0..5 {
            let held = fuller(girth).skin_volume_m3();
            let rise = (held - before[1]) / (girth - before[0]);
            if !(rise > 0.0 && rise.is_finite()) {
                break;
            }
            before = [girth, held];
            girth = (girth + (condition * volume - held) / rise).clamp(-0.6, 1.0);
        }
        fuller(girth)
    }

    /// This whale late in pregnancy.
    #[must_use]
    pub fn pregnant(self) -> Self {
        self.with_girth(&PREGNANCY, 1.0)
    }

    /// Volume that the closed skin holds [m³].
    #[must_use]
    pub fn skin_volume_m3(&self) -> f64 {
        volume_of(self)
    }

    fn with_girth(mut self, shape: &[[f64; 2]], amount: f64) -> Self {
        let (own, shape) = (
            MonotoneCubic::through(self.girth.iter().copied()),
            MonotoneCubic::through(shape.iter().copied()),
        );
        let at = |place: u32| f64::from(place) / f64::from(PLACES);
        self.girth = (0..=PLACES)
            .map(|place| [at(place), own.at(at(place)) * (1.0 + amount * shape.at(at(place)))])
            .collect();
        self
    }
}

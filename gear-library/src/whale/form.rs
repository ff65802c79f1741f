//! Measures of a whale's body, their fit to a mass, and the measures of the North Atlantic right whale.
//!
//! Every length except `length_m` is a share of body length, so that one form applies to all ages.
//!
//! The fit integrates the volume `V` of the closed mesh, which includes fins, mouth and callosities:
//!
//! ```text
//! breadth   b  <-  b sqrt(V / V(b))               factor on all widths and heights
//! condition g  <-  g + (V - V(g)) g' / V'         girth (1 + g f(x)), f greatest at 0.6 of length (Miller et al. 2012)
//! ```

use std::f64::consts::PI;

use serde::Deserialize;

use crate::items::{Growth, MassLaw};

use super::trunk::MonotoneCubic;
use super::volume_of;

/// Measures of a whale's body.
#[derive(Clone, Debug, PartialEq)]
pub struct WhaleForm {
    /// Body length, snout to fluke notch [m].
    pub length_m: f64,
    /// Body sections from snout (0) to fluke notch (1), in rising order of `at`; at least four.
    pub stations: Vec<Station>,
    /// Factor on all widths and heights of the body, for agreement of displaced volume and mass [1].
    pub breadth_scale: f64,
    /// Factor on widths and heights along the body, by share of length, for condition and pregnancy; at least one.
    pub girth: Vec<[f64; 2]>,
    /// Head.
    pub head: HeadForm,
    /// Start of the peduncle (tail stock) [share of length from the snout].
    pub peduncle_start: f64,
    /// Places of the spine joints, from the neck (0) aft, in rising order [share of length from the snout].
    pub spine_joints: [f64; endline_sdk::SPINE_JOINTS],
    /// Flippers.
    pub flippers: FlipperForm,
    /// Flukes.
    pub flukes: FlukesForm,
}

/// One body section; heights are above the level of the snout's tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Place along the body [share of length from the snout].
    pub at: f64,
    /// Full width [share of length].
    pub width: f64,
    /// Height of the back [share of length].
    pub dorsal: f64,
    /// Height of the belly, negative below the snout [share of length].
    pub ventral: f64,
}

/// Head and mouth.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub struct HeadForm {
    /// Length of the head [share of length].
    pub share: f64,
    /// Snout to the corner of the mouth [share of length].
    pub mouth: f64,
    /// Width of the rostrum [share of the head's width].
    pub rostrum_width: f64,
    /// Distance of the arched lower lips from the baleen at their foot [share of the baleen's length there].
    pub lip_arch: f64,
    /// Length of the longest baleen plate [share of length].
    pub baleen: f64,
    /// Relief of the highest callosity, the bonnet; 0 without callosities [m].
    #[serde(rename = "callosities", default)]
    pub callosity_m: f64,
}

/// A pair of flippers: paddles with a blunt, nearly square tip.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub struct FlipperForm {
    /// Middle of the insertion along the body [share of length from the snout].
    pub insertion: f64,
    /// Height of the insertion [share of length above the snout].
    pub insertion_height: f64,
    /// Insertion to tip [share of length].
    pub span: f64,
    /// Chord at the insertion [share of length].
    pub root_chord: f64,
    /// Greatest chord [share of length].
    pub max_chord: f64,
    /// Place of the greatest chord [share of span].
    pub max_chord_at: f64,
    /// Chord near the tip before its rounding [share of length].
    pub tip_chord: f64,
    /// Thickness over chord at the insertion [1].
    pub thickness: f64,
    /// Thickness over chord near the tip [1].
    pub tip_thickness: f64,
    /// Sweep aft at rest [rad].
    pub sweep: f64,
    /// Droop of the tip below the horizontal at rest [rad].
    pub droop: f64,
    /// Radius of the edges [m].
    #[serde(rename = "edge_radius")]
    pub edge_radius_m: f64,
}

/// A pair of flukes.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub struct FlukesForm {
    /// Tip to tip [share of length].
    pub span: f64,
    /// Insertion to notch [share of length].
    pub root_chord: f64,
    /// Chord near the tips before their rounding [share of length].
    pub tip_chord: f64,
    /// Sweep of the leading edge aft, mean along the span [rad].
    pub sweep: f64,
    /// Thickness over chord at the midline [1].
    pub thickness: f64,
    /// Thickness over chord near the tips [1].
    pub tip_thickness: f64,
    /// Depth of the notch between the trailing edges [share of length].
    pub notch: f64,
    /// Height of the flukes [share of length above the snout].
    pub height: f64,
    /// Radius of the edges [m].
    #[serde(rename = "edge_radius")]
    pub edge_radius_m: f64,
}

impl WhaleForm {
    /// Volume of the section table as stacked ellipses, before [`breadth_scale`](Self::breadth_scale) [m³].
    pub fn table_volume_m3(&self) -> f64 {
        let area = |s: &Station| PI / 4.0 * s.width * (s.dorsal - s.ventral);
        let share: f64 = self
            .stations
            .windows(2)
            .map(|w| (w[1].at - w[0].at) * (area(&w[0]) + area(&w[1])) / 2.0)
            .sum();
        share * self.length_m * self.length_m * self.length_m
    }
}

/// Relative change of girth by place: greatest at 60 % of length (Miller et al. 2012), zero at head and flukes.
const CONDITION: [[f64; 2]; 7] =
    [[0.0, 0.0], [0.18, 0.0], [0.35, 0.55], [0.5, 0.9], [0.6, 1.0], [0.75, 0.6], [0.9, 0.0]];
/// Growth of girth late in pregnancy: 5 to 10 % from 0.5 to 0.7 of length, the calf's bulge at 0.55 to 0.65 (facts 4.3, estimate).
const PREGNANCY: [[f64; 2]; 7] =
    [[0.0, 0.0], [0.4, 0.0], [0.5, 0.05], [0.6, 0.10], [0.7, 0.05], [0.8, 0.0], [1.0, 0.0]];
/// Points of the girth curve.
const PLACES: u32 = 40;

impl WhaleForm {
    /// This body with its breadth scaled to a volume [m³]; a volume that is not positive changes nothing.
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

    /// This whale leaner (below 1) or more robust (above 1): `condition` is its volume over that of this body [1].
    /// The girth changes most at 60 % of length; head and flukes do not change.
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
    pub fn pregnant(self) -> Self {
        self.with_girth(&PREGNANCY, 1.0)
    }

    /// Volume of the closed skin [m³].
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

impl WhaleForm {
    /// A North Atlantic right whale (*Eubalaena glacialis*) of a length [m].
    /// The source of each figure is beside it; "estimate" marks figures without a source.
    pub fn right_whale(length_m: f64) -> Self {
        let mut form = Self {
            length_m,
            stations: RIGHT_WHALE_STATIONS
                .iter()
                .map(|&[at, width, dorsal, ventral]| Station { at, width, dorsal, ventral })
                .collect(),
            breadth_scale: 1.0,
            girth: vec![[0.0, 1.0]],
            head: HeadForm {
                share: 0.27,                         // SeaLifeBase: 1/4 to nearly 1/3 of length
                mouth: 0.2345, // Moore et al. 2005, 35 carcasses: 0.2345 L - 0.184 m
                rostrum_width: 0.32, // estimate: 0.25 to 0.35 of the head's width
                lip_arch: 0.11, // estimate
                baleen: 0.128, // Best and Schell 1996, Omura 1969: 0.208 L - 1.095 m
                callosity_m: 0.06 * length_m / 13.7, // recalled: 2 to 8 cm
            },
            peduncle_start: 0.70, // estimate: behind the anus, 0.68 to 0.70 L
            spine_joints: [0.27, 0.36, 0.45, 0.55, 0.64, 0.73, 0.81, 0.885], // estimate: lateral bending spread over 0.35 to 0.9 L
            flippers: right_whale_flippers(),
            flukes: right_whale_flukes(),
        };
        RIGHT_WHALE_GROWTH.proportion(&mut form);
        // Fortune et al. 2020: 1.0 t at 4.3 m, 31.7 t at 13.1 m; sea water 1025 kg/m³.
        form.displacing(RIGHT_WHALE_MASS.mass_kg(length_m) / 1025.0)
    }
}

/// Growth of a right whale's head; sources are beside the shares.
const RIGHT_WHALE_GROWTH: Growth = Growth {
    mouth_offset_m: -0.184,
    baleen_offset_m: -1.095,
    head_width: Some([0.157, -0.106]),
    mass: None,
    age: None,
};
/// Its mass: Fortune et al. 2020.
const RIGHT_WHALE_MASS: MassLaw = MassLaw { length_m: 13.1, mass_kg: 31_700.0, exponent: 3.1026 };

/// Flippers of a right whale.
fn right_whale_flippers() -> FlipperForm {
    FlipperForm {
        insertion: 0.285,             // estimate: 0.27 to 0.30
        insertion_height: -0.055,     // estimate: -0.05 to -0.06
        span: 0.165,                  // Woodward 2006, Omura 1969: 0.15 to 0.18 L (from memory)
        root_chord: 0.062,            // estimate
        max_chord: 0.090,             // from memory: 0.08 to 0.10 L
        max_chord_at: 0.60,           // estimate: "broad, fan-shaped" (SeaLifeBase)
        tip_chord: 0.076,             // estimate: blunt, nearly square tip
        thickness: 0.22,              // from memory: 0.2 to 0.25 near the root
        tip_thickness: 0.09,          // estimate
        sweep: 30.0_f64.to_radians(), // estimate: 20 to 40 degrees
        droop: 25.0_f64.to_radians(), // estimate: 20 to 30 degrees
        edge_radius_m: 0.018,         // estimate: 1 to 3 cm
    }
}

/// Flukes of a right whale.
fn right_whale_flukes() -> FlukesForm {
    FlukesForm {
        span: 0.39,                   // from memory: 0.36 to 0.42 L
        root_chord: 0.10,             // from memory: 0.09 to 0.11 L
        tip_chord: 0.016,             // estimate
        sweep: 30.0_f64.to_radians(), // estimate, from the shape of the flukes in photographs
        thickness: 0.17,              // estimate
        tip_thickness: 0.16,          // estimate: so that the tip's edge has the radius below
        notch: 0.022,                 // estimate: deep notch
        height: 0.004,                // Daoust et al. 2018 outline: end of the body
        edge_radius_m: 0.014,         // estimate: 1 to 3 cm
    }
}

/// Share of length from the snout, width, back and belly, each as a share of length.
///
/// Widths at tenths to 0.8: mesomorphic right whales, photogrammetry of ten animals (C. Miller).
/// Heights: outline of the necropsy drawing of Daoust et al. 2018, 45 points.
/// Widths at 0.85 and aft, and the blunt snout: estimate.
const RIGHT_WHALE_STATIONS: [[f64; 4]; 21] = [
    [0.00, 0.070, 0.020, -0.030],
    [0.05, 0.110, 0.041, -0.053],
    [0.10, 0.149, 0.063, -0.060],
    [0.15, 0.170, 0.077, -0.066],
    [0.20, 0.191, 0.083, -0.073],
    [0.25, 0.209, 0.100, -0.082],
    [0.30, 0.226, 0.106, -0.088],
    [0.35, 0.223, 0.109, -0.093],
    [0.40, 0.220, 0.111, -0.100],
    [0.45, 0.214, 0.111, -0.101],
    [0.50, 0.207, 0.106, -0.097],
    [0.55, 0.192, 0.101, -0.089],
    [0.60, 0.176, 0.096, -0.081],
    [0.65, 0.151, 0.088, -0.074],
    [0.70, 0.126, 0.079, -0.066],
    [0.75, 0.095, 0.069, -0.054],
    [0.80, 0.063, 0.056, -0.041],
    [0.85, 0.049, 0.044, -0.026],
    [0.90, 0.034, 0.031, -0.015],
    [0.95, 0.024, 0.018, -0.008],
    [1.00, 0.014, 0.006, 0.002],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The published volume of this table: 0.01877 L³ as stacked ellipses.
    #[test]
    fn the_table_holds_the_published_volume() {
        let form = WhaleForm::right_whale(10.0);
        assert!((form.table_volume_m3() / 18.77 - 1.0).abs() < 0.02, "{}", form.table_volume_m3());
    }

    /// The displaced mass is that of a 13.7 m whale by Christiansen, 36 t.
    #[test]
    fn the_default_displaces_its_mass() {
        let form = WhaleForm::right_whale(13.7);
        let displaced_t = 1.025 * form.skin_volume_m3();
        assert!((displaced_t / 36.4 - 1.0).abs() < 0.02, "{displaced_t}");
        let scaled = form.displacing(30.0);
        assert!((scaled.skin_volume_m3() / 30.0 - 1.0).abs() < 1e-4);
    }
}

//! What a whale's body is built from: the measures a file in `whales/` gives.
//!
//! Every length but `length_m` is a share of body length, so that one form serves all ages.

use std::f64::consts::PI;

/// Measures of a whale's body.
#[derive(Clone, Debug, PartialEq)]
pub struct WhaleForm {
    /// Body length, snout to fluke notch [m].
    pub length_m: f64,
    /// Body sections from snout (0) to fluke notch (1), in rising order of `at`; at least four.
    pub stations: Vec<Station>,
    /// Factor on every width and height of the body, so that displaced volume and mass agree [1].
    pub breadth_scale: f64,
    /// Factor on widths and heights along the body, by share of length, for condition and pregnancy; at least one.
    pub girth: Vec<[f64; 2]>,
    /// Head.
    pub head: HeadForm,
    /// Where the peduncle (tail stock) begins [share of length from the snout].
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadForm {
    /// Length of the head [share of length].
    pub share: f64,
    /// Snout to the corner of the mouth [share of length].
    pub mouth: f64,
    /// Width of the rostrum [share of the head's width].
    pub rostrum_width: f64,
    /// How far the arched lower lips stand off from the baleen, at their foot [share of the baleen's length there].
    pub lip_arch: f64,
    /// Length of the longest baleen plate [share of length].
    pub baleen: f64,
    /// Relief of the highest callosity, the bonnet; 0 for a head without [m].
    pub callosity_m: f64,
}

/// A pair of flippers: paddles with a blunt, nearly square tip.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// Where along the span the chord is greatest [share of span].
    pub max_chord_at: f64,
    /// Chord near the tip before it rounds off [share of length].
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
    pub edge_radius_m: f64,
}

/// A pair of flukes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlukesForm {
    /// Tip to tip [share of length].
    pub span: f64,
    /// Insertion to notch [share of length].
    pub root_chord: f64,
    /// Chord near the tips before they round off [share of length].
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
    pub edge_radius_m: f64,
}

impl WhaleForm {
    /// Volume of the section table as stacked ellipses, before [`breadth_scale`](Self::breadth_scale) [m³].
    #[must_use]
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

//! The North Atlantic right whale (*Eubalaena glacialis*) as measures.

use crate::items::{Growth, MassLaw};

use super::form::{FlipperForm, FlukesForm, HeadForm, Station, WhaleForm};

impl WhaleForm {
    /// A North Atlantic right whale (*Eubalaena glacialis*) of a given length [m].
    ///
    /// Each figure's source stands beside it; "estimate" marks those no source gives.
    #[must_use]
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

/// How a right whale's head changes with length; sources beside the shares.
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

    /// The published digest of the same table: 0.01877 L³ as stacked ellipses.
    #[test]
    fn the_table_holds_the_published_volume() {
        let form = WhaleForm::right_whale(10.0);
        assert!((form.table_volume_m3() / 18.77 - 1.0).abs() < 0.02, "{}", form.table_volume_m3());
    }

    /// Christiansen's mass of a 13.7 m whale, 36 t, is displaced.
    #[test]
    fn the_default_displaces_its_mass() {
        let form = WhaleForm::right_whale(13.7);
        let displaced_t = 1.025 * form.skin_volume_m3();
        assert!((displaced_t / 36.4 - 1.0).abs() < 0.02, "{displaced_t}");
        let scaled = form.displacing(30.0);
        assert!((scaled.skin_volume_m3() / 30.0 - 1.0).abs() < 1e-4);
    }
}

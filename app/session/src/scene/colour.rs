//! Colours: the tension scale (readable with any colour vision) and the sea's palette.

use super::mesh::Colour;

/// Ten even stops of the cividis scale (Nuñez, Anderton and Renslow 2018), dark to light, sRGB.
const CIVIDIS: [[u8; 3]; 10] = [
    [0x00, 0x20, 0x4d],
    [0x00, 0x33, 0x6f],
    [0x39, 0x48, 0x6b],
    [0x57, 0x5c, 0x6d],
    [0x70, 0x71, 0x73],
    [0x8a, 0x87, 0x79],
    [0xa6, 0x9d, 0x75],
    [0xc4, 0xb5, 0x6c],
    [0xe4, 0xcf, 0x5b],
    [0xff, 0xea, 0x46],
];

/// The scale's darkest part would sink into the water, so slack rope starts here.
const LEAST: f64 = 0.6;

/// The colour of a tension, as a share of the scale's top (clamped to 0..1).
pub fn tension_colour(share: f64) -> Colour {
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 };
    let place = (LEAST + (1.0 - LEAST) * share) * (CIVIDIS.len() - 1) as f64;
    let below = (place as usize).min(CIVIDIS.len() - 2);
    let part = (place - below as f64) as f32;
    let mix = |channel: usize| {
        let (low, high) =
            (f32::from(CIVIDIS[below][channel]), f32::from(CIVIDIS[below + 1][channel]));
        (low + (high - low) * part) / 255.0
    };
    [mix(0), mix(1), mix(2), 1.0]
}

/// An opaque colour from its eight-bit parts.
pub const fn rgb(red: u8, green: u8, blue: u8) -> Colour {
    [red as f32 / 255.0, green as f32 / 255.0, blue as f32 / 255.0, 1.0]
}

/// The colour with another opacity.
pub const fn faded(colour: Colour, opacity: f32) -> Colour {
    [colour[0], colour[1], colour[2], opacity]
}

/// Water far away.
pub const DEEP: Colour = rgb(0x12, 0x2b, 0x38);
/// Seabed.
pub const SEABED: Colour = rgb(0x76, 0x74, 0x66);
/// Sea surface.
pub const SURFACE: Colour = rgb(0x8f, 0xc6, 0xd6);
/// Rope where its tension is not shown: pale, weathered polypropylene.
pub const ROPE: Colour = rgb(0xb9, 0xad, 0x84);
/// Weak places of a line.
pub const WEAK: Colour = rgb(0xd5, 0x5e, 0x00);
/// Whale skin.
pub const SKIN: Colour = rgb(0x3f, 0x49, 0x53);
/// Rough pale patches of a right whale's head.
pub const CALLOSITY: Colour = rgb(0xb3, 0xb4, 0xa9);
/// Baleen.
pub const BALEEN: Colour = rgb(0x9a, 0x93, 0x7c);
/// Inside of the mouth.
pub const MOUTH: Colour = rgb(0x74, 0x5c, 0x60);
/// White patches of belly and throat.
pub const WHITE: Colour = rgb(0xa9, 0xb0, 0xb3);
/// Lid round an eye.
pub const LID: Colour = rgb(0x68, 0x70, 0x78);
/// Eye.
pub const EYE: Colour = rgb(0x16, 0x16, 0x18);
/// Buoy.
pub const BUOY: Colour = rgb(0xe8, 0x6a, 0x33);
/// Band of a buoy.
pub const BUOY_BAND: Colour = rgb(0xf2, 0xee, 0xe4);
/// Frame of a trap.
pub const TRAP: Colour = rgb(0xb9, 0xcf, 0xb4);
/// Wires of a trap.
pub const TRAP_WIRE: Colour = rgb(0x7f, 0x98, 0x82);
/// Anchor and other weights.
pub const STEEL: Colour = rgb(0x93, 0xa1, 0xad);
/// Obstacles.
pub const ROCK: Colour = rgb(0x8a, 0x80, 0x72);
/// Current arrows.
pub const CURRENT: Colour = rgb(0x58, 0xb7, 0xc9);
/// Places where rope presses on skin.
pub const CONTACT: Colour = rgb(0xff, 0x5f, 0x8f);
/// Force of rope on skin.
pub const FORCE: Colour = rgb(0xff, 0xc9, 0x7a);
/// Ends of a cut rope.
pub const PARTED: Colour = rgb(0xff, 0x9b, 0x54);

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of an sRGB colour (IEC 61966-2-1).
    fn luminance(colour: Colour) -> f64 {
        let linear = |part: f32| {
            let part = f64::from(part);
            if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2])
    }

    #[test]
    fn more_tension_is_always_lighter_so_that_no_colour_vision_is_needed() {
        let lights: Vec<f64> =
            (0..=100).map(|step| luminance(tension_colour(f64::from(step) / 100.0))).collect();
        assert!(lights.windows(2).all(|pair| pair[1] > pair[0]), "{lights:?}");
    }

    #[test]
    fn slack_rope_stands_out_from_the_water() {
        let contrast = (luminance(tension_colour(0.0)) + 0.05) / (luminance(DEEP) + 0.05);
        assert!(contrast > 2.5, "contrast {contrast}");
    }

    #[test]
    fn tension_beyond_the_scale_takes_its_top_colour() {
        let bits = |share: f64| tension_colour(share).map(f32::to_bits);
        assert_eq!(bits(3.0), bits(1.0));
        assert_eq!(bits(f64::NAN), bits(1.0));
        assert_eq!(bits(-1.0), bits(0.0));
    }
}

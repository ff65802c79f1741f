//! Round values for scales and axes, and colours of series that are distinct in any colour vision.

/// Colours of series on a dark or light background (Okabe and Ito 2008, without yellow and black).
pub const SERIES: [[u8; 3]; 7] = [
    [0x56, 0xb4, 0xe9],
    [0xe6, 0x9f, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xd5, 0x5e, 0x00],
    [0x4f, 0x8f, 0xd0],
    [0x99, 0x99, 0x99],
];

/// Colours of series on white paper: the dark ones of Okabe and Ito (2008), and two that are as dark.
pub const SERIES_ON_WHITE: [[u8; 3]; 6] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0x8a, 0x6d, 0x00],
    [0x56, 0x70, 0x7f],
];

/// A colour as HTML and SVG write it, such as `#0072b2`.
pub fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// The greatest of 1, 2, 5 times a power of ten that is not above `value`; zero where there is none.
pub fn nice_below(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 0.0;
    }
    let power = 10.0_f64.powf(value.log10().floor());
    let lead = value / power;
    power * [5.0, 2.0, 1.0].into_iter().find(|step| *step <= lead * (1.0 + 1e-12)).unwrap_or(1.0)
}

/// The least of 1, 2, 5 times a power of ten that is not below `value`; zero where there is none.
pub fn nice_above(value: f64) -> f64 {
    let below = nice_below(value);
    // The next of 1, 2, 5 is at most 2.5 times as much.
    if value <= below * (1.0 + 1e-12) { below } else { nice_below(below * 2.6) }
}

/// The round step, 1, 2 or 5 times a power of ten, nearest to `wanted`; zero where there is none.
fn step(wanted: f64) -> f64 {
    let step = nice_below(wanted);
    if step > 0.0 && wanted / step > 1.6 { nice_below(step * 2.6) } else { step }
}

/// Round values from `least` to `most`, about `count` steps; only `least` where the range is empty.
pub fn ticks(least: f64, most: f64, count: u32) -> Vec<f64> {
    let step = step((most - least) / f64::from(count.max(1)));
    if step <= 0.0 {
        return vec![least];
    }
    let first = (least / step - 1e-9).ceil() as i64;
    (first..)
        .map(|index| index as f64 * step)
        .take_while(|tick| *tick <= most + 1e-9 * step)
        .collect()
}

/// Decimals that distinguish values this far apart: none from 1 on, one from 0.1 on, and so
/// on.
pub fn decimals(step: f64) -> usize {
    if step.is_finite() && step > 0.0 {
        (-(step.log10() + 1e-9).floor()).clamp(0.0, 9.0) as usize
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nice_numbers_are_one_two_five() {
        for (value, nice) in [
            (150.0, 100.0),
            (1.0, 1.0),
            (0.34, 0.2),
            (7.0, 5.0),
            (50.0, 50.0),
            (-1.0, 0.0),
            (f64::NAN, 0.0),
        ] {
            assert!((nice_below(value) - nice).abs() < 1e-12, "{value}");
        }
    }

    #[test]
    fn the_nice_number_above_is_the_next_one() {
        for (value, nice) in
            [(1.0, 1.0), (1.1, 2.0), (2.1, 5.0), (0.6, 1.0), (5.01, 10.0), (0.0, 0.0)]
        {
            assert!((nice_above(value) - nice).abs() < 1e-12, "{value}");
        }
    }

    #[test]
    fn ticks_are_round_within_the_range_and_neither_few_nor_many() {
        for top in [0.7, 1.0, 3.3, 47.0, 512.0, 1700.0, 7562.0, 99_999.0] {
            let ticks = ticks(0.0, top, 5);
            assert!(ticks.first() == Some(&0.0) && *ticks.last().unwrap() <= top * (1.0 + 1e-9));
            assert!((4..=9).contains(&ticks.len()), "{top}: {ticks:?}");
        }
        let both = ticks(-0.13, 0.41, 5);
        assert!(both.iter().all(|tick| (-0.13..=0.41).contains(tick)), "{both:?}");
        assert!((4..=7).contains(&both.len()) && both.iter().any(|tick| tick.abs() < 1e-12));
        assert_eq!(ticks(0.0, 0.0, 5), vec![0.0]);
        assert_eq!(ticks(0.0, f64::NAN, 5), vec![0.0]);
    }

    #[test]
    fn no_two_ticks_of_a_scale_are_written_alike() {
        for top in [0.003, 0.04, 0.22, 0.3, 0.7, 1.0, 1.4, 3.3, 12.0, 512.0] {
            let ticks = ticks(0.0, top, 5);
            let places = decimals(ticks[1] - ticks[0]);
            let mut written: Vec<String> =
                ticks.iter().map(|tick| format!("{tick:.places$}")).collect();
            for (tick, text) in ticks.iter().zip(&written) {
                assert!((text.parse::<f64>().unwrap() - tick).abs() < 1e-9 * top, "{text}");
            }
            written.dedup();
            assert_eq!(written.len(), ticks.len(), "{written:?}");
        }
    }

    #[test]
    fn a_colour_is_written_as_html_wants_it() {
        assert_eq!(hex(SERIES_ON_WHITE[0]), "#0072b2");
    }
}

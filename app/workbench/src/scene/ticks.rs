//! Round numbers for scales.

/// The greatest of 1, 2, 5 times a power of ten that is not above `value`; zero where there is none.
#[must_use]
pub fn nice_below(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 0.0;
    }
    let power = 10.0_f64.powf(value.log10().floor());
    let lead = value / power;
    power * [5.0, 2.0, 1.0].into_iter().find(|step| *step <= lead * (1.0 + 1e-12)).unwrap_or(1.0)
}

/// Round values from zero up to `top`, about `count` steps; only zero where `top` is not above zero.
#[must_use]
pub fn ticks(top: f64, count: u32) -> Vec<f64> {
    let wanted = top / f64::from(count.max(1));
    let mut step = nice_below(wanted);
    if step <= 0.0 {
        return vec![0.0];
    }
    if wanted / step > 1.6 {
        step = nice_below(step * 2.6);
    }
    (0..)
        .map(|index| f64::from(index) * step)
        .take_while(|tick| *tick <= top * (1.0 + 1e-9))
        .collect()
}

/// Decimals with which round values this far apart are told apart: none from 1 on, one from 0.1 on, and so on.
#[must_use]
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
    fn ticks_start_at_zero_stay_below_the_top_and_are_neither_few_nor_many() {
        for top in [0.7, 1.0, 3.3, 47.0, 512.0, 1700.0, 7562.0, 99_999.0] {
            let ticks = ticks(top, 5);
            assert!(ticks.first() == Some(&0.0) && *ticks.last().unwrap() <= top * (1.0 + 1e-9));
            assert!((4..=9).contains(&ticks.len()), "{top}: {ticks:?}");
        }
        assert_eq!(ticks(0.0, 5), vec![0.0]);
    }

    #[test]
    fn no_two_ticks_of_a_scale_are_written_alike() {
        for top in [0.003, 0.04, 0.22, 0.3, 0.7, 1.0, 1.4, 3.3, 12.0, 512.0] {
            let ticks = ticks(top, 5);
            let places = decimals(ticks[1] - ticks[0]);
            let mut written: Vec<String> =
                ticks.iter().map(|tick| format!("{tick:.places$}")).collect();
            for (tick, text) in ticks.iter().zip(&written) {
                assert!(
                    (text.parse::<f64>().unwrap() - tick).abs() < 1e-9 * top,
                    "{tick} is written {text}"
                );
            }
            written.dedup();
            assert_eq!(written.len(), ticks.len(), "{top}: {written:?}");
        }
    }
}

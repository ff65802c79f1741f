//! Numbers and events in words. No-break spaces hold an interval or a force on one line.

use endline_gear::StudyEvent;

use crate::study::stats::{Interval, Lowest, Rate};
use crate::units::N_PER_LBF;

/// In place of the rate of an event that the runs of an option were not followed for.
pub const NOT_FOLLOWED: &str = "not followed";

/// `12.0 % [8.1, 17.4] (24 of 200)`. For weighted encounters `0.8 % [0.5, 1.2] (24 of 200, worth 2600)`, or, if the interval allows for
/// events that the study has not met, `0.8 % [0.1, 8.2] (4 of 200, few of much weight)`.
pub(super) fn rate(rate: &Rate) -> String {
    if rate.runs == 0 {
        return "no run counts".to_owned();
    }
    let runs = rate.runs as f64;
    let worth = if rate.interval != rate.as_met {
        ", few of much weight".to_owned()
    } else if (rate.effective - runs).abs() < 0.5 {
        String::new()
    } else {
        format!(", worth {:.0}", rate.effective)
    };
    format!("{} ({} of {}{worth})", short_rate(rate), rate.hits, rate.runs)
}

/// `12.0 % [8.1, 17.4]`.
pub(super) fn short_rate(rate: &Rate) -> String {
    if rate.runs == 0 {
        return "no run counts".to_owned();
    }
    format!("{:.1} % {}", 100.0 * rate.rate, percent_interval(rate.interval))
}

/// `-3.5 points [-6.1, -0.9]`.
pub(super) fn points(difference: f64, interval: Interval) -> String {
    format!("{:+.1} points {}", 100.0 * difference, percent_interval(interval))
}

/// `[-6.1, -0.9]`, in percent.
pub(super) fn percent_interval(Interval { low, high }: Interval) -> String {
    format!("[{:.1},\u{a0}{:.1}]", 100.0 * low, 100.0 * high)
}

/// `0.65 [0.41, 1.02]`.
pub(super) fn ratio(ratio: Option<f64>, interval: Option<Interval>) -> String {
    match (ratio, interval) {
        (Some(ratio), Some(Interval { low, high })) => {
            format!("{ratio:.2} [{low:.2},\u{a0}{high:.2}]")
        }
        _ => "none: the baseline has no such event".into(),
    }
}

/// `1512 N (340 lbf)`.
pub(super) fn force(newtons: f64) -> String {
    format!("{newtons:.0}\u{a0}N ({:.0}\u{a0}lbf)", newtons / N_PER_LBF)
}

/// `alone 12 %, tied 30 %`; `tied in all` if no resample separates the options.
pub fn lowest(Lowest { alone, tied }: Lowest) -> String {
    match (alone > 0.0, tied > 0.0) {
        (false, true) if tied >= 1.0 => "tied in all".to_owned(),
        (_, false) => format!("alone {:.0} %", 100.0 * alone),
        (false, true) => format!("tied {:.0} %", 100.0 * tied),
        (true, true) => format!("alone {:.0} %, tied {:.0} %", 100.0 * alone, 100.0 * tied),
    }
}

/// An event in words, by its name in tables.
pub(super) fn event_words(name: &str) -> String {
    StudyEvent::find(name).map_or_else(|| name.to_owned(), |event| event.words())
}

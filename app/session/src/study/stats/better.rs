//! Probability that an event is rarer with one option than with another.
//!
//! Of the encounters that differ, a share `s` has the event with the option only. With Jeffreys' prior, `s` is
//! `Beta(b + ½, c + ½)`; the event is rarer with the option where `s < ½`.
//! Reference: Jeffreys 1946 (doi:10.1098/rspa.1946.0056).

use statrs::distribution::{Beta, ContinuousCDF};

/// From the encounters with the event with the option only, and with the other only.
pub(super) fn probability_fewer(only_this: f64, only_other: f64) -> f64 {
    if only_this.total_cmp(&only_other).is_eq() {
        return 0.5;
    }
    Beta::new(only_this + 0.5, only_other + 0.5).map_or(0.5, |share| share.cdf(0.5))
}

//! Time for which nothing about a held whale has changed: how an encounter that has settled is known.
//!
//! Something changes when rope takes hold or lets go, lodges in the mouth or leaves it, when turns about a part differ by
//! [`TURNS`] from what they were, when something parts, or when a line bears more by [`MORE`] than any has so far.
//! A whale that struggles as hard as before, and in vain, changes nothing.

use endline_sdk::BodyPart;

use crate::state::State;

/// Turns about a part by which rope has moved; estimate.
const TURNS: f64 = 0.25;
/// Factor by which a tension exceeds all before; estimate.
const MORE: f64 = 1.05;
/// Tension below which none counts as greater than before [N]; estimate.
const LEAST_N: f64 = 50.0;

/// What rope does to the whale, as far as it tells whether anything has changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Hold {
    pub held: bool,
    pub lodged: bool,
    pub turns: [f64; BodyPart::ALL.len()],
}

/// The hold as it was when something changed last.
#[derive(Clone, Debug, Default)]
pub(super) struct Unchanged {
    since_s: f64,
    now_s: f64,
    then: Hold,
    parted: usize,
    greatest_n: f64,
}

impl Unchanged {
    pub fn fold(&mut self, state: &State, now: Hold) {
        self.now_s = state.time_s;
        let parted = state.line_parted.iter().flatten().count()
            + state.link_parted_s.iter().flatten().count();
        let tension_n = state.rope.tension.iter().copied().fold(0.0, f64::max);
        let harder = tension_n > (MORE * self.greatest_n).max(LEAST_N);
        if harder || parted != self.parted || has_changed(&self.then, &now) {
            (self.since_s, self.then, self.parted) = (self.now_s, now, parted);
        }
        if harder {
            self.greatest_n = tension_n;
        }
    }

    /// Time since anything changed [s]; zero for a whale that is not held.
    pub fn seconds(&self) -> f64 {
        if self.then.held { self.now_s - self.since_s } else { 0.0 }
    }
}

fn has_changed(then: &Hold, now: &Hold) -> bool {
    let moved = |(then, now): (&f64, &f64)| libm::fabs(now - then) >= TURNS;
    then.held != now.held
        || then.lodged != now.lodged
        || then.turns.iter().zip(&now.turns).any(moved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::tests::{model, spec};

    /// A whale held from 1 s on, that pulls as given: time unchanged at 100 s.
    fn held(pull_n: impl Fn(f64) -> f64, hold: impl Fn(f64) -> Hold) -> f64 {
        let model = model(spec(vec![1.0; 4]));
        let mut state = State::start(&model);
        let mut meter = Unchanged::default();
        for step in 0..=1000 {
            state.time_s = 0.1 * f64::from(step);
            state.rope.tension.fill(pull_n(state.time_s));
            meter.fold(&state, hold(state.time_s));
        }
        meter.seconds()
    }

    fn turns_of(about_head: f64) -> Hold {
        let mut turns = [0.0; BodyPart::ALL.len()];
        turns[BodyPart::Head as usize] = about_head;
        Hold { held: true, lodged: true, turns }
    }

    #[test]
    fn struggles_in_vain_change_nothing_and_harder_ones_do() {
        let again = |time_s: f64| 1000.0 * libm::fabs(libm::sin(0.3 * time_s));
        let unchanged = held(again, |_| turns_of(0.5));
        assert!(
            (94.0..97.0).contains(&unchanged),
            "from the first full pull at 5.2 s: {unchanged}"
        );
        let harder = |time_s: f64| if time_s < 60.0 { 1000.0 } else { 1100.0 };
        assert!((held(harder, |_| turns_of(0.5)) - 40.0).abs() < 1e-9);
    }

    #[test]
    fn rope_that_winds_lodges_or_lets_go_changes() {
        let winds = |time_s: f64| turns_of(if time_s < 70.0 { 0.5 } else { 0.8 });
        assert!((held(|_| 500.0, winds) - 30.0).abs() < 1e-9);
        let leaves = |time_s: f64| Hold { lodged: time_s < 80.0, ..turns_of(0.5) };
        assert!((held(|_| 500.0, leaves) - 20.0).abs() < 1e-9);
        let free = |time_s: f64| Hold { held: time_s < 50.0, ..turns_of(0.0) };
        assert!(held(|_| 500.0, free).abs() < 1e-12);
    }
}

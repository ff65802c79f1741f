//! When nothing more can happen in a run that counts.

use endline_gear::RunRule;
use endline_sim::metrics::Outcome;

use super::Run;
use crate::report::validity::reasons;

/// How often a run is asked whether it is over [Hz].
const LOOKS_HZ: f64 = 2.0;

impl Run {
    /// Whether the whale has passed, has shed the gear, or has been followed for long enough with it or has
    /// settled in it.
    ///
    /// A run without a whale is never over before its time.
    #[must_use]
    pub fn is_over(&self, rule: &RunRule) -> bool {
        let now = self.state.time_s;
        let Some(whale) = self.summary().whale else { return false };
        match whale.outcome {
            Outcome::NoContact => now >= rule.passed_s,
            Outcome::Shed | Outcome::PartedFree => whale.decided,
            Outcome::Entangled | Outcome::PartedEntangled => {
                let followed =
                    whale.first_contact_s.is_some_and(|first| now - first >= rule.held_s);
                let settled =
                    rule.settled_s.is_some_and(|settled_s| whale.unchanged_s >= settled_s);
                whale.decided && (followed || settled)
            }
        }
    }

    /// Looks whether the run is valid so far; why not, where every look of the last `for_s` has found it invalid.
    pub(crate) fn stays_invalid(&mut self, for_s: f64) -> Option<String> {
        let now = self.state.time_s;
        let reasons = reasons(None, &self.workspace.audit, self.summary().whale.as_ref());
        let Some(reason) = reasons.into_iter().next() else {
            self.invalid_since_s = None;
            return None;
        };
        let since = *self.invalid_since_s.get_or_insert(now);
        (now - since >= for_s).then_some(reason)
    }

    /// Whether it is time to ask whether the run is over.
    #[must_use]
    pub fn is_time_to_look(&self) -> bool {
        let stride = (1.0 / (LOOKS_HZ * self.step_s())).round().max(1.0) as u64;
        self.state.step.is_multiple_of(stride)
    }
}

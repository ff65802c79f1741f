//! The end of a run: when its outcome is decided, and when its solver is stuck.
//!
//! A run is stuck where rope is wedged so that only steps of a millionth of a second succeed, and it would take days.
//! This rule counts steps and iterations, not seconds of a clock, so that the same run ends at the same step on every machine.

use endline_gear::RunRule;
use endline_sim::Stop;
use endline_sim::metrics::Outcome;
use endline_sim::state::LimitedBy;

use super::Run;
use crate::report::validity::reasons;

/// How often a run is asked whether it is over [Hz].
const LOOKS_HZ: f64 = 2.0;

impl Run {
    /// Whether the whale has passed, has shed the gear, or has been followed for long enough with it, or after the last parting,
    /// or has settled in it.
    ///
    /// A run without a whale is never over before its time.
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
                let after_parting = rule.parted_s.is_some_and(|parted_s| {
                    self.last_parting_s().is_some_and(|last_s| now - last_s >= parted_s)
                });
                whale.decided && (followed || settled || after_parting)
            }
        }
    }

    /// Time of the last parting of a link or rope [s].
    fn last_parting_s(&self) -> Option<f64> {
        let links = self.state.link_parted_s.iter().copied();
        let lines = self.state.line_parted.iter().map(|parted| parted.map(|(time_s, _)| time_s));
        links.chain(lines).flatten().max_by(f64::total_cmp)
    }

    /// Checks whether the run is valid so far; returns why not, where every check of the last `for_s` has found it invalid.
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
    pub fn is_time_to_look(&self) -> bool {
        let stride = (1.0 / (LOOKS_HZ * self.step_s())).round().max(1.0) as u64;
        self.state.step.is_multiple_of(stride)
    }
}

/// A run has stuck where its solver tried this many times the steps of its time so far, and of a while more, in contact.
const STUCK: f64 = 10.0;
/// Newton iterations per step at which a run counts as stuck: a step in contact takes two as a rule, and wedged rope up to forty in short steps.
const STUCK_PASSES: f64 = 20.0;
/// That while: time for which a run may stick before it is given up, at the usual cost [s].
const STUCK_FOR_S: f64 = 60.0;

impl Run {
    /// Where and why it has stuck, if it has.
    pub(super) fn stuck(&self) -> Option<Stop> {
        let (audit, settings) = (self.audit(), &self.model().spec.settings);
        let time_s = self.state.time_s;
        let usual = (time_s + STUCK_FOR_S) / settings.contact_step_s.min(settings.step_s);
        let tried = audit.solver_steps + audit.halved;
        let [most_steps, most_passes] = [STUCK, STUCK_PASSES].map(|times| (times * usual) as u64);
        if tried <= most_steps && audit.passes <= most_passes {
            return None;
        }
        let reason = format!(
            "it sticks: hardly a step of the solver goes through, {tried} steps and {} passes in {time_s:.1} s of its time; most were kept short by {}; \
             check what is wedged there, or run it with a longer `segment`",
            audit.passes,
            LimitedBy::mostly(&audit.limited_by).0.words()
        );
        Some(Stop { time_s, part: self.pressed_most(), reason })
    }

    /// Where rope presses most on the whale; the line that pulls most where it does not.
    fn pressed_most(&self) -> String {
        let model = self.model();
        let line_of = |segment: usize| &model.spec.lines[model.segment_line[segment]].id;
        let pressed = self
            .contacts()
            .iter()
            .max_by(|one, other| one.normal_force_n.total_cmp(&other.normal_force_n));
        if let (Some(contact), Some(whale)) = (pressed, &model.spec.whale) {
            let region = whale.skin.regions[contact.triangle].part().name();
            return format!("line {} on the whale's {region}", line_of(contact.segment));
        }
        let peaks_n = self.peak_tensions_n();
        let pulls = (0..peaks_n.len()).max_by(|a, b| peaks_n[*a].total_cmp(&peaks_n[*b]));
        pulls.map_or_else(|| "the run".into(), |line| format!("line {}", model.spec.lines[line].id))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::RunOptions;
    use crate::source::sample::hanging_rope;

    /// A run of a rope that hangs, whose solver has tried this many steps and passes more than accepted.
    fn run(steps: u64, passes: u64) -> Run {
        let options = RunOptions { unsettled: true, frames_hz: 0.0 };
        let mut run = Run::new(hanging_rope(60.0), options).unwrap();
        run.workspace.audit.solver_steps += steps;
        run.workspace.audit.passes += passes;
        run
    }

    #[test]
    fn the_last_parting_is_that_of_a_line_or_a_link() {
        let mut run = run(0, 0);
        assert_eq!(run.last_parting_s(), None);
        run.state.line_parted[0] = Some((3.0, 1.0));
        assert_eq!(run.last_parting_s(), Some(3.0));
        run.state.link_parted_s = vec![None, Some(7.0), Some(2.0)];
        assert_eq!(run.last_parting_s(), Some(7.0));
    }

    #[test]
    fn a_run_that_sticks_ends_where_ten_times_the_usual_steps_are_tried_and_stays_ended() {
        let settings = run(0, 0).model().spec.settings.clone();
        let usual = (STUCK_FOR_S / settings.contact_step_s.min(settings.step_s)) as u64;
        let ends = |mut run: Run| run.step(run.pilot()).err();
        assert_eq!(ends(run(9 * usual, 19 * usual)), None);
        for many in [run(11 * usual, 0), run(0, 21 * usual)] {
            let stop = ends(many).unwrap();
            assert!(stop.reason.contains("it sticks") && stop.reason.contains("`segment`"));
            assert!(stop.part.starts_with("line "), "{stop:?}");
        }
        let mut stuck = run(11 * usual, 0);
        let first = stuck.step(stuck.pilot()).unwrap_err();
        let at = stuck.state.step;
        assert_eq!(stuck.step(stuck.pilot()).unwrap_err(), first);
        assert_eq!((stuck.state.step, stuck.stopped.as_ref()), (at, Some(&first)));
    }
}

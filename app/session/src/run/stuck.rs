//! When a run has stuck: rope is wedged so that only steps of a millionth of a second go through, and it would take days.
//!
//! The rule counts steps and passes, not seconds of a clock, so that the same run ends at the same step on every machine.

use endline_sim::Stop;
use endline_sim::state::LimitedBy;

use super::Run;

/// A run has stuck where its solver tried this many times the steps of its time so far, and of a while more, in contact.
const STUCK: f64 = 10.0;
/// Likewise of Newton's passes: a step in contact takes two as a rule, and rope that is wedged up to forty in steps that are short besides.
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
             look at what is wedged there, or run it with a longer `segment`",
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

    /// A run of a rope that hangs, whose solver has tried so many steps and passes more than it has.
    fn run(steps: u64, passes: u64) -> Run {
        let options = RunOptions { unsettled: true, frames_hz: 0.0 };
        let mut run = Run::new(hanging_rope(60.0), options).unwrap();
        run.workspace.audit.solver_steps += steps;
        run.workspace.audit.passes += passes;
        run
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

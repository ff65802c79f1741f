//! A buoy that is drawn to a flipper or to the mouth: it jams there, its link parts at its rating, and a stronger link leaves it caught.

use endline_sdk::BodyPart;
use endline_sim::metrics::{EventKind, Metrics};
use endline_sim::{Input, Model, State, Workspace, settle, step};

use crate::linked::model;

/// Steps in which a workspace is thrown away after each.
const FRESH_STEPS: u64 = 25;
/// What the links of the two runs bear [N]: 600 and 1,700 lbf.
const WEAK_N: f64 = 600.0 * 4.448_221_615_260_5;
const STRONG: (&str, &str) = ("rating = \"600 lbf\"", "rating = \"1700 lbf\"");

struct Run {
    model: Model,
    state: State,
    workspace: Workspace,
    metrics: Metrics,
}

impl Run {
    fn new(changes: &[(&str, &str)]) -> Self {
        Self::of("buoy-jams", changes)
    }

    fn of(scenario: &str, changes: &[(&str, &str)]) -> Self {
        let model = model(scenario, changes);
        let (state, workspace) = (settle(&model).state, Workspace::new(&model));
        let mut metrics = Metrics::new(&model);
        metrics.fold(&model, &state, &[]);
        Self { model, state, workspace, metrics }
    }

    fn input(&self) -> Input {
        let whale = self.model.spec.whale.as_ref().unwrap();
        Input { controls: whale.pilot.at(&self.state) }
    }

    /// Steps until a time or until `enough`.
    fn until(&mut self, time_s: f64, enough: impl Fn(&Self) -> bool) {
        while self.state.time_s < time_s - 1e-9 && !enough(self) {
            let input = self.input();
            step(&self.model, &input, &mut self.state, &mut self.workspace)
                .unwrap_or_else(|stop| panic!("{stop:?}"));
            self.metrics.fold_step(&self.model, &self.state, &self.workspace);
        }
    }

    fn happened(&self, kind: EventKind) -> bool {
        self.metrics.events().iter().any(|event| event.kind == kind)
    }
}

#[test]
fn a_link_parts_at_its_rating_as_the_buoy_jams() {
    let mut run = Run::new(&[]);
    run.until(26.0, |_| false);
    assert!(!run.workspace.body_contacts.is_empty(), "the buoy must reach the whale");

    // What bodies keep of their touch is in the state alone.
    let (mut kept, mut workspace) = (run.state.clone(), Workspace::new(&run.model));
    let mut dropped = run.state.clone();
    for _ in 0..FRESH_STEPS {
        let input = run.input();
        step(&run.model, &input, &mut kept, &mut workspace).unwrap();
        step(&run.model, &input, &mut dropped, &mut Workspace::new(&run.model)).unwrap();
        assert!(kept == dropped, "a workspace holds what belongs to the state");
    }
    assert!(!kept.body_grips.contacts.is_empty());

    run.until(40.0, |run| run.state.link_parted_s[0].is_some());
    let summary = run.metrics.summary(&run.model, &run.state);
    let bore_n = summary.links[0].peak_tension_n;
    assert!((bore_n / WEAK_N - 1.0).abs() < 5e-3, "{bore_n} N");
    let buoy = summary.bodies[0].on_whale;
    assert!(buoy.peak_whale_push_n > WEAK_N, "it presses with more than its line pulls: {buoy:?}");
    assert_eq!((run.workspace.audit.bodies_crossed, run.workspace.audit.tunnelled), (0, 0));
    run.until(45.0, |_| false);
    assert!(run.metrics.summary(&run.model, &run.state).bodies[0].on_whale.whale_part.is_none());
}

#[test]
fn a_stronger_link_leaves_the_buoy_caught() {
    let mut run = Run::new(&[STRONG]);
    run.until(32.0, |run| run.happened(EventKind::CaughtBuoy));
    assert!(run.happened(EventKind::CaughtBuoy) && run.state.link_parted_s[0].is_none());
    let summary = run.metrics.summary(&run.model, &run.state);
    assert!(summary.links[0].peak_tension_n > 1.02 * WEAK_N, "{:?}", summary.links);
    assert!(summary.bodies[0].on_whale.caught);
}

#[test]
fn a_buoy_that_may_not_touch_goes_through_the_whale_and_parts_nothing() {
    let off = ("rope_nodes = 500\n", "rope_nodes = 500\nbodies_on_whale = false\n");
    let mut run = Run::new(&[off]);
    run.until(40.0, |_| false);
    assert!(run.state.link_parted_s[0].is_none() && !run.happened(EventKind::BodyTouched));
}

#[test]
fn a_link_parts_at_its_rating_as_the_buoy_jams_at_the_mouth() {
    let mut run = Run::of("buoy-at-mouth", &[]);
    run.until(20.0, |run| run.state.link_parted_s[0].is_some());
    let summary = run.metrics.summary(&run.model, &run.state);
    let bore_n = summary.links[0].peak_tension_n;
    assert!((bore_n / WEAK_N - 1.0).abs() < 5e-3, "{bore_n} N");
    let buoy = summary.bodies[0].on_whale;
    assert_eq!(buoy.peak_whale_part, Some(BodyPart::Head), "{buoy:?}");
    assert!(run.happened(EventKind::Lodged), "the line ran through the mouth");
    assert_eq!((run.workspace.audit.bodies_crossed, run.workspace.audit.tunnelled), (0, 0));
}

#[test]
fn a_stronger_link_draws_the_buoy_through_the_mouth() {
    let mut run = Run::of("buoy-at-mouth", &[STRONG]);
    run.until(25.0, |_| false);
    let summary = run.metrics.summary(&run.model, &run.state);
    let (bore_n, buoy) = (summary.links[0].peak_tension_n, summary.bodies[0].on_whale);
    assert!(run.state.link_parted_s[0].is_none() && bore_n > 1.5 * WEAK_N, "{bore_n} N");
    assert_eq!(buoy.peak_whale_part, Some(BodyPart::Head), "{buoy:?}");
    assert_eq!((run.workspace.audit.bodies_crossed, run.workspace.audit.tunnelled), (0, 0));
}

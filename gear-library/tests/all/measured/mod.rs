//! Entanglement measured in whole runs of the right whale with known results: rope that lodges in the mouth and is released,
//! rope that sheds, towed gear, sums of forces.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

mod lodged;
mod shed;
mod towed;

use std::sync::Arc;

use crate::idle::{TestHooks, library};
use endline_fixtures::hooks::{Motion, descriptor};
use endline_friction_models::Coulomb;
use endline_gear::{Options, Scenario, assemble};
use endline_sdk::MotionOutput;
use endline_sim::metrics::{Metrics, Summary};
use endline_sim::{Input, Model, ModelSpec, State, Workspace, step};

/// Controls of a whale at a time [s].
type Timetable = Box<dyn Fn(f64) -> MotionOutput + Send + Sync>;

/// Hooks of a whale with a scripted motion, with Coulomb's law of friction or none.
fn hands(timetable: Timetable, rubs: bool) -> TestHooks {
    let script =
        Motion::new(descriptor("test.script"), move |input| timetable(input.time_s + input.dt_s));
    let mut hooks = TestHooks::without_effect();
    hooks.motion = Some(script);
    if rubs {
        hooks.friction = Some(Arc::new(Coulomb::new()));
    }
    hooks
}

fn spec(text: &str, hooks: &TestHooks) -> ModelSpec {
    let scenario =
        Scenario::read("test.toml", text).unwrap_or_else(|problems| panic!("{}", problems[0]));
    assemble(&scenario, library(), hooks, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", problems[0]))
}

/// A run with its measures.
struct Run {
    model: Model,
    state: State,
    workspace: Workspace,
    metrics: Metrics,
}

impl Run {
    fn of(spec: ModelSpec) -> Self {
        let model = Model::new(spec).unwrap_or_else(|errors| panic!("{errors:?}"));
        let (state, workspace, mut metrics) =
            (State::start(&model), Workspace::new(&model), Metrics::new(&model));
        metrics.fold(&model, &state, &[]);
        Self { model, state, workspace, metrics }
    }

    /// Runs to a time and observes each step.
    fn until(&mut self, time_s: f64, mut observe: impl FnMut(&Self)) {
        while self.state.time_s < time_s - 1e-9 {
            step(&self.model, &Input::default(), &mut self.state, &mut self.workspace)
                .unwrap_or_else(|stop| panic!("{stop:?}"));
            self.metrics.fold_step(&self.model, &self.state, &self.workspace);
            observe(self);
        }
    }

    fn summary(&self) -> Summary {
        self.metrics.summary(&self.model, &self.state)
    }
}

/// Linear from 0 at one time to 1 at another.
fn ramp(time_s: f64, from_s: f64, to_s: f64) -> f64 {
    ((time_s - from_s) / (to_s - from_s)).clamp(0.0, 1.0)
}

/// A whale 20 m down that heads north, in still water; the tests add lines.
fn scenario(more: &str) -> String {
    format!(
        "format = 1\nkind = \"scenario\"\nname = \"measured\"\nsource = \"test\"\nconfidence = \"estimate\"\nduration = \"60 s\"\n\
         segment = \"0.1 m\"\nstart = \"placed\"\n[site]\ndepth = \"60 m\"\ndensity = \"1025 kg/m3\"\nseabed = false\n\
         [current]\nspeed = \"0 m/s\"\ntoward = \"90 deg\"\n\
         [whale]\nitem = \"right-whale\"\nlength = \"13 m\"\nposition = [\"0 m\", \"0 m\"]\ndepth = \"20 m\"\nheading = \"0 deg\"\n\
         speed = \"0 m/s\"\nmotion = \"test.script\"\n[friction]\nmodel = \"test.script\"\n\
         [[rope]]\nid = \"rope\"\nmaterial = \"pp\"\ndiameter = \"10 mm\"\nmass = \"0.0805 kg/m\"\ndensity = \"1025 kg/m3\"\n\
         strength = \"20 kN\"\nstiffness = \"20 kN\"\ndamping = \"20 N s\"\ndrag_normal = 1.2\ndrag_tangential = 0.02\nadded_mass = 1.0\n{more}"
    )
}

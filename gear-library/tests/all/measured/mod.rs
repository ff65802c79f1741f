//! Entanglement measured in whole runs of the right whale with known results: rope that lodges in the mouth and is released,
//! rope that sheds, towed gear, sums of forces.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

mod lodged;
mod shed;
mod towed;

use std::sync::Arc;

use crate::idle::{Idle, library};
use endline_friction_models::Coulomb;
use endline_gear::{Hooks, Options, Scenario, assemble};
use endline_sdk::{
    Descriptor, FrictionModel, GearType, HookError, MotionInput, MotionOutput, WhaleMotion,
};
use endline_sim::metrics::{Metrics, Summary};
use endline_sim::{Input, Model, ModelSpec, State, Workspace, step};

/// Controls of a whale at a time [s].
type Timetable = Box<dyn Fn(f64) -> MotionOutput + Send + Sync>;

/// A whale with a timetable, and rope with Coulomb friction on it, or none.
struct Hands {
    whale: Arc<Script>,
    rubs: bool,
}

struct Script(Descriptor, Timetable);

impl Hands {
    fn of(timetable: Timetable, rubs: bool) -> Self {
        let (id, name, help) =
            ("test.script".into(), "Script".into(), "Keeps to a timetable.".into());
        let descriptor = Descriptor {
            id,
            version: "0.1.0".into(),
            name,
            help,
            attributes: Vec::new(),
            state_len: 0,
            acts: Vec::new(),
        };
        Self { whale: Arc::new(Script(descriptor, timetable)), rubs }
    }
}

impl WhaleMotion for Script {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn step(
        &self,
        _: &[f64],
        input: &MotionInput<'_>,
        _: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        Ok(self.1(input.time_s + input.dt_s))
    }
}

impl Hooks for Hands {
    fn motion(&self, _: &str) -> Option<Arc<dyn WhaleMotion>> {
        Some(self.whale.clone())
    }
    fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>> {
        if self.rubs { Some(Arc::new(Coulomb::new())) } else { Idle::shared().friction(id) }
    }
    fn gear(&self, _: &str) -> Option<Arc<dyn GearType>> {
        None
    }
    fn ids(&self) -> Vec<String> {
        vec!["test.script".into()]
    }
}

fn spec(text: &str, hands: &Hands) -> ModelSpec {
    let scenario =
        Scenario::read("test.toml", text).unwrap_or_else(|problems| panic!("{}", problems[0]));
    assemble(&scenario, library(), hands, &Options::default())
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

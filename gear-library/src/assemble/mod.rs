//! Assembly: builds a model's spec from scenario, library and plugins.
//!
//! Order: sea, whale, gear of the library, obstacles, parts written in place, segments of lines, weak links,
//! friction, probes. All problems are collected and reported with their places.

mod attributes;
mod body;
mod builder;
mod friction_laws;
mod gear;
mod hitch;
mod in_place;
mod line;
mod line_shapes;
mod sea;
mod segments;
mod strength;
mod whale;
mod wrapped;

use std::sync::Arc;

use endline_sdk::{FrictionModel, GearType, WhaleMotion};
use endline_sim::ModelSpec;
use endline_sim::model::{RopeOnRope, Settings};

use crate::diagnostic::Diagnostic;
use crate::library::Library;
use crate::limits;
use crate::scenario::Scenario;
use crate::strength::StrengthBudget;
use builder::Builder;

pub use body::{box_inertia, buoy_floats, buoy_inertia, shell_inertia};
pub(crate) use strength::uniform;

/// The available plugins, by id.
pub trait Hooks {
    /// A whale motion.
    fn motion(&self, id: &str) -> Option<Arc<dyn WhaleMotion>>;
    /// A friction model.
    fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>>;
    /// A gear type.
    fn gear(&self, id: &str) -> Option<Arc<dyn GearType>>;
    /// Every id, for messages.
    fn ids(&self) -> Vec<String>;
}

/// Settings of the caller that override those of the scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Seed.
    pub seed: Option<u64>,
    /// Step between inputs [s].
    pub step_s: Option<f64>,
    /// Greatest step while rope is near the whale [s].
    pub contact_step_s: Option<f64>,
    /// Length of the run [s].
    pub duration_s: Option<f64>,
    /// Whether weak links can part.
    pub weak_links: Option<bool>,
    /// Total number of rope nodes.
    pub rope_nodes: Option<u64>,
    /// Whether the whale is kinetic.
    pub kinetic: Option<bool>,
    /// Default for the balance of momentum and energy by source.
    pub balance: bool,
}

/// A spec with the library files it was built from.
#[derive(Clone)]
pub struct Assembled {
    /// The spec.
    pub spec: ModelSpec,
    /// Paths of the library files used, in order, each once.
    pub files: Vec<String>,
    /// Strength budgets of the pieces of lines and of the weak links.
    pub strengths: Vec<StrengthBudget>,
}

/// Builds the spec of a scenario.
pub fn assemble(
    scenario: &Scenario,
    library: &Library,
    hooks: &dyn Hooks,
    options: &Options,
) -> Result<ModelSpec, Vec<Diagnostic>> {
    assemble_traced(scenario, library, hooks, options).map(|assembled| assembled.spec)
}

/// Builds the spec of a scenario with the library files used.
pub fn assemble_traced(
    scenario: &Scenario,
    library: &Library,
    hooks: &dyn Hooks,
    options: &Options,
) -> Result<Assembled, Vec<Diagnostic>> {
    check_options(scenario, options)?;
    let mut builder = Builder::new(scenario, library, hooks, settings(scenario, options));
    builder.add_sea();
    builder.add_whale(options.kinetic);
    builder.add_gear();
    builder.add_obstacles();
    builder.add_fixtures();
    builder.add_free_joints();
    builder.add_free_bodies();
    builder.add_free_lines();
    builder.cut_lines(options.rope_nodes);
    builder.add_free_links();
    builder.enable_links(options.weak_links.unwrap_or(scenario.weak_links));
    builder.add_friction();
    builder.add_pilot();
    builder.add_probes();
    builder.finish()
}

/// Checks the settings of the caller against the limits of files.
fn check_options(scenario: &Scenario, options: &Options) -> Result<(), Vec<Diagnostic>> {
    let settings = [
        ("step", options.step_s, &limits::STEP),
        ("contact_step", options.contact_step_s, &limits::STEP),
        ("duration", options.duration_s, &limits::DURATION),
        ("rope_nodes", options.rope_nodes.map(|nodes| nodes as f64), &limits::ROPE_NODES),
        ("seed", options.seed.map(|seed| seed as f64), &limits::SEED),
    ];
    let beyond = settings.into_iter().filter_map(|(field, value, limit)| {
        limit.check(field, value?).err().map(|beyond| beyond.at(&scenario.place))
    });
    let problems: Vec<Diagnostic> = beyond.collect();
    if problems.is_empty() { Ok(()) } else { Err(problems) }
}

fn rope_on_rope(scenario: &Scenario) -> RopeOnRope {
    let usual = RopeOnRope::default();
    RopeOnRope {
        friction: scenario.rope_friction.as_ref().map_or(usual.friction, |friction| friction.value),
        ..usual
    }
}

fn settings(scenario: &Scenario, options: &Options) -> Settings {
    let usual = Settings::default();
    Settings {
        step_s: options.step_s.or(scenario.step_s).unwrap_or(usual.step_s),
        auto_step: options.step_s.is_none() && scenario.auto_step,
        contact_step_s: options
            .contact_step_s
            .or(scenario.contact_step_s)
            .unwrap_or(usual.contact_step_s),
        contact_tolerance: scenario.contact_tolerance.unwrap_or(usual.contact_tolerance),
        duration_s: options.duration_s.unwrap_or(scenario.duration_s),
        resolution: scenario.resolution,
        seed: options.seed.unwrap_or(scenario.seed),
        rope_on_bodies: scenario.rope_on_bodies,
        bodies_on_whale: scenario.bodies_on_whale,
        bodies_on_bodies: scenario.bodies_on_bodies,
        unbreakable: scenario.unbreakable,
        rope_on_rope: scenario.rope_on_rope.then(|| rope_on_rope(scenario)),
        as_placed: scenario.as_placed,
        balance: scenario.balance.unwrap_or(options.balance),
        holds_still: true,
        ..usual
    }
}

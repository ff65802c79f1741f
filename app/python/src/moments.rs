//! The moments of a run as arrays.

use std::sync::Arc;

use endline_sdk::BodyPart;
use endline_session::Run;
use endline_sim::metrics::Outcome;
use endline_sim::{ContactPoint, Frame, Model};
use pyo3::prelude::*;

const PARTS: usize = BodyPart::ALL.len();

/// The state of the encounter at a moment.
#[derive(Clone, Copy, Debug)]
pub struct Encounter {
    /// The outcome so far.
    pub outcome: Outcome,
    /// Whether the run was long enough to decide it.
    decided: bool,
    /// Turns of rope about each part, in the order of [`BodyPart::ALL`].
    wraps: [f64; PARTS],
    /// Sum of the normal forces on each part, mean of the last step [N].
    normal_n: [f64; PARTS],
}

impl Encounter {
    /// The encounter at the newest moment of a run; `None` without a whale.
    pub fn of(run: &Run) -> Option<Self> {
        let (whale, summary) = run.state().whale.as_ref().zip(run.summary().whale)?;
        let mut wraps = [0.0; PARTS];
        for (turns, part) in wraps.iter_mut().zip(&summary.regions) {
            *turns = part.wraps;
        }
        Some(Self {
            outcome: summary.outcome,
            decided: summary.decided,
            wraps,
            normal_n: whale.contact_force_n,
        })
    }
}

/// Names of a whale's parts, in the order of the series by part.
#[pyfunction]
pub fn parts() -> Vec<&'static str> {
    BodyPart::ALL.into_iter().map(BodyPart::name).collect()
}

/// A moment of a run.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Places, tensions and contacts.
    pub frame: Arc<Frame>,
    /// The encounter; `None` without a whale.
    pub encounter: Option<Encounter>,
}

impl Moment {
    /// The newest moment of a run.
    pub fn of(run: &Run) -> Self {
        Self { frame: run.frame(), encounter: Encounter::of(run) }
    }
}

/// The encounter at each stored frame of a run, by step.
#[derive(Clone, Debug, Default)]
pub struct History {
    encounters: Vec<(u64, Encounter)>,
}

impl History {
    /// Adds the encounter of a run's newest moment if the run has stored its frame.
    /// To be called before the first step and after each.
    pub fn add(&mut self, run: &Run) {
        let step = run.state().step;
        let is_stored = run.frames().last().is_some_and(|frame| frame.step == step);
        let is_new = self.encounters.last().is_none_or(|(last, _)| *last < step);
        if is_stored
            && is_new
            && let Some(encounter) = Encounter::of(run)
        {
            self.encounters.push((step, encounter));
        }
    }

    /// The stored moments of a run. The newest may be missing here: the run stopped in its step, or differs from a recording there.
    pub fn moments(&self, run: &Run) -> Vec<Moment> {
        let encounter = |step: u64| {
            let place = self.encounters.binary_search_by_key(&step, |(step, _)| *step);
            match place {
                Ok(place) => Some(self.encounters[place].1),
                Err(_) if step == run.state().step => Encounter::of(run),
                Err(_) => None,
            }
        };
        let moment = |frame: &Arc<Frame>| Moment {
            frame: Arc::clone(frame),
            encounter: encounter(frame.step),
        };
        run.frames().iter().map(moment).collect()
    }
}

/// Numbers of an array in the byte order of the machine.
pub struct Numbers {
    /// The numbers.
    pub bytes: Vec<u8>,
    /// Length of each axis.
    pub shape: Vec<usize>,
    /// Numpy's name of their type.
    pub kind: &'static str,
}

/// A series by its name; units and axes are documented with `endline.Result`.
pub fn series(moments: &[Moment], model: &Model, name: &str) -> Option<Numbers> {
    if let Some(numbers) = encounters(moments, name) {
        return Some(numbers);
    }
    let frames: Vec<&Frame> = moments.iter().map(|moment| moment.frame.as_ref()).collect();
    let frames = frames.as_slice();
    let all = frames.iter().copied();
    Some(match name {
        "time_s" => reals(frames.len(), &[], all.map(|frame| frame.time_s)),
        "step" => wholes(frames.len(), all.map(|frame| frame.step as i64)),
        "node_position_m" => {
            let nodes = model.node_count;
            let places =
                all.flat_map(|frame| frame.nodes.iter().flat_map(|place| place.to_array()));
            reals(frames.len(), &[nodes, 3], places)
        }
        "tension_N" => {
            let tensions = all.flat_map(|frame| frame.tension_n.iter().copied());
            reals(frames.len(), &[model.segment_line.len()], tensions)
        }
        "segment_length_m" => {
            let lengths = all.flat_map(|frame| frame.segment_length_m.iter().copied());
            reals(frames.len(), &[model.segment_line.len()], lengths)
        }
        "is_cut" => {
            let cuts = all.flat_map(|frame| frame.cut.iter().copied());
            flags(frames.len(), &[model.segment_line.len()], cuts)
        }
        "body_position_m" => {
            let bodies = model.spec.bodies.len();
            let places =
                all.flat_map(|frame| frame.bodies.iter().flat_map(|body| body.0.to_array()));
            reals(frames.len(), &[bodies, 3], places)
        }
        "body_orientation" => {
            let bodies = model.spec.bodies.len();
            let turns =
                all.flat_map(|frame| frame.bodies.iter().flat_map(|body| body.1.to_array()));
            reals(frames.len(), &[bodies, 4], turns)
        }
        _ => return whale(frames, name).or_else(|| contacts(frames, name)),
    })
}

/// Series of the encounter; empty without a whale.
fn encounters(moments: &[Moment], name: &str) -> Option<Numbers> {
    let all: Vec<&Encounter> =
        moments.iter().filter_map(|moment| moment.encounter.as_ref()).collect();
    Some(match name {
        "wraps_turns" => {
            reals(all.len(), &[PARTS], all.iter().flat_map(|encounter| encounter.wraps))
        }
        "part_normal_force_N" => {
            reals(all.len(), &[PARTS], all.iter().flat_map(|encounter| encounter.normal_n))
        }
        "decided" => flags(all.len(), &[], all.iter().map(|encounter| encounter.decided)),
        _ => return None,
    })
}

/// Series of the whale; empty without a whale.
fn whale(frames: &[&Frame], name: &str) -> Option<Numbers> {
    let whales: Vec<_> = frames.iter().filter_map(|frame| frame.whale.as_ref()).collect();
    let all = whales.iter();
    Some(match name {
        "whale_position_m" => {
            reals(whales.len(), &[3], all.flat_map(|whale| whale.position.to_array()))
        }
        "whale_orientation" => {
            reals(whales.len(), &[4], all.flat_map(|whale| whale.orientation.to_array()))
        }
        "whale_speed_m_s" => reals(whales.len(), &[], all.map(|whale| whale.speed_m_s)),
        _ => return None,
    })
}

/// Series of all contacts of all moments.
fn contacts(frames: &[&Frame], name: &str) -> Option<Numbers> {
    let count = frames.iter().map(|frame| frame.contacts.len()).sum();
    let all = || frames.iter().flat_map(|frame| &frame.contacts);
    let whole = |of: fn(&ContactPoint) -> usize| wholes(count, all().map(|at| of(at) as i64));
    let real = |of: fn(&ContactPoint) -> f64| reals(count, &[], all().map(of));
    Some(match name {
        "contact_moment" => {
            let numbered = frames.iter().enumerate();
            wholes(
                count,
                numbered
                    .flat_map(|(moment, frame)| frame.contacts.iter().map(move |_| moment as i64)),
            )
        }
        "contact_line" => whole(|at| at.line),
        "contact_segment" => whole(|at| at.segment),
        "contact_position_m" => reals(count, &[3], all().flat_map(|at| at.position.to_array())),
        "contact_normal" => reals(count, &[3], all().flat_map(|at| at.normal.to_array())),
        "contact_normal_force_N" => real(|at| at.normal_force_n),
        "contact_friction_N" => reals(count, &[3], all().flat_map(|at| at.friction_n.to_array())),
        "contact_length_m" => real(|at| at.length_m),
        _ => return None,
    })
}

/// The regions of skin that contacts lie on, by contact.
pub fn regions(moments: &[Moment]) -> Vec<&'static str> {
    let contacts = moments.iter().flat_map(|moment| &moment.frame.contacts);
    contacts.map(|contact| contact.region.name()).collect()
}

fn reals(count: usize, inner: &[usize], numbers: impl Iterator<Item = f64>) -> Numbers {
    let shape = [&[count], inner].concat();
    Numbers { bytes: numbers.flat_map(f64::to_ne_bytes).collect(), shape, kind: "f8" }
}

fn wholes(count: usize, numbers: impl Iterator<Item = i64>) -> Numbers {
    Numbers { bytes: numbers.flat_map(i64::to_ne_bytes).collect(), shape: vec![count], kind: "i8" }
}

fn flags(count: usize, inner: &[usize], flags: impl Iterator<Item = bool>) -> Numbers {
    let shape = [&[count], inner].concat();
    Numbers { bytes: flags.map(u8::from).collect(), shape, kind: "?" }
}

//! The moments of a run as arrays.

use std::sync::Arc;

use endline_sim::{ContactPoint, Frame};

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
pub fn series(frames: &[Arc<Frame>], name: &str) -> Option<Numbers> {
    let all = frames.iter().map(AsRef::as_ref);
    Some(match name {
        "time_s" => reals(frames.len(), &[], all.map(|frame| frame.time_s)),
        "step" => wholes(frames.len(), all.map(|frame| frame.step as i64)),
        "node_position_m" => {
            let nodes = first(frames, |frame| frame.nodes.len());
            let places =
                all.flat_map(|frame| frame.nodes.iter().flat_map(|place| place.to_array()));
            reals(frames.len(), &[nodes, 3], places)
        }
        "tension_N" => {
            let segments = first(frames, |frame| frame.tension_n.len());
            reals(frames.len(), &[segments], all.flat_map(|frame| frame.tension_n.iter().copied()))
        }
        "segment_length_m" => {
            let segments = first(frames, |frame| frame.segment_length_m.len());
            reals(
                frames.len(),
                &[segments],
                all.flat_map(|frame| frame.segment_length_m.iter().copied()),
            )
        }
        "body_position_m" => {
            let bodies = first(frames, |frame| frame.bodies.len());
            let places =
                all.flat_map(|frame| frame.bodies.iter().flat_map(|body| body.0.to_array()));
            reals(frames.len(), &[bodies, 3], places)
        }
        "body_orientation" => {
            let bodies = first(frames, |frame| frame.bodies.len());
            let turns =
                all.flat_map(|frame| frame.bodies.iter().flat_map(|body| body.1.to_array()));
            reals(frames.len(), &[bodies, 4], turns)
        }
        _ => return whale(frames, name).or_else(|| contacts(frames, name)),
    })
}

/// Series of the whale; empty without a whale.
fn whale(frames: &[Arc<Frame>], name: &str) -> Option<Numbers> {
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
fn contacts(frames: &[Arc<Frame>], name: &str) -> Option<Numbers> {
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

fn first(frames: &[Arc<Frame>], count: fn(&Frame) -> usize) -> usize {
    frames.first().map_or(0, |frame| count(frame))
}

fn reals(count: usize, inner: &[usize], numbers: impl Iterator<Item = f64>) -> Numbers {
    let shape = [&[count], inner].concat();
    Numbers { bytes: numbers.flat_map(f64::to_ne_bytes).collect(), shape, kind: "f8" }
}

fn wholes(count: usize, numbers: impl Iterator<Item = i64>) -> Numbers {
    Numbers { bytes: numbers.flat_map(i64::to_ne_bytes).collect(), shape: vec![count], kind: "i8" }
}

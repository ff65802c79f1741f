//! A glTF animation of the whale's bones as joint angles over time: an act made in Blender.
//!
//! ```text
//! D_b = R_b(t) R_b(rest)⁻¹             rotation of a bone from its rest, in the scene
//! T_b = D_parent⁻¹ D_b                 rotation of the bone itself
//! T_b = Π exp(a_i axis_i)              about its axes; solved for a_i by Newton's method
//! ```
//!
//! An angle of several bones is the sum of their rotations. The result is therefore independent of the local axes of the
//! file's bones, and keys of different bones may have different times. The motion of the whole whale is not read.

use std::collections::BTreeMap;

use endline_sim::whale::{Angle, Bone};
use glam::{DAffine3, DMat3, DQuat, DVec3};
use gltf::animation::{Interpolation, Property};
use gltf::{Animation as FileAnimation, Document};

use crate::diagnostic::hint;

use super::Fault;
use super::file::{File, rows};
use super::joints::{local, parents, rests};

/// Joint angles over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    /// Times of the keys, rising [s].
    pub times_s: Vec<f64>,
    /// The moving angles, with their values at each time [rad].
    pub angles: Vec<(Angle, Vec<f64>)>,
}

/// Greatest allowed rotation of a bone about other axes than its own [rad]: 3 degrees.
const ASTRAY_RAD: f64 = 0.052;
/// Smallest amplitude of a moving angle [rad].
const STILL_RAD: f64 = 1e-5;
/// Iteration limit of Newton's method, far above the usual number.
const PASSES: usize = 12;

/// Reads an animation by name, or the only one, for a whale with these bones.
pub fn read_animation(
    bytes: &[u8],
    name: Option<&str>,
    bones: &[Bone],
) -> Result<Animation, Fault> {
    let file = File::open(bytes)?;
    let turnings = turnings(&file, &named(&file.document, name)?)?;
    let mut times_s: Vec<f64> =
        turnings.values().flat_map(|turning| turning.times_s.iter().copied()).collect();
    times_s.sort_by(f64::total_cmp);
    times_s.dedup_by(|later, earlier| *later - *earlier < 1e-6);
    let rig = Rig::of(&file, bones)?;
    if !rig.nodes.iter().flatten().any(|node| turnings.contains_key(node)) {
        return Err(Fault::new(
            "rotates no bone of the whale",
            "key the rotations of its bones, such as spine_3 or left_flipper_blade",
        ));
    }
    let mut angles: Vec<(Angle, Vec<f64>)> =
        Angle::all().map(|angle| (angle, vec![0.0; times_s.len()])).collect();
    for (index, time_s) in times_s.iter().enumerate() {
        for (angle, turned) in rig.angles_at(&turnings, *time_s, bones)? {
            if let Some((_, values)) = angles.iter_mut().find(|(known, _)| *known == angle) {
                values[index] += turned;
            }
        }
    }
    angles.retain(|(_, values)| values.iter().any(|value| value.abs() > STILL_RAD));
    Ok(Animation { times_s, angles })
}

/// The animation of a name, or the only one.
fn named<'a>(document: &'a Document, name: Option<&str>) -> Result<FileAnimation<'a>, Fault> {
    let names: Vec<&str> = document
        .animations()
        .map(|animation| animation.name().unwrap_or("without a name"))
        .collect();
    let found = document
        .animations()
        .find(|animation| name.is_none_or(|name| animation.name() == Some(name)));
    match (found, name) {
        (Some(_), None) if names.len() > 1 => Err(Fault::new(
            format!("has {} animations", names.len()),
            format!("name one with `clip`: {}", names.join(", ")),
        )),
        (Some(found), _) => Ok(found),
        (None, Some(name)) => {
            Err(Fault::new(format!("has no animation `{name}`"), hint(name, names)))
        }
        (None, None) => {
            Err(Fault::new("has no animation", "in Blender, export with Animation switched on"))
        }
    }
}

/// Keys of the local rotation of a node.
struct Turning {
    times_s: Vec<f64>,
    turns: Vec<DQuat>,
}

/// Keys of all rotating nodes.
fn turnings(file: &File, animation: &FileAnimation<'_>) -> Result<BTreeMap<usize, Turning>, Fault> {
    let mut turnings = BTreeMap::new();
    for channel in
        animation.channels().filter(|channel| channel.target().property() == Property::Rotation)
    {
        let sampler = channel.sampler();
        let times_s: Vec<f64> =
            rows::<1>(file, &sampler.input())?.into_iter().map(|[time_s]| time_s).collect();
        let mut turns: Vec<DQuat> = rows::<4>(file, &sampler.output())?
            .into_iter()
            .map(|turn| DQuat::from_array(turn).normalize())
            .collect();
        if sampler.interpolation() == Interpolation::CubicSpline {
            turns = turns.chunks(3).filter_map(|key| key.get(1).copied()).collect();
        }
        let rising = times_s.windows(2).all(|pair| pair[1] > pair[0])
            && times_s.first().is_some_and(|first| *first >= 0.0);
        if !rising || times_s.len() != turns.len() || !turns.iter().all(|turn| turn.is_finite()) {
            return Err(Fault::new(
                "has invalid keys",
                "export it again with a program that conforms to glTF 2.0",
            ));
        }
        turnings.insert(channel.target().node().index(), Turning { times_s, turns });
    }
    Ok(turnings)
}

impl Turning {
    /// The rotation at a time: interpolated along the shortest arc, constant beyond the keys.
    fn at(&self, time_s: f64) -> DQuat {
        let after = self.times_s.partition_point(|key_s| *key_s <= time_s);
        if after == 0 || after == self.times_s.len() {
            return self.turns[after.min(self.turns.len() - 1)];
        }
        let [from_s, to_s] = [self.times_s[after - 1], self.times_s[after]];
        self.turns[after - 1].slerp(self.turns[after], (time_s - from_s) / (to_s - from_s))
    }
}

/// The nodes of a file as the whale's bones.
struct Rig {
    /// The node of each bone; `None` if the file has none.
    nodes: Vec<Option<usize>>,
    parents: Vec<Option<usize>>,
    /// Local rotation of each node without animation.
    locals: Vec<DQuat>,
    /// Rotation of each node at rest, in the scene.
    rests: Vec<DQuat>,
}

impl Rig {
    fn of(file: &File, bones: &[Bone]) -> Result<Self, Fault> {
        let node = |bone: &Bone| {
            file.document
                .nodes()
                .find(|node| node.name() == Some(bone.name.as_str()))
                .map(|node| node.index())
        };
        let rotation =
            |transform: DAffine3| transform.to_scale_rotation_translation().1.normalize();
        Ok(Self {
            nodes: bones.iter().map(node).collect(),
            parents: parents(file),
            locals: file.document.nodes().map(|node| rotation(local(&node))).collect(),
            rests: rests(file)?.into_iter().map(rotation).collect(),
        })
    }

    /// Rotation of each bone about its axes at a time; an angle may have several bones.
    fn angles_at(
        &self,
        turnings: &BTreeMap<usize, Turning>,
        time_s: f64,
        bones: &[Bone],
    ) -> Result<Vec<(Angle, f64)>, Fault> {
        let mut turned = vec![DQuat::IDENTITY; bones.len()];
        let mut angles = Vec::new();
        for (index, bone) in bones.iter().enumerate() {
            let before = bone.parent.map_or(DQuat::IDENTITY, |parent| turned[parent]);
            turned[index] =
                self.nodes[index].map_or(before, |node| self.turned(turnings, time_s, node));
            if bone.parent.is_none() {
                continue;
            }
            let axes: Vec<DVec3> = bone.turns.iter().map(|(_, axis)| *axis).collect();
            let (own, astray) = about_axes(&axes, before.conjugate() * turned[index]);
            if astray > ASTRAY_RAD {
                let off = astray.to_degrees();
                let message = format!(
                    "rotates `{}` at {time_s:.2} s by {off:.1} deg about an axis that the bone does not have",
                    bone.name
                );
                return Err(Fault::new(
                    message,
                    "rotate bones about the axes in their custom property `turns`, and lock the others",
                ));
            }
            angles.extend(
                bone.turns.iter().zip(own).map(|((channel, _), angle)| (channel.angle, angle)),
            );
        }
        Ok(angles)
    }

    /// Rotation of a node from its rest, in the whale's axes.
    fn turned(&self, turnings: &BTreeMap<usize, Turning>, time_s: f64, node: usize) -> DQuat {
        let (mut world, mut at) = (DQuat::IDENTITY, Some(node));
        for _ in 0..self.parents.len() {
            let Some(here) = at else { break };
            world =
                turnings.get(&here).map_or(self.locals[here], |turning| turning.at(time_s)) * world;
            at = self.parents[here];
        }
        let to_whale = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
        to_whale * (world * self.rests[node].conjugate()) * to_whale.conjugate()
    }
}

/// Angles about up to three successive axes whose product is closest to a rotation, and the remaining angle [rad].
fn about_axes(axes: &[DVec3], turn: DQuat) -> (Vec<f64>, f64) {
    let mut angles = vec![0.0; axes.len()];
    let mut astray = f64::INFINITY;
    for _ in 0..PASSES {
        let (mut made, mut columns) = (DQuat::IDENTITY, [DVec3::ZERO; 3]);
        for (index, axis) in axes.iter().enumerate().take(3).rev() {
            columns[index] = made * *axis;
            made *= DQuat::from_axis_angle(*axis, angles[index]);
        }
        let off = turn * made.conjugate();
        let off = (if off.w < 0.0 { -off } else { off }).to_scaled_axis();
        astray = off.length();
        let jacobian = DMat3::from_cols(columns[0], columns[1], columns[2]);
        let normal = jacobian.transpose() * jacobian + DMat3::from_diagonal(DVec3::splat(1e-12));
        let change = normal.inverse() * (jacobian.transpose() * off);
        angles.iter_mut().zip(change.to_array()).for_each(|(angle, change)| *angle += change);
    }
    (angles, astray)
}

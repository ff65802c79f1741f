//! A glTF animation of the whale's bones as joint angles over time: an act made in Blender.
//!
//! ```text
//! D_b = R_b(t) R_b(rest)⁻¹             turn of a bone against its rest, in the scene
//! T_b = D_parent⁻¹ D_b                 what the bone itself turned
//! T_b = Π exp(a_i axis_i)              the turns it has; solved for a_i by Newton
//! ```
//!
//! An angle shared among bones is the sum of what they turned. So it does not matter how the file's bones lie along themselves, and keys of
//! different bones may stand at different times. Where the whole whale goes and turns is not read.

use std::collections::BTreeMap;

use endline_sim::whale::{Angle, Bone};
use glam::{DAffine3, DMat3, DQuat, DVec3};
use gltf::animation::{Interpolation, Property};
use gltf::{Animation as FileAnimation, Document};

use super::Fault;
use super::accessor::rows;
use super::file::File;
use super::joints::{local, parents, rests};
use crate::nearest::hint;

/// Joint angles over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    /// Times of the keys, rising [s].
    pub times_s: Vec<f64>,
    /// Each angle that moves, with its value at each time [rad].
    pub angles: Vec<(Angle, Vec<f64>)>,
}

/// Greatest turn of a bone that none of its axes explains [rad]: 3 degrees.
const ASTRAY_RAD: f64 = 0.052;
/// An angle that never passes this does not move [rad].
const STILL_RAD: f64 = 1e-5;
/// Passes of Newton, far more than it takes.
const PASSES: usize = 12;

/// Reads an animation by its name, or the only one, for a whale of these bones.
///
/// # Errors
/// Where the file cannot be read, has not that animation, turns no bone of the whale, or turns one about an axis that it does not have.
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
            "turns no bone of the whale",
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

/// Keys of a node's own rotation.
struct Turning {
    times_s: Vec<f64>,
    turns: Vec<DQuat>,
}

/// The keys of every node that turns.
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
                "has keys that are not sound",
                "write the file anew with a program that keeps to glTF 2.0",
            ));
        }
        turnings.insert(channel.target().node().index(), Turning { times_s, turns });
    }
    Ok(turnings)
}

impl Turning {
    /// The rotation at a time: between keys along the shortest arc, beyond them the nearest key's.
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
    /// The node of each bone of the whale; none for one the file does not have.
    nodes: Vec<Option<usize>>,
    parents: Vec<Option<usize>>,
    /// Own rotation of each node where nothing moves it.
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

    /// What each bone turned about its axes at a time; an angle may come from several bones.
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
                    "turns `{}` at {time_s:.2} s by {off:.1} deg about an axis that it does not have",
                    bone.name
                );
                return Err(Fault::new(
                    message,
                    "turn bones about the axes in their custom property `turns`, and lock the others",
                ));
            }
            angles.extend(
                bone.turns.iter().zip(own).map(|((channel, _), angle)| (channel.angle, angle)),
            );
        }
        Ok(angles)
    }

    /// Turn of a node against its rest, in the whale's axes.
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

/// Angles about up to three axes, turned one after the other, whose product is nearest to a turn, and how far off that is [rad].
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

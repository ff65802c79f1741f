//! A run in motion as binary glTF 2.0, for Blender and other programs: metres, y up, seconds from the first frame.
//!
//! | node | moves by |
//! |---|---|
//! | `whale` | place and turn; its bending (fluke beat, flippers, mouth) as morph targets, one a frame |
//! | a line, by its id | morph targets: a tube through places at equal shares of its length |
//! | a body, by its id | place and turn |
//! | a knot or link | place |
//!
//! Nodes of a line come and go as its resolution follows the whale; a mesh keeps its vertices. So a line is sampled at places of
//! its own, and a line that parts is one mesh a piece from the start.

use std::sync::Arc;

use endline_gear::whale::gltf::pack::Pack;
use endline_sim::{DQuat, DVec3, Frame, Model};
use glam::{Quat, Vec3};
use serde_json::{Value, json};

use super::model::{self, Piece, pieces, turned};
use crate::scene::mesh::{Colour, Mesh};
use crate::scene::{bodies, obstacles, whale};

/// Most bytes that a file may have: glTF counts them in 32 bits.
const MOST_BYTES: usize = 4_000_000_000;

/// Colour of rope and of knots: tension is not shown, for glTF has no colours that change.
const ROPE: Colour = [0.85, 0.72, 0.25, 1.0];

/// The animation of frames, which are of one run and at even steps of `step_s`.
pub fn glb(model: &Model, frames: &[Arc<Frame>], step_s: f64) -> Result<Vec<u8>, String> {
    let first = frames.first().ok_or("there is no frame to write")?;
    // Vertices that move in every frame, about.
    let skin = model.spec.whale.as_ref().map_or(0, |whale| whale.skin.vertices.len());
    let vertices = skin + model.spec.lines.len() * Piece::MOST_VERTICES;
    let bytes = 12 * vertices * frames.len() + 4 * frames.len() * frames.len();
    if bytes > MOST_BYTES {
        return Err(format!(
            "{} frames of {vertices} vertices are more than a glTF file can hold; write a shorter stretch, or fewer frames a second",
            frames.len()
        ));
    }
    let mut clip = Clip::of(frames.len(), step_s);
    let obstacles = obstacles::obstacles(model);
    if !obstacles.triangles.is_empty() {
        clip.mesh("obstacles", &obstacles, &[]);
    }
    clip.whale(model, frames);
    clip.lines(model, frames);
    for (index, body) in model.spec.bodies.iter().enumerate() {
        let poses: Vec<Pose> =
            frames.iter().filter_map(|frame| frame.bodies.get(index).copied()).collect();
        clip.rigid(&body.id, &bodies::one(body), &poses);
    }
    clip.knots(model, frames, first);
    Ok(clip.written())
}

type Pose = (DVec3, DQuat);

/// A glTF document in the making.
struct Clip {
    pack: Pack,
    frames: usize,
    /// Accessors of the times, and of the weights by which morph target `k` counts at frame `k + 1` alone.
    times: usize,
    weights: Option<usize>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

impl Clip {
    fn of(frames: usize, step_s: f64) -> Self {
        let mut pack = Pack::default();
        let at = |frame: usize| (frame as f64 * step_s) as f32;
        let rows: Vec<[f32; 1]> = (0..frames).map(|frame| [at(frame)]).collect();
        let times = pack.numbers(&rows);
        pack.accessors[times]["min"] = json!([0.0]);
        pack.accessors[times]["max"] = json!([at(frames.saturating_sub(1))]);
        let (meshes, nodes, samplers, channels) = Default::default();
        Self { pack, frames, times, weights: None, meshes, nodes, samplers, channels }
    }

    /// Adds a mesh with morph targets, which are differences from its places, and its node.
    fn mesh(&mut self, name: &str, mesh: &Mesh, targets: &[Vec<[f32; 3]>]) -> usize {
        let mut primitive = model::primitive(&mut self.pack, mesh);
        if !targets.is_empty() {
            let morphs: Vec<Value> = targets
                .iter()
                .map(|target| json!({ "POSITION": self.pack.places(target) }))
                .collect();
            primitive["targets"] = json!(morphs);
        }
        self.nodes.push(json!({ "name": name, "mesh": self.meshes.len() }));
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        self.nodes.len() - 1
    }

    fn moves(&mut self, node: usize, path: &str, output: usize) {
        self.channels.push(json!({
            "sampler": self.samplers.len(),
            "target": { "node": node, "path": path },
        }));
        self.samplers.push(json!({
            "input": self.times,
            "output": output,
            "interpolation": "LINEAR",
        }));
    }

    /// A mesh that moves as a whole.
    fn rigid(&mut self, name: &str, mesh: &Mesh, poses: &[Pose]) {
        if poses.len() == self.frames && !mesh.triangles.is_empty() {
            let node = self.mesh(name, mesh, &[]);
            self.posed(node, poses);
        }
    }

    fn posed(&mut self, node: usize, poses: &[Pose]) {
        let places: Vec<[f32; 3]> =
            poses.iter().map(|(place, _)| turned(place.as_vec3())).collect();
        let output = self.pack.numbers(&places);
        self.moves(node, "translation", output);
        let mut turns: Vec<Quat> = Vec::with_capacity(poses.len());
        for (_, turn) in poses {
            let turn = turned_quat(turn.as_quat());
            // A turn and its negative are one; between neighbours the way is the shorter one.
            let before = turns.last().copied().unwrap_or(turn);
            turns.push(if before.dot(turn) < 0.0 { -turn } else { turn });
        }
        let turns: Vec<[f32; 4]> = turns.iter().map(Quat::to_array).collect();
        let output = self.pack.numbers(&turns);
        self.moves(node, "rotation", output);
    }

    /// A mesh that bends: the mesh of the first frame, and the places of each later one.
    fn bends(&mut self, name: &str, first: &Mesh, later: &[Vec<Vec3>]) -> usize {
        let base: Vec<Vec3> = (0..first.vertices()).map(|vertex| first.surface(vertex)).collect();
        let differences = |places: &Vec<Vec3>| -> Vec<[f32; 3]> {
            places.iter().zip(&base).map(|(place, base)| turned(*place - *base)).collect()
        };
        let targets: Vec<Vec<[f32; 3]>> = later.iter().map(differences).collect();
        let node = self.mesh(name, first, &targets);
        if !targets.is_empty() {
            let weights = self.weights();
            self.moves(node, "weights", weights);
        }
        node
    }

    fn weights(&mut self) -> usize {
        if let Some(weights) = self.weights {
            return weights;
        }
        let targets = self.frames - 1;
        let weight = |frame: usize, target: usize| if frame == target + 1 { [1.0] } else { [0.0] };
        let rows: Vec<[f32; 1]> = (0..self.frames)
            .flat_map(|frame| (0..targets).map(move |target| weight(frame, target)))
            .collect();
        let weights = self.pack.numbers(&rows);
        self.weights = Some(weights);
        weights
    }

    fn whale(&mut self, model: &Model, frames: &[Arc<Frame>]) {
        let poses: Vec<Pose> = frames
            .iter()
            .filter_map(|frame| frame.whale.as_ref().map(|at| (at.position, at.orientation)))
            .collect();
        if model.spec.whale.is_none() || poses.len() != frames.len() {
            return;
        }
        let mut skins = frames.iter().zip(&poses).map(|(frame, (place, turn))| {
            let [mut skin, _] = whale::skin_and_eyes(model, frame);
            let back = turn.inverse().as_quat();
            let place = place.as_vec3();
            skin.place.iter_mut().for_each(|at| *at = back * (*at - place));
            skin.normal.iter_mut().for_each(|normal| *normal = back * *normal);
            skin
        });
        let Some(first) = skins.next() else { return };
        let later: Vec<Vec<Vec3>> = skins.map(|skin| skin.place).collect();
        let node = self.bends("whale", &first, &later);
        self.posed(node, &poses);
    }

    fn lines(&mut self, model: &Model, frames: &[Arc<Frame>]) {
        for (line, spec) in model.spec.lines.iter().enumerate() {
            let radius = (model.spec.ropes[spec.rope].diameter_m * 0.5) as f32;
            for (number, piece) in pieces(model, frames, line).iter().enumerate() {
                let (first, later) = piece.meshes(model, frames, radius, ROPE);
                let name = match number {
                    0 => spec.id.clone(),
                    number => format!("{} piece {}", spec.id, number + 1),
                };
                self.bends(&name, &first, &later);
            }
        }
    }

    /// Knots, splices and links as balls at their places.
    fn knots(&mut self, model: &Model, frames: &[Arc<Frame>], first: &Frame) {
        for (index, knot) in model.knots.iter().enumerate() {
            let mut ball = Mesh::default();
            ball.ball(Vec3::ZERO, knot.radius_m as f32, ROPE, 6);
            let share = Piece::share_of_knot(model, first, knot);
            let line = model.segment_line[knot.segment];
            let poses: Vec<Pose> = frames
                .iter()
                .filter_map(|frame| {
                    let place = Piece::place_at(model, frame, line, share)?;
                    Some((place.as_dvec3(), DQuat::IDENTITY))
                })
                .collect();
            self.rigid(&format!("knot {}", index + 1), &ball, &poses);
        }
    }

    fn written(self) -> Vec<u8> {
        let animation = (!self.channels.is_empty()).then(
            || json!({ "name": "run", "samplers": self.samplers, "channels": self.channels }),
        );
        model::file(self.pack, self.nodes, self.meshes, animation)
    }
}

/// A turn about the same axis, which is given with y up.
fn turned_quat(turn: Quat) -> Quat {
    Quat::from_xyzw(turn.x, turn.z, -turn.y, turn.w)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_with_y_up_turns_what_is_turned() {
        let (turn, place) =
            (Quat::from_euler(glam::EulerRot::ZYX, 0.7, -0.3, 1.1), Vec3::new(1.0, 2.0, 3.0));
        let there = Vec3::from(turned(turn * place));
        assert!((turned_quat(turn) * Vec3::from(turned(place)) - there).length() < 1e-6);
    }
}

//! Rope made fast to the whale: where such an end is, and how it pulls.
//!
//! A hitch is a place on a triangle of the skin, a little off it, and goes where the skin goes: within a step of the model straight
//! from where the bones put it at the start to where they put it at the end, as the skin does. To the rope it is a fixture that
//! moves; what its end segment pulls is the force on the whale.

use endline_sdk::LineEnd;
use glam::{DAffine3, DVec3};

use super::pose::{pose, skin_vertex};
use super::skin::Skin;
use crate::model::{Hitch, JointKind, Model};
use crate::state::State;

impl Hitch {
    /// Its place under the bones' transforms [m].
    #[must_use]
    pub fn place(&self, skin: &Skin, bones: &[DAffine3]) -> DVec3 {
        let [a, b, c] =
            skin.triangles[self.triangle].map(|vertex| skin_vertex(skin, bones, vertex as usize));
        let [of_a, of_b, of_c] = self.barycentric;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        a * of_a + b * of_b + c * of_c + normal * self.stand_off_m
    }
}

/// Where the hitches of a model are in one of its steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hitches {
    /// Joint, with its place at the start and at the end of the model's step.
    list: Vec<(usize, [DVec3; 2])>,
    /// Shares of the model's step at which the solver step begins and ends.
    pub span: [f64; 2],
    /// Share of the model's step that the skin has gone.
    pub share: f64,
}

impl Hitches {
    /// Those of a model, where its whale starts.
    pub fn new(model: &Model) -> Self {
        let joints = model.spec.joints.iter().enumerate();
        let list = joints
            .filter(|(_, joint)| matches!(joint.kind, JointKind::Whale(_)))
            .map(|(joint, _)| (joint, [DVec3::ZERO; 2]));
        let mut hitches = Self { list: list.collect(), span: [0.0, 1.0], share: 1.0 };
        if let (Some(whale), false) = (&model.spec.whale, hitches.list.is_empty()) {
            let mut bones = Vec::new();
            pose(
                &whale.skin,
                whale.position_m,
                whale.orientation,
                &whale.start_posture(),
                &mut bones,
            );
            hitches.move_to(model, [&bones, &bones]);
        }
        hitches
    }

    /// Takes the bones at the start and the end of a step of the model.
    pub fn move_to(&mut self, model: &Model, bones: [&[DAffine3]; 2]) {
        let Some(whale) = &model.spec.whale else { return };
        for (joint, places) in &mut self.list {
            if let JointKind::Whale(hitch) = &model.spec.joints[*joint].kind {
                *places = bones.map(|bones| hitch.place(&whale.skin, bones));
            }
        }
    }

    /// The place of a joint made fast to the whale.
    pub fn place(&self, joint: usize) -> Option<DVec3> {
        let [from, to] = self.list.iter().find(|(known, _)| *known == joint)?.1;
        Some(from.lerp(to, self.share))
    }
}

/// Force on the whale and place of every line end made fast to it [N, m].
///
/// The tension of the end's segment counts; what bends rope does at its end does not.
pub(crate) fn pulls<'a>(
    model: &'a Model,
    state: &'a State,
) -> impl Iterator<Item = (DVec3, DVec3)> + 'a {
    ends(model).filter_map(|(line, end)| {
        let (nodes, segments) = (&model.line_nodes[line], &model.line_segments[line]);
        let (tip, inner, segment) = match end {
            LineEnd::A => (nodes.start, nodes.start + 1, segments.start),
            LineEnd::B => (nodes.end - 1, nodes.end - 2, segments.end - 1),
        };
        let tension =
            if state.rope.cut[segment] { 0.0 } else { state.rope.tension[segment].max(0.0) };
        let [tip, inner] = [tip, inner].map(|node| state.rope.position[node]);
        Some(((inner - tip).try_normalize()? * tension, tip))
    })
}

/// Line ends made fast to the whale.
pub(crate) fn ends(model: &Model) -> impl Iterator<Item = (usize, LineEnd)> + '_ {
    let is_hitch = |joint: usize| matches!(model.spec.joints[joint].kind, JointKind::Whale(_));
    model.spec.lines.iter().enumerate().flat_map(move |(index, line)| {
        let at = |joint: usize, end| is_hitch(joint).then_some((index, end));
        [at(line.from, LineEnd::A), at(line.to, LineEnd::B)].into_iter().flatten()
    })
}

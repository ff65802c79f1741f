//! Rope attached to the whale: positions of such line ends, and their forces.
//!
//! A hitch is a point at a barycentric position `b` on a triangle `x_i` of the skin, at the distance `d` [m] along the unit
//! normal `n`:
//! `p = Σ b_i x_i + d n`. It moves with the skin: during a step it moves straight from its position under the bones at the
//! start to that at the end. For rope it is a driven fixture; the force of the end segment, `T t` with `T` the tension [N] and
//! `t` the unit tangent, acts on the whale.

use endline_sdk::LineEnd;
use glam::{DAffine3, DVec3};

use super::pose::{pose, skin_vertex};
use super::skin::Skin;
use crate::model::{Hitch, JointKind, Model};
use crate::state::State;

impl Hitch {
    /// Its position under the bones' transforms [m].
    pub fn place(&self, skin: &Skin, bones: &[DAffine3]) -> DVec3 {
        let [a, b, c] =
            skin.triangles[self.triangle].map(|vertex| skin_vertex(skin, bones, vertex as usize));
        let [of_a, of_b, of_c] = self.barycentric;
        debug_assert!((of_a + of_b + of_c - 1.0).abs() < 1e-9, "barycentric coordinates sum to 1");
        let normal = (b - a).cross(c - a).normalize_or_zero();
        a * of_a + b * of_b + c * of_c + normal * self.stand_off_m
    }
}

/// Positions of the hitches of a model during a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hitches {
    /// Joint, with its position at the start and at the end of the step.
    list: Vec<(usize, [DVec3; 2])>,
    /// Shares of the step at which the solver step starts and ends.
    pub span: [f64; 2],
    /// Share of the step at which the skin is.
    pub share: f64,
}

impl Hitches {
    /// Hitches of a model, with the whale at its initial position.
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

    /// Sets the positions from the bones at the start and the end of a step.
    pub fn move_to(&mut self, model: &Model, bones: [&[DAffine3]; 2]) {
        // A model without a whale has no hitches.
        let Some(whale) = &model.spec.whale else { return };
        for (joint, places) in &mut self.list {
            if let JointKind::Whale(hitch) = &model.spec.joints[*joint].kind {
                *places = bones.map(|bones| hitch.place(&whale.skin, bones));
            }
        }
    }

    /// Position of a joint attached to the whale; `None` for another joint [m].
    pub fn place(&self, joint: usize) -> Option<DVec3> {
        let [from, to] = self.list.iter().find(|(known, _)| *known == joint)?.1;
        Some(from.lerp(to, self.share))
    }
}

/// Force on the whale and position of every line end attached to it [N, m].
///
/// The force is the tension of the end segment; bending is not included.
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

/// Line ends attached to the whale.
pub(crate) fn ends(model: &Model) -> impl Iterator<Item = (usize, LineEnd)> + '_ {
    let is_hitch = |joint: usize| matches!(model.spec.joints[joint].kind, JointKind::Whale(_));
    model.spec.lines.iter().enumerate().flat_map(move |(index, line)| {
        let at = |joint: usize, end| is_hitch(joint).then_some((index, end));
        [at(line.from, LineEnd::A), at(line.to, LineEnd::B)].into_iter().flatten()
    })
}

//! Touches of bodies on skin at the trial, with normal force and friction.
//!
//! Each triangle closer to a core than the contact distance is a touch. Triangles of one patch share the normal force
//! (`law/patch_shares.rs`). Shares are computed in the first iterations of a solver step and then stay, so that Newton can converge.

use glam::DVec3;

use crate::contact::body_on_skin::press::push;
use crate::contact::body_on_skin::{BodyOnSkin, Touch};
use crate::contact::law::friction_arrays::{Asked, Failed, kept_floats};
use crate::contact::law::patch_shares::{Press, Shared, share_out};
use crate::geometry::Pose;
use crate::geometry::placed::on_triangle;
use crate::geometry::sweep::triangle_at;
use crate::model::{Friction, Model};
use crate::state::{BodyGrips, State};

/// Cosine of the angle of two normals above which a touch continues a stored one near it.
const SAME_FACE: f64 = 0.7;
/// Number of the rope in the input of a friction law: no rope.
const NO_ROPE: u32 = u32::MAX;

/// Why bodies could not be measured.
#[derive(Clone, Debug)]
pub(crate) enum Unmeasured {
    /// The core of this body meets this triangle.
    Crushed(usize, usize),
    /// A law of friction failed.
    Plugin(Failed),
}

impl BodyOnSkin {
    /// Evaluates every touch with bodies in these poses, and its friction.
    pub fn evaluate(
        &mut self,
        model: &Model,
        state: &State,
        poses: impl Iterator<Item = Pose>,
        dt: f64,
    ) -> Result<(), Unmeasured> {
        self.measured.clear();
        self.measured.extend(poses);
        self.find_touches(model)?;
        self.share_out();
        self.press(model);
        let Some(friction) = &model.spec.friction else { return Ok(()) };
        self.ask(friction, state);
        self.arrays.respond(friction, dt).map_err(Unmeasured::Plugin)?;
        self.blocks.clear();
        for (place, touch) in self.touches.iter().enumerate() {
            let decrease = touch.normal * touch.stiffness;
            self.blocks.push(self.arrays.block_of(place, touch.normal, decrease));
        }
        Ok(())
    }

    fn find_touches(&mut self, model: &Model) -> Result<(), Unmeasured> {
        std::mem::swap(&mut self.touches, &mut self.touched);
        self.touches.clear();
        let (Some(whale), Some(friction)) = (&model.spec.whale, &model.spec.friction) else {
            return Ok(());
        };
        for near in &self.near {
            let (core, pose) = (&self.cores[near.part], &self.measured[near.body]);
            for index in near.pairs.clone().filter(|index| self.pairs[*index].active) {
                let pair = &self.pairs[index];
                let (triangle, corners) =
                    (pair.triangle as usize, triangle_at(&pair.sweep, self.goal));
                let Some(nearest) = core.nearest(pose, corners) else {
                    if !self.swept {
                        continue;
                    }
                    return Err(Unmeasured::Crushed(near.body, triangle));
                };
                if nearest.distance >= core.reach {
                    continue;
                }
                let region = whale.skin.regions[triangle];
                let at_corners = core.nearest_to_corners(pose, corners, nearest.on_skin);
                let places = std::iter::once(nearest).chain(at_corners);
                let touching = (0..).zip(places).filter(|(_, at)| at.distance < core.reach);
                self.touches.extend(touching.map(|(feature, at)| Touch {
                    part: near.part,
                    body: near.body,
                    pair: index,
                    feature,
                    law: friction.law_of_bodies[region as usize],
                    region,
                    barycentric: at.barycentric,
                    place: at.on_skin,
                    normal: (at.on_core - at.on_skin) / at.distance,
                    depth: core.reach - at.distance,
                    share: 1.0,
                    push_n: 0.0,
                    stiffness: 0.0,
                }));
            }
        }
        if friction.laws.len() > 1 {
            self.touches.sort_unstable_by_key(|touch| (touch.law, touch.pair, touch.feature));
        }
        Ok(())
    }

    fn share_out(&mut self) {
        let Self { touches, touched, cores, .. } = self;
        share_out(touches, touched, self.shared, |part| cores[part].reach);
        self.shared += 1;
    }

    fn press(&mut self, model: &Model) {
        let Some(whale) = &model.spec.whale else { return };
        for touch in &mut self.touches {
            let reach = self.cores[touch.part].reach;
            let [push_n, stiffness] = push(touch.depth, reach, whale.contact_stiffness_n_m2);
            (touch.push_n, touch.stiffness) = (push_n * touch.share, stiffness * touch.share);
        }
    }

    fn ask(&mut self, friction: &Friction, state: &State) {
        self.arrays.clear();
        for touch in &self.touches {
            let pair = &self.pairs[touch.pair];
            let corners = triangle_at(&pair.sweep, self.goal);
            let [start, end] = pair.sweep;
            let moves = [0, 1, 2].map(|corner| end[corner] - start[corner]);
            let skin_move = on_triangle(moves, touch.barycentric) * (self.goal - self.start);
            let now = &state.bodies[touch.body];
            let began = Pose { place: now.position, orientation: now.orientation };
            let inward = self.measured[touch.body].inward(touch.place);
            let body_move = touch.place - began.outward(inward);
            let asked = Asked {
                law: touch.law,
                normal_force: touch.push_n,
                growth_n: 0.0,
                normal: touch.normal,
                grain: self.grains.at(pair.triangle as usize, &corners, touch.normal),
                along: touch.normal,
                slip: body_move - skin_move,
                length: self.cores[touch.part].reach * touch.share,
                share: touch.share,
                coefficient: friction.coefficients_of_bodies[touch.region as usize],
                region: touch.region as u32,
                rope: NO_ROPE,
            };
            let kept = kept_grip(&state.body_grips, touch, inward);
            let kept = kept.and_then(|kept| kept_floats(friction, &state.body_grips.floats, kept));
            self.arrays.put(friction, asked, kept);
        }
    }

    /// Touches with push and friction on the body, linear about where they were measured, the body having moved to a pose since.
    pub fn forces_at<'a>(
        &'a self,
        pose: impl Fn(usize) -> Pose + 'a,
    ) -> impl Iterator<Item = BodyForce> + 'a {
        self.touches.iter().enumerate().map(move |(place, touch)| {
            let (then, now) = (&self.measured[touch.body], pose(touch.body));
            let at = now.outward(then.inward(touch.place));
            let block = self.blocks[place];
            let force = self.arrays.force_of(place) - block * (at - touch.place);
            BodyForce { pair: touch.pair, body: touch.body, arm: at - now.place, force, block }
        })
    }

    /// Stores normal force and friction of the last solution, for bodies that it moved to poses.
    pub fn store_solved(&mut self, pose: impl Fn(usize) -> Pose) {
        let mut pairs = std::mem::take(&mut self.pairs);
        pairs.iter_mut().for_each(|pair| pair.solved = DVec3::ZERO);
        for force in self.forces_at(pose) {
            pairs[force.pair].solved += force.force;
        }
        self.pairs = pairs;
    }

    /// Greatest difference between the forces at the trial and those of the last solution, and the greatest force [N].
    pub fn error_n(&self) -> [f64; 2] {
        let (mut gap, mut greatest) = (0.0_f64, 0.0_f64);
        for (index, pair) in self.pairs.iter().enumerate().filter(|(_, pair)| pair.active) {
            let mine = self.touches.iter().enumerate().filter(|(_, touch)| touch.pair == index);
            let force: DVec3 = mine.map(|(place, _)| self.arrays.force_of(place)).sum();
            gap = gap.max(force.distance(pair.solved));
            greatest = greatest.max(force.length());
        }
        [gap, greatest]
    }
}

impl Shared for Touch {
    fn press(&self) -> Press {
        Press { place: self.place, normal: self.normal, depth: self.depth }
    }

    fn thing(&self) -> usize {
        self.part
    }

    fn number(&self) -> (usize, u64) {
        (self.pair, self.feature)
    }

    fn share(&mut self) -> &mut f64 {
        &mut self.share
    }
}

/// Push and friction on a body.
pub(crate) struct BodyForce {
    pair: usize,
    pub body: usize,
    /// From the body's place to where they act [m].
    pub arm: DVec3,
    pub force: DVec3,
    pub block: glam::DMat3,
}

/// The stored grip that a touch continues: the nearest on the part with almost the same normal.
fn kept_grip(grips: &BodyGrips, touch: &Touch, inward: DVec3) -> Option<usize> {
    let alike =
        grips.contacts.iter().enumerate().filter(|(_, grip)| {
            grip.part == touch.part && grip.normal.dot(touch.normal) > SAME_FACE
        });
    let nearest = alike.min_by(|(_, one), (_, other)| {
        one.place.distance(inward).total_cmp(&other.place.distance(inward))
    });
    nearest.map(|(place, _)| place)
}

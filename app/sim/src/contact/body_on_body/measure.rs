//! Touches of bodies at the trial, with normal force and friction.

use glam::DVec3;

use crate::contact::body_on_body::{BodyOnBody, Pair, STIFFNESS_N_M, Touch};
use crate::contact::law::barrier::BarrierForce;
use crate::contact::law::elastic_grip::{Grip, Push};
use crate::contact::law::patch_shares::{Press, Shared, share_out};
use crate::geometry::Pose;
use crate::matrix::outer;
use crate::state::{PairGrip, State};

/// Cosine of the angle to the line of least distance up to which faces lie along each other.
const ALONG: f64 = 0.99;
/// Two touches nearer to each other than this are one [m].
const SAME_PLACE_M: f64 = 1e-3;
/// Cosine of the angle of two normals above which a touch continues a stored one.
const SAME_FACE: f64 = 0.7;

impl BodyOnBody {
    /// Evaluates every touch with bodies in these poses; the error is two bodies whose cores meet.
    pub fn evaluate(
        &mut self,
        state: &State,
        poses: impl Iterator<Item = Pose>,
    ) -> Result<(), [usize; 2]> {
        self.measured.clear();
        self.measured.extend(poses.chain(self.still.iter().copied()));
        std::mem::swap(&mut self.touches, &mut self.touched);
        self.touches.clear();
        for index in 0..self.pairs.len() {
            self.find_touches(index)?;
        }
        self.share_out();
        for place in 0..self.touches.len() {
            self.press(state, place);
        }
        Ok(())
    }

    fn find_touches(&mut self, index: usize) -> Result<(), [usize; 2]> {
        let Pair { parts, bodies, forgiven_m, .. } = self.pairs[index];
        let [first, second] = parts.map(|part| &self.cores[part]);
        let [one, two] = bodies.map(|body| &self.measured[body]);
        let reach = first.reach + second.reach;
        let nearest = first.nearest_to(one, second, two).ok_or(bodies)?;
        let apart = nearest[0] - nearest[1];
        if apart.length() >= reach - forgiven_m {
            return Ok(());
        }
        self.places.clear();
        first.faces_along(one, (second, two), reach, &mut self.manifold, &mut self.places);
        // Where an edge or a corner is nearest, faces do not lie along each other.
        let is_along = |places: &[DVec3; 2]| {
            (places[0] - places[1]).normalize_or_zero().dot(apart) > ALONG * apart.length()
        };
        self.places.retain(|(_, places)| is_along(places));
        if self.places.is_empty() {
            let on_second = first.ends(one).map(|at| [at, second.nearest_to_place(two, at)]);
            let on_first = second.ends(two).map(|at| [first.nearest_to_place(one, at), at]);
            // The sides that two cylinders turn to each other, where a cylinder lies along what it touches.
            let side = first.side_towards(one, nearest[1]);
            let side = side.map(|at| [at, second.nearest_to_place(two, at)]);
            let is_body = bodies[1] < self.count;
            let others = is_body.then(|| second.side_towards(two, nearest[0]));
            let others = others.into_iter().flatten();
            let others = others.map(|at| [first.nearest_to_place(one, at), at]);
            let all = on_second.chain(on_first).chain([nearest]).chain(side).chain(others);
            self.places.extend((0..).zip(all));
        }
        let first_touch = self.touches.len();
        for (feature, [on_one, on_two]) in self.places.iter().copied() {
            let distance = on_one.distance(on_two);
            let depth = reach - forgiven_m - distance;
            if depth <= 0.0 || distance <= 0.0 {
                continue;
            }
            let normal = (on_one - on_two) / distance;
            let place = on_two + normal * second.reach;
            let mut before = self.touches[first_touch..].iter();
            if !before.any(|other| other.place.distance(place) < SAME_PLACE_M) {
                self.touches.push(Touch {
                    pair: index,
                    feature,
                    place,
                    normal,
                    depth,
                    share: 1.0,
                    force: DVec3::ZERO,
                    block: glam::DMat3::ZERO,
                    stretch: DVec3::ZERO,
                });
            }
        }
        Ok(())
    }

    fn share_out(&mut self) {
        let (mut touches, mut touched) =
            (std::mem::take(&mut self.touches), std::mem::take(&mut self.touched));
        share_out(&mut touches, &mut touched, self.shared, |pair| self.reach_of(pair));
        (self.touches, self.touched) = (touches, touched);
        self.shared += 1;
    }

    /// Contact distance of two parts [m].
    pub(crate) fn reach_of(&self, pair: usize) -> f64 {
        self.pairs[pair].parts.iter().map(|part| self.cores[*part].reach).sum()
    }

    /// Push and friction of a touch.
    fn press(&mut self, state: &State, place: usize) {
        let touch = self.touches[place];
        let Pair { bodies, forgiven_m, .. } = self.pairs[touch.pair];
        let (reach, stiffness) =
            (self.reach_of(touch.pair) - forgiven_m, STIFFNESS_N_M * touch.share);
        let push = BarrierForce::new(reach - touch.depth, reach, stiffness);
        let [one, two] = bodies.map(|body| {
            let began = self.began(state, body);
            touch.place - began.outward(self.measured[body].inward(touch.place))
        });
        let kept = self.kept_grip(&state.pair_grips, &touch);
        let orientation = self.measured[bodies[0]].orientation;
        let kept = kept.map_or(DVec3::ZERO, |grip| orientation * grip.stretch);
        let grip = Grip::new(
            kept + one - two,
            touch.normal,
            stiffness,
            self.friction_of(touch.pair),
            Push { force: push.force, rate: push.stiffness },
        );
        let touch = &mut self.touches[place];
        touch.force = touch.normal * push.force + grip.force;
        touch.block = outer(touch.normal, touch.normal) * push.stiffness + grip.block;
        touch.stretch = grip.kept;
    }

    /// The stored grip that a touch continues: the nearest on the first body with almost the same normal.
    fn kept_grip<'a>(&self, grips: &'a [PairGrip], touch: &Touch) -> Option<&'a PairGrip> {
        let Pair { parts, bodies, .. } = self.pairs[touch.pair];
        let pose = &self.measured[bodies[0]];
        let inward = pose.inward(touch.place);
        let mine = grips.iter().filter(|grip| {
            grip.parts == parts && (pose.orientation * grip.normal).dot(touch.normal) > SAME_FACE
        });
        mine.min_by(|one, other| {
            one.place.distance(inward).total_cmp(&other.place.distance(inward))
        })
    }

    /// Touches with push and friction on the first body, linear about where they were measured, the bodies having moved to poses since.
    pub fn forces_at<'a>(
        &'a self,
        pose: impl Fn(usize) -> Pose + 'a,
    ) -> impl Iterator<Item = PairForce> + 'a {
        self.touches.iter().map(move |touch| {
            let bodies = self.pairs[touch.pair].bodies;
            let now = bodies.map(|thing| self.pose(thing, &pose));
            let at = [0, 1].map(|k| now[k].outward(self.measured[bodies[k]].inward(touch.place)));
            let moved = at[0] - at[1];
            PairForce {
                bodies,
                arms: [at[0] - now[0].place, at[1] - now[1].place],
                force: touch.force - touch.block * moved,
                block: touch.block,
            }
        })
    }

    /// Stores normal force and friction of the last solution, for bodies that it moved to poses.
    pub fn store_solved(&mut self, pose: impl Fn(usize) -> Pose) {
        self.pairs.iter_mut().for_each(|pair| pair.solved = DVec3::ZERO);
        for place in 0..self.touches.len() {
            let touch = self.touches[place];
            let bodies = self.pairs[touch.pair].bodies;
            let now = bodies.map(|thing| self.pose(thing, &pose));
            let at = [0, 1].map(|k| now[k].outward(self.measured[bodies[k]].inward(touch.place)));
            self.pairs[touch.pair].solved += touch.force - touch.block * (at[0] - at[1]);
        }
    }

    /// Greatest difference between the forces at the trial and those of the last solution, and the greatest force [N].
    pub fn error_n(&self) -> [f64; 2] {
        let (mut gap, mut greatest) = (0.0_f64, 0.0_f64);
        for (index, pair) in self.pairs.iter().enumerate() {
            let mine = self.touches.iter().filter(|touch| touch.pair == index);
            let force: DVec3 = mine.map(|touch| touch.force).sum();
            gap = gap.max(force.distance(pair.solved));
            greatest = greatest.max(force.length());
        }
        [gap, greatest]
    }

    /// Stores the grips of an accepted step.
    pub fn store_grips(&self, grips: &mut Vec<PairGrip>) {
        grips.clear();
        for (index, pair) in self.pairs.iter().enumerate() {
            let [one, two] = pair.bodies.map(|body| &self.measured[body]);
            let [first, second] = pair.parts.map(|part| &self.cores[part]);
            let gap = first.nearest_to(one, second, two).map_or(0.0, |[a, b]| a.distance(b));
            let forgiven_m = pair.forgiven_m.min((self.reach_of(index) - gap).max(0.0));
            let mut any = false;
            for touch in self.touches.iter().filter(|touch| touch.pair == index) {
                let inward = one.orientation.inverse();
                grips.push(PairGrip {
                    parts: pair.parts,
                    place: one.inward(touch.place),
                    normal: inward * touch.normal,
                    stretch: inward * touch.stretch,
                    forgiven_m,
                });
                any = true;
            }
            if !any && forgiven_m > 0.0 {
                let (place, normal, stretch) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
                grips.push(PairGrip { parts: pair.parts, place, normal, stretch, forgiven_m });
            }
        }
    }
}

impl Shared for Touch {
    fn press(&self) -> Press {
        Press { place: self.place, normal: self.normal, depth: self.depth }
    }

    fn thing(&self) -> usize {
        self.pair
    }

    fn number(&self) -> (usize, u64) {
        (self.pair, self.feature)
    }

    fn share(&mut self) -> &mut f64 {
        &mut self.share
    }
}

/// Push and friction of two bodies, or of a body and an obstacle.
pub(crate) struct PairForce {
    pub bodies: [usize; 2],
    /// From each body's place to where they act [m].
    pub arms: [DVec3; 2],
    /// On the first body [N].
    pub force: DVec3,
    pub block: glam::DMat3,
}

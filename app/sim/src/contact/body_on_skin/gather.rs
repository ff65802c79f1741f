//! Which triangles of skin are near a body in a step of the model, and which may touch it in a solver step.

use glam::DAffine3;

use crate::contact::body_on_skin::{BodyOnSkin, NearPart, Pair};
use crate::geometry::Pose;
use crate::geometry::sweep::{SweptSegment, triangle_at};
use crate::model::Model;
use crate::state::{BodyState, State};
use crate::whale::Bounds;

/// How far beyond a body's contact distance and its move skin is gathered [m].
const MARGIN_M: f64 = 0.03;
/// Margin of the search of a solver step beyond the contact distance: factor on the expected move of body and skin, and a length [m].
const SEARCH_MOVES: f64 = 1.5;
const SEARCH_M: f64 = 1.5e-3;

impl BodyOnSkin {
    /// Gathers skin near bodies over a step of the model, of which a share has passed, by the poses and a box around all skin in it;
    /// whether there is any.
    pub fn gather(
        &mut self,
        model: &Model,
        state: &State,
        (bones, whole): ([&[DAffine3]; 2], &Bounds),
        passed: f64,
    ) -> bool {
        let left_s = model.spec.settings.step_s * (1.0 - passed);
        (self.start, self.goal, self.fraction) = (passed, 1.0, passed);
        self.near.clear();
        self.pairs.clear();
        self.touching = false;
        let mut begun = false;
        for part in 0..self.cores.len() {
            let body = self.cores[part].thing;
            let held_until_s = model.spec.bodies[body].held_until_s;
            let is_held = held_until_s.is_some_and(|until_s| state.time_s < until_s);
            let (path, search_m) = self.search_of(part, &state.bodies[body], left_s);
            if !is_held && whole.meets(&Bounds::around(&[path.a0, path.a1]).grown(search_m)) {
                if !begun {
                    self.surface.begin(bones[0], bones[1]);
                    begun = true;
                }
                self.surface.gather(&[path], search_m, &mut self.candidates);
                self.add_candidates(part, &state.bodies[body], left_s);
            }
        }
        self.is_near()
    }

    /// The path of a part's body, and the distance from it within which skin is searched for [m].
    fn search_of(&self, part: usize, now: &BodyState, left_s: f64) -> (SweptSegment, f64) {
        let radius = self.cores[part].radius;
        let (from, to) = (now.position, now.position + now.velocity * left_s);
        let path = SweptSegment { a0: from, b0: from, a1: to, b1: to };
        (path, radius + room_of(now, radius, left_s))
    }

    /// Adds a part of a body with the skin that was found near it, if any.
    fn add_candidates(&mut self, part: usize, now: &BodyState, left_s: f64) {
        if !self.candidates.is_empty() {
            let candidates = std::mem::take(&mut self.candidates);
            self.add_part(part, now, candidates.iter().map(|near| near.triangle), left_s);
            self.candidates = candidates;
        }
    }

    /// Adds a part of a body with those of the triangles that are near it.
    fn add_part(
        &mut self,
        part: usize,
        now: &BodyState,
        triangles: impl Iterator<Item = u32>,
        left_s: f64,
    ) {
        let core = &self.cores[part];
        let pose = Pose::of(now);
        let room = room_of(now, core.radius, left_s);
        let (first, mut skin_move) = (self.pairs.len(), 0.0_f64);
        for triangle in triangles {
            let sweep = self.surface.triangle_sweep(triangle);
            let moved =
                (0..3).map(|k| sweep[0][k].distance_squared(sweep[1][k])).fold(0.0, f64::max);
            let moved = moved.sqrt();
            skin_move = skin_move.max(moved);
            // Skin in which a body begins is ignored: no normal force leads out of it.
            let corners = triangle_at(&sweep, self.fraction);
            let Some(nearest) = core.nearest(&pose, corners) else { continue };
            if nearest.distance - moved <= core.reach + room {
                self.pairs.push(Pair {
                    triangle,
                    sweep,
                    gap: nearest.distance,
                    active: false,
                    solved: glam::DVec3::ZERO,
                });
            }
        }
        if self.pairs.len() > first {
            let pairs = first..self.pairs.len();
            let body = core.thing;
            self.near.push(NearPart { part, body, pairs, room, skin_move, moved: 0.0 });
        }
    }

    /// Moves skin to the end of a solver step of length `dt`, and finds the pairs that may touch; returns whether there are any.
    pub fn find_active_pairs(&mut self, state: &State, goal: f64, dt: f64) -> bool {
        (self.start, self.goal, self.shared) = (self.fraction, goal, 0);
        self.touching = false;
        self.touches.clear();
        for near in &self.near {
            let (body, core) = (&state.bodies[near.body], &self.cores[near.part]);
            let pose = Pose::of(body);
            let own_m = moves_m(body, core.radius, dt);
            for pair in &mut self.pairs[near.pairs.clone()] {
                let skin_m = near.skin_move * (goal - self.start);
                // Without sweeps only what is near at the start of the step is found.
                let moves = if self.swept { SEARCH_MOVES * (own_m + skin_m) } else { 0.0 };
                let look = core.reach + SEARCH_M + moves;
                if pair.gap <= look {
                    let corners = triangle_at(&pair.sweep, self.start);
                    pair.gap = core.nearest(&pose, corners).map_or(0.0, |nearest| nearest.distance);
                }
                pair.active = pair.gap <= look;
                pair.solved = glam::DVec3::ZERO;
                self.touching |= pair.active;
            }
        }
        self.touching
    }

    /// Returns to the start of a rejected solver step. Distances are invalidated: if the step was rejected for one pair, those before it
    /// belong to its end.
    pub fn go_back(&mut self) {
        self.fraction = self.start;
        self.pairs.iter_mut().for_each(|pair| pair.gap = 0.0);
    }
}

/// Bound of the move of a body's surface in a time with its present velocity [m].
pub(crate) fn moves_m(body: &BodyState, radius: f64, time_s: f64) -> f64 {
    (body.velocity.length() + body.spin.length() * radius) * time_s
}

/// Distance beyond the contact distance within which skin is gathered for a body [m].
fn room_of(body: &BodyState, radius: f64, time_s: f64) -> f64 {
    MARGIN_M + SEARCH_MOVES * moves_m(body, radius, time_s)
}

//! Which parts of bodies may touch each other in a solver step.

use crate::contact::body_on_body::{BodyOnBody, Pair};
use crate::contact::body_on_skin::gather::moves_m;
use crate::geometry::core::BodyCore;
use crate::state::State;

/// Margin of the search beyond the contact distance: factor on the expected move, and a length [m].
const SEARCH_MOVES: f64 = 1.5;
const SEARCH_M: f64 = 1.5e-3;

/// Two bodies whose blocks the linear system couples.
pub(crate) type Coupled = [usize; 2];

impl BodyOnBody {
    /// Finds the parts of bodies that may touch in a solver step of length `dt`; whether there are any.
    pub fn gather(&mut self, state: &State, dt: f64) -> bool {
        self.pairs.clear();
        self.touches.clear();
        (self.touching, self.shared, self.dt) = (false, 0, dt);
        let move_of = |core: &BodyCore| {
            let body = state.bodies.get(core.thing);
            body.map_or(0.0, |body| moves_m(body, core.radius, dt))
        };
        self.moves_m.clear();
        self.moves_m.extend(self.cores.iter().map(move_of));
        for first in 0..self.part_count {
            let seconds = if self.mutual { first + 1 } else { self.part_count };
            for second in seconds..self.cores.len() {
                if self.cores[first].thing != self.cores[second].thing {
                    self.search_pair(state, [first, second]);
                }
            }
        }
        self.touching = !self.pairs.is_empty();
        self.touching
    }

    fn search_pair(&mut self, state: &State, parts: [usize; 2]) {
        let [first, second] = parts.map(|part| &self.cores[part]);
        let bodies = [first.thing, second.thing];
        let [one, two] = bodies.map(|thing| self.began(state, thing));
        let moves = self.moves_m[parts[0]] + self.moves_m[parts[1]];
        let look = SEARCH_M + SEARCH_MOVES * moves;
        let within = first.radius + second.radius + look;
        if one.place.distance_squared(two.place) > within * within {
            return;
        }
        // Bodies whose cores meet as they are placed are ignored: no normal force would separate them.
        let Some([a, b]) = first.nearest_to(&one, second, &two) else { return };
        let gap = a.distance(b);
        let depth = first.reach + second.reach - gap;
        if depth < -look {
            return;
        }
        // An overlap at the start of the run is allowed; a later one is not.
        let mut kept = state.pair_grips.iter().filter(|grip| grip.parts == parts);
        let as_placed = if state.time_s <= 0.0 { depth.max(0.0) } else { 0.0 };
        let forgiven_m = kept.next().map_or(as_placed, |grip| grip.forgiven_m);
        debug_assert!(parts[0] < parts[1], "parts in rising order: {parts:?}");
        self.pairs.push(Pair { parts, bodies, gap, forgiven_m, solved: glam::DVec3::ZERO });
    }

    /// The bodies that are coupled in this solver step, each two once.
    pub fn coupled(&self) -> impl Iterator<Item = Coupled> {
        let is_first = |place: usize, bodies: Coupled| {
            self.pairs[..place].iter().all(|before| before.bodies != bodies)
        };
        let pairs = self.pairs.iter().map(|pair| pair.bodies).enumerate();
        pairs
            .filter(move |(place, bodies)| bodies[1] < self.count && is_first(*place, *bodies))
            .map(|(_, bodies)| bodies)
    }
}

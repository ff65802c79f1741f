//! Wraps: how far the centre line of rope turns about the axis of a part, loose loops included.
//!
//! A *wrap* is a stretch of whole rope within a part's neighbourhood: between the planes across its axis at the part's two
//! ends, and within `hypot(u / (a + c), v / (b + c)) <= 1` of it, `u, v` the place across the posed axis, `a, b` the half
//! widths of the section there, `c` [`LOOSE_M`]. With `S` the angle that the rope sweeps about the axis from where it comes
//! in to where it leaves (straight lines between nodes), and at both ends the straight ray in which it would go on,
//!
//! ```text
//! W = max(0, |S| / 2 pi + sum over both ends of w (asin(q) / 2 pi - 1/4)),   q = r x t, w = min(1, 2 |t across|)
//! ```
//!
//! `r` is the unit vector across from the axis to that end, `t` the rope's direction across the axis there, in the sense
//! of the sweep. Drawn on for ever both ways, rope that passes straight by sweeps half a turn: that half is taken off, a
//! quarter at each end. So a straight rope counts 0 wherever it is cut off, `n` turns on a cylinder that leave it
//! straight on count `n`, and a bend by `a` round a part counts `a / 2 pi`; `w` lets rope that leaves along the axis count
//! as it swept. Nothing in it depends on which pieces touch or on how rope is cut into segments, and nothing jumps as
//! rope comes into the neighbourhood, goes out of it or slides along. Definitions and reasons: `docs/entanglement.md`.

use std::f64::consts::TAU;

use endline_sdk::BodyPart;
use glam::{DAffine3, DVec3};

use super::outcome::LOST_S;
use super::winding::between;
use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::{State, WhaleState};
use crate::strands::Strands;
use crate::whale::axes::{Axis, PosedAxis, Spot, axes_of};
use crate::whale::{Skin, pose};

/// Rope farther than this from the box of a part's section is not about the part [m]; estimate.
pub const LOOSE_M: f64 = 0.5;

/// Halvings that find where a segment comes into a neighbourhood.
const HALVINGS: usize = 30;

const PARTS: usize = BodyPart::ALL.len();

/// Wraps of rope about every part.
#[derive(Clone, Debug)]
pub(super) struct WrapMeter {
    axes: [Option<Axis>; PARTS],
    posed: PosedAxis,
    bones: Vec<DAffine3>,
    /// When each strand last pressed on each part [s].
    last_s: Vec<[Option<f64>; PARTS]>,
    /// Turns about each part now, with their sign: those of the strand that has most [turns].
    pub(super) turns: [f64; PARTS],
    /// How many wraps each part has.
    counts: [usize; PARTS],
    /// Steps in which turns jumped though the number of wraps stayed.
    pub(super) jumps: u64,
}

/// A wrap as far as it has been walked.
#[derive(Clone, Copy, Debug)]
struct Wrap {
    swept: f64,
    at: f64,
    begin: End,
    end: End,
}

/// Where a wrap begins or ends: `asin(q)`, in the sense of growing azimuth [rad], and `w`.
#[derive(Clone, Copy, Debug)]
struct End {
    lead: f64,
    weight: f64,
}

/// A part's neighbourhood under a pose.
struct Neighbourhood<'a> {
    axis: &'a PosedAxis,
    reach_m: [f64; 2],
    ball: (DVec3, f64),
}

impl WrapMeter {
    pub(super) fn new(skin: &Skin, strands: &Strands) -> Self {
        Self {
            axes: axes_of(skin),
            posed: PosedAxis::default(),
            bones: Vec::with_capacity(skin.bones.len()),
            last_s: vec![[None; PARTS]; strands.lists().len()],
            turns: [0.0; PARTS],
            counts: [0; PARTS],
            jumps: 0,
        }
    }

    /// Measures the wraps of all strands that press on a part, or did less than [`LOST_S`] ago.
    pub(super) fn fold(
        &mut self,
        model: &Model,
        state: &State,
        whale: &WhaleState,
        strands: &Strands,
        contacts: &[ContactPoint],
    ) {
        self.take_contacts(state.time_s, strands, contacts);
        let (before, counts) = (self.turns, self.counts);
        (self.turns, self.counts) = ([0.0; PARTS], [0; PARTS]);
        let free = |last: &Option<f64>| last.is_none_or(|last| state.time_s - last >= LOST_S);
        if self.last_s.iter().flatten().all(free) {
            return;
        }
        let Some(own) = &model.spec.whale else { return };
        pose(&own.skin, whale.position, whale.orientation, &whale.posture, &mut self.bones);
        for part in 0..PARTS {
            if self.last_s.iter().any(|last| !free(&last[part])) {
                self.measure(model, state, strands, part);
            }
        }
        let jumped = |part: usize| {
            let same = counts[part] > 0 && counts[part] == self.counts[part];
            same && libm::fabs(self.turns[part] - before[part]) > super::winding::WINDING_JUMP
        };
        self.jumps += u64::from((0..PARTS).any(jumped));
    }

    /// The most turns about any part now.
    pub(super) fn most(&self) -> f64 {
        self.turns.iter().fold(0.0, |most, turns| libm::fabs(*turns).max(most))
    }

    fn take_contacts(&mut self, time_s: f64, strands: &Strands, contacts: &[ContactPoint]) {
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let part = contact.region.part() as usize;
            self.last_s[strands.places[contact.segment].strand][part] = Some(time_s);
        }
    }

    /// The wraps about one part: those of a strand that turn the same way add up, and the strand that has most counts.
    fn measure(&mut self, model: &Model, state: &State, strands: &Strands, part: usize) {
        let Some(axis) = &self.axes[part] else { return };
        axis.pose(&self.bones, &mut self.posed);
        let near =
            Neighbourhood { axis: &self.posed, reach_m: axis.reach_m, ball: self.posed.ball() };
        for (strand, segments) in strands.lists().iter().enumerate() {
            if self.last_s[strand][part].is_none_or(|last| state.time_s - last >= LOST_S) {
                continue;
            }
            let wraps = near.wraps(model, state, strands, segments);
            self.counts[part] += wraps.len();
            let sum =
                |sense: f64| wraps.iter().map(|wrap| (sense * wrap.turns()).max(0.0)).sum::<f64>();
            let (one, other) = (sum(1.0), sum(-1.0));
            let turns = if one >= other { one } else { -other };
            if libm::fabs(turns) > libm::fabs(self.turns[part]) {
                self.turns[part] = turns;
            }
        }
    }
}

impl Neighbourhood<'_> {
    /// All wraps of a strand, in its order.
    fn wraps(
        &self,
        model: &Model,
        state: &State,
        strands: &Strands,
        segments: &[usize],
    ) -> Vec<Wrap> {
        let (mut wraps, mut open) = (Vec::new(), None::<Wrap>);
        let mut known: Option<(DVec3, Option<Spot>)> = None;
        for &segment in segments {
            if state.rope.cut[segment] {
                wraps.extend(open.take());
                continue;
            }
            let [from, to] = ends_of(model, state, strands, segment);
            let starts = match known {
                Some((place, spot)) if place == from => spot,
                _ => self.look(from),
            };
            let stops = self.look(to);
            known = Some((to, stops));
            if starts.is_none() && stops.is_none() {
                continue;
            }
            let way = (to - from).normalize_or_zero();
            let (enters, leaves) =
                (starts.or_else(|| self.edge(to, from)), stops.or_else(|| self.edge(from, to)));
            let (Some(enters), Some(leaves)) = (enters, leaves) else { continue };
            let mut wrap = open
                .take()
                .filter(|_| starts.is_some())
                .unwrap_or_else(|| Wrap::begin(&enters, way));
            wrap.go(&leaves, way);
            if stops.is_some() { open = Some(wrap) } else { wraps.push(wrap) }
        }
        wraps.extend(open);
        wraps
    }

    /// A place as seen from the axis, where it is in the neighbourhood.
    fn look(&self, place: DVec3) -> Option<Spot> {
        let (middle, radius) = self.ball;
        if place.distance(middle) > radius + LOOSE_M {
            return None;
        }
        let spot = self.axis.see(place)?;
        let [u, v] = [0, 1].map(|k| spot.at_m[k] / (spot.half_m[k] + LOOSE_M));
        (spot.along_m >= self.reach_m[0]
            && spot.along_m <= self.reach_m[1]
            && libm::hypot(u, v) <= 1.0)
            .then_some(spot)
    }

    /// The last place in the neighbourhood on the way from a place in it to one that is not.
    fn edge(&self, within: DVec3, beyond: DVec3) -> Option<Spot> {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.look(within.lerp(beyond, middle)).is_some() {
                low = middle
            } else {
                high = middle
            }
        }
        self.look(within.lerp(beyond, low))
    }
}

impl Wrap {
    fn begin(spot: &Spot, way: DVec3) -> Self {
        let end = End::of(spot, way);
        Self { swept: 0.0, at: spot.azimuth(), begin: end, end }
    }

    fn go(&mut self, to: &Spot, way: DVec3) {
        let azimuth = to.azimuth();
        self.swept += between(self.at, azimuth);
        (self.at, self.end) = (azimuth, End::of(to, way));
    }

    /// Turns, with the sign of the sweep.
    fn turns(&self) -> f64 {
        let counted = |sense: f64| {
            let end = |end: &End| end.weight * (sense * end.lead / TAU - 0.25);
            sense * self.swept / TAU + end(&self.begin) + end(&self.end)
        };
        let (one, other) = (counted(1.0), counted(-1.0));
        if one >= other { one.max(0.0) } else { -other.max(0.0) }
    }
}

impl End {
    fn of(spot: &Spot, way: DVec3) -> Self {
        let [x, y] = spot.across.map(|direction| way.dot(direction));
        let (across, out) = (libm::hypot(x, y), libm::hypot(spot.at_m[0], spot.at_m[1]));
        let turn = spot.at_m[0] * y - spot.at_m[1] * x;
        let sine = if across * out > 0.0 { (turn / (across * out)).clamp(-1.0, 1.0) } else { 0.0 };
        Self { lead: libm::asin(sine), weight: (2.0 * across).min(1.0) }
    }
}

/// The two ends of a segment in the order of its strand.
pub(super) fn ends_of(
    model: &Model,
    state: &State,
    strands: &Strands,
    segment: usize,
) -> [DVec3; 2] {
    let line = model.segment_line[segment];
    let node = model.line_nodes[line].start + segment - model.line_segments[line].start;
    let ends = [state.rope.position[node], state.rope.position[node + 1]];
    if strands.places[segment].reversed { [ends[1], ends[0]] } else { ends }
}

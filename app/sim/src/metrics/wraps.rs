//! Wraps: turns of the centre line of rope about the axis of a part, including loose loops.
//!
//! A *wrap* is a continuous length of uncut rope within the neighbourhood of a part. The neighbourhood is between the planes
//! across the axis at the two ends of the part, and within `hypot(u / (a + c), v / (b + c)) <= 1` of it, with `u, v` the
//! coordinates across the posed axis, `a, b` the half widths of the section, and `c` = [`LOOSE_M`] [m]. With `S` the angle that
//! the rope sweeps about the axis between entry and exit (straight between nodes) [rad], and a straight extension at both ends,
//!
//! ```text
//! W = max(0, |S| / 2 pi + sum over both ends of w (asin(q) / 2 pi - 1/4)),   q = r x t, w = min(1, 2 |t across|)
//! ```
//!
//! in turns. `r` is the transverse unit vector from the axis to that end, and `t` the transverse direction of rope there, in
//! the sense of the sweep. A straight rope, extended to infinity both ways, sweeps half a turn, which is subtracted, a quarter
//! at each end. A straight rope therefore counts 0 wherever it is cut off, `n` turns on a cylinder with straight ends count
//! `n`, and a bend by `a` round a part counts `a / 2 pi`. `w` lets rope that leaves along the axis count by its sweep. The
//! result does not depend on which segments touch or on the segment lengths, and it is continuous when rope enters the
//! neighbourhood, leaves it or slides along. Definitions and reasons: `docs/entanglement.md`.

use std::f64::consts::TAU;

use endline_sdk::BodyPart;
use glam::{DAffine3, DVec3};

use super::events::LOST_S;
use super::winding::between;
use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::{State, WhaleState};
use crate::strands::Strands;
use crate::whale::axes::{Axis, PosedAxis, Spot, axes_of};
use crate::whale::{Skin, pose};

/// Greatest distance of rope about a part from the box of its section; estimate [m].
pub const LOOSE_M: f64 = 0.5;

/// Bisections to find where a segment enters a neighbourhood.
const HALVINGS: usize = 30;

const PARTS: usize = BodyPart::ALL.len();

/// Wraps of rope about every part.
#[derive(Clone, Debug)]
pub(super) struct WrapMeter {
    axes: [Option<Axis>; PARTS],
    posed: PosedAxis,
    bones: Vec<DAffine3>,
    /// Time of the last contact of each strand with each part [s].
    last_s: Vec<[Option<f64>; PARTS]>,
    /// Turns about each part now, signed: those of the strand with the greatest [turns].
    pub(super) turns: [f64; PARTS],
    /// Number of wraps of each part.
    counts: [usize; PARTS],
    /// Number of steps in which turns jumped at a constant number of wraps.
    pub(super) jumps: u64,
}

/// A wrap in progress.
#[derive(Clone, Copy, Debug)]
struct Wrap {
    swept: f64,
    at: f64,
    begin: End,
    end: End,
}

/// An end of a wrap: `asin(q)`, in the sense of increasing azimuth [rad], and `w`.
#[derive(Clone, Copy, Debug)]
struct End {
    lead: f64,
    weight: f64,
}

/// Neighbourhood of a part under a pose.
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

    /// Measures the wraps of all strands in contact with a part within the last [`LOST_S`].
    pub(super) fn fold(
        &mut self,
        model: &Model,
        state: &State,
        whale: &WhaleState,
        strands: &Strands,
        contacts: &[ContactPoint],
    ) {
        self.record_contacts(state.time_s, strands, contacts);
        let (before, counts) = (self.turns, self.counts);
        (self.turns, self.counts) = ([0.0; PARTS], [0; PARTS]);
        let free = |last: &Option<f64>| last.is_none_or(|last| state.time_s - last >= LOST_S);
        if self.last_s.iter().flatten().all(free) {
            return;
        }
        let Some(own) = &model.spec.whale else {
            debug_assert!(false, "wraps are measured on a model with a whale");
            return;
        };
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

    /// Greatest turns about any part now.
    pub(super) fn most(&self) -> f64 {
        self.turns.iter().fold(0.0, |most, turns| libm::fabs(*turns).max(most))
    }

    /// Records the contacts of a step.
    fn record_contacts(&mut self, time_s: f64, strands: &Strands, contacts: &[ContactPoint]) {
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let part = contact.region.part() as usize;
            self.last_s[strands.places[contact.segment].strand][part] = Some(time_s);
        }
    }

    /// Measures the wraps about one part: the sum of a strand's wraps of the same sense, for the strand with the greatest sum.
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
    /// Wraps of a strand, in order.
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
                _ => self.locate(from),
            };
            let stops = self.locate(to);
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
            wrap.extend(&leaves, way);
            if stops.is_some() { open = Some(wrap) } else { wraps.push(wrap) }
        }
        wraps.extend(open);
        wraps
    }

    /// Position relative to the axis; `None` outside the neighbourhood.
    fn locate(&self, place: DVec3) -> Option<Spot> {
        let (middle, radius) = self.ball;
        if place.distance(middle) > radius + LOOSE_M {
            return None;
        }
        let spot = self.axis.locate(place)?;
        let [u, v] = [0, 1].map(|k| spot.at_m[k] / (spot.half_m[k] + LOOSE_M));
        (spot.along_m >= self.reach_m[0]
            && spot.along_m <= self.reach_m[1]
            && libm::hypot(u, v) <= 1.0)
            .then_some(spot)
    }

    /// Last position in the neighbourhood on the line from a position in it to one outside.
    fn edge(&self, within: DVec3, beyond: DVec3) -> Option<Spot> {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.locate(within.lerp(beyond, middle)).is_some() {
                low = middle
            } else {
                high = middle
            }
        }
        self.locate(within.lerp(beyond, low))
    }
}

impl Wrap {
    /// Starts a wrap.
    fn begin(spot: &Spot, way: DVec3) -> Self {
        let end = End::of(spot, way);
        Self { swept: 0.0, at: spot.azimuth(), begin: end, end }
    }

    /// Extends a wrap to a position.
    fn extend(&mut self, to: &Spot, way: DVec3) {
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

/// Ends of a segment, in the order of its strand.
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

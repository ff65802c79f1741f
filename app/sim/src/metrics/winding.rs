//! Winding of rope in contact about the axis of a part, from contact to contact, and twist of the two legs of a bight.
//!
//! Winding is the sum of azimuth differences between consecutive contacts of a run on one part, over `2 pi` [turns]. A run ends
//! at a gap of more than [`BRIDGED_GAP_M`] or at a cut.
//!
//! A strand *lies across* a part where such a run turns by [`LEAST_ACROSS`] to one turn about its axis: from one flank over the back to
//! the other, but not round. For this count a run ends at a gap of more than [`ACROSS_GAP_M`] only, so that rope round a part with
//! some slack is one run. Rope inside the mouth does not count.
//!
//! The *legs* of a strand are its rope beyond the outermost segments in contact, to either end or to the first cut. Both are
//! followed from the whale outwards at the same level: at each step the leg that lags along the mean direction `t` of the two
//! advances. Where the legs are side by side, the vector `u` from one to the other rotates about `t`, and the twist is the sum
//! of these rotations [turns]:
//!
//! ```text
//! twist = sum of atan2(t . (u x u'), u . u' - (u . t)(u' . t)) / 2 pi
//! ```
//!
//! It is positive for right-handed legs, in either order. Definitions and reasons: `docs/entanglement.md`.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use endline_sdk::BodyPart;
use glam::DVec3;

use super::events::LOST_S;
use super::wraps::ends_of;
use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::{RopeState, State};
use crate::strands::{Place, Strands};
use crate::whale::Skin;
use crate::whale::axes::{Axis, axes_of};

/// Greatest gap within a run of contacts; estimate [m].
pub const BRIDGED_GAP_M: f64 = 0.3;

/// Turns from which rope lies across a part rather than along it; estimate [turns].
pub const LEAST_ACROSS: f64 = 0.125;

/// Greatest gap between two contacts of a strand that lies across a part; estimate [m].
pub const ACROSS_GAP_M: f64 = 2.0;

/// Change of winding in one step that raises the alarm; estimate [turns].
pub const WINDING_JUMP: f64 = 0.3;

const PARTS: usize = BodyPart::ALL.len();

/// Winding of rope in contact about every part.
#[derive(Clone, Debug)]
pub(super) struct Winding {
    axes: [Option<Axis>; PARTS],
    /// Triangles inside the mouth.
    inside: Arc<[bool]>,
    pub(super) strands: Strands,
    sites: Vec<Site>,
    open: [Option<Run>; PARTS],
    /// Greatest winding of rope in contact about each part now, signed [turns].
    pub(super) turns: [f64; PARTS],
    /// Number of strands that lie across each part now without a turn.
    pub(super) across: [usize; PARTS],
    runs: [usize; PARTS],
    /// Number of steps in which a winding jumped along unbroken contact.
    pub(super) jumps: u64,
}

/// A contact of rope and its position along its strand.
#[derive(Clone, Copy, Debug)]
struct Site {
    place: Place,
    arc_m: f64,
    half_m: f64,
    part: usize,
    azimuth: f64,
    in_mouth: bool,
}

/// A run of contacts on one part.
#[derive(Clone, Copy, Debug)]
struct Run {
    first: Site,
    last: Site,
    turned: f64,
}

impl Winding {
    pub(super) fn new(skin: &Skin, inside: Arc<[bool]>, strands: Strands) -> Self {
        Self {
            axes: axes_of(skin),
            inside,
            strands,
            sites: Vec::with_capacity(1024),
            open: [None; PARTS],
            turns: [0.0; PARTS],
            across: [0; PARTS],
            runs: [0; PARTS],
            jumps: 0,
        }
    }

    /// Measures the winding of all contacts with a normal force.
    pub(super) fn fold(&mut self, skin: &Skin, contacts: &[ContactPoint], rope: &RopeState) {
        self.strands.measure(&rope.segment_length);
        self.gather(skin, contacts);
        let (before, runs_before) = (self.turns, self.runs);
        (self.turns, self.runs) = ([0.0; PARTS], [0; PARTS]);
        for index in 0..self.sites.len() {
            self.add(self.sites[index], &rope.cut);
        }
        for part in 0..PARTS {
            self.close(part);
        }
        self.across = self.count_across(&rope.cut);
        let jumped = |part: usize| {
            let unbroken = runs_before[part] > 0 && runs_before[part] == self.runs[part];
            unbroken && libm::fabs(self.turns[part] - before[part]) > WINDING_JUMP
        };
        self.jumps += u64::from((0..PARTS).any(jumped));
    }

    /// Greatest turns about any part now.
    pub(super) fn most(&self) -> f64 {
        self.turns.iter().fold(0.0, |most, turns| libm::fabs(*turns).max(most))
    }

    /// Sorts the contacts along their strands, each with its azimuth in the rest posture.
    fn gather(&mut self, skin: &Skin, contacts: &[ContactPoint]) {
        self.sites.clear();
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let part = contact.region.part() as usize;
            let corners =
                skin.triangles[contact.triangle].map(|vertex| skin.vertices[vertex as usize]);
            let [a, b, c] = contact.barycentric;
            debug_assert!((a + b + c - 1.0).abs() < 1e-6, "barycentric coordinates sum to 1");
            let rest = corners[0] * a + corners[1] * b + corners[2] * c;
            if let Some(azimuth) = self.axes[part].as_ref().and_then(|axis| axis.azimuth(rest)) {
                let place = self.strands.places[contact.segment];
                let arc_m = place.arc_at(contact.fraction);
                self.sites.push(Site {
                    place,
                    arc_m,
                    half_m: 0.5 * contact.length_m,
                    part,
                    azimuth,
                    in_mouth: self.inside[contact.triangle],
                });
            }
        }
        self.sites.sort_unstable_by(|a, b| {
            let along = a
                .place
                .strand
                .cmp(&b.place.strand)
                .then(a.place.order.cmp(&b.place.order))
                .then(a.arc_m.total_cmp(&b.arc_m));
            along.then(a.part.cmp(&b.part)).then(a.azimuth.total_cmp(&b.azimuth))
        });
    }

    /// Number of strands that lie across each part without a turn.
    fn count_across(&self, cut: &[bool]) -> [usize; PARTS] {
        let (mut across, mut open) = ([0; PARTS], [None::<Run>; PARTS]);
        let mut close = |run: Run| {
            let turns = libm::fabs(run.turns());
            across[run.first.part] += usize::from((LEAST_ACROSS..1.0).contains(&turns));
        };
        for site in self.sites.iter().filter(|site| !site.in_mouth) {
            let before = open[site.part].take();
            let joins = before.filter(|run| self.joins(run, site, ACROSS_GAP_M, cut));
            open[site.part] = Some(match joins {
                Some(run) => run.onward(*site),
                None => {
                    before.into_iter().for_each(&mut close);
                    Run { first: *site, last: *site, turned: 0.0 }
                }
            });
        }
        open.into_iter().flatten().for_each(close);
        across
    }

    /// Whether a site continues a run across a gap of at most `gap_m`.
    fn joins(&self, run: &Run, site: &Site, gap_m: f64, cut: &[bool]) -> bool {
        let gap = site.arc_m - run.last.arc_m - site.half_m - run.last.half_m;
        let same = site.place.strand == run.last.place.strand;
        same && gap <= gap_m && self.strands.whole(&run.last.place, &site.place, cut)
    }

    /// Adds a site to the run of its part, or closes that run and starts another.
    fn add(&mut self, site: Site, cut: &[bool]) {
        let joins = |run: &Run| self.joins(run, &site, BRIDGED_GAP_M, cut);
        match self.open[site.part].filter(joins) {
            Some(run) => self.open[site.part] = Some(run.onward(site)),
            None => {
                self.close(site.part);
                self.open[site.part] = Some(Run { first: site, last: site, turned: 0.0 });
            }
        }
    }

    /// Closes the run of a part.
    fn close(&mut self, part: usize) {
        if let Some(run) = self.open[part].take() {
            self.runs[part] += 1;
            let turns = run.turns();
            if libm::fabs(turns) > libm::fabs(self.turns[part]) {
                self.turns[part] = turns;
            }
        }
    }
}

impl Run {
    /// The run with a further site.
    fn onward(&self, site: Site) -> Self {
        let turned = self.turned + between(self.last.azimuth, site.azimuth);
        Self { last: site, turned, ..*self }
    }

    /// Turns of the whole run, including half of the length of the first and last site beyond them. That rope is assumed to
    /// turn at the mean rate of the run, by at most the measured turns.
    fn turns(&self) -> f64 {
        let span = self.last.arc_m - self.first.arc_m;
        let beyond = self.first.half_m + self.last.half_m;
        let factor = if span > beyond { 1.0 + beyond / span } else { 2.0 };
        self.turned * factor / TAU
    }
}

/// Difference of two azimuths, in (-π, π] [rad].
pub(super) fn between(from: f64, to: f64) -> f64 {
    let turn = to - from;
    if turn > PI {
        turn - TAU
    } else if turn <= -PI {
        turn + TAU
    } else {
        turn
    }
}

/// Distance above which legs are not side by side; estimate [m].
pub const BESIDE_M: f64 = 0.5;

/// Twists of the legs of every strand.
#[derive(Clone, Debug)]
pub(super) struct TwistMeter {
    strands: Vec<Twist>,
}

/// Twist of a strand's legs, and their start.
#[derive(Clone, Copy, Debug, Default)]
struct Twist {
    span: Option<Span>,
    turns: f64,
    peak_turns: f64,
}

/// Outermost segments of a strand at its last contact.
#[derive(Clone, Copy, Debug)]
struct Span {
    first: usize,
    last: usize,
    time_s: f64,
}

impl TwistMeter {
    pub(super) fn new(strands: &Strands) -> Self {
        Self { strands: vec![Twist::default(); strands.lists().len()] }
    }

    /// Measures the legs of all strands in contact with the whale within the last [`LOST_S`].
    pub(super) fn fold(
        &mut self,
        model: &Model,
        state: &State,
        strands: &Strands,
        contacts: &[ContactPoint],
    ) {
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let place = strands.places[contact.segment];
            self.strands[place.strand].add(place.order, state.time_s);
        }
        for (twist, segments) in self.strands.iter_mut().zip(strands.lists()) {
            twist.span = twist.span.filter(|span| state.time_s - span.time_s < LOST_S);
            let rope = Rope { model, state, strands, segments };
            twist.turns = twist.span.map_or(0.0, |span| rope.twist(&span));
            if twist.turns.abs() > twist.peak_turns.abs() {
                twist.peak_turns = twist.turns;
            }
        }
    }

    /// Twist of the legs of a strand, current and greatest, signed [turns].
    pub(super) fn of(&self, strand: usize) -> [f64; 2] {
        self.strands.get(strand).map_or([0.0; 2], |twist| [twist.turns, twist.peak_turns])
    }
}

impl Twist {
    /// Adds a segment in contact.
    fn add(&mut self, order: usize, time_s: f64) {
        let now = self.span.filter(|span| span.time_s.total_cmp(&time_s).is_eq());
        let (first, last) = now.map_or((order, order), |span| (span.first, span.last));
        self.span = Some(Span { first: first.min(order), last: last.max(order), time_s });
    }
}

/// A strand in a state.
struct Rope<'a> {
    model: &'a Model,
    state: &'a State,
    strands: &'a Strands,
    segments: &'a [usize],
}

/// A position on a leg, between `here` and `to`, the outer end of segment `order`.
#[derive(Clone, Copy)]
struct Leg {
    order: usize,
    onward: bool,
    here: DVec3,
    to: DVec3,
}

impl Rope<'_> {
    /// Twist of the legs beyond a span [turns].
    fn twist(&self, span: &Span) -> f64 {
        let (Some(mut one), Some(mut other)) =
            (self.leg(span.first.checked_sub(1), false), self.leg(span.last.checked_add(1), true))
        else {
            return 0.0;
        };
        let (mut turned, mut apart) = (0.0, other.here - one.here);
        loop {
            let (way, other_way) = (one.way(), other.way());
            let along = (way + other_way).normalize_or_zero();
            let behind = if apart.dot(along) > 0.0 { &mut one } else { &mut other };
            let Some(next) = self.advance(*behind) else { break };
            *behind = next;
            let now = other.here - one.here;
            if way.dot(other_way) > 0.0 && apart.length().max(now.length()) < BESIDE_M {
                turned += turn(apart, now, along);
            }
            apart = now;
        }
        turned / TAU
    }

    /// Leg from a segment to the end (`onward`) or the start of the strand; `None` if the segment does not exist or is cut.
    fn leg(&self, order: Option<usize>, onward: bool) -> Option<Leg> {
        let order = order?;
        let segment = *self.segments.get(order)?;
        let [from, to] = ends_of(self.model, self.state, self.strands, segment);
        let [here, to] = if onward { [from, to] } else { [to, from] };
        (!self.state.rope.cut[segment]).then_some(Leg { order, onward, here, to })
    }

    /// Advances a leg to the outer end of its segment; `None` at its end.
    fn advance(&self, leg: Leg) -> Option<Leg> {
        let next = if leg.onward { leg.order.checked_add(1) } else { leg.order.checked_sub(1) };
        let end = (leg.here != leg.to).then_some(Leg { here: leg.to, ..leg });
        self.leg(next, leg.onward).filter(|_| end.is_some()).or(end)
    }
}

impl Leg {
    fn way(&self) -> DVec3 {
        (self.to - self.here).normalize_or_zero()
    }
}

/// Angle about a unit vector from one vector to another, in (-pi, pi] [rad].
fn turn(from: DVec3, to: DVec3, about: DVec3) -> f64 {
    let across = from.dot(to) - from.dot(about) * to.dot(about);
    libm::atan2(about.dot(from.cross(to)), across)
}

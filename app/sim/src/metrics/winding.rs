//! Touching wraps: how far rope that touches turns about the axis of the part it touches, from contact to contact.

use std::f64::consts::{PI, TAU};

use endline_sdk::BodyPart;

use crate::contact::ContactPoint;
use crate::state::RopeState;
use crate::strands::{Place, Strands};
use crate::whale::Skin;
use crate::whale::axes::{Axis, axes_of};

/// Rope out of contact up to this length does not end a run of contacts [m]; estimate.
pub const BRIDGED_GAP_M: f64 = 0.3;

/// A change of winding in one step that raises the alarm [turns]; estimate.
pub const WINDING_JUMP: f64 = 0.3;

const PARTS: usize = BodyPart::ALL.len();

/// Winding of rope about every part.
#[derive(Clone, Debug)]
pub(super) struct Winding {
    axes: [Option<Axis>; PARTS],
    pub(super) strands: Strands,
    sites: Vec<Site>,
    open: [Option<Run>; PARTS],
    /// The longest winding of touching rope about each part now, with its sign [turns].
    pub(super) turns: [f64; PARTS],
    runs: [usize; PARTS],
    /// Steps in which a winding jumped along unbroken contact.
    pub(super) jumps: u64,
}

/// A touching point of rope, placed along its strand.
#[derive(Clone, Copy, Debug)]
struct Site {
    place: Place,
    arc_m: f64,
    half_m: f64,
    part: usize,
    azimuth: f64,
}

/// A run of contacts on one part, as far as it has been walked.
#[derive(Clone, Copy, Debug)]
struct Run {
    first: Site,
    last: Site,
    turned: f64,
}

impl Winding {
    pub(super) fn new(skin: &Skin, strands: Strands) -> Self {
        Self {
            axes: axes_of(skin),
            strands,
            sites: Vec::with_capacity(1024),
            open: [None; PARTS],
            turns: [0.0; PARTS],
            runs: [0; PARTS],
            jumps: 0,
        }
    }

    /// Measures the winding of the contacts that press.
    pub(super) fn fold(&mut self, skin: &Skin, contacts: &[ContactPoint], rope: &RopeState) {
        self.strands.measure(&rope.segment_length);
        self.gather(skin, contacts);
        let (before, runs_before) = (self.turns, self.runs);
        (self.turns, self.runs) = ([0.0; PARTS], [0; PARTS]);
        for index in 0..self.sites.len() {
            self.walk(self.sites[index], &rope.cut);
        }
        for part in 0..PARTS {
            self.close(part);
        }
        let jumped = |part: usize| {
            let unbroken = runs_before[part] > 0 && runs_before[part] == self.runs[part];
            unbroken && libm::fabs(self.turns[part] - before[part]) > WINDING_JUMP
        };
        self.jumps += u64::from((0..PARTS).any(jumped));
    }

    /// The most turns about any part now.
    pub(super) fn most(&self) -> f64 {
        self.turns.iter().fold(0.0, |most, turns| libm::fabs(*turns).max(most))
    }

    /// Sorts the pressing contacts along their strands, each with its azimuth in the rest posture.
    fn gather(&mut self, skin: &Skin, contacts: &[ContactPoint]) {
        self.sites.clear();
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let part = contact.region.part() as usize;
            let corners =
                skin.triangles[contact.triangle].map(|vertex| skin.vertices[vertex as usize]);
            let [a, b, c] = contact.barycentric;
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

    /// Adds a site to the run of its part, or closes that run and starts another.
    fn walk(&mut self, site: Site, cut: &[bool]) {
        let joins = |run: &Run| {
            let gap = site.arc_m - run.last.arc_m - site.half_m - run.last.half_m;
            let same = site.place.strand == run.last.place.strand;
            same && gap <= BRIDGED_GAP_M && self.strands.whole(&run.last.place, &site.place, cut)
        };
        match self.open[site.part].filter(joins) {
            Some(run) => {
                let turned = run.turned + between(run.last.azimuth, site.azimuth);
                self.open[site.part] = Some(Run { last: site, turned, ..run });
            }
            None => {
                self.close(site.part);
                self.open[site.part] = Some(Run { first: site, last: site, turned: 0.0 });
            }
        }
    }

    /// Ends the run of a part; the longest winding of all its runs stays.
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
    /// Turns of the whole run. Sites stand for rope half their length beyond the first and last:
    /// it is taken to turn at the run's mean rate, up to as much again as was measured.
    fn turns(&self) -> f64 {
        let span = self.last.arc_m - self.first.arc_m;
        let beyond = self.first.half_m + self.last.half_m;
        let factor = if span > beyond { 1.0 + beyond / span } else { 2.0 };
        self.turned * factor / TAU
    }
}

/// The turn from one azimuth to another, in (-π, π] [rad].
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

//! Contact pressure of rope: loads of each part and patch of skin, and normal force beyond what rope can exert.
//!
//! Rope that bends by `θ` under a tension `T` exerts normal forces that sum to `T θ`: `π T` about an edge. Skin also supports
//! the other forces on rope (weight, buoyancy, drag, inertia). By equilibrium their sum over a stretch in contact is at most
//! `R + 2 T`, with `R` the magnitude of the vector sum of normal forces and friction, and `T` the tension at either end. The
//! normal forces of a stretch therefore sum to at most
//!
//! `N ≤ T (θ + 2) + R`   [N]
//!
//! with `T` the greatest tension of the stretch and its adjacent segments [N], and `θ` the sum of the angles between its
//! segments [rad]. A greater sum means that skin presses rope from two sides, or that forces are not in equilibrium. A stretch
//! is rope of one line in contact, with gaps of one segment at most.
//!
//! A closing mouth presses rope from two sides, as does a corner of the mouth with wedged rope, and friction holds it there
//! without tension. The cancelling part of the normal forces on a segment, `Σ |N| - |Σ N|`, is therefore excluded where lips or
//! the inside of the mouth contribute to it.
//! It counts elsewhere, because other skin does not close on rope.
//! Reference: the capstan relation `dN = T dθ` (Euler 1769); the bound was derived here.

use std::sync::Arc;

use endline_sdk::{BodyPart, Region};
use glam::DVec3;

use super::summary::PatchSummary;
use crate::contact::ContactPoint;
use crate::contact::rope_on_skin::step_sums::{RegionMean, StepSums};
use crate::model::Model;
use crate::state::State;

/// Difference of segment indices above which two contacts are in different stretches.
const GAP: usize = 2;

/// Normal force over time: total, and excess over what rope can exert.
#[derive(Clone, Debug, Default)]
pub(super) struct ExcessForceMeter {
    /// Whether each triangle is inside the mouth.
    inside: Arc<[bool]>,
    /// Total [N s].
    all: f64,
    /// Excess [N s].
    beyond: f64,
    /// Contacts in the order of their segments; a buffer.
    order: Vec<usize>,
}

impl ExcessForceMeter {
    /// Meter of a whale with these triangles inside its mouth.
    pub fn new(inside: Arc<[bool]>) -> Self {
        Self { inside, ..Self::default() }
    }

    /// Adds the contacts at the end of a step.
    pub fn fold(&mut self, model: &Model, state: &State, contacts: &[ContactPoint], dt_s: f64) {
        let Self { inside, all, beyond, order } = self;
        order.clear();
        order.extend(0..contacts.len());
        order.sort_unstable_by_key(|index| (contacts[*index].segment, *index));
        let is_adjacent = |one: &usize, next: &usize| {
            let (one, next) = (&contacts[*one], &contacts[*next]);
            one.line == next.line && next.segment <= one.segment + GAP
        };
        for stretch in order.chunk_by(is_adjacent) {
            let stretch = stretch.iter().map(|index| &contacts[*index]);
            let normal_n: f64 = stretch.clone().map(|contact| contact.normal_force_n).sum();
            *all += normal_n * dt_s;
            let by_rope_n = normal_n - in_the_mouth_n(inside, stretch.clone());
            *beyond += (by_rope_n - most_n(model, state, stretch)).max(0.0) * dt_s;
        }
    }

    /// Share of the normal force over time that exceeds what rope can exert.
    pub fn beyond_share(&self) -> f64 {
        if self.all > 0.0 { self.beyond / self.all } else { 0.0 }
    }
}

/// Normal force with which the mouth presses rope from two sides, by segment [N].
fn in_the_mouth_n<'a>(inside: &[bool], stretch: impl Iterator<Item = &'a ContactPoint>) -> f64 {
    let mut own = Segment::default();
    let mut sum_n = 0.0;
    for contact in stretch {
        if contact.segment != own.segment {
            sum_n += std::mem::take(&mut own).clamped_n();
            own.segment = contact.segment;
        }
        own.all_n += contact.normal_force_n;
        own.resultant_n += contact.normal * contact.normal_force_n;
        own.in_mouth |=
            contact.region == Region::Lips || inside.get(contact.triangle) == Some(&true);
    }
    sum_n + own.clamped_n()
}

/// Normal forces on a segment.
#[derive(Clone, Copy, Debug, Default)]
struct Segment {
    segment: usize,
    all_n: f64,
    resultant_n: DVec3,
    in_mouth: bool,
}

impl Segment {
    fn clamped_n(self) -> f64 {
        if self.in_mouth { (self.all_n - self.resultant_n.length()).max(0.0) } else { 0.0 }
    }
}

/// Greatest normal force that the rope of a stretch can exert [N].
fn most_n<'a>(
    model: &Model,
    state: &State,
    stretch: impl DoubleEndedIterator<Item = &'a ContactPoint> + Clone,
) -> f64 {
    let [Some(first), Some(last)] = [stretch.clone().next(), stretch.clone().next_back()] else {
        return 0.0;
    };
    let own = &model.line_segments[first.line];
    let from = first.segment.saturating_sub(1).max(own.start);
    let to = (last.segment + 1).min(own.end - 1);
    let shift = model.line_nodes[first.line].start - own.start;
    let along = |segment: usize| {
        let node = segment + shift;
        state.rope.position[node + 1] - state.rope.position[node]
    };
    let turn: f64 = (from..to).map(|segment| angle(along(segment), along(segment + 1))).sum();
    let tension_n = state.rope.tension[from..=to].iter().copied().fold(0.0, f64::max);
    let resultant: DVec3 =
        stretch.map(|contact| contact.normal * contact.normal_force_n + contact.friction_n).sum();
    tension_n * (turn + 2.0) + resultant.length()
}

/// Angle between two vectors [rad].
fn angle(one: DVec3, other: DVec3) -> f64 {
    libm::atan2(one.cross(other).length(), one.dot(other))
}

const PARTS: usize = BodyPart::ALL.len();

const PATCHES: usize = Region::ALL.len();

/// Loads of every part and patch.
#[derive(Clone, Debug, Default)]
pub(super) struct Loads {
    pub(super) parts: [Load; PARTS],
    pub(super) patches: [Load; PATCHES],
}

/// Load of a part or patch, current and greatest; forces are means over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Load {
    pub(super) length_m: f64,
    pub(super) normal_n: f64,
    /// Vector sum of normal force and friction of rope on skin [N].
    pub(super) force_n: DVec3,
    /// Sum of the magnitudes of friction forces [N].
    pub(super) friction_n: f64,
    /// Greatest tension of any segment in contact [N].
    pub(super) tension_n: f64,
    /// Greatest slip speed of any contact [m/s].
    pub(super) slip_m_s: f64,
    pub(super) peak_length_m: f64,
    pub(super) peak_normal_n: f64,
    pub(super) peak_friction_n: f64,
    pub(super) peak_tension_n: f64,
    pub(super) peak_line_load_n_m: f64,
    pub(super) peak_pressure_pa: f64,
    pub(super) work_j: f64,
    pub(super) peak_wraps: f64,
    pub(super) peak_touching_wraps: f64,
    /// Level of wraps last reported [turns].
    pub(super) reported_wraps: f64,
}

impl Loads {
    /// Adds the contacts at the end of a step and their sums over the step.
    pub(super) fn fold(
        &mut self,
        model: &Model,
        state: &State,
        contacts: &[ContactPoint],
        sums: &StepSums,
    ) {
        let Self { parts, patches } = self;
        parts.iter_mut().chain(patches.iter_mut()).for_each(Load::begin);
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let tension_n = state.rope.tension[contact.segment].max(0.0);
            for load in
                [&mut parts[contact.region.part() as usize], &mut patches[contact.region as usize]]
            {
                load.add(model, contact, tension_n);
            }
        }
        for region in Region::ALL {
            let mean = sums.of_region(region);
            for load in [&mut parts[region.part() as usize], &mut patches[region as usize]] {
                load.add_mean(&mean);
            }
        }
        parts.iter_mut().chain(patches.iter_mut()).for_each(Load::end);
    }

    /// Load of each patch, in the order of [`Region::ALL`].
    pub(super) fn patches(&self) -> Vec<PatchSummary> {
        let summary = |(region, load): (&Region, &Load)| PatchSummary {
            region: *region,
            contact_length_m: load.length_m,
            normal_n: load.normal_n,
            friction_n: load.friction_n,
            force_n: load.force_n,
            tension_n: load.tension_n,
            peak_contact_length_m: load.peak_length_m,
            peak_normal_n: load.peak_normal_n,
            peak_friction_n: load.peak_friction_n,
            peak_tension_n: load.peak_tension_n,
            peak_line_load_n_m: load.peak_line_load_n_m,
            peak_pressure_pa: load.peak_pressure_pa,
            friction_work_j: load.work_j,
        };
        Region::ALL.iter().zip(&self.patches).map(summary).collect()
    }
}

impl Load {
    fn begin(&mut self) {
        (self.length_m, self.normal_n, self.slip_m_s) = (0.0, 0.0, 0.0);
        (self.force_n, self.friction_n, self.tension_n) = (DVec3::ZERO, 0.0, 0.0);
    }

    fn add(&mut self, model: &Model, contact: &ContactPoint, tension_n: f64) {
        self.length_m += contact.length_m;
        self.tension_n = self.tension_n.max(tension_n);
        self.slip_m_s = self.slip_m_s.max(slip_speed(contact));
        let line_load =
            if contact.length_m > 0.0 { contact.normal_force_n / contact.length_m } else { 0.0 };
        let width = model.spec.ropes[model.spec.lines[contact.line].rope].diameter_m;
        self.peak_line_load_n_m = self.peak_line_load_n_m.max(line_load);
        self.peak_pressure_pa =
            self.peak_pressure_pa.max(if width > 0.0 { line_load / width } else { 0.0 });
    }

    /// Adds mean forces and work over a step.
    fn add_mean(&mut self, mean: &RegionMean) {
        self.normal_n += mean.normal_n;
        self.force_n += mean.force_n;
        self.friction_n += mean.friction_n;
        self.work_j += mean.work_j;
    }

    fn end(&mut self) {
        self.peak_length_m = self.peak_length_m.max(self.length_m);
        self.peak_normal_n = self.peak_normal_n.max(self.normal_n);
        self.peak_friction_n = self.peak_friction_n.max(self.friction_n);
        self.peak_tension_n = self.peak_tension_n.max(self.tension_n);
    }
}

/// Speed of rope over skin in the last solver step [m/s].
fn slip_speed(contact: &ContactPoint) -> f64 {
    if contact.dt_s > 0.0 { contact.slip_m.length() / contact.dt_s } else { 0.0 }
}

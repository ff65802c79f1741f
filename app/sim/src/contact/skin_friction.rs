//! Friction between rope and skin: arrays for the friction plugins, their floats from step to step.
//!
//! Contacts are handed over law by law (`model::Friction`), one call each. With every contact the state keeps, ahead of the
//! plugin's floats, the law that they belong to and an account of the energy that friction has taken from the rope and
//! given to it there (`account.rs`).

use std::ops::Range;
use std::sync::Arc;

use endline_sdk::{Contacts, FrictionResponse};
use glam::{DMat3, DVec3};

use super::account::Account;
use super::grain::Grains;
use super::near::Near;
use super::points::SkinContactPoints;
use super::touch::Touch;
use crate::model::{Friction, FrictionLaw, Model};
use crate::solver::outer;
use crate::state::{FrictionState, State};

/// Floats of the state ahead of the plugin's own: number of the law, energy taken, energy given.
const KEPT: usize = 3;

/// Why friction failed, and whose fault it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failed {
    /// Id of the plugin.
    pub id: String,
    /// What went wrong.
    pub message: String,
}

/// Contacts of one law: places in the arrays, and in the floats.
#[derive(Clone, Debug)]
struct Group {
    law: usize,
    contacts: Range<usize>,
    floats: Range<usize>,
}

/// A contact point in touch, and the law that holds there.
#[derive(Clone, Copy, Debug)]
struct Found {
    law: usize,
    point: usize,
    face: usize,
}

/// Arrays handed to the friction plugins in a pass, one entry for each contact point in touch, law by law.
#[derive(Clone, Debug)]
pub(crate) struct Touching {
    grains: Arc<Grains>,
    /// Index of the contact point.
    pub point: Vec<usize>,
    /// Which of the faces that the contact point touches.
    pub face: Vec<usize>,
    /// Places in these arrays, in rising order of contact point.
    pub in_order: Vec<usize>,
    found: Vec<Found>,
    groups: Vec<Group>,
    normal_force: Vec<f64>,
    /// What the linear push grows by to where it was measured [N].
    growth_n: Vec<f64>,
    normal: Vec<[f64; 3]>,
    grain: Vec<[f64; 3]>,
    along: Vec<[f64; 3]>,
    slip: Vec<[f64; 3]>,
    /// Length of rope, the share of the face taken in [m].
    length: Vec<f64>,
    /// Share of the face.
    share: Vec<f64>,
    coefficient: Vec<f64>,
    region: Vec<u32>,
    rope: Vec<u32>,
    floats: Vec<f64>,
    floats_at_end: Vec<f64>,
    account: Vec<Account>,
    /// What the plugins answered.
    pub response: Vec<FrictionResponse>,
    /// `-d force / d place` of each contact as it went into the last solve [N/m].
    pub block: Vec<DMat3>,
}

impl Touching {
    /// No contacts yet, on a skin of these grains.
    pub fn new(grains: Arc<Grains>) -> Self {
        Self {
            grains,
            point: Vec::new(),
            face: Vec::new(),
            in_order: Vec::new(),
            found: Vec::new(),
            groups: Vec::new(),
            normal_force: Vec::new(),
            growth_n: Vec::new(),
            normal: Vec::new(),
            grain: Vec::new(),
            along: Vec::new(),
            slip: Vec::new(),
            length: Vec::new(),
            share: Vec::new(),
            coefficient: Vec::new(),
            region: Vec::new(),
            rope: Vec::new(),
            floats: Vec::new(),
            floats_at_end: Vec::new(),
            account: Vec::new(),
            response: Vec::new(),
            block: Vec::new(),
        }
    }

    /// Collects what contact points touch, as measured last.
    pub fn collect(
        &mut self,
        model: &Model,
        near: &Near,
        points: &SkinContactPoints,
        state: &State,
    ) {
        self.clear();
        let (Some(whale), Some(friction)) = (&model.spec.whale, &model.spec.friction) else {
            return;
        };
        for (point, at) in points.list.iter().enumerate() {
            for (face, touch) in points.touches(at).iter().enumerate() {
                let region = whale.skin.regions[near.skin_of(touch.pair).triangle as usize];
                let rope = model.spec.lines[model.segment_line[at.segment]].rope;
                self.found.push(Found { law: friction.law_of[rope][region as usize], point, face });
            }
        }
        if friction.laws.len() > 1 {
            self.found.sort_unstable_by_key(|found| (found.law, found.point, found.face));
        }
        for place in 0..self.found.len() {
            self.put(model, friction, near, points, state, place);
        }
        self.in_order.extend(0..self.point.len());
        if friction.laws.len() > 1 {
            self.in_order.sort_unstable_by_key(|place| (self.point[*place], self.face[*place]));
        }
        self.response.resize(self.point.len(), FrictionResponse::default());
    }

    fn clear(&mut self) {
        self.point.clear();
        self.face.clear();
        self.in_order.clear();
        self.found.clear();
        self.groups.clear();
        self.normal_force.clear();
        self.growth_n.clear();
        self.normal.clear();
        self.grain.clear();
        self.along.clear();
        self.slip.clear();
        self.length.clear();
        self.share.clear();
        self.coefficient.clear();
        self.region.clear();
        self.rope.clear();
        self.floats.clear();
        self.account.clear();
        self.response.clear();
    }

    /// Puts the contact found at a place into the arrays.
    fn put(
        &mut self,
        model: &Model,
        friction: &Friction,
        near: &Near,
        points: &SkinContactPoints,
        state: &State,
        place: usize,
    ) {
        let Some(whale) = &model.spec.whale else { return };
        let Found { law, point: index, face } = self.found[place];
        let point = &points.list[index];
        let touch = &points.touches(point)[face];
        let pair = near.skin_of(touch.pair);
        let region = whale.skin.regions[pair.triangle as usize];
        let rope = model.spec.lines[model.segment_line[point.segment]].rope;
        let rope_move = touch.place - point.began.place;
        let skin_move = pair.move_of(touch.barycentric) * (pair.stands - near.start);
        let slip = rope_move - skin_move;
        self.point.push(index);
        self.face.push(face);
        self.normal_force.push(touch.barrier.force);
        self.growth_n.push(touch.growth_n);
        self.normal.push(touch.normal.to_array());
        let grain = self.grains.at(pair.triangle as usize, &pair.now, touch.normal);
        self.grain.push(grain.to_array());
        self.along.push(point.began.along.normalize_or(touch.normal).to_array());
        self.slip.push((slip - touch.normal * slip.dot(touch.normal)).to_array());
        self.length.push(point.length * touch.share);
        self.share.push(touch.share);
        let coefficient = friction.coefficients[rope][region as usize];
        self.coefficient.push(coefficient * point.began.friction_factor);
        self.region.push(region as u32);
        self.rope.push(u32::try_from(rope).unwrap_or(u32::MAX));
        self.put_floats(friction, law, touch.kept, &state.rope.friction);
        self.put_in_group(law, place);
    }

    /// The plugin's floats and the account as the step began; zero where the contact is new or another law held there.
    fn put_floats(
        &mut self,
        friction: &Friction,
        law: usize,
        kept: Option<usize>,
        grips: &FrictionState,
    ) {
        let (width, stride) =
            (friction.laws[law].model.descriptor().state_len, KEPT + friction.state_len());
        let kept = kept.and_then(|place| grips.floats.get(place * stride..(place + 1) * stride));
        match kept {
            Some([of, taken_j, given_j, floats @ ..]) if of.to_bits() == (law as f64).to_bits() => {
                self.account.push(Account { taken_j: *taken_j, given_j: *given_j });
                self.floats.extend_from_slice(&floats[..width]);
            }
            _ => {
                self.account.push(Account::default());
                self.floats.resize(self.floats.len() + width, 0.0);
            }
        }
    }

    fn put_in_group(&mut self, law: usize, place: usize) {
        match self.groups.last_mut() {
            Some(group) if group.law == law => {
                group.contacts.end = place + 1;
                group.floats.end = self.floats.len();
            }
            last => {
                let from = last.map_or(0, |group| group.floats.end);
                self.groups.push(Group {
                    law,
                    contacts: place..place + 1,
                    floats: from..self.floats.len(),
                });
            }
        }
    }

    /// Asks the plugins for forces and derivatives.
    pub fn respond(&mut self, friction: &Friction, dt_s: f64) -> Result<(), Failed> {
        let mut response = std::mem::take(&mut self.response);
        let answer = self.groups.iter().try_for_each(|group| {
            let law = &friction.laws[group.law];
            let out = &mut response[group.contacts.clone()];
            law.model
                .respond(&law.attributes, &self.contacts(group, dt_s), out)
                .map_err(|error| failed(law, error.message))?;
            if out.iter().all(is_finite) {
                Ok(())
            } else {
                Err(failed(law, "gave a force or derivative that is not a finite number"))
            }
        });
        self.response = response;
        answer
    }

    /// Asks the plugins for their floats at the end of the step and keeps them for the sites in touch.
    pub fn advance(
        &mut self,
        friction: &Friction,
        dt_s: f64,
        points: &SkinContactPoints,
        grips: &mut FrictionState,
    ) -> Result<(), Failed> {
        let mut ends = std::mem::take(&mut self.floats_at_end);
        ends.clear();
        ends.resize(self.floats.len(), 0.0);
        let advanced = self.groups.iter().try_for_each(|group| {
            let (law, out) = (&friction.laws[group.law], &mut ends[group.floats.clone()]);
            law.model
                .advance(&law.attributes, &self.contacts(group, dt_s), out)
                .map_err(|error| failed(law, error.message))?;
            if out.iter().all(|x| x.is_finite()) {
                Ok(())
            } else {
                Err(failed(law, "gave a state that is not a finite number"))
            }
        });
        self.floats_at_end = ends;
        advanced?;
        self.settle_accounts(friction)?;
        self.keep(friction, points, grips);
        Ok(())
    }

    /// Books the work of the step, as if each face had no other beside it; a law that gives more than it can have taken ends the run.
    fn settle_accounts(&mut self, friction: &Friction) -> Result<(), Failed> {
        for group in &self.groups {
            for place in group.contacts.clone() {
                let work_j = DVec3::from_array(self.response[place].force_n)
                    .dot(DVec3::from_array(self.slip[place]));
                self.account[place]
                    .book(work_j / self.share[place])
                    .map_err(|message| failed(&friction.laws[group.law], message))?;
            }
        }
        Ok(())
    }

    fn keep(&self, friction: &Friction, points: &SkinContactPoints, grips: &mut FrictionState) {
        let stride = KEPT + friction.state_len();
        grips.clear();
        for place in &self.in_order {
            let Some(group) = self.groups.iter().find(|group| group.contacts.contains(place))
            else {
                continue;
            };
            let width = friction.laws[group.law].model.descriptor().state_len;
            let from = group.floats.start + (place - group.contacts.start) * width;
            let Account { taken_j, given_j } = self.account[*place];
            let (point, face) = (&points.list[self.point[*place]], self.face[*place]);
            let push_n = (self.normal_force[*place] + self.growth_n[*place]).max(0.0);
            grips.sites.push(point.site(face));
            grips.push_n.push(push_n / self.share[*place]);
            grips.normals.push(DVec3::from_array(self.normal[*place]));
            grips.floats.extend_from_slice(&[group.law as f64, taken_j, given_j]);
            grips.floats.extend_from_slice(&self.floats_at_end[from..from + width]);
            grips.floats.resize(grips.sites.len() * stride, 0.0);
        }
    }

    /// `-d force / d place` of a contact with what it touches [N/m].
    pub fn block_of(&self, place: usize, touch: &Touch) -> DMat3 {
        let response = &self.response[place];
        let growth = touch.away * touch.barrier.stiffness;
        outer(touch.normal + DVec3::from_array(response.by_normal_force), growth)
            - matrix(&response.by_slip)
    }

    /// Takes the push of a contact as linear about another one, where it was measured; friction goes on from the push it was asked for.
    pub fn follow_law(&mut self, place: usize, touch: &Touch) {
        self.growth_n[place] = touch.barrier.force + touch.growth_n - self.normal_force[place];
        self.block[place] = self.block_of(place, touch);
    }

    /// Push and friction of a contact together, linear about the push that they were asked for [N].
    pub fn force_of(&self, place: usize) -> DVec3 {
        let (response, normal) = (&self.response[place], DVec3::from_array(self.normal[place]));
        normal * self.normal_force[place]
            + DVec3::from_array(response.force_n)
            + (normal + DVec3::from_array(response.by_normal_force)) * self.growth_n[place]
    }

    /// Slip of a contact in this step.
    pub fn slip_of(&self, place: usize) -> DVec3 {
        DVec3::from_array(self.slip[place])
    }

    fn contacts(&self, group: &Group, dt_s: f64) -> Contacts<'_> {
        let at = group.contacts.clone();
        Contacts {
            dt_s,
            normal_force_n: &self.normal_force[at.clone()],
            normal: &self.normal[at.clone()],
            grain: &self.grain[at.clone()],
            along: &self.along[at.clone()],
            slip_m: &self.slip[at.clone()],
            length_m: &self.length[at.clone()],
            coefficient: &self.coefficient[at.clone()],
            region: &self.region[at.clone()],
            rope: &self.rope[at],
            state: &self.floats[group.floats.clone()],
        }
    }
}

fn failed(law: &FrictionLaw, message: impl Into<String>) -> Failed {
    Failed { id: law.model.descriptor().id.to_string(), message: message.into() }
}

fn is_finite(answer: &FrictionResponse) -> bool {
    answer
        .force_n
        .iter()
        .chain(answer.by_slip.iter().flatten())
        .chain(&answer.by_normal_force)
        .all(|x| x.is_finite())
}

/// Rows of a plugin's answer as a matrix.
fn matrix(rows: &[[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(rows).transpose()
}

//! Inputs and outputs of the friction laws: contacts in order of law, and the floats that each stores from step to step.
//!
//! Each law is called once for all of its contacts (`model::Friction`). The state stores, for every contact, the number of its law, the
//! energy that friction has taken from rope and returned to it, and the floats of the law.
//!
//! A friction law stores energy in its bristles and returns no more than it took: from the first touch of a contact,
//! `returned <= taken`, with the work `f . s` of the force on the rope over its slip, summed by sign. An allowance is added: where
//! segments of rope change their length, a bristle is transferred to a longer or shorter sub-segment, and its energy
//! changes by at most 25 mm over 10 mm, the longest and the shortest sub-segment near an edge. A law that drives the rope exceeds the
//! allowance within its first strokes.

use crate::matrix::outer;
use crate::model::{Friction, FrictionLaw};
use endline_sdk::{Contacts, FrictionResponse};
use glam::{DMat3, DVec3};
use std::ops::Range;

/// Number of floats before those of the law: number of the law, energy taken, energy returned.
const KEPT: usize = 3;

/// Normal force under which no contact slips [N].
const HOLDING_N: f64 = 1e9;
/// Longest stretch of a contact that holds [m]. A law with a force that needs a longer one is not elastic.
const LONGEST_STRETCH_M: f64 = 0.1;

/// Why friction failed, and whose fault it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failed {
    /// Id of the plugin.
    pub id: String,
    /// The error message.
    pub message: String,
}

/// Contacts of one law: places in the arrays, and in the floats.
#[derive(Clone, Debug)]
struct Group {
    law: usize,
    contacts: Range<usize>,
    floats: Range<usize>,
}

/// Input of a friction law for one contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    /// Number of the law.
    pub law: usize,
    /// Normal force where it is linearised, and its linear increment to the trial [N].
    pub normal_force: f64,
    pub growth_n: f64,
    pub normal: DVec3,
    pub grain: DVec3,
    /// Along the rope, or the normal where there is no such direction.
    pub along: DVec3,
    pub slip: DVec3,
    /// Length of rope, the share of the face taken in [m].
    pub length: f64,
    /// Share of the face.
    pub share: f64,
    pub coefficient: f64,
    pub region: u32,
    pub rope: u32,
}

/// Arrays handed to the friction laws in a pass, one entry for each contact, law by law.
#[derive(Clone, Debug, Default)]
pub(crate) struct FrictionArrays {
    groups: Vec<Group>,
    normal_force: Vec<f64>,
    growth_n: Vec<f64>,
    normal: Vec<[f64; 3]>,
    grain: Vec<[f64; 3]>,
    along: Vec<[f64; 3]>,
    slip: Vec<[f64; 3]>,
    length: Vec<f64>,
    share: Vec<f64>,
    coefficient: Vec<f64>,
    region: Vec<u32>,
    rope: Vec<u32>,
    floats: Vec<f64>,
    floats_at_end: Vec<f64>,
    account: Vec<Account>,
    /// Results of the laws.
    pub response: Vec<FrictionResponse>,
    /// Scratch: results under [`HOLDING_N`], and the normal forces meanwhile.
    held_response: Vec<FrictionResponse>,
    pushes_n: Vec<f64>,
}

impl FrictionArrays {
    pub fn clear(&mut self) {
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

    /// Appends a contact, in rising order of law; `kept` are its floats at the end of the last solver step.
    #[inline(always)]
    pub fn put(&mut self, friction: &Friction, asked: Asked, kept: Option<&[f64]>) {
        let place = self.normal_force.len();
        self.normal_force.push(asked.normal_force);
        self.growth_n.push(asked.growth_n);
        self.normal.push(asked.normal.to_array());
        self.grain.push(asked.grain.to_array());
        self.along.push(asked.along.to_array());
        self.slip.push((asked.slip - asked.normal * asked.slip.dot(asked.normal)).to_array());
        self.length.push(asked.length);
        self.share.push(asked.share);
        self.coefficient.push(asked.coefficient);
        self.region.push(asked.region);
        self.rope.push(asked.rope);
        self.put_floats(friction, asked.law, kept);
        self.put_in_group(asked.law, place);
    }

    /// The law's floats and the account as the step began; zero where the contact is new or another law held there.
    #[inline(always)]
    fn put_floats(&mut self, friction: &Friction, law: usize, kept: Option<&[f64]>) {
        let width = friction.laws[law].model.descriptor().state_len;
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

    #[inline(always)]
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

    /// Calls the laws for forces and derivatives.
    pub fn respond(&mut self, friction: &Friction, dt_s: f64) -> Result<(), Failed> {
        let mut response = std::mem::take(&mut self.response);
        response.resize(self.normal_force.len(), FrictionResponse::default());
        let answer = self.groups.iter().try_for_each(|group| {
            self.respond_to(friction, dt_s, group, &mut response[group.contacts.clone()])
        });
        self.response = response;
        answer
    }

    /// Calls the law of one group.
    fn respond_to(
        &self,
        friction: &Friction,
        dt_s: f64,
        group: &Group,
        out: &mut [FrictionResponse],
    ) -> Result<(), Failed> {
        let law = &friction.laws[group.law];
        law.model
            .respond(&law.attributes, &self.contacts(group, dt_s), out)
            .map_err(|error| failed(law, error.message))?;
        if out.iter().all(is_finite) {
            Ok(())
        } else {
            Err(failed(law, "gave a force or derivative that is not a finite number"))
        }
    }

    /// Replaces the responses of the contacts at these places, in rising order, by those of contacts that hold at any force, at the same
    /// trial. A law that fails at such a normal force, or does not hold, keeps its response.
    pub fn hold(&mut self, friction: &Friction, dt_s: f64, places: &[usize]) {
        debug_assert!(places.is_sorted(), "{places:?}");
        self.pushes_n.clear();
        self.pushes_n.extend(places.iter().map(|place| self.normal_force[*place]));
        places.iter().for_each(|place| self.normal_force[*place] = HOLDING_N);
        let mut held = std::mem::take(&mut self.held_response);
        held.resize(self.normal_force.len(), FrictionResponse::default());
        for group in 0..self.groups.len() {
            let group = &self.groups[group];
            let [from, end] = [group.contacts.start, group.contacts.end]
                .map(|contact| places.partition_point(|place| *place < contact));
            let out = &mut held[group.contacts.clone()];
            if from == end || self.respond_to(friction, dt_s, group, out).is_err() {
                continue;
            }
            for place in places[from..end].iter().copied().filter(|place| holds(&held[*place])) {
                self.response[place] =
                    FrictionResponse { by_normal_force: [0.0; 3], ..held[place] };
            }
        }
        for (place, push_n) in places.iter().zip(&self.pushes_n) {
            self.normal_force[*place] = *push_n;
        }
        self.held_response = held;
    }

    /// Calls the laws for their floats at the end of the step, and adds the work of the step.
    pub fn advance(&mut self, friction: &Friction, dt_s: f64) -> Result<(), Failed> {
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
        self.settle_accounts(friction)
    }

    /// Adds the work of the step, as if each face were alone; a law that returns more than it can have taken ends the run.
    fn settle_accounts(&mut self, friction: &Friction) -> Result<(), Failed> {
        for group in &self.groups {
            for place in group.contacts.clone() {
                let work_j = self.friction_of(place).dot(self.slip_of(place));
                self.account[place]
                    .book(work_j / self.share[place])
                    .map_err(|message| failed(&friction.laws[group.law], message))?;
            }
        }
        Ok(())
    }

    /// Appends the floats of a contact to those stored, the same number for every contact.
    pub fn keep(&self, friction: &Friction, place: usize, kept: &mut Vec<f64>) {
        let Some(group) = self.groups.iter().find(|group| group.contacts.contains(&place)) else {
            return;
        };
        let width = friction.laws[group.law].model.descriptor().state_len;
        let from = group.floats.start + (place - group.contacts.start) * width;
        let Account { taken_j, given_j } = self.account[place];
        let end = kept.len() + stride(friction);
        kept.extend_from_slice(&[group.law as f64, taken_j, given_j]);
        kept.extend_from_slice(&self.floats_at_end[from..from + width]);
        kept.resize(end, 0.0);
    }

    /// `-d force / d place` of a contact with normal force along `normal`, which decreases by `decrease` with a move [N/m].
    pub fn block_of(&self, place: usize, normal: DVec3, decrease: DVec3) -> DMat3 {
        let response = &self.response[place];
        outer(normal + DVec3::from_array(response.by_normal_force), decrease)
            - matrix(&response.by_slip)
    }

    /// Sets the normal force where it is linearised; friction stays that of the evaluation [N].
    pub fn set_push(&mut self, place: usize, push_n: f64) {
        self.growth_n[place] = push_n - self.normal_force[place];
    }

    /// Normal force of a contact, linear about the evaluation, never negative, as if its face were alone [N].
    pub fn whole_push_n(&self, place: usize) -> f64 {
        let push_n = (self.normal_force[place] + self.growth_n[place]).max(0.0);
        push_n / self.share[place]
    }

    /// Normal force and friction of a contact together, linear about the evaluation [N].
    pub fn force_of(&self, place: usize) -> DVec3 {
        let (response, normal) = (&self.response[place], DVec3::from_array(self.normal[place]));
        normal * self.normal_force[place]
            + DVec3::from_array(response.force_n)
            + (normal + DVec3::from_array(response.by_normal_force)) * self.growth_n[place]
    }

    /// Direction of the push of a contact.
    pub fn normal_of(&self, place: usize) -> DVec3 {
        DVec3::from_array(self.normal[place])
    }

    /// Friction of a contact [N].
    pub fn friction_of(&self, place: usize) -> DVec3 {
        DVec3::from_array(self.response[place].force_n)
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

/// Stored floats of a contact, by its index among those stored; `None` if there is no such index.
pub(crate) fn kept_floats<'a>(
    friction: &Friction,
    floats: &'a [f64],
    place: usize,
) -> Option<&'a [f64]> {
    let stride = stride(friction);
    floats.get(place * stride..(place + 1) * stride)
}

/// Number of stored floats of each contact.
fn stride(friction: &Friction) -> usize {
    KEPT + friction.state_len()
}

fn failed(law: &FrictionLaw, message: impl Into<String>) -> Failed {
    Failed { id: law.model.descriptor().id.to_string(), message: message.into() }
}

/// Whether a response is that of a contact that holds: its force is at most that of its stiffness over [`LONGEST_STRETCH_M`].
fn holds(response: &FrictionResponse) -> bool {
    let force = DVec3::from_array(response.force_n);
    let Some(direction) = force.try_normalize() else { return true };
    let stiffness = -direction.dot(matrix(&response.by_slip) * direction);
    force.length() < LONGEST_STRETCH_M * stiffness
}

fn is_finite(answer: &FrictionResponse) -> bool {
    answer
        .force_n
        .iter()
        .chain(answer.by_slip.iter().flatten())
        .chain(&answer.by_normal_force)
        .all(|x| x.is_finite())
}

/// Rows of a plugin's result as a matrix.
fn matrix(rows: &[[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(rows).transpose()
}

/// Largest ratio of energy returned to energy taken.
const MOST_RETURNED: f64 = 3.0;
/// Energy that may be returned in addition, for rounding [J].
const OF_NOTHING_J: f64 = 1e-3;

/// Energy taken from the rope and returned to it since first touch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Account {
    pub taken_j: f64,
    pub given_j: f64,
}

impl Account {
    /// Adds the work of a step; the error says that more has been returned than can have been taken.
    pub fn book(&mut self, work_j: f64) -> Result<(), String> {
        if work_j <= 0.0 {
            self.taken_j -= work_j;
            return Ok(());
        }
        self.given_j += work_j;
        let Self { taken_j, given_j } = *self;
        if given_j <= MOST_RETURNED * taken_j + OF_NOTHING_J {
            return Ok(());
        }
        Err(format!(
            "its friction adds energy: at one contact it has given the rope {given_j:.3} J, of {taken_j:.3} J that it took"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_stored_may_come_back_and_no_more() {
        let mut account = Account::default();
        for work in [-2.0, 1.0, -0.5, 1.4] {
            account.book(work).unwrap();
        }
        assert_eq!(account, Account { taken_j: 2.5, given_j: 2.4 });
        let fault = account.book(6.0).unwrap_err();
        assert!(fault.contains("adds energy") && fault.contains("8.400 J, of 2.500 J"), "{fault}");
        assert!(Account::default().book(2e-3).is_err());
    }
}

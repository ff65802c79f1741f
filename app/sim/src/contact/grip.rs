//! Friction between rope and skin: arrays for the friction plugin, its floats from step to step.

use endline_sdk::{Contacts, FrictionResponse};
use glam::{DMat3, DVec3};

use super::near::{Near, on_triangle};
use super::slots::{Slot, Slots, Touch};
use crate::in_place::clone_in_place;
use crate::model::{Friction, Model};
use crate::state::State;

/// Floats of the friction model for the sites in touch, in rising order of site.
#[derive(Debug, Default, PartialEq)]
pub struct Grips {
    /// Sites in touch.
    pub sites: Vec<u64>,
    /// Floats of each, one after the other.
    pub floats: Vec<f64>,
}

clone_in_place!(Grips { sites, floats });

impl Grips {
    /// Forgets all grips.
    pub(crate) fn clear(&mut self) {
        self.sites.clear();
        self.floats.clear();
    }
}

/// Arrays handed to the friction plugin in a pass, one entry for each slot in touch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Touching {
    /// Index of the slot.
    pub slot: Vec<usize>,
    normal_force: Vec<f64>,
    normal: Vec<[f64; 3]>,
    slip: Vec<[f64; 3]>,
    length: Vec<f64>,
    coefficient: Vec<f64>,
    region: Vec<u32>,
    rope: Vec<u32>,
    floats: Vec<f64>,
    /// What the plugin answered.
    pub response: Vec<FrictionResponse>,
}

impl Touching {
    /// Collects the slots in touch, as `touch_of` tells it.
    pub fn collect(&mut self, model: &Model, near: &Near, slots: &Slots, state: &State, touch_of: impl Fn(&Slot) -> Option<Touch>) {
        self.clear();
        let (Some(whale), Some(friction)) = (&model.spec.whale, &model.spec.friction) else { return };
        for (index, slot) in slots.list.iter().enumerate() {
            let Some(touch) = touch_of(slot) else { continue };
            let pair = &near.pairs[touch.pair];
            let region = whale.skin.regions[pair.triangle as usize];
            let rope = model.spec.lines[model.segment_line[slot.segment]].rope;
            let rope_move = touch.place - slot.on_rope(|node| state.rope.position[node]);
            let skin_move = on_triangle(pair.now, touch.barycentric) - on_triangle(pair.sweep[0], touch.barycentric);
            let slip = rope_move - skin_move;
            self.slot.push(index);
            self.normal_force.push(touch.press.force);
            self.normal.push(touch.normal.to_array());
            self.slip.push((slip - touch.normal * slip.dot(touch.normal)).to_array());
            self.length.push(slot.length);
            self.coefficient.push(friction.coefficients[rope][region as usize]);
            self.region.push(region as u32);
            self.rope.push(u32::try_from(rope).unwrap_or(u32::MAX));
            self.push_floats(friction.model.descriptor().state_len, slot.site, &state.rope.grips);
        }
        self.response.resize(self.slot.len(), FrictionResponse::default());
    }

    fn clear(&mut self) {
        self.slot.clear();
        self.normal_force.clear();
        self.normal.clear();
        self.slip.clear();
        self.length.clear();
        self.coefficient.clear();
        self.region.clear();
        self.rope.clear();
        self.floats.clear();
        self.response.clear();
    }

    fn push_floats(&mut self, width: usize, site: u64, grips: &Grips) {
        match grips.sites.binary_search(&site) {
            Ok(place) => self.floats.extend_from_slice(&grips.floats[place * width..(place + 1) * width]),
            Err(_) => self.floats.resize(self.floats.len() + width, 0.0),
        }
    }

    /// Asks the plugin for forces and derivatives.
    pub fn respond(&mut self, friction: &Friction, dt_s: f64) -> Result<(), String> {
        if self.slot.is_empty() {
            return Ok(());
        }
        let mut response = std::mem::take(&mut self.response);
        let answer = friction.model.respond(&friction.attributes, &self.contacts(dt_s), &mut response);
        self.response = response;
        answer.map_err(|error| error.message)?;
        let finite = |answer: &FrictionResponse| {
            answer.force_n.iter().chain(answer.by_slip.iter().flatten()).chain(&answer.by_normal_force).all(|x| x.is_finite())
        };
        if self.response.iter().all(finite) { Ok(()) } else { Err("gave a force or derivative that is not a finite number".into()) }
    }

    /// Asks the plugin for its floats at the end of the step and keeps them for the sites in touch.
    pub fn advance(&self, friction: &Friction, dt_s: f64, slots: &Slots, grips: &mut Grips) -> Result<(), String> {
        grips.sites.clear();
        grips.sites.extend(self.slot.iter().map(|slot| slots.list[*slot].site));
        grips.floats.clear();
        grips.floats.resize(self.floats.len(), 0.0);
        if self.slot.is_empty() {
            return Ok(());
        }
        friction.model.advance(&friction.attributes, &self.contacts(dt_s), &mut grips.floats).map_err(|error| error.message)?;
        if grips.floats.iter().all(|x| x.is_finite()) { Ok(()) } else { Err("gave a state that is not a finite number".into()) }
    }

    /// Push and friction of a contact together [N].
    pub fn force_of(&self, place: usize) -> DVec3 {
        DVec3::from_array(self.normal[place]) * self.normal_force[place] + DVec3::from_array(self.response[place].force_n)
    }

    /// Slip of a contact in this step.
    pub fn slip_of(&self, place: usize) -> DVec3 {
        DVec3::from_array(self.slip[place])
    }

    fn contacts(&self, dt_s: f64) -> Contacts<'_> {
        Contacts {
            dt_s,
            normal_force_n: &self.normal_force,
            normal: &self.normal,
            slip_m: &self.slip,
            length_m: &self.length,
            coefficient: &self.coefficient,
            region: &self.region,
            rope: &self.rope,
            state: &self.floats,
        }
    }
}

/// Rows of a plugin's answer as a matrix.
pub(crate) fn matrix(rows: &[[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(rows).transpose()
}

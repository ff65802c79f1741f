//! Rope on the whale's skin: detection that cannot miss, and response inside the solution for rope.

mod crease;
mod kind;
pub(crate) mod near;
mod pieces;
pub(crate) mod points;
pub(crate) mod skin_friction;
pub mod step_sums;
pub(crate) mod stored_faces;
pub(crate) mod touch;

use std::sync::Arc;

use glam::{DMat3, DVec3};

use crate::contact::law::barrier::PINCHED_SHARE;
use crate::contact::law::friction_arrays::Failed;
use crate::contact::law::skin_direction::Grains;
use crate::contact::rope_on_skin::near::Near;
use crate::contact::rope_on_skin::points::{SkinContactPoint, SkinContactPoints};
use crate::contact::rope_on_skin::skin_friction::Touching;
use crate::contact::rope_on_skin::touch::Touch;
use crate::contact::{ContactError, ContactPoint};
use crate::model::{Friction, Model};
use crate::state::State;

/// Rope that begins a step pinched may end it this much nearer to skin, as a share.
const STILL_PINCHED: f64 = 0.99;

/// Rope on skin in one model with a whale. A step depends on nothing that is stored here between steps.
#[derive(Clone, Debug)]
pub(crate) struct RopeOnSkin {
    pub near: Near,
    points: SkinContactPoints,
    friction: Touching,
    /// Whether rope may touch skin in this solver step.
    pub touching: bool,
    /// Whether all contact points have been measured at the trial since they were opened, so that the next measurement is omitted.
    is_measured: bool,
    /// Force of each contact point by the last solution less the force at the trial [N].
    missed: Vec<DVec3>,
    /// Friction of each contact point by the last solution [N]; empty where there was none with these points.
    solved_friction: Vec<DVec3>,
    /// Scratch: contacts whose friction has reversed.
    reversed: Vec<usize>,
    /// Places where contact was measured last.
    before: Vec<DVec3>,
    /// Places of rope by its velocities.
    target: Vec<DVec3>,
    /// Greatest contact distance of any rope [m].
    greatest_contact_distance: f64,
}

impl RopeOnSkin {
    /// Scratch for a model, where it has a whale.
    pub fn new(model: &Model) -> Option<Self> {
        let tree = model.skin_tree.clone()?;
        Some(Self {
            friction: Touching::new(Arc::new(Grains::new(tree.skin()))),
            near: Near::new(model, tree),
            points: SkinContactPoints::default(),
            touching: false,
            is_measured: false,
            missed: Vec::new(),
            solved_friction: Vec::new(),
            reversed: Vec::new(),
            before: Vec::new(),
            target: Vec::new(),
            greatest_contact_distance: model
                .spec
                .ropes
                .iter()
                .map(|rope| 0.5 * rope.diameter_m)
                .chain(model.knots.iter().map(|knot| knot.radius_m))
                .fold(0.0, f64::max),
        })
    }

    /// Whether rope is near skin in this step of the model.
    pub fn is_near(&self) -> bool {
        !self.near.pairs.is_empty()
    }

    /// Finds the pairs that may touch in a solver step that ends at the share `goal` of the model's step, by the velocities of rope;
    /// returns whether there are any.
    pub fn find_active_pairs(&mut self, state: &State, goal: f64, dt: f64) -> bool {
        let rope = &state.rope;
        self.target.clear();
        self.target.extend(
            rope.position
                .iter()
                .zip(&rope.velocity)
                .map(|(place, velocity)| *place + *velocity * dt),
        );
        self.near.find_active(&rope.position, &self.target, goal);
        self.near.may_touch()
    }

    /// Holds the contacts whose friction at the trial opposes that of the solution that led there. Otherwise iterations would alternate
    /// between slip one way and the other (`law/elastic_grip.rs`).
    fn hold_reversed(&mut self, model: &Model, dt_s: f64) {
        let Self { points, friction: touching, solved_friction, reversed, .. } = self;
        let Some(laws) = &model.spec.friction else { return };
        if solved_friction.is_empty() {
            return;
        }
        debug_assert_eq!(solved_friction.len(), points.list.len(), "solved with these points");
        reversed.clear();
        reversed.extend(touching.faces.iter().enumerate().filter_map(|(place, contact)| {
            let at_trial = touching.arrays.friction_of(place);
            (at_trial.dot(solved_friction[contact.point]) < 0.0).then_some(place)
        }));
        if !reversed.is_empty() {
            touching.arrays.hold(laws, dt_s, reversed);
        }
    }

    /// Stores the block `-dF/dx` of every contact as measured last.
    fn store_blocks(&mut self) {
        let Self { points, friction: touching, .. } = self;
        touching.block.clear();
        touching.force.clear();
        for (place, contact) in touching.faces.iter().enumerate() {
            let touch = &points.touches(&points.list[contact.point])[contact.face];
            touching.block.push(touching.block_of(place, touch));
            touching.force.push(touching.arrays.force_of(place));
        }
    }

    /// Push and friction of every contact as measured last, with its block as noted.
    pub fn contacts(&self) -> impl Iterator<Item = (&SkinContactPoint, DVec3, &DMat3)> {
        let Self { points, friction: touching, .. } = self;
        let solved = touching.force.iter().zip(&touching.block);
        let faces = touching.faces.iter().zip(solved);
        faces.map(|(contact, (force, block))| (&points.list[contact.point], *force, block))
    }

    /// Contacts with forces linear about the evaluation (`before`), with the rope at other places.
    pub fn contacts_at<'a>(
        &'a self,
        places: &'a [DVec3],
    ) -> impl Iterator<Item = (&'a SkinContactPoint, DVec3, &'a DMat3)> {
        self.contacts().map(|(point, force, block)| {
            let step = point.on_rope(|node| places[node] - self.before[node]);
            (point, force - *block * step, block)
        })
    }

    /// Difference between the normal force of the last solution and the law at these places, with skin as evaluated last.
    fn law_error_at(&self, places: &[DVec3]) -> ContactError {
        let Self { points, friction: touching, before, .. } = self;
        let mut missed = ContactError::default();
        for (place, contact) in touching.faces.iter().enumerate() {
            let step = points.list[contact.point].on_rope(|node| places[node] - before[node]);
            let gap_n = points.law_missed(contact.point, contact.face, step);
            let force = touching.force[place] - touching.block[place] * step;
            missed = missed.and(ContactError { gap_n, greatest_n: force.length() });
        }
        missed
    }

    /// Makes the normal force of every contact linear about the last solution.
    pub fn follow_law(&mut self, places: &[DVec3]) {
        let Self { points, friction: touching, before, .. } = self;
        for place in 0..touching.faces.len() {
            let contact = touching.faces[place];
            let step = points.list[contact.point].on_rope(|node| places[node] - before[node]);
            let touch = points.follow_law(contact.point, contact.face, step);
            touching.follow_law(place, touch);
        }
    }

    /// After a solution: push and friction of every contact point by it.
    fn store_solved(&mut self, places: &[DVec3]) {
        let Self { points, friction: touching, before, missed, solved_friction, .. } = self;
        for sums in [&mut *missed, &mut *solved_friction] {
            sums.clear();
            sums.resize(points.list.len(), DVec3::ZERO);
        }
        for (place, contact) in touching.faces.iter().enumerate() {
            let step = points.list[contact.point].on_rope(|node| places[node] - before[node]);
            let force = touching.force[place] - touching.block[place] * step;
            let normal = touching.arrays.normal_of(place);
            missed[contact.point] += force;
            solved_friction[contact.point] += force - normal * normal.dot(force);
            points.note_solved(contact.point, contact.face, step);
        }
    }

    /// Difference between the forces of the last solution and those evaluated last.
    fn solution_error(&mut self) -> ContactError {
        let Self { friction: touching, missed, .. } = self;
        let mut greatest = 0.0_f64;
        for (place, contact) in touching.faces.iter().enumerate() {
            let force = touching.arrays.force_of(place);
            missed[contact.point] -= force;
            greatest = greatest.max(force.length_squared());
        }
        let gap = missed.iter().map(|missed| missed.length_squared()).fold(0.0, f64::max);
        ContactError { gap_n: gap.sqrt(), greatest_n: greatest.sqrt() }
    }

    /// Opens the contact points of rope that may touch, as its predicted places lie.
    pub fn open_active_points(&mut self, model: &Model, state: &State, places: &[DVec3]) {
        let Some(whale) = &model.spec.whale else { return };
        let (stiffness, friction) = (whale.contact_stiffness_n_m2, &state.rope.friction);
        let lengths = &state.rope.segment_length;
        self.points.open(model, &self.near, lengths, stiffness, friction);
        self.points.measure(&self.near, places);
        let mut opened = self.points.open_more(&self.near, places);
        while opened > 0 {
            self.points.measure_opened(&self.near, places);
            opened = self.points.open_more_beside_opened(&self.near, places);
        }
    }

    /// Whether rope has left the margin in which skin near it was gathered.
    fn has_left_margin(&self, places: &[DVec3]) -> bool {
        self.near.strayed(places, self.near.margin_m - self.greatest_contact_distance)
    }

    /// A segment and triangle nearer than this share of the contact distance, if any.
    fn nearer_than(&self, share: f64) -> Option<(usize, usize)> {
        if !self.points.any_nearer_than(share * self.greatest_contact_distance) {
            return None;
        }
        self.points.list.iter().find_map(|point| {
            let touch = self
                .points
                .touches(point)
                .iter()
                .find(|touch| touch.distance < share * point.contact_distance)?;
            Some((point.segment, self.near.skin_of(touch.pair).triangle as usize))
        })
    }

    /// A segment and triangle between which rope is pinched at the end of a step from `from`, if any. Rope that began it pinched may stay,
    /// and come out again.
    /// A knot may be pressed flat: the rope in its middle has contact points of its own.
    fn pinched(&self, from: &[DVec3]) -> Option<(usize, usize)> {
        // Twice the distance, whatever the rounding.
        if !self.points.any_nearer_than(2.0 * PINCHED_SHARE * self.greatest_contact_distance) {
            return None;
        }
        self.points.list.iter().filter(|point| !point.is_knot).find_map(|point| {
            let is_pinched = |touch: &&Touch| {
                let share = touch.distance / point.contact_distance;
                share < PINCHED_SHARE && {
                    let began = self.near.began_at(touch.pair, point.on_rope(|node| from[node]));
                    touch.distance < STILL_PINCHED * began
                }
            };
            let touch = self.points.touches(point).iter().find(is_pinched)?;
            Some((point.segment, self.near.skin_of(touch.pair).triangle as usize))
        })
    }

    /// Contacts at the end of an accepted step; the friction model's floats move on.
    fn advance_friction(
        &mut self,
        model: &Model,
        friction: &Friction,
        dt_s: f64,
        state: &mut State,
        contacts: &mut Vec<ContactPoint>,
    ) -> Result<(), Failed> {
        contacts.clear();
        let Some(whale) = &model.spec.whale else { return Ok(()) };
        for place in self.friction.in_order.iter().copied() {
            let contact = self.friction.faces[place];
            let point = &self.points.list[contact.point];
            let touch = self.points.touches(point).get(contact.face);
            let Some(touch) = touch else { continue };
            let triangle = self.near.skin_of(touch.pair).triangle as usize;
            contacts.push(ContactPoint {
                line: model.segment_line[point.segment],
                segment: point.segment,
                fraction: point.fraction,
                triangle,
                barycentric: touch.barycentric,
                region: whale.skin.regions[triangle],
                position: touch.place,
                normal: touch.normal,
                distance_m: touch.distance,
                length_m: point.length,
                is_knot: point.is_knot,
                normal_force_n: touch.barrier.force,
                friction_n: self.friction.arrays.friction_of(place),
                slip_m: self.friction.arrays.slip_of(place),
                dt_s,
            });
        }
        self.friction.advance(friction, dt_s, &self.points, &mut state.rope.friction)
    }
}

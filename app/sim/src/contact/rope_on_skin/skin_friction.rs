//! Friction between rope and skin: the contact points in touch, in the arrays of the friction laws (`friction_arrays.rs`).

use std::sync::Arc;

use endline_sdk::Region;
use glam::{DMat3, DVec3};
use pulp::{Arch, Simd, WithSimd};

use crate::bucket_sort::BucketSort;
use crate::contact::law::friction_arrays::{Asked, Failed, FrictionArrays, kept_floats};
use crate::contact::law::skin_direction::Grains;
use crate::contact::rope_on_skin::near::Near;
use crate::contact::rope_on_skin::points::SkinContactPoints;
use crate::contact::rope_on_skin::touch::Touch;
use crate::geometry::norm;
use crate::model::{Friction, Model};
use crate::state::{FrictionState, State};

/// A touched face of a contact point, and its friction law.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FaceContact {
    law: usize,
    rope: usize,
    region: Region,
    /// Index of the contact point.
    pub point: usize,
    /// Which of the faces that the contact point touches.
    pub face: usize,
    /// Its place in rising order of contact point and face.
    order: usize,
}

/// What the inputs of the friction laws are computed from.
struct Sources<'a> {
    model: &'a Model,
    friction: &'a Friction,
    near: &'a Near,
    state: &'a State,
}

/// Appends the inputs of all contacts to the arrays, with the instructions of the processor.
struct Append<'a> {
    touching: &'a mut Touching,
    points: &'a mut SkinContactPoints,
    sources: Sources<'a>,
}

impl WithSimd for Append<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { touching, points, sources } = self;
        for place in 0..touching.faces.len() {
            touching.append(&sources, points, touching.faces[place]);
        }
    }
}

/// Contact points in touch, one entry for each face, in the order of the arrays.
#[derive(Clone, Debug)]
pub(crate) struct Touching {
    arch: Arch,
    sort: BucketSort<FaceContact>,
    grains: Arc<Grains>,
    /// Each touched face, in the order of the arrays.
    pub faces: Vec<FaceContact>,
    /// Places in the arrays, in rising order of contact point.
    pub in_order: Vec<usize>,
    pub arrays: FrictionArrays,
    /// `-d force / d place` of each contact as it went into the last solve [N/m].
    pub block: Vec<DMat3>,
    /// Push and friction of each contact, linear about the evaluation that went into the last solve [N].
    pub force: Vec<DVec3>,
}

impl Touching {
    /// No contacts yet, on a skin of these grains.
    pub fn new(grains: Arc<Grains>) -> Self {
        Self {
            arch: Arch::new(),
            sort: BucketSort::default(),
            grains,
            faces: Vec::new(),
            in_order: Vec::new(),
            arrays: FrictionArrays::default(),
            block: Vec::new(),
            force: Vec::new(),
        }
    }

    /// Collects the touched faces of contact points, as evaluated last.
    pub fn collect(
        &mut self,
        model: &Model,
        near: &Near,
        points: &mut SkinContactPoints,
        state: &State,
    ) {
        self.clear();
        let (Some(whale), Some(friction)) = (&model.spec.whale, &model.spec.friction) else {
            return;
        };
        for (point, at) in points.list.iter().enumerate() {
            for (face, touch) in points.touches(at).iter().enumerate() {
                let region = whale.skin.regions[near.skin_of(touch.region_pair).triangle as usize];
                let rope = model.spec.lines[model.segment_line[at.segment]].rope;
                let law = friction.law_of[rope][region as usize];
                let order = self.faces.len();
                self.faces.push(FaceContact { law, rope, region, point, face, order });
            }
        }
        if friction.laws.len() > 1 {
            self.sort.sort_by_bucket(&mut self.faces, |contact| contact.law);
        }
        self.in_order.resize(self.faces.len(), 0);
        for (place, contact) in self.faces.iter().enumerate() {
            self.in_order[contact.order] = place;
        }
        let arch = self.arch;
        let sources = Sources { model, friction, near, state };
        arch.dispatch(Append { touching: self, points, sources });
    }

    fn clear(&mut self) {
        self.faces.clear();
        self.in_order.clear();
        self.arrays.clear();
    }

    /// Appends the inputs of a contact to the arrays.
    #[inline(always)]
    fn append(
        &mut self,
        sources: &Sources<'_>,
        points: &mut SkinContactPoints,
        contact: FaceContact,
    ) {
        let Sources { model, friction, near, state } = *sources;
        let FaceContact { law, rope, region, point: index, face, .. } = contact;
        let factor = points.friction_factor(model, &state.rope.position, index);
        let point = &points.list[index];
        let touch = &points.touches(point)[face];
        let (pair, of_region) = (near.skin_of(touch.pair), near.skin_of(touch.region_pair));
        let from = &state.rope.position;
        let rope_move = touch.place - point.on_rope(|node| from[node]);
        let along = from[point.node + 1] - from[point.node];
        let skin_move = pair.move_of(touch.barycentric) * (pair.stands - near.start);
        let coefficient = friction.coefficients[rope][region as usize];
        let asked = Asked {
            law,
            normal_force: touch.barrier.force,
            growth_n: touch.growth_n,
            normal: touch.normal,
            grain: self.grains.at(of_region.triangle as usize, &of_region.now, touch.normal),
            along: norm::normalize_or(along, touch.normal),
            slip: rope_move - skin_move,
            length: point.length * touch.share,
            share: touch.share,
            coefficient: coefficient * factor,
            region: region as u32,
            rope: u32::try_from(rope).unwrap_or(u32::MAX),
        };
        let kept =
            touch.kept.and_then(|kept| kept_floats(friction, &state.rope.friction.floats, kept));
        self.arrays.put(friction, asked, kept);
    }

    /// Calls the laws for their floats at the end of the step and stores them for the sites in touch.
    pub fn advance(
        &mut self,
        friction: &Friction,
        dt_s: f64,
        points: &SkinContactPoints,
        grips: &mut FrictionState,
    ) -> Result<(), Failed> {
        self.arrays.advance(friction, dt_s)?;
        grips.clear();
        for place in self.in_order.iter().copied() {
            let FaceContact { point, face, .. } = self.faces[place];
            let point = &points.list[point];
            grips.sites.push(point.site(face));
            grips.push_n.push(self.arrays.whole_push_n(place));
            grips.normals.push(self.arrays.normal_of(place));
            self.arrays.keep(friction, place, &mut grips.floats);
        }
        Ok(())
    }

    /// `-d force / d place` of a contact [N/m].
    pub fn block_of(&self, place: usize, touch: &Touch) -> DMat3 {
        self.arrays.block_of(place, touch.normal, touch.decrease())
    }

    /// Makes the normal force of a contact linear about another force; friction stays linear about its evaluation.
    pub fn follow_law(&mut self, place: usize, touch: &Touch) {
        self.arrays.set_push(place, touch.barrier.force + touch.growth_n);
        self.block[place] = self.block_of(place, touch);
        self.force[place] = self.arrays.force_of(place);
    }
}

//! The skeleton: bones, their joints, and their weights on the skin of trunk and head.

use std::f64::consts::PI;

use endline_sdk::SPINE_JOINTS;
use endline_sim::whale::{Angle, Bone, Channel};
use glam::{DQuat, DVec2, DVec3};

use super::Builder;
use super::form::WhaleForm;
use super::head::Jaws;
use super::trunk::{CORNER_ANGLE, Sections, corner_at, smooth_step};

/// Bones that move a vertex, with weights that sum to 1.
pub type Weights = [(u16, f64); 4];

/// Bones and their indices. The root bone is at mid-body, the origin of the whale's frame; the spine bends from there both
/// ways.
pub struct Skeleton {
    /// All bones, parents before children.
    pub bones: Vec<Bone>,
    /// Upper jaw and brain case.
    pub skull: u16,
    /// Lower jaw with the lips.
    pub jaw: u16,
    /// Left lower lip; the right one is next.
    pub lip: u16,
    /// Bone of each section of the body from the head to the flukes.
    stretches: Vec<u16>,
    /// Joints between those sections [share of length from the snout].
    bends: Vec<f64>,
    /// Left fluke and its tip; the right ones are next.
    pub fluke: [u16; 2],
    /// Left flipper's shoulder, blade and tip; the right ones are next.
    pub flipper: [u16; 3],
}

/// Spine joints that are divided equally between two bones: those of the thin tail stock, which bends strongly.
const SHARED: std::ops::Range<usize> = 4..SPINE_JOINTS;
/// Distance of the two bones from such a joint [share of the distance to the nearest joint].
const APART: f64 = 0.25;

/// Angle from the back of the foot about which a lower lip turns [rad].
const LIP_FOOT: f64 = 2.0;
/// Joints of the fluke blades [share of half span].
pub const FLUKE_BENDS: [f64; 2] = [0.22, 0.60];
/// Distance of the shoulder joint behind the middle of the base [share of root chord].
const HINGE_AFT: f64 = 0.5;
/// Joints of the flipper [share of span].
pub const FLIPPER_BENDS: [f64; 3] = [0.0, 0.40, 0.72];

impl Skeleton {
    /// The skeleton of a form.
    pub fn of(form: &WhaleForm, sections: &Sections) -> Self {
        let mut skeleton = Self {
            bones: vec![control()],
            skull: 0,
            jaw: 0,
            lip: 0,
            stretches: vec![0],
            bends: Vec::new(),
            fluke: [0; 2],
            flipper: [0; 3],
        };
        let middle = form.spine_joints.iter().filter(|&&joint| joint < 0.5).count();
        skeleton.add_fore_spine(form, sections, middle);
        skeleton.bends.extend(&form.spine_joints[..middle]);
        skeleton.add_jaw(form, sections);
        skeleton.add_aft_spine(form, sections, middle);
        skeleton.add_flukes(form, sections);
        skeleton.add_flippers(form, sections);
        skeleton
    }

    /// Weights of a place of the body: the two sections at the nearest joint.
    pub fn along_body(&self, at: f64) -> Weights {
        let mut weights = [(self.stretches[0], 1.0), (0, 0.0), (0, 0.0), (0, 0.0)];
        for (index, &bend) in self.bends.iter().enumerate() {
            let reach = self.reach(index);
            let aft = smooth_step(bend - reach, bend + reach, at);
            if aft > 0.0 {
                weights = [
                    (self.stretches[index], 1.0 - aft),
                    (self.stretches[index + 1], aft),
                    (0, 0.0),
                    (0, 0.0),
                ];
            }
        }
        weights
    }

    /// Half width of a bend, limited by the neighbouring joints.
    fn reach(&self, bend: usize) -> f64 {
        let here = self.bends[bend];
        let gap = |other: Option<&f64>| other.map_or(f64::INFINITY, |place| (place - here).abs());
        0.48 * gap(self.bends.get(bend + 1))
            .min(gap(bend.checked_sub(1).and_then(|before| self.bends.get(before))))
    }

    /// Transfers a share of a vertex's weights to another bone; the smallest of five weights is dropped.
    pub fn hand_over(weights: Weights, bone: u16, share: f64) -> Weights {
        if share <= 0.0 {
            return weights;
        }
        let mut moved = weights.map(|(mover, weight)| (mover, weight * (1.0 - share)));
        moved.sort_by(|left, right| right.1.total_cmp(&left.1));
        moved[3] = (bone, share);
        let sum: f64 = moved.iter().map(|(_, weight)| weight).sum();
        moved.map(|(mover, weight)| (mover, weight / sum))
    }

    fn push(
        &mut self,
        name: &str,
        parent: u16,
        origin: DVec3,
        turns: &[(Angle, f64, DVec3)],
    ) -> u16 {
        let turns =
            turns.iter().map(|&(angle, share, axis)| (Channel { angle, share }, axis)).collect();
        self.bones.push(Bone {
            name: name.into(),
            parent: Some(usize::from(parent)),
            origin,
            turns,
        });
        u16::try_from(self.bones.len() - 1).unwrap_or(u16::MAX)
    }

    /// The spine from the middle forward: each joint carries the part ahead of it and turns in the opposite sense.
    fn add_fore_spine(&mut self, form: &WhaleForm, sections: &Sections, middle: usize) {
        let mut parent = 0;
        for joint in (0..middle).rev() {
            parent = self.push(
                &spine_name(joint),
                parent,
                sections.axis(form.spine_joints[joint]),
                &spine_turns(joint, 1.0, 1.0),
            );
            self.stretches.insert(0, parent);
        }
        self.skull = parent;
    }

    fn add_aft_spine(&mut self, form: &WhaleForm, sections: &Sections, middle: usize) {
        let mut parent = 0;
        for joint in middle..SPINE_JOINTS {
            for (name, at, share) in bends_of(form, joint) {
                parent =
                    self.push(&name, parent, sections.axis(at), &spine_turns(joint, share, -1.0));
                self.stretches.push(parent);
                self.bends.push(at);
            }
        }
    }

    fn add_jaw(&mut self, form: &WhaleForm, sections: &Sections) {
        let corner = corner_at(form);
        let hinge = sections.place(corner, DVec2::Y * sections.outline(corner, CORNER_ANGLE).y);
        self.jaw = self.push("jaw", self.skull, hinge, &[(Angle::Jaw, 1.0, DVec3::Y)]);
        for (side, name, out) in sides() {
            let foot = sections.outline(0.5 * corner, LIP_FOOT) * DVec2::new(0.8 * out, 1.0);
            let turn = [(Angle::Lips(side), 1.0, DVec3::NEG_X * out)];
            let lip = self.push(
                &format!("{name}_lip"),
                self.jaw,
                sections.place(0.5 * corner, foot),
                &turn,
            );
            if side == 0 {
                self.lip = lip;
            }
        }
    }

    fn add_flukes(&mut self, form: &WhaleForm, sections: &Sections) {
        let joint = fluke_joint(form);
        let peduncle = self.stretches[self.stretches.len() - 1];
        let flukes = self.push(
            "flukes",
            peduncle,
            sections.axis(joint),
            &[(Angle::FlukePitch, 1.0, DVec3::NEG_Y)],
        );
        self.bends.push(joint);
        self.stretches.push(flukes);
        let height = form.flukes.height * form.breadth_scale;
        for (side, name, out) in sides() {
            let hinge = |bend: f64| {
                sections.place(1.0, DVec2::new(out * bend * form.flukes.span / 2.0, height))
            };
            let flex = [(Angle::FlukeFlex(side), 0.5, DVec3::X * out)];
            let blade = self.push(&format!("{name}_fluke"), flukes, hinge(FLUKE_BENDS[0]), &flex);
            let tip = self.push(&format!("{name}_fluke_tip"), blade, hinge(FLUKE_BENDS[1]), &flex);
            if side == 0 {
                self.fluke = [blade, tip];
            }
        }
    }

    fn add_flippers(&mut self, form: &WhaleForm, sections: &Sections) {
        let chest = self.chest(form.flippers.insertion);
        for (side, name, out) in sides() {
            let mirror = DVec3::new(1.0, out, 1.0);
            let turn = DQuat::from_rotation_z(form.flippers.sweep)
                * DQuat::from_rotation_x(-form.flippers.droop);
            let span = turn * DVec3::Y * mirror;
            let root = sections.flipper_root(form) * mirror;
            let behind = DVec3::NEG_X * HINGE_AFT * form.flippers.root_chord * form.length_m;
            let hinge = |bend: f64| root + span * bend * form.flippers.span * form.length_m;
            let twist = |share: f64| (Angle::FlipperTwist(side), share, span * out);
            let raise = |share: f64| (Angle::FlipperRaise(side), share, DVec3::X * out);
            let chord =
                DVec3::new(libm::cos(form.flippers.sweep), libm::sin(form.flippers.sweep), 0.0)
                    * mirror;
            let flex = (Angle::FlipperFlex(side), 0.5, chord * out);
            let sweep = (Angle::FlipperSweep(side), 1.0, DVec3::Z * out);
            let shoulder = self.push(
                &format!("{name}_flipper_shoulder"),
                chest,
                hinge(FLIPPER_BENDS[0]) + behind,
                &[twist(0.4), raise(0.8), sweep],
            );
            let blade = self.push(
                &format!("{name}_flipper_blade"),
                shoulder,
                hinge(FLIPPER_BENDS[1]),
                &[twist(0.4), raise(0.2), flex],
            );
            let tip = self.push(
                &format!("{name}_flipper_tip"),
                blade,
                hinge(FLIPPER_BENDS[2]),
                &[twist(0.2), flex],
            );
            if side == 0 {
                self.flipper = [shoulder, blade, tip];
            }
        }
    }

    /// The bone with the greatest weight at a place of the body.
    fn chest(&self, at: f64) -> u16 {
        let weights = self.along_body(at);
        if weights[1].1 > weights[0].1 { weights[1].0 } else { weights[0].0 }
    }

    /// The mirror image of a bone.
    pub fn other_side(&self, bone: u16) -> u16 {
        if bone == self.lip {
            bone + 1
        } else if self.fluke.contains(&bone) {
            bone + 2
        } else if self.flipper.contains(&bone) {
            bone + 3
        } else {
            bone
        }
    }
}

fn control() -> Bone {
    Bone { name: "control".into(), parent: None, origin: DVec3::ZERO, turns: Vec::new() }
}

/// Side number, name and sign of y.
fn sides() -> [(usize, &'static str, f64); 2] {
    [(0, "left", 1.0), (1, "right", -1.0)]
}

fn spine_name(joint: usize) -> String {
    if joint == 0 { "skull".into() } else { format!("spine_{joint}") }
}

/// Where the flukes hinge on the tail stock [share of length from the snout].
fn fluke_joint(form: &WhaleForm) -> f64 {
    (1.0 - 0.8 * form.flukes.root_chord).max(form.spine_joints[SPINE_JOINTS - 1] + 0.01)
}

/// The bones of a spine joint aft of mid-body: name, place [share of length from the snout] and share of the joint's angles.
fn bends_of(form: &WhaleForm, joint: usize) -> Vec<(String, f64, f64)> {
    let here = form.spine_joints[joint];
    if !SHARED.contains(&joint) {
        return vec![(spine_name(joint), here, 1.0)];
    }
    let next = form.spine_joints.get(joint + 1).copied().unwrap_or_else(|| fluke_joint(form));
    let apart = APART * (next - here).min(here - form.spine_joints[joint - 1]);
    vec![
        (spine_name(joint), here - apart, 0.5),
        (format!("{}_aft", spine_name(joint)), here + apart, 0.5),
    ]
}

/// The channels of a spine joint. The aft part moves down for positive pitch, to starboard for positive yaw and starboard
/// side down for positive roll; `way` is 1 for a bone that carries the fore part, -1 for the aft part.
fn spine_turns(joint: usize, share: f64, way: f64) -> [(Angle, f64, DVec3); 3] {
    [
        (Angle::SpinePitch(joint), share, DVec3::Y * way),
        (Angle::SpineYaw(joint), share, DVec3::NEG_Z * way),
        (Angle::SpineRoll(joint), share, DVec3::NEG_X * way),
    ]
}

/// Range of the shoulder on the skin of the trunk [share of length].
const SHOULDER_REACH: f64 = 0.1;
/// Weight of the shoulder at the rim of the flipper's base.
pub const SHOULDER_RIM: f64 = 0.5;

impl Builder<'_> {
    /// Bones of a place on the trunk.
    pub fn trunk_weights(&self, place: DVec3, at: f64, angle: f64) -> Weights {
        let weights = Skeleton::hand_over(
            self.skeleton.along_body(at),
            self.skeleton.jaw,
            self.jaw_share(at, angle, 0),
        );
        Skeleton::hand_over(weights, self.skeleton.flipper[0], self.shoulder_share(place, at))
    }

    /// Bones of the lower jaw: `inside` counts vertices from the rim inwards, 0 for the outside.
    pub fn lower_jaw_weights(&self, at: f64, angle: f64, inside: usize) -> Weights {
        let weights = Skeleton::hand_over(
            self.skeleton.along_body(at),
            self.skeleton.jaw,
            self.jaw_share(at, angle, inside),
        );
        Skeleton::hand_over(weights, self.skeleton.lip, self.lip_share(at, angle, inside))
    }

    /// Weight of the jaw: it ends at the corner of the mouth, and farther aft below it.
    fn jaw_share(&self, at: f64, angle: f64, inside: usize) -> f64 {
        let corner = corner_at(self.form);
        if inside > 0 {
            return 1.0 - smooth_step(corner - 0.05, corner, at);
        }
        let below = smooth_step(CORNER_ANGLE, PI, angle.max(0.0));
        let gape = if at < corner { self.jaws().gape(at) } else { CORNER_ANGLE };
        let rim = smooth_step(gape - 0.3, gape, angle);
        let from = corner - 0.05 + 0.02 * below;
        let to = corner + 0.08 * below;
        (1.0 - smooth_step(from, to.max(from + 0.02), at)) * rim
    }

    /// Weight of the lip, which turns about its foot: 1 at the rim, 0 at the height of the groove inside.
    fn lip_share(&self, at: f64, angle: f64, inside: usize) -> f64 {
        let ahead = 1.0 - at / corner_at(self.form);
        let along = smooth_step(0.06, 0.3, ahead) * (1.0 - smooth_step(0.7, 0.93, ahead));
        let gape = self.jaws().gape(at);
        let up = if inside > 0 {
            1.0 - smooth_step(0.0, 5.0, inside as f64)
        } else {
            1.0 - smooth_step(gape, 2.0, angle)
        };
        along * up
    }

    /// Weight of the shoulder, decreasing around the flipper's base.
    fn shoulder_share(&self, place: DVec3, at: f64) -> f64 {
        let flippers = &self.form.flippers;
        let root = self.flipper_root();
        let off = place - root;
        let half = flippers.root_chord / 2.0 / libm::cos(flippers.sweep).max(0.3);
        let along = (off.x.abs() / self.form.length_m - half).max(0.0);
        let off = DVec3::new(along * self.form.length_m, off.y, off.z);
        let behind =
            smooth_step(self.layout.rows[0], self.layout.rows[self.layout.hole_rows[0]], at);
        let behind = behind * smooth_step(0.0, 0.03, place.y / self.form.length_m);
        SHOULDER_RIM
            * behind
            * (1.0 - smooth_step(0.005, SHOULDER_REACH, off.length() / self.form.length_m))
    }

    fn jaws(&self) -> Jaws<'_> {
        Jaws::of(self.form, &self.sections)
    }
}

//! The skeleton: which bones there are, where they turn, and how they share the skin.

use endline_sdk::SPINE_JOINTS;
use endline_sim::whale::{Angle, Bone, Channel};
use glam::{DQuat, DVec2, DVec3};

use super::curve::smooth_step;
use super::form::WhaleForm;
use super::layout::{CORNER_ANGLE, corner_at};
use super::section::Sections;

/// Bones that move a vertex, with weights that sum to 1.
pub type Weights = [(u16, f64); 4];

/// Bones and where to find them. The middle of the body, where the whale's frame has its origin, is
/// the control bone; the spine bends from there both ways.
pub struct Skeleton {
    /// All bones, parents before children.
    pub bones: Vec<Bone>,
    /// Upper jaw and brain case.
    pub skull: u16,
    /// Lower jaw with the lips.
    pub jaw: u16,
    /// Left lower lip; the right one follows.
    pub lip: u16,
    /// Bone of each stretch of the body from the head to the flukes.
    stretches: Vec<u16>,
    /// Where one of those stretches bends on the next [share of length from the snout].
    bends: Vec<f64>,
    /// Left fluke and its tip; the right ones follow.
    pub fluke: [u16; 2],
    /// Left flipper's shoulder, blade and tip; the right ones follow.
    pub flipper: [u16; 3],
}

/// Spine joints that two bones share half and half: those of the tail stock, which is thin and bends far.
const SHARED: std::ops::Range<usize> = 4..SPINE_JOINTS;
/// How far on either side of such a joint its two bones turn [share of the way to the nearest joint].
const APART: f64 = 0.25;

/// Angle from the back of the foot about which a lower lip turns [rad].
const LIP_FOOT: f64 = 2.0;
/// Where the fluke blades bend [share of half span].
pub const FLUKE_BENDS: [f64; 2] = [0.22, 0.60];
/// How far behind the middle of its base the flipper turns [share of root chord].
const HINGE_AFT: f64 = 0.5;
/// Where the flipper bends [share of span].
pub const FLIPPER_BENDS: [f64; 3] = [0.0, 0.40, 0.72];

impl Skeleton {
    /// The skeleton of a form.
    #[must_use]
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

    /// Weights of a point of the body: the two stretches that meet at the nearest bend.
    #[must_use]
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

    /// How far a bend spreads, so that it ends before its neighbours begin.
    fn reach(&self, bend: usize) -> f64 {
        let here = self.bends[bend];
        let gap = |other: Option<&f64>| other.map_or(f64::INFINITY, |place| (place - here).abs());
        0.48 * gap(self.bends.get(bend + 1))
            .min(gap(bend.checked_sub(1).and_then(|before| self.bends.get(before))))
    }

    /// Hands part of a vertex's weights over to another bone; the least of five bones gives way.
    #[must_use]
    pub fn hand_over(weights: Weights, bone: u16, share: f64) -> Weights {
        if share <= 0.0 {
            return weights;
        }
        let mut kept = weights.map(|(mover, weight)| (mover, weight * (1.0 - share)));
        kept.sort_by(|left, right| right.1.total_cmp(&left.1));
        kept[3] = (bone, share);
        let sum: f64 = kept.iter().map(|(_, weight)| weight).sum();
        kept.map(|(mover, weight)| (mover, weight / sum))
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

    /// From the middle forward: each joint carries what lies ahead of it, so it turns the other way.
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

    /// The bone that carries most of the body at a place.
    fn chest(&self, at: f64) -> u16 {
        let weights = self.along_body(at);
        if weights[1].1 > weights[0].1 { weights[1].0 } else { weights[0].0 }
    }

    /// The bone of the other side that mirrors a bone.
    #[must_use]
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

/// Side number, name, and which way along y it lies.
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

/// A positive pitch bends what lies aft down, a positive yaw swings it to starboard, a positive roll turns its starboard side
/// down; `way` is 1 for a bone that carries what lies ahead, -1 for one that carries what lies aft.
fn spine_turns(joint: usize, share: f64, way: f64) -> [(Angle, f64, DVec3); 3] {
    [
        (Angle::SpinePitch(joint), share, DVec3::Y * way),
        (Angle::SpineYaw(joint), share, DVec3::NEG_Z * way),
        (Angle::SpineRoll(joint), share, DVec3::NEG_X * way),
    ]
}

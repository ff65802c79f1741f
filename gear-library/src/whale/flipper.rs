//! The flipper: a paddle, joined to the hole in the trunk's side by a fillet.

use endline_sdk::Region;
use endline_sim::whale::Mark;
use glam::{DQuat, DVec3};

use super::Builder;
use super::bones::{FLIPPER_BENDS, SHOULDER_RIM, Skeleton, Weights};
use super::fin::{Section, fillet, spans, tip_bluntness, tip_rounding};
use super::form::WhaleForm;
use super::mesh::Corner;
use super::trunk::{HOLE, MonotoneCubic, smooth_step};

/// Rings between root and tip.
const RINGS: usize = 17;
/// Share of the span over which the base blends into the body.
const FILLET: f64 = 0.22;
/// Start of an edge [share of the half chord from its middle].
pub const EDGE: f64 = 0.8;
/// Start of the part of the blade that follows the shoulder only [share of span].
const FREE: f64 = 0.25;
/// Start of the tip [share of span].
const TIP: f64 = 0.9;
/// Share of a flipper's chord that lies ahead of its axis.
const LEAD: f64 = 0.46;

/// Adds the left flipper to the rim of its hole.
pub fn add(build: &mut Builder, hole: &[u32]) {
    let chords = chords(build.form);
    let rim: Vec<DVec3> = hole.iter().map(|&vertex| build.half.place(vertex)).collect();
    let base: Vec<DVec3> =
        (0..hole.len()).map(|vertex| base(build, &chords, vertex, hole.len())).collect();
    let (mut before, mut inner) = (hole.to_vec(), 0.0);
    for s in spans(RINGS) {
        let ring: Vec<Corner> =
            (0..hole.len()).map(|vertex| corner(build, &chords, s, vertex, &rim, &base)).collect();
        let ring = build.half.row(ring);
        let middle = (s + inner) / 2.0;
        let count = hole.len();
        let section = section(build.form, &chords, middle);
        build.half.ring(&before, &ring, |patch| {
            Some(region(middle, section.corner(share(patch as f64 + 0.5, count)).2))
        });
        (before, inner) = (ring, s);
    }
    let place = build.flipper_place(
        (LEAD - 0.5) * build.form.flippers.tip_chord * build.form.length_m,
        1.0,
        0.0,
    );
    let tip = Corner { place, weights: weights(build, place, 1.0), mark: Mark::Skin };
    let tip = build.half.add(tip);
    build.half.fan_in(&before, tip, |_| Region::LeftFlipperTip);
}

/// Share of the outline of a section for a vertex of the hole's rim, which begins at its upper front corner and runs down.
fn share(vertex: f64, of: usize) -> f64 {
    (HOLE[1] as f64 / 2.0 - vertex) / of as f64
}

/// Intersection of the flipper without fillet with the body [m].
fn base(build: &Builder, chords: &MonotoneCubic, vertex: usize, of: usize) -> DVec3 {
    let (x, z, _) = section(build.form, chords, 0.0).corner(share(vertex as f64, of));
    let (from, along) = (build.flipper_place(x, 0.0, z), build.flipper_axis());
    let reach =
        0.6 * build.form.flippers.root_chord * build.form.length_m + 0.01 * build.form.length_m;
    let (mut low, mut high) = (-reach, reach);
    for _ in 0..40 {
        let middle = (low + high) / 2.0;
        if build.sections.level(from + along * middle) < 1.0 { low = middle } else { high = middle }
    }
    from + along * (low + high) / 2.0
}

fn corner(
    build: &Builder,
    chords: &MonotoneCubic,
    s: f64,
    vertex: usize,
    rim: &[DVec3],
    base: &[DVec3],
) -> Corner {
    let part = share(vertex as f64, rim.len());
    let (x, z, _) = section(build.form, chords, 0.0).corner(part);
    let root = base[vertex] - build.flipper_place(x, 0.0, z);
    let (x, z, _) = section(build.form, chords, s).corner(part);
    let left = 1.0 - smooth_step(0.0, 0.55, s);
    let place = build.flipper_place(x, s, z)
        + root * left
        + (rim[vertex] - base[vertex]) * fillet(s, FILLET);
    Corner { place, weights: weights(build, place, s), mark: Mark::Skin }
}

fn region(s: f64, along: f64) -> Region {
    match along {
        _ if s < 0.03 => Region::Body,
        _ if s >= TIP => Region::LeftFlipperTip,
        along if along > EDGE => Region::LeftFlipperLeading,
        along if along < -EDGE => Region::LeftFlipperTrailing,
        _ => Region::LeftFlipper,
    }
}

/// Chord along a flipper [m by share of span].
fn chords(form: &WhaleForm) -> MonotoneCubic {
    let flippers = &form.flippers;
    let points = [
        [0.0, flippers.root_chord],
        [flippers.max_chord_at, flippers.max_chord],
        [1.0, flippers.tip_chord],
    ];
    MonotoneCubic::through(points.map(|[s, chord]| [s, chord * form.length_m]))
}

fn section(form: &WhaleForm, chords: &MonotoneCubic, s: f64) -> Section {
    let flippers = &form.flippers;
    let full = chords.at(s);
    let middle = (LEAD - 0.5) * full;
    let half_chord = full / 2.0 * tip_rounding(s, 10.0);
    let half_thickness =
        full / 2.0 * (flippers.thickness + (flippers.tip_thickness - flippers.thickness) * s);
    let blunt =
        tip_bluntness(flippers.edge_radius_m, flippers.span * form.length_m, half_thickness);
    let half_thickness = half_thickness * tip_rounding(s, blunt);
    Section {
        lead: middle + half_chord,
        trail: middle - half_chord,
        half_thickness,
        edge_radius: flippers.edge_radius_m,
    }
}

/// Weights: the base follows body and shoulder, the rest shoulder, blade and tip.
fn weights(build: &Builder, place: DVec3, s: f64) -> Weights {
    let [shoulder, blade, tip] = build.skeleton.flipper;
    if s > FLIPPER_BENDS[1] - 0.15 {
        let to_blade = smooth_step(FLIPPER_BENDS[1] - 0.15, FLIPPER_BENDS[1] + 0.15, s);
        let to_tip = smooth_step(FLIPPER_BENDS[2] - 0.15, FLIPPER_BENDS[2] + 0.15, s);
        let weights = [(shoulder, 1.0 - to_blade), (blade, to_blade), (0, 0.0), (0, 0.0)];
        return Skeleton::hand_over(weights, tip, to_tip);
    }
    let at = 0.5 - place.x / build.form.length_m;
    let share = SHOULDER_RIM + (1.0 - SHOULDER_RIM) * smooth_step(0.0, FREE, s);
    Skeleton::hand_over(build.skeleton.along_body(at), shoulder, share)
}

impl Builder<'_> {
    /// Intersection of the left flipper's axis with the body [m].
    pub fn flipper_root(&self) -> DVec3 {
        self.sections.flipper_root(self.form)
    }

    /// Unit vector along the left flipper at rest.
    pub fn flipper_axis(&self) -> DVec3 {
        self.flipper_turn() * DVec3::Y
    }

    fn flipper_turn(&self) -> DQuat {
        let flippers = &self.form.flippers;
        DQuat::from_rotation_z(flippers.sweep) * DQuat::from_rotation_x(-flippers.droop)
    }

    /// A place in the flipper's frame: `x` forward along the chord [m], share of the span, `z` across [m].
    fn flipper_place(&self, x: f64, s: f64, z: f64) -> DVec3 {
        let span = self.form.flippers.span * self.form.length_m;
        self.flipper_root() + self.flipper_turn() * DVec3::new(x, s * span, z)
    }
}

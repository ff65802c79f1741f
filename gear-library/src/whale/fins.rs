//! Flippers and flukes: thin closed pieces with rounded edges and vertices crowded at the edges.

use std::f64::consts::{PI, TAU};

use endline_sdk::Region;
use endline_sim::whale::Mark;
use glam::{DQuat, DVec3};

use super::bones::{FLIPPER_BENDS, FLUKE_BENDS, Skeleton};
use super::curve::{MonotoneCubic, smooth_step};
use super::form::WhaleForm;
use super::part::{Corner, Part, Rings, Weights};
use super::section::Sections;

/// Corners around a flipper's section.
const FLIPPER_AROUND: usize = 40;
/// Rings along a flipper.
const FLIPPER_RINGS: usize = 21;
/// Corners around a fluke's section.
const FLUKE_AROUND: usize = 32;
/// Rings along each fluke.
const FLUKE_RINGS: usize = 22;
/// Least half chord and half thickness, so that any form has a section [m].
const LEAST_M: f64 = 1e-6;
/// How strongly a fluke's rings crowd at the notch and at the tip, 0 to 1.
const FLUKE_CROWD: f64 = 0.8;
/// Rounding of the notch's bottom [share of half span].
const NOTCH_ROUNDING: f64 = 0.012;
/// How far the leading edge runs on forward along the peduncle [share of root chord].
const FILLET: f64 = 0.3;
/// How far a flipper's root reaches into the body [share of span].
const ROOT: f64 = 0.2;
/// Share of the half chord, from its middle, where an edge begins.
const EDGE: f64 = 0.8;
/// Share of the span where a flipper's tip begins.
const TIP: f64 = 0.9;

/// One section of a fin in its own plane: `x` ahead along the chord, `z` across the thickness [m].
struct Section {
    lead: f64,
    trail: f64,
    half_thickness: f64,
    edge_radius: f64,
}

impl Section {
    /// The corner at a share of the way round, from the leading edge over the upper side, and its
    /// place along the chord from -1 (trailing edge) to 1 (leading edge).
    ///
    /// A flat lens rolled round by a disc of the edge's radius: the edges are as blunt as asked for,
    /// and equal steps crowd where the outline turns.
    fn corner(&self, share: f64) -> (f64, f64, f64) {
        let half_chord = ((self.lead - self.trail) / 2.0).max(LEAST_M);
        let half_thickness = self.half_thickness.max(LEAST_M);
        let radius = self.edge_radius.min(0.9 * half_thickness).min(0.45 * half_chord);
        let long = half_chord - radius;
        let short = (half_thickness - radius).max(0.03 * long);
        let turn = TAU * share;
        let crowd = libm::pow(short / long, 0.6);
        let around = libm::atan2(crowd * libm::sin(turn), libm::cos(turn));
        let (cos, sin) = (libm::cos(around), libm::sin(around));
        let normal = DVec3::new(cos / long, 0.0, sin / short).normalize();
        let x = long * cos + radius * normal.x;
        let z = short * sin * (1.0 + 0.25 * cos * sin * sin) + radius * normal.z;
        ((self.lead + self.trail) / 2.0 + x, z, x / half_chord)
    }
}

/// How much of chord and of thickness is left near a tip that rounds off; `blunt` is high for a square tip.
fn tip_rounding(s: f64, blunt: f64) -> f64 {
    libm::sqrt((1.0 - libm::pow(s.clamp(0.0, 1.0), blunt)).max(0.0))
}

/// Exponent that rounds a tip of some half thickness to a radius over a span.
fn tip_bluntness(radius: f64, span: f64, half_thickness: f64) -> f64 {
    (2.0 * radius * span / (half_thickness * half_thickness).max(LEAST_M * LEAST_M)).clamp(8.0, 80.0)
}

/// The left flipper.
#[must_use]
pub fn left_flipper(form: &WhaleForm, sections: &Sections, skeleton: &Skeleton) -> Part {
    let spans: Vec<f64> = (0..FLIPPER_RINGS).map(|ring| 1.0 - (1.0 + ROOT) * libm::pow(1.0 - share(ring, FLIPPER_RINGS), 1.7)).collect();
    let chords = flipper_chords(form);
    let turn = DQuat::from_rotation_z(form.flippers.sweep) * DQuat::from_rotation_x(-form.flippers.droop);
    let place = |x: f64, s: f64, z: f64| sections.flipper_root() + turn * DVec3::new(x, s * form.flippers.span * form.length_m, z);
    let corner = |s: f64, x: f64, z: f64| {
        let place = place(x, s, z);
        Corner { place, weights: flipper_weights(form, skeleton, place, s), mark: Mark::Skin }
    };
    let rings = spans.iter().map(|&s| {
        let section = flipper_section(form, &chords, s);
        (0..FLIPPER_AROUND).map(|column| section.corner(share(column, FLIPPER_AROUND))).map(|(x, z, _)| corner(s, x, z)).collect()
    });
    let rings = Rings { first_pole: corner(-ROOT, 0.0, 0.0), rings: rings.collect(), last_pole: corner(1.0, tip_middle(form), 0.0) };
    Part::closed(&rings, |ring, column| {
        let s = spans[ring.saturating_sub(1)];
        let (_, _, along) = flipper_section(form, &chords, s).corner((column as f64 + 0.5) / FLIPPER_AROUND as f64);
        match along {
            _ if s >= TIP => Region::LeftFlipperTip,
            along if along > EDGE => Region::LeftFlipperLeading,
            along if along < -EDGE => Region::LeftFlipperTrailing,
            _ => Region::LeftFlipper,
        }
    })
}

/// Chord along a flipper [m by share of span].
fn flipper_chords(form: &WhaleForm) -> MonotoneCubic {
    let flippers = &form.flippers;
    let points = [
        [-ROOT, 0.95 * flippers.root_chord],
        [0.0, flippers.root_chord],
        [flippers.max_chord_at, flippers.max_chord],
        [1.0, flippers.tip_chord],
    ];
    MonotoneCubic::through(points.map(|[s, chord]| [s, chord * form.length_m]))
}

/// Middle of the chord at the tip, ahead of the flipper's axis [m].
fn tip_middle(form: &WhaleForm) -> f64 {
    (LEAD - 0.5) * form.flippers.tip_chord * form.length_m
}

/// Share of a flipper's chord that lies ahead of its axis.
const LEAD: f64 = 0.46;

fn flipper_section(form: &WhaleForm, chords: &MonotoneCubic, s: f64) -> Section {
    let flippers = &form.flippers;
    let along = s.clamp(0.0, 1.0);
    let full = chords.at(s);
    let middle = (LEAD - 0.5) * full;
    let half_chord = full / 2.0 * tip_rounding(s, 10.0);
    let half_thickness = full / 2.0 * (flippers.thickness + (flippers.tip_thickness - flippers.thickness) * along);
    let blunt = tip_bluntness(flippers.edge_radius_m, flippers.span * form.length_m, half_thickness);
    let half_thickness = half_thickness * tip_rounding(s, blunt);
    Section { lead: middle + half_chord, trail: middle - half_chord, half_thickness, edge_radius: flippers.edge_radius_m }
}

/// The root stays with the body, the rest goes with shoulder, blade and tip.
fn flipper_weights(form: &WhaleForm, skeleton: &Skeleton, place: DVec3, s: f64) -> Weights {
    let [shoulder, blade, tip] = skeleton.flipper;
    if s > FLIPPER_BENDS[1] - 0.15 {
        let to_blade = smooth_step(FLIPPER_BENDS[1] - 0.15, FLIPPER_BENDS[1] + 0.15, s);
        let to_tip = smooth_step(FLIPPER_BENDS[2] - 0.15, FLIPPER_BENDS[2] + 0.15, s);
        let weights = [(shoulder, 1.0 - to_blade), (blade, to_blade), (0, 0.0), (0, 0.0)];
        return Skeleton::hand_over(weights, tip, to_tip);
    }
    let at = 0.5 - place.x / form.length_m;
    Skeleton::hand_over(skeleton.along_body(at), shoulder, smooth_step(-0.1, 0.2, s))
}

/// Both flukes: one piece from the left tip to the right.
#[must_use]
pub fn flukes(form: &WhaleForm, sections: &Sections, skeleton: &Skeleton) -> Part {
    let half_span = form.flukes.span / 2.0 * form.length_m;
    let spans: Vec<f64> = (0..=2 * FLUKE_RINGS).filter_map(fluke_span).collect();
    let corner = |s: f64, aft: f64, z: f64| {
        let height = form.flukes.height * form.breadth_scale * form.length_m;
        let place = sections.place(aft, DVec3::ZERO) + DVec3::new(0.0, s * half_span, height + z);
        Corner { place, weights: fluke_weights(skeleton, aft, s), mark: Mark::Skin }
    };
    let rings = spans.iter().map(|&s| {
        let section = fluke_section(form, s);
        let corners = (0..FLUKE_AROUND).map(|column| section.corner(share(column, FLUKE_AROUND)));
        corners.map(|(x, z, _)| corner(s, -x / form.length_m, z)).collect()
    });
    let pole = |s: f64| {
        let section = fluke_section(form, s);
        corner(s, -(section.lead + section.trail) / 2.0 / form.length_m, 0.0)
    };
    let rings = Rings { first_pole: pole(1.0), rings: rings.collect(), last_pole: pole(-1.0) };
    Part::closed(&rings, |ring, column| {
        let inner = spans[ring.saturating_sub(1)];
        let s = (inner + spans.get(ring).copied().unwrap_or(inner)) / 2.0;
        let (_, _, along) = fluke_section(form, inner).corner((column as f64 + 0.5) / FLUKE_AROUND as f64);
        fluke_region(s > 0.0, along)
    })
}

/// Where a ring of the flukes stands, 1 at the left tip, -1 at the right; none for the poles.
fn fluke_span(ring: usize) -> Option<f64> {
    let from_middle = (ring as f64 - FLUKE_RINGS as f64) / FLUKE_RINGS as f64;
    let out = from_middle.abs();
    let s = out - FLUKE_CROWD * libm::sin(TAU * out) / TAU;
    (s < 1.0).then_some(-s.copysign(from_middle))
}

/// Section of the flukes; `x` is ahead of the snout's place and so negative [m].
fn fluke_section(form: &WhaleForm, s: f64) -> Section {
    let flukes = &form.flukes;
    let out = s.abs();
    let reach = libm::tan(flukes.sweep) * flukes.span / 2.0;
    let fillet = FILLET * flukes.root_chord * libm::exp(-out / 0.1);
    let lead = 1.0 - flukes.root_chord - fillet + reach * libm::pow(out, 1.3);
    let tip_trail = 1.0 - flukes.root_chord + reach + flukes.tip_chord;
    let off = libm::sqrt(out * out + NOTCH_ROUNDING * NOTCH_ROUNDING) - NOTCH_ROUNDING;
    let lobe = 1.0 + flukes.notch * (1.0 - libm::exp(-off / 0.05));
    let trail = lobe + (tip_trail - 1.0 - flukes.notch) * out * out - 0.006 * libm::sin(PI * out);
    let chord = (trail - lead).max(0.2 * flukes.tip_chord) * form.length_m;
    let middle = -(lead + trail) / 2.0 * form.length_m;
    let half_chord = chord / 2.0 * tip_rounding(out, 16.0);
    let half_thickness = chord / 2.0 * (flukes.thickness + (flukes.tip_thickness - flukes.thickness) * out);
    let blunt = tip_bluntness(flukes.edge_radius_m, flukes.span / 2.0 * form.length_m, half_thickness);
    Section {
        lead: middle + half_chord,
        trail: middle - half_chord,
        half_thickness: half_thickness * tip_rounding(out, blunt),
        edge_radius: flukes.edge_radius_m,
    }
}

/// The middle goes with the peduncle's end, the rest with blade and tip.
fn fluke_weights(skeleton: &Skeleton, at: f64, s: f64) -> Weights {
    let [blade, tip] = skeleton.fluke.map(|bone| if s > 0.0 { bone } else { skeleton.other_side(bone) });
    let out = s.abs();
    let to_blade = smooth_step(FLUKE_BENDS[0] - 0.18, FLUKE_BENDS[0] + 0.18, out);
    let to_tip = smooth_step(FLUKE_BENDS[1] - 0.2, FLUKE_BENDS[1] + 0.2, out);
    Skeleton::hand_over(Skeleton::hand_over(skeleton.along_body(at), blade, to_blade), tip, to_tip)
}

fn fluke_region(left: bool, along: f64) -> Region {
    match (left, along) {
        (true, along) if along > EDGE => Region::LeftFlukeLeading,
        (true, along) if along < -EDGE => Region::LeftFlukeTrailing,
        (true, _) => Region::LeftFluke,
        (false, along) if along > EDGE => Region::RightFlukeLeading,
        (false, along) if along < -EDGE => Region::RightFlukeTrailing,
        (false, _) => Region::RightFluke,
    }
}

/// The region of the other side.
#[must_use]
pub fn other_side(region: Region) -> Region {
    match region {
        Region::LeftFlipper => Region::RightFlipper,
        Region::LeftFlipperLeading => Region::RightFlipperLeading,
        Region::LeftFlipperTrailing => Region::RightFlipperTrailing,
        Region::LeftFlipperTip => Region::RightFlipperTip,
        own => own,
    }
}

fn share(index: usize, of: usize) -> f64 {
    index as f64 / of as f64
}
